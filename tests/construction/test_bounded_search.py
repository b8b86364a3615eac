"""A search for closures looks at no more places than its bound, and the bound is told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphkin.construction.higher_class.closure_solver import KEPT, ClosureSolver, Trying
from graphkin.construction.higher_class.trial import Trial
from graphkin.diagnosis import ranges
from graphkin.diagnosis.ranges import (
    FEWER,
    FEWEST,
    ROUNDS,
    WORK,
    closing,
    ranges_of,
    swept,
    where_it_closes,
)
from graphkin.documents.sheet_documents import hand_out
from graphkin.mechanism import load
from graphkin.motion.course import Course
from graphkin.motion.driving import GRID
from graphkin.numbers.roots import roots
from graphkin.scene.read_scene import read_text
from tests.chosen import EVERY

HERE = Path(__file__).resolve().parent / "scenes"
EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "scenes"


@pytest.fixture
def tried(monkeypatch) -> list[int]:
    """How many steps each run of a trial has made."""
    runs: list[int] = []
    found = Trial.found

    def counted(self, known, tried, signs):
        runs.append(len(tried) * len(self.ready.moving))
        return found(self, known, tried, signs)

    monkeypatch.setattr(Trial, "found", counted)
    return runs


@pytest.mark.parametrize("height", [0.3, 1e18])
def test_a_function_that_only_rounding_moves_is_not_searched_for_a_least_value(height):
    """|e^ix| is 1 but for rounding: every third place of a grid looks like a turn."""
    places = []

    def misfit(_, x):
        places.append(len(x))
        return height * abs(np.exp(1j * x))

    grid = np.linspace(0, 6, 361)[None, :]
    assert roots(misfit, grid)[1].size == 0
    assert sum(places) == grid.size


def test_a_turn_far_from_zero_is_left_after_a_few_places():
    places = []

    def misfit(_, x):
        places.append(len(x))
        return 2 - np.cos(20 * x)

    assert roots(misfit, np.linspace(0, 6, 361)[None, :])[1].size == 0
    assert sum(places) < 361 + 20 * 12


@pytest.mark.parametrize(
    ("name", "most"), [("scissor-table", 10_000), ("scissor-table-two-stages", 20_000)]
)
def test_a_scissor_table_is_closed_with_few_trials(name, most, tried):
    """Folded, its arms fall together, and what is left to fit is rounding on the whole round."""
    mechanism = load(str(HERE / f"{name}.toml"))
    assert mechanism.witness(mechanism.solve()).agrees
    assert sum(tried) < 50 * most


def test_the_range_of_a_scissor_table_is_searched_within_the_bound(tried):
    """|KB|² = cos²θ/4 + 9/4 sin²θ, B at 2 cos θ: from 0.5 to 1.5 m; a cylinder keeps its sign."""
    found = closing(load(str(HERE / "scissor-table.toml")).scene)
    assert FEWEST <= found.searched < GRID
    assert f"searched at {found.searched} positions of the driver" in found.bound
    assert np.abs(found.ranges) == pytest.approx(np.array([[0.5, 1.5]]), abs=1e-6)
    assert sum(tried) < 3 * WORK


def test_a_length_beyond_all_others_is_searched_within_the_bound(tried):
    text = (EXAMPLES / "stephenson-2-ternary.toml").read_text(encoding="utf-8")
    scene = read_text(text.replace("O2-E = 94", "O2-E = 1e18"), "far", None, {})
    words = where_it_closes(scene)
    assert words.startswith("it closes for no angle of the driver: check the lengths (searched at ")
    assert sum(tried) < 3 * WORK


@pytest.mark.parametrize(
    ("name", "length"),
    [("rod-and-wheel", "C-B = 40"), *([("plank-axle", "radius = 45")] if EVERY else [])],
)
def test_a_wheel_that_turns_without_end_is_not_searched(name, length):
    """A bar of 9e15 mm on a wheel of 60 mm may roll it 5e13 times round; no search sees that."""
    text = (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    key = length.split(" = ")[0]
    scene = read_text(text.replace(length, f"{key} = 9e15"), "far", None, {})
    assert closing(scene).dear
    words = "where it closes is not searched, as it takes too many trials: check the lengths"
    assert where_it_closes(scene) == words


def test_a_ring_that_does_not_close_is_followed_from_one_of_a_few_positions():
    """At the end of the range two closures meet, which a search finds on one side only."""
    text = (EXAMPLES / "plates-ring.toml").read_text(encoding="utf-8")
    text = text.replace("O-A = 50", "O-A = 200").replace("angle = 255", "angle = 160")
    scene = read_text(text, "ring", None, {})
    found = closing(scene)
    assert found.searched == FEWER // len(ROUNDS) and len(found.ranges) == 1
    end = found.ranges[0][1]
    group = Course(swept(scene, 1), scene.branches).group(0)
    before, beyond = map(len, group.every(end + np.array([-0.01, 0.01])))
    assert before - beyond == 2


def test_a_ring_is_followed_through_a_plate_that_is_stretched_flat():
    """Near -80.6° the legs to one plate are in line, so the two signs of that dyad meet.

    Both ends are folds of the sixteen equations of the bars, followed by pseudo-arclength.
    """
    text = (EXAMPLES / "plates-ring.toml").read_text(encoding="utf-8")
    text = text.replace("O-A = 50", "O-A = 200").replace("angle = 255", "angle = 160")
    ((low, high),) = closing(read_text(text, "ring", None, {})).ranges
    assert low == pytest.approx(-86.6281, abs=2e-4)
    assert high == pytest.approx(-12.9934, abs=2e-4)


def test_a_range_is_sought_once_a_scene(monkeypatch):
    """The range of ``check`` and the hint of an error are the same search."""
    scene = load(str(EXAMPLES / "four-bar-triple-rocker.toml")).scene
    calls: list[int] = []

    def counted(course, count):
        calls.append(count)
        return ranges_of(course, count)

    monkeypatch.setattr(ranges, "ranges_of", counted)
    first = closing(scene)
    where_it_closes(scene)
    assert closing(scene) is first
    assert len(calls) == 1


def test_a_range_that_is_searched_everywhere_says_nothing_of_it():
    found = closing(load(str(EXAMPLES / "four-bar-triple-rocker.toml")).scene)
    assert found.searched == 0
    assert found.bound == ""


# --- closures are sought once for each position --------------------------------------------------


@pytest.fixture
def sought(monkeypatch) -> list[tuple[object, ...]]:
    """What was known at each search for closures."""
    calls: list[tuple[object, ...]] = []
    closures = Trying.closures

    def counted(self, known):
        calls.append((id(self), *(value[0] for value in known)))
        return closures(self, known)

    monkeypatch.setattr(Trying, "closures", counted)
    return calls


def test_the_sheets_of_a_scene_seek_its_closures_once(sought):
    hand_out(load(str(EXAMPLES / "stephenson-3-crank.toml")))
    assert 1 <= len(sought) == len(set(sought)) <= KEPT


def closer_of(name: str) -> tuple[ClosureSolver, tuple[object, ...]]:
    """What closes the group of a scene, and what is known there."""
    mechanism = load(str(EXAMPLES / f"{name}.toml"))
    trace = mechanism.trace()
    for number, step in enumerate(mechanism.program.steps):
        if step.action and isinstance(step.action.value, ClosureSolver) and number in trace.values:
            return step.action.value, tuple(trace.values[arg] for arg in step.args)
    raise LookupError(name)


def test_other_values_have_their_own_closure_and_few_are_kept():
    closer, known = closer_of("stephenson-3-crank")
    for i in range(2 * KEPT):
        moved = tuple(value * (1 + 1e-6 * i) for value in known)
        assert closer(*moved) == closer.trying.closed(moved, closer.number)
        assert len(closer.trying.kept) <= KEPT
