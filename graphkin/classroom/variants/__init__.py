"""Data for each student of a class: assigned, judged as one batch, written down."""
