"""The ground of a fixed pivot: on the side that is freest, and held there while the links move."""

from __future__ import annotations

from cmath import rect
from math import radians

import pytest
import shapely
from msgspec.structs import replace

from graphkin.construction.guides.slide_symbols import ground_ways
from graphkin.drawing.marks import Polyline
from tests.chosen import CHOSEN
from tests.documents.made_up import made_up
from tests.documents.sheet_tools import VARIANTS, drawn, kind_of, kinds_of, outline

CRANK = """
[frame]
O = [0, 0]
[links.1]
O-A = 40
"""


def crank(angle: float):
    """A crank alone, at an angle in degrees."""
    return made_up(CRANK, {"O": 0j, "A": rect(40, radians(angle))})


@pytest.mark.parametrize("angle", [0, 30, 90, 150, 180])
def test_the_ground_stands_below_where_nothing_is_in_its_way(angle):
    assert ground_ways(crank(angle), 1000.0) == {"O": -1j}


@pytest.mark.parametrize("angle", [225, 250, 270, 290, 315])
def test_the_ground_turns_away_from_a_bar_that_leads_down(angle):
    (way,) = ground_ways(crank(angle), 1000.0).values()
    bar = rect(1, radians(angle))
    assert (way * bar.conjugate()).real < 0.75


def test_the_ground_stays_where_it_was_chosen_while_the_mechanism_moves():
    first = crank(90)
    assert ground_ways(replace(crank(270), chosen=first), 1000.0) == ground_ways(first, 1000.0)


SHOWN = dict.fromkeys((*CHOSEN, "link-motion"))  # a rod passes close under the pivot of its shaft


@pytest.mark.parametrize(("name", "n"), [*((name, None) for name in SHOWN), *VARIANTS])
def test_no_bar_runs_through_the_ground_of_a_pivot(name, n):
    marks = drawn(name, n, kinds_of(name, n)[0]).marks["mechanism"]
    bars = [outline(mark) for mark in marks if kind_of(mark) in ("link", "guide-bar")]
    for mark in marks:
        if isinstance(mark, Polyline) and mark.cls == "fixed-pivot":
            foot = shapely.LineString(mark.points[1:])
            assert all(bar.distance(foot) > 0.5 for bar in bars), mark
