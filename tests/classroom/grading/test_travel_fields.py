"""Strokes, swings and time ratios on a form: keys by closed forms, tolerances, causes, marks."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import asin, degrees, sqrt
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.causes import Variants, constructed
from graphkin.classroom.grading.class_look import in_other_units
from graphkin.classroom.grading.class_marking import standards
from graphkin.classroom.grading.feedback import cause_words, quantity
from graphkin.classroom.grading.keys import Keys
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.standard import Standard, standard
from graphkin.classroom.lab.items import asked_fields
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.classroom.roster.students import Student, Taker
from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.text.errors import RosterError, SceneError

TRAVELS = {
    "offset-slider-crank": "strokes = [3]\ntime_ratios = [3]",
    "slotted-lever": "strokes = [3, 5]\ntime_ratios = [3, 5]",
}


def text_of(name: str, asked: str) -> str:
    """The text of a shipped lab that asks for more."""
    text = Path(scene_files.find(name)).read_text(encoding="utf-8")
    return text.replace("[ask]", f"[ask]\n{asked}")


@cache
def standard_of(name: str, **settings: int) -> Standard:
    """The standard of a shipped lab that also asks for travels."""
    mechanism = Mechanism(read_text(text_of(name, TRAVELS[name]), name, None, settings))
    return standard(mechanism, asked_fields(mechanism).values(), rubric_of(mechanism))


def rubric_of(mechanism: Mechanism) -> Rubric:
    """A point for every field."""
    return Rubric(points=dict.fromkeys(asked_fields(mechanism), Fraction(1)))


def marked(own: Standard, written: dict[str, str]) -> dict[str, tuple[str, str]]:
    """The status and the cause of each field of a sheet."""
    answers = {
        field: read_answer(text, own.by_field[field].item) for field, text in written.items()
    }
    graded = Marker(own).mark(Taker(Student("1", "s", 1), {}), answers)
    return {mark.item.field: (mark.status.name, mark.cause) for mark in graded.marks}


def test_stroke_and_time_ratio_of_an_offset_slider_crank():
    """H = √((l+r)² − e²) − √((l−r)² − e²); K from the angles of crank and rod in line."""
    key, r, rod, e = standard_of("offset-slider-crank").key, 0.060, 0.200, 0.030
    far, near = sqrt((rod + r) ** 2 - e**2), sqrt((rod - r) ** 2 - e**2)
    between = degrees(asin(e / (rod - r)) - asin(e / (rod + r)))
    assert key["H_3"] == pytest.approx(far - near, rel=1e-9)
    assert key["K_3"] == pytest.approx((180 + between) / (180 - between), rel=1e-7)


def test_swing_and_time_ratio_of_a_slotted_lever():
    """sin(ψ/2) = r/d, and K = (180° + ψ)/(180° − ψ): crank and lever are perpendicular."""
    own = standard_of("slotted-lever")
    values = {name: float(value) for name, value in own.mechanism.scene.values.items()}
    r, d = values.get("r", 120) / 1000, 0.300
    swing = 2 * degrees(asin(r / d))
    assert own.key["swing_3"] == pytest.approx(swing, rel=1e-7)
    for field in ("K_3", "K_5"):
        assert own.key[field] == pytest.approx((180 + swing) / (180 - swing), rel=1e-6)
    assert own.by_field["swing_3"].item.unit == "°"


@pytest.mark.parametrize(
    ("cause", "factor"), [("diameter_for_radius", 2), ("radius_for_diameter", 0.5)]
)
@pytest.mark.parametrize(("name", "r"), [("offset-slider-crank", 60), ("slotted-lever", 84)])
def test_a_crank_of_another_length_gives_the_travel_of_that_mechanism(name, r, cause, factor):
    """The travel of a sheet with a cause is that of a scene with the wrong length."""
    own = standard_of(name, r=r)
    text = text_of(name, TRAVELS[name]).replace('"r"', f'"{factor}*r"')
    other = Mechanism(read_text(text, name, None, {"r": r}))
    variants = Variants([own])
    (change,) = (each.change for each in constructed(own) if each.name == cause)
    told = dict(zip(variants.fields, variants.read(variants.changed(change))[0], strict=True))
    there = standard(other, asked_fields(other).values(), own.rubric).key
    for field in own.travel:
        assert told[field] == pytest.approx(there[field], rel=2e-3), field


def written(values: dict[str, float]) -> dict[str, str]:
    """Values as a student writes them, with four digits."""
    return {field: f"{value:.4g}" for field, value in values.items()}


@pytest.mark.parametrize("name", TRAVELS)
def test_a_sheet_of_the_key_is_right(name):
    """The key earns all points, with units as a student may write them."""
    own = standard_of(name)
    sheet = written(own.key)
    assert {status for status, _ in marked(own, sheet).values()} == {"RIGHT"}
    blocks = [field for field in own.travel if field.startswith("H")]
    for field in blocks:
        sheet[field] = f"{1000 * own.key[field]:.1f} mm"
    assert marked(own, sheet)[blocks[0]] == ("RIGHT", "")


def test_a_time_ratio_turned_over_is_named():
    """1/K is explained; a stroke of half the size is wrong and nothing explains it."""
    own = standard_of("slotted-lever")
    sheet = written(own.key) | {f"K_{link}": f"{1 / own.key['K_3']:.3f}" for link in (3, 5)}
    found = marked(own, sheet)
    assert found["K_3"] == found["K_5"] == ("CAUSE", "ratio_inverted")
    assert found["swing_3"] == ("RIGHT", "")
    half = written(own.key) | {"H_5": f"{own.key['H_5'] / 2:.4f}"}
    assert marked(own, half)["H_5"][0] == "WRONG"


@pytest.mark.parametrize(("name", "link"), [("slotted-lever", "5"), ("offset-slider-crank", "3")])
def test_a_time_ratio_turned_over_is_named_beside_another_slip(name, link):
    """One wrong sense, which has nothing to do with the ratio, does not hide the cause."""
    mechanism = Mechanism(read_text(text_of(name, f"time_ratios = [{link}]"), name, None, {}))
    own = standard(mechanism, asked_fields(mechanism).values(), rubric_of(mechanism))
    right = written(own.key) | {f"K_{link}": f"{1 / own.key[f'K_{link}']:.3f}"}
    slips = [field for field in right if field.startswith("epsilon") and field.endswith("_sense")]
    for slip in slips:
        found = marked(own, right | {slip: "cw" if own.key[slip] > 0 else "ccw"})
        assert found[f"K_{link}"] == ("CAUSE", "ratio_inverted")
        assert found[slip][0] == "WRONG"
    assert slips


def test_a_number_without_a_unit_has_no_comma():
    own = standard_of("slotted-lever")
    graded = Marker(own).mark(Taker(Student("1", "s", 1), {}), {})
    assert quantity(graded.mark("K_5"), words("en")) == own.by_field["K_5"].item.symbol
    assert quantity(graded.mark("H_5"), words("en")).endswith(", m")


def test_nothing_is_said_to_follow_from_a_time_ratio():
    """A time ratio enters no other field of the form."""
    own = standard_of("slotted-lever")
    sheet = written(own.key) | {f"K_{link}": f"{1 / own.key['K_3']:.3f}" for link in (3, 5)}
    answers = {field: read_answer(text, own.by_field[field].item) for field, text in sheet.items()}
    graded = Marker(own).mark(Taker(Student("1", "s", 1), {}), answers)
    (said,) = cause_words(graded, words("en"))
    assert "the time ratio was turned over" in said
    assert "follow" not in said


def test_a_crank_drawn_twice_as_long_explains_stroke_and_plans_at_once():
    """One mistake costs once: the whole sheet of a crank twice as long has that cause."""
    own = standard_of("offset-slider-crank")
    variants = Variants([own])
    (change,) = (e.change for e in constructed(own) if e.name == "diameter_for_radius")
    told = variants.read(variants.changed(change))[0]
    sheet = dict(zip(variants.fields, (float(value) for value in told), strict=True))
    found = marked(own, written(sheet))
    assert found["H_3"] == ("CAUSE", "diameter_for_radius")
    assert found["v_B"] == ("CAUSE", "diameter_for_radius")


def test_the_tolerance_is_that_of_the_pencil_in_both_dead_positions():
    """A coarser pencil is allowed more; a stroke a tenth off is not right."""
    own = standard_of("offset-slider-crank")
    coarse = standard(own.mechanism, own.items, replace(own.rubric, point=1.0, line=1.0))
    for field in own.travel:
        assert coarse.tolerance[field].pencil > 1.5 * own.tolerance[field].pencil
        assert 0.005 < own.tolerance[field].value / own.key[field] < 0.05
    mm = own.paper.mechanism / 1000
    assert own.tolerance["H_3"].ruler == pytest.approx(own.rubric.ruler * mm)
    assert own.tolerance["H_3"].pencil > sqrt(2) * own.rubric.point * mm
    sheet = written(own.key) | {"H_3": f"{0.9 * own.key['H_3']:.4f}"}
    assert marked(own, sheet)["H_3"][0] == "WRONG"


def test_strokes_in_metres_do_not_hide_that_speeds_are_in_millimetres():
    keys = Keys.of([standard_of("offset-slider-crank").expectation])
    units = [keys.standards[0].item[field].unit for field in keys.fields]
    per_second = np.array([unit.startswith("m/") for unit in units])
    assert "m" in units and per_second.sum() > 1
    sizes = np.repeat(keys.sizes, 8, axis=0)
    with pytest.raises(RosterError, match="another unit") as caught:
        in_other_units(keys, abs(sizes) * np.where(per_second, 1000.0, 1.0), sizes)
    assert "H_3" not in str(caught.value)
    in_other_units(keys, abs(sizes), sizes)


def test_variants_of_a_class_have_the_keys_of_single_ones():
    """The keys of many variants at once equal those of single ones."""
    name = "offset-slider-crank"
    text = text_of(name, TRAVELS[name])
    usual = Mechanism(read_text(text, name, None, {}))
    some = [{"n": "3", "r": "60"}, {"n": "4", "r": "64"}, {"n": "9", "r": "52"}]
    form = tuple(asked_fields(usual).values())
    found = standards(usual, text, form, rubric_of(usual), [(each, ()) for each in some])
    for own, each in zip(found, some, strict=True):
        single = standard_of(name, **{key: int(value) for key, value in each.items()})
        for field in single.travel:
            assert own.key[field] == single.key[field]
            assert own.tolerance[field].value == pytest.approx(single.tolerance[field].value)


@pytest.mark.parametrize(
    ("asked", "place", "words"),
    [
        ("strokes = [1]", "ask.strokes[0]", "link 1 does not move to and fro"),
        ("strokes = [3]\ntime_ratios = [2]", "ask.time_ratios[0]", "link 2 does not move"),
    ],
)
def test_what_has_no_stroke_is_refused(asked, place, words):
    """A crank and a rod have no stroke; the place in the scene is named."""
    name = "offset-slider-crank"
    mechanism = Mechanism(read_text(text_of(name, asked), name, None, {}))
    with pytest.raises(SceneError) as refused:
        standard(mechanism, asked_fields(mechanism).values(), Rubric())
    (problem,) = refused.value.problems
    assert (str(problem.place), words in str(problem)) == (place, True)


def test_a_stroke_is_written_in_the_unit_of_the_results():
    """A scene in inches asks for inches: a plain number is in inches, one with mm is not."""
    name = "offset-slider-crank"
    text = text_of(name, TRAVELS[name]).replace('length = "mm"', 'length = "in"')
    mechanism = Mechanism(read_text(text, name, None, {}))
    own = standard(mechanism, asked_fields(mechanism).values(), rubric_of(mechanism))
    item = own.by_field["H_3"].item
    assert item.unit == mechanism.scene.unit_of_results == "in"
    assert read_answer("10", item).value == pytest.approx(0.254)
    assert read_answer("100 mm", item).value == pytest.approx(0.1)
    assert (
        read_answer("ψ = 47,2°", standard_of("slotted-lever").by_field["swing_3"].item).value
        == 47.2
    )
