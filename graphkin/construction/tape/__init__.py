"""The program as source: traced once, emitted as numpy, as a compiled loop or as JavaScript."""
