"""Whoever draws a thousand classes in one process needs no more room than for one."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import graphkin

SOURCES = sorted(Path(graphkin.__file__).parent.rglob("*.py"))
MOST = 4096


def caches(source: str) -> Iterator[tuple[int, ast.expr]]:
    """The line and the decorator of each function whose results are kept."""
    for node in ast.walk(ast.parse(source)):
        for found in getattr(node, "decorator_list", ()):
            name = ast.unparse(found).partition("(")[0].rpartition(".")[2]
            if name in ("cache", "lru_cache"):
                yield found.lineno, found


def room(found: ast.expr) -> int | None:
    """How many results a cache keeps; None where it is not said."""
    given = {word.arg: word.value for word in getattr(found, "keywords", ())}
    size = given.get("maxsize")
    return size.value if isinstance(size, ast.Constant) else None


def test_no_cache_grows_without_bound():
    sizes = {
        f"{path.name}:{line}": room(found)
        for path in SOURCES
        for line, found in caches(path.read_text(encoding="utf-8"))
    }
    assert len(sizes) > 10
    assert {place: size for place, size in sizes.items() if not 0 < (size or 0) <= MOST} == {}


def test_a_cache_without_bound_is_seen():
    for kept in ("cache", "functools.cache", "lru_cache", "lru_cache()", "lru_cache(maxsize=None)"):
        ((_, found),) = caches(f"@{kept}\ndef f(x): return x")
        assert room(found) is None
