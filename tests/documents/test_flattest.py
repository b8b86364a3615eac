"""The line on the margin of a key that tells its flattest crossing."""

from __future__ import annotations

from graphkin.construction.core.program import Part
from graphkin.documents.sentences import crossings_on, flattest_line
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.symbol_markup import symbol
from graphkin.text import words
from tests.documents.sheet_tools import drawings
from tests.mechanisms import shipped


def test_what_stands_on_the_sheet_before_is_not_told_again():
    mechanism = shipped("pump", 7)
    first, second = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))
    parts = [{crossing.part for crossing in crossings_on(drawing)} for drawing in (first, second)]
    assert parts == [
        {Part.POSITION, Part.VELOCITY, Part.CENTRE},
        {Part.NORMAL, Part.ACCELERATION, Part.POLE},
    ]


def test_where_there_is_no_room_it_is_left_out():
    mechanism = shipped("pump", 7)
    drawing = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))[0]
    assert not list(flattest_line(drawing, 190.0))


def test_a_triangle_whose_corners_no_sentence_names_is_told_by_its_component():
    drawing = drawings("four-bar-triple-rocker")[1]
    (line,) = flattest_line(drawing, 0.0)
    assert line.markup.startswith(f"Flattest crossing for {symbol('a_C^ν')}, 57°")
