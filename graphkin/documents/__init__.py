"""The views of sheets, by the names that commands and pages use."""

MOTION_VIEWS = ("positions", "diagrams")
"""The views of a whole motion."""
VIEWS = ("key", "task", "steps", "overlay", *MOTION_VIEWS)
"""All views of a mechanism's sheets."""
PRINTED_VIEWS = ("task", "key", "overlay", "steps", *MOTION_VIEWS)
"""The same in the order in which the sheets of a class are printed."""
