"""Slips by name: known ways of going wrong, and what each field would then be."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan, pi

from msgspec import Struct

from graphkin.classroom.grading.standard import Standard

RATIOS = {
    "rpm_as_rad": 30 / pi,
    "turns_as_rad": 1 / (2 * pi),
}
"""How many times too fast a crank turns whose rev/min, or rev/s, are taken for rad/s."""
AS_RPM = pi / 30
"""The same where rad/s are taken for rev/min."""
UNITS_TAKEN = (*RATIOS, "rad_as_rpm")
"""The slips of a speed's unit."""


class Slip(Struct, frozen=True):
    """A slip by name, and what each field that it changes would then be.

    ``whole`` tells that it is one of the construction, which goes through all that follows.
    """

    name: str
    whole: bool
    values: Mapping[str, float]


def unit_ratios(standard: Standard) -> Mapping[str, float]:
    """How many times too fast a crank turns whose speed is taken in the wrong unit, by slip."""
    in_turns = standard.mechanism.scene.units.get("speed") == "rev/min"
    return RATIOS if in_turns else {"rad_as_rpm": AS_RPM}


def differs(standard: Standard, field: str, value: float) -> bool:
    """Whether a field is told otherwise than by the key, by more than it may be off."""
    if isnan(value):
        return False
    item, right = standard.by_field[field].item, standard.key[field]
    if item.what == "sense":
        return value != 0 and value == -right
    return abs(item.off(value, right)) > standard.tolerance[field].value
