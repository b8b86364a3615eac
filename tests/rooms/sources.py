"""What the modules of the house import, keep and name: each is parsed once."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
HOUSE = ROOT / "graphkin"
SOURCES = sorted(HOUSE.rglob("*.py"))


class Source(NamedTuple):
    """Imports by line and dotted name, decorators of functions whose results are kept by line, and
    names of classes, also of those within others."""

    imports: tuple[tuple[int, str], ...]
    caches: tuple[tuple[int, int | None], ...]
    classes: tuple[str, ...]


@cache
def source(path: Path, house: Path = HOUSE) -> Source:
    """A module of a house."""
    package = ("graphkin", *path.relative_to(house).parent.parts)
    return read(path.read_text(encoding="utf-8"), package)


def read(text: str, package: tuple[str, ...] = ("graphkin",)) -> Source:
    """The text of a module of a package."""
    every = list(ast.walk(ast.parse(text)))
    return Source(
        tuple(found for node in every for found in imported(node, package)),
        tuple(found for node in every for found in kept(node)),
        tuple(node.name for node in every if isinstance(node, ast.ClassDef)),
    )


def imported(node: ast.AST, package: tuple[str, ...]) -> Iterator[tuple[int, str]]:
    """Line and dotted name, below graphkin, of what an import brings, also inside functions."""
    if isinstance(node, ast.Import):
        names = [alias.name for alias in node.names]
    elif isinstance(node, ast.ImportFrom):
        start = package[: len(package) - node.level + 1] if node.level else ()
        base = ".".join((*start, *filter(None, [node.module])))
        names = [f"{base}.{alias.name}" for alias in node.names]
    else:
        return
    for name in names:
        if name.partition(".")[0] == "graphkin":
            yield node.lineno, name.partition(".")[2]


def kept(node: ast.AST) -> Iterator[tuple[int, int | None]]:
    """The line of a decorator that keeps results, and how many; None where it is not said."""
    for found in getattr(node, "decorator_list", ()):
        name = ast.unparse(found).partition("(")[0].rpartition(".")[2]
        if name in ("cache", "lru_cache"):
            given = {word.arg: word.value for word in getattr(found, "keywords", ())}
            size = given.get("maxsize")
            yield found.lineno, size.value if isinstance(size, ast.Constant) else None
