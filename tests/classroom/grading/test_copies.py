"""Who copied and who did not: classes of 120 who draw by a hand that shares nothing with marking.

``python -m tests.bench.copies`` tries every kind of class with every lab.
"""

from __future__ import annotations

from functools import cache
from math import isnan

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.classroom.grading import copied_answers
from graphkin.classroom.grading.class_marking import graded_class
from graphkin.classroom.grading.copied_answers import copies, wrong_variants
from graphkin.classroom.grading.copied_answers import named as grouped
from graphkin.classroom.grading.graded import SURE, Answer, Status
from graphkin.classroom.grading.keys import Keys
from tests.chosen import EVERY
from tests.classroom.grading.classes import (
    COPYING,
    HONEST,
    LABS,
    Kind,
    book_of,
    copied_class,
    honest_class,
    is_found,
    marked,
    named,
    takers_of,
    written,
)
from tests.classroom.grading.hand import SLIPS
from tests.classroom.grading.students import book_of as shipped
from tests.classroom.grading.students import marker_of, taker

CAREFUL, ORDINARY, WEAK, COMPUTED = HONEST[0], HONEST[1], HONEST[3], HONEST[6]
SOME = range(len(HONEST)) if EVERY else (0, 3, 6)
ONE = None if EVERY else 1
"""How many labs a class of a kind is tried with."""
NUMBERS = range(1, 31)


@pytest.mark.parametrize("seed", range(10 if EVERY else 1))
@pytest.mark.parametrize("place", SOME, ids=lambda place: HONEST[place].name)
def test_nobody_of_an_honest_class_is_named(place, seed):
    """Careful, weak and sloppy ones, each with one of three labs in turn."""
    kind, lab = HONEST[place], LABS[(place + seed) % len(LABS)]
    result = marked(lab, kind, seed, honest_class(lab, kind, seed))
    assert len([each for each in result.graded if each.present]) == 120
    assert named(result) == []


@pytest.mark.parametrize(("lab", "seed"), list(zip(LABS, (2, 16, 7), strict=True))[:ONE])
def test_who_computes_instead_of_drawing_agrees_with_others_to_the_digits(lab, seed):
    """Classes in which two have the same data and the same slip, and write the same uncopied; and
    one in which all have one slip, and what it leaves near enough to be right is the same, too."""
    answers = honest_class(lab, COMPUTED, seed)
    texts = [tuple(each.text for each in row.values()) for row in answers.values()]
    assert len(set(texts)) < len(texts)
    assert named(marked(lab, COMPUTED, seed, answers)) == []
    kind = Kind("computed, one slip", (0.0, 0.01), step=0.1, share=1.0, slips=SLIPS[5:6])
    assert named(marked(lab, kind, 0, honest_class(lab, kind, 0))) == []


def test_of_what_careful_hands_draw_hardly_a_hundredth_is_judged_wrong():
    """Three classes, each student with a quarter of a millimetre: every field that is not right."""
    found = [
        (lab, mark.item.field, mark.status)
        for lab in LABS
        for graded in marked(lab, CAREFUL, 1, honest_class(lab, CAREFUL, 1)).graded
        for mark in graded.marks
        if mark.points and not mark.answer.is_blank
    ]
    wrong = [each for each in found if each[2] is not Status.RIGHT]
    assert len(found) > 5000
    assert len(wrong) <= 0.01 * len(found), wrong


@pytest.mark.parametrize(("lab", "kind", "way", "least"), [
    ("offset-slider-crank", WEAK, 0, 11), ("slotted-lever", ORDINARY, 1, 8),
    ("pump", ORDINARY, 2, 6), ("pump", ORDINARY, 3, 8),
])  # fmt: skip
def test_who_copies_is_found_and_nobody_else(lab, kind, way, least):
    """Of twelve pairs: all of another's answers, another's data drawn again, half of another's
    answers, all of the answers of another with the same data. It changes no mark by itself."""
    answers, pairs = copied_class(lab, kind, 0, COPYING[way])
    result = marked(lab, kind, 0, answers)
    assert sum(is_found(result, pair) for pair in pairs) >= least
    copied = {who for pair in pairs for who in pair}
    assert all(copied.issuperset(group) for group in named(result))
    assert all(each.odds <= SURE for each in (*result.wrong_variants, *result.copies))
    by_itself = result.copies and not result.wrong_variants
    for each in result.graded[:: 1 if EVERY else 12] if by_itself else ():
        alone = book_of(lab).marker_of(each.taker).mark(each.taker, answers[each.taker.student.id])
        assert each.marks == alone.marks


def test_whole_millimetres_agree_twice_as_often_as_halves():
    """A student all of whose lengths are whole reads whole millimetres."""
    keys = Keys.of([marker_of("pump", 7).standard.expectation])
    halves, whole = keys.reading(0), keys.reading(0, whole=True)
    assert (whole == np.where(keys.lengths, 2.0, 1.0) * halves).all()
    assert copied_answers.is_whole(np.array([93.0, 70.0, np.nan, 12.0]))
    assert not copied_answers.is_whole(np.array([93.0, 70.0, 12.5]))
    assert not copied_answers.is_whole(np.array([93.0, 70.0]))


