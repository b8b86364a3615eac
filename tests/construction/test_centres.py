"""Laws of relative centres (Kennedy, Aronhold) and of the inflection circle (Euler, Savary)."""

from __future__ import annotations

from cmath import exp
from collections import Counter
from itertools import combinations
from math import hypot, pi

import pytest
from hypothesis import given, settings
from msgspec.structs import replace

from graphkin.construction.centres.instant_centre import (
    LineOfCentres,
    RelativeCentre,
    velocity_normal,
)
from graphkin.construction.core.program import Part
from graphkin.construction.core.solution import Solution
from graphkin.documents.centre_tables import breadth_of, place_of
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import Ratio, cross, dot
from tests.mechanisms import LAW, mechanism_of, mechanisms, shipped
from tests.scene_files import scene_text

FIVE_BAR = scene_text("construction/five-bar")
ALL = 'centres = "all"'
NEAR = 1e-9


def test_the_ray_to_a_centre_is_square_to_a_velocity_from_wherever_the_plan_has_its_pole():
    """A hand puts the pole where it hits it, and measures from there."""
    for pole in (0, 3 - 1j, -40 + 7j):
        ray = velocity_normal(1 + 2j, pole, pole + 2 + 5j)
        assert ray.point == 1 + 2j
        assert dot(ray.along, 2 + 5j) == 0 and ray.along != 0


def four_bar(ask: str, angle: float = 75, speed: float = 12, acceleration: float = 0) -> Mechanism:
    """The four-bar in one position."""
    values = {"angle": angle, "speed": speed, "acceleration": acceleration}
    return mechanism_of(scene_text("construction/four-bar-with-a-plate", **values) + ask)


def slider_crank(ask: str, angle: float) -> Mechanism:
    """The slider-crank in one position."""
    return mechanism_of(scene_text("construction/slider-crank-with-a-plate", angle=angle) + ask)


def motion_of(
    mechanism: Mechanism, solution: Solution, link: str
) -> tuple[complex, complex, float]:
    """Place and velocity of the last known point of a link, and its angular velocity."""
    if link == "0":
        return 1 + 1j, 0j, 0.0
    points = [p for p in mechanism.scene.links[link].points if p in solution.points]
    point, omega = solution.points[points[-1]], solution.links[link].omega
    assert point.position is not None and point.velocity is not None and omega is not None
    return point.position, point.velocity, omega


def breadth(solution: Solution) -> float:
    """The largest distance of two points."""
    places = [point.position for point in solution.points.values()]
    return max(abs(p - q) for p, q in combinations(places, 2))


def homogeneous(ratio: Ratio, size: float) -> tuple[float, float, float]:
    """A centre in homogeneous coordinates of length one, lengths in units of ``size``."""
    way = (ratio.start * ratio.size + ratio.shift) / size
    length = hypot(abs(way), ratio.size)
    return way.real / length, way.imag / length, ratio.size / length


def as_one(mechanism: Mechanism, solution: Solution, name: str) -> bool:
    """True for two links that only rounding moves against each other: every point is a centre."""
    (p, v, w), (q, u, x) = (motion_of(mechanism, solution, k) for k in name.split("-"))
    size = breadth(solution)
    reach = max(abs(link.omega) for link in solution.links.values())
    apart = abs(v - u - 1j * x * (p - q)) + abs(w - x) * size
    return apart <= NEAR * reach * (size + abs(p - q))


# --- relative centres ----------------------------------------------------------------------------


@settings(LAW)
@given(mechanisms())
def test_two_links_have_one_velocity_at_their_centre(made):
    mechanism = mechanism_of(made.text() + f"[ask]\n{ALL}\n")
    solution = mechanism.solve()
    n = len(mechanism.scene.links) + 1
    assert len(solution.centres) == n * (n - 1) // 2
    size = breadth(solution)
    for name, ratio in solution.centres.items():
        (p, v, w), (q, u, x) = (motion_of(mechanism, solution, k) for k in name.split("-"))
        reach = abs(w) + abs(x) + (abs(v) + abs(u)) / size
        if ratio.size == 0:
            apart = (v - 1j * w * p) - (u - 1j * x * q)
            assert abs(dot(apart, ratio.shift)) <= NEAR * reach * size * abs(ratio.shift)
            assert abs(w - x) <= NEAR * reach
            continue
        place = ratio.start + ratio.shift / ratio.size
        apart = (v + 1j * w * (place - p)) - (u + 1j * x * (place - q))
        assert abs(apart) <= NEAR * reach * (size + abs(place))


