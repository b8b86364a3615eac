"""The construction and the loops find the same closures of every group of higher class."""

import pytest

from graphkin.diagnosis.closures import choices
from graphkin.loops.assemble import closures
from graphkin.loops.closing_groups import groups
from graphkin.loops.equations import equations
from graphkin.loops.loop_motion import pose_of, setting_of, unknowns_of
from graphkin.loops.witness import examine
from graphkin.structure.groups import Higher
from tests.chance.checking import case
from tests.chosen import EVERY

SEEDS = (9, 16, 78, 302, 690) if EVERY else (16, 78, 690)
"""Plates, wheels on long tracks, drivers within, windows narrower than a degree."""


@pytest.mark.parametrize("seed", SEEDS)
def test_as_many_closures_by_trial_as_by_newton(seed):
    mechanism = case(seed).mechanism
    solved = examine(mechanism.scene, mechanism.solve(), None).solved
    drawn = {
        frozenset(choice.links): len(choice.closures)
        for choice in choices(mechanism.scene, mechanism.groups, mechanism.program)
    }
    known = {frozenset(group.links): group for group in groups(mechanism.scene, solved.loops)}
    higher = [frozenset(g.links) for g in mechanism.groups if isinstance(g, Higher)]
    assert higher
    for links in higher:
        group = known[links]
        part = equations(mechanism.scene, setting_of(solved.loops, 0), group.known | links)
        stands = unknowns_of(part, pose_of(solved.loops, solved.unknowns[0]))
        assert len(closures(part, stands, group)) == drawn[links]
