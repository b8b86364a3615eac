"""Pages as SVG and PDF, marks in axes of matplotlib, files written whole or not at all."""
