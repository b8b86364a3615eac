"""The calculation in its order: a symbol is found before it is used, and once."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

import graphkin
from graphkin.handout import drawings_of
from graphkin.paper.relation import Relation
from graphkin.paper.relations import relations
from graphkin.steps.solution import Verdict
from graphkin.text import words

SCENES = sorted((Path(__file__).parents[2] / "examples" / "scenes").glob("*.toml"))
PINNED = [path for path in SCENES if "rolls" not in path.read_text(encoding="utf-8")]
"""Those without wheels."""
SYMBOL = re.compile(r"\*[vaωελ]\*(?:_(?:\{[^}]*\}|\w))?(?:\^\{?[νταcr]\}?)?")
"""A velocity, an acceleration, a rate, or the ratio of two trial plans."""


@cache
def calculation(path: Path) -> tuple[tuple[str, tuple[Relation, ...]], ...]:
    """The sections of the calculation of a scene."""
    verdict = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    drawings = drawings_of(graphkin.load(path), verdict, words("en"))
    return tuple((name, tuple(found)) for name, found in relations(drawings))


def found_in(path: Path) -> list[Relation]:
    """The relations of a scene in their order, with results."""
    return [r for _, section in calculation(path) for r in section if r.result]


def symbols(markup: str) -> set[str]:
    """The vectors and rates of a formula."""
    return {
        m[0] for m in SYMBOL.finditer(markup) if not markup[m.end() :].startswith(("^1", "^{1"))
    }


@pytest.mark.parametrize("path", SCENES, ids=lambda p: p.stem)
def test_what_a_relation_uses_is_found_before_it(path):
    whole = found_in(path)
    late = []
    for place, relation in enumerate(whole):
        known = {r.left for r in whole[:place]}
        later = {r.left for r in whole[place + 1 :]}
        used = symbols(relation.symbols) - {relation.left}
        late += [(relation.left, name) for name in used & later - known]
    assert not late


@pytest.mark.parametrize("path", PINNED, ids=lambda p: p.stem)
def test_the_vector_that_gives_a_rate_is_found_before_it(path):
    """Where wheels roll it may be measured between two images of the point of contact."""
    whole = found_in(path)
    for place, relation in enumerate(whole):
        vector, over, _ = relation.symbols.partition("/")
        if relation.unit in ("rad/s", "rad/s^2") and over and re.match(r"\*[va]\*_", vector):
            known = {r.left for r in whole[:place]}
            assert vector in known, relation


@pytest.mark.parametrize("path", SCENES, ids=lambda p: p.stem)
def test_no_relation_stands_twice(path):
    whole = [(r.left, r.symbols, r.figures) for r in found_in(path)]
    assert len(whole) == len(set(whole))


@pytest.mark.parametrize("path", SCENES, ids=lambda p: p.stem)
def test_no_rate_enters_a_plan_in_degrees(path):
    """A driver's rate in degrees is turned into radians before anything is computed from it."""
    whole = found_in(path)
    for relation in whole:
        if relation.unit.startswith("deg/s"):
            assert any(r.left == relation.left and r.unit.startswith("rad/s") for r in whole)


def test_the_angular_acceleration_of_a_driver_in_degrees_is_turned_into_radians():
    whole = found_in(next(path for path in SCENES if path.stem == "excavator-relative"))
    lines = [r for r in whole if r.left == "*ε*_{stick/boom}" and r.unit == "rad/s^2"]
    assert [(r.figures, r.result) for r in lines] == [("π·12/180", "0.20944")]


@pytest.mark.parametrize(
    ("scene", "first", "then"),
    [
        ("roller-plates", "*ω*_{3}", "*v*_{AO}"),
        ("rapid-return", "*λ*", "*ω*_{2}"),
        ("rapid-return", "*ω*_{2}", "*v*_{A3P}"),
        ("eight-link-2", "*ω*_{3}", "*v*_{C}"),
        ("eight-link-2", "*v*_{B3A}", "*ω*_{3}"),
    ],
)
def test_rates_stand_before_the_vectors_that_are_computed_from_them(scene, first, then):
    names = [r.left for r in found_in(next(p for p in SCENES if p.stem == scene))]
    assert names.index(first) < names.index(then)
