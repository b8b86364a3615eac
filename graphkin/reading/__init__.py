"""Photographs of drawn sheets: their owners, the positions of their points, and what is correct."""
