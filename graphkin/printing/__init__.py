"""Printing a class: every student's sheets and forms as files, and the files for the printer."""
