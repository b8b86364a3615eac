"""Which small mistakes no test finds: ``python -m tests.bench.mutants 60 --seed 1``.

A mutant is the program with one sign, operator, comparison, constant or pair of arguments wrong.
It is tried by the tests that come by its block (``blocks``; what stands outside of all functions by
those that come by a block with its name), the quickest first for at most ``--seconds``, then for as
long again by others of their rooms, for tests share what one of them makes: those with the same
subject first. The first that fails ends it, if it does by itself, too (``mutant_trials``).
``-j`` says how many processes run at once, ``--only PATH…`` takes the mutants from some modules,
``--from`` goes on in the list. Where it is not known which blocks the tests of a room come by, they
run first, which takes as long as the tests do; ``--known`` goes by what is known, as it was.

What survives is printed with its line and in how many tests; a survivor wants a test, or is
equivalent: ``survivors.txt`` keeps those of the last runs with a word each.
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
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import suppress
from importlib.util import cache_from_source
from itertools import accumulate
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from tests.bench.blocks import ROOT, Block, Come, blocks, called, keep, kept, told
from tests.bench.mutant_trials import SAYS, SWITCH

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


def copy_of(folder: Path) -> Path:
    """A copy of the program and its tests."""
    copy = folder / "copy"
    listed = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True)
    for path in filter(None, listed.split("\0")):
        (copy / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / path, copy / path)
    return copy


def switched(copy: Path, chosen: Sequence[Mutant]) -> list[int]:
    """Put every mutant that can stand there into its place in a copy, beside what is right; those
    of them that stand in a function, so that they can be switched."""
    (copy / "sitecustomize.py").write_text(SWITCH, encoding="utf-8")
    ends: dict[tuple[Path, int], int] = {}
    inside = []
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
            around = blocks((ROOT / mutant.path).read_text(encoding="utf-8"))
            if any(each.first <= mutant.line <= each.last for each in around):
                inside.append(number)
    return inside


def written(source: bytes, mutant: Mutant, after: str) -> bytes:
    """A module with something else in a mutant's place."""
    lines = source.splitlines(keepends=True)
    line, end = lines[mutant.line - 1], mutant.column + len(mutant.before.encode())
    lines[mutant.line - 1] = line[: mutant.column] + after.encode() + line[end:]
    return b"".join(lines)


def come_by(rooms: Sequence[str], jobs: int, as_known: bool) -> list[Come]:
    """Which tests come by which blocks, of each room; rooms where it is not known run now."""
    missing = [room for room in rooms if kept(room, as_known) is None]
    if missing:
        with TemporaryDirectory() as folder, ThreadPoolExecutor(jobs) as pool:
            copy = copy_of(Path(folder))
            names = told(copy)
            (copy / "sitecustomize.py").write_text(SAYS, encoding="utf-8")
            files = {room: Path(folder) / f"{room}.come" for room in missing}
            runs = {
                pool.submit(run, copy, [f"tests/{room}"], COME=str(path)): room
                for room, path in files.items()
            }
            for ran in as_completed(runs):
                assert ran.result() >= 0
                keep(runs[ran], files[runs[ran]], names)
    return [found for room in rooms if (found := kept(room, True))]


def tests_of(mutant: Mutant, come: Sequence[Come], most: float) -> list[str]:
    """The tests that try a mutant: those that come by it, then others of their rooms."""
    names = {called(*each) for each in blocks_of(mutant)}
    seconds = {test: took for own in come for test, took in own.seconds.items() if took < inf}
    found = {test for own in come for name in names for test in own.tests.get(name, ())}
    near = sorted(found & {*seconds}, key=lambda test: (seconds[test], test))
    files, rooms, subjects = ({part(test) for test in near} for part in (file_of, room_of, subject))

    def farther(test: str) -> tuple[bool, bool, float, str]:
        """What one test keeps others use: those of its subject, and of its file, come next."""
        return subject(test) not in subjects, file_of(test) not in files, seconds[test], test

    others = sorted((test for test in seconds if room_of(test) in rooms), key=farther)
    others = [test for test in others if test not in found]
    return [*within(near, seconds, most), *within(others, seconds, most)]


def file_of(test: str) -> str:
    """The file of a test."""
    return test.partition("::")[0]


def room_of(test: str) -> str:
    """The room of a test."""
    return test.split("/")[1]


def subject(test: str) -> str:
    """What a test is tried with."""
    return test.partition("[")[2]


