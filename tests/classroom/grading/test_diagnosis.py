"""Slips named alike in every field that they touch, and seldom where chance alone is at work."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import exp, log, pi

import numpy as np
import pytest

from graphkin import load
from graphkin.classroom.grading.graded import Answer, EarnedMark, Status
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.slip_diagnosis import (
    RARER,
    SHARE,
    by_chance,
    hit_density,
    hit_ratio,
    judged,
    share,
)
from graphkin.classroom.grading.slips import Slip, constructions
from graphkin.classroom.grading.standard import Standard, standard
from graphkin.classroom.lab.items import asked_fields
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.chosen import FOLDER
from tests.classroom.grading.students import LABS, drawn, given, marker_of, row, taker

RPM = 30 / pi
PENCIL = 0.3
VARIANTS = (3, 24)


def right_set(name: str, n: int) -> dict[str, Answer]:
    """The first answers of a careful drawing that are all right."""
    tried = (handed_in(name, n, seed) for seed in range(1, 50))
    return next(each for each in tried if is_all_right(marker_of(name, n), each))


def is_all_right(marker: Marker, answers: Mapping[str, Answer]) -> bool:
    """Whether every value is right by the key, by some way."""
    graded = marker.mark(taker(), answers)
    marks = [graded.mark(field) for field in values(marker.standard)]
    return all(abs(m.off or 0.0) <= 0.8 * m.tolerance for m in marks)


def handed_in(name: str, n: int, seed: int = 1) -> dict[str, Answer]:
    """The answers of one careful drawing; values reckoned from the segments that were measured."""
    standard = marker_of(name, n).standard
    answers = row(drawn(standard, PENCIL, 1, seed), 0)
    for field in values(standard):
        answers |= given({field: three(own_value(standard, field, answers))})
    return answers


def three(value: float) -> float:
    """A number to three digits."""
    return float(f"{value:.3g}")


def values(standard: Standard, vectors: bool = False) -> list[str]:
    """The fields that are values which the drawing tells; of vectors with a segment only."""
    fields = [probe.item.field for probe in standard.layout.probes if probe.item.what == "value"]
    fields = [field for field in fields if not standard.tolerance[field].unsure]
    return [field for field in fields if not vectors or f"{field}_mm" in standard.key]


def own_value(standard: Standard, field: str, answers: Mapping[str, Answer]) -> float:
    """A value from the own segment where there is one."""
    if f"{field}_mm" not in answers:
        return float(answers[field].value or 0.0)
    plane = standard.by_field[field].plane
    return float(answers[f"{field}_mm"].value or 0.0) * standard.paper.millimetre(plane)


def off_by(
    standard: Standard,
    answers: Mapping[str, Answer],
    fields: Sequence[str],
    velocities: float,
    accelerations: float,
) -> dict[str, Answer]:
    """The answers with some values as many times too large."""
    changed = {}
    for field in fields:
        fast = standard.by_field[field].item.unit in ("m/s", "rad/s")
        own = own_value(standard, field, answers)
        changed[field] = three(own * (velocities if fast else accelerations))
    return {**answers, **given(changed)}


def names(marker: Marker, answers: Mapping[str, Answer], fields: Sequence[str]) -> set[str]:
    """The names that the wrong ones of some fields are given."""
    graded = marker.mark(taker(), answers)
    marks = [graded.mark(field) for field in fields]
    return {mark.slip for mark in marks if mark.status is not Status.RIGHT}


CASES = {
    "rev/min for rad/s": (RPM, RPM**2, False, "rpm_as_rad"),
    "rev/min for rad/s, only in values with a segment": (RPM, RPM**2, True, "rpm_as_rad"),
    "rev/min for rad/s, the square forgotten": (RPM, RPM, False, "rpm_as_rad"),
    "rev/s for rad/s": (1 / (2 * pi), 1 / (2 * pi) ** 2, False, "turns_as_rad"),
    "a power of ten": (10.0, 10.0, False, "power_of_ten"),
    "a power of ten, only in values with a segment": (10.0, 10.0, True, "power_of_ten"),
    "metres for millimetres": (1e-3, 1e-3, True, "power_of_ten"),
    "a scale of one's own": (0.7, 0.7, False, "wrong_scale"),
    "a scale of one's own, squared in accelerations": (1.6, 2.56, False, "wrong_scale"),
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("name", LABS)
def test_a_factor_has_one_name_in_all_the_values_that_it_spoils(name, case):
    velocities, accelerations, vectors, slip = CASES[case]
    for n in VARIANTS:
        marker = marker_of(name, n)
        fields = values(marker.standard, vectors)
        answers = right_set(name, n)
        answers = off_by(marker.standard, answers, fields, velocities, accelerations)
        assert names(marker, answers, fields) == {slip}, (n, fields)


def test_one_value_alone_is_told_by_its_own_segment():
    """Ten times and thirty over π times differ by 5 %, and the drawing alone by more: what was
    measured tells them apart; the square forgotten has the name of the unit."""
    for n in VARIANTS:
        marker, answers = marker_of("pump", n), right_set("pump", n)
        for field, factor, slip in (
            ("v_D", 10.0, "power_of_ten"),
            ("v_D", RPM, "rpm_as_rad"),
            ("a_D", RPM, "rpm_as_rad"),
        ):
            found = off_by(marker.standard, answers, [field], factor, factor)
            assert names(marker, found, [field]) == {slip}


def spoiled(answers: Mapping[str, Answer], random: np.random.Generator) -> dict[str, Answer]:
    """Answers of which each number is wrong by any factor from a third to three."""
    wrong = {
        field: float(f"{answer.value * 3 ** random.uniform(-1, 1):.4g}")
        for field, answer in answers.items()
        if not field.endswith("_sense") and answer.value is not None
    }
    return {**answers, **given(wrong)}


def lost(name: str, n: int, answers: Mapping[str, Answer]) -> list[EarnedMark]:
    """The marks of the numbers that are wrong."""
    graded = marker_of(name, n).mark(taker(n), answers)
    return [mark for mark in graded.marks if mark.status is not Status.RIGHT and mark.tolerance]


def share_named(marks: Sequence[EarnedMark]) -> float:
    """How many of some marks have the name of a slip."""
    assert len(marks) > 300
    return sum(bool(mark.slip) for mark in marks) / len(marks)


def test_chance_gives_hardly_any_name_to_numbers_at_random():
    """Sets all of whose numbers are wrong by chance, as in a set that was copied and changed."""
    marks = []
    for name in LABS:
        for n in range(1, 31, 3):
            random = np.random.Generator(np.random.PCG64([n, 5]))
            for seed in (1, 2):
                marks += lost(name, n, spoiled(handed_in(name, n, seed), random))
    assert share_named(marks) < 0.02


def test_one_wrong_number_among_right_ones_seldom_has_a_name():
    """Of wrong numbers spread over two decades; more where the tolerance is wide."""
    marker = marker_of("pump", 7)
    answers = handed_in("pump", 7)
    shares = []
    for field in ("v_D", "omega_3", "epsilon_2"):
        right = marker.standard.key[field]
        tried = [right * 10 ** (-1 + 2 * (i + 0.5) / 200) for i in range(200)]
        found = [names(marker, {**answers, **given({field: value})}, [field]) for value in tried]
        shares.append(sum(bool(each - {""}) for each in found) / len(tried))
    assert max(shares) < 0.3
    assert np.mean(shares) < 0.2, shares


@pytest.mark.parametrize("name", LABS)
def test_no_slip_is_made_more_often_than_the_common_ones(name):
    """What can be made in several ways, or in some fields only, is rarer; all others are alike."""
    shares = {slip.name: share(slip) for slip in marker_of(name, 7).slips}
    assert max(shares.values()) == SHARE
    assert all(shares[rare] <= SHARE / 2 for rare in RARER if rare in shares)


@pytest.mark.parametrize("right", [0.04, 1.0, 250.0])
def test_half_of_all_wrong_answers_lie_within_a_factor_of_two(right):
    """Spread in logarithms as Cauchy's curve: all of them, and half, by the trapezoidal rule."""
    for reach, part in ((log(2), 0.5), (3 * log(2), 0.795), (4000.0, 1.0)):
        angles = np.linspace(-1, 1, 2001) * np.arctan(min(reach, 600.0) / log(2))
        logs = log(2) * np.tan(angles)
        dense = [by_chance(right * exp(each), right) for each in logs]
        assert np.trapezoid(dense, logs) == pytest.approx(part, abs=2e-3)
    assert by_chance(right * 3, right) == pytest.approx(by_chance(right / 3, right))


