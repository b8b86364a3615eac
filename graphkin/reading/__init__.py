"""Photographs of drawn sheets: whose sheet each is, where its points are, which ones are right."""
