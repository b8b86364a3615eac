"""Wheels, gears and racks: their positions, and their motion without slip."""
