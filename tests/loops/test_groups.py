"""The order of groups is found with a work that grows with the number of links."""

from __future__ import annotations

import pytest

from graphkin.loops import closing_groups
from graphkin.loops.equations import equations
from graphkin.scene.read_scene import read_text
from tests.bench.chain import scene


@pytest.fixture
def looked_at(monkeypatch) -> list[tuple[str, ...]]:
    """Every set of links that is looked at."""
    sets: list[tuple[str, ...]] = []
    group_of = closing_groups.group_of

    def counted(links, *rest):
        sets.append(links)
        return group_of(links, *rest)

    monkeypatch.setattr(closing_groups, "group_of", counted)
    return sets


def test_a_chain_of_dyads_is_looked_at_dyad_by_dyad(looked_at):
    """Each link that becomes known has a few neighbours; no other set is looked at again."""
    counts = []
    for dyads in (10, 20, 40):
        looked_at.clear()
        read = read_text(scene(dyads), "chain", None, {})
        found = closing_groups.stages(read, equations(read))
        expected = [("crank",), *((f"rod{k}", f"rocker{k}") for k in range(1, dyads + 1))]
        assert [group.links for group in found] == expected
        counts.append(len(looked_at))
    assert counts[2] - counts[1] == 2 * (counts[1] - counts[0])
    assert counts[2] < 8 * 40
