"""A whole turn of three linkages: ours against plain numpy, a peer library and a loop in C."""

from __future__ import annotations

import tempfile
import timeit
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from graphkin.construction.core.run import Trace, run_blocks
from graphkin.construction.tape.emitted import BatchRunner, Way
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.arithmetic import batch_kind
from tests.bench.four_bar_in_c import compiled
from tests.bench.linkages import PINS, SCENES, peer
from tests.bench.linkages_by_formulas import in_blocks

SIZES = (3_600, 36_000)
QUANTITIES = ("position", "velocity", "acceleration")


@dataclass(frozen=True)
class Turn:
    """A linkage with the angles of a full turn, ready to be run in several ways."""

    mechanism: Mechanism
    press: BatchRunner
    needed: tuple[int, ...]
    keep: tuple[int, ...]
    degrees: np.ndarray

    def plain(self) -> Trace:
        """The steps one after the other on arrays."""
        program, values = self.mechanism.program, {"phi": self.degrees}
        with np.errstate(all="ignore"):
            return run_blocks(program, self.needed, values, batch_kind(), self.keep)

    def emitted(self, way: Way) -> Trace:
        """The emitted source."""
        with np.errstate(all="ignore"):
            return self.press.run(self.needed, {"phi": self.degrees}, self.keep, way=way)


def mechanism_of(text: str) -> Mechanism:
    """The mechanism of a scene in words."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return load(path)


def turn_of(name: str, size: int) -> Turn:
    """A full turn of a linkage, all its moving pins asked."""
    mechanism = mechanism_of(SCENES[name])
    program = mechanism.program
    targets = [(quantity, pin) for pin in PINS[name] for quantity in QUANTITIES]
    keep = tuple(program.targets[target] for target in targets)
    degrees = np.linspace(0, 360, size, endpoint=False)
    return Turn(mechanism, BatchRunner(program), program.needed(targets), keep, degrees)


def best(work: Callable[[], object], repeat: int = 9) -> float:
    """Shortest time of one call in seconds, the call once warm."""
    work()
    timer = timeit.Timer(work)
    number, _ = timer.autorange()
    return min(timer.repeat(repeat, number)) / number


def once(work: Callable[[], object]) -> float:
    """Time of a first call in seconds."""
    return timeit.timeit(work, number=1)


def rows(name: str, size: int) -> list[tuple[str, float]]:
    """What each way takes for one position, in seconds."""
    turn = turn_of(name, size)
    ways: dict[str, Callable[[], Any]] = {
        "closed form, numpy": partial(in_blocks, name, turn.degrees)
    }
    if find_spec("pylinkage") and find_spec("numba"):
        ways["pylinkage, its numba path"] = peer(name, size)[0]
    ways["ours, step by step on arrays"] = turn.plain
    ways["ours, emitted numpy"] = partial(turn.emitted, "numpy")
    if find_spec("numba"):
        ways["ours, emitted and compiled"] = partial(turn.emitted, "numba")
    with tempfile.TemporaryDirectory() as folder:
        loop = compiled(Path(folder)) if name == "four-bar" else None
        if loop is not None:
            ways["a loop in C, cc -O3"] = partial(loop, turn.degrees)
        return [(way, best(work) / size) for way, work in ways.items()]


def settle() -> None:
    """Have and leave a large array, so that memory is had at the same cost from here on."""
    np.ones(3_000_000).sum()


def before(name: str) -> list[tuple[str, float]]:
    """What is spent once, before the first position: tracing, writing source, compiling."""
    found = []
    ways: tuple[tuple[str, Way], ...] = (("emitted numpy", "numpy"), ("compiled", "numba"))
    for words, way in ways:
        if way == "numba" and not find_spec("numba"):
            continue
        turn = turn_of(name, 1)
        turn_of("slider-crank", 1).emitted(way)
        found.append((words, once(partial(turn.emitted, way))))
    return found


def table() -> str:
    """All rows as one text: nanoseconds a position, and how many times the closed form's."""
    lines = []
    settle()
    for name in SCENES:
        for size in SIZES:
            found = rows(name, size)
            first, fair = found[0][1], dict(found).get("pylinkage, its numba path")
            for way, seconds in found:
                faster = f"{fair / seconds:7.1f} × the peer's speed" if fair else ""
                lines.append(
                    f"{name:13}{size:7} {way:30} {seconds * 1e9:7.1f} ns "
                    f"{seconds / first:6.2f} × closed form {faster}"
                )
        lines += [f"{name:13}   once: {way:23} {t * 1e3:7.1f} ms" for way, t in before(name)]
    return "\n".join(lines)


if __name__ == "__main__":
    print(table())
