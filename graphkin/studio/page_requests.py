"""What the page asks for, as it comes in: every field of the kind and size that it must have."""

from __future__ import annotations

import json
from typing import Any

from graphkin.scene.file_limits import LARGEST

MOST_BYTES = 4 * LARGEST
"""Bytes of a request at most: a scene of the largest size, every sign of it written as an escape
but the rarest."""
MOST_SETTINGS, LONGEST_SETTING = 200, 100
MOST_PLACES, FARTHEST = 500, 1e9
"""Points whose places are told, and how far off one may be."""
SHORT = 300
"""Signs of names and marks."""


class PageRequestError(Exception):
    """A request that the page does not make."""


class PageRequest:
    """The fields of a request by name; reading one that is not so raises PageRequestError."""

    def __init__(self, data: bytes) -> None:
        try:
            fields = json.loads(data.decode("utf-8"))
        except (ValueError, RecursionError):
            raise PageRequestError("no JSON") from None
        if not isinstance(fields, dict):
            raise PageRequestError("no object")
        self.fields: dict[str, Any] = fields

    def text(self, key: str, most: int = SHORT) -> str:
        """A text; nothing where it is not given."""
        found = self.fields.get(key, "")
        if not isinstance(found, str) or len(found) > most:
            raise PageRequestError(key)
        try:
            found.encode("utf-8")
        except UnicodeEncodeError:
            raise PageRequestError(key) from None
        return found

    def scene(self) -> str:
        """The text of a scene; one too large is for the reader of scenes to refuse."""
        return self.long_text("text")

    def long_text(self, key: str) -> str:
        """A text as long as a scene may be."""
        return self.text(key, MOST_BYTES)

    def flag(self, key: str) -> bool:
        """Whether something is so; not where it is not given."""
        found = self.fields.get(key, False)
        if not isinstance(found, bool):
            raise PageRequestError(key)
        return found

    def number(self, key: str) -> int:
        """A whole number; 0 where it is not given."""
        found = self.fields.get(key, 0)
        if not isinstance(found, int) or isinstance(found, bool) or not 0 <= found < 2**53:
            raise PageRequestError(key)
        return found

    def choice(self, key: str, known: tuple[str, ...]) -> str:
        """One of some words; the first where it is not given."""
        found = self.fields.get(key, known[0])
        if found not in known:
            raise PageRequestError(key)
        return str(found)

    def choices(self, key: str, known: tuple[str, ...]) -> tuple[str, ...]:
        """Some of some words, in their order; at least one."""
        found = self.fields.get(key)
        if not isinstance(found, list) or not found or any(word not in known for word in found):
            raise PageRequestError(key)
        return tuple(word for word in known if word in found)

    def place(self, key: str) -> complex:
        """A place in the field; its origin where it is not given."""
        return place_of(key, self.fields.get(key, [0, 0]))

    def places(self) -> dict[str, complex]:
        """Where points stand, by their names."""
        found = self.fields.get("places", {})
        if not isinstance(found, dict) or len(found) > MOST_PLACES:
            raise PageRequestError("places")
        return {name: place_of("places", at) for name, at in found.items() if len(name) <= SHORT}

    def names(self, key: str) -> tuple[str, ...]:
        """At most two names."""
        found = self.fields.get(key, [])
        if not isinstance(found, list) or len(found) > 2:
            raise PageRequestError(key)
        if not all(isinstance(name, str) and 0 < len(name) <= SHORT for name in found):
            raise PageRequestError(key)
        return tuple(found)

    def settings(self) -> dict[str, str]:
        """The values of sliders, as texts."""
        found = self.fields.get("settings", {})
        if not isinstance(found, dict) or len(found) > MOST_SETTINGS:
            raise PageRequestError("settings")
        for value in found.values():
            if not isinstance(value, str) or not 0 < len(value) <= LONGEST_SETTING:
                raise PageRequestError("settings")
        return dict(found)


def place_of(key: str, found: Any) -> complex:
    """A place as the page tells it. Raises PageRequestError for what is none."""
    if not isinstance(found, list) or len(found) != 2:
        raise PageRequestError(key)
    for value in found:
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not number or not abs(value) <= FARTHEST:
            raise PageRequestError(key)
    return complex(*found)