def test_pairs_are_not_chained():
    """B shares ten wrong numbers with A and D, and others with C, who shares nothing with A."""
    answers = honest_class("pump", ORDINARY, 0)
    own = {each.settings["n"]: each.student.id for each in reversed(takers_of(False, 0))}
    a, b, c, d = list(own.values())[:4]
    sizes = {f: float(v.value or 0) for f, v in answers[a].items() if not f.endswith("_sense")}
    times = (1.3, 2.6, 0.6, 1.9, 0.45, 3.1)
    every = {f: written(f, times[i % 6] * size, 4) for i, (f, size) in enumerate(sizes.items())}
    wrong = {f: every[f] for f in list(sizes)[:10]}
    other = {f: every[f] for f in list(sizes)[10:]}
    for who, shared in ((a, wrong), (b, wrong | other), (c, other), (d, wrong)):
        answers[who] |= shared
    (found,) = marked("pump", ORDINARY, 0, answers).copies
    assert set(found.students) == {a, b, d}
    assert set(found.fields) == set(wrong)


def test_who_shares_with_one_of_two_only_what_these_share_is_named_with_nobody():
    """It was theirs already; whoever shares something else with one of them is a pair with that;
    three who share are one group with the odds of their weakest pair."""
    strong = {(0, 1): 30.0, (0, 2): 20.0, (1, 3): 10.0}
    fields = {(0, 1): (4, 5, 6), (0, 2): (4, 6), (1, 3): (6, 7)}
    found = list(grouped(strong, fields, lambda pair, less: 99.0))
    assert found == [((0, 1), (4, 5, 6), 30.0), ((1, 3), (6, 7), 10.0)]
    strong = {(0, 1): 30.0, (0, 2): 29.0, (1, 2): 28.0}
    (found,) = grouped(strong, dict.fromkeys(strong, (4, 5, 6)), lambda pair, less: strong[pair])
    assert found == ((0, 1, 2), (4, 5, 6), 28.0)
    assert copies((), ()) == ()


def test_two_processes_mark_as_one_does():
    answers, book = honest_class("pump", ORDINARY, 0), replace(shipped("pump"), markers={})
    takers = takers_of(False, 0)[:40]
    alone, two = (graded_class(replace(book, markers={}), takers, answers, jobs=n) for n in (1, 2))
    assert replace(alone, expected=()) == replace(two, expected=())
    assert [e.key for e in alone.expected] == [e.key for e in two.expected]


# --- another's data ------------------------------------------------------------------------------


@cache
def expectations(name: str):
    """What is expected of each number."""
    return tuple(marker_of(name, n).standard.expectation for n in NUMBERS)


def shifted(n: int, by: int) -> int:
    """The number so many places further, going round."""
    return (n - 1 + by) % len(NUMBERS) + 1


@pytest.mark.parametrize(("name", "by"), [("pump", 1), ("slotted-lever", 8)])
def test_a_row_that_is_the_key_of_the_neighbour_is_found(name, by):
    """Also where nearly all of it is right by the own key: digits agree with the other's."""
    graded = []
    for n in NUMBERS:
        key = marker_of(name, shifted(n, by)).standard.key
        texts = {f: f"{v:.4g}" for f, v in key.items() if not isnan(v)}
        row = {f: Answer(text, float(text)) for f, text in texts.items()}
        graded.append(marker_of(name, n).mark(taker(n), row))
    found = wrong_variants(graded, expectations(name))
    assert {each.students[0]: each.students[1] for each in found} == {
        f"s{n:03d}": f"s{shifted(n, by):03d}" for n in NUMBERS
    }


def sizes(n: int) -> dict[str, float]:
    """The numbers of a key, senses left out."""
    key = marker_of("pump", n).standard.key
    return {f: v for f, v in key.items() if not (isnan(v) or f.endswith("_sense"))}


def half_way(percent: int):
    """Six students, each with eight numbers so much of the way from the own to another's."""
    for n in range(3, 27, 4):
        other = sizes(shifted(n, 8))
        own = [*sizes(n).items()][:8]
        mixed = {f: v + percent / 100 * (other[f] - v) for f, v in own if f in other}
        yield n, {f: written(f, value, 3) for f, value in mixed.items()}


def alike(count: int):
    """Two with other data who write so many of the same wrong numbers."""
    n, factors = count + 1, (1.3, 2.6, 0.6, 1.9, 0.45, 3.1)
    same = [(f, factors[i % 6] * v) for i, (f, v) in enumerate(sizes(n).items()) if i < count]
    for own, off in ((n, 1.003), (shifted(n, 10), 0.997)):
        every = {f: off * v for f, v in sizes(own).items()}
        every |= {f: v for f, v in same if f in every}
        yield own, {f: written(f, value, 2) for f, value in every.items()}


@pytest.mark.parametrize(
    ("suspect", "some", "amounts"),
    [(wrong_variants, half_way, (60, 70, 80)), (copies, alike, range(3, 11))],
    ids=["another's data", "another's digits"],
)
def test_who_is_named_has_odds_of_a_thousand(suspect, some, amounts, monkeypatch):
    """All with such odds are named, and none of those with less, of whom there are some."""
    rows = [row for amount in amounts for row in some(amount)]
    graded = [marker_of("pump", n).mark(taker(n, f"{i}"), row) for i, (n, row) in enumerate(rows)]
    own = [marker_of("pump", n).standard.expectation for n, _ in rows]
    found = suspect(graded, own)
    for odds in ("STRONG", "STRONG_COPY"):
        monkeypatch.setattr(copied_answers, odds, 1.0)
    every = suspect(graded, own)
    assert list(found) == [each for each in every if each.odds >= 1000]
    assert 2 < len(found) < len(every) - 2


def test_the_covariance_of_many_is_that_of_one():
    book = replace(shipped("pump"), markers={})
    book.prepare([taker(7), taker(8)])
    many = book.expectation(taker(7))
    assert np.allclose(many.spread, expectations("pump")[6].spread, rtol=1e-9)
    sizes = [each.pencil / 1.96 for each in many.tolerance.values()]
    assert np.allclose(np.sqrt(np.diag(many.spread)), sizes, rtol=0.15)
