"""Sheets of mechanisms with every kind of pair can be read: nothing on anything, all inside."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
import shapely

from graphkin.construction.core.layout import lay_out
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.marks import Text
from graphkin.mechanism import load
from graphkin.text import words
from tests.documents.sheet_tools import KINDS, Drawn, fields_of, kind_of, outline, told
from tests.documents.test_sheets import (  # noqa: F401 - the same laws, for the sheets of this file
    test_no_label_touches_a_line_or_another_text,
    test_nothing_leaves_the_frame_or_its_field,
)

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
SHOWN = {
    "crank-slot": ("block", "guide-bar"),
    "crank-fixed-slot": ("block", "slider", "guide-bar"),
    "oscillating-slide": ("block",),
    "oldham": ("block", "guide-bar"),
    "eight-link-1": ("block", "slider", "hinge"),
    "mobility-cam": ("block", "weld"),
    "rapid-return-slider": ("block", "slider", "drive"),
    "trammel": ("slider", "drive"),
    "roller": ("disc", "spoke", "contact", "guide"),
    "roller-plates": ("disc", "contact", "guide-bar"),
    "gears-pair": ("gear-disc", "pitch", "contact"),
    "gears-planet": ("gear-disc", "pitch", "contact"),
    "gears-rack": ("gear-disc", "pitch", "slider"),
}
"""What must be seen on the mechanism of each scene."""


@cache
def drawn(name: str, kind: str) -> Drawn:
    """One sheet of an example."""
    mechanism = load(SCENES / f"{name}.toml")
    verdict = proved(mechanism, mechanism.solve())
    for drawing in drawings_of(mechanism, verdict, words("en")):
        if drawing.kind == kind:
            layout = lay_out(drawing)
            page = sheet(drawing, "key", "1/2", layout)
            return Drawn(drawing, layout, page, fields_of(drawing, page))
    raise AssertionError(f"{name} has no sheet of {kind}")


@pytest.fixture(params=[(name, kind) for name in SHOWN for kind in KINDS], ids="-".join)
def page(request) -> Drawn:
    return drawn(*request.param)


@pytest.mark.parametrize("name", SHOWN)
def test_the_symbols_of_every_pair_are_there(name):
    found = {kind_of(mark) for mark in drawn(name, "velocity").marks["mechanism"]}
    assert found >= set(SHOWN[name])


def test_no_block_hides_a_part_of_a_line_or_an_arc_that_found_a_point(page):
    marks = page.marks["mechanism"]
    for k, mark in enumerate(marks):
        if kind_of(mark) in ("block", "slider"):
            block = shapely.Polygon(mark.points)
            steps = [m for m in marks[:k] if m.step is not None and not isinstance(m, Text)]
            assert not [told(m) for m in steps if outline(m).intersects(block)]


@pytest.mark.parametrize("name", SHOWN)
def test_every_link_has_its_number(name):
    page = drawn(name, "velocity")
    said = [page.meaning("mechanism", label) for label in page.labels("mechanism")]
    assert [said.count(link) for link in page.drawing.scene.links] == [
        1 for _ in page.drawing.scene.links
    ]
