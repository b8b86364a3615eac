"""What finds positions are records: their roles, words in each language, and words of failure."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from graphkin.construction.core.crossings import Determined
from graphkin.construction.core.kind import ByHand, constructions
from graphkin.construction.guides.swung_guide import GuideThroughPins, TangentGuide
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.mechanism import Mechanism, load
from graphkin.text import words

FOLDER = Path(__file__).parents[2] / "examples" / "scenes"
SCENES = (
    "slider-crank",
    "four-bar-crank-rocker",
    "crank-slot",
    "excavator-relative",
    "lifter",
    "oscillating-slide",
    "roller",
    "stephenson-2-ternary",
    "trammel",
    "watt-1-ternary",
)
EVERY = pytest.mark.parametrize("name", SCENES)


@cache
def mechanism(name: str) -> Mechanism:
    """A scene, read once."""
    return load(FOLDER / f"{name}.toml")


@EVERY
def test_what_two_loci_determine_says_what_lies_in_line_where_they_fail(name):
    program = mechanism(name).program
    for each in constructions(program, Determined):
        nearly = each.in_line(program.steps, nearly=True)
        assert nearly.count("nearly ") == 1
        assert nearly.replace("nearly ", "") == each.in_line(program.steps, nearly=False)
        if each.has_mirror:
            assert each.apart.startswith(each.loci.split(" and ")[0])


def test_the_guide_of_a_lever_has_no_angle_and_turns_its_link():
    (lever, *_) = constructions(mechanism("crank-slot").program, GuideThroughPins | TangentGuide)
    assert lever.has_angle is isinstance(lever, TangentGuide)
    assert lever.found_link == lever.link
    assert lever.pencil["turn"] is ByHand.TURNED


def test_a_pivot_of_the_frame_may_be_given_by_two_distances():
    """No arcs are drawn for it: the frame stands before anything is drawn."""
    some = load(Path(__file__).parent / "scenes" / "frame-triangle.toml")
    drawn = drawings_of(some, proved(some, some.solve()), words("en"))[0]
    marks = [mark.name for page in sheet(drawn, "key", "1") for mark in page.marks]
    assert "Q" in marks and not {"OQ", "PQ"} & {*marks}
