"""A solution without what doubles have lost: the quantities of which no digit is sure."""

from __future__ import annotations

from collections.abc import Mapping
from math import nan
from typing import Any

import numpy as np
from msgspec.structs import replace

from graphkin.construction.core.solution import UNKNOWN, Solution
from graphkin.loops.equations import equations
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import Scene


def sure_of(solution: Solution, unsure: Mapping[str, Any]) -> Solution:
    """The solution with NaN for every quantity of which no digit is sure, by its path.

    Of a batch of N each path has flags (N,), and only the variants that they mark are lost.
    """
    parts: dict[str, dict[str, Any]] = {}
    for path, where in unsure.items():
        part, name, *key = path.split(".")
        motions = parts.setdefault(part, dict(getattr(solution, part)))
        found = getattr(motions[name], key[0]) if key else motions[name]
        without = lost(found, where)
        motions[name] = replace(motions[name], **{key[0]: without}) if key else without
    return replace(solution, **parts)


def lost(value: Any, where: Any = True) -> Any:
    """What stands for a value of which no digit is sure, or for some rows of an array."""
    if isinstance(value, Ratio):
        return Ratio(*(lost(part + 0j, where) for part in value))
    gone = UNKNOWN if np.iscomplexobj(value) else nan
    return gone if where is True else np.where(where, gone, value)


def evenness(scene: Scene) -> float:
    """The shortest vector of the loops and arm of a wheel, in parts of the longest."""
    loops = equations(scene)
    sizes = [abs(loops.chains.fixed).ravel(), abs(loops.slips.rows).ravel()]
    lengths = np.concatenate([part[part > 0] for part in sizes])
    return float(lengths.min() / lengths.max()) if lengths.size else 1.0
