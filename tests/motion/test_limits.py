"""How far followers go: closed forms for rockers and blocks."""

from __future__ import annotations

from math import asin, degrees, sqrt

import numpy as np
import pytest

from graphkin.diagnosis.ranges import closing
from graphkin.mechanism import Mechanism, load
from graphkin.motion import follower_limits
from graphkin.motion.cycle import cycle
from graphkin.motion.ends import crossings_of_zero
from graphkin.motion.follower_limits import followers, movers_of
from graphkin.motion.single_loop import class_of, loop_of
from graphkin.scene.read_scene import read_text
from tests.bench.chain import scene as chain
from tests.motion.linkages import cosine_rule, four_bar, slider_crank
from tests.scene_files import FOLDER, scene_text

EXACT = 1e-9


@pytest.mark.parametrize("lengths", [(40, 90, 70, 100), (1, 3, 2.5, 3.2), (0.2, 9, 4, 10)])
def test_a_rocker_turns_round_where_crank_and_coupler_are_in_line(lengths):
    crank, coupler, rocker, frame = lengths
    found = cycle(four_bar(crank, coupler, rocker, frame, speed=7))
    (only,) = followers(found)
    out = cosine_rule(frame, coupler + crank, rocker)
    back = 180 + cosine_rule(frame, coupler - crank, rocker)
    assert [limit.at for limit in only.limits] == pytest.approx([out, back], abs=EXACT)
    far = 180 - cosine_rule(frame, rocker, coupler + crank)
    near = 180 - cosine_rule(frame, rocker, coupler - crank)
    assert only.low.value == pytest.approx(far, abs=EXACT)
    assert only.high.value == pytest.approx(near, abs=EXACT)
    assert only.extent == pytest.approx(near - far, abs=EXACT)
    turned = back - out
    ratio = max(turned, 360 - turned) / min(turned, 360 - turned)
    assert only.time_ratio == pytest.approx(ratio, rel=1e-9)
    assert only.rising == pytest.approx(turned, abs=EXACT)  # from far, where it is low, to near
    assert only.line == ("O2", "B")


@pytest.mark.parametrize(("r", "c", "d"), [(60, 200, 20), (2, 5, 0), (1, 4, -2.5)])
def test_stroke_and_time_ratio_of_an_offset_slider_crank(r, c, d):
    found = cycle(slider_crank(r, c, d))
    (block,) = followers(found)
    far, near = sqrt((c + r) ** 2 - d**2), sqrt((c - r) ** 2 - d**2)
    assert block.high.value == pytest.approx(far, rel=1e-12)
    assert block.low.value == pytest.approx(near, rel=1e-12)
    out, back = degrees(asin(d / (c + r))) % 360, 180 + degrees(asin(d / (c - r)))
    assert [limit.at % 360 for limit in block.limits] == pytest.approx(
        sorted([out % 360, back]), abs=EXACT
    )
    turned = abs(back - out)
    ratio = max(turned, 360 - turned) / min(turned, 360 - turned)
    assert block.time_ratio == pytest.approx(ratio, rel=1e-9)


def test_the_extremes_of_a_range_lie_at_its_dead_points_where_nothing_turns_round():
    found = cycle(four_bar(3, 2, 2.5, 4, angle=20))
    (rocker,) = followers(found)
    ends = {found.ranges[0][0], found.ranges[0][1]}
    assert {rocker.low.at, rocker.high.at} & ends
    # stretched: A, B, O2 in line, so the rocker stands in the line from O2 to A
    ((_, high),) = found.ranges
    stretched = next(each for each in (rocker.low, rocker.high) if each.at in ends)
    a = 3 * np.exp(1j * np.radians(stretched.at))
    assert degrees(np.angle((a - 4) * np.exp(-1j * np.radians(stretched.value)))) == pytest.approx(
        0, abs=1e-5
    )
    assert high == found.ranges[0][1]


def test_the_second_rocker_of_the_six_bar_turns_round_four_times():
    rocker = followers(cycle(load("examples/scenes/six-bar.toml")))[1]
    assert len(rocker.limits) == 4
    assert rocker.time_ratio is None
    first, third = rocker.limits[0], rocker.limits[2]
    bell = followers(cycle(load("examples/scenes/six-bar.toml")))[0]
    # wherever the bell crank stands still, so does the rocker that it moves
    assert [first.at, third.at] == pytest.approx([limit.at for limit in bell.limits], abs=EXACT)


