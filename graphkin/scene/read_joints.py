"""The guides of blocks, and what is written as they are: a line, a table or a list of them."""

from __future__ import annotations

from graphkin.scene.findings import Table, numbered, one_or_many, shown
from graphkin.scene.measures import FloatText, Measures, Pair
from graphkin.scene.model import FRAME, Slide
from graphkin.scene.phrases import line_words, link_name, point_name
from graphkin.scene.quantity import Quantity

MOST = 20
GUIDE = "the link that carries the guide, 0 for the frame"


def tables(table: Table, key: str) -> list[Table]:
    """The tables of a key that may hold one or a list of them."""
    raws = one_or_many(table.take(key))
    if len(raws) > MOST:
        table.findings.add(table.at(key), f"a list of {len(raws)}", f"at most {MOST}")
    found = []
    for index, raw in enumerate(raws[:MOST]):
        place = numbered(table.at(key), index, len(raws))
        if isinstance(raw, dict):
            found.append(Table(place, raw, table.findings))
        else:
            table.findings.add(place, shown(raw), "a table { … }, or a list of them")
    return found


def read_slides(table: Table, measures: Measures) -> tuple[Slide, ...]:
    """The guides of a block."""
    return tuple(read_slide(each, measures) for each in tables(table, "slides"))


def read_slide(table: Table, measures: Measures) -> Slide:
    """One guide: ``{ on, through, angle, offset }`` or ``{ on, along = "P-Q", offset }``."""
    on = link_name(table.at("on"), table.take("on"), measures.findings, GUIDE) or FRAME
    raw = table.take("along")
    through, angle, along = None, None, None
    if raw is None:
        through, angle = read_line(table, measures)
    else:
        along = line_words(table.at("along"), raw, measures.findings)
        for key in ("through", "angle"):
            if table.take(key) is not None:
                expected = 'either along = "P-Q", or through and angle'
                measures.findings.add(table.at(key), f"{key} beside along", expected)
    offset = read_offset(table, measures)
    pin = table.flag("pin")
    table.finish()
    return Slide(on, through, angle, along, offset, pin)


def read_offset(table: Table, measures: Measures) -> Quantity:
    """The distance kept to the left of a guide, nought where it is not written."""
    raw = table.take("offset")
    return measures.length(table.at("offset"), 0 if raw is None else raw)


def read_line(table: Table, measures: Measures) -> tuple[str | Pair | None, Quantity | None]:
    """A line by a point that it passes through and its angle to the x axis of its link."""
    raw, turned = table.take("through"), table.take("angle")
    if raw is None:
        expected = 'through = "P" or [x, y], with an angle, or along = "P-Q"'
        measures.findings.add(table.place, "no through", expected)
    elif turned is None:
        measures.findings.add(table.place, "through without an angle", "angle = …")
    through: str | Pair | None
    if isinstance(raw, list):
        through = measures.point(table.at("through"), raw)
    elif raw is None:
        through = None
    elif isinstance(raw, str) and not isinstance(raw, FloatText):
        through = point_name(table.at("through"), raw, measures.findings)
    else:
        through, expected = None, 'the name of a point, "P", or two coordinates [x, y]'
        measures.findings.add(table.at("through"), shown(raw), expected)
    angle = None if turned is None else measures.angle(table.at("angle"), turned)
    return through, angle
