"""Marks answers against each student's own drawing: tolerances, follow-through, slips."""
