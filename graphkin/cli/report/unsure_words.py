"""Of which quantities a digit is sure in doubles: the others are not reported as numbers."""

from __future__ import annotations

from math import isnan

from graphkin.construction.core.solution import LinkMotion, Verdict
from graphkin.text.plain_table import listed

KINDS = {"position": "positions", "velocity": "velocities", "acceleration": "accelerations"}


def is_unsure(link: LinkMotion) -> bool:
    """Whether no digit is sure of how a link turns."""
    return any(value is not None and isnan(value) for value in (link.omega, link.epsilon))


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
