"""Which steps to draw: position, velocity and acceleration of each group, poles and centres."""
