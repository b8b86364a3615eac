"""Of which quantities a digit is sure in doubles: the others are not reported as numbers."""

from __future__ import annotations

from dataclasses import replace
from math import isnan, nan
from typing import Any

from graphkin.plane import Ratio
from graphkin.report.table import listed
from graphkin.steps.solution import LinkMotion, Solution, Verdict

UNKNOWN = complex(nan, nan)
KINDS = {"position": "positions", "velocity": "velocities", "acceleration": "accelerations"}


def sure_of(solution: Solution, verdict: Verdict | None) -> Solution:
    """The solution with NaN for every quantity of which no digit is sure."""
    parts: dict[str, dict[str, Any]] = {}
    for path in verdict.unsure if verdict is not None else ():
        part, name, *key = path.split(".")
        motions = parts.setdefault(part, dict(getattr(solution, part)))
        found = getattr(motions[name], key[0]) if key else motions[name]
        motions[name] = replace(motions[name], **{key[0]: lost(found)}) if key else lost(found)
    return replace(solution, **parts)


def is_unsure(link: LinkMotion) -> bool:
    """Whether no digit is sure of how a link turns."""
    return any(value is not None and isnan(value) for value in (link.omega, link.epsilon))


def lost(value: Any) -> Any:
    """What stands for a value of which no digit is sure."""
    if isinstance(value, Ratio):
        return Ratio(UNKNOWN, UNKNOWN, UNKNOWN)
    return UNKNOWN if isinstance(value, complex) else nan


def digits_words(verdict: Verdict) -> str:
    """How many digits are sure of the positions, velocities and accelerations."""
    known = [(kind, verdict.digits[kind]) for kind in KINDS if kind in verdict.digits]
    return ", ".join(f"{KINDS[kind]} {digits}" for kind, digits in known)


def unsure_words(verdict: Verdict) -> str:
    """Of which quantities no digit is sure, and why."""
    return (
        f"no digit is sure of {listed(verdict.unsure, 6)}: flat crossings enlarge the rounding of "
        "doubles beyond them; solve --digits proves what can be known"
    )
