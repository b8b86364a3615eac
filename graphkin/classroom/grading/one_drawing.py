"""Which values beyond their own tolerance are right, since all of a sheet is one careful drawing.

Of twenty values of a careful drawing one lies beyond its tolerance, and whatever was drawn from it
beyond its own. But errors of one drawing go together as its construction says: values of other data
may each lie near enough, but not in that way.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from graphkin.accuracy.pencil.forecast import chi_square_share
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.keys import Keys, coarseness
from graphkin.classroom.grading.likelihood import Key
from graphkin.classroom.grading.standard import Expectation
from graphkin.numbers.arrays import np

FEW = 3
"""Fewer values tell nothing of a drawing together."""


def of_one_drawing(
    expected: Expectation, answers: Mapping[str, Answer], beyond: Sequence[str]
) -> tuple[str, ...]:
    """Those of the fields ``beyond`` their tolerance that are right by all of the sheet."""
    found = tuple(field for field in beyond if is_near(expected, field, answers[field]))
    if not found:
        return ()
    keys = Keys.of([expected])
    told = np.array([answers[field].is_read for field in keys.fields])
    read = told & keys.known(0)
    given = [answers[keys.fields[place]] for place in np.flatnonzero(read)]
    values = np.array([float(each.value or 0.0) for each in given])
    digits = np.array([coarseness(each) for each in given]) * abs(values)
    key, rounded = keys.key(0, read), np.maximum(digits, keys.reading(0)[read])
    sizes = np.where(key.places, values, abs(values))
    return found if is_one_drawing(sizes - key.sizes, rounded, key) else ()


def is_near(expected: Expectation, field: str, answer: Answer) -> bool:
    """Whether a value lies where 99 of 100 careful drawings have it; a sense does so nowhere."""
    if field not in expected.tolerance:
        return False
    off = expected.item[field].off(float(answer.value or 0.0), expected.key[field])
    return abs(off) <= expected.tolerance[field].most


def is_one_drawing(off: Any, rounded: Any, key: Key) -> Any:
    """Whether values lie off together as in 95 of 100 careful drawings, each rounded by so much.

    ``off`` may hold a row for each of many sheets.
    """
    spread = key.spread + np.diag(key.computed**2 + rounded**2 / 3)
    scale, count = np.sqrt(np.diag(spread)), len(spread)
    if count < FEW or not (scale > 0).all():
        return np.zeros(np.shape(off)[:-1], dtype=bool)
    shared = spread / np.outer(scale, scale) + 1e-9 * np.eye(count)
    apart = off / scale
    size = (apart * np.linalg.solve(shared, apart.T).T).sum(axis=-1)
    return size <= count * chi_square_share(count)
