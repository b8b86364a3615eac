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
        "gears-double-planet",
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
STUDENTS = range(1, 31) if EVERY else (7, 29)
"""The variants of a lab."""
