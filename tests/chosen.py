"""The scenes and students that the tests of pages look at: a few that have it all, or every one.

``EVERY=1 pytest`` looks at every one, as a change of layout wants.
"""

from __future__ import annotations

import os
from pathlib import Path

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
HALVES = (CHOSEN, CHOSEN) if EVERY else (CHOSEN[::2], CHOSEN[1::2])
"""Every other one, and the rest: what takes long looks at one half, another test at the other."""
SPOKEN = ("ro", "en", "it") if EVERY else ("ro",)
"""The languages in which a page is looked at that differs in its words alone."""
STUDENTS = range(1, 31) if EVERY else (7, 29)
"""The variants of a lab."""
