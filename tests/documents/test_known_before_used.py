"""The calculation in its order: a symbol is found before it is used, and once."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

import graphkin
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.solution import Verdict
from graphkin.documents.relations import relations
from graphkin.documents.sheet_documents import drawings_of
from graphkin.text import words
from tests.chosen import FOLDER, HALVES

CHOSEN = [FOLDER / f"{name}.toml" for name in HALVES[1]]
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


@pytest.mark.parametrize("path", CHOSEN, ids=lambda p: p.stem)
def test_what_a_relation_uses_is_found_before_it(path):
    whole = found_in(path)
    late = []
    for place, relation in enumerate(whole):
        known = {r.left for r in whole[:place]}
        later = {r.left for r in whole[place + 1 :]}
        used = symbols(relation.symbols) - {relation.left}
        late += [(relation.left, name) for name in used & later - known]
    assert not late


@pytest.mark.parametrize("path", CHOSEN, ids=lambda p: p.stem)
def test_no_rate_enters_a_plan_in_degrees(path):
    """A driver's rate in degrees is turned into radians before anything is computed from it."""
    whole = found_in(path)
    for relation in whole:
        assert "deg" not in relation.unit
        if relation.unit.startswith("°/s"):
            assert any(r.left == relation.left and r.unit.startswith("rad/s") for r in whole)
