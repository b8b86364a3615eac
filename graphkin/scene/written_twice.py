"""Keys and tables that a TOML text has twice: where both stand, and the text read without them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import Any

from graphkin.scene.findings import shown_key
from graphkin.scene.toml_spans import Again, Path, walked
from graphkin.text.errors import InLine, Problem

SPARE = "\ue000"
"""Begins the name that a key gets instead of one which is taken: a sign of no alphabet."""


def written_twice(text: str) -> tuple[list[Problem], str, list[Again]]:
    """What stands twice in a text, the text with other names for it, and where it was."""
    again = walked(text).again
    problems = [problem_of(text, each) for each in again]
    for number, each in reversed([*enumerate(again)]):
        text = f'{text[: each.key.start]}"{SPARE}{number}"{text[each.key.end :]}'
    return problems, text, again


def problem_of(text: str, each: Again) -> Problem:
    """The problem of a key or a table, at its second place."""
    first, at = (text.count("\n", 0, start) + 1 for start in (each.first.start, each.key.start))
    place = InLine(at, each.key.start - text.rfind("\n", 0, each.key.start))
    found = f"{dotted(each.path)} is written twice, first in line {first}"
    if each.heading:
        said = "one heading of a table", "write all of it under the first"
    else:
        said = (
            "one value of a key",
            "take out one of the two, unless a heading is missing between them",
        )
    return Problem(str(place), found, *said, about=(place,))


def dotted(path: Path) -> str:
    """A path as messages write it: ``drivers[0].speed``."""
    keys = (f"[{key}]" if isinstance(key, int) else f".{shown_key(key)}" for key in path)
    return "".join(keys).removeprefix(".")


def read_once(tables: dict[str, Any], again: Iterable[Again]) -> dict[str, Any]:
    """The tables of a text with other names: a key has its first value, a table all its keys."""
    for number, each in enumerate(again):
        own = tables.pop(f"{SPARE}{number}", None)
        if isinstance(own, dict) and isinstance(whole := inside(tables, each.path), dict):
            whole |= own | whole
    for table in within(tables):
        for key in [key for key in table if key.startswith(SPARE)]:
            del table[key]
    return tables


def inside(value: Any, path: Path) -> Any:
    """What stands at a path; None where nothing does."""
    with suppress(LookupError, TypeError):
        for key in path:
            value = value[key]
        return value
    return None


def within(value: Any) -> Iterator[dict[str, Any]]:
    """A table and all tables within it."""
    if isinstance(value, dict):
        yield value
    for each in value.values() if isinstance(value, dict) else value:
        if isinstance(each, dict | list):
            yield from within(each)
