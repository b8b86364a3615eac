"""Centres by Kennedy's lines, the inflection circle, centrodes and paths on the sheet."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from math import hypot

import pytest
from shapely import LineString, Point

from graphkin.construction.core.curve_extent import is_straight
from graphkin.construction.core.curve_marks import (
    UNSEEN,
    clipped_path,
    middle_of,
    ring,
)
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.solution import Curve
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.documents.step_pages import growing
from graphkin.drawing.field import Field
from graphkin.drawing.marks import LineMark, Page, Polyline, Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.motion.motion_curves import curves_of
from graphkin.numbers.plane import Circle as Round
from graphkin.numbers.plane import Ratio, cross
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.documents.sheet_tools import drawings

HEAD = """graphkin = 1
title = "centres"
units = { length = "mm", angle = "deg", speed = "rad/s" }
"""
FOUR_BAR = """
[frame]
O1 = [0, 0]
O2 = [150, 0]
[links.1]
O1-A = 80
[links.2]
A-B = 130
[links.3]
O2-B = 70
[[drivers]]
turn = 1
angle = 75
speed = 12
[branches]
B = "left of A-O2"
"""
SLIDER_CRANK = """
[frame]
O = [0, 0]
[links.1]
O-A = 60
[links.2]
A-B = 160
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[[drivers]]
turn = 1
angle = 60
speed = 12
[branches]
3 = "forward"
"""
CARDAN = """
[frame]
O = [0, 0]
[links.1]
A = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[links.2]
B-A = 100
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 90 }
[[drivers]]
slide = 1
position = "100*cos(45)"
speed = -200
[branches]
3 = "backward"
"""
NEAR = """
[frame]
A = [0, 0]
D = [110, 0]
[links.1]
A-B = 60
[links.2]
B-C = 60
[links.3]
D-C = 75
[[drivers]]
turn = 1
angle = 70
speed = 3
[branches]
C = "left of B-D"
"""
SCENES = {"near": NEAR, "four-bar": FOUR_BAR, "slider-crank": SLIDER_CRANK, "cardan": CARDAN}
ALL = 'centres = "all"'
TENTH = 0.1


@cache
def drawn(name: str, ask: str) -> tuple[Drawing, ...]:
    """The material of a scene's sheets."""
    mechanism = Mechanism(read_text(f"{HEAD}{SCENES[name]}[ask]\n{ask}\n", name, None, {}))
    return tuple(drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en")))


def page_of(drawing: Drawing, view: str = "key") -> Page:
    """A sheet, which must fit."""
    page = sheet(drawing, view, "1/1")
    page.check()
    return page


def names(page: Page) -> set[str]:
    """The points that labels name, of several together each."""
    texts = [m for m in page.marks if isinstance(m, Text) and m.cls.startswith("label")]
    return {name for text in texts for name in text.name.split()}


def field_of(drawing: Drawing) -> Field:
    """The mechanism's field."""
    return lay_out(drawing).mechanism


# --- relative centres ----------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["four-bar", "slider-crank"])
def test_every_centre_has_its_name_on_the_sheet(name):
    found = names(page_of(drawn(name, ALL)[0]))
    assert found >= {"I01", "I02", "I03", "I12", "I13", "I23"}


def test_a_task_sheet_gives_no_centre_away():
    page = page_of(drawn("four-bar", ALL)[0], "task")
    assert not [m for m in page.marks if getattr(m, "name", "").startswith("I")]
    told = " ".join(m.markup for m in page.marks if isinstance(m, Text))
    assert "Kennedy" in told


def test_lines_of_centres_run_through_the_centres_that_they_join_and_find():
    drawing = drawn("four-bar", ALL)[0]
    field, page = field_of(drawing), page_of(drawing)
    rays = {m.step: m for m in page.marks if isinstance(m, LineMark) and m.cls == "ray" and m.step}
    lines = 0
    for number, step, _ in drawing.mechanism_steps():
        if not step.action or step.action.key != "kennedy-line" or number not in rays:
            continue
        lines += 1
        mark = rays[number]
        found = drawing.results[drawing.children[number][0]]
        for end in (*step.args, found):
            ratio = drawing.trace.values[end]
            x, y = field(drawing.place(ratio))
            along = (mark.x2 - mark.x1, mark.y2 - mark.y1)
            away = along[0] * (y - mark.y1) - along[1] * (x - mark.x1)
            assert abs(away) < 1e-6 * hypot(*along) * max(hypot(x, y), 1)
            inside = min(mark.x1, mark.x2) - TENTH <= x <= max(mark.x1, mark.x2) + TENTH
            assert inside or not field.holds(drawing.place(ratio), 10)
    assert lines == 4


def test_the_centre_of_a_block_is_named_where_its_ray_leaves_the_field():
    page = page_of(drawn("slider-crank", ALL)[0])
    text = next(m for m in page.marks if isinstance(m, Text) and m.name == "I03")
    assert "at infinity, direction 90.0°" in text.markup


def test_pins_and_guides_are_said_in_one_sentence_and_each_other_centre_in_its_own():
    said = [s.markup for s in sentences(drawn("slider-crank", ALL)[0])]
    at_once = [s for s in said if "are the centres of their links" in s]
    assert len(at_once) == 1
    assert at_once[0].count("=") == 3 and at_once[0].count("at infinity ⊥ guide") == 1
    assert sum("the centre of links" in s for s in said) == 2
    assert any("towards *I*_{03} at infinity" in s for s in said)


def test_a_centre_that_is_asked_alone_brings_only_what_leads_to_it():
    drawing = drawn("slider-crank", 'centres = ["1-3"]')[0]
    found = {s.name for _, s, v in drawing.mechanism_steps() if isinstance(v, Ratio) and s.name}
    assert found == {"I01", "I12", "I23", "I03", "I13"}


KNOWN = 'centres = [2, "all"]'


def test_the_centre_of_a_link_and_the_frame_is_its_instantaneous_centre_found_again():
    drawing = drawn("four-bar", KNOWN)[0]
    (said,) = [plain(s.markup) for s in sentences(drawing) if "I02" in plain(s.markup)[-40:]]
    assert said.endswith("they meet in I02, which is I2 again: a check")
    assert {"I2", "I02"} <= names(page_of(drawing))


def test_a_far_centre_that_is_found_again_is_told_by_its_first_name():
    (drawing,) = drawings("instant-centres")
    texts = [plain(m.markup) for m in page_of(drawing).marks if isinstance(m, Text)]
    assert sum("off the field" in text and "218.7" in text for text in texts) == 1
    assert "I02 = I2" in texts and "I2 = I02" in texts


def test_centres_that_fall_together_each_have_their_page():
    drawing = drawn("near", KNOWN)[0]
    letters = []
    for page in growing(drawing, "1/1"):
        shown = [plain(m.markup) for m in page.marks if isinstance(m, Text)]
        letters += [text for text in shown if text in ("I2", "I2 ≡ I02")]
    assert letters[0] == "I2" and letters[-1] == "I2 ≡ I02"


# --- the inflection circle -----------------------------------------------------------------------


def test_a_link_without_any_acceleration_has_no_pole_at_infinity():
    """Of a crank that stands: a pole that is every point is told by its sentence alone."""
    text = HEAD + SCENES["four-bar"].replace("speed = 12", "speed = 0") + "[ask]\npoles = [2]\n"
    mechanism = Mechanism(read_text(text, "four-bar", None, {}))
    *_, drawing = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))
    assert any("every point is its pole" in said.markup for said in sentences(drawing))
    assert not [m for m in page_of(drawing).marks if "infinity" in getattr(m, "markup", "")]


