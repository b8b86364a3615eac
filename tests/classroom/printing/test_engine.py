"""Who does the work: every chunk is done once, no more wait than needed, failures are told."""

from __future__ import annotations

import os
from concurrent.futures import Future, ThreadPoolExecutor

import pytest

from graphkin.classroom.printing.workers import AHEAD, processes, results
from graphkin.text.errors import PageError


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_every_part_is_done_once(workers):
    parts = [(i,) for i in range(60)]
    with ThreadPoolExecutor(workers) as pool:
        assert sorted(results(pool, workers, sum, parts)) == list(range(60))
    assert list(results(None, 1, sum, parts)) == list(range(60))


def test_no_more_parts_wait_than_the_workers_need():
    """Parts are taken from their source only as fast as results are fetched."""
    taken = []
    source = ((taken.append(i) or i,) for i in range(1000))
    with ThreadPoolExecutor(2) as pool:
        found = results(pool, 2, sum, source)
        next(found)
        assert len(taken) <= (1 + AHEAD) * 2
        found.close()


def test_a_broken_way_to_the_workers_is_told():
    class Cut(ThreadPoolExecutor):
        def submit(self, *_args, **_more):
            broken: Future[int] = Future()
            broken.set_exception(OSError("connection closed"))
            return broken

    with Cut(1) as pool, pytest.raises(PageError, match="a worker ended suddenly"):
        list(results(pool, 1, sum, [(1,)]))


def doubled(items):
    """Twice each item; the system ends the process that works on a 7."""
    if 7 in items:
        os._exit(9)
    return [2 * item for item in items]


def test_an_item_that_ends_its_process_fails_alone():
    parts = [range(i, i + 4) for i in range(0, 32, 4)]
    with processes(2) as pool:
        found = list(results(pool, 2, doubled, parts, lambda item: [-item]))
    assert sorted(each for some in found for each in some) == sorted(
        -i if i == 7 else 2 * i for i in range(32)
    )
