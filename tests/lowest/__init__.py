"""The lowest versions of all libraries that pyproject.toml names, tried."""
