"""Wheels, gears and racks that roll without slip."""
