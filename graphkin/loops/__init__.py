"""The independent route: vector loops, their Jacobian, Newton's method and velocity ratios."""
