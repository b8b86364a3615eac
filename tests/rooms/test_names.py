"""One name, one thing: no two modules and no two classes of the house are called alike."""

from __future__ import annotations

from collections import defaultdict

from tests.rooms.sources import HOUSE, SOURCES, read, source


def shared(named: dict[str, list[str]]) -> dict[str, list[str]]:
    """The names that several bear."""
    return {name: places for name, places in named.items() if len(places) > 1}


def test_no_two_modules_have_one_name():
    named: dict[str, list[str]] = defaultdict(list)
    for path in SOURCES:
        if path.name != "__init__.py":
            named[path.name].append(str(path.relative_to(HOUSE)))
    assert shared(named) == {}


def test_no_two_classes_have_one_name():
    named: dict[str, list[str]] = defaultdict(list)
    for path in SOURCES:
        for name in source(path).classes:
            named[name].append(str(path.relative_to(HOUSE)))
    assert shared(named) == {}


def test_a_class_within_another_is_seen():
    text = "class A:\n    class B: ...\ndef f():\n    class C: ..."
    assert sorted(read(text).classes) == ["A", "B", "C"]
