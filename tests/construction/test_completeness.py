"""Whether the closures found are all: proved in discs, or left open; never claimed falsely."""

from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.cli.report.check_report import closure_lines
from graphkin.construction.higher_class import completeness, trial
from graphkin.construction.higher_class.closure_solver import sign_table
from graphkin.construction.higher_class.completeness import Proof, is_complete
from graphkin.diagnosis.closures import choices
from graphkin.loops.assemble import assembled, closures
from graphkin.loops.cam_laws import by_law
from graphkin.loops.closing_groups import counted_in_order, stages
from graphkin.loops.equations import equations, part_of
from graphkin.loops.loop_motion import pose_of, unknowns_of
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from tests.construction.test_several_trials import closer
from tests.scene_files import scene_text

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
COUNTS = {
    "rapid-return": 4,
    "stephenson-2-binary": 2,
    "stephenson-3-crank": 4,
    "platform-3rpr": 2,
    "platform-six": 6,
    "link-motion": 4,
    "plates-coupled": 2,
    "platform-3rrr": 2,
    "plates-ring": 2,
}
"""Closures of the one group of higher class in an example."""
OPEN = "others may exist"


def example(name: str) -> Mechanism:
    """An example scene."""
    return load(EXAMPLES / f"{name}.toml")


def of_tests(name: str) -> Mechanism:
    """A scene of this room."""
    return Mechanism(read_text(scene_text(f"construction/{name}"), name))


def report(mechanism: Mechanism) -> str:
    """What check says of the closures."""
    found = choices(mechanism.scene, *mechanism.laid, proving=True)
    return "\n".join(line for choice in found for line in closure_lines(choice, mechanism.scene))


def counted_by_loops(mechanism: Mechanism) -> int:
    """In how many ways the largest group closes by the independent route."""
    scene = by_law(mechanism.scene)
    loops = counted_in_order(equations(scene))
    group = max(stages(scene, loops), key=lambda each: len(each.links))
    pose = pose_of(loops, assembled(scene, loops)[0])
    part = part_of(loops, group.known | set(group.links))
    return len(closures(part, unknowns_of(part, pose), group))


@pytest.mark.parametrize("name", COUNTS)
def test_closures_of_an_example_are_proved_to_be_all(name):
    mechanism = example(name)
    trying, known = closer(mechanism)
    assert trying.closures_of(known).ways() == COUNTS[name]
    assert is_complete(trying, known)
    assert OPEN not in report(mechanism)


@pytest.mark.parametrize(
    "name", ["stephenson-3-crank", "rapid-return", "link-motion", "platform-3rrr"]
)
def test_the_independent_route_counts_what_is_proved(name):
    assert counted_by_loops(example(name)) == COUNTS[name]


@pytest.mark.parametrize("name", COUNTS)
def test_without_any_one_of_its_closures_a_list_is_not_proved(name, monkeypatch):
    monkeypatch.setattr(completeness, "WORK", 400_000)
    trying, known = closer(example(name))
    found = trying.closures_of(known)
    for k in range(len(found.whole)):
        kept = np.arange(len(found.whole)) != k
        less = replace(
            found, table=found.table[kept], whole=found.whole[kept], touching=found.touching[kept]
        )
        assert not Proof(trying, known).holds_no_other(less)


def test_a_closure_listed_twice_is_not_proved():
    trying, known = closer(example("rapid-return"))
    found = trying.closures_of(known)
    twice = np.array([0, 0, *range(1, len(found.whole))])
    more = replace(
        found, table=found.table[twice], whole=found.whole[twice], touching=found.touching[twice]
    )
    assert not Proof(trying, known).holds_no_other(more)


def test_a_grid_too_coarse_to_find_all_leaves_the_verdict_open(monkeypatch):
    monkeypatch.setattr(trial, "SAMPLES", 3)
    mechanism = example("platform-six")
    trying, known = closer(mechanism)
    assert trying.closures_of(known).ways() < COUNTS["platform-six"]
    assert OPEN in report(mechanism)


def test_where_the_work_comes_to_its_bound_the_verdict_is_open(monkeypatch):
    monkeypatch.setattr(completeness, "WORK", 1)
    assert OPEN in report(example("platform-six"))


def test_a_dyad_that_can_be_drawn_only_within_a_step_of_the_grid_is_looked_at():
    """The side of a plate is 1.6 mm long and 200 mm from the pivot of its leg: the dyad can be
    drawn within 0.9 degrees, and the grid has steps of 3."""
    mechanism = of_tests("plate-with-a-short-side")
    trying, known = closer(mechanism)
    assert trying.closures_of(known).ways() == 6
    assert is_complete(trying, known)


def test_a_closure_in_which_the_trial_is_undetermined_leaves_the_verdict_open():
    """Two guides of links that are tried lie on one line in the position as drawn: the point that
    they share may be anywhere on it, so no trial value shows that the group closes there."""
    assert OPEN in report(of_tests("ring-with-parallel-guides"))


@pytest.mark.parametrize("name", [*COUNTS, "wheel-in-ring-rod", "rod-and-wheel"])
def test_a_disc_holds_what_each_of_its_trial_values_gives(name):
    """Values and their differences, in cells of all sizes anywhere."""
    trying, known = closer(example(name))
    proof, rng, size = Proof(trying, known), np.random.default_rng(5), len(trying.unknowns)
    rows = sign_table(len(trying.signs))
    table = np.array(rows, dtype=float).reshape(len(rows), len(trying.signs))
    count = 300
    signs = table[rng.integers(len(table), size=count)]
    turns = np.array([one.turns for one in trying.unknowns])
    middle = np.where(turns, 2 * np.pi, 3.0) * (rng.uniform(size=(count, size)) - 0.5)
    half = 10.0 ** rng.uniform(-7, -1, (count, size))
    seen = proof.looked(signs, middle, half)
    arrays = [np.atleast_1d(each) for each in known]
    drawn = 0
    for _ in range(20):
        share = middle + rng.uniform(-1, 1, middle.shape) * half
        tried = np.where(turns, share, proof.scale * np.tan(share))
        value = trying.misfits(arrays, tried, signs).T
        there = np.isfinite(value).all(axis=0)
        drawn += there.sum()
        assert not (there & seen.empty & ~(abs(value) > 1e3).any(axis=0)).any()
        slack = 1e-9 * (1 + abs(value))
        for near, off in ((seen.value, seen.radius), (seen.middle, mean_reach(seen, half))):
            outside = there & (abs(value - near) > off + slack)
            assert not outside.any()
    assert drawn > 20


def mean_reach(seen, half):
    """How far values lie from those in the middles of cells, by their slopes."""
    with np.errstate(all="ignore"):
        way = ((abs(seen.rises) + seen.spread) * half.T[None]).sum(axis=1)
    return np.where(np.isfinite(way), way + seen.unsure, np.inf)
