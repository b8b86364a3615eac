"""Follow-through, the guard against easy values, slips and their shares."""

from __future__ import annotations

from fractions import Fraction
from math import isnan, pi

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.graded import Answer, Status
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.standard import Standard
from tests.classroom.grading.students import LABS, given, key_answers, marker_of, marker_with, taker

MORE = ("v_BA_mm", "v_BA", "a_BA_nu_mm", "a_BA_nu", "a_BA_tau_mm", "a_BA_tau")


def marked(marker: Marker, **changes: float) -> dict[str, object]:
    """The marks by field when the key is handed in with some answers changed."""
    answers = {**key_answers(marker.standard), **given(changes)}
    return {mark.item.field: mark for mark in marker.mark(taker(), answers).marks}


def kv(found: Standard) -> float:
    """Velocity of a millimetre of the plan."""
    return found.paper.velocities / 1000


def test_a_value_follows_from_the_own_segment_times_the_scale():
    marker = marker_of("pump", 7)
    own = 1.4 * marker.standard.key["v_D_mm"]
    found = marked(marker, v_D_mm=own, v_D=own * kv(marker.standard))
    assert found["v_D_mm"].earned == 0
    assert found["v_D"].status is Status.FOLLOWS
    assert found["v_D"].source == "v_D_mm"
    assert found["v_D"].earned == found["v_D"].points * Fraction("0.8")


def test_a_rate_follows_from_the_own_relative_velocity_over_the_bar():
    """The plate AB of the pump is 0.4 m long."""
    marker = marker_with("pump", MORE)
    own = 1.3 * marker.standard.key["v_BA_mm"]
    speed = own * kv(marker.standard)
    found = marked(marker, v_BA_mm=own, v_BA=speed, omega_3=speed / 0.4, a_BA_nu=speed**2 / 0.4)
    for field in ("v_BA", "omega_3", "a_BA_nu"):
        assert found[field].status is Status.FOLLOWS, field
        assert found[field].source.startswith("v_BA")


def test_the_construction_is_run_again_from_the_own_velocity():
    """B is off: everything after it is drawn rightly from the student's own b."""
    marker = marker_with("pump", ("v_B_mm", "v_B"), n=12)
    found = marker.standard
    step = found.by_field["v_B_mm"].step
    told = found.told({step: 1.6 * found.exact.trace.values[step]})
    marks = marked(marker, **{f: v for f, v in told.items() if not isnan(v)})
    assert marks["v_B_mm"].earned == 0
    lost = [m for m in marks.values() if m.status is Status.WRONG and m.item.what != "sense"]
    assert [m.item.field for m in lost] in ([], ["v_B_mm"])
    assert sum(m.status is Status.FOLLOWS for m in marks.values()) >= 3


def test_nothing_follows_from_a_value_that_is_nearly_nought():
    """Numbas #368: a wrong start must not make later work trivial and earn its marks."""
    marker = marker_with("pump", MORE)
    own = 0.02 * marker.standard.key["v_BA_mm"]
    speed = own * kv(marker.standard)
    found = marked(marker, v_BA_mm=own, v_BA=speed, omega_3=speed / 0.4, a_BA_nu=speed**2 / 0.4)
    assert {found[f].earned for f in ("v_BA_mm", "v_BA", "omega_3", "a_BA_nu")} == {0}


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


def test_without_a_share_nothing_follows():
    marker = marker_with("pump", (), follow=0.0)
    own = 1.4 * marker.standard.key["v_D_mm"]
    found = marked(marker, v_D_mm=own, v_D=own * kv(marker.standard))
    assert found["v_D"].earned == 0


def test_blank_and_unreadable_are_not_wrong_and_earn_nothing():
    marker = marker_of("pump", 7)
    answers = key_answers(marker.standard)
    item = marker.standard.by_field["v_D"].item
    answers |= {"v_D_mm": Answer(""), "v_D": read_answer("3,8,2", item)}
    found = {mark.item.field: mark for mark in marker.mark(taker(), answers).marks}
    assert found["v_D_mm"].status is Status.BLANK
    assert found["v_D"].status is Status.UNREADABLE
    assert found["v_D_mm"].earned == found["v_D"].earned == 0


def test_a_sign_tells_the_sense_that_was_left_blank():
    marker = marker_of("pump", 7)
    answers = key_answers(marker.standard)
    value = marker.standard.key["omega_4"]
    assert value < 0
    answers["omega_4"] = Answer(f"{value}", value, signed=True)
    answers["omega_4_sense"] = Answer("")
    found = {mark.item.field: mark for mark in marker.mark(taker(), answers).marks}
    assert found["omega_4_sense"].status is Status.RIGHT


def test_points_of_a_segment_too_short_to_be_measured_go_to_the_value():
    marker = marker_of("pump", 25)
    answers = key_answers(marker.standard)
    answers["a_D_mm"] = Answer("")
    computing = replace(taker(25), compute=("a_D_mm", "a_D"))
    graded = marker.mark(computing, answers)
    assert graded.earned == graded.points == sum(marker.standard.rubric.points.values())
    assert graded.mark("a_D_mm").points == 0


