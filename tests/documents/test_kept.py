"""What writers keep from one page to the next makes them quick and changes nothing."""

from __future__ import annotations

import pytest

from graphkin.drawing import clearance, richtext
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Page, Polyline, Text
from graphkin.writers import pdf, svg
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import write_svg

KEPT = (
    clearance.arc_chords,
    pdf.lettering,
    pdf.outline,
    svg.class_attributes,
    svg.element,
    svg.text_runs,
    *(richtext.laid, richtext.spaced_runs, richtext.runs, richtext.extent),
)
SHAPES = (
    LineMark(10, 20, 30, 40, "velocity", "v_A"),
    Polyline(((10.0, 60.0), (40.0, 60.0), (40.0, 80.0)), "plate", closed=True),
    CircleMark(60, 60, 5, "pin"),
    Arc(60, 60, 9, 20, 110, "angle"),
)
FIRST = Text(10, 100, "*v*_A ⊥ OA", "label", 3.5)
SECOND = Text(10, 110, "Ω ≠ *ω*_1", "label", 3.5, rotate=30)


def page(*found, height=297.0):
    return Page(210, height, found)


def forget():
    for kept in KEPT:
        kept.cache_clear()


@pytest.mark.parametrize("write", [write_svg, lambda one: write_pdf((one,))])
def test_pages_before_it_leave_a_page_as_it_is(write):
    pages = [page(*SHAPES, FIRST, SECOND), page(SECOND, *SHAPES, FIRST), page(FIRST)]
    alone = []
    for one in pages:
        forget()
        alone.append(write(one))
    assert [write(one) for one in pages] == alone
    assert [write(one) for one in reversed(pages)] == alone[::-1]
