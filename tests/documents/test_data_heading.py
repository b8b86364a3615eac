"""The data at the head of a sheet: each stands there once, in the table or in words beside it."""

from itertools import cycle

import pytest

from graphkin.construction.core.layout import lay_out, lowered
from graphkin.documents.sheet import (
    NAME,
    Moved,
    data,
    data_heading,
    spare_above,
    title_line,
    writing,
)
from graphkin.documents.sheet_documents import (
    continued_lines,
    drawings_of,
    drawn_sheets,
    proved,
)
from graphkin.drawing.field import A3, ABOVE
from graphkin.drawing.marks import LineMark, Text, reach
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.chosen import HALVES
from tests.documents.full_scenes import NAMED, drawings_from
from tests.documents.sheet_tools import drawings
from tests.mechanisms import SHIPPED
from tests.scene_files import scene_text

WHICH = [*((name, None) for name in HALVES[0]), *((lab, 7) for lab in SHIPPED)]


@pytest.mark.parametrize(
    ("which", "language"), [*zip(WHICH, cycle(("en", "ro", "it")), strict=False)], ids=str
)
def test_every_datum_stands_there_once(which, language):
    for drawing in drawings(*which, language):
        if Moved.DATA in writing(drawing, "key").moved:
            lines = continued_lines(drawing, "key", {Moved.DATA}, 24)
            assert all(datum.said.split()[0] in " ".join(lines) for datum in data(drawing))
            continue
        marks = data_heading(drawing, "key", 24, 22.4, lambda sheet=drawing: spare_above(sheet))
        texts = [mark.markup for mark in marks if isinstance(mark, Text)]
        said = "; ".join(texts).replace(";;", ";")
        found = data(drawing)
        if any(isinstance(mark, LineMark) for mark in marks):
            cells = [part for datum in found if datum.value for part in (datum.name, datum.value)]
            rest = [datum.remark for datum in found if datum.remark]
            assert texts[: len(cells)] == cells
            assert " ".join(texts[len(cells) :]).split() == "; ".join(rest).split()
        else:
            assert all(datum.said.split()[0] in said for datum in found)


@pytest.mark.parametrize("which", [("gears-planet", None), ("pump", 7)])
def test_below_a_title_of_two_lines_data_leave_room_for_captions_of_two(which):
    """The first caption's foot is 2.2 mm above the field, its letters 3.5 mm high at most."""
    for drawing in drawings(*which):
        lowest = max(
            mark.y for mark in data_heading(drawing, "key", 24, 23.4) if isinstance(mark, Text)
        )
        assert lowest <= A3.fields[1] - 2.2 - 3.5 - 1.4


@pytest.mark.parametrize("remark", ["", ", continued"])
@pytest.mark.parametrize("count", [1, 5, 7, 9, 11, 14, 18, 22])
def test_a_title_of_any_length_stands_clear_of_the_frame_and_of_the_data(count, remark):
    """1.5 mm from the frame, 0.5 mm from letters of 2.5 mm."""
    named = NAMED.format(crank="A", rocker="B")
    for drawing in drawings_from(named, title="Quick gearing " * count):
        marks, _, foot = title_line(drawing, remark)
        boxes = [reach(mark) for mark in marks if isinstance(mark, Text) and mark.name == "title"]
        assert min(box[1] for box in boxes) >= A3.area[1] + 1.5
        assert max(box[3] for box in boxes) <= foot - 2.5 - 0.5


