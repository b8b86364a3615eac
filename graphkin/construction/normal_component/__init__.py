"""What the velocity of a point about another says of its acceleration."""
