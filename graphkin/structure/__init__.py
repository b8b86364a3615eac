"""How a mechanism is put together: its pairs, its mobility, and its groups in order."""