@pytest.mark.parametrize(("view", "language"), [("key", "ro"), ("task", "it")])
def test_long_data_stand_on_the_sheet_where_the_drawings_leave_room_or_on_the_next(view, language):
    """Six data about rollers, each half a line long, are more lines than stand above the fields."""
    for drawing in drawings_from(scene_text("documents/plank-pulled"), language):
        marks = [mark for page in drawn_sheets([drawing], view)[0].pages for mark in page.marks]
        lines = [mark for mark in marks if isinstance(mark, Text) and mark.name == NAME]
        said = " ".join(mark.markup for mark in lines)
        cells = {mark.markup for mark in lines if mark.cls == "table"}
        for datum in data(drawing, solved=view == "key"):
            assert datum.said in said or (
                {datum.name, datum.value} <= cells and datum.remark in said
            )
        assert all(mark.height == 2.5 for mark in lines)
        assert max(reach(mark)[2] for mark in lines) < A3.fields[2]


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_fields_that_are_lowered_leave_as_much_room_above_drawings_as_any_has(which):
    for drawing in drawings(*which):
        layout, more = lay_out(drawing), writing(drawing, "key").more
        fields = lowered(drawing.paper, layout, more)
        for field, old in ((fields.mechanism, layout.mechanism), (fields.plan, layout.plan)):
            assert (field.at, field.mm, field.middle) == (old.at, old.mm, old.middle)
        metres, top = drawing.scales.metres(drawing.kind), fields.plan.rect[1]
        assert fields.mechanism(1j * drawing.mechanism_extent().top)[1] >= top + ABOVE - 1e-6
        assert fields.plan(1j * drawing.plan_extent().top / metres)[1] >= top + ABOVE - 1e-6


@pytest.mark.parametrize(("name", "teeth"), [("gears-planet", (30, 20)), ("gears-pair", (24, 40))])
def test_gears_have_their_teeth_and_their_module_in_the_table(name, teeth):
    """A module that all gears share has one column; the centres are said beside the table."""
    (page, *_) = drawn_sheets(drawings(name, None), "key")[0].pages
    cells = [m for m in page.marks if isinstance(m, Text) and m.name == NAME and m.cls == "table"]
    below = {m.x: m.markup for m in cells if m.y == max(each.y for each in cells)}
    columns = [(m.markup, below[m.x]) for m in cells if m.x in below and m.markup != below[m.x]]
    assert [int(value) for head, value in columns if head.startswith("*z*_")] == [*teeth]
    assert sum(head == "*m*" for head, _ in columns) == 1


@pytest.mark.parametrize("name", ["plates-coupled", "shaper-forces", "plank-axle"])
def test_long_data_are_tables_where_the_drawings_leave_their_height(name):
    mechanism = load(name)
    last = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))[1]
    marks = data_heading(last, "key", 24, 22.4, lambda: spare_above(last))
    cells = [mark for mark in marks if isinstance(mark, Text) and mark.cls == "table"]
    rows = sorted({round(cell.y, 3) for cell in cells})
    ends = [max(reach(cell)[2] for cell in cells if round(cell.y, 3) == row) for row in rows]
    assert len(rows) % 2 == 0
    assert max(ends) - min(ends) < 60  # rows one below another are about equally long
    assert max(ends) < last.paper.left[2]
    lines = [mark.y for mark in marks if isinstance(mark, Text) and mark.cls == "caption"]
    assert min(lines) > rows[-1] + 3


PLATES = """
graphkin = 1
title = "Plates"
units = { length = "mm", angle = "deg", speed = "rev/min" }
[frame]
O = [0, 0]
Q = [180, 20]
[links.1]
O-A = 50
[links.2]
A = [0, 0]
B = [150, 0]
C = [90, 60]
[links.3]
Q = [0, 0]
B = [110, 0]
D = [50, 40]
[[drivers]]
turn = 1
angle = 60
speed = 60
[branches]
B = "left of A-Q"
"""


def test_points_of_plates_are_columns_and_their_axes_stand_beside():
    """A point with coordinates on two links has the index of each."""
    mechanism = Mechanism(read_text(PLATES, "x"))
    drawing = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))[0]
    found = data(drawing)
    values = {datum.name: datum.value for datum in found}
    assert values[symbol("C")] == "(90, 60) mm"
    assert values[symbol("B_2")] == "(150, 0) mm"
    assert values[symbol("B_3")] == "(110, 0) mm"
    said = [datum.words for datum in found]
    own = f"{symbol('B_2')} ≡ {symbol('B')}"
    assert f"{symbol('A')}, {own}, {symbol('C')}: in the axes of link 2" in said
