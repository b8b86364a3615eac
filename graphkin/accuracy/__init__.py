"""The cost of accuracy: the same positions computed with every kind of number and method."""
