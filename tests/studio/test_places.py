"""A mistake is marked where it stands: on its line, at its key, as a browser counts signs."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from graphkin import labs
from graphkin.errors import GraphkinError, Problem, SceneError
from graphkin.mechanism import Mechanism
from graphkin.scene.read import read_text
from graphkin.studio.places import Mark, marked
from graphkin.studio.spans import Path as Keys
from graphkin.studio.spans import spans, values
from tests.scene.test_problems import CASES

PUMP = labs.find("pump").read_text(encoding="utf-8")
SCENES = [
    *sorted((Path(__file__).resolve().parents[2] / "examples" / "scenes").glob("*.toml")),
    *(labs.find(name) for name in labs.names()),
]
HEADED = ("links.2", "links.5", "drivers[0]", "drivers")
"""What is missing there has no line of its own: the heading is marked."""


def selected(text: str, mark: Mark) -> str:
    """What a browser selects from start to end."""
    data = text.encode("utf-16-le")
    return data[2 * mark.start : 2 * mark.end].decode("utf-16-le")


def mistakes(text: str) -> list[Mark]:
    """The problems of a scene in place."""
    try:
        mechanism = Mechanism(read_text(text, "scene"))
        mechanism.solve()
    except GraphkinError as error:
        return marked(error.problems, text)
    return []


def leaves(value: Any, path: Keys = ()) -> dict[Keys, Any]:
    """All values of a tree of tables and lists by their paths."""
    if isinstance(value, dict):
        return {
            k: v for key, inner in value.items() for k, v in leaves(inner, (*path, key)).items()
        }
    if isinstance(value, list):
        found = [leaves(inner, (*path, i)) for i, inner in enumerate(value)]
        return {k: v for each in found for k, v in each.items()}
    return {path: value}


@pytest.mark.parametrize("path", SCENES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_every_value_of_a_scene_is_found_where_it_is_written(path):
    text = path.read_text(encoding="utf-8")
    found = spans(text)
    for keys, value in leaves(tomllib.loads(text)).items():
        start, end = found[keys]
        piece = text[start:end]
        written = piece if isinstance(keys[-1], int) else f"{piece.split('=', 1)[1]}"
        assert tomllib.loads(f"x = {written}")["x"] == value, keys


HARD = r"""
# "no" = [table]
a.b = 1 # a = 2
"c d".'e.f' = "x # y = \" ]" # [no]
m = '''
[not.a.table]
k = 1
''' # after
n = [ # one
  1, [2, { p = "}", q = ']' }], # two
  "three",
]
t = { u = { v = 1 }, w.x = [ { y = 1 }, { y = 2 } ] }
[[many]]
one = 1
[many.within]
two = 2
[[many]]
one = -1.5e3
[many.within]
two = 2024-01-01 10:00:00
["\u0061\"b"]
last = true"""


def test_every_way_to_write_toml_is_walked_through():
    text = HARD.replace("\n", "\r\n")
    found, tree = spans(text), tomllib.loads(text)
    for keys, value in leaves(tree).items():
        start, end = values(text).get(keys) or found[keys]
        assert tomllib.loads(f"x = {text[start:end]}")["x"] == value, keys
    assert text[slice(*found["many", 1, "within"])] == "[many.within]"
    assert text[slice(*found["many",])] == "[[many]]"
    assert text[slice(*found['a"b',])] == '["\\u0061\\"b"]'


@pytest.mark.parametrize("cut", range(0, len(HARD), 7))
def test_what_is_no_toml_ends_the_walk_without_a_fault(cut):
    assert set(spans(HARD[:cut])) <= set(spans(HARD))
    spans(HARD[cut:])
    spans(HARD[:cut] + "]]}}'\"=" + HARD[cut:])


def test_deep_nesting_ends_the_walk():
    assert ("a",) not in spans("a = " + "[" * 100_000)


def known() -> list[tuple[str, str, Problem]]:
    """The known mistakes that can be made in the pump by themselves."""
    found = []
    for old, new, place, said, _ in CASES:
        try:
            read_text(PUMP.replace(old, new, 1), "pump")
        except SceneError as error:
            alike = [p for p in error.problems if p.place == place and said in str(p)]
            found += [(old, new, problem) for problem in alike[:1]]
    return found


@pytest.mark.parametrize(("old", "new", "problem"), known(), ids=lambda each: str(each)[:40])
def test_a_known_mistake_is_marked_on_its_line(old, new, problem):
    text = PUMP.replace(old, new, 1)
    (mark,) = marked([problem], text)
    first = text.count("\n", 0, PUMP.index(old)) + 1
    if problem.place not in HEADED:
        assert first <= mark.line <= first + new.count("\n")
    assert selected(text, mark) in text.split("\n")[mark.line - 1]


def test_nearly_all_known_mistakes_were_tried():
    assert len(known()) > 100


@pytest.mark.parametrize(
    ("old", "new", "said", "line", "what"),
    [
        ("A-B = 40", "A-B = 40,5", "numbers are written with a point", 24, ",5"),
        ("[links.2]", "[links.2", "not TOML", 20, "[links.2"),
        ('"right of A-O2"', '"right of A-O1"', "known pins", 42, 'B = "right of A-O1"'),
        ('B = "right of A-O2"\n', "", "is missing", 41, "[branches]"),
        ('5 = "forward"', '5 = "closure 1"', "closure 1", 43, '5 = "closure 1"'),
        ("O2-B = 30", "O2-B = 3", "the arcs miss each other", 42, 'B = "right of A-O2"'),
        ("C-D = 20", "C-D = 0.1", "the arc misses the guide", 36, "[[drivers]]"),
        ('angle = "30 + 2*n"', 'angle = "30 + 2*m"', "no parameter", 38, 'angle = "30 + 2*m"'),
        ('velocity = ["D"]', 'velocity = ["A", "Q"]', "Q is no point", 46, '"Q"'),
        ("omega = [2, 3, 4]", "omega = [2, 9, 4]", "link 9", 48, "9"),
        ("[links.4]", "[[drivers]]\nturn = 2\nangle = 1\nspeed = 1\n[links.4]", "drivers", 29, ""),
    ],
)
def test_mistakes_of_every_kind_are_marked(old, new, said, line, what):
    text = PUMP.replace(old, new, 1)
    assert text != PUMP
    marks = [mark for mark in mistakes(text) if said in str(mark.problem)]
    assert marks, [str(mark.problem) for mark in mistakes(text)]
    assert marks[0].line == line
    assert what in selected(text, marks[0])


def test_signs_beyond_the_basic_plane_count_as_two():
    text = PUMP.replace('"Pump mechanism"', '"Pump 🛠🛠 mechanism"', 1).replace(
        "A-B = 40", "A-B = true"
    )
    (mark,) = mistakes(text)
    assert selected(text, mark) == "A-B = true"


def test_a_sound_scene_has_no_mistakes():
    assert not mistakes(PUMP)


def test_problems_come_in_the_order_of_the_text_those_without_a_place_last():
    problems = [Problem("", "whole"), Problem("sheet", "s"), Problem("witness of", "w")]
    problems += [Problem("ask.velocity[0]", "v"), Problem("links.3.A-B", "l"), Problem("data", "d")]
    assert [mark.problem.found for mark in marked(problems, PUMP)] == [
        "whole",
        "l",
        "v",
        "s",
        "w",
        "d",
    ]
