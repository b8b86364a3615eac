"""A lab as questions for a learning platform."""
