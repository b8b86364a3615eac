"""Diagrams by chords and strings, on paper and against closed forms and the exact course."""

from __future__ import annotations

import re
from functools import cache
from itertools import pairwise
from math import cos, pi, radians, sin, sqrt

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.construction.diagram_steps import (
    CHORD,
    by_tangents,
    differentiated,
    integrated,
    smooth,
)
from graphkin.documents.diagram_numbers import FollowerMotion, motion_of
from graphkin.documents.diagrams_sheet import (
    CHORDS,
    TANGENTS,
    Axes,
    RateMethod,
    axes_for,
    cost_of_rate,
    cost_of_second,
    derived_twice,
    force_courses,
    mean_ordinates,
    values_at,
)
from graphkin.documents.positions import positions_of
from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import CircleMark, LineMark, Page, Polyline, Text
from graphkin.mechanism import Mechanism, load
from graphkin.scene.model import StatedPositions
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
from graphkin.text.errors import SceneError
from tests.chosen import by_turns
from tests.documents.sheet_tools import mechanism_named
from tests.mechanisms import mechanism_of
from tests.motion.linkages import slider_crank
from tests.scene_files import scene_text

DRAWN = (
    *("crank-rocker", "shaper", "cam-roller", "gears-planet", "five-bar", "jumper"),
    "gears-three-planets",
)


def posed(mechanism: Mechanism, **ways: object) -> Mechanism:
    return Mechanism(replace(mechanism.scene, positions=StatedPositions(**ways)))


def sheets_of(mechanism: Mechanism, language: str = "en") -> dict[str, tuple[Page, ...]]:
    return {part.kind: part.pages for part in hand_out(mechanism, "diagrams", language)}


@cache
def sheets(name: str, language: str = "en") -> dict[str, tuple[Page, ...]]:
    return sheets_of(mechanism_named(name), language)


def named(page: Page, start: str) -> dict[str, LineMark]:
    return {m.name: m for m in page.marks if isinstance(m, LineMark) and m.name.startswith(start)}


def slope(line: LineMark) -> float:
    return -(line.y2 - line.y1) / (line.x2 - line.x1)


# --- the steps ------------------------------------------------------------------------------------


def test_chords_of_a_parabola_have_its_slope_in_the_middle():
    points = [(x, 2 + 3 * x - 0.5 * x * x) for x in (0.0, 1.0, 2.5, 4.0)]
    for step in differentiated(points, 7.0):
        x, height = step.found
        assert height == pytest.approx(7 * (3 - x))
        assert step.end == (0.0, height)


def test_the_error_of_a_chord_is_a_twenty_fourth_of_the_third_derivative():
    """Of x³ over steps h it is exactly h²/24 · 6."""
    h = 0.7
    points = [(h * i, (h * i) ** 3) for i in range(6)]
    for step in differentiated(points, 1.0):
        x, height = step.found
        assert height - 3 * x * x == pytest.approx(CHORD * h * h * 6)


def test_tangents_of_a_parabola_have_its_slope_at_their_points():
    points = [(0.5 * i, 2 + 3 * 0.5 * i - 0.5 * (0.5 * i) ** 2) for i in range(6)]
    found = by_tangents(points, 7.0)
    assert [step.found[0] for step in found] == [x for x, _ in points[1:-1]]
    for step in found:
        x, height = step.found
        assert height == pytest.approx(7 * (3 - x))
        (left, low), (right, high) = step.first, step.last
        assert (high - low) / (right - left) == pytest.approx(height / 7)


def test_tangents_of_a_whole_turn_close_on_themselves():
    """Of sin x over steps h they are cos x · sin h/h, at the ends too."""
    places = np.linspace(0, 2 * pi, 13)
    found = by_tangents([(x, sin(x)) for x in places], 1.0, closed=True)
    expected = [(x, cos(x) * sin(pi / 6) / (pi / 6)) for x in places]
    assert [step.found for step in found] == [pytest.approx(pair) for pair in expected]


def test_integration_takes_back_what_differentiation_gives():
    points = [(x, sin(x)) for x in np.linspace(0, 3, 8)]
    heights = [step.found[1] for step in differentiated(points, 12.0)]
    strings = integrated([x for x, _ in points], heights, 12.0, points[0][1])
    assert [step.last for step in strings] == [pytest.approx(p) for p in points[1:]]


