"""Links that go round without being driven: wheels on them move on and never leap."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from graphkin.construction.tape.emitted import runner
from graphkin.diagnosis.ranges import closing
from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import Cycle, cycle
from graphkin.motion.driving import stated_motion
from graphkin.motion.follower_limits import followers
from graphkin.motion.motion_curves import curves_of
from graphkin.motion.pieces import strangers
from graphkin.scene.read_scene import read_scene, read_text
from graphkin.structure.wheel_groups import counted_near, counting, place_of_turns
from graphkin.text.errors import GraphkinError
from graphkin.web.page_driver import INPUT, driven_by
from graphkin.web.tracing import Tracing
from tests.chosen import CHOSEN, EVERY
from tests.examples.scenes import FILES
from tests.scene_files import scene_text

OWN = {path.stem: path for path in sorted((Path(__file__).parent / "scenes").glob("*.toml"))}
ROLLING = OWN | {name: path for name, path in FILES.items() if "rolls" in path.read_text("utf-8")}
LONG = {
    "ring-near-parallel",
    "two-triads-two-cranks",
    "two-triads-one-crank",
    "gear-drives-drag-link",
}
"""Own scenes whose places take seconds, each beside a quicker one of its kind."""
TRIED = {*ROLLING} if EVERY else {*OWN, *CHOSEN} - LONG
"""The scenes that are swept."""
DRAG_LINK = OWN["drag-link-planet"].read_text("utf-8")
ARM, SUN, PLANET, BAR = 0.070, 0.040, 0.030, 0.025
"""Of the planet on the drag link (m): its arm, both radii, and from its centre to Q."""
FEW = 60
"""Places of a sweep; then as many between."""


@cache
def scene(name: str) -> Mechanism:
    return load(ROLLING[name])


@cache
def swept(name: str) -> Cycle:
    """A few places of the motion, which every law here looks at."""
    return cycle(scene(name), steps=FEW)


def planet(turns: float = 0.0, start: float = 0.0) -> Mechanism:
    """The planet on the drag link, its arm counted from a start and gone round so often more."""
    rolls = f"rolls = {{ on = 0, start = {{ 3 = {start} }}, turns = {{ 3 = {turns} }} }}"
    return Mechanism(read_text(DRAG_LINK.replace("rolls = { on = 0 }", rolls), Path("planet.toml")))


def planet_point(centre, arm_angle):
    """Q by Willis: on a fixed sun the planet turns 1 + sun/planet times as far as its arm."""
    return centre + BAR * np.exp(1j * arm_angle * (1 + SUN / PLANET))


def steps_of(found: Cycle):
    """The largest step of any point between neighbours, and by how much one goes too far.

    Twice as far as its speed allows is too far. Beside dead points, where speeds are without bound,
    nothing is compared.
    """
    way, driver = np.diff(found.at), found.sweep.driver
    time = (
        way
        * found.sweep.per_unit
        / (1 if driver is None else abs(stated_motion(driver, found.scene)[1]))
    )
    beside = (way < 1.5 * np.median(way)) & (np.diff(found.piece) == 0)
    if not found.path.whole:
        ends = [(low + (high - low) / 10, high - (high - low) / 10) for low, high in found.ranges]
        inner = np.any([(low < found.at) & (found.at < high) for low, high in ends], axis=0)
        beside &= inner[1:] & inner[:-1]
    largest, over = 0.0, 0.0
    for name, point in found.solution.points.items():
        if "@" in name or name in found.scene.cam_centres:  # at each place another point of a link
            continue
        place = np.broadcast_to(point.position, found.at.shape)
        speed = np.abs(np.broadcast_to(point.velocity, found.at.shape))
        step = np.abs(np.diff(place))
        largest = max(largest, step[beside].max())
        over = max(over, (step - 2 * np.maximum(speed[1:], speed[:-1]) * time)[beside].max())
    return largest, over


@pytest.mark.parametrize("name", [name for name in ROLLING if name in TRIED])
def test_no_point_moves_farther_than_its_speed_allows(name):
    few = swept(name)
    many = few.along(np.unique([*few.at, *(few.at[1:] + few.at[:-1]) / 2]))
    found = steps_of(few), steps_of(many)
    assert max(over / largest for largest, over in found) < 1e-3
    assert 0.4 * found[0][0] < found[1][0] < 0.65 * found[0][0]


@pytest.mark.parametrize(
    "name", [name for name in OWN if name in TRIED and not name.startswith("gear-drives")]
)
def test_the_witness_agrees_in_every_row(name):
    assert swept(name).witnessed.agrees.all()


def test_a_planet_on_a_drag_link_stands_as_willis_says_through_three_turns():
    found = cycle(scene("drag-link-planet"), steps=540, low=-480, high=600)
    points = {name: found.solution.points[name].position for name in ("O2", "B", "Q")}
    arm = np.unwrap(np.angle(points["B"] - points["O2"]))
    here = arm[np.searchsorted(found.at, 60.0)]
    arm -= 2 * np.pi * np.rint(here / (2 * np.pi))
    assert np.ptp(arm) > 6 * np.pi - 1
    assert np.abs(points["Q"] - planet_point(points["B"], arm)).max() < 1e-12
    assert found.witnessed.agrees.all()


@pytest.mark.parametrize("turns", [-2, 0, 1, 7])
@pytest.mark.parametrize("start", [0, 170, -170, 400])
def test_stated_turns_are_added_to_the_angle_within_half_a_turn_of_the_start(turns, start):
    mechanism = planet(turns, start)
    solution = mechanism.solve()
    centre = solution.points["B"].position
    angle = np.angle(centre - solution.points["O2"].position) - np.radians(start)
    angle = np.angle(np.exp(1j * angle)) + 2 * np.pi * turns
    assert abs(solution.points["Q"].position - planet_point(centre, angle)) < 1e-14
    assert mechanism.witness(solution).agrees


def test_a_gear_drives_a_four_bar_as_far_as_that_drives_it():
    """The two are one linkage; the group that closes by trial counts its arm within the trial."""
    gear = cycle(scene("four-bar-drives-gear"), steps=3600).solution.points
    swing = np.ptp(np.unwrap(np.angle(gear["M"].position - gear["O2"].position)))
    ((low, high),) = cycle(scene("gear-drives-four-bar"), steps=4).ranges
    assert high - low == pytest.approx(np.degrees(swing), abs=1e-3)


def test_a_turn_more_is_what_the_motion_leads_to_in_a_turn():
    later = cycle(scene("drag-link-planet"), steps=4, low=60, high=420).solution.points["Q"]
    stated = planet(1).solve().points["Q"]
    assert abs(later.position[-1] - stated.position) < 1e-14
    assert abs(later.velocity[-1] - stated.velocity) < 1e-14


def test_the_arm_beyond_half_a_turn_is_followed_by_range_and_moving_page():
    mechanism = scene("whitworth-gears")
    assert closing(mechanism.scene).ranges == [(0.0, 360.0)]
    tracing = Tracing(mechanism, driven_by(mechanism.scene))
    trace = tracing.traced(mechanism.trace())
    point = trace.value("position", "C")
    at = np.arange(0.0, 360.0)
    run = runner(tracing.graph, [point.node, point.imag.node])
    x, y = run({INPUT: at, **tracing.counting_angles(at)})
    rows = cycle(mechanism).along(at)
    assert np.abs(x + 1j * y - rows.solution.points["C"].position).max() < 1e-12


@pytest.mark.parametrize(
    ("name", "links", "turns"),
    [
        ("drag-link-planet", ("4",), 3),
        ("gear-before-and-after", ("5", "6"), 2),
        ("geared-five-bar", ("2", "3", "4"), 2),
        ("planet-on-coupler", (), 1),
        ("gear-drives-drag-link", (), 1),
    ],
)
def test_a_mechanism_comes_back_after_as_many_turns_as_its_wheels_need(name, links, turns):
    path = swept(name).path
    assert path.whole
    assert path.returns
    assert strangers(path) == links
    assert path.turns == turns
    assert path.spans == ((0, turns * 360),)


WANKEL = """
graphkin = 1
title = "Wankel"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
wheel = { centre = "O", radius = PINION }
[links.1]
O-C = 15
[links.2]
C-P = 100
wheel = { centre = "C", radius = RING, inside = true }
rolls = { on = 0, start = { 1 = 90, 2 = 90 } }
[[drivers]]
turn = 1
angle = 40
speed = 30
[ask]
curves = ["P"]
centrodes = [2]
"""
"""A rotor's ring round a pinion of the housing, on an eccentric (Wankel)."""


