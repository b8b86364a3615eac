"""Groups of higher class: the motion goes on though the number of its closure changes."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.cli.report.cycle_report import pieces_words, range_words
from graphkin.construction.higher_class.closure_solver import Trying
from graphkin.construction.higher_class.following import GroupOnWay, Place
from graphkin.construction.higher_class.trial_rates import Spread, best_of, enlarged
from graphkin.mechanism import Mechanism, load
from graphkin.motion.closures_followed import carried, carried_about, changes, numbers_at
from graphkin.motion.course import Course
from graphkin.motion.cycle import cycle
from graphkin.motion.events import singulars
from graphkin.motion.follower_limits import followers
from graphkin.motion.sweep import sweep_of
from graphkin.scene.model import Closure
from graphkin.scene.read_scene import read_text
from tests.chance.checking import case
from tests.scene_files import FOLDER


@pytest.fixture(scope="module")
def swept():
    """A Stephenson III driven at the crank of its two-link path, across two new numbers."""
    mechanism = load("examples/scenes/stephenson-3-crank.toml")
    return cycle(mechanism, low=95, high=125, steps=10)


def test_the_closure_is_followed_under_its_changing_number(swept):
    assert len(swept.pieces) > 1
    numbers = [piece.branches["1"] for piece in swept.pieces]
    assert all(isinstance(each, Closure) for each in numbers)
    assert all(a != b for a, b in pairwise(numbers))
    for name, motion in swept.solution.points.items():
        if np.ptp(np.abs(motion.position - motion.position[0])) == 0:
            continue
        # positions and velocities fit together: no leap to another closure anywhere
        seconds = np.radians(np.diff(swept.at)) / swept.solution.links["5"].omega[0]
        mean = (motion.velocity[1:] + motion.velocity[:-1]) / 2
        step = np.diff(motion.position)
        assert np.abs(step - mean * seconds).max() < 0.02 * np.abs(step).max(), name


def test_every_row_agrees_with_the_witness(swept):
    assert swept.witnessed.agrees.all()


def test_a_link_turns_round_where_the_other_driver_has_its_dead_point():
    # driven at link 1 the same linkage has dead points; seen from link 5, link 1 turns round there
    other = load("examples/scenes/stephenson-3.toml")
    dead = cycle(other).ranges[0][1]
    here = cycle(load("examples/scenes/stephenson-3-crank.toml"), low=145, high=160, steps=15)
    crank = next(each for each in followers(here) if each.name == "1")
    assert crank.high.value == pytest.approx(dead, abs=1e-6)


def told(found) -> list[str]:
    """The lines about the closures."""
    label, lines = pieces_words(found)
    assert label == "closures"
    assert lines[0] == "one motion through the whole range; to select it, write in [branches]"
    return lines[1:]


def test_each_number_is_told_as_a_scene_writes_it(swept):
    first, *_, last = lines = told(swept)
    assert first == 'φ from 95.000° to 101.862°: 1 = "closure 3"'
    assert last == 'φ from 120.635° to 125.000°: 1 = "closure 1"'
    assert len(lines) == len(swept.pieces)


def test_the_motion_goes_on_where_two_closures_cross():
    """Where the crank of the rapid return is on the guide, two of its closures cross."""
    found = cycle(load("examples/scenes/rapid-return.toml"), low=80, high=280, steps=20)
    (piece,) = found.pieces
    assert piece.branches["2"] == Closure(2)
    assert {90.0, 270.0} == set(found.left_out)
    assert found.witnessed.agrees.all()


def test_followed_closures_of_several_trials_are_those_that_a_search_finds():
    """Newton's method from the neighbours comes to the same places as the search all round."""
    mechanism = load("examples/scenes/plates-coupled.toml")
    (piece,) = cycle(mechanism, low=0, high=30, steps=3).pieces
    course, at = piece.course, np.array([1.7, 11.3, 28.9])
    assert course.closures
    targets = [target for target in course.program.targets if target[0] == "velocity"]
    sought = replace(course, closures=()).columns(at, targets)
    for target, found in course.columns(at, targets).items():
        assert found == pytest.approx(sought[target], abs=1e-12), target


def test_between_places_of_two_closures_nothing_is_told():
    mechanism = load("examples/scenes/plates-coupled.toml")
    (piece,) = cycle(mechanism, low=0, high=9, steps=3).pieces
    course = piece.course
    (way,) = course.closures
    leaping = way.tried + np.where(np.arange(len(way.at)) % 2, 0.5, 0.0)[:, None]
    wrong = replace(course, closures=(replace(way, tried=leaping),))
    assert np.isnan(wrong.columns(np.array([4.5]), [("position", "P3")])["position", "P3"])


def scene_of(name: str) -> str:
    """A scene of two groups of class III, or of one of them alone."""
    return f"tests/motion/scenes/{name}.toml"


