"""Instantaneous centres, relative centres and poles."""