def test_levels_leave_equal_areas_below_and_above_a_curve():
    points = [(x, sin(x) + 0.2 * x * x) for x in np.linspace(0, 3, 7)]
    levels = mean_ordinates(points, closed=False)
    through = np.array(smooth(points, chords=400))
    for level, ((x, _), (u, _)) in zip(levels, pairwise(points), strict=True):
        part = through[(through[:, 0] >= x - 1e-9) & (through[:, 0] <= u + 1e-9)]
        assert np.trapezoid(part[:, 1], part[:, 0]) == pytest.approx(level * (u - x), rel=1e-4)


def test_a_smooth_curve_runs_through_its_points():
    points = [(0.0, 1.0), (1.0, 3.0), (2.5, -1.0), (3.0, 0.0)]
    assert smooth(points, chords=5)[::5] == [pytest.approx(p) for p in points]


# --- on paper -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["cam-roller", "cam-knife", "offset-slider-crank"])
def test_every_pole_has_its_distance(name: str):
    """A short line has its distance below it, as a long one has."""
    for part in ("differentiation", "integration"):
        for page in sheets(name).get(part, ()):
            poles = [m for m in page.marks if isinstance(m, LineMark) and "pole dist" in m.name]
            said = {m.name: m.markup for m in page.marks if isinstance(m, Text)}
            assert poles
            for line in poles:
                length = abs(line.x2 - line.x1)
                assert said[line.name] == f"*H* = {length:g} mm"


def test_every_ray_is_parallel_to_its_chord():
    page, _ = sheets("crank-rocker")["differentiation"]
    for letter, count in (("ω", 12), ("ε", 12)):
        chords, rays = named(page, f"chord {letter}"), named(page, f"ray {letter}")
        assert len(rays) == count
        for i in range(count):
            chord, ray = chords[f"chord {letter}_{i}"], rays[f"ray {letter}_{i}"]
            assert slope(chord) == pytest.approx(slope(ray), abs=1e-9)


def test_every_ray_is_parallel_to_its_tangent():
    _, page = sheets("crank-rocker")["differentiation"]
    for letter in ("ω", "ε"):
        tangents, rays = named(page, f"tangent {letter}"), named(page, f"ray {letter}")
        assert len(tangents) == 13
        for name, ray in rays.items():
            tangent = tangents[name.replace("ray", "tangent")]
            assert slope(tangent) == pytest.approx(slope(ray), abs=1e-9)


def test_the_exact_course_and_the_values_of_the_plans_have_room():
    for page in sheets("crank-rocker")["differentiation"]:
        crosses = [m for m in page.marks if isinstance(m, LineMark) and m.cls.startswith("centre ")]
        assert len(crosses) == 2 * 2 * 13


def test_every_string_is_parallel_to_its_ray():
    (page,) = sheets_of(slider_crank(2, 5, 1))["integration"]
    rays = named(page, "ray ")
    nodes = [m for m in page.marks if isinstance(m, CircleMark) and m.cls == "point construction"]
    for i, (one, other) in enumerate(pairwise(nodes)):
        string = -(other.cy - one.cy) / (other.cx - one.cx)
        assert string == pytest.approx(slope(rays[f"ray {i}"]), abs=1e-9)


@pytest.mark.parametrize("name", ["shaper", "cam-roller", "gears-three-planets"])
def test_every_string_lies_in_its_diagram(name: str):
    """Those of a link that turns fully rise as far as any."""
    for page in sheets(name)["integration"]:
        axis = [m for m in page.marks if isinstance(m, LineMark) and m.name in ("axis ψ", "axis s")]
        low, top = max(m.y1 for m in axis), min(m.y2 for m in axis)
        nodes = [m for m in page.marks if isinstance(m, CircleMark) and "point con" in m.cls]
        assert len(nodes) == 1 + len(named(page, "ray "))
        assert all(top <= node.cy <= low for node in nodes)


def test_strings_of_a_whole_turn_are_said_to_have_turned_and_rounding_is_zero():
    (page,) = sheets("gears-three-planets")["integration"]
    said = [m.markup for m in page.marks if isinstance(m, Text)]
    assert any("by strings: 0 %" in each for each in said)
    assert any("360°" in each for each in said)
    for page in sheets("gears-three-planets")["differentiation"]:
        said = [m.markup for m in page.marks if isinstance(m, Text)]
        assert not [each for each in said if "forecast" in each and "·10" in each]
        assert any(": 0 % of" in each for each in said)


