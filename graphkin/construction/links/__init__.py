"""Links: their shapes, their positions, and how they are drawn."""
