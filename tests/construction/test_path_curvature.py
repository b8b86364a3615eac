"""Laws of the centre of curvature of a point's path (Hartenberg and Denavit, chapter 7).

A pin of a crank goes round its pivot, a point of Cardan's bar on an ellipse, a point of a rolling
rim on a cycloid; any other point as the circle through three places near one another.
"""

from __future__ import annotations

import re
from math import cos, hypot, pi, radians, sin

import pytest
from msgspec.structs import replace

from graphkin.cli.report.solution_record import record
from graphkin.construction.core.solution import Solution
from graphkin.documents.centre_tables import breadth_of, place_of
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import Ratio, cross
from graphkin.text import words
from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text

FOUR_BAR = """[frame]
O1 = [0, 0]
O2 = [0.15, 0]
[links.1]
O1-A = 0.06
[links.2]
A-B = 0.13
A-P = 0.08
B-P = 0.09
P = "left of A-B"
[links.3]
O2-B = 0.11
[[drivers]]
turn = 1
angle = {angle}
speed = {speed}
acceleration = {acceleration}
[branches]
B = "left of A-O2"
[ask]
curvature = ["A", "B", "P"]
inflection = [2]
velocity = ["P"]
"""


def four_bar(angle: float = 70, speed: float = 2, acceleration: float = 5) -> Mechanism:
    """The four-bar in one position and motion."""
    return mechanism_of(FOUR_BAR.format(angle=angle, speed=speed, acceleration=acceleration))


def centre(solution: Solution, point: str) -> complex | None:
    """The centre of curvature of a point's path; None for a straight path."""
    return place_of(solution.points[point].curvature_centre, breadth_of(solution))


def circle_through(a: complex, b: complex, c: complex) -> complex:
    """The centre of the circle through three points."""
    p, q = b - a, c - a
    return a + 1j * (p * abs(q) ** 2 - q * abs(p) ** 2) / (2 * cross(p, q))


@pytest.mark.parametrize("angle", [0, 70, 200, 310])
def test_pins_of_crank_and_rocker_go_round_their_pivots(angle):
    solution = four_bar(angle).solve()
    assert centre(solution, "A") == pytest.approx(0, abs=1e-12)
    assert centre(solution, "B") == pytest.approx(0.15, abs=1e-12)


@pytest.mark.parametrize("angle", [20, 70, 200, 310])
def test_a_path_is_near_its_circle_of_curvature(angle):
    """The circle through three neighbouring places, which no velocity enters."""
    step = 1e-3
    near = [four_bar(angle + n * step).solve().points["P"].position for n in (-1, 0, 1)]
    found = centre(four_bar(angle).solve(), "P")
    assert found == pytest.approx(circle_through(*near), rel=1e-4)


@pytest.mark.parametrize(("speed", "acceleration"), [(-2, 5), (0.01, 80), (300, -1e4)])
def test_the_centre_is_of_the_path_and_no_matter_of_its_motion(speed, acceleration):
    moved = centre(four_bar(70, speed, acceleration).solve(), "P")
    assert moved == pytest.approx(centre(four_bar().solve(), "P"), abs=1e-11)


@pytest.mark.parametrize("angle", [20, 70, 310])
def test_it_is_where_the_inflection_circle_puts_it(angle):
    """Euler and Savary: PI² = PΩ·PW, W the second point of the normal on the inflection circle."""
    solution = four_bar(angle).solve()
    link, breadth = solution.links["2"], breadth_of(solution)
    i, j = (place_of(each, breadth) for each in (link.instant_centre, link.inflection_pole))
    p = solution.points["P"].position
    ray = (i - p) / abs(i - p)
    w = i + ray * ((j - i) / ray).real
    assert centre(solution, "P") == pytest.approx(p + (i - p) ** 2 / (w - p), abs=1e-10)


CARDAN = scene_text("construction/cardan").replace("B-A = 100", 'B-A = 100\nB-C = 30\nC = "on B-A"')


