"""Which small mistakes no test finds: ``python -m tests.bench.mutants 12 --seed 1``.

A mutant is the program with one sign, operator, comparison, constant or pair of arguments wrong.
All tests run once in a copy in which every mutant stands beside what is right, which keeps which of
them come by it, and in what time (``--rooms`` for some rooms of them); then each mutant is tried by
these, the quickest first, for at most ``--seconds``, until the first that fails
(``mutant_trials``). What no test comes by, for it stands outside of all functions, is tried in a
copy of its own by the tests that import its module, those of its room and what is kept of all
outputs. ``-j`` says how many processes run at once, ``--only PATH…`` takes the mutants from some
modules, ``--from`` goes on in the list. What survives is printed with its line; a survivor wants a
test, or is equivalent: ``survivors.txt`` keeps those of the last run with a word each.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from importlib.util import cache_from_source
from itertools import accumulate
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from tests.bench.mutant_trials import SWITCH

ROOT = Path(__file__).resolve().parents[2]
ENDLESS = 900
"""Seconds of a processor after which a mutant counts as found: it does not come to an end."""
PATIENCE = 4 * 3600
"""Seconds after which one that only waits counts as found."""
ROOMS = sorted({path.parts[-2] for path in (ROOT / "tests").glob("*/test_*.py")} - {"bench"})
"""The rooms of the tests, by which mutants are tried."""
NOTHING = 5
"""What pytest ends with where it finds no test."""
FLAGS = ("strict", "frozen", "slots")
"""Keywords with which zip and dataclass only refuse what no caller does."""
SWAPPED: dict[type[ast.AST], type[ast.AST]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
    ast.And: ast.Or,
    ast.Or: ast.And,
}


class Mutant(NamedTuple):
    """A module with one expression of it, at a column of a line in UTF-8, written otherwise."""

    path: Path
    line: int
    column: int
    before: str
    after: str


def otherwise(node: ast.AST) -> ast.expr | None:
    """An expression with one mistake in it; None where there is none to make."""
    match node:
        case ast.BinOp(left, op, right) if type(op) in SWAPPED:
            return ast.BinOp(left, SWAPPED[type(op)](), right)
        case ast.Compare(left, [op], others) if type(op) in SWAPPED:
            return ast.Compare(left, [SWAPPED[type(op)]()], others)
        case ast.BoolOp(op, values):
            return ast.BoolOp(SWAPPED[type(op)](), values)
        case ast.UnaryOp(ast.USub() | ast.Not(), operand):
            return operand
        case ast.Constant(bool(value)):
            return ast.Constant(not value)
        case ast.Constant(int(value)):
            return ast.Constant(value + 1)
        case ast.Constant(float(value)):
            return ast.Constant(value * 1.01 if value else 1.0)
        case ast.Call(func, [one, other, *rest], keywords) if ast.dump(one) != ast.dump(other):
            return ast.Call(func, [other, one, *rest], keywords)
    return None


def idle(tree: ast.AST) -> set[ast.AST]:
    """What nothing runs or only refuses wrong programs: annotations, FLAGS; and what lies in
    f-strings, where the place of a node may be that of the whole."""
    roots = [
        getattr(node, name, None) for node in ast.walk(tree) for name in ("annotation", "returns")
    ]
    roots += [
        node.value for node in ast.walk(tree) if isinstance(node, ast.keyword) and node.arg in FLAGS
    ]
    roots += [node for node in ast.walk(tree) if isinstance(node, ast.JoinedStr)]
    return {inner for root in roots if root is not None for inner in ast.walk(root)}


def mutants(path: Path) -> Iterator[Mutant]:
    """Every mutant of a module whose mistake stands on one line."""
    source = path.read_bytes()
    tree, lines = ast.parse(source), source.splitlines()
    still = idle(tree)
    for node in ast.walk(tree):
        made = None if node in still else otherwise(node)
        if made is None or node.lineno != node.end_lineno:
            continue
        before = lines[node.lineno - 1][node.col_offset : node.end_col_offset].decode()
        after = f"({ast.unparse(made)})"
        yield Mutant(path.relative_to(ROOT), node.lineno, node.col_offset, before, after)


def nearest(path: Path) -> Iterator[list[str]]:
    """What tries a module: the tests that import it, those of its own name first, those of its
    room, what is kept of all."""
    *packages, name = path.with_suffix("").parts
    told = re.compile(
        rf"\b{'.'.join((*packages, name))}\b|from {'.'.join(packages)} import [^\n]*\b{name}\b"
    )
    texts = {each: each.read_text(encoding="utf-8") for each in ROOT.glob("tests/**/test_*.py")}
    found = [each for each, text in texts.items() if told.search(text)]
    found.sort(key=lambda each: (name not in each.stem, path.parts[1] not in each.parts))
    yield [str(each.relative_to(ROOT)) for each in found]
    room = Path("tests") / path.parts[1]
    yield [str(room)] if (ROOT / room).is_dir() else []
    yield ["tests/golden"]


def copy_of(folder: Path) -> Path:
    """A copy of the program and its tests."""
    copy = folder / "copy"
    listed = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True)
    for path in filter(None, listed.split("\0")):
        (copy / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / path, copy / path)
    return copy


def switched(copy: Path, chosen: Sequence[Mutant]) -> None:
    """Put every mutant that can stand there into its place in a copy, beside what is right."""
    (copy / "sitecustomize.py").write_text(SWITCH, encoding="utf-8")
    ends: dict[tuple[Path, int], int] = {}
    for number, mutant in sorted(enumerate(chosen), key=lambda each: each[1], reverse=True):
        place, before = (mutant.path, mutant.line), mutant.before
        module = copy / mutant.path
        if mutant.column + len(before.encode()) > ends.get(place, sys.maxsize):
            continue  # one within another
        both = f"({mutant.after} if __mutant__({number}) else ({before}))"
        source = written(module.read_bytes(), mutant, both)
        with suppress(SyntaxError):  # as in a pattern
            compile(source, str(module), "exec")
            module.write_bytes(source)
            ends[place] = mutant.column


def written(source: bytes, mutant: Mutant, after: str) -> bytes:
    """A module with something else in a mutant's place."""
    lines = source.splitlines(keepends=True)
    line, end = lines[mutant.line - 1], mutant.column + len(mutant.before.encode())
    lines[mutant.line - 1] = line[: mutant.column] + after.encode() + line[end:]
    return b"".join(lines)