@pytest.mark.parametrize(("pinion", "ring", "turns"), [(30, 45, 3), (60, 75, 5)])
def test_the_path_of_a_rotor_goes_on_until_it_closes(pinion, ring, turns):
    """An epitrochoid, by its closed form; both centrodes are the pitch circles, drawn once."""
    text = WANKEL.replace("PINION", str(pinion)).replace("RING", str(ring))
    curves = curves_of(Mechanism(read_text(text, Path("wankel.toml"))))
    found = {curve.kind: np.array(curve.runs[0]) for curve in curves}
    assert all(len(curve.runs) == 1 for curve in curves)
    path = found["trajectory"]
    eccentric = -np.pi / 2 + np.linspace(0, 2 * np.pi * turns, len(path))
    rotor = 1j * np.exp(1j * eccentric * (1 - pinion / ring))
    assert np.abs(path - (0.015j * np.exp(1j * eccentric) + 0.1 * rotor)).max() < 1e-12
    assert path[0] == path[-1]
    for kind, radius in (("fixed-centrode", pinion), ("moving-centrode", ring)):
        around = np.abs(np.diff(found[kind])).sum()
        assert around == pytest.approx(2 * np.pi * radius / 1000, rel=1e-4)


WRONG = {
    "{ 3 = 0.5 }": "links.4.rolls.turns.3: 0.5 turns; expected a whole number of turns",
    "{ 9 = 1 }": "links.4.rolls.turns.9: link 9 is not in [links]",
    "{ 1 = 1 }": "links.4.rolls.turns.1: a driver gives the angle of link 1",
    "{ 2 = 1 }": "links.4.rolls.turns.2: no wheel depends on how often link 2 went round",
    "{ 4 = 1 }": "links.4.rolls.turns.4: link 4 rolls, which counts its whole turns",
    "1": "links.4.rolls.turns: 1; expected a table",
}


