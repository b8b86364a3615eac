"""The program as source code: traced once, then emitted as numpy, a compiled loop or JavaScript."""