def test_cardans_bar_draws_an_ellipse():
    """ρ = (a²·sin²t + b²·cos²t)^(3/2)/(a·b) of x = a·cos t, y = b·sin t."""
    solution = mechanism_of(CARDAN + '[ask]\ncurvature = ["C", "A", "B"]\n').solve()
    a, b, t = 30, 70, radians(-45)
    p = solution.points["C"].position
    assert p == pytest.approx(complex(a * cos(t), b * sin(t)))
    found = centre(solution, "C")
    assert found is not None
    assert abs(found - p) == pytest.approx(hypot(a * sin(t), b * cos(t)) ** 3 / (a * b))
    assert centre(solution, "A") is None and centre(solution, "B") is None


ROLLING = """[frame]
O = [0, 0]
[links.1]
C = [0, 0]
P = [0, -2]
wheel = {{ centre = "C", radius = 2 }}
rolls = {{ on = 0, through = "O", angle = 0, start = {{ 1 = 0 }} }}
[[drivers]]
turn = 1
angle = {angle}
speed = 3
[ask]
curvature = ["P", "C"]
"""


@pytest.mark.parametrize("turned", [40, 90, 180, 300])
def test_a_point_of_a_rolling_rim_draws_a_cycloid(turned):
    """ρ = 4·r·sin(θ/2): twice the chord to the contact, which is halfway to the centre."""
    solution = mechanism_of(ROLLING.format(angle=-turned)).solve()
    p = solution.points["P"].position
    found = centre(solution, "P")
    assert found is not None
    assert abs(found - p) == pytest.approx(4 * 2 * sin(radians(turned) / 2))
    assert (found + p) / 2 == pytest.approx(complex(2 * turned * pi / 180, 0), abs=1e-12)
    assert centre(solution, "C") is None


def test_the_record_has_centre_and_radius_or_null():
    mechanism = mechanism_of(ROLLING.format(angle=-90))
    solution = mechanism.solve()
    points = record(mechanism.scene, solution, None, None)["points"]
    assert points["P"]["curvature"]["radius"] == pytest.approx(4 * 2 * sin(pi / 4))
    assert points["C"]["curvature"] is None
    assert mechanism.witness(solution).agrees


def test_a_point_at_rest_has_no_centre():
    mechanism = four_bar(speed=0, acceleration=3)
    assert centre(mechanism.solve(), "P") is None
    assert mechanism.witness(mechanism.solve()).agrees


def test_the_loops_find_a_centre_out_that_is_a_little_off():
    mechanism = four_bar()
    solution = mechanism.solve()
    own = solution.points["P"]
    start, shift, size = own.curvature_centre
    for times in (1 + 1e-6, -1, 1 + 1e-6j):
        wrong = replace(own, curvature_centre=Ratio(start, times * shift, size))
        points = {**solution.points, "P": wrong}
        assert not mechanism.witness(replace(solution, points=points)).agrees


REASON = re.compile(r"\((?P<m>[\d.]+)·\*k\*_v\)\^2 = \*k\*_L·(?P<n>[\d.]+)·\*k\*_a")


@pytest.mark.parametrize("language", ["en", "ro", "it"])
def test_a_sheet_says_once_why_the_vectors_are_divided(language):
    """v²/a of the drawn lengths is a length at the mechanism's scale: the printed scales say so."""
    mechanism = four_bar(speed=4)
    solution = mechanism.solve()
    drawing = drawings_of(mechanism, mechanism.witness(solution), words(language), None)[1]
    said = [each.markup.replace(",", ".") for each in sentences(drawing)]
    (found,) = [match for each in said if (match := REASON.search(each))]
    m, n, scales = float(found["m"]), float(found["n"]), drawing.scales
    assert (m * scales.kv) ** 2 == pytest.approx(scales.kL * n * scales.ka)
    assert any(f"/{found['m']}" in each for each in said) and m != 1 != n
    speed, across = abs(solution.points["P"].velocity), curved(solution, "P")
    drawn = (speed / scales.kv / m) ** 2 / (across / scales.ka / n)
    place = solution.points["P"].position
    assert drawn * scales.kL == pytest.approx(abs(centre(solution, "P") - place))


def curved(solution: Solution, point: str) -> float:
    """The component of a point's acceleration across its path, in m/s²."""
    motion = solution.points[point]
    return abs(cross(motion.velocity, motion.acceleration)) / abs(motion.velocity)
