"""Guides and the blocks that slide on them."""
