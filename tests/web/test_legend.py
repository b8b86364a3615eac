"""What the symbols on a page mean: each that its sheets have, and none that they have not."""

from __future__ import annotations

import re
from functools import cache

import pytest

from graphkin.construction.core.program import Part, sign_of
from graphkin.drawing.style import BY_SIGN
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import load
from graphkin.text import LANGUAGES, words
from graphkin.web.screen_sheets import ScreenSheet, screen_sheets
from graphkin.web.step_page import meanings, step_page
from tests.chosen import SCENES
from tests.documents.sheet_tools import mechanism_named

FEW = ("pump", "slotted-lever", "oscillating-slide", "gears-planet", "oldham", "gears-ring")


@cache
def sheets_of(name: str) -> tuple[ScreenSheet, ...]:
    """The sheets of a scene, in English."""
    mechanism = mechanism_named(name) if name in SCENES else load(name)
    return tuple(screen_sheets(mechanism, "en"))


@pytest.mark.parametrize("name", FEW)
def test_each_kind_of_component_is_told_and_no_other(name):
    drawn = {
        sign_of(step)
        for sheet in sheets_of(name)
        for _, step, _ in sheet.drawing.steps(sheet.drawing.plane)
        if sign_of(step)
    }
    told = {term for term, _ in meanings(words("en"), sheets_of(name))}
    assert drawn
    assert {kind for kind in BY_SIGN if symbol(f"a^{kind}") in told} == drawn & set(BY_SIGN)
    assert drawn <= set(BY_SIGN)


@pytest.mark.parametrize("name", FEW)
def test_poles_scales_and_what_is_found_are_told_once(name):
    terms = [term for term, _ in meanings(words("en"), sheets_of(name))]
    assert len(terms) == len(set(terms))
    for sheet in sheets_of(name):
        assert symbol(sheet.drawing.pole) in terms
        steps = sheet.drawing.trace.program.steps
        parts = {steps[number].part for number in sheet.drawing.trace.values}
        for part, term in ((Part.CENTRE, "*I*"), (Part.POLE, "*J*")):
            if part in parts and (part is Part.CENTRE) == (sheet.drawing.kind == "velocity"):
                assert term in terms


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_symbol_has_its_meaning_in_each_language(language):
    spoken = words(language)
    found = list(meanings(spoken, sheets_of("pump")))
    assert len(found) > 10
    assert all(meaning and not re.search(r"\{[a-z]+\}", meaning) for _, meaning in found)
    markup = step_page(load("pump"), language).partition('id="legend"')[2]
    assert markup.count("<dt>") == markup.count("<dd>") == len(found)
    assert spoken("legend.title") in markup
