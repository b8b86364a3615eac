"""Pages as SVG and PDF, marks in matplotlib axes, and files written completely or not at all."""