def test_the_inflection_circle_runs_through_both_ends_of_its_diameter():
    drawing = drawn("slider-crank", "inflection = [2]")[-1]
    assert drawing.kind == "acceleration"
    field, page = field_of(drawing), page_of(drawing)
    number, circle = next(
        (n, v) for n, s, v in drawing.mechanism_steps() if s.name == "inflection 2"
    )
    arcs = [m for m in page.marks if isinstance(m, Polyline) and m.step == number]
    assert arcs
    x, y = field(circle.centre)
    away = [hypot(u - x, v - y) for arc in arcs for u, v in arc.points[1:-1]]
    assert away == pytest.approx([circle.radius * field.mm] * len(away), abs=1e-6)
    for name in ("I2", "W2"):
        ratio = next(v for _, s, v in drawing.mechanism_steps() if s.name == name)
        assert abs(drawing.place(ratio) - circle.centre) == pytest.approx(circle.radius, rel=1e-9)


def test_the_points_laid_off_on_the_rays_lie_on_the_inflection_circle():
    drawing = drawn("slider-crank", "inflection = [2]")[-1]
    steps = [(s, v) for _, s, v in drawing.mechanism_steps()]
    circle = next(v for s, v in steps if s.name == "inflection 2")
    laid_off = [v for s, v in steps if s.action and s.action.key == "inflection-point"]
    assert len(laid_off) == 2
    for point in laid_off:
        assert abs(point - circle.centre) == pytest.approx(circle.radius, rel=1e-9)


