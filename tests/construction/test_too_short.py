"""What is too short to be drawn is left out of the drawing, not of the tables: its value stands."""

from __future__ import annotations

import re

from graphkin.construction.core.naming import TINY
from graphkin.construction.result_tables import turning_rows, vector_rows
from graphkin.documents.relations import relations as relations_of
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.documents.sheet_tools import HEAD, drawings, mechanism_named
from tests.scene_files import scene_text

TOGGLE = scene_text("construction/toggle")
"""A four-bar linkage within a degree of a dead point."""
GEARS = scene_text("construction/fast-gears")
"""Gears that turn fast and speed up slowly."""
GUIDED = scene_text("construction/swinging-guide")
"""A bar in a swinging block that hardly turns, and a dyad after it."""
SHIFTED = scene_text("construction/shifting-bar")
"""A bar between blocks on parallel guides: it shifts steadily, all else is rounding."""


def scene_of(title, text):
    """The material of the sheets of a scene written here."""
    mechanism = Mechanism(read_text(HEAD.format(title=title) + text, title, None, {}))
    return drawings_of(mechanism, proved(mechanism, sheet_motion(mechanism)), words("en"))


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


def test_what_is_left_out_is_told_before_the_plan_is_drawn_without_it():
    """The bar's normal component is too short; the first right triangle is one of a later dyad."""
    said = [plain(sentence.markup) for sentence in sentences(scene_of("guided", GUIDED)[1])]
    (left_out,) = (n for n, text in enumerate(said) if "is left out: aQ2Aν" in text)
    (without,) = (n for n, text in enumerate(said) if "through a′ the perpendicular to AQ2" in text)
    (triangle,) = (n for n, text in enumerate(said) if "by the right triangle" in text)
    assert left_out < without < triangle


def test_what_is_left_out_ends_its_sentence():
    """The next triangle of the plan is drawn, so nothing may be read as left out with the rest."""
    mechanism = mechanism_named("mobility-watt")
    proof = proved(mechanism, sheet_motion(mechanism))
    (_, drawing) = drawings_of(mechanism, proof, words("en"))
    (said,) = (plain(s.markup) for s in sentences(drawing) if "left out" in s.markup)
    drawn, left_out = said.split("what is too short to be drawn is left out: ")
    assert "aCν at C on O3C" in drawn
    assert left_out.startswith("aCBν") and "aCν" not in left_out


def test_wheels_that_hardly_speed_up_have_their_values_and_senses():
    _, drawing = scene_of("gears", GEARS)
    cells = cells_of(drawing)
    assert cells["a_B^τ"][2] == "0.39" and float(cells["a_B^τ"][1]) < TINY
    assert cells["ε2"] == ("9.839", "clockwise")
    assert cells["ε3"] == ("1.829", "counter-clockwise")


def test_what_is_only_rounding_is_zero_even_where_nothing_else_is_there():
    first, then = found = scene_of("a bar that shifts", SHIFTED)
    assert cells_of(first)["v_BA"][1:] == ("0", "0")
    assert cells_of(first)["ω2"] == cells_of(then)["ε2"] == ("0", "")
    assert {cells[1:] for name, cells in cells_of(then).items() if name != "ε2"} == {("0", "0")}
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
