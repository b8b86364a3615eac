"""The manual: its pages are run, and what the program writes into them is kept here."""
