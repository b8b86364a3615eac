"""Who copied and who did not: classes of 120 who draw by a hand that shares nothing with marking.

``python -m tests.bench.copies`` tries every kind of class with every lab.
"""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.class_report import odds_words
from graphkin.classroom.grading.graded import SURE, Status
from graphkin.classroom.grading.keys import Keys
from graphkin.classroom.grading.likelihood import PENCILS, fit
from graphkin.classroom.grading.same_digits import copies
from graphkin.text import words
from tests.classroom.grading import hand
from tests.classroom.grading.classes import (
    COPYING,
    HONEST,
    LABS,
    Kind,
    Row,
    book_of,
    copied_class,
    honest_class,
    is_found,
    marked,
    named,
    number_of,
    sheet_of,
    takers_of,
    written,
)
from tests.classroom.grading.students import marker_of

ORDINARY = HONEST[1]


@pytest.mark.parametrize(("place", "kind"), list(enumerate(HONEST))[::2], ids=str)
def test_nobody_of_an_honest_class_is_named(place, kind):
    """Careful, weak and sloppy ones, each with one of three labs in turn."""
    lab = LABS[place % len(LABS)]
    result = marked(lab, kind, 0, honest_class(lab, kind, 0))
    assert len([each for each in result.graded if each.present]) == 120
    assert named(result) == []


def test_a_crank_laid_off_badly_is_not_the_data_of_a_neighbour():
    """Five degrees too far: the plans are then those of the fourth number further on, the values
    computed by the own scale are not."""
    lab, kind = "offset-slider-crank", ORDINARY
    rng = np.random.default_rng(5)
    answers: dict[str, Row] = {}
    for taker in takers_of(False, 0):
        given = hand.data(lab, number_of(taker))
        bad = replace(given, angle=given.angle + 5)
        found = hand.drawn(lab, bad, sheet_of(lab, taker.settings["n"]), rng, 0.1, ruler=0.1)
        answers[taker.student.id] = {f: written(f, value, 3) for f, value in found.items()}
    assert named(marked(lab, kind, 0, answers)) == []


@pytest.mark.parametrize("lab", LABS)
def test_a_crank_laid_off_badly_is_no_coarse_pencil(lab):
    """Three degrees too far, all else exact: no answer is a mistake, the pencil the finest."""
    standard = marker_of(lab, 7).standard
    keys = Keys.of([standard.expectation])
    given = hand.data(lab, 7)
    bad = replace(given, angle=given.angle + 3)
    found = hand.key(lab, bad, (standard.scales.kL, standard.scales.kv))
    values = np.array([found[field] for field in keys.fields])
    answers = np.where(keys.places, values, abs(values))
    read = np.ones(len(answers), dtype=bool)
    told = fit(answers, 1e-3 * abs(answers), keys.key(0, read))
    assert told.fits.all()
    assert told.pencil == PENCILS[0]


@pytest.mark.parametrize(("lab", "way", "least"), [
    ("offset-slider-crank", 0, 10), ("pump", 0, 10), ("slotted-lever", 1, 8), ("pump", 2, 6),
    ("pump", 3, 8),
])  # fmt: skip
def test_who_copies_is_found_and_nobody_else(lab, way, least):
    """Of twelve pairs: all of another's answers, another's data drawn again, half of another's
    answers, all of the answers of another with the same data."""
    answers, pairs = copied_class(lab, ORDINARY, 0, COPYING[way])
    result = marked(lab, ORDINARY, 0, answers)
    assert sum(is_found(result, pair) for pair in pairs) >= least
    copied = {who for pair in pairs for who in pair}
    assert all(copied.issuperset(group) for group in named(result))
    assert all(each.odds <= SURE for each in (*result.wrong_variants, *result.copies))


def test_pairs_are_not_chained():
    """B shares ten wrong numbers with A and D, and others with C, who shares nothing with A."""
    lab, kind = "pump", replace(ORDINARY, own=True)
    answers = honest_class(lab, kind, 3)
    a, b, c, d = list(answers)[:4]
    sizes = {f: float(v.value or 0) for f, v in answers[a].items() if not f.endswith("_sense")}
    wrong = {f: written(f, 1.7 * size, 4) for f, size in list(sizes.items())[:10]}
    other = {f: written(f, 2.3 * size, 4) for f, size in list(sizes.items())[10:]}
    answers[a] |= wrong
    answers[b] |= wrong | other
    answers[c] |= other
    answers[d] |= wrong
    (found,) = marked(lab, kind, 3, answers).copies
    assert set(found.students) == {a, b, d}
    assert set(found.fields) == set(wrong)


def test_each_who_copied_is_named_with_what_the_two_share():
    """One has all of A's answers, another all but the places, which are the own."""
    lab, kind = "pump", replace(ORDINARY, own=True)
    answers = honest_class(lab, kind, 4)
    order = sorted(takers_of(True, 4), key=number_of)
    a, b, c = (order[place].student.id for place in (10, 60, 110))
    shared = {field for field in answers[a] if not field.startswith(("I_", "J_"))}
    answers[b] = dict(answers[a])
    answers[c] |= {field: answers[a][field] for field in shared}
    fields = {
        frozenset(each.students): each.fields for each in marked(lab, kind, 4, answers).copies
    }
    assert set(fields) == {frozenset((a, b)), frozenset((a, c))}
    assert shared.issuperset(fields[frozenset((a, c))])
    assert not shared.issuperset(fields[frozenset((a, b))])


def test_odds_are_no_surer_than_a_model_can_be():
    spoken = words("en")
    assert odds_words(SURE, spoken) == "at least 10000"
    assert odds_words(2500.0, spoken) == spoken.significant(2500.0, 1)


def test_what_fits_another_s_data_follows_from_nothing():
    """A whole class hands in the answers of the next number."""
    lab, kind = "slotted-lever", Kind("copied", (0.25, 0.25))
    answers, _ = copied_class(lab, kind, 0, COPYING[0], 60)
    result = marked(lab, kind, 0, answers)
    fits = {each.students[0]: set(each.fields) for each in result.wrong_variants}
    assert len(fits) > 40
    alone = {t.student.id: t for t in takers_of(False, 0)}
    lost = 0
    for each in result.graded:
        who = each.taker.student.id
        if who in fits:
            before = book_of(lab).mark(alone[who], answers[who])[0]
            for mark, old in zip(each.marks, before.marks, strict=True):
                fitting = mark.item.field.removesuffix("_sense") in fits[who]
                assert not (fitting and mark.status is Status.FOLLOWS)
                assert mark.earned == (0 if mark.status is not old.status else old.earned)
                lost += mark.earned < old.earned
    assert lost > 40


def test_a_class_without_answers_has_no_copies():
    assert copies((), ()) == ()
