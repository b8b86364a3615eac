"""Marks answers against each student's own drawing: tolerances, causes, follow-through."""
