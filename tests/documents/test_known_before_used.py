"""The calculation in its order: a symbol is found before it is used, and once."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

import graphkin
from graphkin.construction.core.given_data import driver_index
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.solution import Verdict
from graphkin.documents.relations import relations
from graphkin.documents.sheet_documents import drawings_of
from graphkin.text import words
from tests.chosen import CHOSEN as SOME
from tests.chosen import FOLDER

SCENES = sorted(FOLDER.glob("*.toml"))
CHOSEN = [FOLDER / f"{name}.toml" for name in SOME]
SLIDING = [path for path in SCENES if re.search(r"^slides = \[\d", path.read_text("utf-8"), re.M)]
"""Those that ask what blocks do on their guides."""
LAWS = [path for path in SCENES if path.stem in ("jumper", "excavator-absolute")]
"""Those whose cranks turn by laws of time."""
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
def test_the_vector_that_gives_a_rate_is_found_before_it(path):
    whole = found_in(path)
    for place, relation in enumerate(whole):
        vector, over, _ = relation.symbols.partition("/")
        if relation.unit in ("rad/s", "rad/s^2") and over and re.match(r"\*[va]\*_", vector):
            known = {r.left for r in whole[:place]}
            assert vector in known, relation


@pytest.mark.parametrize("path", CHOSEN, ids=lambda p: p.stem)
def test_the_vector_of_a_normal_component_is_found_before_it(path):
    whole = found_in(path)
    for place, relation in enumerate(whole):
        vector, square, _ = relation.symbols.partition("^2/")
        if relation.left.endswith("^{ν}") and square:
            assert vector in {r.left for r in whole[:place]}, relation


@pytest.mark.parametrize("path", SLIDING, ids=lambda p: p.stem)
def test_what_a_block_does_on_its_guide_is_a_vector_found_before_it(path):
    whole = found_in(path)
    slides = [r for name, section in calculation(path) if name == "slides" for r in section]
    assert len(slides) >= 2
    for relation in slides:
        before = whole[: whole.index(relation)]
        assert relation.result in [r.result for r in before if r.left == relation.symbols]


@pytest.mark.parametrize("path", LAWS, ids=lambda p: p.stem)
def test_every_rate_of_a_law_of_time_is_derived(path):
    """With its whole law, in which pi is π, even where the rate is a mere number."""
    derived = {r.left for r in found_in(path) if r.symbols.startswith("d")}
    for driver in graphkin.load(path).scene.drivers:
        index = f"_{{{driver_index(driver)}}}"
        rates = {f"*ω*{index}": driver.speed, f"*ε*{index}": driver.acceleration}
        assert {rate for rate, quantity in rates.items() if not quantity.is_zero()} <= derived
    assert not any("pi" in r.symbols + r.figures for r in found_in(path))


@pytest.mark.parametrize("path", CHOSEN, ids=lambda p: p.stem)
def test_no_relation_stands_twice(path):
    whole = [(r.left, r.symbols, r.figures) for r in found_in(path)]
    assert len(whole) == len(set(whole))


@pytest.mark.parametrize("path", CHOSEN, ids=lambda p: p.stem)
def test_no_rate_enters_a_plan_in_degrees(path):
    """A driver's rate in degrees is turned into radians before anything is computed from it."""
    whole = found_in(path)
    for relation in whole:
        assert "deg" not in relation.unit
        if relation.unit.startswith("°/s"):
            assert any(r.left == relation.left and r.unit.startswith("rad/s") for r in whole)
