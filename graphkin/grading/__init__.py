"""Answers held against each student's own drawing: tolerances, follow-through, slips, reports."""
