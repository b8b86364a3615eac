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


@pytest.mark.parametrize(
    ("scene", "left", "symbols"),
    [
        ("rapid-return", "*v*_{2/3}", "*v*_{AA3}"),
        ("rapid-return", "*a*_{2/3}", "*a*_{AA3}^{r}"),
        ("oscillating-slide", "*a*_{2/3}", "*a*_{AA3}^{r}"),
        ("crank-fixed-slot", "*v*_{3/0}", "*v*_{E}"),
        ("gears-ring", "*v*_{T1P}", "*v*_{P}"),
    ],
)
def test_a_vector_by_another_name_is_said_to_be_so(scene, left, symbols):
    whole = found_in(next(path for path in SCENES if path.stem == scene))
    assert [r.symbols for r in whole if r.left == left] == [symbols]


def test_a_contact_that_rests_is_why_the_centre_moves_against_it():
    whole = found_in(next(path for path in SCENES if path.stem == "gears-ring"))
    remarks = {r.left: r.remark for r in whole}
    assert remarks["*v*_{T1P}"] == "opposite to *v*_{P}, for *v*_{T1} = 0: no slip"


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


def test_the_angular_acceleration_of_a_driver_in_degrees_is_turned_into_radians():
    whole = found_in(next(path for path in SCENES if path.stem == "excavator-relative"))
    assert {"°/s", "°/s²"} <= {relation.unit for relation in whole}
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
