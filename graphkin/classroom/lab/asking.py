"""What one student's form asks, and its worth: a segment that is too short is not measured."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from fractions import Fraction

from graphkin.classroom.lab.lab_model import Item


def is_left_out(item: Item, points: Mapping[str, Fraction], compute: Collection[str]) -> bool:
    """Whether only the value is asked of a vector: its segment is too short to be measured, and the
    value, which is computed, is worth points of its own."""
    left = item.what == "segment" and item.field in compute
    return left and bool(points.get(item.beside("value")))


def worth(item: Item, points: Mapping[str, Fraction], compute: Collection[str]) -> Fraction | None:
    """The points of a field; a segment that is left out leaves its own to the value.

    None where the rubric gives none at all.
    """
    if is_left_out(item, points, compute):
        return None
    own = points.get(item.field)
    more = points.get(item.segment) if item.segment in compute else None
    return own if more is None else (own or 0) + more


def asked_of(
    form: Iterable[Item], points: Mapping[str, Fraction], compute: Collection[str]
) -> tuple[tuple[Item, ...], dict[str, Fraction]]:
    """The fields that one student's form has, and the points of those that are worth any."""
    items = tuple(item for item in form if not is_left_out(item, points, compute))
    worths = {item.field: worth(item, points, compute) for item in items}
    return items, {field: found for field, found in worths.items() if found is not None}
