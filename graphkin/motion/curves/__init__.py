"""Figures of a whole cycle: curves over the driver, paths of points, centrodes, the ring."""