def reached(copy: Path, rooms: Sequence[str], jobs: int) -> dict[int, list[tuple[float, str]]]:
    """The tests that come by each mutant, the quickest first; without those that fail anyway."""
    found: dict[int, list[tuple[float, str]]] = defaultdict(list)
    files = [copy.parent / f"{room}.reached" for room in rooms]
    with ThreadPoolExecutor(jobs) as pool:
        runs = [
            pool.submit(run, copy, [f"tests/{room}"], REACHED=str(kept))
            for room, kept in zip(rooms, files, strict=True)
        ]
    assert all(each.result() >= 0 for each in runs)
    for kept in files:
        times: dict[str, float] = defaultdict(float)
        for line in lines_of(kept.with_suffix(".times")):
            test, seconds, outcome = line.rsplit("\t", 2)
            times[test] += float(seconds) if outcome == "passed" else inf
        for line in lines_of(kept):
            number, _, test = line.partition("\t")
            if times.get(test, inf) < inf:
                found[int(number)].append((times[test], test))
    return {number: sorted({*tests}) for number, tests in found.items()}


def lines_of(path: Path) -> list[str]:
    """The lines of a file, none where it is not there."""
    return path.read_text(encoding="utf-8").splitlines() if path.is_file() else []


def tried(
    copy: Path, tests: Mapping[int, Sequence[tuple[float, str]]], most: float, jobs: int
) -> set[int]:
    """Those of some mutants that a test finds which comes by, in at most so many seconds."""
    trials = []
    for number, timed in tests.items():
        sums = accumulate(seconds for seconds, _ in timed)
        within = [test for whole, (_, test) in zip(sums, timed, strict=True) if whole <= most]
        trials.append((number, within or [timed[0][1]]))
    found = set[int]()
    shares = {copy.parent / f"{k}.tried": trials[k::jobs] for k in range(jobs) if trials[k::jobs]}
    runs = []
    with ThreadPoolExecutor(jobs) as pool:
        for path, some in shares.items():
            path.write_text(json.dumps(some), encoding="utf-8")
            files = sorted({test.partition("::")[0] for _, own in some for test in own})
            runs.append(pool.submit(run, copy, files, TRIED=str(path)))
    assert not any(each.result() for each in runs), "the tests could not be tried"
    for path in shares:
        fates = (line.split("\t", 1) for line in lines_of(path.with_suffix(".fates")))
        found |= {int(number) for number, fate in fates if fate}
    return found


