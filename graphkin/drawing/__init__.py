"""The parts of any picture: marks, symbols, lettering, and places for labels."""