@settings(LAW)
@given(mechanisms())
def test_the_centres_of_any_three_links_lie_on_one_line(made):
    mechanism = mechanism_of(made.text() + f"[ask]\n{ALL}\n")
    solution = mechanism.solve()
    size = breadth(solution)
    for i, j, k in combinations(("0", *mechanism.scene.links), 3):
        names = (f"{i}-{j}", f"{j}-{k}", f"{i}-{k}")
        if any(as_one(mechanism, solution, name) for name in names):
            continue
        a, b, c = (homogeneous(solution.centres[name], size) for name in names)
        area = (
            a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
        )
        assert abs(area) <= NEAR


@settings(LAW)
@given(mechanisms())
def test_lines_of_centres_meet_where_the_velocities_say(made):
    mechanism = mechanism_of(made.text() + f"[ask]\n{ALL}\n")
    solution = mechanism.solve()
    size = breadth(solution)
    trace = mechanism.trace(mechanism.asked(), by_hand=True)
    for number, value in trace.values.items():
        step = mechanism.program.steps[number]
        if step.part is not Part.CENTRE or step.by_hand not in trace.values:
            continue
        if as_one(mechanism, solution, f"{step.of.first}-{step.of.link}"):
            continue
        hand = homogeneous(trace.values[step.by_hand], size)
        velocities = homogeneous(value, size)
        apart = [
            hand[1] * velocities[2] - hand[2] * velocities[1],
            hand[2] * velocities[0] - hand[0] * velocities[2],
            hand[0] * velocities[1] - hand[1] * velocities[0],
        ]
        assert hypot(*apart) <= 1e-8


def test_all_six_centres_of_a_four_bar_are_found_by_hand():
    mechanism = four_bar(ALL)
    trace = mechanism.trace(mechanism.asked(), by_hand=True)
    steps = [mechanism.program.steps[number] for number in trace.values]
    assert [s.name for s in steps if s.action and s.action.key == "pin-centre"] == [
        "I01",
        "I12",
        "I03",
        "I23",
    ]
    lines = [s.of.letters for s in steps if isinstance(s.of, LineOfCentres)]
    assert lines == [("I01", "I12"), ("I03", "I23"), ("I01", "I03"), ("I12", "I23")]


def test_all_centres_of_the_pump_are_found_by_two_lines_or_at_once():
    """Six links have fifteen centres: six pins, a guide, and eight by Kennedy."""
    scene = shipped("pump", 7).scene
    pairs = tuple("-".join(pair) for pair in combinations(("0", *scene.links), 2))
    mechanism = Mechanism(replace(scene, ask=replace(scene.ask, pairs=pairs)))
    trace = mechanism.trace([("centre", pair) for pair in pairs], by_hand=True)
    keys = Counter(
        step.action.key
        for step in (mechanism.program.steps[number] for number in trace.values)
        if step.part is Part.CENTRE and step.action
    )
    assert (keys["pin-centre"], keys["guide-centre"]) == (6, 1)
    assert keys["relative-centre"] == keys["kennedy-meet"] == 8
    assert keys["kennedy-line"] == 16


@pytest.mark.parametrize("name", ["pump", "slotted-lever"])
def test_a_line_of_centres_leads_through_the_point_of_a_centre_that_does_not_stand_aside(name):
    """Off the sheet, an arrow along that line shows it; one aside gets a ray of its own."""
    scene = shipped(name, 7).scene
    pairs = tuple("-".join(pair) for pair in combinations(("0", *scene.links), 2))
    mechanism = Mechanism(replace(scene, ask=replace(scene.ask, pairs=pairs)))
    trace = mechanism.trace([("centre", pair) for pair in pairs], by_hand=True)
    aside = set()
    for number, value in trace.values.items():
        kind = mechanism.program.steps[number].of
        if not isinstance(kind, RelativeCentre) or kind.crossing is None:
            continue
        lines = [trace.values[way.line] for way in kind.ways]
        through = [
            abs(cross(line.along, value.start - line.point)) < 1e-9 * abs(line.along)
            for line in lines
        ]
        assert kind.aside or any(through)
        aside.add(kind.aside)
    assert aside == ({False} if name == "pump" else {False, True})


