"""What the calculation tells of a cam leads to the centre of curvature that the sheet lays off."""

from __future__ import annotations

import re
from cmath import phase
from itertools import cycle
from math import cos, degrees, pi, sin, sqrt
from pathlib import Path

import pytest

from graphkin.construction.cams.cam_centre import FORMS, CurvatureCentre, of_cams
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.construction.core.kind import constructions
from graphkin.documents.calculation import calculation
from graphkin.documents.relations import relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import load
from graphkin.numbers.cam_motions import MOTIONS
from graphkin.numbers.plane import cross
from graphkin.text import LANGUAGES, words
from tests.documents.sheet_tools import drawings
from tests.documents.test_calculation import last_digit, value_of

LEVERS = ("cam-rocker", "cam-conjugate", "cam-fixed-lever")
GUIDED = ("cam-roller", "cam-knife", "cam-table")
FORMULA = re.compile(r"= ([^=;]*?\)\^\{3/2\} / \([^;]*?\)), ")


def told(name: str, language: str = "en") -> tuple[Drawing, CurvatureCentre, str]:
    """The velocity sheet of a scene with one cam, its centre, and how that is told to follow."""
    drawing = drawings(name, None, language)[0]
    centre, *_ = constructions(drawing.trace.program, CurvatureCentre)
    *_, how = (r for r in of_cams(drawing, []) if not r.result)
    return drawing, centre, " ".join((how.left, *how.more))


def by_formula(how: str, **known: float) -> float:
    """What a printed formula gives."""
    text = FORMULA.search(how)[1].replace("*", "").replace("·", "*").replace("−", "-")
    text = re.sub(r"\^\{3/2\}", "**1.5", text).replace("^", "**")
    text = re.sub(r"([sψ])([′″])_\{?\w+\}?", lambda m: {"′": "rate", "″": "bend"}[m[2]], text)
    text = re.sub(r"(cos|sin) γ", r"\1(γ)", text)
    return float(eval(text, {"__builtins__": {}, "cos": cos, "sin": sin}, known))


@pytest.mark.parametrize(("name", "language"), [*zip(cycle(LEVERS), LANGUAGES, strict=False)])
def test_the_radius_under_a_lever_is_what_its_formula_gives(name, language):
    drawing, centre, how = told(name, language)
    cam, spot, values = drawing.scene.cams[centre.follower], drawing.standing.spot, drawing.trace
    o, q, b, k = (spot(p) for p in (cam.pivot, cam.lever.pin, cam.point, centre.name))
    rate, bend = (float(values.values[n]) for n in (centre.rate, centre.bend))
    sign = 1 if cross(q - o, b - q) > 0 else -1
    assert f"1 {'+' if sign > 0 else '−'} *ψ*′" in how
    angle = abs(phase((o - q) / (b - q)))
    sizes = {"d": abs(q - o), "l": abs(b - q), "γ": angle, "u": 1 + sign * rate}
    found = by_formula(how, rate=rate, bend=bend, **sizes)
    pole = o + (q - o) * sign * rate / (1 + sign * rate)
    assert abs(abs(pole - o) / abs(pole - q) - abs(rate)) < 1e-9
    assert b + (pole - b) / abs(pole - b) * found == pytest.approx(k, abs=1e-9)


@pytest.mark.parametrize(("name", "language"), [*zip(cycle(GUIDED), LANGUAGES, strict=False)])
def test_the_radius_under_a_guided_tip_is_what_its_formula_gives(name, language):
    drawing, centre, how = told(name, language)
    cam, spot, values = drawing.scene.cams[centre.follower], drawing.standing.spot, drawing.trace
    o, b, k = (spot(p) for p in (cam.pivot, cam.point, centre.name))
    rate, bend = (float(values.values[n]) for n in (centre.rate, centre.bend))
    slide = drawing.scene.links[centre.follower].slides[0]
    along = 1j ** (float(slide.angle.si(drawing.scene.values)) * 2 / 3.141592653589793)
    seen = (b - o) / along
    found = by_formula(how, rate=rate, bend=bend, h=seen.real, e=seen.imag)
    pole = o - 1j * along * rate
    assert b + (pole - b) / abs(pole - b) * found == pytest.approx(k, abs=1e-9)


@pytest.mark.parametrize("motion", [*FORMS])
def test_each_motion_is_printed_as_it_is_computed(motion):
    """Lift and derivatives of a piece 1.7 rad long that lifts by 3, in both halves of it."""
    name, late, _ = motion.partition("-late")
    for share in (0.7,) if late else (0.2, 0.4):
        found = MOTIONS[name](share)
        wanted = (3 * found.at, 3 * found.rate / 1.7, 3 * found.bend / 1.7**2)
        printed = (form.format(h="3", x=str(share), b="1.7") for form in FORMS[motion])
        assert [value_of(each) for each in printed] == pytest.approx(wanted)


@pytest.mark.parametrize("angle", [50, 240])
@pytest.mark.parametrize("name", ["cam-roller", "cam-rocker", "cam-fixed-lever"])
def test_the_law_is_told_by_the_piece_that_holds(name, angle):
    """In a return with the lift before it; what swings is put in in radians."""
    mechanism = load(Path("examples/scenes") / f"{name}.toml", angle=angle)
    drawing = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))[0]
    told = [r for r in of_cams(drawing, []) if r.figures]
    assert len(told) >= 5
    for relation in told:
        printed, unit = last_digit(relation.result)
        assert value_of(relation.figures) == pytest.approx(printed, abs=unit), relation


