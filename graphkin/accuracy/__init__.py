"""What accuracy costs: the same positions by every kind of number and route."""