@cache
def turned(name: str):
    """A whole turn of a scene."""
    return cycle(load(scene_of(name)), steps=90)


def leaps(found, per_unit: float) -> float:
    """The largest way from row to row that no mean of the two velocities explains, in parts of the
    largest way."""
    worst = 0.0
    for motion in found.solution.points.values():
        way = np.diff(np.broadcast_to(motion.position, found.at.shape))
        speed = np.broadcast_to(motion.velocity, found.at.shape)
        led = (speed[1:] + speed[:-1]) / 2 * np.diff(found.at) * per_unit
        worst = max(worst, float(np.abs(way - led).max() / max(np.abs(way).max(), 1e-12)))
    return worst


def alike(both, alone, points: str, rows=slice(None)) -> None:
    """Hold the points of some names of one cycle to those of another."""
    for name, motion in both.solution.points.items():
        if name.startswith(points):
            other = np.broadcast_to(alone.solution.points[name].position, alone.at.shape)[rows]
            assert np.broadcast_to(motion.position, both.at.shape) == pytest.approx(
                other, abs=1e-9
            ), name


def test_numbers_between_a_few_searches_are_those_of_a_search_at_every_place():
    mechanism = load("examples/scenes/plates-ring.toml")
    sweep = sweep_of(mechanism.scene)
    course = carried_about(Course(sweep, sweep.original.branches), sweep.at_scene)
    group, way = course.group(0), course.closures[0]
    grid = np.linspace(405, 490, 31)  # |it has a new number four times
    found = numbers_at(group, way, grid)
    fresh = course.group(0)
    assert (np.diff(found) != 0).sum() >= 4
    assert len(group.searched) < len(grid)
    assert found.tolist() == fresh.numbers(way, grid).tolist()


def test_a_bracket_that_is_cut_has_its_closures_paired_anew(monkeypatch):
    """Pairs of the whole bracket lead nowhere in its parts: each part was searched on its own."""
    text = Path("examples/scenes/plates-ring.toml").read_text(encoding="utf-8")
    text = text.replace("O-A = 50", "O-A = 200").replace("angle = 255", "angle = 50")
    scene = read_text(text.replace("closure 2", "closure 1"), "ring", None, {})
    sweep = sweep_of(scene)
    course = carried(Course(sweep, sweep.original.branches), 50.0, 25.0)
    searched, closures = [], GroupOnWay.closures
    monkeypatch.setattr(
        GroupOnWay, "closures", lambda self, at: (searched.extend(at), closures(self, at))[1]
    )
    found = changes(course, 0, 25.0, 50.0)
    assert [number for _, number in found] == [4, 2, 1]
    assert [at for at, _ in found] == pytest.approx([25.0, 27.347645745, 38.605505478], abs=1e-7)
    assert len(searched) < 20


def test_a_group_that_does_not_close_where_it_is_drawn_says_where_it_was_searched():
    text = Path("examples/scenes/stephenson-3-crank.toml").read_text(encoding="utf-8")
    text = text.replace("angle = 100", "angle = 30")  # |closure 3 is not there
    found = cycle(Mechanism(read_text(text, "open", None, {})), steps=30)
    assert found.path.searched == 360
    assert "searched; a range between two of them is not seen" in range_words(found)


def test_a_ring_with_a_link_that_hardly_turns_is_followed_to_its_dead_points():
    """Link 9 turns by 1e-4 where link 8 turns by 1; a search misses its closure at most places."""
    found = cycle(load("tests/motion/scenes/ring-near-parallel.toml"), steps=90)
    (low, high), *others = found.ranges
    assert low < 1.0  # |the lines of P13 are parallel near 0.8°
    assert high == pytest.approx(65.328975, abs=1e-5)
    assert not others
    assert found.witnessed.agrees.all()


def test_two_groups_on_one_crank_move_as_each_does_alone():
    both = turned("two-triads-one-crank")
    assert both.path.whole and both.path.returns
    for name, points in (("two-triads-first", "A"), ("two-triads-second", "B")):
        alike(both, turned(name), points)


def test_two_groups_on_two_cranks_move_as_each_does_alone():
    both = cycle(load(scene_of("two-triads-two-cranks")), low=0, high=1, steps=60)
    first, second = np.degrees([2.0, 3.0])
    one = cycle(load(scene_of("two-triads-first")), low=20, high=20 + first, steps=60)
    other = cycle(load(scene_of("triad-of-one-crank")), low=20 - second, high=20, steps=60)
    alike(both, one, "A")
    alike(both, other, "B", slice(None, None, -1))


@pytest.mark.parametrize("name", ["two-triads-one-crank", "triad-moves-triad"])
def test_no_group_leaps_from_row_to_row(name):
    found = turned(name)
    assert found.path.whole and found.path.returns
    assert leaps(found, np.radians(1) / 2.0) < 0.01


