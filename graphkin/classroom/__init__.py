"""A class: labs, class lists, variants, printed sheets, answers and marks."""
