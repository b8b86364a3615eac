"""Every vector that a hand lays off bears a name: on the page, in the table, in the calculation."""

from __future__ import annotations

import pytest

from graphkin.construction.core.component import LaidOff
from graphkin.construction.core.kind import construction
from graphkin.construction.core.naming import NAUGHT, drawn_between
from graphkin.construction.result_tables import vector_rows
from graphkin.construction.rolling.rolling_normal import RollingNormal
from graphkin.documents.relations import relations
from graphkin.drawing.marks import Text
from graphkin.drawing.symbol_markup import symbol
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import drawings, drawn
from tests.mechanisms import SHIPPED

LAID = (
    "turned-velocity",
    "centripetal",
    "driven-tangential",
    "driven-slide",
)
"""The actions that lay off a vector in a plan, beside those of components."""
WHICH = [(lab, 7) for lab in SHIPPED] + [(name, None) for name in CHOSEN]


def component_laid_off(step):
    """The component of whose vector a step lays off the end; None for others."""
    kind = construction(step)
    if isinstance(kind, LaidOff):
        return kind.component
    return kind if isinstance(kind, RollingNormal) and step.role == "image" else None


def laid_off(drawing):
    """The symbols of the vectors that are laid off in the right plan, with their lengths in mm."""
    for number, step, _ in drawing.steps(drawing.plane):
        component = component_laid_off(step)
        if component is not None and number not in drawing.auxiliary:
            yield component.symbol, drawn_between(drawing, step.args[0], number, step.plane)
        elif step.action and step.action.key in LAID and number not in drawing.auxiliary:
            size = drawn_between(drawing, step.args[0], number, step.plane)
            made = construction(step)
            if isinstance(made, LaidOff):
                yield made.component.symbol, size
            else:
                yield made.fields(drawing, step.role)["vector"], size


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_every_vector_that_is_laid_off_stands_in_the_table(which):
    for drawing in drawings(*which):
        rows = {row.cells[0] for row in vector_rows(drawing, empty=False)}
        assert {name for name, _ in laid_off(drawing)} <= rows


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_every_vector_that_is_laid_off_is_named_beside_its_arrow_or_in_a_note(which):
    for drawing in drawings(*which):
        page = drawn(*which, drawing.kind)
        names = texts(page)
        for name, size in laid_off(drawing):
            assert size < NAUGHT or any(name in markup for markup in names), name


def texts(page):
    """The markup of all that is written in the field of the plan, its notes among it."""
    return [mark.markup for mark in page.marks["plan"] if isinstance(mark, Text)]


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_every_vector_that_is_laid_off_is_computed_or_read_off(which):
    whole = [r.left for _, section in relations(drawings(*which)) for r in section if r.result]
    for drawing in drawings(*which):
        assert {name for name, _ in laid_off(drawing)} <= set(whole)


def test_what_turns_steadily_about_a_moving_pin_has_a_normal_component_with_its_arrow():
    (_, acceleration) = drawings("jumper")
    assert symbol("a_CH^ν") in {name for name, _ in laid_off(acceleration)}