def test_the_curve_of_the_speed_is_whole_between_its_crosses():
    """The peak between two positions is higher than both."""
    mechanism = slider_crank(2, 2.2, 0.1)
    (page,) = sheets_of(posed(mechanism, count=6))["integration"]
    assert uncut(page, "velocity", "v")
    for page in sheets_of(posed(mechanism, count=6))["differentiation"]:
        assert uncut(page, "velocity", "v")
        assert uncut(page, "acceleration", "a")


def uncut(page: Page, look: str, name: str) -> bool:
    """Whether a curve is one piece and keeps clear of the edges of its diagram."""
    (run,) = [m for m in page.marks if isinstance(m, Polyline) and m.cls == look and m.name == name]
    edges = [y for m in named(page, "position ").values() for y in (m.y1, m.y2)]
    return not any(abs(y - edge) < 1e-6 for _, y in run.points for edge in edges)


def test_the_derived_scale_gives_the_mean_speed_of_each_interval():
    """Measured with the printed factors, a point is Δs·ω/Δφ by the closed form."""
    r, rod, e, pace = 2.0, 5.0, 1.0, 3.0
    page, _ = sheets_of(slider_crank(r, rod, e, speed=pace))["differentiation"]
    text = next(m.markup for m in page.marks if isinstance(m, Text) and "(m/s)/mm" in m.markup)
    k = float(text.partition(" (m/s)/mm")[0].rpartition("= ")[2])
    points = {m.name: m for m in page.marks if isinstance(m, CircleMark) and "point" in m.cls}
    zero = next(m.y1 for m in page.marks if isinstance(m, LineMark) and m.name == "axis v")
    scene = slider_crank(r, rod, e, speed=pace).scene
    first = float(scene.drivers[0].position.number(scene.values))

    def place(i: int) -> float:
        phi = radians(first + 30 * i)
        return r * cos(phi) + sqrt(rod**2 - (e - r * sin(phi)) ** 2)

    for i in range(12):
        mean = (place(i + 1) - place(i)) / (pi / 6) * pace
        assert (zero - points[f"v_{i}"].cy) * k == pytest.approx(mean, abs=2e-3 * pace * r)


def test_the_diagrams_of_a_driver_that_runs_backwards_run_with_its_motion():
    """Poles lie before the axis, and chords and plans agree in sign; the angle falls."""
    mechanism = slider_crank(2, 5, 1, speed=-3)
    page, _ = sheets_of(mechanism)["differentiation"]
    assert [m.markup for m in page.marks if getattr(m, "name", "") == "axis u"] == ["−*φ*"] * 3
    pole = next(m for m in page.marks if isinstance(m, CircleMark) and m.name == "P_v")
    ends = [m.x2 for m in named(page, "ray v").values()]
    assert all(pole.cx < x for x in ends)
    points = [m for m in page.marks if isinstance(m, CircleMark) and m.name.startswith("v_")]
    crosses = [m for m in page.marks if isinstance(m, LineMark) and m.name.startswith("v_")]
    by_x = sorted({((m.x1 + m.x2) / 2, (m.y1 + m.y2) / 2) for m in crosses})
    for point in points:
        near = np.interp(point.cx, [x for x, _ in by_x], [y for _, y in by_x])
        assert point.cy == pytest.approx(near, abs=6.0)
    (summed,) = sheets_of(mechanism)["integration"]
    nodes = [m for m in summed.marks if isinstance(m, CircleMark) and m.cls == "point construction"]
    rays = named(summed, "ray ")
    for i, (one, other) in enumerate(pairwise(nodes)):
        assert other.cx > one.cx
        string = -(other.cy - one.cy) / (other.cx - one.cx)
        assert string == pytest.approx(slope(rays[f"ray {i}"]), abs=1e-9)


def test_diagrams_over_a_backward_driver_are_those_of_the_mirrored_mechanism():
    """A crank-slider in line is its own mirror image, run the other way round."""
    pages = [
        sheets_of(slider_crank(2, 5, 0, angle=way * 20, speed=way * 3))["differentiation"]
        for way in (1, -1)
    ]
    for one, other in zip(*pages, strict=True):
        both = [
            [(m.name, m.cx, m.cy) for m in page.marks if isinstance(m, CircleMark)]
            for page in (one, other)
        ]
        assert [n for n, _, _ in both[0]] == [n for n, _, _ in both[1]]
        assert np.allclose([m[1:] for m in both[0]], [m[1:] for m in both[1]], atol=1e-6)


