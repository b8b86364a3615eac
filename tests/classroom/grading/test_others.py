"""Answers that fit another student's data: found down to the neighbour's, never in honest rows.

Answers are drawn with a pencil by the construction itself (``drawn``), or are the other's key.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from math import isnan

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.class_marking import graded_class
from graphkin.classroom.grading.class_pictures import slip_counts
from graphkin.classroom.grading.class_report import own_work
from graphkin.classroom.grading.copied_answers import wrong_variants
from graphkin.classroom.grading.graded import Answer, Status, Suspicion
from tests.classroom.grading.students import (
    book_of,
    drawn,
    given,
    key_answers,
    marker_of,
    row,
    taker,
)

NUMBERS = range(1, 31)
EACH = 10
"""Drawings of each variant, so that a class has three hundred."""
Rows = Mapping[int, Mapping[str, Answer]]


def suspected(name: str, rows: Rows) -> tuple[Suspicion, ...]:
    """The suspicions about a class of thirty, those without a row absent."""
    graded = [marker_of(name, n).mark(taker(n), rows.get(n, {}), n in rows) for n in NUMBERS]
    return wrong_variants(graded, expectations(name))


@lru_cache
def expectations(name: str):
    """What is expected of each number."""
    return tuple(marker_of(name, n).standard.expectation for n in NUMBERS)


@lru_cache
def drawings(name: str, pencil: float):
    """Many drawings of each number."""
    return {n: drawn(marker_of(name, n).standard, pencil, EACH, 100 + n) for n in NUMBERS}


def key_of(name: str, n: int, digits: int = 4) -> dict[str, Answer]:
    """The key of a number to some digits."""
    key = marker_of(name, n).standard.key
    texts = {f: f"{v:.{digits}g}" for f, v in key.items() if not isnan(v)}
    return {f: Answer(text, float(text)) for f, text in texts.items()}


def shifted(n: int, by: int) -> int:
    """The number so many places further, going round."""
    return (n - 1 + by) % len(NUMBERS) + 1


@pytest.mark.parametrize(("name", "pencil"), [("pump", 0.25), ("slotted-lever", 0.5)])
def test_no_honest_row_is_suspected(name, pencil):
    """Three hundred honest students, and none of them is."""
    for i in range(EACH):
        rows = {n: row(columns, i) for n, columns in drawings(name, pencil).items()}
        assert not suspected(name, rows)


@pytest.mark.parametrize(("name", "by"), [("pump", 1), ("slotted-lever", 8)])
def test_a_row_that_is_the_key_of_the_neighbour_is_found(name, by):
    """Also where nearly all of it is right by the own key: digits agree with the other's."""
    found = suspected(name, {n: key_of(name, shifted(n, by)) for n in NUMBERS})
    named = {each.students[0]: each.students[1] for each in found}
    assert named == {f"s{n:03d}": f"s{shifted(n, by):03d}" for n in NUMBERS}


@pytest.mark.parametrize("name", ["slotted-lever"])
def test_an_own_slip_of_the_construction_is_no_evidence(name):
    """Rightly drawn from a wrong start, it hits nobody else's data."""
    for place in range(len(marker_of(name, 7).slips)):
        rows = {}
        for n in NUMBERS:
            slips = marker_of(name, n).slips
            if place < len(slips) and slips[place].whole:
                mine = row(drawings(name, 0.25)[n], 0)
                key = marker_of(name, n).standard.key
                ratio = {f: v / key[f] for f, v in slips[place].values.items() if key[f]}
                wrong = {f: mine[f].value * r for f, r in ratio.items() if f in mine}
                rows[n] = {**mine, **given({f: float(f"{v:.4g}") for f, v in wrong.items()})}
        assert not suspected(name, rows), place


def test_a_suspected_row_loses_what_follows_where_it_fits_and_guessed_slips():
    """Its slips explain it by chance: they are told to nobody, counted nowhere."""
    takers = [taker(n) for n in NUMBERS]
    marks = {
        n: marker_of("pump", n).mark(taker(n), key_answers(marker_of("pump", m).standard))
        for n in NUMBERS
        for m in (shifted(n, 2),)
    }
    answers = {f"s{n:03d}": key_answers(marker_of("pump", shifted(n, 2)).standard) for n in NUMBERS}
    found = graded_class(book_of("pump"), takers, answers).result
    assert len(found.wrong_variants) == len(NUMBERS)
    fits = {each.students[0]: each.fields for each in found.wrong_variants}
    for each in found.graded:
        before = marks[each.taker.student.number]
        for mark, old in zip(each.marks, before.marks, strict=True):
            fitting = mark.item.field.removesuffix("_sense") in fits[each.taker.student.id]
            lost = fitting and old.status is Status.FOLLOWS
            assert mark.earned == (0 if lost else old.earned)
        paid = [m for m in each.marks if m.slip]
        assert all(m.status is Status.SLIP and m.earned for m in paid)
    assert any(m.slip and not m.earned for each in marks.values() for m in each.marks)
    assert slip_counts(own_work(found)) == []


def test_the_covariance_of_many_is_that_of_one():
    book = replace(book_of("pump"), markers={}, expected={})
    book.prepare([taker(7), taker(8)])
    many = book.expectation(taker(7))
    assert np.allclose(many.spread, expectations("pump")[6].spread, rtol=1e-9)
    sizes = [each.pencil / 1.96 for each in many.tolerance.values()]
    assert np.allclose(np.sqrt(np.diag(many.spread)), sizes, rtol=0.15)
