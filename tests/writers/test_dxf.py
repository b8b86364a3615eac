"""A DXF holds every stroke of a sheet at its true size, on the layer of its class."""

from __future__ import annotations

from io import StringIO
from math import dist, hypot

import ezdxf
import pytest

from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import Arc, LineMark, Page, Text
from graphkin.mechanism import load
from graphkin.writers.dxf import write_dxf
from graphkin.writers.files import rendered


@pytest.fixture(scope="module")
def sheet() -> Page:
    """The velocity sheet of the pump."""
    parts = hand_out(load("pump"), view="key", language="en")
    return next(part for part in parts if part.kind == "velocity").pages[0]


def read(data: bytes):
    """A DXF read and found sound."""
    document = ezdxf.read(StringIO(data.decode("utf-8")))
    assert not document.audit().errors
    return document


def test_lines_and_arcs_have_their_length_and_layer(sheet):
    document = read(write_dxf(sheet))
    assert document.units == ezdxf.units.MM
    space = document.modelspace()
    wanted = sorted(
        (mark.cls.split()[0], round(hypot(mark.x2 - mark.x1, mark.y2 - mark.y1), 6))
        for mark in sheet.marks
        if isinstance(mark, LineMark) and (mark.x1, mark.y1) != (mark.x2, mark.y2)
    )
    lines = sorted(
        (line.dxf.layer, round(dist(line.dxf.start, line.dxf.end), 6))
        for line in space.query("LINE")
    )
    assert lines == wanted
    assert {"velocity", "link", "construction"} <= {layer for layer, _ in lines}
    arcs = [mark for mark in sheet.marks if isinstance(mark, Arc)]
    assert len(space.query("ARC")) == len(arcs)


def test_an_arc_and_a_line_lie_where_the_page_has_them():
    arc = Arc(50, 60, 10, 30, 120, "compass")
    line = LineMark(50, 60, 70, 40, "velocity")
    text = Text(10, 20, "*v*_A", "label velocity", rotate=90)
    space = read(write_dxf(Page(100, 100, (arc, line, text)))).modelspace()
    (drawn,) = space.query("ARC")
    (x, y) = arc.at(30)
    assert dist((drawn.start_point.x, drawn.start_point.y), (x, 100 - y)) < 1e-9
    assert drawn.dxf.radius == 10
    (stroke,) = space.query("LINE")
    assert dist((stroke.dxf.end.x, stroke.dxf.end.y), (70, 60)) < 1e-9
    first, index = space.query("TEXT")
    assert (first.dxf.text, index.dxf.text) == ("v", "A")
    assert index.dxf.insert.y > first.dxf.insert.y  # it reads upwards
    assert index.dxf.insert.x > 10  # and an index stands below its line


def test_the_same_page_has_the_same_bytes_and_its_own_file(sheet):
    assert write_dxf(sheet) == write_dxf(sheet)
    assert list(rendered("pump-velocity-key", "velocity", [sheet], ("dxf",))) == [
        "pump-velocity-key.dxf"
    ]
