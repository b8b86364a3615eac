"""The drawn part of a guide of the frame stays clear of fixed pivots, in every kind of number, its
line of the field's edge; what bears the frame stays clear of the notes."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.construction.core.plot import above_foot
from graphkin.construction.guides.slide_symbols import AWAY, LEAST, REACH, clear_of_pivots, rails_of
from graphkin.drawing.marks import LineMark, Text, reach
from tests.documents.made_up import field_of, made_up
from tests.documents.sheet_tools import drawn

SCENE = """
[frame]
O = [0, {below}]
G = [0, 0]
[links.1]
O-B = 40
[links.2]
A = [0, 0]
slides = {{ on = 0, through = "G", angle = 0 }}
"""
SPANS = {
    30: (30 - REACH, 30 + REACH),
    20: (AWAY, 20 + REACH),
    10: (10 - LEAST, 10 + REACH),
    -10: (-10 - REACH, -10 + LEAST),
    -20: (-20 - REACH, -AWAY),
    -30: (-30 - REACH, -30 + REACH),
}
"""The drawn part, in mm from a pivot on the guide, by where the block stands."""


def span(middle, below=0):
    """The part about a block whose middle stands there, with the pivot so far below the guide."""
    points = {"O": -1j * below, "G": 0j, "B": 40 - 1j * below, "A": 0j}
    drawing = made_up(SCENE.format(below=-below), points)
    (rail,) = rails_of(drawing)
    return clear_of_pivots(drawing, field_of(drawing), rail, middle)


@pytest.mark.parametrize("middle", SPANS)
def test_a_guide_ends_before_a_pivot_but_holds_its_block(middle):
    assert span(float(middle)) == pytest.approx(SPANS[middle])


def test_many_places_at_once_give_what_each_gives_alone():
    low, high = span(np.array(list(SPANS), float))
    expected = np.array(list(SPANS.values())).T
    assert (low, high) == (pytest.approx(expected[0]), pytest.approx(expected[1]))


def test_a_pivot_well_beside_the_guide_shortens_nothing():
    assert span(10.0, below=20) == pytest.approx((10 - REACH, 10 + REACH))


@pytest.mark.parametrize(
    "name", ["offset-slider-crank", "rapid-return", "trammel", "roller-plates"]
)
def test_the_line_of_a_guide_ends_within_the_field(name):
    page = drawn(name, 1 if name == "offset-slider-crank" else None, "velocity")
    left, top, right, bottom = above_foot(page.layout.mechanism.rect)
    lines = [m for m in page.page.marks if isinstance(m, LineMark) and m.name.startswith("guide ")]
    assert lines
    for line in lines:
        across, down = sorted((line.x1, line.x2)), sorted((line.y1, line.y2))
        assert left - 1e-9 <= across[0] and across[1] <= right + 1e-9, line
        assert top - 1e-9 <= down[0] and down[1] <= bottom + 1e-9, line


@pytest.mark.parametrize("language", ["en", "it", "ro"])
def test_notes_stand_below_the_ground_of_pivots(language):
    page = drawn("watt-1", None, "acceleration", language=language)
    marks = page.marks["mechanism"]
    foot = page.marks["plan"]  # whose last note stands as low as one of this field would
    notes = [reach(m) for m in foot if isinstance(m, Text) and m.name == "note"][-1:]
    ground = [m for m in marks if isinstance(m, LineMark) and m.cls == "ground"]
    assert notes and ground
    assert max(max(m.y1, m.y2) for m in ground) < min(box[1] for box in notes)
