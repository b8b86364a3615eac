"""The marking's judgement on labs of one's own, whose classes draw by formulas of another book.

Careful hands (0.25 mm along either axis, 0.25°, lengths read to half a millimetre) are right, who
understood something wrongly is not, another's sheet earns no more than the lab allows, and copies
are found. What is right by all of a sheet is tried field by field.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from graphkin.classroom.grading.feedback import why
from graphkin.classroom.grading.graded import Answer, Status
from graphkin.classroom.grading.marking import Marker, is_near, is_right
from graphkin.classroom.grading.neighbours import RightValues, is_within, neighbours, standards_of
from graphkin.text import Words
from tests.chosen import EVERY
from tests.classroom.grading import own_labs
from tests.classroom.grading.classes import HONEST, named, written
from tests.classroom.grading.own_labs import DRAW, book_of, honest_class, marked, takers_of
from tests.classroom.grading.students import given, key_answers, lab_of, marker_of, taker

COUNT = 120 if EVERY else 40
CAREFUL = HONEST[0]
SLIPS = ("normal_missing", "normal_reversed", "driver_reversed", "rpm_as_rad", "angle_clockwise")


@pytest.mark.parametrize("name", DRAW)
def test_the_formulas_are_those_of_the_key(name):
    for each in takers_of(name, COUNT):
        key = book_of(name).marker(each.settings).standard.key
        for field, value in own_labs.drawn(name, each).items():
            if field.endswith("_sense"):
                assert value == key[field]
            else:
                assert abs(value) == pytest.approx(abs(key[field]), rel=1e-9)


@pytest.mark.parametrize("name", DRAW)
def test_of_what_careful_hands_draw_at_most_a_hundredth_is_not_right(name):
    """What follows from an own value is not right, either."""
    found = [marked(name, honest_class(name, CAREFUL, seed, COUNT)) for seed in range(4)]
    fields = sum(bool(mark.points) for r in found for each in r.graded for mark in each.marks)
    missed = [each for result in found for each in own_labs.not_right(result)]
    assert fields > 2500
    assert len(missed) <= 0.01 * fields, missed


@pytest.mark.parametrize("name", DRAW)
@pytest.mark.parametrize("kind", [HONEST[i] for i in (3, 9)], ids=lambda kind: kind.name)
def test_nobody_who_is_honest_is_named(name, kind):
    assert named(marked(name, honest_class(name, kind, 1, COUNT))) == []


@pytest.mark.parametrize("name", DRAW)
def test_what_a_misunderstanding_moves_far_is_right_for_no_one_in_a_thousand(name):
    """By more than twice what is allowed at most, in the same drawing without errors: those of the
    hand may bring a value back by chance."""
    rng, tried, right = np.random.default_rng(4), 0, []
    takers = takers_of(name, COUNT)
    for each in takers:
        for slip in SLIPS:
            marker = book_of(name).marker(each.settings)
            try:
                moved = own_labs.drawn(name, each, slips=[slip])
                row = own_labs.drawn(name, each, rng, (0.25, 0.25, 0.13, 0.5), [slip])
            except ValueError:
                continue
            answers = {field: written(field, value, 4) for field, value in row.items()}
            graded = marker.mark(each, answers)
            for field, allowed in marker.standard.tolerance.items():
                off = abs(abs(moved.get(field, 0.0)) - abs(marker.standard.key[field]))
                if field in moved and off > 2 * allowed.most:
                    tried += 1
                    if graded.mark(field).status is Status.RIGHT:
                        right.append((each.settings, slip, field))
    assert tried > 16 * len(takers)
    assert len(right) <= max(1, tried / 1000), right


@pytest.mark.parametrize("name", DRAW)
def test_another_s_careful_drawing_earns_in_the_mean_no_more_than_the_lab_allows(name):
    """From right values alone, of each on the next one's sheet; 99 of 100 below three fifths."""
    answers, everybody = honest_class(name, CAREFUL, 3, COUNT), takers_of(name, COUNT)
    shares = []
    for own, other in pairwise(everybody):
        graded = book_of(name).marker(own.settings).mark(own, answers[other.student.id])
        right = sum(mark.earned for mark in graded.marks if mark.status is Status.RIGHT)
        shares.append(float(right / graded.points))
    assert np.mean(shares) < 0.3
    assert np.quantile(shares, 0.99, method="lower") <= 0.6