def test_a_crank_has_its_pin_for_its_inflection_circle():
    drawing = drawn("four-bar", "inflection = [1]")[0]
    page = page_of(drawing)
    assert not [m for m in page.marks if getattr(m, "cls", "").startswith("inflection")]
    assert any("is its fixed pin" in s.markup for s in sentences(drawing))


def test_an_inflection_pole_at_infinity_is_told_by_its_sentence_alone():
    """With the crank square to the guide the rod does not turn, but begins to."""
    text = HEAD + SLIDER_CRANK.replace("angle = 60", "angle = 90") + "[ask]\ninflection = [2]\n"
    mechanism = Mechanism(read_text(text, "slider-crank", None, {}))
    drawing = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))[-1]
    told = "W2, the inflection pole of link 2, is at infinity"
    assert any(told in plain(said.markup) for said in sentences(drawing))
    notes = [m for m in page_of(drawing).marks if getattr(m, "name", "") == "note"]
    assert not any("infinity" in plain(note.markup) for note in notes)


@pytest.mark.parametrize("name", SCENES)
def test_every_line_and_point_of_a_centre_is_part_of_its_construction(name):
    ask = "centres = [1, 2, 3, 'all']\npoles = [1, 2, 3]\ninflection = [1, 2, 3]"
    steps = drawn(name, ask)[0].trace.program.steps
    own = [
        (number, step)
        for number, step in enumerate(steps)
        if step.part in (Part.CENTRE, Part.POLE) and step.plane is Plane.MECHANISM
    ]
    assert own
    assert all(getattr(construction(step), step.role) == number for number, step in own)


# --- centrodes and paths -------------------------------------------------------------------------


def nearest(curve: Curve, place: complex) -> tuple[float, complex]:
    """How far a curve passes from a place, and its direction there."""
    best = (float("inf"), 0j)
    for run in curve.runs:
        for a, b in pairwise(run):
            along = b - a
            share = ((place - a) * along.conjugate()).real / abs(along) ** 2 if along else 0.0
            foot = a + min(max(share, 0.0), 1.0) * along
            best = min(best, (abs(place - foot), along / abs(along) if along else 0j), key=first)
    return best


def first(pair: tuple[float, complex]) -> float:
    """The first of two."""
    return pair[0]


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "cardan"])
def test_centrodes_touch_in_the_instantaneous_centre(name):
    drawing = drawn(name, "velocity = ['A']\ncentrodes = [2]")[0]
    fixed, moving = drawing.curves
    assert (fixed.kind, moving.kind) == ("fixed-centrode", "moving-centrode")
    centre = drawing.place(drawing.trace.value("centre", "2"))
    found = [nearest(curve, centre) for curve in (fixed, moving)]
    assert max(away for away, _ in found) < 1e-4 * drawing.reach
    assert abs(cross(found[0][1], found[1][1])) < 0.01
    page_of(drawing)


def test_the_centrodes_of_cardans_cross_are_circles_of_radius_l_and_of_diameter_l():
    fixed, moving = drawn("cardan", "velocity = ['A']\ncentrodes = [2]")[0].curves
    out = [abs(z) for run in fixed.runs for z in run]
    middle = (0.1 - 0.1j) / 2 / 2**0.5
    about = [abs(z - middle) for run in moving.runs for z in run]
    assert out == pytest.approx([0.1] * len(out), rel=1e-9)
    assert about == pytest.approx([0.05] * len(about), rel=1e-9)
    ends = [min(run[0].imag, run[-1].imag, key=abs) for run in fixed.runs]
    assert all(abs(y) < 1e-3 for y in ends)
    assert fixed.now == pytest.approx((0.1 - 0.1j) / 2**0.5, rel=1e-9)


