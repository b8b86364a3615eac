"""A cycle of the motion: a turn of the driver or its range, in pieces of one closure."""
