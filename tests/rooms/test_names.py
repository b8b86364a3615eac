"""One name, one thing: no two modules and no two classes of the house are called alike."""

from __future__ import annotations

import ast
from collections import defaultdict
from pathlib import Path

import graphkin

HOUSE = Path(graphkin.__file__).parent
SOURCES = sorted(HOUSE.rglob("*.py"))


def shared(named: dict[str, list[str]]) -> dict[str, list[str]]:
    """The names that several bear."""
    return {name: places for name, places in named.items() if len(places) > 1}


def classes(source: str) -> list[str]:
    """The names of all classes of a module, also of those within others."""
    return [node.name for node in ast.walk(ast.parse(source)) if isinstance(node, ast.ClassDef)]


def test_no_two_modules_have_one_name():
    named: dict[str, list[str]] = defaultdict(list)
    for path in SOURCES:
        if path.name != "__init__.py":
            named[path.name].append(str(path.relative_to(HOUSE)))
    assert shared(named) == {}


def test_no_two_classes_have_one_name():
    named: dict[str, list[str]] = defaultdict(list)
    for path in SOURCES:
        for name in classes(path.read_text(encoding="utf-8")):
            named[name].append(str(path.relative_to(HOUSE)))
    assert shared(named) == {}


def test_a_class_within_another_is_seen():
    source = "class A:\n    class B: ...\ndef f():\n    class C: ..."
    assert sorted(classes(source)) == ["A", "B", "C"]
