"""Which values beyond their own tolerance are right, since all of a sheet is one careful drawing.

Of twenty values of a careful drawing one lies beyond its tolerance, and whatever was drawn from it
lies beyond its own. But errors of one drawing go together as its construction says: values of other
data may each lie near enough, but not in that way.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from graphkin.accuracy.pencil.forecast import chi_square_share
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.keys import Keys, coarseness
from graphkin.classroom.grading.likelihood import Key
from graphkin.classroom.grading.standard import Expectation

LEAST = 2 / 3
"""The share of what is read that is near enough on a sheet that is one careful drawing."""


def of_one_drawing(
    expected: Expectation, answers: Mapping[str, Answer], off: Sequence[str]
) -> tuple[str, ...]:
    """Those of the fields ``off`` by themselves that are right by all of the sheet."""
    import numpy as np

    near = {
        field: is_near(expected, field, answers[field])
        for field in expected.tolerance
        if answers[field].is_read
    }
    found = tuple(field for field in off if near.get(field))
    if not found or not mostly(sum(near.values()), len(near)):
        return ()
    keys = Keys.of([expected])
    read = np.array([near.get(field, False) for field in keys.fields]) & keys.known(0)
    given = [answers[field] for field, told in zip(keys.fields, read, strict=True) if told]
    values = np.array([float(each.value or 0.0) for each in given])
    digits = np.array([coarseness(each) * abs(float(each.value or 0.0)) for each in given])
    key = keys.key(0, read)
    sizes = np.where(key.places, values, abs(values))
    rounded = np.maximum(digits, keys.reading(0)[read])
    return found if is_one_drawing(sizes - key.sizes, rounded, key) else ()


def is_near(expected: Expectation, field: str, answer: Answer) -> bool:
    """Whether an answer lies where 99 of 100 careful drawings have it."""
    value, right = float(answer.value or 0.0), expected.key[field]
    if expected.item[field].what != "place":
        value, right = abs(value), abs(right)
    return abs(value - right) <= expected.tolerance[field].most


def mostly(near: Any, read: Any) -> Any:
    """Whether so many of the values that are read are enough to tell that all are one drawing."""
    return near >= LEAST * read


def is_one_drawing(off: Any, rounded: Any, key: Key) -> bool:
    """Whether values lie off together as in 95 of 100 careful drawings, each rounded by so much."""
    import numpy as np

    spread = key.spread + np.diag(key.computed**2 + rounded**2 / 3)
    scale = np.sqrt(np.diag(spread))
    if not len(off) or not (scale > 0).all():
        return False
    shared = spread / np.outer(scale, scale) + 1e-9 * np.eye(len(scale))
    apart = off / scale
    return bool(apart @ np.linalg.solve(shared, apart) <= len(off) * chi_square_share(len(off)))