def test_a_straight_centrode_takes_no_room_from_the_mechanism():
    (drawing,) = drawings("centrodes-roller")
    fixed, moving = drawing.curves
    rail = [point for run in fixed.runs for point in run]
    assert is_straight(rail) and not is_straight([point for run in moving.runs for point in run])
    assert max(point.real for point in rail) > drawing.mechanism_extent().right
    assert drawing.scales.kL == 2
    (way,) = [m for m in page_of(drawing).marks if isinstance(m, Text) and m.name == "s 1"]
    lines = [m for m in page_of(drawing).marks if isinstance(m, LineMark) and m.name == "s 1"]
    assert plain(way.markup) == "s = 40 mm" and len([m for m in lines if m.cls == "drive"]) == 3


def test_the_path_of_a_crank_pin_is_its_circle_and_closes():
    (curve,) = drawn("slider-crank", 'velocity = ["B"]\ncurves = ["A"]')[0].curves
    assert curve.kind == "trajectory"
    (run,) = curve.runs
    assert run[0] == run[-1]
    assert [abs(z) for z in run] == pytest.approx([0.06] * len(run), rel=1e-12)


def test_paths_and_centrodes_are_drawn_and_named_on_the_velocity_sheet_only():
    ask = 'velocity = ["B"]\nacceleration = ["B"]\ncurves = ["A"]\ncentrodes = [2]'
    velocity, acceleration = drawn("slider-crank", ask)
    kinds = ("trajectory", "fixed-centrode", "moving-centrode")
    marks = [m for m in page_of(velocity).marks if isinstance(m, Polyline)]
    assert {m.cls for m in marks} >= set(kinds)
    assert names(page_of(velocity)) >= {"A", "2"} | set(kinds)
    assert not acceleration.curves
    assert not {getattr(m, "cls", "") for m in page_of(acceleration).marks} & set(kinds)


def test_nothing_is_swept_where_no_curve_is_asked():
    mechanism = Mechanism(read_text(f"{HEAD}{FOUR_BAR}[ask]\n{ALL}\n", "four-bar", None, {}))
    assert curves_of(mechanism) == ()


# --- curves in a field ---------------------------------------------------------------------------


def test_a_curve_is_cut_at_the_edge_of_its_field():
    rect = (0.0, 0.0, 10.0, 10.0)
    parts = list(clipped_path([(-5, 5), (5, 5), (5, 20), (8, 20), (8, 5)], rect, "ray", "x"))
    assert [part.points for part in parts] == [
        ((0.0, 5.0), (5.0, 5.0), (5.0, 10.0)),
        ((8.0, 10.0), (8.0, 5.0)),
    ]
    assert not list(clipped_path([(20, 20), (30, 30)], rect, "ray", "x"))


def test_only_corners_that_nobody_sees_are_left_out():
    rect = (0.0, 0.0, 200.0, 200.0)
    straight = [(float(x), 20.0) for x in range(10, 101)]
    (line,) = clipped_path([*straight, (100.0, 60.0)], rect, "ray", "x")
    assert line.points == ((10.0, 20.0), (100.0, 20.0), (100.0, 60.0))
    turn = [100 + 60 * ((-1) ** (i / 360)) for i in range(721)]
    points = [(point.real, 100 + point.imag) for point in turn]
    (circle,) = clipped_path(points, rect, "ray", "x")
    assert len(circle.points) < len(points) / 2
    kept = LineString(circle.points)
    assert max(kept.distance(Point(point)) for point in points) <= UNSEEN


def test_a_curve_is_named_at_a_share_of_its_length():
    part = Polyline(((0.0, 0.0), (80.0, 0.0), (80.0, 20.0)), "trajectory")
    assert middle_of(part, 0.5) == (50.0, 0.0)
    assert middle_of(part, 0.9) == (80.0, 10.0)
    assert middle_of(part, 1.0) == (80.0, 20.0)


@pytest.mark.parametrize("radius", [0.01, 1.0, 50.0])
def test_the_chords_of_a_drawn_circle_leave_it_by_less_than_a_line_is_wide(radius):
    mm = 1000.0
    around = ring(Round(0j, radius), mm)
    middles = [(a + b) / 2 for a, b in pairwise(around)]
    assert max(radius - abs(m) for m in middles) * mm < 0.1
