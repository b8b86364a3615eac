"""Who copied and who did not: classes of 120 who draw by a hand that shares nothing with marking.

``python -m tests.bench.copies`` tries every kind of class with every lab.
"""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.graded import SURE, Status
from graphkin.classroom.grading.same_digits import copies
from graphkin.classroom.grading.same_digits import named as grouped
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

CAREFUL, ORDINARY, COMPUTED = HONEST[0], HONEST[1], HONEST[6]
SOME = range(len(HONEST)) if EVERY else (0, 3, 6)
ONE = None if EVERY else 1
"""How many labs a class of a kind is tried with."""


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
    """Classes in which two have the same data and the same slip, and write the same uncopied."""
    answers = honest_class(lab, COMPUTED, seed)
    texts = [tuple(each.text for each in row.values()) for row in answers.values()]
    assert len(set(texts)) < len(texts)
    assert named(marked(lab, COMPUTED, seed, answers)) == []


@pytest.mark.parametrize("lab", LABS[:ONE])
def test_a_class_that_computes_and_misunderstands_alike_names_nobody(lab):
    """All have one slip, and what it leaves near enough to be right is the same for all, too."""
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


@pytest.mark.parametrize("lab", LABS[:ONE])
def test_nine_of_ten_who_hand_in_another_s_answers_are_found(lab):
    """Twelve of a hundred and twenty who have data of their own; all the others are honest."""
    kind = HONEST[3] if lab == LABS[0] else ORDINARY
    answers, pairs = copied_class(lab, kind, 2, COPYING[0])
    result = marked(lab, kind, 2, answers)
    assert sum(is_found(result, pair) for pair in pairs) >= 0.9 * len(pairs)
    copied = {who for pair in pairs for who in pair}
    assert all(copied.issuperset(group) for group in named(result))


@pytest.mark.parametrize(("lab", "way", "least"), [
    ("offset-slider-crank", 0, 10), ("slotted-lever", 1, 8), ("pump", 2, 6), ("pump", 3, 8),
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
    times = (1.3, 2.6, 0.6, 1.9, 0.45, 3.1)
    every = {f: written(f, times[i % 6] * size, 4) for i, (f, size) in enumerate(sizes.items())}
    wrong = {f: every[f] for f in list(sizes)[:10]}
    other = {f: every[f] for f in list(sizes)[10:]}
    answers[a] |= wrong
    answers[b] |= wrong | other
    answers[c] |= other
    answers[d] |= wrong
    (found,) = marked(lab, kind, 3, answers).copies
    assert set(found.students) == {a, b, d}
    assert set(found.fields) == set(wrong)


def test_who_shares_with_one_of_two_only_what_these_share_is_named_with_nobody():
    """It was theirs already; whoever shares something else with one of them is a pair with that."""
    strong = {(0, 1): 30.0, (0, 2): 20.0, (1, 3): 10.0}
    fields = {(0, 1): (4, 5, 6), (0, 2): (4, 6), (1, 3): (6, 7)}
    found = list(grouped(strong, fields, lambda pair, less: 99.0))
    assert found == [((0, 1), (4, 5, 6), 30.0), ((1, 3), (6, 7), 10.0)]


def test_three_who_share_answers_are_one_group_with_the_odds_of_their_weakest_pair():
    strong = {(0, 1): 30.0, (0, 2): 29.0, (1, 2): 28.0}
    fields = dict.fromkeys(strong, (4, 5, 6))
    (found,) = grouped(strong, fields, lambda pair, less: strong[pair])
    assert found == ((0, 1, 2), (4, 5, 6), 28.0)


def test_what_fits_another_s_data_follows_from_nothing():
    """A whole class hands in the answers of the next number."""
    lab, kind = "slotted-lever", Kind("copied", (0.25, 0.25))
    answers, _ = copied_class(lab, kind, 0, COPYING[0], 30)
    result = marked(lab, kind, 0, answers)
    fits = {each.students[0]: set(each.fields) for each in result.wrong_variants}
    assert len(fits) > 20
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
    assert lost > 20


def test_a_class_without_answers_has_no_copies():
    assert copies((), ()) == ()
