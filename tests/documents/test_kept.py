"""What writers keep from one page to the next makes them quick and changes nothing."""

from __future__ import annotations

import io

import pypdf
import pytest

from graphkin.drawing import chords, marks, richtext
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Page, Polyline, Text
from graphkin.writers import pdf, svg
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import write_svg

KEPT = (
    chords.arc_chords,
    pdf.lettering,
    pdf.outline,
    svg.called,
    svg.element,
    svg.said,
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


def test_a_mark_keeps_its_distance_from_the_top_of_any_page():
    tall, low = page(*SHAPES, FIRST), page(*SHAPES, FIRST, height=148.5)
    both = pypdf.PdfReader(io.BytesIO(write_pdf((tall, low)))).pages
    heights = []
    for made, height in zip(both, (297.0, 148.5), strict=True):
        found = []

        def visit(text, matrix, place, *_, found=found):
            found += [place[5]] if text.strip() else []

        made.extract_text(visitor_text=visit)
        heights.append(height - found[0] * 25.4 / 72)
        drawn = made.get_contents().get_data().decode("latin-1")
        x, y = 10 * 72 / 25.4, (height - 20) * 72 / 25.4
        assert f"{svg.number(x)} {svg.number(y)}\nm" in drawn
    assert heights == pytest.approx([100, 100], abs=1e-3)


def test_a_page_that_a_mark_fits_says_nothing_of_a_smaller_one():
    page(FIRST).check()
    with pytest.raises(marks.PageError, match="within the page"):
        page(FIRST, height=90.0).check()