def test_where_the_circle_diagram_stops_the_velocity_plan_gives_a_centre():
    """A five-bar has no two triangles that share a missing side; one centre comes by normals."""
    mechanism = mechanism_of(FIVE_BAR)
    trace = mechanism.trace([("centre", f"0-{k}") for k in (2, 3)], by_hand=True)
    hands = [
        mechanism.program.steps[step.by_hand].action.key
        for step in (mechanism.program.steps[number] for number in trace.values)
        if step.action and step.action.key == "relative-centre" and step.by_hand in trace.values
    ]
    assert sorted(hands) == ["kennedy-meet", "normals-meet"]
    for number, value in trace.values.items():
        step = mechanism.program.steps[number]
        if step.by_hand in trace.values and step.part is Part.CENTRE:
            drawn = place_of(trace.values[step.by_hand], 1.0)
            assert drawn == pytest.approx(place_of(value, 1.0), rel=1e-9)


def test_the_velocity_ratio_is_that_of_the_distances_to_the_relative_centre():
    solution = four_bar('centres = ["1-3"]').solve()
    centre = place_of(solution.centres["1-3"], 1.0)
    assert centre is not None and set(solution.centres) == {"1-3"}
    to_crank, to_rocker = (centre - solution.points[p].position for p in ("O1", "O2"))
    ratio = solution.links["3"].omega / solution.links["1"].omega
    assert ratio * to_rocker == pytest.approx(to_crank, rel=1e-12)


def test_a_slider_crank_has_its_sixth_centre_square_over_the_crank_pivot():
    mechanism = slider_crank(ALL, 60)
    solution = mechanism.solve()
    rod, pin = (solution.points[p].position for p in ("A", "B"))
    over = rod + (pin - rod) * (0 - rod.real) / (pin - rod).real
    assert place_of(solution.centres["1-3"], 1.0) == pytest.approx(over, rel=1e-12)
    assert place_of(solution.centres["0-3"], 1.0) is None
    assert solution.centres["0-3"].shift.real == 0


def test_in_a_parallelogram_the_coupler_has_its_centre_against_the_frame_at_infinity():
    numbers = {"angle": 70, "speed": 3, "acceleration": 0}
    text = scene_text("construction/four-bar-with-a-plate", **numbers) + ALL
    text = text.replace("[2.5, 0.3]", "[2, 0]").replace("A-B = 2.3", "A-B = 2")
    mechanism = mechanism_of(text.replace("O2-B = 1.6", "O2-B = 0.8"))
    solution = mechanism.solve()
    assert place_of(solution.centres["0-2"], 1.0) is None
    assert place_of(solution.centres["1-3"], 1.0) is None
    crank, coupler = exp(1j * pi * 70 / 180), 1.0
    assert abs(cross(solution.centres["0-2"].shift, crank)) < 1e-12
    assert abs(cross(solution.centres["1-3"].shift, coupler)) < 1e-12


# --- the inflection circle -----------------------------------------------------------------------


def circle_of(mechanism: Mechanism, link: str) -> tuple[complex, float]:
    """Centre and radius of a link's inflection circle, from the solution."""
    motion = mechanism.solve().links[link]
    i, w = (place_of(r, 1.0) for r in (motion.instant_centre, motion.inflection_pole))
    return (i + w) / 2, abs(w - i) / 2


