"""Printing a class: every student's sheets and forms, and the files for the printer."""
