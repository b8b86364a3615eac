"""Pages for a browser: sheets that are drawn step by step and move, and animations."""