@pytest.mark.parametrize("acceleration", [0, 70, -200])
@pytest.mark.parametrize("angle", [20, 75, 140, 233])
def test_points_of_the_inflection_circle_accelerate_along_their_velocity(angle, acceleration):
    mechanism = four_bar("inflection = [2]", angle, -7, acceleration)
    solution = mechanism.solve()
    base, link = solution.points["C"], solution.links["2"]
    centre, radius = circle_of(mechanism, "2")
    for k in range(12):
        way = centre + radius * exp(2j * pi * k / 12) - base.position
        velocity = base.velocity + 1j * link.omega * way
        acceleration_there = base.acceleration + (1j * link.epsilon - link.omega**2) * way
        size = abs(velocity) * abs(acceleration_there) + abs(link.omega) ** 3 * radius**2
        assert abs(cross(velocity, acceleration_there)) <= 1e-11 * size


def test_points_of_the_inflection_circle_move_straight_by_differences_of_sixty_digits():
    """The coupler of a four-bar carried on a little, positions from circles in mpmath alone."""
    import mpmath as mp

    centre, radius = circle_of(four_bar("inflection = [2]", 75), "2")
    here = four_bar("inflection = [2]", 75).solve().points
    base = here["A"].position, here["B"].position
    with mp.workdps(60):

        def coupler(angle):
            a, far = mp.mpf("0.8") * mp.expjpi(angle / 180), mp.mpc("2.5", "0.3")
            d, r, s = abs(far - a), mp.mpf("2.3"), mp.mpf("1.6")
            along = (d * d + r * r - s * s) / (2 * d)
            return a, a + (far - a) / d * mp.mpc(along, mp.sqrt(r * r - along * along))

        step = mp.mpf("1e-12")

        def bend(spot):
            ratio = (mp.mpc(spot) - base[0]) / (mp.mpc(base[1]) - base[0])
            before, now, after = (
                a + (b - a) * ratio for a, b in (coupler(75 + k * step) for k in (-1, 0, 1))
            )
            first, second = (after - before) / 2, after - 2 * now + before
            return (mp.conj(first) * second).imag / abs(first) ** 3

        bends = [bend(centre + radius * exp(2j * pi * k / 7 + 0.1j)) for k in range(7)]
        assert max(abs(k) for k in bends) < 1e-9
        assert abs(bend(centre)) > 1e-2


@pytest.mark.parametrize("angle", [15, 60, 130, 200, 300])
def test_a_pin_that_slides_on_a_line_lies_on_the_inflection_circle_of_its_rod(angle):
    mechanism = slider_crank("inflection = [2]", angle)
    centre, radius = circle_of(mechanism, "2")
    pin = mechanism.solve().points["B"].position
    assert abs(pin - centre) == pytest.approx(radius, rel=1e-9)


def test_the_inflection_pole_by_hand_is_the_one_by_accelerations():
    mechanism = four_bar("inflection = [2, 3]", 50, 9, 31)
    trace = mechanism.trace(mechanism.asked(), by_hand=True)
    for link, by_hand in (("2", True), ("3", False)):
        number = mechanism.program.targets["inflection", link]
        step = mechanism.program.steps[number]
        assert (step.by_hand in trace.values) is by_hand
        if step.by_hand is not None:
            drawn = place_of(trace.values[step.by_hand], 1.0)
            assert drawn == pytest.approx(place_of(trace.values[number], 1.0), rel=1e-9)
    fixed = place_of(trace.value("inflection", "3"), 1.0)
    assert fixed == pytest.approx(2.5 + 0.3j, rel=1e-12)


@pytest.mark.parametrize("name", ["pump", "slotted-lever"])
def test_what_is_far_is_told_by_half_the_perimeter_of_the_box_around_all_points(name):
    """One metre where there is one point alone; what is endlessly far has no part in it."""
    solution = shipped(name, 7).solve()
    far = replace(solution.points["A"], position=complex("inf"))
    xs, ys = zip(
        *((p.position.real, p.position.imag) for p in solution.points.values()), strict=True
    )
    spans = [max(each) - min(each) for each in (xs, ys)]
    assert breadth_of(solution) == pytest.approx(sum(spans))
    assert breadth_of(replace(solution, points={**solution.points, "X": far})) == sum(spans)
    assert breadth_of(replace(solution, points={"A": solution.points["A"]})) == 1.0
    assert breadth_of(replace(solution, points={})) == 1.0
