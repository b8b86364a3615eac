"""Every run tries the same examples, so that the same tree gives the same verdict."""

from hypothesis import settings

settings.register_profile("same", derandomize=True, database=None)
settings.load_profile("same")