def test_the_centre_under_a_flat_face_stands_where_the_law_says():
    drawing, centre, how = told("cam-flat")
    cam, spot, values = drawing.scene.cams[centre.follower], drawing.standing.spot, drawing.trace
    rate, bend = (float(values.values[n]) for n in (centre.rate, centre.bend))
    slide = drawing.scene.links[centre.follower].slides[0]
    along = 1j ** (float(slide.angle.si(drawing.scene.values)) * 2 / 3.141592653589793)
    found = spot(cam.pivot) - along * bend - 1j * along * rate
    assert found == pytest.approx(spot(centre.name), abs=1e-9)
    assert abs(found - spot(cam.pivot)) == pytest.approx(sqrt(rate**2 + bend**2))
    assert "√" in how


def test_a_reader_of_the_data_reckons_how_far_a_plate_has_swung_its_lever():
    """From where the coordinate is zero, from where the law counts it, and how far it goes."""
    drawing = drawings("cam-plate-lever")[0]
    told = " ".join(plain(each) for each in given(drawing))
    start, sign = re.search(
        r"C slides .*\(positive from (\w+) to the (left|right)\)", told
    ).groups()
    ahead, law = {"left": -1, "right": 1}[sign], r"coordinate of C, (\w+), counted from (\d+) mm"
    way, zero = re.search(law, told).groups()
    span, rise = map(float, re.search(r"to (\d+) mm rise of (\d+)° \(cycloidal\)", told).groups())
    gone = 1000 * ahead * (drawing.standing.spot("C") - drawing.standing.spot(start)).real
    part = (gone - float(zero)) * {"forwards": 1, "backwards": -1}[way] / span
    swing = rise * (part - sin(2 * pi * part) / (2 * pi))
    centre, *_ = constructions(drawing.trace.program, CurvatureCentre)
    assert swing == pytest.approx(degrees(drawing.trace.values[centre.lift]), abs=1e-9)


SIDES = {"upwards": 1j, "downwards": -1j, "to the right": 1, "to the left": -1}


def test_the_sentence_leads_from_the_pivot_to_the_centre_under_a_flat_face():
    drawing, centre, _ = told("cam-flat")
    said = next(s.markup for s in sentences(drawing) if "centre of curvature" in s.markup)
    laid = re.findall(rf"([\d.]+) mm ({'|'.join(SIDES)})", said)
    spot, cam = drawing.standing.spot, drawing.scene.cams[centre.follower]
    way = sum(float(size) * SIDES[side] for size, side in laid)
    assert len(laid) == 2
    assert way == pytest.approx(drawing.on_paper(spot(centre.name) - spot(cam.pivot)), abs=0.01)


@pytest.mark.parametrize("name", ["cam-table", "cam-flat", "cam-plate"])
def test_a_sentence_tells_the_law_in_millimetres_of_paper_as_it_tells_the_centre(name):
    """The calculation has it as the scene has: larger by the scale of the mechanism."""
    drawing, *_ = drawings(name)
    said = next(s.markup for s in sentences(drawing) if "by the law" in s.markup)
    lift = r"\*s\*_\{\w+\} = (−?[\d.]+) mm"
    written = next(r for _, rs in relations([drawing]) for r in rs if re.match(r"\*s\*_", r.left))
    real = float(written.result.replace("−", "-"))
    drawn = float(re.search(lift, said)[1].replace("−", "-"))
    assert written.unit == "mm"
    assert drawn == pytest.approx(float(drawing.on_paper(real / 1000)), abs=0.001)


def test_a_form_asks_for_the_law_and_the_distance_before_the_velocity_that_follows():
    found = drawings("cam-lever")
    cam = found[0].scene.cams["2"]
    lines = [
        plain(mark.markup)
        for page in calculation(found, "task")
        for mark in page.marks
        if isinstance(mark, Text)
    ]
    begin = ["ψ2 = ", "ψ′2 = ", "ψ″2 = ", f"O{cam.centre} = .", f"v{cam.centre} = ω1·O"]
    places = [next(i for i, line in enumerate(lines) if line.startswith(b)) for b in begin]
    assert places == sorted(places)
    values = found[0].trace.values
    centre, *_ = constructions(found[0].trace.program, CurvatureCentre)
    swing = next(r.result for r in of_cams(found[0], []) if r.unit == "°")
    assert float(swing) == pytest.approx(degrees(values[centre.lift]), abs=5e-4)


@pytest.mark.parametrize(("name", "language"), [("cam-flat", "ro"), ("cam-carried", "it")])
def test_how_far_a_flat_face_is_laid_off_follows_from_base_circle_and_law(name, language):
    drawing = drawings(name, None, language)[0]
    (high,) = (r for r in of_cams(drawing) if r.symbols.startswith("*r*_b"))
    printed, unit = last_digit(high.result)
    assert value_of(high.figures) == pytest.approx(printed, abs=1.000001 * unit)
    drawn = re.search(r"\d+[.,]\d\d mm", high.remark)[0]
    assert any(drawn in said.markup for said in sentences(drawing))
