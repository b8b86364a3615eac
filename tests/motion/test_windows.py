"""Windows of a cycle: as narrow as a zoom on a dead point, and no wider than can be followed."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest

from graphkin.cli.report.cycle_report import cycle_lines, cycle_table
from graphkin.mechanism import Mechanism, load
from graphkin.motion import ends
from graphkin.motion.course import Course
from graphkin.motion.cycle import cycle
from graphkin.motion.driving import GRID
from graphkin.motion.sweep import bounds_in_si, turn_evenly, whole_turn, window
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError
from tests.motion.linkages import four_bar, slider_crank
from tests.scene_files import FOLDER


@pytest.fixture
def searched(monkeypatch) -> list[int]:
    """How many positions are looked at, each time that events are sought."""
    counts: list[int] = []
    margins = Course.margins

    def counted(self, at):
        counts.append(len(np.atleast_1d(at)))
        return margins(self, at)

    monkeypatch.setattr(Course, "margins", counted)
    return counts


def rocker():
    """A triple rocker: |AO2| = 4 where coupler and rocker are in line, 9 + 4 - 12 cos φ = 16."""
    return four_bar(3, 2, 2, 2, angle=60), float(np.degrees(np.arccos(-3 / 12)))


@pytest.mark.parametrize("width", [1e2, 1.0, 1e-2, 1e-4, 1e-6, 1e-8])
def test_a_window_about_a_dead_point_shows_it(width, searched):
    mechanism, dead = rocker()
    found = cycle(mechanism, low=dead - width / 2, high=dead + width / 2, steps=20)
    assert [(each.kind, each.at) for each in found.singulars] == [
        ("dead", pytest.approx(dead, abs=1e-12))
    ]
    assert len(found.at) == 10
    assert found.at.min() >= dead - width / 2
    assert found.witnessed.agrees.all()
    assert f"{dead:.4f}"[:6] in "\n".join(cycle_lines(found))
    assert cycle_table(found).count("\n") >= len(found.at)
    assert sum(searched) < 5 * GRID


def test_a_wheel_that_is_driven_by_its_way_rolls_one_turn_about_where_it_stands():
    """Its circumference, half of it to each side."""
    scene = load("examples/scenes/roller.toml").scene
    (radius,) = (wheel.radius.si(scene.values) for wheel in scene.links["1"].wheels)
    low, high, whole = window(scene, "roll", 1, 0.2, None, None)
    assert (low, high) == pytest.approx((0.2 - np.pi * radius, 0.2 + np.pi * radius))
    assert not whole


@pytest.mark.parametrize("at", [180, -180, 540])
@pytest.mark.parametrize("width", [50.0, 1e-1, 1e-3])
def test_a_change_point_within_a_window_is_found(at, width):
    """A parallelogram has its change points at whole and half turns."""
    found = cycle(four_bar(2, 4, 2, 4, angle=50), low=at - width / 3, high=at + width, steps=12)
    assert [(each.kind, each.at) for each in found.singulars] == [("change", pytest.approx(at))]


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (float("nan"), 1, "--from: nan; expected a finite number"),
        (0, float("inf"), "--to: inf; expected a finite number"),
        (20, 10, "--from, --to: 20 to 10 deg; expected a window that grows"),
        (0, 1e7, "--from, --to: 0 to 10000000 deg, followed from 60; expected at most 72000 deg"),
        (-1e15, 0, "expected at most 72000 deg; give a window that is narrower, or nearer to"),
        (1e15, None, "expected at most 72000 deg"),
        (60, 60 + 1e-13, "expected steps of at least"),
    ],
)
def test_a_window_that_cannot_be_shown_is_refused_in_one_sentence(low, high, words, searched):
    mechanism, _ = rocker()
    with pytest.raises(SceneError, match=re.escape(words)) as caught:
        cycle(mechanism, low=low, high=high)
    assert len(caught.value.problems) == 1
    assert not searched


@pytest.mark.parametrize("steps", [0, 1_000_000, 10**9])
def test_steps_for_which_there_is_no_room_are_refused(steps):
    with pytest.raises(SceneError, match=r"--steps: .* expected 1 to \d+ steps"):
        cycle(load("pump", n=7), steps=steps)


def test_a_window_of_many_turns_is_followed_part_by_part(searched):
    found = cycle(slider_crank(2, 5), low=0, high=7200, steps=10)
    assert found.at == pytest.approx(np.arange(11) * 720)
    assert max(searched) <= 1.5 * GRID + 2


def test_a_motion_in_time_that_ends_is_divided_into_the_steps_as_a_range_is():
    """G runs out at 600 + 25 t = 500 + 200 mm; a window that is stated keeps its own steps."""
    mechanism = load(FOLDER / "motion/two-cylinders.toml")
    found = cycle(mechanism, steps=8)
    assert found.at == pytest.approx(np.arange(8) / 2)
    assert found.left_out == pytest.approx([4])
    assert cycle(mechanism, low=0, high=10, steps=5).at == pytest.approx([0, 2])


def test_a_rack_moves_as_far_as_its_pinion_turns_once():
    """2π·30 mm, half of it to each side; the parallelograms change twice in a turn."""
    found = cycle(load(FOLDER / "motion/gripper-on-a-rack.toml"), steps=12)
    half = 0.03 * np.pi
    assert found.ranges == (pytest.approx((0.02 - half, 0.02 + half)),)
    assert [each.kind for each in found.singulars] == ["change", "change"]


def test_a_slide_that_nothing_stops_is_shown_as_far_as_the_mechanism_is_large():
    """O1 and C are farthest apart: C is 300 mm from O2 towards R, 10 mm right and 200 mm below."""
    mechanism = load(FOLDER / "motion/bell-cranks-with-slots.toml")
    found = cycle(mechanism, steps=12)
    large = abs(1.2 + 0.3 * (0.01 - 0.2j) / abs(0.01 - 0.2j))
    assert found.ranges == (pytest.approx((0.06 - large, 0.06 + large)),)
    (line,) = [line for line in cycle_lines(found) if line.startswith("range")]
    assert line.endswith("from -1191.38 mm to 1311.38 mm; nothing stops it below and above")
    wide = cycle(mechanism, low=-5, high=5, steps=12)
    assert wide.ranges == (pytest.approx((-5, 5)),)


RANGES = {
    "a slide in a window": ("slide = 1", {"low": 0.02, "high": 0.1}, "it goes on below and above"),
    "a slide that a rod stops": ("slide = 1", {}, ""),
    "a slide that nothing stops": ("free", {}, "nothing stops it below and above"),
    "a wheel that a rod stops a turn away": ("roll = 1", {}, "it goes on below and above"),
}


@pytest.mark.parametrize("case", RANGES)
def test_nothing_stops_only_what_no_length_can_stop(case):
    """The rod of 150 mm on a bar of 150 mm stops a slide 300 mm from the pivot, a wheel also."""
    kind, window, expected = RANGES[case]
    moved = 'slides = { on = 0, through = "O", angle = 0 }'
    if kind == "roll = 1":
        moved = 'wheel = { centre = "A", radius = 5 }'
        moved += "\nrolls = { on = 0, through = [0, -5], angle = 0 }"
    text = f"[frame]\nO = [0, 0]\n[links.1]\nA = [0, 0]\n{moved}\n"
    branches = ""
    if kind != "free":
        text += "[links.2]\nA-C = 150\n[links.3]\nO-C = 150\n"
        branches = '[branches]\nC = "left of O-A"\n'
    driver = "slide = 1" if kind == "free" else kind
    text += f"[[drivers]]\n{driver}\nposition = 110\nspeed = 30\n{branches}"
    units = 'units = { length = "mm", angle = "deg", speed = "rad/s" }'
    scene = read_text(f'graphkin = 1\ntitle = "Range"\n{units}\n{text}', "range", None, {})
    (line,) = [
        line
        for line in cycle_lines(cycle(Mechanism(scene), steps=60, **window))
        if line.startswith("range")
    ]
    assert line.partition("; ")[2] == expected


@pytest.mark.parametrize("speed", [0.0, 0.3, 2.0])
@pytest.mark.parametrize("push", [-0.4, -0.3, -0.1, 0.0, 0.7, 1.0])
def test_an_even_turn_takes_the_least_time_in_which_its_angle_is_a_whole_turn(speed, push):
    """2π = ω t + α t² / 2; none where it comes to rest before."""
    roots = np.roots([push / 2, speed, -2 * np.pi])
    real = [root.real for root in roots if abs(root.imag) < 1e-9 and root.real > 0]
    found = turn_evenly(speed, push)
    assert found == (pytest.approx(min(real)) if real else None)


DRIVEN = """graphkin = 1
title = "Driven by time"
time = 0
units = {{ length = "mm", angle = "deg", speed = "rad/s" }}
[frame]
O = [0, 0]
[links.1]
O-A = 40
[[drivers]]
{}
"""


@pytest.mark.parametrize(
    ("driver", "seconds"),
    [
        ('turn = 1\nangle = 40\nspeed = "3"', 2 * np.pi / 3),
        ('turn = 1\nangle = 40\nspeed = "-3"', 2 * np.pi / 3),
        (
            "turn = 1\nangle = 40\nspeed = -3\nacceleration = -0.5",
            6 * (np.sqrt(1 + np.pi * 2 / 9) - 1),
        ),
        ("turn = 1\nangle = 40\nspeed = 3\nacceleration = -2", 1.5),
        ('turn = 1\nangle = "40 + 30*t**2"', np.sqrt(12)),
        ('turn = 1\nangle = "40 - 20*sin(90*t)"', 4.0),
    ],
)
def test_a_scene_is_shown_for_a_turn_till_its_driver_rests_or_for_once_to_and_fro(driver, seconds):
    found = whole_turn(read_text(DRIVEN.format(driver), "driven.toml"))
    assert found == pytest.approx(seconds, rel=1e-5)


@pytest.mark.parametrize("step", [0.5, 1e-4])
@pytest.mark.parametrize("way", [1, -1])
def test_the_parts_of_a_long_way_overlap_by_four_steps_in_any_unit(monkeypatch, step, way):
    """None is longer than a grid and a half; the first event that is none of theirs ends it."""
    course = SimpleNamespace(sweep=SimpleNamespace(grid_step=step))
    parts: list[tuple[float, float]] = []

    def looked(_, low, high, dead=7.0):
        parts.append((low / (way * step), high / (way * step)))
        return ends.Event("dead" if parts[-1][1] > dead * GRID else "window", high)

    monkeypatch.setattr(ends, "event_between", looked)
    assert ends.next_event(course, 0.0, way * 4.2 * GRID * step).kind == "window"
    for k, (low, high) in enumerate(parts[:-1]):
        assert low == pytest.approx(k * (GRID - 4))
        assert high - low == pytest.approx(GRID)
    assert parts[-1][1] == pytest.approx(4.2 * GRID)
    assert GRID / 2 < parts[-1][1] - parts[-1][0] <= 1.5 * GRID
    parts.clear()
    assert ends.next_event(course, 0.0, way * 30 * GRID * step).kind == "dead"
    assert 7 * GRID < parts[-1][1] < 8 * GRID


def test_bounds_are_in_the_unit_of_the_driver_that_is_swept():
    """Millimetres of a slide become metres; degrees of a turn, and seconds, stay."""
    slide = "turn = 1\nangle = 40\nspeed = 3\n[[drivers]]\nslide = 2\nposition = 10\nspeed = 1\n"
    block = 'links.2]\nB = [0, 0]\nslides = { on = 0, through = "O", angle = 0 }\n[[drivers]'
    text = DRIVEN.format(slide).replace("[drivers]", block, 1)
    scene = read_text(text, "driven.toml")
    assert bounds_in_si(scene, 1, 10, 20) == (10, 20)
    assert bounds_in_si(scene, 2, 10, 20) == pytest.approx((0.01, 0.02))
    assert bounds_in_si(scene, 2, None, 20) == (None, pytest.approx(0.02))
    assert bounds_in_si(scene, None, 10, 20) == (10, 20)
