"""What a neighbour's right values earn, against the marking of single answers and drawn samples."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.marking import is_right, with_senses
from graphkin.classroom.grading.neighbours import (
    RightValues,
    is_within,
    neighbours,
    points_of,
    standards_of,
    worst_drawn,
)
from graphkin.classroom.lab.lab_model import LabRule, Range, settings
from graphkin.classroom.lab.lab_trial import apart_lines
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants import assign, class_files
from graphkin.classroom.variants.assign import assigned
from graphkin.classroom.variants.class_files import class_lines
from graphkin.text.errors import RosterError
from tests.classroom.grading.students import LABS, lab_of

NUMBERS = (3, 7, 8, 12, 21)


@pytest.fixture(scope="module", params=LABS)
def found(request):
    lab = lab_of(request.param)
    many = [({"n": Fraction(n)}, ()) for n in NUMBERS]
    return standards_of(lab, many)


def test_a_key_earns_on_another_sheet_what_its_marking_says(found):
    """Each field's answer is written down, and marked by itself."""
    told = neighbours([*found, found[0]])
    assert told.exact[0, len(found)] == pytest.approx(1)  # the same data earn everything
    assert told.closest() == [(0, len(found))]
    names = "abcdefg"
    twice = neighbours([*found, found[0], found[1]])
    assert twice.closest() == [(0, len(found)), (1, len(found) + 1)]
    assert apart_lines(twice, names, "id")[-1].endswith(
        "on the sheet of a; likewise g's on that of b"
    )
    for i, own in enumerate(found):
        total = sum(points_of(own, field) for field in own.key)
        for j, other in enumerate(found):
            if i == j:
                assert np.isnan(told.exact[i, j])
                continue
            written = {f: Answer(repr(v), v, signed=v < 0) for f, v in other.key.items()}
            given = with_senses(own, written)
            right = {f for f in own.key if is_right(own, f, given)}
            sized = {f: own.by_field[f].item.sized for f in right}
            right = {f for f in right if sized[f] in right or not points_of(own, sized[f])}
            earned = sum(points_of(own, f) for f in right)
            assert told.exact[i, j] == pytest.approx(earned / total, abs=1e-12)


def test_a_drawing_earns_in_the_mean_what_samples_of_it_earn(found):
    chance = np.random.default_rng(7)
    told, own = neighbours(found), RightValues.of(found)
    samples = 20_000
    for i, j in ((0, 1), (2, 1), (4, 3)):
        errors = chance.normal(size=(samples, own.keys.sizes.shape[1])) * own.keys.deviations[j]
        right = abs(own.keys.sizes[j] + np.nan_to_num(errors) - own.keys.sizes[i]) <= own.allowed[i]
        senses = (own.senses[i] == own.senses[j]) | own.unclear[i]
        with_size = senses & (right | (own.points[i] == 0))[:, own.sized]
        mean = ((right @ own.points[i]) + (with_size @ own.sense_points[i])).mean()
        assert told.drawn[i, j] == pytest.approx(mean, abs=0.01)


def drawing_lab(apart: float | None, tries: int = 200):
    """The slotted lever with numbers drawn from its range."""
    rule = LabRule("mechanics", {"n": Range(Fraction(1), Fraction(30), Fraction(1))}, tries)
    lab = lab_of("slotted-lever")
    return replace(lab, rule=rule, fair=replace(lab.fair, apart=apart))


STUDENTS = [Student(i, f"s{i}", i) for i in range(1, 9)]


def closest(lab, every) -> float:
    """The most that right values of one earn on another's sheet."""
    told = neighbours(standards_of(lab, [(e.settings, e.computed) for e in every]))
    return float(np.nanmax(told.exact))


def test_who_would_be_too_near_is_drawn_again():
    free, held = (assigned(drawing_lab(apart), STUDENTS) for apart in (None, 0.5))
    assert closest(drawing_lab(None), free) > 0.5
    assert all(each.fair for each in held)
    assert closest(drawing_lab(None), held) <= 0.5
    assert held[0].settings == free[0].settings
    lab = drawing_lab(0.5)
    assert all(each.settings == settings(lab, each.student, each.attempt) for each in held)
    assert [each.settings for each in assigned(lab, STUDENTS)] == [each.settings for each in held]


def test_where_there_is_no_room_the_last_fair_data_stay_and_the_fault_is_told():
    lab = drawing_lab(0.0, tries=3)
    found = assigned(lab, STUDENTS)
    near = [each for each in found if not each.fair]
    assert len(near) > len(found) / 2 and near[0] != found[0]
    assert all(fault.limit == "apart" for each in near for fault in each.faults)
    assert "of the points, at most 0 %" in str(near[0].faults[0])


