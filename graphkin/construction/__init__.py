"""What a hand draws, kind by kind: everything about a construction stands in its own module."""
