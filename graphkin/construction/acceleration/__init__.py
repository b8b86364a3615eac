"""The acceleration plan."""
