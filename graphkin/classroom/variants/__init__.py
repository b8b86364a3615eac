"""Data for each student of a class: assigned, checked for fairness in one batch, and saved."""
