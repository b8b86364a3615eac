"""Follow-through, the guard against easy values, slips and their shares."""

from __future__ import annotations

from fractions import Fraction

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.class_marking import unfollowed
from graphkin.classroom.grading.follow_through import Own, OwnLengths
from graphkin.classroom.grading.graded import Answer, Status
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.standard import Standard, standard
from graphkin.classroom.lab.items import all_fields
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.mechanism import load
from tests.chosen import FOLDER
from tests.classroom.grading.students import given, key_answers, marker_of, marker_with, taker

MORE = ("v_BA_mm", "v_BA", "a_BA_nu_mm", "a_BA_nu", "a_BA_tau_mm", "a_BA_tau")


def marked(marker: Marker, **changes: float) -> dict[str, object]:
    """The marks by field when the key is handed in with some answers changed."""
    answers = {**key_answers(marker.standard), **given(changes)}
    return {mark.item.field: mark for mark in marker.mark(taker(), answers).marks}


def kv(found: Standard) -> float:
    """Velocity of a millimetre of the plan."""
    return found.paper.velocities / 1000


def test_what_follows_on_the_drawing_earns_follow_though_no_number_tells_it():
    """A crank laid off in a wrong direction is in no field of the form: only the drawing has it."""
    marker = marker_of("pump", 7)
    far = Answer("82.5", 82.5)
    found = {}
    for followed in (False, True):
        own = {"v_D_mm": replace(far, followed=followed)}
        (found[followed],) = [
            mark
            for mark in marker.mark(taker(), {**key_answers(marker.standard), **own}).marks
            if mark.item.field == "v_D_mm"
        ]
    assert found[False].status is Status.WRONG
    assert found[False].earned == 0
    assert found[True].status is Status.FOLLOWS
    assert found[True].source == ""
    assert found[True].earned == found[True].points * Fraction("0.8")
    right = {field: replace(answer, followed=True) for field, answer in
             key_answers(marker.standard).items()}  # fmt: skip
    assert {mark.status for mark in marker.mark(taker(), right).marks} == {Status.RIGHT}
    strict = marker_with("pump", (), follow=0.0)
    marks = strict.mark(taker(), {**key_answers(strict.standard), "v_D_mm": own["v_D_mm"]}).marks
    assert next(mark for mark in marks if mark.item.field == "v_D_mm").earned == 0
    own = 1.4 * strict.standard.key["v_D_mm"]
    assert marked(strict, v_D_mm=own, v_D=own * kv(strict.standard))["v_D"].earned == 0


def test_points_of_a_segment_too_short_to_be_measured_go_to_the_value():
    marker = marker_of("pump", 25)
    answers = key_answers(marker.standard)
    answers["a_D_mm"] = Answer("")
    computing = replace(taker(25), compute=("a_D_mm", "a_D"))
    graded = marker.mark(computing, answers)
    assert graded.earned == graded.points == sum(marker.standard.rubric.points.values())
    assert graded.mark("a_D_mm").points == 0


def test_what_turns_the_other_way_from_own_values_is_no_power_of_ten():
    """An own acceleration from which ε comes out a tenth of its size, the other way."""
    marker = marker_of("pump", 12)
    found = marker.standard
    step, values = found.by_field["a_D_mm"].step, found.exact.trace.values

    def told(factor: float) -> dict[str, float]:
        return found.reread({step: factor * values[step]})

    right, other = found.key["epsilon_4"], told(1.1)["epsilon_4"]
    factor = 1 + 0.1 * (-1.098 * right) / (other - right)
    own = told(factor)
    assert own["epsilon_4"] / right == pytest.approx(-0.098)
    fields = ("a_D_mm", "a_D", "epsilon_4", "epsilon_4_sense")
    marks = marked(marker, **{field: own[field] for field in fields})
    for name in fields[1:]:
        assert marks[name].status is Status.FOLLOWS, name
    given_up = {field: own[field] for field in fields} | {"epsilon_4": 3 * right}
    marks = marked(marker, **given_up)
    assert marks["epsilon_4"].status is not Status.FOLLOWS
    assert marks["epsilon_4_sense"].status is not Status.FOLLOWS  # only with its size


# --- slips --------------------------------------------------------------------------------------


ROLLING = {
    "wheel-in-ring": ("omega_1", "a_TP_nu", 0.05 * 0.15 / (0.15 - 0.05)),
    "rod-and-wheel": ("omega_3", "a_TC_nu", 0.06),
    "bar-on-drive-roller": ("omega_1", "a_TO_nu", None),
}
"""Wheels with the rate, the component and the length by which its square is multiplied: r·R/(R - r)
in a ring (Euler, Savary), r on a rail; none where what is rolled on turns, too."""


