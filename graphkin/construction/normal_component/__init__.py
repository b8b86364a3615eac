"""Acceleration components that follow from the velocity of a point about another."""
