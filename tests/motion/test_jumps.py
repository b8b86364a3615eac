"""A cycle is a motion: each row follows from its neighbour as the velocities say."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import Cycle, cycle, cycle_at, jumps
from graphkin.motion.ends import Event
from graphkin.motion.pieces import Path
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import WitnessError
from tests.chosen import shared
from tests.examples.scenes import FILES
from tests.motion.linkages import four_bar, slider_crank

AT = np.arange(0.0, 360.0)


def switched(found: Cycle, at: float) -> Cycle:
    """A whole turn whose closure is another one from some position of the driver on."""
    (piece,) = found.path.ranges[0]
    name, branch = next(iter(piece.branches.items()))
    other = {**piece.branches, name: replace(branch, side=-branch.side)}
    first = replace(piece, high=Event("window", at))
    last = replace(piece, low=Event("window", at), course=replace(piece.course, branches=other))
    path = Path(((first, last),), True, True, 1)
    return cycle_at(found.mechanism, found.sweep, path, AT)


@pytest.mark.parametrize("speed", [7, 0])
def test_a_closure_that_is_another_from_a_row_on_is_a_jump_there_and_at_the_end(speed):
    whole = cycle(four_bar(2, 5, 4, 6, speed=speed))
    assert jumps(whole) == ()
    found = jumps(switched(whole, 123.5))
    assert [(each.low, each.high) for each in found] == [(123, 124), (359, 360)]
    assert {each.of for each in found} == {"B"}
    there = switched(whole, 123.5).solution.points["B"].position
    assert [each.way for each in found] == pytest.approx(
        [abs(there[124] - there[123]), abs(there[0] - there[359])]
    )
    assert all(each.led < 0.01 * each.way for each in found)


def test_a_small_jump_is_seen_at_any_grid():
    """The coupler is longer by a thousandth from 100 degrees on."""
    short, long = (cycle(four_bar(2, coupler, 4, 6, speed=7)) for coupler in (5, 5.005))
    for steps in (36, 360, 3600):
        first, last = (each.along(np.arange(steps) * (360 / steps)) for each in (short, long))
        (piece,), (other,) = short.path.ranges[0], long.path.ranges[0]
        parts = (
            replace(piece, high=Event("window", 100.0)),
            replace(other, low=Event("window", 100.0)),
        )
        path = Path((parts,), True, True, 1)
        joined = cycle_at(first.mechanism, first.sweep, path, last.at)
        assert [each.low <= 100 <= each.high for each in jumps(joined)] == [True, False]


def test_no_cycle_with_a_jump_is_given(monkeypatch):
    """Not to a command, nor a sheet, nor a program of one's own; in all rows or in some targets."""
    mechanism = four_bar(2, 5, 4, 6, speed=7)
    found = switched(cycle(mechanism), 123.5)
    monkeypatch.setattr("graphkin.motion.cycle.reachable_ranges", lambda *_: found.path)
    there = found.solution.points["B"].position
    way = f"{abs(there[124] - there[123]):.4g}"
    words = rf"B jumps between 123 and 124 deg; .*it moves {way} m there, and .* gives 0\.01\d+ m"
    for targets in (None, [("position", "A")]):
        with pytest.raises(WitnessError, match=words):
            cycle(mechanism, targets=targets)


@pytest.mark.parametrize("name", shared(FILES, 4))
def test_no_motion_of_the_examples_jumps(name):
    mechanism = load(FILES[name])
    if mechanism.scene.drivers and not any(step.closes for step in mechanism.program.steps):
        for steps in (24, 360):
            assert jumps(cycle(mechanism, steps=steps)) == ()


@pytest.mark.parametrize("off", [1e-3, 1e-6, 1e-9, 0.0])
def test_a_crank_that_all_but_stops_beside_a_change_point_is_only_fast(off):
    """Near it the coupler turns over within less than a step of the rows."""
    assert jumps(cycle(four_bar(2, 4 + off, 2, 4, angle=30, speed=3))) == ()
    assert jumps(cycle(slider_crank(2, 2 + off, 0))) == ()


def test_a_wheel_on_one_pin_is_followed_by_its_angle():
    """It is set on by five degrees from 100 degrees of the driver on."""
    text = FILES["gears-pair"].read_text("utf-8")
    text = text.replace("O2-B = 70", "O2 = [0, 0]").replace(', "B"]', "]")
    set_on = text.replace("2 = 120 }", "2 = 125 }")
    first, last = (cycle(Mechanism(read_text(each, "pair"))) for each in (text, set_on))
    assert jumps(first) == jumps(last) == ()
    parts = (
        replace(first.pieces[0], high=Event("window", 100.0)),
        replace(last.pieces[0], low=Event("window", 100.0)),
    )
    path = replace(first.path, ranges=(parts,))
    there, _ = jumps(cycle_at(first.mechanism, first.sweep, path, first.at))
    assert (there.low, there.high, there.of, there.turns) == (100, 101, "2", True)
    assert there.way == pytest.approx(5 - there.led, abs=0.01)
