"""Which tests come by which blocks of the program: what the trials of mutants go by.

A copy of the program says at the head of every block (the body of a function, a branch, a loop)
that a test comes by. All tests run in it once, a room at a time; which blocks each came by, and its
seconds, are kept for every list of mutants (``KEPT``). A room whose tests have changed runs again;
a block keeps its name (its function, and its number there) when other lines move.
"""

from __future__ import annotations

import ast
import json
from collections import defaultdict
from collections.abc import Iterator, Sequence
from hashlib import sha256
from math import inf
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / ".pytest_cache" / "blocks"
"""Where the blocks are kept that the tests of each room come by."""
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
COMPILED = "numba.njit"
"""What stands in a module whose functions a compiler reads: their blocks say nothing."""


class Block(NamedTuple):
    """A block: its function, its number there, its first line that does something, its last."""

    function: str
    number: int
    first: int
    last: int


class Come(NamedTuple):
    """What the tests of a room come by: the seconds of each test, the tests of each block."""

    seconds: dict[str, float]
    tests: dict[str, list[str]]


def blocks(source: str) -> list[Block]:
    """The blocks of all functions of a module, each before those within."""
    return [] if COMPILED in source else [*inner(ast.parse(source), "", [])]


def inner(node: ast.AST, name: str, count: list[int]) -> Iterator[Block]:
    """The blocks within a node, counted in their function."""
    for _, found in ast.iter_fields(node):
        if not (isinstance(found, list) and found):
            continue
        chained = isinstance(node, ast.If) and found[0].col_offset == node.col_offset  # an elif
        beside = isinstance(node, FUNCTIONS) and found[0].lineno == node.lineno  # an overload
        if count and isinstance(found[0], ast.stmt) and not chained and not beside:
            yield Block(name, count[0], head(found), found[-1].end_lineno)
            count[0] += 1
        for each in found:
            if isinstance(each, FUNCTIONS):
                yield from inner(each, f"{name}.{each.name}", [0])
            elif isinstance(each, ast.ClassDef):
                yield from inner(each, f"{name}.{each.name}", [])
            elif isinstance(each, (ast.stmt, ast.ExceptHandler, ast.match_case)):
                yield from inner(each, name, count)


def head(body: Sequence[ast.stmt]) -> int:
    """The first line of a block after what it says of itself."""
    says = isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant)
    first = body[1] if says and len(body) > 1 else body[0]
    return min(each.lineno for each in [first, *getattr(first, "decorator_list", [])])


def called(path: Path, block: Block) -> str:
    """The name by which a block is kept."""
    return f"{path}{block.function}:{block.number}"


def told(copy: Path) -> list[str]:
    """Have every block of a copy of the program say that it is come by; their names by number."""
    names: list[str] = []
    for path in sorted(copy.glob("graphkin/**/*.py")):
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
        for block in sorted(blocks("".join(lines)), key=lambda each: -each.first):
            line = lines[block.first - 1]
            space = line[: len(line) - len(line.lstrip())]
            lines.insert(block.first - 1, f"{space}__come__({len(names)})\n")
            names.append(called(path.relative_to(copy), block))
        path.write_text("".join(lines), encoding="utf-8")
    return names


def summed(room: str) -> str:
    """What changes where a test of a room changes."""
    files = sorted((ROOT / "tests" / room).rglob("*.py"))
    return sha256(b"\0".join(each.read_bytes() for each in files)).hexdigest()


def keep(room: str, reached: Path, names: Sequence[str]) -> None:
    """Keep what the tests of a room came by, as the plugin wrote it."""
    seconds: dict[str, float] = {}
    tests = defaultdict[str, list[str]](list)
    for line in reached.read_text(encoding="utf-8").splitlines():
        test, took, outcome, own = line.split("\t")
        seconds[test] = float(took) if outcome == "passed" else inf
        for each in own.split():
            tests[names[int(each)]].append(test)
    KEPT.mkdir(parents=True, exist_ok=True)
    found = json.dumps([summed(room), seconds, tests])
    (KEPT / f"{room}.json").write_text(found, encoding="utf-8")


def kept(room: str, as_known: bool) -> Come | None:
    """What the tests of a room come by; None where it is not known as they are, or at all."""
    path = KEPT / f"{room}.json"
    if not path.is_file():
        return None
    as_they_were, *found = json.loads(path.read_text(encoding="utf-8"))
    return Come(*found) if as_known or as_they_were == summed(room) else None