@pytest.mark.parametrize("turns", WRONG)
def test_turns_that_cannot_be_meant_are_refused_at_their_place(turns):
    text = DRAG_LINK.replace("on = 0 }", f"on = 0, turns = {turns} }}")
    with pytest.raises(GraphkinError, match=r"links\.4\.rolls\.turns") as caught:
        Mechanism(read_text(text, Path("planet.toml"))).solve()
    assert WRONG[turns] in str(caught.value)


@pytest.mark.parametrize("name", ["gears-planet", "gears-ravigneaux", "drag-link-planet"])
def test_the_place_of_turns_is_that_of_what_rolls_and_counts_them(name):
    """It leads to that table of the scene; numbered where its link rolls several times."""
    found = read_scene(ROLLING[name])
    for link, rolling in counting(found).items():
        keys = re.fullmatch(r"links\.(\w+)\.rolls(?:\[(\d)\])?", place_of_turns(found, link))
        assert keys is not None
        rolls = found.links[keys[1]].rolls
        assert (keys[2] is None) == (len(rolls) == 1)
        assert rolls[int(keys[2] or 0)] is rolling
    first = next(each for each in found.every_link if each.rolls)
    assert place_of_turns(found, "no such link").startswith(f"links.{first.name}.rolls")


@pytest.mark.parametrize(("unit", "start"), [("deg", np.pi / 360), ("rad", 0.5)])
def test_whole_turns_are_added_in_the_unit_of_the_angle(unit, start):
    rolls = "on = 0, start = { 3 = 0.5 }, turns = { 3 = 2 } }"
    text = DRAG_LINK.replace("on = 0 }", rolls).replace('angle = "deg"', f'angle = "{unit}"')
    scene = read_text(text, Path("planet.toml"))
    assert counted_near(scene)["3"].si(scene.values) == pytest.approx(start + 4 * np.pi)


GEARED = """graphkin = 1
title = "Geared five-bar"
units = {{ length = "mm", angle = "deg", speed = "rad/s" }}
module = 4
[frame]
O = [0, 0]
Q = [120, 0]
[links.1]
O-A = 45
wheel = {{ centre = "O", teeth = 20 }}
[links.2]
A-B = 110
[links.3]
C-B = 100
[links.4]
Q-C = 50
wheel = {{ centre = "Q", teeth = 40 }}
rolls = {{ on = 1, start = {{ 4 = {start} }} }}
[[drivers]]
turn = 1
angle = 80
speed = 12
[branches]
B = "left of A-C"
"""


