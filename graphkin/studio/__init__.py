"""A page on this computer alone in which a scene is written, moved, looked at and saved."""
