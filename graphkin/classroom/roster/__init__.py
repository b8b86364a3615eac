"""Class lists and tables of answers: CSV with any separator, or XLSX."""