@pytest.mark.parametrize("scene", ROLLING)
def test_the_component_of_a_wheel_follows_from_an_own_rate(scene):
    rate, field, length = ROLLING[scene]
    mechanism = load(FOLDER / f"{scene}.toml")
    form = all_fields(mechanism)
    asked = [form[name] for name in (rate, f"{rate}_sense", field)]
    points = dict.fromkeys((rate, field), Fraction(1))
    found = standard(mechanism, asked, Rubric(points=points, follow=0.8))
    own = 1.2 * abs(found.key[rate])
    told = [*OwnLengths(found, {rate: Own(own, 0.0, rate)}).computed(field, 0.0)]
    if length is None:
        assert told == []
        return
    (only,) = told
    assert only.sources == (rate,)
    assert only.value == pytest.approx(own**2 * length)
    marks = marked(Marker(found), **{rate: own, field: own**2 * length})
    assert (marks[field].status, marks[field].source) == (Status.FOLLOWS, rate)
    assert marks[field].earned == Fraction("0.8")


@pytest.mark.parametrize(
    ("cell", "status"),
    [
        ("3.827 mm/s", Status.UNREADABLE),
        ("-3,827 mm/s", Status.UNREADABLE),
        ("3.827", Status.RIGHT),
        ("3827 mm/s", Status.RIGHT),
        ("3.83 mm/s", Status.CAUSE),
        ("9.827 m/s", Status.WRONG),
        ("9.827 mm/s", Status.UNREADABLE),
        ("30.827 mm/s", Status.WRONG),
    ],
)
def test_a_point_that_may_part_thousands_is_asked_where_only_that_is_near_the_key(cell, status):
    marker = marker_of("pump", 7)
    item = marker.standard.by_field["v_D"].item
    answers = key_answers(marker.standard) | {"v_D": read_answer(cell, item)}
    found = marker.mark(taker(7), answers).mark("v_D")
    assert found.status is status
    assert (found.answer.problem == "thousands") == (status is Status.UNREADABLE)


@pytest.mark.parametrize(
    ("digits", "cell", "share", "rounded"),
    [
        (None, "473", 1, ""),
        (None, "400", Fraction("0.8"), "few"),
        (None, "420", 0, ""),
        ((3, 4), "470", 1, ""),
        ((3, 4), "4.7e2", Fraction("0.8"), "few"),
        ((3, 4), "473.00", Fraction("0.8"), "many"),
    ],
)
def test_significant_digits_are_a_part_of_the_rubric(digits, cell, share, rounded):
    """The piston of the pump at number 7: 473 m/s²; 400 may mean all up to 450, 420 up to 425."""
    marker = marker_with("pump", (), digits=digits)
    item = marker.standard.by_field["a_D"].item
    answers = key_answers(marker.standard) | {"a_D": read_answer(cell, item)}
    for field in ("v_D", "omega_2", "omega_3", "omega_4", "epsilon_2", "epsilon_3", "epsilon_4"):
        answers[field] = read_answer(f"{abs(marker.standard.key[field]):.4g}", item)
    found = marker.mark(taker(7), answers).mark("a_D")
    assert (found.earned, found.rounded) == (share * found.points, rounded)


def test_two_cells_of_one_row_exchanged_are_named():
    marker = marker_of("pump", 7)
    key = key_answers(marker.standard)
    swapped = key | {"v_D": key["v_D_mm"], "v_D_mm": key["v_D"]}
    assert [cause.name for cause in marker.mark(taker(7), swapped).causes] == ["answers_exchanged"]


def test_a_sense_beside_a_value_that_no_longer_follows_earns_nothing():
    """Values that fit another's data do not follow, and their senses are right by chance."""
    marker = marker_of("pump", 7)
    (graded,) = [marker.mark(taker(7), key_answers(marker.standard))]
    follows = replace(graded.mark("omega_3"), status=Status.FOLLOWS, source="v_D")
    marks = tuple(follows if m.item.field == "omega_3" else m for m in graded.marks)
    found = unfollowed(replace(graded, marks=marks), ("omega_3",))
    assert [found.mark(f).earned for f in ("omega_3", "omega_3_sense")] == [0, 0]
    assert found.mark("omega_3_sense").alone
    assert found.mark("omega_2_sense").earned
