"""The views of sheets, by the names that commands and pages use."""

MOTION_VIEWS = ("positions", "diagrams")
"""The views of a whole motion."""
PAPER_VIEWS = ("overlay", *MOTION_VIEWS)
"""The views without a page for a screen."""
VIEWS = ("key", "task", "steps", *PAPER_VIEWS)
"""All views of a mechanism's sheets."""
PRINTED_VIEWS = ("task", "key", "overlay", "steps", *MOTION_VIEWS)
"""The same in the order in which the sheets of a class are printed."""
