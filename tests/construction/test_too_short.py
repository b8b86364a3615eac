"""What is too short to be drawn is left out of the drawing, not of the tables: its value stands."""

from __future__ import annotations

import re

import pytest

from graphkin.construction.core.segments import TINY
from graphkin.construction.result_tables import turning_rows, vector_rows, vectors
from graphkin.documents.relations import relations as relations_of
from graphkin.documents.scaling import shown
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.richtext import plain
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import (
    HEAD,
    drawings,
    named,
)

LEFT_OUT = "what is too short to be drawn is left out: "
LABS = [("pump", n) for n in (29, 30)] + [("pump-collinear", n) for n in (22, 24, 25)]
TOGGLE = """
[frame]
O1 = [0, 0]
O2 = [120, 0]
[links.1]
O1-A = 60
[links.2]
A-B = 70
[links.3]
O2-B = 80
[[drivers]]
turn = 1
angle = 108.205
speed = "2*pi"
[branches]
B = "left of A-O2"
[ask]
velocity = ["A", "B"]
acceleration = ["A", "B"]
omega = [2, 3]
epsilon = [2, 3]
"""
"""A four-bar linkage within a degree of a dead point."""
GEARS = """
module = 0.5
[frame]
O1 = [0, 0]
O2 = [96, 0]
O3 = { from = "O2", length = "0.25*(37+199)", angle = 60 }
[links.1]
O1-A = 30
wheel = { centre = "O1", teeth = 173 }
[links.2]
O2-B = 40
wheels = [{ centre = "O2", teeth = 211 }, { centre = "O2", teeth = 37 }]
rolls = { on = 1 }
[links.3]
O3-C = 45
wheel = { centre = "O3", teeth = 199 }
rolls = { on = 2 }
[[drivers]]
turn = 1
angle = 100
speed = "100*pi/3"
acceleration = 12
[ask]
velocity = ["A", "B", "C"]
acceleration = ["A", "B", "C"]
omega = [2, 3]
epsilon = [2, 3]
"""
"""Gears that turn fast and speed up slowly."""
SHIFTED = """
[frame]
P = [0, 0]
Q = [30, 70]
[links.1]
A = [0, 0]
slides = { on = 0, through = "P", angle = 33 }
[links.2]
A-B = 87
[links.3]
B = [0, 0]
slides = { on = 0, through = "Q", angle = 33 }
[[drivers]]
slide = 1
position = 40
speed = 30
[branches]
3 = "forward"
[ask]
velocity = ["A", "B"]
acceleration = ["A", "B"]
omega = [2]
epsilon = [2]
"""
"""A bar between blocks on parallel guides: it shifts steadily, all else is rounding."""
WHICH = [*((name, None) for name in ("watt-1", "lifter", "stephenson-1", *CHOSEN)), *LABS]

TRIED = {("plates-ring", None)}
"""Where a trial plan lays one off on its own, with the tangential component after it."""


def short_ones(drawing):
    """The vectors of the plan that are shorter than what a hand draws, but not nought."""
    return {name for name, _, length, size in vectors(drawing) if size and length < TINY}


def scene_of(title, text):
    """The material of the sheets of a scene written here."""
    mechanism = Mechanism(read_text(HEAD.format(title=title) + text, title, None, {}))
    return drawings_of(mechanism, proved(mechanism, shown(mechanism)), words("en"))


def cells_of(drawing):
    """The cells of both tables of a sheet by the name of their row."""
    rows = [*vector_rows(drawing, empty=False), *turning_rows(drawing, empty=False)]
    return {row.name: row.cells[1:] for row in rows}


def lines_of(found):
    """The relations of a calculation page, each in a line."""
    sections = [relations for _, relations in relations_of(found)]
    return [" ".join(plain(p) for p in each.parts(solved=True)) for r in sections for each in r]


def test_what_is_asked_beside_a_dead_point_has_its_value_however_short_it_is_drawn():
    first, then = found = scene_of("toggle", TOGGLE)
    assert cells_of(first)["v_A"][::2] == ("*o**a*", "0.3770")
    assert cells_of(then)["a_A"] == ("*o*′*a*′", "<\xa00.01", "2.4")
    said = [plain(sentence.markup) for sentence in sentences(then)]
    assert any("aA ∥ O1A, from A to O1" in text and "<\xa00.01 mm" in text for text in said)
    assert "aA = ω12·O1A = 6.283192·0.06 = 2.369 m/s2 (from A to O1)" in lines_of(found)


def test_wheels_that_hardly_speed_up_have_their_values_and_senses():
    _, drawing = scene_of("gears", GEARS)
    cells = cells_of(drawing)
    assert cells["a_B^τ"][2] == "0.39" and float(cells["a_B^τ"][1]) < TINY
    assert cells["ε2"] == ("9.839", "clockwise")
    assert cells["ε3"] == ("1.829", "counter-clockwise")


def test_what_is_only_rounding_is_nought_even_where_nothing_else_is_there():
    first, then = found = scene_of("a bar that shifts", SHIFTED)
    assert cells_of(first)["v_BA"][1:] == ("0.00", "0")
    assert cells_of(first)["ω2"] == cells_of(then)["ε2"] == ("0", "")
    assert {cells[1:] for name, cells in cells_of(then).items() if name != "ε2"} == {("0.00", "0")}
    assert not [line for line in lines_of(found) if "·10" in line]
    assert plain(sentences(then)[-1].markup).startswith(
        "nothing is set on the mechanism, because all"
    )


def test_a_component_that_is_too_short_says_so_with_its_length():
    _, drawing = drawings("watt-2")
    line = next(line for line in lines_of([drawing]) if "too short to be drawn" in line)
    name, length = re.match(r"a(\w+)ν = .*, ([\d.]+) mm, too short", line).groups()
    assert float(length) < TINY
    assert cells_of(drawing)[f"a_{name}^ν"][1] == length


@pytest.mark.parametrize("which", [each for each in WHICH if each not in TRIED], ids=named)
def test_no_sentence_lays_it_off_or_draws_its_triangle(which):
    for drawing in drawings(*which):
        for name in short_ones(drawing):
            if not re.search(r"\^[νc]$", name):
                continue
            own, told = plain(symbol(name)), 0
            for sentence in sentences(drawing):
                text = plain(sentence.markup)
                before, _, after = text.partition(LEFT_OUT)
                assert own not in before, text
                told += own in after
            assert told == 1, name
