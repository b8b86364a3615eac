"""What the program gives, committed, so that a redesign can be proved to change none of it."""
