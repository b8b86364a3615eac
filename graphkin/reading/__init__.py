"""Photographs of drawn sheets: whose each is, where its points lie, and what is right of them."""
