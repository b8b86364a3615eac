"""What the page asks for, as it comes in: every field of the kind and size that it must have."""

from __future__ import annotations

import json
from typing import Any

from graphkin.scene.limits import LARGEST

MOST_BYTES = 4 * LARGEST
"""Bytes of a request at most: a scene of the largest size, every sign of it written as an escape
but the rarest."""
MOST_SETTINGS, LONGEST_SETTING = 200, 100
SHORT = 300
"""Signs of names and marks."""


class OrderError(Exception):
    """A request that the page does not make."""


class Order:
    """A request's fields by name. Each way to read one raises OrderError for what is not so."""

    def __init__(self, data: bytes) -> None:
        try:
            fields = json.loads(data.decode("utf-8"))
        except (ValueError, RecursionError):
            raise OrderError("no JSON") from None
        if not isinstance(fields, dict):
            raise OrderError("no object")
        self.fields: dict[str, Any] = fields

    def text(self, key: str, most: int = SHORT) -> str:
        """A text; nothing where it is not given."""
        found = self.fields.get(key, "")
        if not isinstance(found, str) or len(found) > most:
            raise OrderError(key)
        try:
            found.encode("utf-8")
        except UnicodeEncodeError:
            raise OrderError(key) from None
        return found

    def scene(self) -> str:
        """The text of a scene; one too large is for the reader of scenes to refuse."""
        return self.text("text", MOST_BYTES)

    def flag(self, key: str) -> bool:
        """Whether something is so; not where it is not given."""
        found = self.fields.get(key, False)
        if not isinstance(found, bool):
            raise OrderError(key)
        return found

    def number(self, key: str) -> int:
        """A whole number; 0 where it is not given."""
        found = self.fields.get(key, 0)
        if not isinstance(found, int) or isinstance(found, bool) or not 0 <= found < 2**53:
            raise OrderError(key)
        return found

    def choice(self, key: str, known: tuple[str, ...]) -> str:
        """One of some words; the first where it is not given."""
        found = self.fields.get(key, known[0])
        if found not in known:
            raise OrderError(key)
        return str(found)

    def choices(self, key: str, known: tuple[str, ...]) -> tuple[str, ...]:
        """Some of some words, in their order; at least one."""
        found = self.fields.get(key)
        if not isinstance(found, list) or not found or any(word not in known for word in found):
            raise OrderError(key)
        return tuple(word for word in known if word in found)

    def settings(self) -> dict[str, str]:
        """The values of sliders, as texts."""
        found = self.fields.get("settings", {})
        if not isinstance(found, dict) or len(found) > MOST_SETTINGS:
            raise OrderError("settings")
        for value in found.values():
            if not isinstance(value, str) or not 0 < len(value) <= LONGEST_SETTING:
                raise OrderError("settings")
        return dict(found)
