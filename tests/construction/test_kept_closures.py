"""The closures of a group are sought once for each position, however often they are asked."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphkin.construction.higher_class.closure_solver import KEPT, ClosureSolver, Trying
from graphkin.documents.sheet_documents import hand_out
from graphkin.mechanism import load

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"


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
    hand_out(load(str(SCENES / "stephenson-3-crank.toml")))
    assert 1 <= len(sought) == len(set(sought)) <= KEPT


def closer_of(name: str) -> tuple[ClosureSolver, tuple[object, ...]]:
    """What closes the group of a scene, and what is known there."""
    mechanism = load(str(SCENES / f"{name}.toml"))
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
