"""Printing a class: every student's sheets and forms, and the merged files to print."""
