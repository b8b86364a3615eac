"""The line on the margin of a key that tells its flattest crossing."""

from __future__ import annotations

import pytest

from graphkin.construction.core.program import Part
from graphkin.documents.flattest import crossings_on, flattest_line
from graphkin.documents.sheet_documents import drawings_of, hand_out, proved
from graphkin.drawing.areas import A3_AREA
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import extent, plain
from graphkin.text import words
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import mechanism_named
from tests.mechanisms import shipped

MIDDLE = 210.0
"""Where the centring mark stands at the lower edge, in mm."""


def lines_of(mechanism, language: str, view: str = "key") -> list[dict[str, Text]]:
    """The witness's line and the flattest crossing's on each sheet, as far as they are there."""
    found = []
    for part in hand_out(mechanism, view, language):
        if part.kind != "calculation":
            marks = [mark for mark in part.pages[0].marks if isinstance(mark, Text)]
            found.append({m.name: m for m in marks if m.name in ("witness", "flattest")})
    return found


def test_each_key_tells_its_own_flattest_crossing():
    velocity, acceleration = lines_of(shipped("pump", 7), "en")
    assert (
        plain(velocity["flattest"].markup)
        == "Flattest crossing C, 55°: 1 mm of pencil becomes 2.2 mm"
    )
    assert plain(acceleration["flattest"].markup) == (
        "Flattest crossing J3, 18°: 1 mm of pencil becomes 6.6 mm"
    )


def test_a_task_does_not_give_it_away():
    assert all("flattest" not in lines for lines in lines_of(shipped("pump", 7), "en", "task"))


@pytest.mark.parametrize("language", ["en", "ro"])
@pytest.mark.parametrize("n", [1, 7, 10, 20, 30])
def test_it_stands_between_the_witness_and_the_centring_mark(language, n):
    for lines in lines_of(shipped("pump", n), language):
        witness, line = lines["witness"], lines["flattest"]
        assert line.y == witness.y < A3_AREA[3]
        assert line.x < MIDDLE - 1
        end = witness.x + extent(witness.markup, witness.height)[0]
        assert line.x - extent(line.markup, line.height)[0] > end + 2


@pytest.mark.parametrize("name", CHOSEN)
def test_every_scene_has_one_where_lines_cross(name):
    mechanism = mechanism_named(name)
    for drawing in drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("ro")):
        line = list(flattest_line(drawing, 137.0))
        assert len(line) == bool(crossings_on(drawing))


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
