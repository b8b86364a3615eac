"""What is not asked takes no room: bytes counted by tracemalloc, none of them a matter of time."""

from __future__ import annotations

import tracemalloc
from itertools import pairwise

import numpy as np
import pytest

from graphkin.construction.tape.emitted import EMITTED_FROM
from graphkin.mechanism import Mechanism
from graphkin.scene.model import Ask
from tests.diagnosis.scope import asking, shipped

SIZES = (EMITTED_FROM // 2, 8 * EMITTED_FROM)
"""Variants that go step by step, and by emitted source."""
SCOPES = {
    "position": Ask(curves=("D",)),
    "velocity": Ask(velocity=("D",)),
    "acceleration": Ask(acceleration=("D",)),
}
LITTLE = 8 * 1024
"""Bytes of records, names and the like."""


def room(mechanism: Mechanism, size: int, *, asked: bool = True) -> tuple[int, int]:
    """Bytes that a batch keeps, and the most that it needs on the way."""
    n = np.linspace(1, 30, size)
    mechanism.batch(n=n, asked=asked)
    tracemalloc.start()
    try:
        kept = mechanism.batch(n=n, asked=asked)
        found = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert kept.points
    return found


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("scope", SCOPES)
def test_a_batch_keeps_just_what_is_asked(scope, size):
    """One vector is two doubles a variant, its margin one, whatever was found on the way."""
    kept, _ = room(asking("pump", SCOPES[scope]), size)
    assert 24 * size <= kept <= 24 * size + LITTLE


@pytest.mark.parametrize("size", SIZES)
def test_a_batch_needs_less_room_for_less(size):
    peaks = [room(asking("pump", ask), size)[1] for ask in SCOPES.values()]
    peaks += [room(shipped("pump"), size)[1], room(shipped("pump"), size, asked=False)[1]]
    assert all(less < more for less, more in pairwise(peaks)), peaks


@pytest.mark.parametrize("size", SIZES)
def test_what_the_scene_asks_takes_less_than_half_of_everything(size):
    asked, everything = (room(shipped("pump"), size, asked=asked)[0] for asked in (True, False))
    assert 2 * asked < everything


@pytest.mark.parametrize("scope", SCOPES)
def test_a_batch_runs_the_slice_and_keeps_its_ends(scope, monkeypatch):
    mechanism = asking("pump", SCOPES[scope])
    runs = []
    press = mechanism.press.__class__
    usual = press.run

    def noted(self, needed, values, keep, **options):
        runs.append((tuple(needed), set(keep)))
        return usual(self, needed, values, keep, **options)

    monkeypatch.setattr(press, "run", noted)
    mechanism.batch(n=np.linspace(1, 30, 5), asked=True)
    asked = mechanism.asked()
    program = mechanism.program
    assert runs == [(program.needed(asked), {program.targets[target] for target in asked})]