# --- right by all of a sheet ---------------------------------------------------------------------


def moved(n: int, **times: float) -> tuple[Marker, dict[str, Answer]]:
    """The slotted lever's key, some of whose fields are so many tolerances larger."""
    marker = marker_of("slotted-lever", n)
    key, allowed = marker.standard.key, marker.standard.tolerance
    off = {field: abs(key[field]) + by * allowed[field].value for field, by in times.items()}
    return marker, {**key_answers(marker.standard), **given(off)}


def test_one_value_a_little_beyond_on_a_good_sheet_is_right_and_the_page_says_why():
    marker, answers = moved(12, omega_4=1.2)
    graded = marker.mark(taker(12), answers)
    assert not is_right(marker.standard, "omega_4", answers)
    mark = graded.mark("omega_4")
    assert mark.status is Status.RIGHT
    assert mark.is_together
    assert mark.earned == mark.points
    for language, word in (("en", "together"), ("ro", "împreună"), ("it", "insieme")):
        assert word in why(graded, mark, Words(language), is_kept_back=False)
    near = marker.mark(taker(12), moved(12, omega_4=0.9)[1]).mark("omega_4")
    assert not near.is_together


def test_a_value_that_its_own_segment_contradicts_is_not_right():
    """A speed is a segment times the scale: these two cannot lie so far apart in one drawing."""
    both, answers = moved(12, v_C=1.2, v_C_mm=1.2)
    found = both.mark(taker(12), answers)
    assert found.mark("v_C_mm").status is found.mark("v_C").status is Status.RIGHT
    for off in (
        {"v_C": 1.2},
        {"omega_4": 1.4},  # what one drawing in a hundred misses
        {"omega_4": 1.2, "a_C_mm": 6, "a_C": 6, "v_A3_mm": 4, "v_A3": 4},  # no drawing of the data
    ):
        marker, answers = moved(12, **off)
        first = next(iter(off))
        assert marker.mark(taker(12), answers).mark(first).status is not Status.RIGHT


def test_fields_that_lie_near_one_by_one_but_not_together_are_not_right():
    """All of another's velocities, each within what 99 of 100 drawings keep to."""
    marker, answers = moved(
        12, v_C_mm=1.2, v_C=1.2, v_A3_mm=-1.2, v_A3=-1.2, omega_3=-1.2, omega_4=1.2
    )
    beyond = ("v_C_mm", "v_A3_mm", "omega_3", "omega_4")
    assert all(is_near(marker.standard.expectation, f, answers[f]) for f in beyond)
    found = marker.mark(taker(12), answers)
    assert all(found.mark(field).status is not Status.RIGHT for field in beyond)


def test_what_another_s_key_earns_counts_what_is_right_by_all_of_a_sheet():
    """Cranks that differ by a few hundredths, against the marking of each."""
    lab = lab_of("slotted-lever")
    many = [({"n": Fraction(12), "r": Fraction(r)}, ()) for r in (100, 103, 105, 106, 107, 110)]
    found = standards_of(lab, many)
    told, own = neighbours(found), RightValues.of(found)
    alone = own.earned(own, is_within)
    more = 0
    for i, sheet in enumerate(found):
        for j, other in enumerate(found):
            if i != j:
                graded = Marker(sheet).mark(taker(12), key_answers(other))
                by_key = [m for m in graded.marks if m.status is Status.RIGHT and not m.source]
                right = {m.item.field for m in by_key}
                both = [m for m in by_key if m.item.sized in right]  # a sense with its size
                share = float(sum(m.earned for m in both) / graded.points)
                assert told.exact[i, j] == pytest.approx(share, abs=1e-12)
                more += told.exact[i, j] > alone[i, j] + 1e-9
    assert more