def within(tests: Sequence[str], seconds: Mapping[str, float], most: float) -> list[str]:
    """The first of some tests that take so many seconds together; one at least."""
    sums = accumulate(seconds[test] for test in tests)
    return [test for test, whole in zip(tests, sums, strict=True) if whole <= most] or [*tests[:1]]


def blocks_of(mutant: Mutant) -> list[tuple[Path, Block]]:
    """The innermost block that a mutant stands in; outside of all, those with its name."""
    source = (ROOT / mutant.path).read_text(encoding="utf-8")
    around = [each for each in blocks(source) if each.first <= mutant.line <= each.last]
    if around:
        return [(mutant.path, max(around, key=lambda each: each.first))]
    names = re.compile(rf"\b({'|'.join(names_at(ast.parse(source), mutant.line)) or '$'})\b")
    found = []
    for path in sorted((ROOT / "graphkin").rglob("*.py")):
        lines = path.read_text(encoding="utf-8").splitlines()
        for each in blocks("\n".join(lines)) if names.search("\n".join(lines)) else ():
            if names.search("\n".join(lines[each.first - 1 : each.last])):
                found.append((path.relative_to(ROOT), each))
    return found


def names_at(tree: ast.AST, line: int) -> set[str]:
    """What a statement outside of all functions gives a name to."""
    found = set[str]()
    for node in ast.walk(tree):
        if isinstance(node, ast.stmt) and node.lineno <= line <= (node.end_lineno or 0):
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                found = {node.name}
            elif isinstance(node, (ast.Assign, ast.AnnAssign)):
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                found = {
                    each.id
                    for target in targets
                    for each in ast.walk(target)
                    if isinstance(each, ast.Name)
                }
    return found


def tried(copy: Path, tests: Mapping[int, Sequence[str]], jobs: int) -> dict[int, str]:
    """The first test that finds each of some mutants; empty for one that survives."""
    trials = [*tests.items()]
    shares = {copy.parent / f"{k}.tried": trials[k::jobs] for k in range(jobs) if trials[k::jobs]}
    runs = []
    with ThreadPoolExecutor(jobs) as pool:
        for path, some in shares.items():
            path.write_text(json.dumps(some), encoding="utf-8")
            files = {file_of(test) for _, own in some for test in own}
            files = sorted(file for file in files if (copy / file).is_file())  # those still there
            runs.append(pool.submit(run, copy, files, TRIED=str(path)))
    assert not any(each.result() for each in runs), "the tests could not be tried"
    found = {}
    for path in shares:
        for line in path.with_suffix(".fates").read_text(encoding="utf-8").splitlines():
            number, _, fate = line.partition("\t")
            found[int(number)] = fate
    return found


def alone(copy: Path, mutant: Mutant, tests: Sequence[str]) -> str:
    """Whether a test fails where one mutant alone is written, and none where it is not."""
    module = copy / mutant.path
    right = module.read_bytes()
    if not tests:
        return ""
    names = copy.parent / "alone"  # more of them than a command line holds
    names.write_text("\n".join(tests), encoding="utf-8")
    try:
        put(module, written(right, mutant, mutant.after))
        fails = run(copy, [f"@{names}"]) not in (0, NOTHING)
    finally:
        put(module, right)
    return "alone" if fails and run(copy, [f"@{names}"]) in (0, NOTHING) else ""


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
    parser.add_argument("--known", action="store_true")
    given = parser.parse_args(words)
    paths = given.only or sorted((ROOT / "graphkin").rglob("*.py"))
    every = [mutant for path in paths for mutant in mutants(path.resolve())]
    chosen = random.Random(given.seed).sample(every, min(given.count, len(every)))[given.first :]
    come = come_by(given.rooms, given.jobs, given.known)
    tests = [tests_of(mutant, come, given.seconds) for mutant in chosen]
    with TemporaryDirectory() as one, TemporaryDirectory() as other:
        copy, single = copy_of(Path(one)), copy_of(Path(other))
        inside = switched(copy, chosen)
        fates = tried(
            copy, {number: tests[number] for number in inside if tests[number]}, given.jobs
        )
        for number, mutant in enumerate(chosen):
            own = tests[number]
            fate = fates[number] if number in fates else alone(single, mutant, own)
            end = f"found by {fate}" if fate else f"SURVIVES {len(own)} tests"
            change = f"{mutant.before} → {mutant.after}"
            print(f"{mutant.path}:{mutant.line}: {change}: {end}", flush=True)


if __name__ == "__main__":
    main()
