"""Mechanisms from the files and links of other programs, written as scenes."""
