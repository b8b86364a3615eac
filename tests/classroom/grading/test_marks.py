"""Follow-through, the guard against easy values, slips and their shares."""

from __future__ import annotations

from fractions import Fraction
from math import pi

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.form_relations import Own, OwnLengths
from graphkin.classroom.grading.graded import Answer, Status
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.standard import Standard, standard
from graphkin.classroom.lab.items import all_fields
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.mechanism import load
from tests.chosen import FOLDER
from tests.classroom.grading.students import LABS, given, key_answers, marker_of, marker_with, taker

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
        return found.told({step: factor * values[step]})

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
    assert marks["epsilon_4_sense"].status is Status.SLIP  # it would follow with its size only
    alone = marked(marker, epsilon_4=0.1 * right, epsilon_4_sense=-own["epsilon_4_sense"])
    assert alone["epsilon_4"].slip == "power_of_ten"
    against = marked(marker, epsilon_4=0.1 * right, epsilon_4_sense=own["epsilon_4_sense"])
    assert against["epsilon_4"].slip == ""


# --- slips --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LABS)
def test_each_slip_of_the_construction_is_named(name):
    """One sense alone tells of no driver."""
    marker = marker_of(name, 7)
    whole = [slip for slip in marker.slips if slip.whole and len(slip.values) > 1]
    assert len(whole) > 5
    for slip in whole:
        found = marked(marker, **slip.values)
        named = [m.slip for f, m in found.items() if f in slip.values and m.slip]
        alike = {s.name for s in whole if s.values.keys() == slip.values.keys()}
        assert named, slip.name
        assert max(set(named), key=named.count) in {slip.name, *alike}


@pytest.mark.parametrize(
    ("field", "name", "factor"),
    [
        ("v_D", "power_of_ten", 10.0),
        ("v_D", "power_of_ten", 0.01),
        ("v_D", "scale_missing", None),
        ("a_D", "wrong_scale", None),
        ("omega_3", "rate_in_turns", 9.549296585513721),
        ("omega_3", "rate_in_degrees", 57.29577951308232),
        ("omega_3", "length_not_scaled", 5.0),
        ("omega_3", "absolute_for_relative", None),
        ("epsilon_2", "normal_for_tangential", None),
        ("a_BA_nu", "swapped", None),
        ("a_BA_tau_mm", "swapped", None),
        ("I_3_y_mm", "opposite", -1.0),
    ],
)
def test_each_slip_of_a_field_is_named(field, name, factor):
    marker = marker_with("pump", (*MORE, "I_3_x_mm", "I_3_y_mm"))
    slip = next(s for s in marker.slips if s.name == name and field in s.values)
    value = slip.values[field] if factor is None else marker.standard.key[field] * factor
    assert marked(marker, **{field: value})[field].slip == name


def test_a_coordinate_of_the_other_axis_is_named():
    marker = marker_with("pump", ("J_3_x_mm", "J_3_y_mm"))
    for field, other in ("xy", "yx"):
        value = marker.standard.key[f"J_3_{other}_mm"]
        mark = marked(marker, **{f"J_3_{field}_mm": value})[f"J_3_{field}_mm"]
        assert (mark.status, mark.slip) == (Status.SLIP, "axes_swapped")


def test_rev_per_minute_taken_for_rad_per_second_cost_their_share_once():
    """What comes after names the field at which it was paid for."""
    marker = marker_with("pump", (), slips={"rpm_as_rad": 0.5})
    slip = next(s for s in marker.slips if s.name == "rpm_as_rad")
    found = marked(marker, **slip.values)
    shares = sorted(found[f].earned / found[f].points for f in slip.values if found[f].points)
    assert shares[0] == Fraction("0.5")
    assert set(shares[1:]) == {Fraction("0.8")}
    marks = [m for m in found.values() if m.status is Status.SLIP and m.item.what != "sense"]
    first, *others = marks
    assert (first.source, first.earned / first.points) == ("", Fraction("0.5"))
    assert {m.source for m in others} == {first.item.field}
    assert {m.earned / m.points for m in others} == {Fraction("0.8")}


def test_a_slip_is_paid_for_once_whatever_way_it_was_made():
    """Rev/min for rad/s where the plan keeps its scales: v grows with the ratio, a with its square,
    and what is turned round by a crank that turns the other way is paid for by the first sense.
    """
    marker = marker_of("slotted-lever", 7)
    key, ratio = marker.standard.key, 30 / pi
    values = [f for f in key if not f.endswith(("_mm", "_sense"))]
    powers = {f: 2 if f[0] in "ae" else 1 for f in values}
    found = marked(marker, **{f: key[f] * ratio ** powers[f] for f in values})
    shares = [found[f].earned / found[f].points for f in values]
    assert shares == [Fraction("0.5"), *[Fraction("0.8")] * (len(values) - 1)]
    slip = next(s for s in marker.slips if s.name == "driver_reversed")
    found = marked(marker, **slip.values)
    assert len(slip.values) == 3
    shares = [found[f].earned / found[f].points for f in key if f in slip.values]
    assert shares == [Fraction("0.5"), Fraction("0.8"), Fraction("0.8")]


@pytest.mark.parametrize("share", [0.5, None])
@pytest.mark.parametrize("free", [("a_A3_mm", "a_A3"), ("a_C_mm", "a_C", "a_A3_mm", "a_A3")])
def test_a_slip_is_paid_for_at_the_first_field_with_points(free, share):
    """Coriolis left out, and no points for accelerations from which others follow."""
    slips = {"coriolis_missing": share} if share else {}
    points = dict.fromkeys(free, Fraction())
    marker = marker_with("slotted-lever", (), points=points, slips=slips)
    slip = next(s for s in marker.slips if s.name == "coriolis_missing")
    found = marked(marker, **slip.values)
    assert {found[field].slip for field in free} == {slip.name}
    paid, *others = [m for f, m in found.items() if m.slip == slip.name and m.points]
    assert paid.earned / paid.points == Fraction(str(share or 0))
    if share:
        assert {m.earned / m.points for m in others} == {Fraction("0.8")}


def test_a_slip_without_a_share_earns_nothing():
    """However often it explains an answer; what follows from own values earns its share."""
    marker = marker_with("pump", (), slips={}, follow=0.8)
    slip = next(s for s in marker.slips if s.name == "rpm_as_rad")
    slipped = [m for m in marked(marker, **slip.values).values() if m.slip]
    assert len(slipped) > 3
    assert all(not m.earned for m in slipped if m.status is Status.SLIP)


def test_what_only_a_drawing_tells_after_a_slip_is_told_by_the_slip():
    """ω4 = v_CB/l hangs on v_A3 through the plan alone, whose lengths are right: rev/min it is.
    ω3 = v_A3/l is in the own numbers, and both are told of it.
    """
    marker = marker_of("slotted-lever", 7)
    key, ratio = marker.standard.key, 30 / pi
    rates = {f: key[f] * ratio for f in ("v_C", "v_A3", "omega_3", "omega_4", "v_slide_2")}
    found = marked(marker, **rates)
    told = found["omega_4"]
    assert (told.status, told.slip, told.source) == (Status.SLIP, "rpm_as_rad", "v_C")
    assert told.earned == found["omega_3"].earned == told.points * Fraction("0.8")
    assert (found["omega_3"].status, found["omega_3"].source) == (Status.FOLLOWS, "v_A3")
    assert found["omega_3"].slip == "rpm_as_rad"


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
        ("3.83 mm/s", Status.SLIP),
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
