"""Pages for a screen: the sheets that draw themselves, move, and take answers."""
