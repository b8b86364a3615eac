"""Wheels, gears and racks: how they stand and move without slip."""
