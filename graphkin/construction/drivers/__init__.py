"""The motions that drivers give, and how drivers are drawn."""
