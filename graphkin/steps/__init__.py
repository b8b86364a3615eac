"""What a hand can draw, the straight-line program of it, and the run that gives every value."""
