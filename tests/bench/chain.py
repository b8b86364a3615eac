"""How the cost grows with the number of links: chains of 2 to 200 dyads, and the fitted exponent.

A crank-rocker whose rocker drives the next by a parallel rod, and so on. The exponent is the slope
of the logarithms over the larger chains: 1 is as many times the work for as many times the links.
Seconds are those of the processor; with OPENBLAS_NUM_THREADS=1 no second core counts among them.
"""

from __future__ import annotations

import math
import timeit
from collections.abc import Callable
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import numpy as np

from graphkin.construction.compile import write
from graphkin.construction.core.run import run_blocks
from graphkin.construction.core.solution import gathered
from graphkin.construction.tape.emitted import BatchRunner
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import batch_kind
from graphkin.scene.read_scene import read_scene
from graphkin.structure.decomposition import decompose

DYADS = (2, 5, 10, 20, 50, 100, 200)
FITTED = 20
"""The shortest chain that counts for the exponent."""
POSITIONS = 2_000

HEAD = """
graphkin = 1
title = "Chain"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[parameters]
phi = { value = 40 }
[[drivers]]
turn = "crank"
angle = "phi"
speed = 10
"""


def scene(dyads: int) -> str:
    """The text of a chain of dyads RRR; the last rocker shares the pivot of the one before it."""
    pivots = "\n".join(f"O{k} = [{100 * k}, 0]" for k in range(dyads))
    links, sides = ["[links.crank]\nO0-B0 = 40"], ["[branches]"]
    for k in range(1, dyads + 1):
        pivot, rod = (k, 100) if k < dyads else (k - 1, 60)
        links += [f"[links.rod{k}]\nB{k - 1}-B{k} = {rod}"]
        links += [f"[links.rocker{k}]\nO{pivot}-B{k} = 60"]
        sides += [f'B{k} = "left of B{k - 1}-O{pivot}"']
    return "\n".join([HEAD, "[frame]", pivots, *links, *sides, ""])


def timed(work: Callable[[], Any]) -> float:
    """Shortest of some calls in seconds of the processor, fewer of slow ones."""
    first = timeit.timeit(work, number=1, timer=process_time)
    count = max(3, min(20, int(1 / max(first, 1e-6))))
    return min([first, *timeit.repeat(work, number=1, repeat=count, timer=process_time)])


def costs(dyads: int) -> dict[str, float]:
    """What each part of the work takes for one chain, in seconds."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "chain.toml"
        path.write_text(scene(dyads), encoding="utf-8")
        found = {"reading the scene": timed(partial(read_scene, path))}
        read = read_scene(path)
    found["finding the groups"] = timed(partial(decompose, read))
    groups = decompose(read)
    found["writing the program"] = timed(partial(write, read, groups))
    mechanism = Mechanism(read)
    program = mechanism.program
    found["choosing the steps"] = timed(partial(program.needed, program.targets))
    found["one position"] = timed(mechanism.trace)
    for name, targets in (("everything", None), ("one velocity", [("velocity", "B1")])):
        solution = gathered(mechanism.trace(targets))
        found[f"the check of {name}"] = timed(partial(mechanism.witness, solution))
    needed, keep = program.needed(program.targets), list(program.targets.values())
    values = {"phi": np.linspace(0, 360, POSITIONS, endpoint=False)}
    press = BatchRunner(program)
    with np.errstate(all="ignore"):
        run = partial(run_blocks, program, needed, values, batch_kind(), keep)
        found[f"{POSITIONS} positions, step by step"] = timed(run)
        emit = partial(press.run, needed, values, keep, way="numpy")
        found["tracing and writing source"] = timed(lambda: emitted_anew(press, emit))
        found[f"{POSITIONS} positions, emitted"] = timed(emit)
    return found


def emitted_anew(press: BatchRunner, run: Callable[[], Any]) -> None:
    """Trace and run once, nothing kept from before."""
    press.kept.clear()
    run()


def exponent(sizes: tuple[int, ...], seconds: list[float]) -> float:
    """The slope of log seconds over log sizes, by least squares over the larger chains."""
    pairs = [(math.log(n), math.log(t)) for n, t in zip(sizes, seconds, strict=True) if n >= FITTED]
    xs, ys = zip(*pairs, strict=True)
    return float(np.polyfit(xs, ys, 1)[0])


def table(sizes: tuple[int, ...] = DYADS) -> str:
    """Milliseconds for each length of chain, and the exponent."""
    every = [costs(n) for n in sizes]
    head = "".join(f"{n:>9}" for n in sizes)
    lines = [f"{'dyads':32}{head}  exponent"]
    for part in every[0]:
        seconds = [found[part] for found in every]
        cells = "".join(f"{t * 1e3:9.2f}" for t in seconds)
        lines.append(f"{part + ', ms':32}{cells}{exponent(sizes, seconds):10.2f}")
    return "\n".join(lines)


if __name__ == "__main__":
    print(table())
