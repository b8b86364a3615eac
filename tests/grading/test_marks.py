"""Follow-through, the guard against easy values, slips and their shares."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import isnan, pi

import pytest

from graphkin.grading.marking import Marker
from graphkin.grading.model import Answer, Status
from graphkin.grading.numbers import read_answer
from graphkin.grading.rows import SLIPS
from graphkin.grading.standard import Standard, standard
from graphkin.lab.items import items
from graphkin.lab.model import Lab, Rubric
from graphkin.lab.slip_names import NAMES
from graphkin.text import LANGUAGES, words
from tests.grading.students import LABS, book_of, given, key_answers, lab_of, marker_of, taker

MORE = ("v_BA_mm", "v_BA", "a_BA_nu_mm", "a_BA_nu", "a_BA_tau_mm", "a_BA_tau")


def marker_with(name: str, fields: tuple[str, ...], n: int = 7, **changes: object) -> Marker:
    """A marker of a shipped lab whose rubric asks for more fields."""
    lab = lab_of(name)
    points = {**lab.rubric.points, **dict.fromkeys(fields, Fraction(2))}
    rubric = replace(lab.rubric, points=points, **changes)
    wider: Lab = replace(lab, rubric=rubric)
    mechanism = book_of(name).mechanism({"n": str(n)})
    return Marker(standard(mechanism, items(mechanism, wider), rubric))


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


def test_nothing_follows_into_a_value_that_is_nearly_nought():
    """A quarter of the velocity leaves a sixteenth of the normal component: too easy."""
    marker = marker_with("pump", MORE)
    own = 0.25 * marker.standard.key["v_BA_mm"]
    speed = own * kv(marker.standard)
    found = marked(marker, v_BA_mm=own, a_BA_nu=speed**2 / 0.4, omega_3=speed / 0.4)
    assert found["a_BA_nu"].earned == 0
    assert found["omega_3"].status is Status.FOLLOWS


def test_without_a_share_nothing_follows():
    marker = marker_with("pump", (), follow=0.0)
    own = 1.4 * marker.standard.key["v_D_mm"]
    found = marked(marker, v_D_mm=own, v_D=own * kv(marker.standard))
    assert found["v_D"].earned == 0


def test_what_is_right_by_the_key_is_right_whatever_came_before():
    marker = marker_of("pump", 7)
    found = marked(marker, v_D_mm=1.4 * marker.standard.key["v_D_mm"])
    assert found["v_D"].status is Status.RIGHT


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


def test_a_reversed_sense_is_named():
    marker = marker_of("pump", 7)
    found = marked(marker, omega_3_sense=-marker.standard.key["omega_3_sense"])
    assert found["omega_3_sense"].slip == "sense_reversed"
    assert found["omega_3_sense"].earned == 0


def test_rev_per_minute_taken_for_rad_per_second_cost_their_share_once():
    marker = marker_with("pump", (), slips={"rpm_as_rad": 0.5})
    slip = next(s for s in marker.slips if s.name == "rpm_as_rad")
    found = marked(marker, **slip.values)
    shares = [found[f].earned / found[f].points for f in slip.values if found[f].points]
    assert sorted(shares)[0] == Fraction("0.5")
    assert set(sorted(shares)[1:]) == {Fraction("0.8")}


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


def test_a_crank_that_is_reckoned_too_fast_leaves_the_drawing_as_it_is():
    """kv = ω·kL and ka = ω²·kL: segments stay, velocities grow with ω, accelerations with ω²."""
    marker = marker_of("pump", 7)
    slip, key = next(s for s in marker.slips if s.name == "rpm_as_rad"), marker.standard.key
    assert not [field for field in slip.values if field.endswith("_mm")]
    assert slip.values["v_D"] / key["v_D"] == pytest.approx(30 / pi)
    assert slip.values["epsilon_2"] / key["epsilon_2"] == pytest.approx((30 / pi) ** 2)


def test_coriolis_missing_and_turned_round_are_told_apart():
    """Slotted lever: the construction is run again without, and with the component turned."""
    marker = marker_of("slotted-lever", 7)
    for name in ("coriolis_missing", "coriolis_reversed"):
        slip = next(s for s in marker.slips if s.name == name)
        named = {m.slip for f, m in marked(marker, **slip.values).items() if f in slip.values}
        assert name in named
        assert not named & ({"coriolis_missing", "coriolis_reversed"} - {name})


def test_an_answer_that_no_slip_explains_has_no_name():
    marker = marker_of("pump", 7)
    found = marked(marker, omega_3=marker.standard.key["omega_3"] * 1.37)
    assert found["omega_3"].status is Status.WRONG
    assert found["omega_3"].slip == ""


def test_random_wrong_answers_are_seldom_named():
    """Chance: of wrong answers spread over two decades few may be taken for a slip."""
    marker = marker_of("pump", 7)
    field, right = "omega_3", marker.standard.key["omega_3"]
    values = [right * 10 ** (-1 + 2 * (i + 0.5) / 400) for i in range(400)]
    named = sum(bool(marked(marker, **{field: value})[field].slip) for value in values)
    assert named / len(values) < 0.35


def test_every_slip_has_a_sentence_in_every_language():
    assert set(SLIPS) == set(NAMES)
    for language in LANGUAGES:
        assert all(words(language).has(key) for key in SLIPS.values())


def test_a_rubric_may_leave_everything_at_its_default():
    assert Rubric().follow == 0.8
