"""The elements of any drawing: marks, symbols, lettering, and places for labels."""
