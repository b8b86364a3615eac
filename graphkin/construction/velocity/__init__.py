"""The velocity plan."""
