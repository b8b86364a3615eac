"""A plugin of pytest that tries mutants: what each test comes by, and which mutants it fails.

In one copy of the program blocks say that a test comes by (``COME`` names the file that keeps it).
In another every mutant stands beside what is right, ``((wrong) if __mutant__(7) else (right))``:
the tests are collected once, and a process forks for each mutant, so that nothing that a test
keeps is the next one's (``TRIED`` names the mutants with their tests, and is told the fates).
"""

from __future__ import annotations

import builtins
import json
import os
import resource
import signal
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

SWITCH = '''"""Says which mutant is at work, in every process."""
import builtins
import os

at_work = [int(os.environ.get("MUTANT", -1))]
builtins.__mutant__, builtins.__switch__ = (lambda number: number == at_work[0]), at_work
'''
"""What stands as ``sitecustomize.py`` in the copy with mutants."""
SAYS = '''"""Takes what a block says."""
import builtins

builtins.__come__ = set().add
'''
"""The same in the copy whose blocks say that a test comes by."""
ENDLESS = 300
"""Seconds of a processor after which a mutant counts as found: it does not come to an end."""
WAITS = 4 * ENDLESS
"""Seconds after which one that only waits counts as found."""
RIGHT = -1
"""The number of no mutant."""
failed: list[str] = []


@pytest.hookimpl(hookwrapper=True, tryfirst=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Keeps which blocks a test comes by, and its seconds of a processor."""
    come, before = set[int](), used()
    builtins.__come__ = come.add
    failed.clear()
    yield
    builtins.__come__ = set().add
    if "COME" in os.environ:
        fate, own = "failed" if failed else "passed", " ".join(map(str, sorted(come)))
        with Path(os.environ["COME"]).open("a", encoding="utf-8") as kept:
            kept.write(f"{item.nodeid}\t{used() - before:.3f}\t{fate}\t{own}\n")


def used() -> float:
    """Seconds of a processor that this process and those it waited for took."""
    every = map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in every)


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Keeps that a test fails."""
    if report.failed:
        failed.append(report.nodeid)


def pytest_runtestloop(session: pytest.Session) -> bool | None:
    """Tries each mutant by its tests, in a process of its own."""
    if "TRIED" not in os.environ:
        return None
    path = Path(os.environ["TRIED"])
    items = {item.nodeid: item for item in session.items}
    with path.with_suffix(".fates").open("w", encoding="utf-8") as fates:
        for number, tests in json.loads(path.read_text(encoding="utf-8")):
            fate = found_by(number, [items[test] for test in tests if test in items])
            fates.write(f"{number}\t{fate}\n")
            fates.flush()
    return True


def found_by(number: int, items: Sequence[pytest.Item]) -> str:
    """The first test that finds a mutant; nothing if it survives all.

    One that fails finds it only if it fails by itself, too, and does not where nothing is wrong:
    in another order a test may fail of what others before it have kept.
    """
    while fate := tried(number, items):
        places = [place for place, item in enumerate(items) if item.nodeid == fate]
        alone = [items[place] for place in places]
        if not alone or (tried(number, alone) and not tried(RIGHT, alone)):
            return fate
        items = items[places[0] + 1 :]
    return ""


def tried(number: int, items: Sequence[pytest.Item]) -> str:
    """The first test that fails with a mutant at work; nothing if none does."""
    out, into = os.pipe()
    if (child := os.fork()) == 0:
        os.setpgid(0, 0)
        resource.setrlimit(resource.RLIMIT_CPU, (ENDLESS, ENDLESS))
        builtins.__switch__[0] = number
        os.environ["MUTANT"] = str(number)
        fate = "breaks the run"
        try:
            fate = first_failed(items)
        finally:
            os.write(into, b"." + fate.encode()[:4000])
            os._exit(0)
    last = time.monotonic() + WAITS
    while os.waitpid(child, os.WNOHANG) == (0, 0):
        if time.monotonic() > last:
            os.killpg(child, signal.SIGKILL)
            os.waitpid(child, 0)
            break
        time.sleep(0.02)
    os.write(into, b"\n")  # where nothing was told, a process that it left may hold the pipe open
    told = os.read(out, 5000).decode().strip()
    os.close(into)
    os.close(out)
    return told[1:] if told else "does not come to an end"


def first_failed(items: Sequence[pytest.Item]) -> str:
    """Runs tests until one fails."""
    for item, after in zip(items, [*items[1:], None], strict=True):
        item.config.hook.pytest_runtest_protocol(item=item, nextitem=after)
        if failed:
            return failed[0]
    return ""
