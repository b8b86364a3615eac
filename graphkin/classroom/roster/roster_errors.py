"""The error of tables that cannot be read."""

from __future__ import annotations

from graphkin.text.errors import GraphkinError


class RosterError(GraphkinError):
    """A class list or a table of answers cannot be read; every problem has its row and column."""