def test_a_rate_follows_rightly_from_a_right_velocity_at_the_edge_of_its_tolerance():
    """ω = v/l with the own v, which is right, over a bar that was measured half a percent short."""
    marker = marker_of("slotted-lever", 7)
    found = marker.standard
    speed = found.key["v_A3"] + 0.98 * found.tolerance["v_A3"].value
    own = speed * found.key["omega_3"] / found.key["v_A3"] / 0.995
    assert own > found.key["omega_3"] + found.tolerance["omega_3"].value
    mark = marked(marker, v_A3=speed, omega_3=own)["omega_3"]
    assert (mark.status, mark.source) == (Status.RIGHT, "v_A3")
    assert mark.earned == mark.points
    alone = marked(marker, omega_3=own)["omega_3"]
    assert alone.earned == 0


CORIOLIS = ("a_AA3_cor_mm", "a_AA3_cor")


@pytest.mark.parametrize(("omega", "speed"), [(1.4, 1.0), (1.0, 0.7), (1.4, 0.8)])
@pytest.mark.parametrize("field", ["v_slide_2", "v_AA3"])
def test_the_coriolis_component_follows_from_own_values(field, omega, speed):
    """a = 2·ω·v of the own ω and the own v, as it is computed and as it is laid off."""
    marker = marker_with("slotted-lever", ("v_AA3", *CORIOLIS))
    found = marker.standard
    own = 2 * omega * abs(found.key["omega_3"]) * speed * found.key["v_slide_2"]
    values = {"omega_3": omega * found.key["omega_3"], field: speed * found.key["v_slide_2"]}
    length = 1000 * own / found.paper.accelerations
    marks = marked(marker, **values, a_AA3_cor=own, a_AA3_cor_mm=length)
    for name in CORIOLIS:
        assert marks[name].status is Status.FOLLOWS, name
        assert marks[name].source in (*values, "a_AA3_cor_mm")
    wrong = marked(marker, **values, a_AA3_cor=2 * own)
    assert wrong["a_AA3_cor"].earned == 0


def test_what_is_drawn_with_an_own_coriolis_component_follows():
    """A block's speed that was misread by a third: the lever's acceleration is right for it."""
    marker = marker_of("slotted-lever", 7)
    found = marker.standard
    values = found.exact.trace.values
    program = found.mechanism.program
    step = next(n for n, s in enumerate(program.steps) if s.action and s.action.key == "coriolis")
    told = found.told({step: 1.5 * values[step]})
    own = {"v_slide_2": 1.5 * found.key["v_slide_2"]}
    marks = marked(marker, **{f: v for f, v in told.items() if f[0] in "ae"}, **own)
    lost = {f for f, mark in marks.items() if mark.status in (Status.WRONG, Status.SLIP)}
    assert lost == {"v_slide_2"}
    assert marks["a_A3_mm"].source == "v_slide_2"


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
    alone = marked(marker, epsilon_4=0.1 * right, epsilon_4_sense=-own["epsilon_4_sense"])
    assert alone["epsilon_4"].slip == "power_of_ten"
    against = marked(marker, epsilon_4=0.1 * right, epsilon_4_sense=own["epsilon_4_sense"])
    assert against["epsilon_4"].slip == ""


# --- slips --------------------------------------------------------------------------------------


def whole_slips() -> list[tuple[str, int]]:
    """Each shipped lab with the number of its slips of the construction."""
    return [(name, i) for name in LABS for i in range(len(all_whole(name)))]


def all_whole(name: str) -> list[object]:
    """The slips of the construction of a lab's variant 7; one sense alone tells of no driver."""
    return [slip for slip in marker_of(name, 7).slips if slip.whole and len(slip.values) > 1]


@pytest.mark.parametrize(("name", "index"), whole_slips())
def test_each_slip_of_the_construction_is_named(name, index):
    marker, slip = marker_of(name, 7), all_whole(name)[index]
    found = marked(marker, **slip.values)
    named = [m.slip for f, m in found.items() if f in slip.values and m.slip]
    alike = {s.name for s in all_whole(name) if s.values.keys() == slip.values.keys()}
    assert named, slip.name
    best = max(set(named), key=named.count)
    assert best == slip.name or best in alike


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


@pytest.mark.parametrize(("field", "other"), ["xy", "yx"])
def test_a_coordinate_of_the_other_axis_is_named(field, other):
    marker = marker_with("pump", ("J_3_x_mm", "J_3_y_mm"))
    value = marker.standard.key[f"J_3_{other}_mm"]
    mark = marked(marker, **{f"J_3_{field}_mm": value})[f"J_3_{field}_mm"]
    assert (mark.status, mark.slip) == (Status.SLIP, "axes_swapped")


def test_rev_per_minute_taken_for_rad_per_second_cost_their_share_once():
    marker = marker_with("pump", (), slips={"rpm_as_rad": 0.5})
    slip = next(s for s in marker.slips if s.name == "rpm_as_rad")
    found = marked(marker, **slip.values)
    shares = [found[f].earned / found[f].points for f in slip.values if found[f].points]
    assert sorted(shares)[0] == Fraction("0.5")
    assert set(sorted(shares)[1:]) == {Fraction("0.8")}


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


def test_what_comes_after_a_slip_names_the_field_at_which_it_was_paid_for():
    marker = marker_with("pump", (), slips={"rpm_as_rad": 0.5})
    slip = next(s for s in marker.slips if s.name == "rpm_as_rad")
    marks = [m for m in marked(marker, **slip.values).values() if m.status is Status.SLIP]
    numbers = [m for m in marks if m.item.what != "sense"]
    first, *others = numbers
    assert (first.source, first.earned / first.points) == ("", Fraction("0.5"))
    assert others
    assert {m.source for m in others} == {first.item.field}
    assert {m.earned / m.points for m in others} == {Fraction("0.8")}
