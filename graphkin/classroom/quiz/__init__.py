"""A lab as questions of a learning platform."""