# --- what it costs --------------------------------------------------------------------------------


def motion(mechanism: Mechanism, count: int) -> FollowerMotion:
    found = motion_of(positions_of(posed(mechanism, count=count), words("en")))
    assert found is not None
    return found


def costs(moved: FollowerMotion, method: RateMethod = CHORDS):
    where = moved.place(moved.at)
    axes = axes_for(moved, 0.0, 60.0, where, np.inf)
    points = [axes.place(float(u), float(v)) for u, v in zip(moved.at, where, strict=True)]
    tops, exact = (0.0, 70.0, 140.0), values_at(moved, moved.fine)
    rate, again = derived_twice(moved, method, axes, points, tops, exact)
    return cost_of_rate(moved, rate), cost_of_second(moved, rate, again)


@pytest.mark.parametrize("method", [CHORDS, TANGENTS])
@pytest.mark.parametrize("name", ["crank-rocker", "shaper"])
def test_the_forecast_of_a_method_is_its_error(name: str, method: RateMethod):
    coarse, fine = (costs(motion(mechanism_named(name), count), method) for count in (24, 48))
    wide = 1 if method is CHORDS else 2  # the difference of two intervals, not of one
    for cost in fine:
        assert cost.chord == pytest.approx(cost.forecast, rel=0.05 * wide)
    for one, other in zip(coarse, fine, strict=True):
        assert one.chord == pytest.approx(one.forecast, rel=0.2 * wide)
        assert one.chord > 2.5 * other.chord
        assert other.pencil > (one.pencil if method is CHORDS else 0)


def test_derivatives_by_the_driver_are_those_of_the_closed_form():
    """The trammel-like s = r cos φ + sqrt(l² - r² sin² φ) by central differences of its own."""
    moved = motion(slider_crank(2, 5, 0), 12)
    at = np.array([40.0, 75.0, 200.0])

    def place(degrees: np.ndarray) -> np.ndarray:
        phi = np.radians(degrees)
        return 2 * np.cos(phi) + np.sqrt(25 - 4 * np.sin(phi) ** 2)

    h = np.degrees(0.02)
    ways = np.arange(-3, 4)
    rows = np.array([place(at + k * h) for k in ways])
    third = (rows[5] - 2 * rows[4] + 2 * rows[2] - rows[1]) / (2 * 0.02**3)
    fourth = (rows[5] - 4 * rows[4] + 6 * rows[3] - 4 * rows[2] + rows[1]) / 0.02**4
    found = moved.derivatives(at)
    assert found[2] == pytest.approx(third, rel=2e-3, abs=2e-3)
    assert found[3] == pytest.approx(fourth, rel=2e-2, abs=2e-2)


def test_an_accelerating_driver_is_compared_with_its_own_share_left_out():
    """a = ω²·s″ + ε·s′, and differentiating v by φ gives the first term alone."""
    scene = scene_text("documents/slider-crank").replace("speed = 3", "speed = 3\nacceleration = 5")
    moved = motion(mechanism_of(scene), 12)
    first, second = moved.derivatives(moved.at)[:2]
    assert values_at(moved, moved.at)[2] == pytest.approx(9 * second, rel=1e-9, abs=1e-9)
    assert moved.rates(moved.at)[1] == pytest.approx(9 * second + 5 * first, rel=1e-9, abs=1e-9)


# --- jerk and mechanical advantage ----------------------------------------------------------------


def test_the_jerk_of_a_cam_is_that_of_its_law():
    """A cycloidal rise of 20 mm to 120°: ω³·h·4π²/β³·cos(2πθ/β); in the dwell after it, none."""
    moved = motion(mechanism_named("cam-roller"), 12)
    pace, beta = 300 * pi / 30, radians(120)
    at = np.array([15.0, 55.0, 100.0])
    law = pace**3 * 0.02 * 4 * pi**2 / beta**3 * np.cos(2 * pi * np.radians(at) / beta)
    assert moved.third(at) == pytest.approx(law, rel=1e-4)
    assert moved.third(np.array([150.0])) == pytest.approx(0.0, abs=1e-3 * law.max())


