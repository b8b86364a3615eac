"""Which small mistakes no test finds: ``python -m tests.bench.mutants 12 --seed 1``.

A mutant is the program with one sign, operator, comparison, constant or pair of arguments wrong.
Each is tried in a copy by the tests that import its module, by those of its room and by those of
what is kept of all outputs, until the first that fails; as many at once as ``-j`` says, each in one
process. ``--only PATH…`` takes the mutants from some modules, ``--from`` goes on in the list. What
survives is printed with its line; a survivor wants a test, or is equivalent: ``survivors.txt``
keeps those of the last run with a word each.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import re
import resource
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from importlib.util import cache_from_source
from pathlib import Path
from queue import SimpleQueue
from tempfile import TemporaryDirectory
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
ENDLESS = 900
"""Seconds of a processor after which a mutant counts as found: it does not come to an end."""
PATIENCE = 4 * 3600
"""Seconds after which one that only waits counts as found."""
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

    @property
    def source(self) -> str:
        """The module with the mistake."""
        lines = (ROOT / self.path).read_bytes().splitlines(keepends=True)
        line, end = lines[self.line - 1], self.column + len(self.before.encode())
        lines[self.line - 1] = line[: self.column] + self.after.encode() + line[end:]
        return b"".join(lines).decode()


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


def survives(mutant: Mutant, copies: SimpleQueue[Path]) -> bool:
    """Whether no test of the mutant's room, and no kept output, changes, in one of some copies."""
    copy = copies.get()
    module = copy / mutant.path
    right = module.read_bytes()
    try:
        put(module, mutant.source.encode())
        return not any(fails(copy, tests) for tests in nearest(mutant.path) if tests)
    finally:
        put(module, right)
        copies.put(copy)


def put(module: Path, source: bytes) -> None:
    """Write a module, and forget what was compiled of it."""
    module.write_bytes(source)
    Path(cache_from_source(str(module))).unlink(missing_ok=True)


def fails(copy: Path, tests: Sequence[str]) -> bool:
    """Whether one of some tests fails in a copy."""
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-n", "0", "-p", "no:cacheprovider"]
    surroundings = {**os.environ, "PYTHONPATH": str(copy), "PYTHONDONTWRITEBYTECODE": ""}
    with subprocess.Popen(
        [*command, *tests],
        cwd=copy,
        env=surroundings,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as ran:
        resource.prlimit(ran.pid, resource.RLIMIT_CPU, (ENDLESS, ENDLESS))
        try:
            return ran.wait(PATIENCE) not in (0, NOTHING)
        except subprocess.TimeoutExpired:
            ran.kill()
            return True


def main(words: Sequence[str] | None = None) -> None:
    """Try some mutants, and print those that survive."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("count", type=int, nargs="?", default=12)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--from", type=int, default=0, metavar="N", dest="first")
    parser.add_argument("-j", type=int, default=os.cpu_count() or 1, metavar="N", dest="jobs")
    parser.add_argument("--only", nargs="+", type=Path, metavar="PATH")
    told = parser.parse_args(words)
    paths = told.only or sorted((ROOT / "graphkin").rglob("*.py"))
    every = [mutant for path in paths for mutant in mutants(path.resolve())]
    chosen = random.Random(told.seed).sample(every, min(told.count, len(every)))[told.first :]
    with ExitStack() as stack, ThreadPoolExecutor(told.jobs) as pool:
        copies: SimpleQueue[Path] = SimpleQueue()
        for _ in range(told.jobs):
            copies.put(copy_of(Path(stack.enter_context(TemporaryDirectory()))))
        fates = pool.map(partial(survives, copies=copies), chosen)
        for mutant, alive in zip(chosen, fates, strict=True):
            fate = "SURVIVES" if alive else "found"
            place = f"{mutant.path}:{mutant.line}"
            print(f"{fate:8} {place}: {mutant.before} → {mutant.after}", flush=True)


if __name__ == "__main__":
    main()
