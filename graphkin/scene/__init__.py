"""What the lecturer wrote: a TOML scene read into frozen records with exact numbers."""
