"""Run work in this process, on all cores of this machine, or on a cluster."""

from __future__ import annotations

import os
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import chain, islice
from typing import Any, TypeVar

from graphkin.text.errors import PageError, message

CHUNK = 25
"""The most students in a chunk."""
SHARES = 4
"""The fewest chunks for each worker, if there are enough students."""
AHEAD = 2
"""The chunks queued for each worker."""
ENDED = message("the system ended the process that worked on it, twice; is the memory full?")
"""The message for an item whose process ends."""
CLUSTER = "dask://"
PRELOADED = ("graphkin.classroom.printing.print_run", "graphkin.writers.pdf")
"""The modules that every worker needs, imported once where processes can share them."""

Given = TypeVar("Given")
Result = TypeVar("Result")


def cores() -> int:
    """The number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def chunks(items: Sequence[Given], workers: int, most: int = CHUNK) -> list[Sequence[Given]]:
    """The items in chunks for some workers, each of at most ``most`` items."""
    size = max(1, min(most, len(items) // (SHARES * workers)))
    return [items[i : i + size] for i in range(0, len(items), size)]


@contextmanager
def engine(jobs: int, address: str = "") -> Iterator[tuple[Executor | None, int]]:
    """The executor and its number of workers; None for the executor if this process does the work.

    ``address`` is dask://HOST:PORT for a cluster. Raises PageError if the cluster does not answer.
    """
    if address:
        with cluster(address) as found:
            yield found
    elif jobs == 1:
        yield None, 1
    else:
        pool = processes(jobs)
        try:
            yield pool, jobs
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def processes(jobs: int) -> ProcessPoolExecutor:
    """Worker processes that start fresh: they share no threads, locks or files with this one."""
    return ProcessPoolExecutor(jobs, mp_context=fresh_processes(), initializer=begin)


def fresh_processes() -> Any:
    """The multiprocessing context that starts fresh processes."""
    from multiprocessing import get_all_start_methods, get_context

    server = "forkserver" in get_all_start_methods()
    context = get_context("forkserver" if server else "spawn")
    if server:
        context.set_forkserver_preload(list(PRELOADED))
    return context


def begin() -> None:
    """Initialise a worker: leave Ctrl-C to its parent, and end when the parent ends."""
    from threading import Thread

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=follow_parent, daemon=True).start()


def follow_parent() -> None:
    """Wait until the parent process ends for any reason, then end this one."""
    from multiprocessing import parent_process
    from multiprocessing.connection import wait as wait_for

    parent = parent_process()
    if parent is not None:
        wait_for([parent.sentinel])
        os._exit(1)


@contextmanager
def cluster(address: str) -> Iterator[tuple[Executor, int]]:
    """The workers of a Dask cluster, through the interface of the standard library."""
    try:
        from distributed import Client
    except ImportError as error:
        found = message("needs dask.distributed, which is not installed")
        hint = message("install graphkin[cluster]")
        raise PageError.at(f"--engine {address}", found, hint=hint) from error
    try:
        client = Client(f"tcp://{address.removeprefix(CLUSTER)}", timeout=10)
    except (OSError, ValueError) as error:
        found, expected = (
            message("does not answer"),
            message("{cluster}HOST:PORT of a Dask scheduler", cluster=CLUSTER),
        )
        raise PageError.at(f"--engine {address}", found, expected) from error
    with client:
        yield client.get_executor(), max(1, sum(client.nthreads().values()))


def results(
    executor: Executor | None,
    workers: int,
    work: Callable[[Sequence[Given]], Result],
    parts: Iterable[Sequence[Given]],
    lost: Callable[[Given], Result] | None = None,
) -> Iterator[Result]:
    """The result of each part, as it arrives; only as many parts wait as the workers need.

    Where the system ends a process, the items in work are done again one at a time. ``lost`` gives
    the result for an item whose process ends again. Raises PageError if a process dies and there is
    no ``lost``, or if the connection to a cluster breaks.
    """
    if executor is None:
        yield from map(work, parts)
        return
    waiting: dict[Future[Result], Sequence[Given]] = {}
    left = iter(parts)
    try:
        while True:
            for part in islice(left, (1 + AHEAD) * workers - len(waiting)):
                waiting[executor.submit(work, part)] = part
            if not waiting:
                return
            done, _ = wait(waiting, return_when=FIRST_COMPLETED)
            for future in done:
                found = future.result()
                del waiting[future]
                yield found
    except (BrokenExecutor, CancelledError, OSError) as error:
        if lost is None or not isinstance(error, BrokenProcessPool):
            hint = message(
                "the memory may be too small: run the same command with --jobs 1 to continue"
            )
            raise PageError.at("print", message("a worker ended suddenly"), hint=hint) from error
    finally:
        for future in waiting:
            future.cancel()
    assert lost is not None
    yield from one_by_one(work, chain.from_iterable(waiting.values()), lost)
    with processes(workers) as fresh:
        yield from results(fresh, workers, work, left, lost)


def one_by_one(
    work: Callable[[Sequence[Given]], Result],
    items: Iterable[Given],
    lost: Callable[[Given], Result],
) -> Iterator[Result]:
    """The result of each item, alone in a process; ``lost`` for an item that ends its process."""
    left = deque(items)
    while left:
        with processes(1) as pool:
            while left:
                try:
                    found = pool.submit(work, [left[0]]).result()
                except BrokenProcessPool:
                    yield lost(left.popleft())
                    break
                left.popleft()
                yield found
