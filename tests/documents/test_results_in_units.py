"""Results in other units than metres: the same mechanism, computed in the unit of its results."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.standard import standard
from graphkin.classroom.lab.items import asked_fields
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.documents.relations import of_travel
from graphkin.documents.sheet_documents import drawings_of, hand_out
from graphkin.drawing.marks import LineMark, Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.house import House
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
from graphkin.text.errors import SceneError
from graphkin.text.school_signs import SCHOOLS
from graphkin.web.step_page import step_page
from tests.running import Run

INCH = 0.0254
SCENES = (
    *("pump", "shaper", "cam-rocker", "cam-plate", "gears-planet", "gears-rack", "plates-ring"),
    *("belts-crossed", "excavator-relative", "roller", "platform-six", "geneva-wheel"),
)
UNMARKED = [name for name in SCENES if name != "plates-ring"]
"""Scenes without a point whose image is called m."""
INCHES = """
graphkin = 1
title = "Slider-crank"
units = { length = "in", angle = "deg", speed = "rev/min" }
[frame]
O = [0, 0]
[links.1]
O-A = 2
[links.2]
A-B = 6
[links.3]
B = [0, 0]
slides = { on = 0, through = [0, 0.5], angle = 0 }
[[drivers]]
turn = 1
angle = 40
speed = 120
[branches]
3 = "forward"
[ask]
velocity = ["B"]
acceleration = ["B"]
omega = [2]
epsilon = [2]
"""
METRES = re.compile(r"(?<![\w*])[mм](?=/[sсmм])|= [\d.,·]+ [mм]\b")
"""Metres as a unit in a text."""


LATIN = re.compile(r"(?<=[\d)] )\(?(mm|cm|m|rad|N|N·m|kg|kg·m²|N/m)\b|(?<![\w{])(m/s|rad/s|N/mm)")
"""Latin letters of a unit after a number, or in a ratio."""


@pytest.mark.parametrize("view", ["key", "task"])
@pytest.mark.parametrize("name", [*UNMARKED, "pump-forces", "shaper-forces", "gears-forces"])
def test_units_of_russian_pages_are_in_cyrillic_letters(name, view):
    """GOST 8.417-2002; names of points and links stay in Latin letters."""
    for part in hand_out(load(name), view, "ru"):
        said = [plain(m.markup) for page in part.pages for m in page.marks if isinstance(m, Text)]
        assert not [each for each in said if LATIN.search(each)]
        assert any("мм" in each for each in said)


def of(name: str, results: str) -> Mechanism:
    """A scene of graphkin with the unit of its results."""
    path = scene_files.examples().get(name, name)
    return Mechanism(replace(load(path).scene, results=results))


def texts(mechanism: Mechanism, view: str, language: str = "en") -> list[str]:
    """Every text on the pages of a view."""
    pages = (page for part in hand_out(mechanism, view, language) for page in part.pages)
    return [plain(m.markup) for page in pages for m in page.marks if isinstance(m, Text)]


@pytest.mark.parametrize("name", SCENES)
def test_the_motion_is_the_same_in_inches(name: str) -> None:
    given = of(name, "in")
    own, measured = given.solve(), given.measured.solve()
    assert given.measured.scene.base == "in"
    for point, motion in own.points.items():
        other = measured.points[point]
        for key in ("position", "velocity", "acceleration"):
            every = [getattr(each, key) for each in own.points.values()]
            scale = max(abs(each) for each in every if each is not None) or 1.0
            if getattr(motion, key) is not None:
                away = getattr(motion, key) - INCH * getattr(other, key)
                assert abs(away) <= 1e-9 * scale
    for link, turning in own.links.items():
        other = measured.links[link]
        assert other.omega == pytest.approx(turning.omega, rel=1e-9, abs=1e-9)
        assert other.epsilon == pytest.approx(turning.epsilon, rel=1e-9, abs=1e-6)
    assert given.measured.witness(measured).agrees


@pytest.mark.parametrize("name", ["pump", "shaper", "cam-rocker", "gears-planet"])
def test_the_drawing_is_the_same_in_inches(name: str) -> None:
    drawn = []
    for results in ("SI", "in"):
        sheets = hand_out(of(name, results))[:-1]
        marks = (mark for sheet in sheets for mark in sheet.pages[0].marks)
        lines = [m for m in marks if isinstance(m, LineMark) and m.step is not None]
        ends = np.array([(m.x1, m.y1, m.x2, m.y2) for m in lines])
        drawn.append(ends[np.hypot(*(ends[:, :2] - ends[:, 2:]).T) > 1e-6])
    assert np.allclose(*drawn, rtol=0, atol=1e-6)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("view", ["key", "task"])
def test_no_metre_is_left_on_paper(view: str, language: str) -> None:
    found = texts(Mechanism(read_text(INCHES, "x")), view, language)
    assert not [each for each in found if METRES.search(each)]
    own = words(language).spelled("in/s")
    assert any(own in each for each in found)


def test_relations_follow_from_their_figures_in_inches() -> None:
    found = texts(Mechanism(read_text(INCHES, "x")), "key")
    assert "vA = ω1·OA = 12.5664·2 = 25.13 in/s (⊥ OA)" in found
    assert "kL = 1 in/in = 0.0393701 in/mm (scale 1:1)" in found
    assert any("kL = 1 in/in" in each and each.startswith("Mechanism, scale") for each in found)
    assert "OA/kL = 2/0.0393701 = 50.8 mm (drawn)" in found


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_task_leaves_room_for_the_scale_as_its_caption_states_it(language: str) -> None:
    """In inches per inch of paper, then per millimetre, which the next lines take."""
    found = texts(Mechanism(read_text(INCHES, "x")), "task", language)
    own, drawn = map(words(language).spelled, ("in/in", "in/mm"))
    assert any(re.search(rf"\(kL = [. ]+ {own}[\s;)]", each) for each in found)
    (line,) = (each for each in found if each.startswith("kL = "))
    assert re.fullmatch(rf"kL = [. ]+ {own} = [. ]+ {drawn}", line)


def test_a_page_for_the_screen_has_inches() -> None:
    page = step_page(Mechanism(read_text(INCHES, "x")), "en")
    assert "in/s" in page
    assert not re.search(r">[^<]*(?<![\w])m/s", page)


def test_a_scene_in_metres_is_not_computed_anew() -> None:
    mechanism = load("pump")
    assert mechanism.measured is mechanism
    assert words("en", length="m").unit("(m/s^2)/mm") == "(m/s^2)/mm"
    assert words("en", length="ft").unit("(m/s^2)/mm") == "(ft/s^2)/mm"


@pytest.mark.parametrize(
    "length, stated, house, base",
    [
        *(("in", "", "", "in"), ("ft", "", "", "ft"), ("mm", "", "", "m"), ("cm", "", "", "m")),
        *(("in", "SI", "", "m"), ("cm", "scene", "", "cm"), ("mm", "", "scene", "mm")),
        *(("mm", "m", "in", "m"), ("in", "", "ft", "ft")),
    ],
)
def test_the_unit_of_results(length: str, stated: str, house: str, base: str) -> None:
    more = f', results = "{stated}"' if stated else ""
    text = INCHES.replace('length = "in"', f'length = "{length}"{more}')
    scene = read_text(text, "x", house=House(results=house))
    assert scene.unit_of_results == base
    assert Mechanism(scene).measured.scene.base == base


def test_an_unknown_unit_of_results_is_told() -> None:
    with pytest.raises(SceneError, match=r"units\.results: \"yd\"; expected one of SI, cm, ft"):
        read_text(INCHES.replace('"in"', '"in", results = "yd"'), "x")


def test_solve_prints_inches_and_its_json_si(run: Run, tmp_path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(INCHES, encoding="utf-8")
    assert "v, in/s" in run("solve", path).output
    assert "scale    kL = 1 in/in, drawn 1 : 1" in run("solve", path).output
    assert "scale    kL = 1, drawn 1 : 1" in run("solve", path, "--units", "SI").output
    assert "v, m/s" in run("solve", path, "--units", "SI").output
    si = json.loads(run("solve", path, "--json").output)
    own = json.loads(run("solve", path, "--json", "--units", "scene").output)
    assert "units" not in si
    assert own["units"]["length"] == "in"
    assert si["points"]["B"]["velocity"][0] == pytest.approx(
        INCH * own["points"]["B"]["velocity"][0]
    )
    assert si["scales"]["kL"] == pytest.approx(INCH * own["scales"]["kL"])  # per metre of paper
    assert si["scales"]["kv"] == pytest.approx(INCH * own["scales"]["kv"])


@pytest.mark.parametrize(
    ("length", "name", "field"),
    [
        ("mm", "offset-slider-crank", "H_3"),
        ("in", "offset-slider-crank", "H_3"),
        ("mm", "slotted-lever", "swing_3"),
    ],
)
def test_the_calculation_and_the_form_ask_for_travel_in_one_unit(length, name, field):
    """A student who copies the calculated stroke or swing to the form is right."""
    text = (
        Path(scene_files.find(name))
        .read_text(encoding="utf-8")
        .replace("[ask]", "[ask]\nstrokes = [3]")
    )
    text = text.replace('length = "mm"', f'length = "{length}"')
    mechanism = Mechanism(read_text(text, name, None, {}))
    fields = asked_fields(mechanism)
    own = standard(mechanism, fields.values(), Rubric(points={field: Fraction(1)}))
    measured = mechanism.measured
    verdict = measured.witness(measured.solve())
    (asked,) = of_travel(drawings_of(measured, verdict, words("en", length=measured.scene.base))[0])
    assert asked.unit == fields[field].unit
    assert read_answer(asked.result, fields[field]).value == pytest.approx(own.key[field], rel=1e-3)


def test_a_class_in_inches_is_marked_in_inches(run: Run, tmp_path) -> None:
    """A number without a unit has that of its field; the feedback shows values in it."""
    lab, folder = tmp_path / "lab", tmp_path / "class"
    lab.mkdir()
    scene = INCHES.replace("[frame]", "[parameters]\nn = { value = 1, min = 1, max = 9 }\n[frame]")
    (lab / "scene.toml").write_text(scene.replace("angle = 40", 'angle = "39 + n"'), "utf-8")
    rule = 'graphkin = 1\n[variants]\nset = { n = "number" }\n[marks]\nv_B = 1\na_B = 1\n'
    (lab / "lab.toml").write_text(rule, encoding="utf-8")
    (tmp_path / "class.csv").write_text("id,number\none,1\ntwo,1\n", encoding="utf-8")
    given = "id,v_B,a_B\none,18.70,278.5\ntwo,0.4749 m/s,400\n"
    (tmp_path / "answers.csv").write_text(given, encoding="utf-8")
    assert run("variants", lab, tmp_path / "class.csv", "-o", folder).exit_code in (0, 1)
    done = run("grade", folder, tmp_path / "answers.csv")
    assert done.exit_code in (0, 1), done.output
    marks = (folder / "report" / "marks.csv").read_text(encoding="utf-8-sig")
    rows = [line.split(",") for line in marks.splitlines()]
    right = {row[rows[0].index("id")]: row for row in rows[1:]}
    assert right["one"][rows[0].index("v_B")] == right["two"][rows[0].index("v_B")] == "1"
    assert right["one"][rows[0].index("a_B")] == "1"
    assert right["two"][rows[0].index("a_B")] != "1"
    tolerances = (folder / "report" / "tolerances.csv").read_text(encoding="utf-8-sig")
    assert "one,v_B,in/s,18.6977," in tolerances
    page = next((folder / "report").rglob("*one*.html")).read_text(encoding="utf-8")
    assert "18.70" in page and "in/s" in page and "m/s" not in re.sub("[a-z]m/s", "", page)


@pytest.mark.parametrize(("size", "written"), [(1, "1:1"), (2, "1:2"), (4, "1:4"), (6, "1:8")])
def test_scales_of_inches_are_full_half_quarter_and_eighth(size: int, written: str) -> None:
    longer = INCHES.replace("O-A = 2", f"O-A = {2 * size}").replace("A-B = 6", f"A-B = {6 * size}")
    (first, *_) = hand_out(Mechanism(read_text(longer, "x")), "key", "en")
    marks = [m for m in first.pages[0].marks if isinstance(m, Text) and m.name == "scale"]
    assert written in [mark.markup for mark in marks]


# --- forces ---------------------------------------------------------------------------------------

POUND = 0.45359237 * 9.80665
"""A pound-force in newtons, exact by definition."""
PRESS = """
graphkin = 1
title = "Press"
units = { length = "in", angle = "deg", speed = "rev/min", force = "lbf" }
gravity = true
[frame]
O = [0, 0]
[links.1]
O-A = 3
[links.2]
A-B = 9
A-G = 3.5
G = "on A-B"
mass = 4.5
centre = "G"
inertia = 38
[links.3]
B = [0, 0]
slides = { on = 0, through = [0, 0], angle = 0 }
mass = 6
[[drivers]]
turn = 1
angle = 50
speed = 600
[branches]
3 = "forward"
[[loads]]
at = "B"
link = 3
force = [-250, 0]
[[springs]]
between = "O-B"
stiffness = 5
free = 4
[ask]
reactions = ["A", 3]
balance = true
"""
IN_NEWTONS = (
    (', force = "lbf"', ""),
    ("mass = 4.5", 'mass = "4.5*0.45359237"'),
    ("mass = 6", 'mass = "6*0.45359237"'),
    ("inertia = 38", 'inertia = "38*0.45359237*0.0254**2"'),
    ("-250", '"-250*0.45359237*9.80665"'),
    ("stiffness = 5", 'stiffness = "5*0.45359237*9.80665/0.0254"'),
    ("gravity = true", "gravity = [0, -9.80665]"),
)
"""The same press in kilograms, newtons and metres, by the definitions of the units."""
NEWTONS = re.compile(r"(?<=[\d)] )(N|N·m|kg|kg·m²)(?![\w·])|\bN/mm")


def forces_of(mechanism: Mechanism) -> list[tuple[complex, float]]:
    found, verdict = mechanism.forces()
    assert verdict.agrees
    some = [(each.force, 0.0) for each in found.reactions]
    return some + [(each.force or 0.0, each.moment or 0.0) for each in found.balance]


@pytest.mark.parametrize("name", ["pump-forces", "shaper-forces", "gears-forces", "belts-forces"])
@pytest.mark.parametrize(("results", "metre", "newton"), [("in", INCH, POUND), ("mm", 1e-3, 1.0)])
def test_forces_are_the_same_in_other_units(name: str, results: str, metre, newton) -> None:
    given = of(name, results)
    assert given.measured.scene.base == results
    for own, other in zip(forces_of(given), forces_of(given.measured), strict=True):
        assert other[0] * newton == pytest.approx(own[0], rel=1e-9, abs=1e-9)
        assert other[1] * newton * metre == pytest.approx(own[1], rel=1e-9, abs=1e-9)


def test_a_scene_in_pounds_is_the_same_in_newtons() -> None:
    text = PRESS
    for own, si in IN_NEWTONS:
        assert own in text
        text = text.replace(own, si)
    both = [forces_of(Mechanism(read_text(each, "x"))) for each in (PRESS, text)]
    for own, other in zip(*both, strict=True):
        assert own == pytest.approx(other, rel=1e-12)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("view", ["key", "task"])
def test_no_newton_is_left_on_a_sheet_in_pounds(view: str, language: str) -> None:
    found = texts(Mechanism(read_text(PRESS, "x")), view, language)
    assert not [each for each in found if NEWTONS.search(each) or METRES.search(each)]
    assert any(words(language).spelled("lbf·in") in each for each in found)


def test_a_weight_in_pounds_is_its_mass_in_pounds() -> None:
    found = texts(Mechanism(read_text(PRESS, "x")), "key")
    assert "4.5 lb = 0.011655 lbf·s²/in" in found
    assert "G2 = m2·g = 0.011655·386.09 = 4.500 lbf" in found


@pytest.mark.parametrize(
    ("written", "pounds"),
    [
        *(("250", 250), ("250 lb", 250), ("1.112 kN", 1112 / POUND), ("250,0 lbf", 250)),
        ("250 фунт-сила", 250),
    ],
)
def test_forces_are_answered_in_pounds_or_newtons(written: str, pounds: float) -> None:
    item = asked_fields(Mechanism(read_text(PRESS, "x")))["R_12"]
    assert item.unit == "lbf"
    assert read_answer(written, item).value == pytest.approx(pounds * POUND, rel=1e-12)


@pytest.mark.parametrize(
    ("written", "inch_pounds"),
    [
        *(("60", 60), ("60 lbf·in", 60), ("60 in-lb", 60), ("5 ft·lbf", 60), ("5 lb-ft", 60)),
        ("6.779 N·m", 6.779 / POUND / INCH),
    ],
)
def test_moments_are_answered_in_inch_or_foot_pounds(written: str, inch_pounds: float) -> None:
    item = asked_fields(Mechanism(read_text(PRESS, "x")))["M_b1"]
    assert item.unit == "lbf·in"
    assert read_answer(written, item).value == pytest.approx(inch_pounds * POUND * INCH, rel=1e-12)


def test_angular_accelerations_of_forces_have_the_sign_of_the_school() -> None:
    scene = read_text(PRESS, "x", house=House(signs=SCHOOLS["english"].signs))
    assert not [each for each in texts(Mechanism(scene), "key") if "ε" in each]


def test_forces_in_pounds_are_reported_in_pounds(run: Run, tmp_path) -> None:
    path = tmp_path / "press.toml"
    path.write_text(PRESS, encoding="utf-8")
    assert "moment, lbf·in" in run("solve", path).output
    assert "moment, N·m" in run("solve", path, "--units", "SI").output
    own = json.loads(run("solve", path, "--json", "--units", "scene").output)
    si = json.loads(run("solve", path, "--json").output)
    assert own["units"]["moment"] == "lbf·in"
    moment = own["balance"]["1"]["moment"] * POUND * INCH
    assert si["balance"]["1"]["moment"] == pytest.approx(moment, rel=1e-9)


@pytest.mark.parametrize("results", ["in", "SI"])
def test_a_length_in_a_polygon_is_marked_as_it_is_printed(results: str) -> None:
    """Factors of forces are round in pounds, so a polygon in pounds has other lengths."""
    text = PRESS.replace("force =", f'results = "{results}", force =', 1)
    mechanism = Mechanism(read_text(text, "x"))
    fields = asked_fields(mechanism)
    own = standard(mechanism, fields.values(), Rubric(points=dict.fromkeys(fields, Fraction(1))))
    found = texts(mechanism, "key")
    printed = next(b for a, b in pairwise(found) if a == "R12" and re.fullmatch(r"[\d.]+", b))
    assert own.key["R_12_mm"] == pytest.approx(float(printed), abs=0.006)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("view", ["key", "task"])
def test_the_head_of_a_force_sheet_has_both_units_of_its_scale(view: str, language: str) -> None:
    """Arms are in mm on paper, so a moment in lbf·in needs kL in in/mm."""
    some = hand_out(Mechanism(read_text(PRESS, "x")), view, language)
    (page, *_) = next(part.pages for part in some if part.kind == "force")
    said = " ".join(plain(m.markup) for m in page.marks if isinstance(m, Text))
    own = [words(language).spelled(unit) for unit in ("in/in", "in/mm")]
    assert re.search(rf"kL = [^=()]+ {own[0]} = [^=()]+ {own[1]}", said)


@pytest.mark.parametrize("results", ["lbf", "in", "SI"])
def test_a_displacement_on_paper_follows_from_the_head_of_the_sheet(results: str) -> None:
    """Its moment by its force and kL in the last unit of the head, all as printed."""
    mechanism = Mechanism(read_text(PRESS, "x"))
    if results != "lbf":
        mechanism = Mechanism(replace(mechanism.scene, results=results))
    sheet, calculation = (" ".join(texts(mechanism, view)) for view in ("steps", "key"))
    scale = re.search(r"loads, scale \S+ +\(kL = (?:[\d.]+ in/in = )?([\d.]+) (?:in|m)/mm", sheet)
    force = re.search(r"Fi2 = [^=]+ = ([\d.]+) ", sheet)
    shift = re.search(r"h\d = Mi2/\(Fi2·kL\) = ([\d.]+) mm", sheet)
    turning = re.search(r"Mi2 = J2·ε2 = [^=]+ = ([\d.]+) ", calculation)
    assert scale and force and shift and turning
    k, f, h, m = (float(each[1]) for each in (scale, force, shift, turning))
    assert h == pytest.approx(m / (f * k), rel=2e-3)
