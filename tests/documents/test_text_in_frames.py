"""In every view no text leaves its frame, its cell or its page, as a PDF shows it.

The boxes of the letters are those that another program reads from the file, not the widths by which
the pages were laid out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from ctypes import c_float
from itertools import pairwise

import numpy as np
import pypdfium2
import pytest
from msgspec.structs import replace
from pypdfium2 import raw

from graphkin.documents.calculation import calculation
from graphkin.documents.sheet_documents import CALCULATED, drawn_sheets
from graphkin.drawing.field import A3, A4_FRAME, A4_SIZE, paper_of
from graphkin.drawing.marks import LineMark, Mark, Page, Polyline, Text
from graphkin.text import words
from graphkin.writers.pdf import write_pdf
from tests.chosen import CHOSEN, EVERY, spoken_by
from tests.documents.sheet_tools import drawings, kind_of, texts
from tests.mechanisms import SHIPPED

LABS = SHIPPED if EVERY else ("pump",)
WHICH = [*((lab, 7) for lab in LABS), *((name, None) for name in CHOSEN)]
VIEWS = ("key", "task", "steps", "overlay")
MM = 25.4 / 72
NEAR = 0.05
"""How far, in mm, a letter may reach over a line or the frame without being seen to."""
SLACK = np.array([NEAR, NEAR, -NEAR, -NEAR])
RULES = ("frame", "border", "panel")
"""The classes of the lines of frames and cells."""
OWN = ("known", "vector")
"""The names of those that belong to the symbol beside them."""
OUTSIDE = 5.0
"""How wide the band of letters and digits around the frame of a sheet is, in mm."""


def pages_of(name: str, n: int | None, language: str) -> Iterator[Page]:
    """The pages of a scene or a student's lab in all views, its calculations among them.

    Of pages that grow step by step each has the texts that the one before it lacks.
    """
    found = [replace(each, words=words(language)) for each in drawings(name, n)]
    for view in VIEWS:
        for sheet in drawn_sheets(found, view):
            yield from newly_written(sheet.pages) if view == "steps" else sheet.pages
        if view in CALCULATED:
            yield from calculation(found, view)


def newly_written(pages: Sequence[Page]) -> Iterator[Page]:
    """Pages that grow, without the texts of the one before."""
    before: set[Mark] = set()
    for page in pages:
        kept = (m for m in page.marks if not isinstance(m, Text) or m not in before)
        yield replace(page, marks=tuple(kept))
        before = {*page.marks}


def boxes_of(page: pypdfium2.PdfPage, height: float) -> Iterator[tuple[float, ...]]:
    """The left, top, right and bottom of each piece of text of a page of a PDF, in mm."""
    for piece in page.get_objects(filter=[raw.FPDF_PAGEOBJ_TEXT]):
        ends = [c_float() for _ in range(4)]
        raw.FPDFPageObj_GetBounds(piece.raw, *ends)
        left, bottom, right, top = (end.value * MM for end in ends)
        yield left, height - top, right, height - bottom


def rules_of(page: Page) -> np.ndarray:
    """The straight lines of the frame and the cells of a page: x0, y0, x1, y1 in mm."""
    found: list[tuple[float, float, float, float]] = []
    for mark in page.marks:
        if kind_of(mark) not in RULES or mark.name in OWN:
            continue
        if isinstance(mark, LineMark):
            found.append((mark.x1, mark.y1, mark.x2, mark.y2))
        elif isinstance(mark, Polyline):
            corners = [*mark.points, *(mark.points[:1] if mark.closed else ())]
            found += [(*start, *end) for start, end in pairwise(corners)]
    lines = np.array(found)
    return np.hstack(
        [np.minimum(lines[:, :2], lines[:, 2:]), np.maximum(lines[:, :2], lines[:, 2:])]
    )


def in_points(box: np.ndarray, height: float) -> list[float]:
    """A box of a page in mm as its left, bottom, right and top in points."""
    left, top, right, bottom = box
    return [side / MM for side in (left, height - bottom, right, height - top)]


def faults(pages: Sequence[Page]) -> Iterator[str]:
    """The pieces of text that leave the frame of their page, or that a line of it crosses."""
    written = [replace(page, marks=tuple(texts([page]))) for page in pages]
    document = pypdfium2.PdfDocument(write_pdf(written))
    for page, printed in zip(pages, document, strict=True):
        boxes = np.array([*boxes_of(printed, page.height)])
        at = boxes + SLACK
        is_small, is_sheet = page.width == A4_SIZE[0], any(m.cls == "border" for m in page.marks)
        area = paper_of("A4", "ISO").leaf.area if is_small else A3.area
        left, top, right, low = area if is_sheet else A4_FRAME if is_small else A3.area
        inside = (at[:, :2] >= (left, top)).all(1) & (at[:, 2:] <= (right, low)).all(1)
        if is_sheet or not is_small:  # the letters of a sheet's grid stand around its frame
            inner = (at[:, 2:] > (left, top)).all(1) & (at[:, :2] < (right, low)).all(1)
            outer = (at[:, :2] >= (left - OUTSIDE, top - OUTSIDE)).all(1)
            outer &= (at[:, 2:] <= (right + OUTSIDE, low + OUTSIDE)).all(1)
            inside |= outer & ~inner
        rules = rules_of(page)
        crossed = (at[:, None, :2] < rules[None, :, 2:]).all(2)
        crossed &= (rules[None, :, :2] < at[:, None, 2:]).all(2)
        for i in (~inside | crossed.any(1)).nonzero()[0]:
            place = ", ".join(f"{side:.2f}" for side in boxes[i])
            words_ = printed.get_textpage().get_text_bounded(*in_points(boxes[i], page.height))
            yield f"{page.title}: “{words_}” ({place})"


@pytest.mark.parametrize(
    ("name", "n", "language"),
    [(name, n, language) for name, n in WHICH for language in spoken_by(name)],
)
def test_no_text_leaves_its_frame_its_cell_or_its_page(name, n, language):
    found = [*faults([*pages_of(name, n, language)])]
    assert not found, "\n".join(found)
