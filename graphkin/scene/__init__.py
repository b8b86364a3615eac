"""The scene of a lecturer: a TOML file read into frozen records with exact numbers."""
