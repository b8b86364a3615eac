"""Centres by Kennedy's lines, the inflection circle, centrodes and paths on the sheet."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from math import hypot

import pytest
from shapely import LineString, Point

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.paper_canvas import UNSEEN, clipped_path, middle_of, ring
from graphkin.construction.core.solution import Curve
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.field import Field
from graphkin.drawing.marks import Page, Polyline, Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import Circle as Round
from graphkin.numbers.plane import cross
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.scene_files import scene_text

HEAD = """graphkin = 1
title = "centres"
units = { length = "mm", angle = "deg", speed = "rad/s" }
"""
FOUR_BAR = scene_text("construction/four-bar-150")
SLIDER_CRANK = scene_text("construction/slider-crank-60")
CARDAN = scene_text("construction/cardan")
NEAR = scene_text("construction/four-bar-110")
SCENES = {"near": NEAR, "four-bar": FOUR_BAR, "slider-crank": SLIDER_CRANK, "cardan": CARDAN}
ALL = 'centres = "all"'


@cache
def drawn(name: str, ask: str) -> tuple[Drawing, ...]:
    """The material of a scene's sheets."""
    mechanism = Mechanism(read_text(f"{HEAD}{SCENES[name]}[ask]\n{ask}\n", name, None, {}))
    return tuple(drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en")))


def page_of(drawing: Drawing, view: str = "key") -> Page:
    """A sheet, which must fit."""
    page = sheet(drawing, view, "1/1")[0]
    page.check()
    return page


def field_of(drawing: Drawing) -> Field:
    """The mechanism's field."""
    return lay_out(drawing).mechanism


# --- relative centres ----------------------------------------------------------------------------


def test_a_task_sheet_gives_no_centre_away():
    page = page_of(drawn("four-bar", ALL)[0], "task")
    assert not [m for m in page.marks if getattr(m, "name", "").startswith("I")]
    told = " ".join(m.markup for m in page.marks if isinstance(m, Text))
    assert "Kennedy" in told


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
    number, circle = next((n, v) for n, s, v in drawing.on_mechanism if s.name == "inflection 2")
    arcs = [m for m in page.marks if isinstance(m, Polyline) and m.step == number]
    assert arcs
    x, y = field(circle.centre)
    away = [hypot(u - x, v - y) for arc in arcs for u, v in arc.points[1:-1]]
    assert away == pytest.approx([circle.radius * field.mm] * len(away), abs=1e-6)
    for name in ("I2", "W2"):
        ratio = next(v for _, s, v in drawing.on_mechanism if s.name == name)
        assert abs(drawing.place(ratio) - circle.centre) == pytest.approx(circle.radius, rel=1e-9)


def test_an_inflection_pole_at_infinity_is_told_by_its_sentence_alone():
    """With the crank square to the guide the rod does not turn, but begins to."""
    text = HEAD + SLIDER_CRANK.replace("angle = 60", "angle = 90") + "[ask]\ninflection = [2]\n"
    mechanism = Mechanism(read_text(text, "slider-crank", None, {}))
    drawing = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))[-1]
    told = "W2, the inflection pole of link 2, is at infinity"
    assert any(told in plain(said.markup) for said in sentences(drawing))
    notes = [m for m in page_of(drawing).marks if getattr(m, "name", "") == "note"]
    assert not any("infinity" in plain(note.markup) for note in notes)


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


# --- curves in a field ---------------------------------------------------------------------------


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
    assert middle_of(part, 1.0) == middle_of(part, 1 + 1e-12) == (80.0, 20.0)


@pytest.mark.parametrize("radius", [0.01, 1.0, 50.0])
def test_the_chords_of_a_drawn_circle_leave_it_by_less_than_a_line_is_wide(radius):
    mm = 1000.0
    around = ring(Round(0j, radius), mm)
    middles = [(a + b) / 2 for a, b in pairwise(around)]
    assert max(radius - abs(m) for m in middles) * mm < 0.1
