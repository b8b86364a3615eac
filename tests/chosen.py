"""The scenes and students that the tests of pages look at: a few that have it all, or every one.

``EVERY=1 pytest`` looks at every one, as a change of layout wants.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from itertools import cycle, islice, product
from pathlib import Path
from typing import Any
from zlib import crc32

from graphkin.text import LANGUAGES

FOLDER = Path(__file__).resolve().parents[1] / "examples" / "scenes"
SCENES = tuple(sorted(path.stem for path in FOLDER.glob("*.toml")))
"""The example scenes."""
EVERY = os.environ.get("EVERY") == "1"
CHOSEN = (
    SCENES
    if EVERY
    else (
        "cam-rocker",
        "cam-roller",
        "centrodes-roller",
        "bar-on-roller",
        "belts-forces",
        "crank-slot",
        "cylinders-two",
        "excavator-relative",
        "gears-simpson",
        "gears-kutzbach",
        "gears-pair",
        "gears-rack",
        "gears-three-planets",
        "inflection-cardan",
        "instant-centres",
        "jumper",
        "klein-engine",
        "mobility-cam",
        "platform-3rpr",
        "roller-plates",
        "six-bar",
        "stephenson-2-ternary",
        "trammel",
        "wheel-in-ring",
    )
)
"""Those of them that have every action, driver and question that any has."""
SPOKEN = ("ro", "en", "it") if EVERY else ("ro",)
"""The languages in which a page is looked at that differs in its words alone."""
STUDENTS = range(1, 31) if EVERY else (7, 29)
"""The variants of a lab."""


def number_of(name: str) -> int:
    """A number of a name alone, so that a new scene moves no other into a share or out of it."""
    return crc32(name.encode())


def shared(names: Iterable[str], parts: int, part: int = 0) -> tuple[str, ...]:
    """One of some parts of the names, by their own numbers; all with ``EVERY=1``."""
    return tuple(name for name in names if EVERY or number_of(name) % parts == part)


def spoken_by(name: str) -> tuple[str, ...]:
    """The language in which a scene is looked at, by its number; all with ``EVERY=1``."""
    return LANGUAGES if EVERY else (LANGUAGES[number_of(name) % len(LANGUAGES)],)


def by_turns(*lists: Sequence[Any]) -> list[tuple[Any, ...]]:
    """Each of every list at least once, with the others by turns; every combination with
    ``EVERY=1``.
    """
    if EVERY:
        return [*product(*lists)]
    return [*islice(zip(*map(cycle, lists), strict=False), max(map(len, lists)))]


HALVES = shared(CHOSEN, 2, 0), shared(CHOSEN, 2, 1)
"""Two halves: what takes long looks at one of them, another test at the other."""
