"""Variants streamed a block at a time: the batch's own numbers, and only one block held."""

import tracemalloc

import numpy as np
import pytest

from graphkin import load
from graphkin.text.errors import SceneError


@pytest.mark.parametrize("kind", ["float64", "float32", "longdouble"])
@pytest.mark.parametrize("asked", [True, False])
def test_blocks_one_after_the_other_are_the_batch(kind, asked):
    pump, n = load("pump"), np.linspace(1, 30, 1000)
    whole = pump.batch(n=n, asked=asked, kind=kind).points["D"].acceleration
    parts = [
        block.points["D"].acceleration
        for block in pump.stream(n=n, asked=asked, kind=kind, block=300)
    ]
    assert [len(part) for part in parts] == [300, 300, 300, 100]
    assert (np.concatenate(parts) == whole).all()


def peak(count):
    """Bytes that are held at most while so many variants run past."""
    pump, n = load("pump"), np.linspace(1, 30, count)
    largest = 0.0
    tracemalloc.start()
    for block in pump.stream(n=n, asked=True, block=5000):
        largest = max(largest, float(abs(block.points["D"].acceleration).max()))
    held = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert largest > 400
    return held


def test_memory_does_not_grow_with_the_number_of_variants():
    """Beside the given array itself only one flag for each variant, which its range needs."""
    few, many = peak(20_000), peak(220_000)
    assert many - few <= 1.1 * 200_000


def test_what_is_wrong_is_told_before_the_first_block():
    with pytest.raises(SceneError, match="outside the range"):
        load("pump").stream(n=[1.0, 99.0])
    with pytest.raises(SceneError, match="is no parameter"):
        load("pump").stream(m=[1.0])


def test_of_no_parameters_there_is_one_block():
    (block,) = load("pump").stream()
    assert block.points["D"].acceleration == load("pump").solve().points["D"].acceleration