def test_no_jerk_is_told_where_the_acceleration_jumps():
    """A harmonic rise begins with a jump of the acceleration."""
    moved = motion(mechanism_named("cam-rocker"), 12)
    assert np.isnan(moved.third(np.array([0.0, 140.0]))).all()
    assert np.isfinite(moved.third(np.array([70.0, 170.0]))).all()


def test_a_wheel_at_constant_speed_has_no_jerk():
    """What is left of its differences is rounding."""
    moved = motion(mechanism_named("gears-pair"), 12)
    assert (moved.third(np.linspace(1.0, 300.0, 50)) == 0).all()


def test_the_diagrams_show_each_asked_force_once_over_the_driver():
    """They are those of single positions, with a cross at each position of the sheet."""
    mechanism = Mechanism(read_text(scene_text("motion/press"), "press"))
    found = positions_of(mechanism, words("en"))
    at = found.planned_places
    fine = np.linspace(at[0], at[-1], 25)
    every = {each.name: each for each in force_courses(found, at, fine)}
    assert every.keys() == {"R_12", "R_03", "M_b1"}
    for k in (1, 7, 20):
        solved, _ = found.cycle.path.ranges[0][0].course.mechanism(float(fine[k])).forces()
        (balance,) = solved.balance
        assert every["M_b1"].fine[k] == pytest.approx(balance.moment, rel=1e-9)
    assert (every["R_12"].fine >= 0).all()
    page = sheets_of(mechanism)["courses"][0]
    axes = [m.name for m in page.marks if isinstance(m, Text) and m.name.startswith("axis ")]
    for name in every:
        assert axes.count(f"axis {name}") == 1


def test_the_mechanical_advantage_balances_the_power():
    """Of a slider-crank: torque ω equals force v, with v by the closed form."""
    moved = motion(slider_crank(2, 5, 0, speed=3), 12)
    at = np.array([40.0, 100.0])
    phi = np.radians(at)
    v = -2 * np.sin(phi) - 4 * np.sin(phi) * np.cos(phi) / np.sqrt(25 - 4 * np.sin(phi) ** 2)
    assert moved.advantage(at) == pytest.approx(np.abs(1 / v), rel=1e-9)


# --- all kinds of mechanisms ----------------------------------------------------------------------


@pytest.mark.parametrize(("name", "language"), by_turns(DRAWN, LANGUAGES))
def test_diagrams_stay_on_the_page_in_every_language(name: str, language: str):
    found = sheets(name, language)
    assert "courses" in found
    for page in (page for pages in found.values() for page in pages):
        page.check()
        assert page.lang == language


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_sentences_of_a_sheet_end_above_the_residual_check(language):
    """Also the long ones on tangents, which German needs nine lines for."""
    mechanism = mechanism_named("shaper")
    for pages in sheets_of(mechanism, language).values():
        for page in pages:
            texts = [mark for mark in page.marks if isinstance(mark, Text)]
            (proof,) = (text.y for text in texts if text.name == "witness")
            said = [text.y for text in texts if text.name == "sentence"]
            assert max(said, default=0.0) < proof - 2.3


def test_a_point_that_keeps_its_line_has_no_hodograph():
    """Only the pump's piston D is asked: its velocity is a line; A's keeps its length."""
    page, _ = sheets_of(load("pump"))["hodographs"]
    named = {mark.name for mark in page.marks if mark.name.startswith("hodograph ")}
    assert named == {"hodograph B", "hodograph C"}


def test_hodographs_have_the_velocities_of_the_positions():
    page, _ = sheets("crank-rocker")["hodographs"]
    texts = " ".join(m.markup for m in page.marks if isinstance(m, Text))
    k = float(re.findall(r"\*k\*_v = ([\d.]+)", texts)[0])
    circles = {m.name: complex(m.cx, -m.cy) for m in page.marks if isinstance(m, CircleMark)}
    for i in range(12):
        solved = load(str(mechanism_named("crank-rocker").scene.source), n=(4 + 2 * i) % 24).solve()
        for point in ("B", "P"):
            drawn = circles[f"v_{point},{i}"] - circles[f"pole {point}"]
            assert drawn * k == pytest.approx(solved.points[point].velocity, rel=1e-3, abs=1e-4)


