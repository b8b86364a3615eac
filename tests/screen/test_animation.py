"""Animations begin where the scene stands, follow the cycle, and nothing leaves the picture."""

from __future__ import annotations

import io
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from graphkin.mechanism import load
from graphkin.motion import cycle
from graphkin.paper.marks import Text, reach
from graphkin.screen.frames import AREA, PICTURE, stage
from graphkin.screen.gif import PAUSE, gif
from graphkin.screen.moments import GROWN, Motion, motion
from graphkin.screen.pictured import mechanism_marks, plan_marks
from graphkin.text import words
from tests.cli.conftest import Run, run  # noqa: F401

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
NAMES = (
    "pump",
    "slotted-lever",
    "oldham",
    "trammel",
    "gears-ring",
    "roller",
    "five-bar",
    "four-bar-change-point",
    "stephenson-3-crank",
    "excavator-absolute",
)
"""Whole turns and ranges; drivers that turn, slide and roll; two of them; class III; wheels."""
FRAMES = 12
SLACK = 1e-9


@lru_cache
def shown(name: str) -> Motion:
    """A motion in a few moments."""
    path = SCENES / f"{name}.toml"
    mechanism = load(str(path)) if path.is_file() else load(name, n=7)
    return motion(cycle(mechanism), words("en"), FRAMES)


@pytest.mark.parametrize("name", NAMES)
def test_it_begins_where_the_scene_stands(name):
    found = shown(name)
    first = found.moments[found.order[0]]
    drawn = found.cycle.mechanism.solve()
    size = max(abs(z) for z in first.alone.positions.values())
    for point, place in first.alone.positions.items():
        assert abs(place - drawn.points[point].position) < SLACK * size
    if found.cycle.sweep.driver is not None:
        turn = 360 if found.cycle.sweep.whole else np.inf
        assert abs(first.at - found.cycle.sweep.start) % turn < SLACK


@pytest.mark.parametrize("name", NAMES)
def test_every_moment_is_a_place_of_the_cycle(name):
    """One construction by floats against the batch of all places, closures and all."""
    found = shown(name)
    whole = 360 if found.cycle.sweep.whole else np.inf
    rows = found.cycle.along([m.at for m in found.moments])
    assert len(rows.at) >= len(found.moments) - 2  # dead points have no row
    for moment in found.moments:
        near = np.flatnonzero(np.abs(np.abs(rows.at - moment.at) % whole) < SLACK)
        if not near.size:
            continue
        for point, place in moment.alone.positions.items():
            other = np.broadcast_to(rows.solution.points[point].position, rows.at.shape)[near[0]]
            assert abs(place - other) < 1e-8 * (1 + abs(place)), (name, point, moment.at)


@pytest.mark.parametrize("name", NAMES)
def test_it_goes_round_or_to_and_fro_without_a_jump(name):
    found = shown(name)
    order = np.array(found.order)
    closes = found.cycle.sweep.what != "time"
    steps = np.diff(np.append(order, order[0]) if closes else order)
    ends = len(found.moments) - 1
    assert set(np.abs(steps)) <= {1, ends}
    assert set(order) == set(range(len(found.moments)))
    places = [moment.at for moment in found.moments]
    assert places == sorted(places)


@pytest.mark.parametrize("name", NAMES)
def test_nothing_leaves_its_field_and_scales_stay(name):
    found = shown(name)
    set_up = stage(found, words("en"))
    for moment in found.moments:
        parts = [(set_up.mechanism, mechanism_marks(moment.alone, set_up.mechanism))]
        parts += [
            (set_up.plans[kind], plan_marks(drawing, set_up.plans[kind]))
            for kind, drawing in moment.drawings.items()
        ]
        for field, marks in parts:
            for mark in marks:
                box = reach(mark)
                room = 3.0 if isinstance(mark, Text) else 1e-6
                assert box[0] > field.rect[0] - room, (name, moment.at, mark)
                assert box[1] > field.rect[1] - room, (name, moment.at, mark)
                assert box[2] < field.rect[2] + room, (name, moment.at, mark)
                assert box[3] < field.rect[3] + room, (name, moment.at, mark)


@pytest.mark.parametrize("name", ["pump", "slotted-lever", "trammel", "roller"])
def test_what_belongs_to_the_frame_does_not_travel(name):
    found = shown(name)
    field = stage(found, words("en")).mechanism
    fixed = [
        {m for m in mechanism_marks(moment.alone, field) if m.cls in ("guide", "ground", "slot")}
        for moment in found.moments
    ]
    assert all(marks == fixed[0] for marks in fixed)


