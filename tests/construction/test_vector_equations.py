"""Every velocity and acceleration that is asked has its vector equation in the calculation."""

from __future__ import annotations

import pytest

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import lettered
from graphkin.construction.drivers.driver_relations import of_driver
from graphkin.construction.rolling.contact_points import of_contacts
from graphkin.construction.vector_equations import of_equations
from graphkin.drawing.symbol_markup import symbol
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import drawings
from tests.mechanisms import SHIPPED

STANDS = (" =", " ∥", " ⊥", " by similarity")
"""What follows a vector that a line of the calculation is about."""


def asked(drawing: Drawing) -> set[str]:
    """The symbols of the asked vectors of a sheet, but those of points that stand still."""
    program, trace = drawing.trace.program, drawing.trace
    letter = "v" if drawing.kind == "velocity" else "a"
    names = getattr(drawing.scene.ask, drawing.kind)
    links = drawing.scene.links
    own = {n: n.partition("@")[0] for n in names if "@" in n}
    points = {p if p in links[n.partition("@")[2]].points else n for n, p in own.items()}
    points |= {name for name in names if "@" not in name}
    poles = {n for n, step in enumerate(program.steps) if step.action and step.action.key == "pole"}
    images = {point: program.targets[drawing.kind, point] for point in points}
    assert all(number in trace.values for number in images.values())
    return {symbol(f"{letter}_{lettered(p)}") for p, n in images.items() if n not in poles}


def given(first: Drawing) -> set[str]:
    """The vectors that the relations of the drivers give, as they stand on the first page."""
    return {each.left for driver in first.scene.drivers for each in of_driver(first, driver)}


def told(drawing: Drawing) -> set[str]:
    """The vectors that an equation, a given motion along a guide or a similarity gives."""
    lines = [relation.left for _, relation in of_equations(drawing)]
    lines = [line.removeprefix("vectors:  ") for line in lines]
    whole = [relation.left for relation in of_contacts(drawing)]
    whole += [line for line in lines if not any(mark in line for mark in STANDS)]
    return {line.split(mark)[0] for line in lines for mark in STANDS if mark in line} | {*whole}


@pytest.mark.parametrize("name", [*SHIPPED, *CHOSEN])
def test_every_asked_vector_has_its_equation(name):
    sheets = drawings(name, 7 if name in SHIPPED else None)
    for drawing in sheets:
        known = told(drawing) | given(sheets[0])
        assert asked(drawing) <= known, asked(drawing) - known


def test_points_that_two_trials_find_have_theirs():
    for drawing in drawings("rapid-return"):
        letter = "v" if drawing.kind == "velocity" else "a"
        assert {symbol(f"{letter}_{point}") for point in ("P2", "P", "Q", "A3")} <= told(drawing)
