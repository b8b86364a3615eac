"""How links stand, carried over from the equations they were found by to others."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.loops.equations import Equations
from graphkin.loops.rigid_bodies import Guide, Reals

Spot = tuple[str, int, str]
"""A guide by its block, its number there, and whether it is a track."""


class Pose(Struct, frozen=True, eq=False):
    """The angle of every link's x axis (radians) and the coordinate on every guide (m)."""

    angles: Mapping[str, float]
    coordinates: Mapping[Spot, float]


def spot(guide: Guide) -> Spot:
    """What a guide is known by."""
    return guide.block, guide.number, guide.moved_by


def setting_of(loops: Equations, n: int) -> dict[str, Any]:
    """The parameter values of one setting of a batch, or of the one scene."""
    values = loops.numbers.values
    return {name: v[n].item() if hasattr(v, "shape") else v for name, v in values.items()}


def lean(loops: Equations, link: str, setting: int = 0) -> float:
    """Angle (radians) of a link's x axis against its turning."""
    return float(loops.numbers.reals(loops.turned.angle[link])[setting])


def pose_of(loops: Equations, row: Reals, setting: int = 0) -> Pose:
    """How links stand by the unknowns (K + m,) of one setting."""
    angles = np.concatenate([[0.0], row[: loops.turning_count]])
    slid = row[loops.turning_count :]
    return Pose(
        {
            link: float(angles[loops.turned.of[link]]) + lean(loops, link, setting)
            for link in loops.links
        },
        {spot(guide): float(s) for guide, s in zip(loops.guides, slid, strict=True)},
    )


def unknowns_of(loops: Equations, pose: Pose) -> Reals:
    """The unknowns (1, K + m) of a pose, one scene; zero where the pose does not tell them."""
    row = np.zeros((1, loops.unknown_count))
    for link, angle in pose.angles.items():
        k = loops.turned.of.get(link, 0)
        if k:
            row[0, k - 1] = angle - lean(loops, link)
    for j, guide in enumerate(loops.guides):
        row[0, loops.turning_count + j] = pose.coordinates.get(spot(guide), 0.0)
    return row
