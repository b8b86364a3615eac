"""Pages for a browser: sheets that draw themselves and move, and animations."""
