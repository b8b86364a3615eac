"""Kinds of numbers, exact rationals, points and lines of the plane."""
