"""How fast it is, told in ratios against plain code in the same run: python -m tests.bench."""