@pytest.mark.parametrize(
    ("lengths", "name", "turns"),
    [
        ((40, 90, 70, 100), "crank-rocker", True),
        ((70, 90, 40, 100), "rocker-crank", False),
        ((4, 3.5, 4.5, 2), "double crank", True),
        ((4, 2, 4.5, 5), "double rocker", False),
        ((3, 2, 2.5, 4.5), "triple rocker", False),
        ((2, 4, 2, 4), "change-point parallelogram", True),
        ((3, 2, 2, 3), "change-point kite", False),
        ((1, 4, 3, 2), "change-point four-bar", True),
    ],
)
def test_the_verdict_on_a_four_bar_and_its_range_agree(lengths, name, turns):
    crank, coupler, rocker, frame = lengths
    found = cycle(four_bar(crank, coupler, rocker, frame, angle=50))
    loop = loop_of(found)
    assert loop is not None
    assert class_of(loop) == name
    assert loop.turns == turns == found.path.whole
    full = [each.full for each in followers(found) if each.name == "3"]
    assert full[0] == (name in ("double crank", "change-point parallelogram"))


@pytest.mark.parametrize(("r", "c", "d"), [(2, 5, 3), (2, 5, 3.1), (2, 5, -2), (3, 2, 0.4)])
def test_the_band_of_a_slider_crank_and_its_range_agree(r, c, d):
    found = cycle(slider_crank(r, c, d, angle=0))
    loop = loop_of(found)
    assert loop is not None
    assert loop.lengths == pytest.approx({"crank": r, "rod": c, "offset": abs(d)})
    assert loop.turns == found.path.whole == (r + abs(d) <= c)


def test_followers_found_together_are_those_found_alone(tmp_path, monkeypatch):
    path = tmp_path / "chain.toml"
    path.write_text(chain(4), encoding="utf-8")
    found = cycle(load(str(path)))
    together = followers(found)
    assert len(together) == 4
    every = list(movers_of(found))
    for mover, of in zip(every, together, strict=True):
        monkeypatch.setattr(follower_limits, "movers_of", lambda _, mover=mover: [mover])
        assert followers(found) == (of,)


@pytest.mark.parametrize("enough", [0.0, 1e-6])
def test_a_crossing_does_not_depend_on_the_brackets_beside_it(enough):
    def value(u):
        return np.cos(u)

    lows, highs = np.array([1.0, 4.0, -100.0]), np.array([2.0, 5.0, -98.0])
    together = crossings_of_zero(value, lows, highs, enough)
    alone = [
        crossings_of_zero(value, lows[k : k + 1], highs[k : k + 1], enough)[0] for k in range(3)
    ]
    assert together.tolist() == alone


def test_a_block_turns_round_where_the_arms_of_a_lift_lie_flat():
    """There it is an arm away from the fixed pin, inside the range of the cylinder."""
    found = cycle(load(FOLDER / "motion/scissor-lift-cylinder.toml"), steps=8)
    block = next(each for each in followers(found) if each.name == "3")
    ((low, high),) = found.ranges
    assert block.high.value == pytest.approx(1, abs=1e-12)
    assert low < block.high.at < high and not block.high.edge


@pytest.mark.parametrize("motion", ["harmonic", "cycloidal", "3-4-5", "parabolic"])
def test_a_dwell_is_no_part_of_a_stroke(motion):
    """It rests from 0 to 60 and from 180 to 240 degrees of a cam that turns clockwise."""
    text = scene_text("motion/knife-cam-after-a-dwell", base=30, motion=motion)
    (block,) = followers(cycle(Mechanism(read_text(text, "cam"))))
    spans = [(each.start, each.end) for each in block.dwells]
    assert spans == [pytest.approx(span, abs=1e-3) for span in ((120, 180), (300, 360))]
    assert [each.value for each in block.dwells] == pytest.approx([0.055, 0.030], abs=1e-12)
    assert block.rising == pytest.approx(120, abs=1e-3)
    assert block.falling == pytest.approx(120, abs=1e-3)
    assert block.time_ratio == pytest.approx(1, abs=1e-4)


@pytest.mark.parametrize("sign", [1, -1])
def test_the_length_of_a_cylinder_keeps_its_sign(sign):
    text = (FOLDER / "motion/boom-on-a-cylinder.toml").read_text("utf-8")
    text = text.replace("position = 600", f"position = {sign * 600}")
    found = cycle(Mechanism(read_text(text, "boom")))
    pin = np.hypot(0.3, 0.2)
    ends = sorted([sign * (0.7 - pin), sign * (0.7 + pin)])
    assert found.ranges == (pytest.approx(tuple(ends), abs=1e-9),)


@pytest.mark.parametrize("sign", [1, -1])
def test_the_range_of_check_leaves_out_lengths_of_the_other_sign(sign):
    text = (FOLDER / "motion/boom-on-a-cylinder.toml").read_text("utf-8")
    text = text.replace("position = 600", f"position = {sign * 600}")
    pin = np.hypot(0.3, 0.2)
    ends = sorted([sign * (0.7 - pin), sign * (0.7 + pin)])
    assert closing(read_text(text, "boom")).ranges == [pytest.approx(ends, abs=1e-6)]


def test_the_link_that_stands_for_a_cam_is_no_follower():
    """The centre of curvature of a flat follower's cam jumps where the law changes."""
    found = cycle(load("examples/scenes/valve-train.toml"), steps=12)
    assert [each.name for each in followers(found)] == ["camshaft", "tappet", "rocker", "valve"]