def test_who_means_a_value_hits_it_within_what_is_allowed():
    """As a bell whose 95 of 100 are allowed; by a slip so much more densely than by chance."""
    off = np.linspace(-0.6, 0.6, 12001)
    dense = np.array([hit_density(each, 0.5) for each in off])
    assert np.trapezoid(dense, off) == pytest.approx(0.95, abs=2e-3)
    assert (dense[abs(off) > 0.5] == 0).all() and (dense[abs(off) < 0.499] > 0).all()
    for size, right in ((40.0, 20.0), (3.0, 90.0)):
        ratio = hit_density(0.2, 0.5) / (by_chance(size, right) / size)
        assert hit_ratio(size + 0.2, size, 0.5, right) == pytest.approx(ratio)
    assert hit_ratio(0.4, 0.5, 0.5, 1.0) == 0.0


def test_what_is_computed_from_an_explained_value_is_no_further_evidence():
    """Odds are multiplied for each answer that is hit, but for those that follow from another."""
    standard = marker_of("pump", 12).standard
    fields = tuple(values(standard)[:3])
    slip = Slip("wrong_scale", False, {field: 1.3 * standard.key[field] for field in fields})
    answers = given({field: 1.3 * standard.key[field] for field in fields})

    def odds(sources, given=()):
        found = judged(standard, slip, answers, fields, (), sources, given)
        assert found.fields == fields
        return found.odds / share(slip)

    one, other, third = (
        judged(standard, slip, answers, (field,), ()).odds / share(slip) for field in fields
    )
    assert min(one, other, third) > 1
    assert odds({}) == pytest.approx(one * other * third)
    assert odds({fields[1]: (fields[0],)}) == pytest.approx(one * third)
    assert odds({fields[1]: ("elsewhere",)}) == pytest.approx(one * other * third)
    assert odds({fields[2]: ("elsewhere",)}, ("elsewhere",)) == pytest.approx(one * other)