def survives(copy: Path, mutant: Mutant) -> bool:
    """Whether no test near a mutant, and no kept output, changes where it alone is written."""
    module = copy / mutant.path
    right = module.read_bytes()
    try:
        put(module, written(right, mutant, mutant.after))
        return all(run(copy, tests) in (0, NOTHING) for tests in nearest(mutant.path) if tests)
    finally:
        put(module, right)


def put(module: Path, source: bytes) -> None:
    """Write a module, and forget what was compiled of it."""
    module.write_bytes(source)
    Path(cache_from_source(str(module))).unlink(missing_ok=True)


def run(copy: Path, tests: Sequence[str], **told: str) -> int:
    """Run some tests in a copy until the first that fails, or all for the plugin; its status."""
    command = [sys.executable, "-m", "pytest", "-q", "-n", "0", "-p", "no:cacheprovider"]
    command += ["-p", "tests.bench.mutant_trials"] if told else ["-x"]
    surroundings = {**os.environ, "PYTHONPATH": str(copy), "PYTHONDONTWRITEBYTECODE": "", **told}
    with subprocess.Popen(
        [*command, *tests],
        cwd=copy,
        env=surroundings,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as ran:
        if told:
            return ran.wait()
        resource.prlimit(ran.pid, resource.RLIMIT_CPU, (ENDLESS, ENDLESS))
        try:
            return ran.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            ran.kill()
            return -1


def main(words: Sequence[str] | None = None) -> None:
    """Try some mutants, and print those that survive."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("count", type=int, nargs="?", default=12)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--from", type=int, default=0, metavar="N", dest="first")
    parser.add_argument("-j", type=int, default=os.cpu_count() or 1, metavar="N", dest="jobs")
    parser.add_argument("--only", nargs="+", type=Path, metavar="PATH")
    parser.add_argument("--rooms", nargs="+", default=ROOMS, choices=ROOMS, metavar="ROOM")
    parser.add_argument("--seconds", type=float, default=60.0)
    given = parser.parse_args(words)
    paths = given.only or sorted((ROOT / "graphkin").rglob("*.py"))
    every = [mutant for path in paths for mutant in mutants(path.resolve())]
    chosen = random.Random(given.seed).sample(every, min(given.count, len(every)))[given.first :]
    with TemporaryDirectory() as one, TemporaryDirectory() as other:
        copy, alone = copy_of(Path(one)), copy_of(Path(other))
        switched(copy, chosen)
        tests = reached(copy, given.rooms, given.jobs)
        found = tried(copy, tests, given.seconds, given.jobs)
        for number, mutant in enumerate(chosen):
            alive = number not in found and (number in tests or survives(alone, mutant))
            fate = "SURVIVES" if alive else "found"
            place = f"{mutant.path}:{mutant.line}"
            print(f"{fate:8} {place}: {mutant.before} → {mutant.after}", flush=True)


if __name__ == "__main__":
    main()
