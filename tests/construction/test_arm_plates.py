"""The plate of an arm lies below its wheels, so that the sun within it is seen."""

import pytest

from graphkin.construction.core.layout import lay_out
from graphkin.construction.links.mechanism_symbols import draw_plates
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import Polyline
from tests.documents.sheet_tools import drawings


@pytest.mark.parametrize(("name", "arm"), [("gears-three-planets", "2"), ("gears-ravigneaux", "4")])
def test_the_plate_of_an_arm_comes_before_its_wheels(name, arm):
    drawing = drawings(name)[0]
    field = lay_out(drawing).mechanism
    board = FieldContent(field.rect)
    draw_plates(board, drawing, field)
    plates = [i for i, m in enumerate(board.marks) if isinstance(m, Polyline) and m.cls == "plate"]
    assert [board.marks[i].name for i in plates] == [arm]
    assert plates == [0]
    assert len(board.marks) > len(drawing.standing.discs)