@pytest.mark.parametrize(("scene", "longer"), [("pump", 1.0), (FOLDER / "gears-planet.toml", RPM)])
def test_a_speed_in_the_wrong_unit_lengthens_a_plan_whose_scale_no_crank_says(scene, longer):
    """One crank's speed is in the scale of its plan; of several drivers the sheet states one."""
    mechanism = load(scene)
    found = standard(mechanism, asked_fields(mechanism).values(), Rubric())
    told = next(slip.values for slip in constructions(found) if slip.name == "rpm_as_rad")
    point = mechanism.scene.ask.velocity[0]
    assert told[f"v_{point}"] == pytest.approx(RPM * found.key[f"v_{point}"])
    segment = f"v_{point}_mm"
    assert told.get(segment, found.key[segment]) == pytest.approx(longer * found.key[segment])


def test_a_driver_whose_acceleration_is_left_out_turns_evenly():
    """Held against the same mechanism, written without that acceleration."""
    text = (FOLDER / "four-bar-crank-rocker.toml").read_text(encoding="utf-8")
    assert "\nacceleration = 20\n" in text
    mechanism = Mechanism(read_text(text, "four-bar"))
    even = Mechanism(read_text(text.replace("\nacceleration = 20\n", "\n"), "four-bar")).solve()
    found = standard(mechanism, asked_fields(mechanism).values(), Rubric())
    slips = [slip for slip in constructions(found) if slip.name == "driver_acceleration_missing"]
    told = {field: value for slip in slips for field, value in slip.values.items()}
    assert abs(told["a_C"]) == pytest.approx(abs(even.points["C"].acceleration))
    for link in ("2", "3"):
        assert told[f"epsilon_{link}"] == pytest.approx(even.links[link].epsilon)
    assert not any(field.startswith(("v_", "omega_")) for field in told)
