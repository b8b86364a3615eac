"""What is too short to be drawn is left out everywhere: sentences, triangles, tables, turnings."""

from __future__ import annotations

import re

import pytest

from graphkin.paper.desk import TINY
from graphkin.paper.marks import Text
from graphkin.paper.richtext import plain
from graphkin.paper.sentences import sentences
from graphkin.paper.short import NEARLY_NOUGHT
from graphkin.paper.symbolic import symbol
from graphkin.paper.tables import turning_rows, vector_rows, vectors
from tests.paper.sheet_tools import SCENES, drawings, drawn, named

LEFT_OUT = "what is too short to be drawn is left out: "
LABS = [("pump", n) for n in (29, 30)] + [("pump-collinear", n) for n in (22, 24, 25)]
WHICH = [*((name, None) for name in SCENES), *LABS]


def short_ones(drawing):
    """The vectors of the plan that are shorter than what a hand draws, but not nought."""
    return {name for name, _, length, size in vectors(drawing) if size and length < TINY}


def test_there_are_some():
    every = {(*which, d.kind) for which in WHICH for d in drawings(*which) if short_ones(d)}
    assert {name for name, _, _ in every} >= {"watt-1", "lifter", "pump", "pump-collinear"}
    assert {kind for _, _, kind in every} == {"velocity", "acceleration"}


@pytest.mark.parametrize("which", WHICH, ids=named)
def test_its_value_is_nearly_nought(which):
    for drawing in drawings(*which):
        short = short_ones(drawing)
        for row, (name, _, length, size) in zip(
            vector_rows(drawing, empty=False), vectors(drawing), strict=True
        ):
            assert (row.cells[2:] == (NEARLY_NOUGHT, NEARLY_NOUGHT)) == (name in short)
            assert length >= TINY or name in short or size == 0


@pytest.mark.parametrize("which", WHICH, ids=named)
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


@pytest.mark.parametrize(
    ("name", "kind", "link"), [("watt-1", "velocity", 5), ("stephenson-1", "velocity", 5)]
)
def test_a_link_hardly_turns_whose_relative_velocity_is_too_short(name, kind, link):
    drawing = next(d for d in drawings(name) if d.kind == kind)
    cells = {row.name: row.cells for row in turning_rows(drawing, empty=False)}
    assert cells.pop(f"ω{link}")[1:] == (NEARLY_NOUGHT, "")
    assert not [row for row in cells.values() if row[1] == NEARLY_NOUGHT]


def test_its_triangle_is_not_drawn_and_the_other_one_needs_no_index():
    page = drawn("gears-profiles", None, "acceleration")
    marks = page.marks["mechanism"]
    assert "v_K2" in {mark.name for mark in marks}
    assert not [mark for mark in marks if "K2K1" in mark.name]
    letters = {mark.markup for mark in marks if isinstance(mark, Text)}
    assert {"*k*″", "*k*‴", "*k*^{IV}"} <= letters
    first = next(s for s in sentences(page.drawing) if s.name == "ν1")
    assert plain(first.markup).endswith(f"{LEFT_OUT}aK2K1ν = vK2K12/K1K2 (0.34 mm)")
