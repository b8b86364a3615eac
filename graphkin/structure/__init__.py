"""The structure of a mechanism: its pairs, its mobility, and its groups in order."""
