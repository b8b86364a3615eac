"""The studio: a page on this computer in which a scene is written, moved, viewed and saved."""