@pytest.mark.parametrize("name", ["pump", "trammel"])
def test_it_turns_back_before_a_dead_point(name):
    """There a driver at constant speed gives velocities without bound."""
    found = shown(name)
    assert found.reached[0] < found.low < found.high < found.reached[1]
    assert found.shortened
    rows = found.cycle.along(np.linspace(found.low, found.high, 200))
    for rate in ("velocity", "acceleration"):
        every = [getattr(p, rate) for p in found.cycle.solution.points.values()]
        usual = np.median(
            np.max([np.abs(np.broadcast_to(v, found.cycle.at.shape)) for v in every], axis=0)
        )
        here = [getattr(p, rate) for p in rows.solution.points.values()]
        assert max(float(np.max(np.abs(v))) for v in here) <= 1.1 * GROWN * usual


def test_a_whole_turn_is_not_cut():
    found = shown("slotted-lever")
    assert not found.shortened
    assert len(found.order) == FRAMES


@pytest.mark.parametrize("name", ["pump", "five-bar"])
def test_a_gif_has_all_its_pictures_and_the_same_bytes_again(name):
    from PIL import Image

    found = shown(name)
    data = gif(found, words("en"))
    assert data == gif(found, words("en"))
    with Image.open(io.BytesIO(data)) as picture:
        assert picture.n_frames == len(found.order)
        assert picture.info["loop"] == 0
        assert picture.info["duration"] == PAUSE
        assert picture.width / picture.height == pytest.approx(PICTURE[0] / PICTURE[1], rel=0.01)
    assert len(data) < 5e6 * len(found.order) / 72


def test_the_first_picture_is_the_drawn_position():
    """The ink of a pin's place: dark where A stands, white where it stands nowhere."""
    from PIL import Image

    found = shown("pump")
    set_up = stage(found, words("en"))
    with Image.open(io.BytesIO(gif(found, words("en")))) as picture:
        dots = np.asarray(picture.convert("L"))
    drawn = found.cycle.mechanism.solve()
    scale = dots.shape[1] / PICTURE[0]
    for name in "ABCD":
        x, y = set_up.mechanism(complex(drawn.points[name].position))
        around = dots[int((y - 1.5) * scale) : int((y + 1.5) * scale)]
        assert around[:, int((x - 1.5) * scale) : int((x + 1.5) * scale)].min() < 100
    left, top = int((AREA[0] + 2) * scale), int((AREA[1] + 12) * scale)
    assert dots[top : top + 20, left : left + 20].min() > 240


def test_the_command_writes_both(run: Run, tmp_path: Path):  # noqa: F811
    args = ("cycle", "slotted-lever", "-o", tmp_path, "--format", "gif,html", "--steps", "24")
    result = run(*args)
    assert result.exit_code == 0, result.output
    names = {path.name for path in tmp_path.iterdir()}
    stem = next(name for name in names if name.endswith(".csv")).removesuffix("-cycle.csv")
    assert names == {f"{stem}-cycle.csv", f"{stem}-motion.gif", f"{stem}-motion.html"}
    again = run(*args)
    assert again.exit_code == 2
    assert "--force" in again.stderr


RIGID = """graphkin = 1
title = "Rigid"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O1 = [0, 0]
O2 = [30, 0]
[links.1]
O1-A = 10
[links.2]
A-B = 10
[links.3]
O2-B = 10
[[drivers]]
turn = 1
angle = 0
speed = 2
[branches]
B = "left of A-O2"
[ask]
velocity = ["B"]
"""


@pytest.mark.parametrize("kind", ["gif", "html"])
def test_what_cannot_move_is_a_message(run: Run, tmp_path: Path, kind: str):  # noqa: F811
    path = tmp_path / "rigid.toml"
    path.write_text(RIGID, encoding="utf-8")
    result = run("cycle", path, "-o", tmp_path / "out", "--format", kind)
    assert result.exit_code == 2
    assert "Traceback" not in result.output
    assert not (tmp_path / "out").exists()


def test_a_page_says_when_it_cannot_move_one_of_several_drivers(run: Run, tmp_path: Path):  # noqa: F811
    args = ("cycle", SCENES / "five-bar.toml", "--driver", "2", "-o", tmp_path)
    result = run(*args, "--format", "html")
    assert result.exit_code == 2
    assert "--format gif" in result.stderr
    assert run(*args, "--format", "gif", "--steps", "24").exit_code == 0
