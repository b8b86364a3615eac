"""A file, link or text of another program, brought into the studio as the text of a scene."""

from __future__ import annotations

from base64 import b64decode
from binascii import Error
from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

from msgspec import Struct

from graphkin.importing.figure import Completion
from graphkin.importing.formats import content, imported, is_drawing, text_of
from graphkin.importing.scene_text import scene_text
from graphkin.scene.file_limits import LARGEST
from graphkin.studio.folder import ENDING, meant
from graphkin.text.problems import spoken

MOST_BYTES = 2 * LARGEST
"""Largest number of bytes of a file; its base 64 fits into a request."""


class Brought(Struct, frozen=True):
    """What the page sends: a file in base 64 with its name, or a pasted text, and what a drawing
    does not say.
    """

    file: str
    name: str
    pasted: str
    tracing: Completion

    def text(self) -> str:
        """The text that is imported. Raises SceneError where there is none."""
        if not self.file:
            link = self.pasted.strip()
            return content(link) if "://" in link[:10] else text_of(self.pasted.encode())
        try:
            return text_of(b64decode(self.file, validate=True))
        except Error:
            return ""


def brought(order: Brought, language: str) -> dict[str, Any]:
    """The text of the scene, the name of its file, and the notes. Raises GraphkinError."""
    found = scene_text(imported(order.text(), order.tracing))
    stem = PurePath(order.name or "imported").stem
    return {
        "text": found.text,
        "name": meant(f"{stem}{ENDING}") if order.name else f"imported{ENDING}",
        "notes": [spoken(note, language) for note in found.notes],
    }


def asks_more(order: Brought) -> bool:
    """Whether a text is a drawing, which does not say what is fixed."""
    try:
        return is_drawing(order.text())
    except Exception:  # the error of the import itself is reported
        return False


def tracing_of(fields: Mapping[str, str]) -> Completion:
    """What the page says of a drawing: fixed points, the driven bar, and sliding points."""
    slides = (word.partition("=") for word in fields["slides"].replace(",", " ").split())
    return Completion(
        tuple(fields["fixed"].replace(",", " ").split()),
        tuple(part.strip() for part in fields["drive"].split("-") if part.strip()),
        {name: angle or "0" for name, _, angle in slides},
    )
