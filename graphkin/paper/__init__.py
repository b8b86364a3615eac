"""The page: one display list in millimetres, and the files written from it."""
