"""Slips in forces: what each makes of a sheet, by other scenes, and whether marking names it."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.causes import Cause, Variants, constructed
from graphkin.classroom.grading.feedback import cause_sentence
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.standard import Standard, standard
from graphkin.classroom.lab.items import asked_fields
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.classroom.roster.students import Student, Taker
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words

SCENES = Path(__file__).parents[2] / "scenes" / "forces"


@cache
def standard_of(name: str, *changes: tuple[str, str]) -> Standard:
    """The standard of a scene of forces with some of its text changed."""
    text = (SCENES / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    mechanism = Mechanism(read_text(text, name, None, {}))
    fields = asked_fields(mechanism)
    rubric = Rubric(points=dict.fromkeys(fields, Fraction(1)))
    return standard(mechanism, fields.values(), rubric)


def values_by(own: Standard, name: str) -> tuple[Cause, dict[str, float]]:
    """The values of a student with a slip everywhere."""
    (cause,) = (e for e in constructed(own) if e.name == name and not e.way)
    variants = Variants([own])
    told = variants.read(variants.changed(cause.change))[0]
    return cause, dict(zip(variants.fields, told.tolist(), strict=True))


MASSES = (("mass = 3", "mass = 0"), ("mass = 2", "mass = 0"))
NO_GRAVITY = ("gravity = true", "gravity = false")


@pytest.mark.parametrize(
    ("slip", "before", "after"),
    [
        ("weight_missing", (), (NO_GRAVITY,)),
        ("mass_for_weight", (), (("gravity = true", "gravity = [0, -1]"),)),
        ("inertia_missing", (NO_GRAVITY,), (NO_GRAVITY, *MASSES)),
        ("inertia_moment_missing", (), (("inertia = 0.06", ""), ("inertia = 0.025", ""))),
    ],
)
def test_what_is_forgotten_is_as_if_it_were_not_there(slip, before, after):
    """The forces of a slip are those of a scene without the thing that was forgotten."""
    own, other = standard_of("four-bar", *before), standard_of("four-bar", *after)
    _, told = values_by(own, slip)
    for field, item in own.by_field.items():
        if item.item.unit != "mm":
            assert abs(told[field] - other.key[field]) < 1e-9 * max(1, abs(other.key[field]))


@pytest.mark.parametrize(
    ("name", "slip"),
    [
        *(("four-bar", slip) for slip in ("inertia_along", "inertia_missing")),
        *(("four-bar", f"inertia_moment_{way}") for way in ("missing", "reversed")),
        *(("four-bar", slip) for slip in ("weight_missing", "mass_for_weight", "arm_slanted")),
        *(("four-bar", slip) for slip in ("tangential_reversed", "arms_about_outer")),
        ("shaper", "reaction_reversed"),
        *(("shaper", slip) for slip in ("weight_missing", "arm_slanted", "reaction_along_guide")),
        *(("ram", slip) for slip in ("weight_missing",)),
    ],
)
def test_a_slip_is_named_and_costs_its_own_share(name, slip):
    own = standard_of(name)
    _, told = values_by(own, slip)
    graded = marked(own, told)
    assert [each.name for each in graded.causes] == [slip]
    assert graded.earned >= graded.points * Fraction(3, 4)
    assert words("it")(f"cause.{slip}") in cause_sentence(graded.causes[0], words("it"))


def marked(own: Standard, told: dict[str, float]):
    """The marks of a student who writes some values to four digits."""
    answers = {item.field: read_answer(written(item, told[item.field]), item) for item in own.items}
    return Marker(own).mark(Taker(Student(1, "s"), {}, ()), answers)


def written(item, value: float) -> str:
    if item.what == "sense":
        return "ccw" if value > 0 else "cw"
    return f"{abs(value):.4g} {item.unit}"


@pytest.mark.parametrize(
    "name",
    [
        *(
            "belt-on-arm",
            "cam-rocker",
            "class-three",
            "cylinders",
            "four-bar",
            "gas-engine",
            "planetary",
            "rack",
        ),
        *("ram", "shaper"),
    ],
)
def test_the_key_itself_earns_everything(name):
    own = standard_of(name)
    graded = marked(own, dict(own.key))
    assert graded.earned == graded.points and not graded.causes


def test_the_force_of_a_cam_and_of_a_rack_is_asked_where_the_follower_or_the_wheel_is():
    assert {"R_12", "R_02"} <= {*standard_of("cam-rocker").by_field}
    assert {"R_12", "R_02"} <= {*standard_of("rack").by_field}


def test_a_scale_of_the_student_s_own_for_forces_is_named():
    own = standard_of("four-bar")
    told = {f: v * (1.25 if f.endswith("_mm") else 1) for f, v in own.key.items()}
    assert [each.name for each in marked(own, told).causes] == ["own_scale"]


@pytest.mark.parametrize("name", ["four-bar", "shaper"])
def test_one_wrong_force_that_later_ones_follow_is_followed(name):
    """The first force alone is wrong in mm and in N; the rest follows from it, or is right."""
    own = standard_of(name)
    graded = marked(own, {f: v * (1.4 if f.startswith("R_12") else 1) for f, v in own.key.items()})
    assert graded.earned >= graded.points - 2


@pytest.mark.parametrize("slip", ["strands_swapped", "tension_of_other_strand"])
def test_a_slip_in_a_belt_is_named_and_costs_its_own_share(slip):
    """Strands that are not parallel, so that a swap of both changes the reaction in the pin."""
    own = standard_of("belt-on-arm", ('centre = "O", radius = 60', 'centre = "O", radius = 110'))
    _, told = values_by(own, slip)
    graded = marked(own, told)
    assert [each.name for each in graded.causes] == [slip]
    assert graded.earned >= graded.points * Fraction(3, 4)


@pytest.mark.parametrize(
    ("stated", "taken_for"),
    [("slack = 400", "pretension = {middle}"), ("pretension = 400", "slack = 400")],
)
def test_a_tension_of_the_wrong_strand_is_that_of_a_belt_stretched_otherwise(stated, taken_for):
    """A slack tension taken for the tight one is a mean lower by half of the difference."""
    own = standard_of("belt-on-arm", ("slack = 40", stated))
    tight, slack = sorted((abs(own.key[f]) for f in ("R_02_left", "R_02_right")), reverse=True)
    middle = 400 - (tight - slack) / 2
    other = standard_of("belt-on-arm", ("slack = 40", taken_for.format(middle=middle)))
    _, told = values_by(own, "tension_of_other_strand")
    for field, item in own.by_field.items():
        if item.item.unit != "mm":
            assert told[field] == pytest.approx(other.key[field], rel=1e-9, abs=1e-9)


def test_swapped_strands_have_each_the_tension_of_the_other():
    own = standard_of("belt-on-arm")
    _, told = values_by(own, "strands_swapped")
    for one, other in (("R_02_left", "R_02_right"), ("R_02_right", "R_02_left")):
        assert told[one] == pytest.approx(own.key[other], rel=1e-9)
