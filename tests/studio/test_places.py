"""A mistake is marked where it stands: on its line, at its key, as a browser counts signs."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from graphkin.scene.toml_spans import Path as Keys
from graphkin.scene.toml_spans import spans
from graphkin.studio.look import MarkedProblem, line_of, marked
from graphkin.text.errors import GraphkinError, Problem, SceneError, Sought
from tests.chosen import CHOSEN, FOLDER
from tests.scene.conftest import DATA
from tests.scene.test_problems import CASES, PLANETS, SAID, SEVERAL
from tests.studio.pump import BAR, PUMP

PLANET = (DATA / "planet.toml").read_text(encoding="utf-8")
SCENES = [
    *(FOLDER / f"{name}.toml" for name in CHOSEN),
    *(Path(scene_files.find(name)) for name in scene_files.names()),
]
HEADED = ("links.2", "links.5", "drivers[0]", "drivers")
"""What is missing there has no line of its own: the heading is marked."""


def selected(text: str, mark: MarkedProblem) -> str:
    """What a browser selects of a mistake."""
    return selected_span(text, mark.start, mark.end)


def selected_span(text: str, start: int, end: int) -> str:
    """What a browser selects from start to end."""
    return text.encode("utf-16-le")[2 * start : 2 * end].decode("utf-16-le")


def mistakes(text: str) -> list[MarkedProblem]:
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


def test_what_is_no_toml_ends_the_walk_without_a_fault():
    for cut in range(0, len(HARD), 7):
        assert set(spans(HARD[:cut])) <= set(spans(HARD)), cut
        spans(HARD[cut:])
        spans(HARD[:cut] + "]]}}'\"=" + HARD[cut:])


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


def test_every_known_mistake_is_marked_on_its_line():
    for old, new, problem in known():
        text = PUMP.replace(old, new, 1)
        (mark,) = marked([problem], text)
        first = text.count("\n", 0, PUMP.index(old)) + 1
        if problem.place not in HEADED:
            assert first <= mark.line <= first + new.count("\n"), problem
        assert selected(text, mark) in text.split("\n")[mark.line - 1], problem


def everything() -> list[tuple[str, Problem]]:
    """Every text of the known mistakes with each problem that is found in it."""
    texts = [PUMP.replace(old, new, 1) for old, new, *_ in (*CASES, *SAID)]
    texts += [PUMP.replace("[links.4]", SEVERAL, 1)]
    texts += [PLANET.replace(old, new, 1) for old, new, *_ in PLANETS]
    found = []
    for text in texts:
        try:
            Mechanism(read_text(text, "scene")).solve()
        except GraphkinError as error:
            found += [(text, problem) for problem in error.problems]
    return found


def names_in(place: str) -> list[str]:
    """The keys that a place names, from the last to the first."""
    dotted = re.sub(r"\[\d+\]", "", place.removeprefix("position of "))
    found = re.findall(r'"((?:\\.|[^"\\])*)"|([^."]+)', dotted)
    return [quoted or bare for quoted, bare in reversed(found)]


def test_the_line_of_every_known_mistake_holds_the_key_that_its_place_names():
    for text, problem in everything():
        holds_its_key(text, problem)


def holds_its_key(text: str, problem: Problem) -> None:
    """The last key that is written at all; of a list, the element lies within its key's line."""
    (mark,) = marked([problem], text)
    if told := line_of(problem):
        assert problem.place == f"line {told.line}"
        assert mark.line == told.line
        assert 0 <= mark.column <= len(text.split("\n")[mark.line - 1]) + 1
        return
    assert mark.line, str(problem)
    line = text.split("\n")[mark.line - 1]
    words = re.findall(r"[\w@]+", line)
    if not problem.place:
        assert mark.line == 1
        return
    lone = [path[-1] for path in problem.about if isinstance(path, tuple) and "-" not in path[-1]]
    if lone:
        assert lone[0] in words
        return
    for name in names_in(problem.place):
        pieces = re.findall(r"[\w@]+", name)
        held = all(piece in words for piece in pieces) or name in line
        if held or any(within(name, other) for other in keys_of(text, problem.place)):
            assert held, (str(problem), line)
            return
    pytest.fail(f"{problem}: {line}")


def within(name: str, key: str) -> bool:
    """Whether a key is one, or holds a point of that name."""
    return name == key or name in key.split("-")


def keys_of(text: str, place: str) -> list[str]:
    """The last keys of all paths that share the table of a place."""
    table = re.split(r"[.\[]", place)
    return [
        str(path[-1])
        for path in spans(text)
        if len(path) >= len(table) - 1 and [str(key) for key in path[:-1]] == table[:-1]
    ]


@pytest.mark.parametrize(
    ("written", "column", "helps"),
    [
        ("A-B = ", 7, "the value is missing"),
        ("A-B = .5", 7, "digits on both sides"),
        ("A-B = 4 0", 9, "one key = value"),
        ("A-B 40", 5, "write ="),
        ('A-B = "40', 10, "put its quote at its end"),
        ("A-B = { x = 1", 14, "} or a comma"),
        ("[[links.x]", 10, "a heading ends as it begins"),
    ],
)
def test_no_toml_is_marked_at_the_column_of_its_reader(written, column, helps):
    """The line and the column are those that tomllib tells of the same text."""
    text = PUMP.replace("A-B = 40", written, 1)
    with pytest.raises(tomllib.TOMLDecodeError) as caught:
        tomllib.loads(text)
    (mark,) = mistakes(text)
    assert f"(at line {mark.line}, column {mark.column})" in str(caught.value)
    assert (mark.line, mark.column) == (BAR, column)
    assert helps in str(mark.problem.hint)


@pytest.mark.parametrize(
    ("names", "where"),
    [
        (("B",), 'B = "right of A-O2"'),
        (("3",), "[links.3]"),
        (("C",), "A-C = 20"),
        ((), "[[drivers]]"),
    ],
)
def test_what_is_sought_is_marked_at_its_branch_its_link_its_lengths_or_the_drivers(names, where):
    """Whatever the words of its place are: none is read out of these."""
    problem = Problem("in other words", "is not found", about=(Sought(names),))
    (mark,) = marked([problem], PUMP)
    assert selected(PUMP, mark) == where


def test_a_point_that_the_arcs_do_not_reach_is_marked_at_its_branch():
    text = PUMP.replace("A-B = 40", "A-B = 4").replace("A-C = 20", "A-C = 24")
    (mark,) = mistakes(text)
    assert mark.problem.place == "position of B"
    assert selected(text, mark) == 'B = "right of A-O2"'


def test_signs_beyond_the_basic_plane_count_as_two():
    text = PUMP.replace('"Pump mechanism"', '"Pump 🛠🛠 mechanism"', 1).replace(
        "A-B = 40", "A-B = true"
    )
    (mark,) = mistakes(text)
    assert selected(text, mark) == "A-B = true"


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