@pytest.mark.parametrize("start", [60, 240])
def test_a_geared_five_bar_moves_until_its_bars_are_in_line_though_that_be_turns_away(start):
    """Its second crank turns half as fast, so that all stands as before after two turns."""
    mechanism = Mechanism(read_text(GEARED.format(start=start), Path("geared.toml")))
    found = cycle(mechanism, steps=360)

    def apart(angle):
        ends = 0.045 * np.exp(1j * np.radians(angle))
        return abs(0.120 + 0.050 * np.exp(1j * np.radians(start - angle / 2)) - ends)

    ((low, high),) = found.ranges
    assert 360 < high - low < 720
    assert np.allclose(apart(np.array([low, high])), 0.210, atol=1e-9)
    assert (apart(np.linspace(low, high, 10001)[1:-1]) < 0.210).all()
    assert not found.path.whole
    assert np.allclose(closing(mechanism.scene).ranges, [(low, high)], atol=1e-5)
    degrees = np.arange(np.ceil(low), high)
    assert np.isin(degrees, np.round(found.at, 9)).all()
    assert found.witnessed.agrees.all()


STOPS = [-100.744, 25.878, 43.065, 115.817, 189.551, 557.891]
"""Where coupler and rod of the geared five-bar are in line, in a circle of two turns."""


@pytest.mark.parametrize("angle", [90, -60, 300, 1000])
def test_a_driver_has_the_same_ranges_and_dead_points_wherever_it_stands(angle):
    """A and B are as far apart there as both bars together."""
    text = scene_text("motion/geared-five-bar-that-stops", angle=angle)
    found = cycle(Mechanism(read_text(text, Path("geared.toml"))))
    assert found.path.turns == 2
    assert sorted(found.ranges) == [
        pytest.approx(pair, abs=1e-3) for pair in zip(STOPS[::2], STOPS[1::2], strict=True)
    ]
    assert [each.at for each in found.singulars] == pytest.approx(STOPS, abs=1e-3)
    turned = np.radians(np.array([each.at for each in found.singulars]))
    a = 0.06 * np.exp(1j * turned)
    b = 0.1 + 0.055 * np.exp(1j * (np.radians(70) - 1.5 * (turned - np.pi / 2)))
    assert np.minimum(abs(abs(b - a) - 0.175), abs(abs(b - a) - 0.015)).max() < 1e-9


@pytest.mark.parametrize("angle", [50, 770, -300])
def test_a_stroke_is_that_of_all_turns_after_which_all_stands_as_before(angle):
    text = scene_text("motion/planet-back-after-four-turns", angle=angle)
    found = cycle(Mechanism(read_text(text, Path("planet.toml"))))
    block = next(each for each in followers(found) if each.name == "6")
    assert len(found.at) == 4 * 360
    places = found.solution.slides["6"].position
    assert block.low.value == pytest.approx(places.min(), abs=1e-4)
    assert block.extent == pytest.approx(0.258696, abs=1e-6)
    assert not (block.low.edge or block.high.edge)
    assert len(block.limits) == 8


def test_what_never_comes_back_has_one_turn_and_no_extreme_at_its_edges():
    text = scene_text("motion/planet-back-after-four-turns", angle=50)
    text = text.replace("radius = 40 }", "radius = 39.123456 }").replace(
        "O2-P = 110", "O2-P = 109.123456"
    )
    found = cycle(Mechanism(read_text(text, Path("planet.toml"))))
    assert found.path.whole
    assert not found.path.returns
    assert found.path.turns == 0
    (block,) = (each for each in followers(found, 0) if each.name == "6")
    for end in (block.low, block.high):
        assert end.edge == (end.at in (0.0, 360.0))


def test_a_locus_too_short_to_draw_gives_no_curve():
    mechanism = Mechanism(read_text(scene_text("motion/locus-too-short-to-sample"), "x", None, {}))
    assert mechanism.witness(mechanism.solve()).agrees
    assert {curve.kind for curve in curves_of(mechanism)} == {"locus"}
    assert any(not curve.runs for curve in curves_of(mechanism))


def test_the_ends_of_a_tried_group_are_the_same_wherever_it_stands():
    """From 60 degrees both dead points lie within a turn, from 80 and 120 one of them does."""
    text = FILES["rope-levers"].read_text("utf-8")

    def ends(angle):
        scene = text.replace("value = 80", f"value = {angle}")
        found = cycle(Mechanism(read_text(scene, Path("rope.toml"))), steps=60)
        assert [each.kind for each in found.singulars] == ["dead", "dead"]
        ((low, high),) = found.ranges
        return low, high

    low, high = ends(60)
    assert high - low > 360
    assert low < 80 - 360
    assert ends(80) == pytest.approx((low, high), abs=1e-7)
    assert ends(120) == pytest.approx((low, high), abs=1e-7)
