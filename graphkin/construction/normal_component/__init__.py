"""Normal components by the right triangle on the mechanism."""
