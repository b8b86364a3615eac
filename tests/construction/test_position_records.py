"""What finds positions are records: their roles, words in each language, and words of failure."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from graphkin.construction.core.determined import Determined
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction, construction, constructions
from graphkin.construction.core.program import Drive, Part, Plane
from graphkin.construction.guides.dyad_by_arc_and_guide import DyadByArcAndGuide
from graphkin.construction.guides.guide_line import GuideLine, GuideThroughBlock, ShiftedGuide
from graphkin.construction.guides.set_by_coordinate import SetByCoordinate
from graphkin.construction.guides.swung_guide import GuideThroughPins, TangentGuide
from graphkin.construction.links.compass_arc import CompassArc
from graphkin.construction.links.driven_crank import DrivenCrank
from graphkin.construction.links.dyad_by_arcs import DyadByArcs
from graphkin.construction.links.plate_points import PlatePoint
from graphkin.documents.sentences import sentences
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
KINDS = (
    CompassArc,
    DrivenCrank,
    DyadByArcAndGuide,
    DyadByArcs,
    GuideLine,
    PlatePoint,
    SetByCoordinate,
)
EVERY = pytest.mark.parametrize("name", SCENES)


@cache
def mechanism(name: str) -> Mechanism:
    """A scene, read once."""
    return load(FOLDER / f"{name}.toml")


@cache
def drawing(name: str, language: str = "en") -> Drawing:
    """The first sheet of a scene."""
    some = mechanism(name)
    return drawings_of(some, proved(some, some.solve()), words(language))[0]


@EVERY
def test_the_given_motions_are_values_of_the_scene(name):
    for step in mechanism(name).program.steps:
        if isinstance(step.of, Drive):
            assert step.given is not None


@EVERY
def test_each_point_found_on_the_mechanism_is_part_of_a_construction(name):
    program, frame = mechanism(name).program, mechanism(name).scene.frame.points
    for step in program.steps:
        if step.part is Part.POSITION and step.plane is Plane.MECHANISM and step.name:
            assert step.name in frame or isinstance(step.of, Construction)


def test_the_scenes_have_every_kind():
    for kind in KINDS:
        assert any(True for name in SCENES for _ in constructions(mechanism(name).program, kind))


@EVERY
@pytest.mark.parametrize("language", ["en", "it", "ro"])
def test_a_record_says_how_its_point_is_found(name, language):
    drawn = drawing(name, language)
    said = {each.step: each.markup for each in sentences(drawn)}
    steps = drawn.trace.program.steps
    for number, markup in said.items():
        if number >= 0 and isinstance(kind := construction(steps[number]), PlatePoint | DyadByArcs):
            assert markup.endswith(kind.point_sentence(drawn, steps[number].role))


@EVERY
def test_arcs_have_their_point_at_the_distance_that_they_lay_off(name):
    drawn = drawing(name)
    places = drawn.standing.known
    for each in constructions(drawn.trace.program, CompassArc):
        if each.arc in drawn.trace.values and each.centre in places:
            circle = drawn.trace.values[each.arc]
            apart = abs(places[each.point] - places[each.centre])
            assert circle.centre == places[each.centre]
            assert circle.radius == pytest.approx(apart, rel=1e-9)
            assert each.laid_length("arc") == each.points == (each.centre, each.point)


@EVERY
def test_what_two_loci_determine_says_what_lies_in_line_where_they_fail(name):
    program = mechanism(name).program
    for each in constructions(program, Determined):
        nearly = each.in_line(program.steps, "nearly ")
        assert nearly.count("nearly ") == 1
        assert nearly.replace("nearly ", "") == each.in_line(program.steps, "")
        if each.has_mirror:
            assert each.apart.startswith(each.loci.split(" and ")[0])


def test_the_guide_of_a_lever_has_no_angle_and_turns_its_link():
    (lever, *_) = constructions(mechanism("crank-slot").program, GuideThroughPins | TangentGuide)
    assert lever.has_angle is isinstance(lever, TangentGuide)
    assert lever.found_link == lever.link
    assert lever.directions >= {"turn"}


@EVERY
def test_lines_of_guides_lie_along_them(name):
    for kind in (GuideLine, GuideThroughBlock, ShiftedGuide):
        for each in constructions(mechanism(name).program, kind):
            assert each.lies_along == f"the guide of {each.block}"


def test_a_pivot_of_the_frame_may_be_given_by_two_distances():
    """No arcs are drawn for it: the frame stands before anything is drawn."""
    some = load(Path(__file__).parent / "scenes" / "frame-triangle.toml")
    drawn = drawings_of(some, proved(some, some.solve()), words("en"))[0]
    marks = [mark.name for mark in sheet(drawn, "key", "1").marks]
    assert "Q" in marks and not {"OQ", "PQ"} & {*marks}
