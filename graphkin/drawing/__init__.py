"""What any picture is made of: marks, symbols, lettering, and places for labels."""
