"""Cams: the follower placed by the cam's law, the centre of curvature, and the profile."""
