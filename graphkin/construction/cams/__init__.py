"""Cams by their law: the follower set, the centre of curvature, the profile."""