def test_a_group_that_another_moves_is_numbered_with_it():
    found = cycle(load(scene_of("triad-moves-triad")), low=95, high=160, steps=6)
    numbers = [(piece.branches["a2"].number, piece.branches["b2"].number) for piece in found.pieces]
    assert numbers == [(2, 4), (2, 6), (1, 6)]
    assert found.witnessed.agrees.all()


def test_a_followed_closure_is_led_to_where_it_meets_another():
    """At a fold two closures are one: from both sides of it the sine of crossing goes to zero."""
    (*_, last) = cycle(load("examples/scenes/stephenson-3-crank.toml")).pieces
    end = last.high
    before = end.at - np.array([1e-4, 1e-6, 1e-8])
    sines = last.course.margins(before)[0]
    assert end.kind == "dead"
    # the sine goes as the root of the way that is left
    assert sines[:-1] / sines[1:] == pytest.approx(10.0, rel=0.02)
    assert np.isnan(last.course.margins(np.array([end.at + 1e-8]))[0, 0])


def test_a_followed_mechanism_is_that_of_a_search_and_needs_none(swept, monkeypatch):
    at = 103.0
    piece = next(each for each in swept.pieces if each.holds(np.array([at]))[0])
    sought = Mechanism(piece.course.standing(at)).solve()
    led = piece.course.mechanism(at)
    monkeypatch.setattr(Trying, "closures_of", lambda *known: pytest.fail("searched again"))
    for name, motion in led.solve().points.items():
        assert motion.position == pytest.approx(sought.points[name].position, abs=1e-12)
        assert motion.velocity == pytest.approx(sought.points[name].velocity, abs=1e-11)
    assert led.trial_rates


def test_the_words_of_a_dead_point_are_those_of_the_followed_closure(monkeypatch):
    path = cycle(load("examples/scenes/stephenson-3-crank.toml")).path
    sought = singulars(path)
    monkeypatch.setattr(Trying, "closures_of", lambda *known: pytest.fail("searched again"))
    assert singulars(path) == sought
    assert {each.kind for each in sought} == {"dead"}


def test_trial_rates_are_the_best_of_all_pairs():
    spread = Spread((0.3 + 0.1j, -0.2 + 0.5j), (0.5 - 0.2j, 0.1 + 0.7j), 1.7, 1.5)
    worse = {0.0: -0.8, 1.0: 0.0, -1.5: 0.1, 2.0: 0.0, 3.0: 0.05}

    def fault(first: float, second: float) -> float:
        large = enlarged(spread, first, second)
        return spread.fault(first, second, large) + worse[first] + worse[second]

    pairs = [(a, b) for a in worse for b in worse if abs(a) < abs(b)]
    assert best_of(spread, worse) == min(pairs, key=lambda pair: fault(*pair))


def test_a_motion_goes_on_where_two_links_of_a_group_are_in_line():
    """A plate on three bars stops where their lines meet in one point, and nowhere before.

    B, E and D are in line half a millisecond earlier. C. Gosselin and J. Angeles: Singularity
    analysis of closed-loop kinematic chains, 1990.
    """
    found = cycle(load(FOLDER / "motion/three-cranks-and-a-plate.toml"), low=0.07, steps=8)
    (_, end), *_ = found.ranges
    last = found.along([end - 2e-6]).solution
    places = {name: each.position[0] for name, each in last.points.items()}
    lines = []
    for pin, plate in ("AD", "BE", "CF"):
        way = (places[plate] - places[pin]) / abs(places[plate] - places[pin])
        lines.append((way.real, way.imag, (places[pin].conjugate() * way).imag / 0.1))
    assert np.linalg.det(lines) == pytest.approx(0, abs=0.02)


@pytest.mark.parametrize("seed", [9950002, 9950066])
def test_nothing_is_searched_where_a_closure_is_followed_or_lost(seed, monkeypatch):
    """Links are led back past where a group was followed, and on past where another ends."""

    def searched(group, at):
        raise AssertionError(f"searched at {at}")

    made = case(seed).mechanism
    sweep = sweep_of(made.scene, driver=1)
    course = Course(sweep, sweep.original.branches)
    monkeypatch.setattr(GroupOnWay, "closures", searched)
    found = carried_about(course, sweep.at_scene)
    assert len(found.closures) == len(found.closers) > 0


@pytest.mark.parametrize("step", [0.0, 1e-17])
def test_a_group_at_rest_is_at_no_fold(step):
    """Its steps were shortened for another reason; no curve goes through one point."""
    angles = np.zeros(2)
    found = [Place(0.1 * n, np.array([1 + step * n, 2.0]), angles, angles) for n in range(5)]
    assert GroupOnWay(None, None, 360.0).fold(found, 1.0, np.ones(4)) is None