def test_a_formula_draws_nothing_again_and_says_who_is_near():
    lab = lab_of("pump")
    assert not lab.rule.draws
    lab = replace(lab, fair=replace(lab.fair, apart=0.5))
    found = assigned(lab, STUDENTS)
    assert [each.settings["n"] for each in found] == list(range(1, 9))
    near = [each for each in found if not each.fair]
    assert near
    assert {fault.where for each in near for fault in each.faults} <= {s.id for s in STUDENTS}


def test_the_least_exact_field_is_that_of_the_largest_error(found):
    """By the keys and tolerances of the report, as a lecturer would reckon it."""
    told = neighbours(found)
    for own, error in zip(found, told.pencil, strict=True):
        asked = [f for f, points in own.rubric.points.items() if points and f in own.tolerance]
        sized = [
            f
            for f in asked
            if own.by_field[f].item.what != "place" and own.key[f] and f not in own.computed
        ]
        errors = {f: own.tolerance[f].pencil / abs(own.key[f]) for f in sized}
        assert error == pytest.approx(max(errors.values()))
        assert worst_drawn(own)[0] in errors


def test_who_would_draw_too_inexactly_is_drawn_again():
    lab = drawing_lab(None)
    told = neighbours(standards_of(lab, asked(assigned(lab, STUDENTS))))
    limit = float(np.median(told.pencil))
    found = assigned(replace(lab, fair=replace(lab.fair, pencil=limit)), STUDENTS)
    assert all(each.fair for each in found)
    told = neighbours(standards_of(lab, asked(found)))
    assert told.pencil.max() <= limit
    # exactly known values are right up to what is allowed
    assert list(is_within(np.array([-2.0, 1.9, 2.1]), np.array(2.0), None)) == [True, True, False]


def asked(every):
    """Data with the fields that are computed."""
    return [(each.settings, each.computed) for each in every]


def test_blocks_of_a_list_give_what_the_whole_list_gives(monkeypatch):
    """And none of them holds more than its own students against the others."""
    many = [Student(i, f"s{i}", i) for i in range(1, 25)]
    lab = replace(drawing_lab(0.6, tries=4), rule=wide_rule())
    whole = assigned(lab, many)
    sizes = []
    earned = RightValues.earned

    def noted(own, other, chance):
        sizes.append(min(len(own.points), len(other.points)))
        return earned(own, other, chance)

    monkeypatch.setattr(RightValues, "earned", noted)
    monkeypatch.setattr(assign, "BLOCK", 5)
    assert assigned(lab, many) == whole
    assert {each.fair for each in whole} == {True, False}
    assert max(sizes) <= 5


def wide_rule() -> LabRule:
    """Many different data."""
    drawn = {
        "n": Range(Fraction(3), Fraction(30), Fraction(1)),
        "r": Range(Fraction(84), Fraction(138), Fraction(1)),
    }
    return LabRule("mechanics", drawn, 4)


def test_students_of_the_same_data_are_compared_like_others(found):
    """What is the same is worked out once."""
    twice = [*found, *found]
    apart = [replace(each) for each in twice]
    told, expected = neighbours(twice), neighbours(apart)
    for name in ("exact", "drawn", "pencil"):
        np.testing.assert_array_equal(getattr(told, name), getattr(expected, name))


def test_the_same_data_have_one_standard(found):
    lab = lab_of("pump")
    own = standards_of(lab, [({"n": Fraction(n)}, ()) for n in (7, 8, 7)])
    assert own[0] is own[2]
    assert own[0] is not own[1]


@pytest.mark.parametrize("limits", [{"apart": 0.5}, {"pencil": 0.5}])
def test_a_list_that_is_too_long_to_be_kept_apart_is_refused(limits, monkeypatch):
    monkeypatch.setattr(assign, "MOST", 7)
    lab = drawing_lab(None)
    with pytest.raises(RosterError, match=r"class\.csv: has 8 students.*at most 7; split the list"):
        assigned(replace(lab, fair=replace(lab.fair, **limits)), STUDENTS, "class.csv")
    assert len(assigned(lab, STUDENTS)) == 8


def test_of_a_long_list_a_part_is_compared_and_that_is_said(monkeypatch):
    lab = lab_of("pump")
    found = assigned(lab, STUDENTS)
    assert not [line for line in class_lines(lab, found) if line.startswith("compared")]
    monkeypatch.setattr(class_files, "COMPARED", 4)
    told = list(class_lines(lab, found))
    (said,) = [line for line in told if line.startswith("compared")]
    assert said.endswith("4 of 8 students, evenly spaced in the list")
    assert not [line for line in told if "s2's right values" in line]