def test_a_mechanism_without_followers_and_requests_is_refused():
    scene = """
[frame]
O = [0, 0]
[links.1]
O-A = 2
[[drivers]]
turn = 1
angle = 40
speed = 3
[ask]
poles = [1]
"""
    with pytest.raises(SceneError, match="nothing follows the driver"):
        hand_out(mechanism_of(scene), "diagrams", "en")


def test_axes_put_zero_where_it_belongs():
    axes = Axes((10.0, 0.0, 110.0, 60.0), 30.0, 2.0, 5.0, 1.0)
    assert axes.on_page(axes.place(1.0, 0.0)) == (10.0, 30.0)
    assert axes.on_page(axes.place(2.0, 1.0)) == (12.0, 25.0)


EPICYCLIC = """
graphkin = 1
title = "Planetary gear"
units = { length = "mm", angle = "deg", speed = "rev/min" }

[frame]
O = [0, 0]
wheel = { centre = "O", teeth = 72, inside = true }

[links.planet]
P = [0,0]
wheel = { centre = "P", teeth = 24 }
rolls = [{ on = "sun", link = "arm" }, { on = 0 }]

[links.sun]
O = [0, 0]
wheel = { centre = "O", teeth = 24 }

[[drivers]]
turn = "sun"
angle = 20
speed = 1400

[ask]
omega = ["arm", "planet"]
"""


@pytest.mark.parametrize("language", LANGUAGES)
def test_an_acceleration_of_zero_has_no_share_of_its_largest_value_and_no_numbers(language):
    """The arm of a planetary gear at constant speed."""
    spoken = words(language)
    mechanism = Mechanism(read_text(EPICYCLIC, "epicyclic"))
    pages = sheets_of(mechanism, language)["differentiation"]
    assert len(pages) == 2
    for page in pages:
        texts = [mark for mark in page.marks if isinstance(mark, Text)]
        assert not [mark.markup for mark in texts if ">100" in mark.markup]
        assert spoken("diagrams.zero", v="ε") in [mark.markup for mark in texts]
        assert spoken("diagrams.zero", v="ω") not in [mark.markup for mark in texts]
        lines = [m for m in page.marks if isinstance(m, LineMark)]
        ticks = {
            n: [m for m in lines if m.name == f"axis {n}" and abs(m.x1 - m.x2) < 3] for n in "ωε"
        }
        assert len(ticks["ω"]) > 1
        assert len(ticks["ε"]) == 1


def test_numbers_of_positions_are_clear_of_the_name_of_an_axis():
    """Those of a link that only turns clockwise lie above its values, next to the name."""
    scene = EPICYCLIC.replace("speed = 1400", "speed = -1400")
    (page,) = sheets_of(Mechanism(read_text(scene, "epicyclic")))["courses"]
    texts = [mark for mark in page.marks if isinstance(mark, Text)]
    numbers = [box_of(mark) for mark in texts if mark.name.startswith("position ")]
    titles = [box_of(mark) for mark in texts if mark.name.startswith("axis ω")]
    assert len(titles) == 2
    for left, top, right, low in titles:
        for a, b, c, d in numbers:
            assert c < left or right < a or d < top or low < b


def box_of(text: Text) -> tuple[float, float, float, float]:
    xs, ys = zip(*text.corners(), strict=True)
    return min(xs), min(ys), max(xs), max(ys)


GEARED = """
graphkin = 1
title = "Double crank beside a wheel"
units = { length = "mm", angle = "deg", speed = "rev/min" }
module = 4

[frame]
O = [0, 0]
Q = [30, 0]
R = [0, -120]

[links.1]
O-A = 90
wheel = { centre = "O", teeth = 40 }

[links.2]
A-B = 100

[links.3]
Q-B = 95

[links.4]
R-D = 30
wheel = { centre = "R", teeth = 20 }
rolls = { on = 1, start = { 1 = 0, 4 = 30 } }

[[drivers]]
turn = 1
angle = 60
speed = 100

[branches]
B = "left of A-Q"

[ask]
omega = [3, 4]
"""


def test_the_diagrams_show_the_last_follower_that_is_not_uniform():
    moved = motion(Mechanism(read_text(GEARED, "geared")), 12)
    assert moved.mover.name == "3"
    only = motion(mechanism_named("gears-three-planets"), 12)
    assert only.mover.name == "2"
