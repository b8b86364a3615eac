"""Where numbers of links and the teeth of gears stand, held against another library."""

from __future__ import annotations

from itertools import pairwise
from math import pi
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from graphkin.construction.guides.slide_symbols import nearest, slot_ends
from graphkin.construction.links.dyad_by_arcs import arcs_reach
from graphkin.construction.links.mechanism_symbols import (
    Body,
    label_beside,
    settle_in_plates,
    within,
)
from graphkin.construction.links.wheel_symbols import Mesh, teeth_at
from graphkin.drawing.field import Field
from graphkin.drawing.labels import FieldContent, Label
from graphkin.drawing.marks import Polyline, reach
from graphkin.numbers.plane import Circle

PLACE = st.builds(complex, st.floats(-30, 30), st.floats(-30, 30))


def body(*corners: complex) -> Body:
    """A bar between two points, or a plate with corners in order around it."""
    plate = len(corners) > 2
    around = [*corners, *corners[:1]] if plate else [*corners]
    x, y = [z.real for z in corners], [z.imag for z in corners]
    box = (min(x), min(y), max(x), max(y))
    return Body([*pairwise(around)], [*corners] if plate else [], box)


@given(st.sampled_from([(0j, 12 + 5j), (0j, 14 + 2j, 9 + 11j), (0j, 3 + 11j, 12 + 3j)]), PLACE)
def test_how_far_a_place_is_from_a_link(corners, place):
    """Nought inside a plate, whichever way its corners run."""
    found, point = body(*corners), shapely.Point(place.real, place.imag)
    line = [(z.real, z.imag) for z in corners]
    shape = shapely.Polygon(line) if len(line) > 2 else shapely.LineString(line)
    assert found.apart(place) == pytest.approx(shape.distance(point), abs=1e-9)
    if shape.boundary.distance(point) > 1e-9:
        assert found.holds(place) is (len(line) > 2 and shape.contains(point))


@given(PLACE, PLACE, st.floats(0.5, 20))
def test_a_link_is_near_a_line_where_their_boxes_are(start, end, far):
    found, plate = body(0j, 14 + 2j, 9 + 11j), shapely.box(0, 0, 14, 11)
    x, y = sorted((start.real, end.real)), sorted((start.imag, end.imag))
    wide = shapely.box(x[0] - far, y[0] - far, x[1] + far, y[1] + far)
    assert found.near(start, end, far) is wide.intersects(plate)


@pytest.mark.parametrize("name", ["3", "coupler"])
def test_the_name_of_a_plate_stands_as_a_whole_inside_it(name):
    """0.8 mm from its sides, however long it is."""
    corners = ((10.0, 10.0), (70.0, 10.0), (70.0, 40.0), (10.0, 40.0), (10.0, 10.0))
    board = FieldContent((0.0, 0.0, 100.0, 100.0))
    board.marks.append(Polyline(corners, "plate", name))
    board.labels.append(Label(name, "", (70.0, 25.0), name=name, ring=True))
    settle_in_plates(board)
    assert not board.labels
    found = [reach(mark) for mark in board.marks[1:]]
    assert max(box[2] for box in found) == pytest.approx(70 - 0.8, abs=0.05)
    assert min(box[0] for box in found) > 10.8


@pytest.mark.parametrize("corners", [(0j, 14 + 2j, 9 + 11j), (0j, 16 + 0j, 16 + 8j, 8j)])
def test_places_within_a_plate_are_spread_evenly_over_it(corners):
    """At the knots of a net of eighths of each of its triangles, 21 in each."""
    places = [*within(corners)]
    assert len(places) == 21 * (len(corners) - 2)
    shape = shapely.Polygon([(z.real, z.imag) for z in corners])
    assert all(shape.contains(shapely.Point(z.real, z.imag)) for z in places)
    first = places[:21]
    assert sum(first) / 21 == pytest.approx(sum(corners[:3]) / 3)
    assert min(abs(a - b) for a in first for b in first if a != b) == pytest.approx(
        min(abs(p - q) for p in corners[:3] for q in corners[:3] if p != q) / 8
    )


@pytest.mark.parametrize(
    ("others", "share", "side"),
    [
        ([], 0.5, 1),
        ([body(-9 - 3j, 70 - 3j)], 0.5, 1),
        ([body(-9 + 3j, 70 + 3j)], 0.5, -1),
        ([body(-9 + 4j, 70 + 4j), body(-9 - 4j, 70 - 4j)], 0.5, 1),
        ([body(20 - 9j, 20 + 9j)], 0.3, 1),
        ([body(20 - 9j, 20 + 9j), body(12 + 1j, 12 + 9j)], 0.7, 1),
    ],
)
def test_a_number_stands_beside_its_bar_where_there_is_room(others, share, side):
    """At its middle on the left of it seen along it, else on the other side or aside; 4 mm of the
    bar to both sides of that place belong to the number."""
    label = label_beside(SimpleNamespace(name="2"), 0j, 40 + 0j, others)
    (x1, y1), (x2, y2) = label.subject
    assert (x1, x2) == pytest.approx((40 * share - 4, 40 * share + 4))
    assert (y1, y2) == (0, 0)
    assert label.away == pytest.approx((0.0, float(side)))


@given(PLACE, st.floats(0.5, 20), PLACE, st.floats(0.5, 20))
def test_two_arcs_reach_one_another_where_their_circles_cross(one, r, other, s):
    found = arcs_reach(Circle(one, r), Circle(other, s))
    distance = abs(other - one)
    if min(abs(distance - r - s), abs(distance - abs(r - s))) > 1e-6:
        assert (min(found) > 0) == (abs(r - s) < distance < r + s)
    assert min(arcs_reach(Circle(one, r), Circle(one, r))) < 0


@pytest.mark.parametrize("shown", [2, 3])
@pytest.mark.parametrize("shift", [0.0, 0.5])
def test_teeth_stand_about_each_place_where_a_gear_meshes(shift, shown):
    """A tooth there, or a gap between two; a pitch apart, and none on another's place."""
    count = 60
    pitch = 2 * pi / count
    each = 2 * shown + (2 if shift else 1)
    one, other = Mesh(1.0, shift, shown), Mesh(4.0, shift, shown)
    found = teeth_at([one, other], pitch, count)
    assert len(found) == 2 * each and found == sorted(found)
    near = np.array([angle for angle in found if abs(angle - 1.0) < 1.0])
    assert near.mean() == pytest.approx(1.0)
    assert np.diff(near) == pytest.approx(pitch)
    double = teeth_at([one, Mesh(1.0 + pitch, shift, shown)], pitch, count)
    assert len(double) == each + 1
    assert np.diff(double) == pytest.approx(pitch)
    assert teeth_at([], pitch, count) == []


@pytest.mark.parametrize(("count", "shown"), [(14, 1), (22, 4), (11, 2)])
def test_a_gear_of_few_teeth_has_them_all(count, shown):
    for shift in (0.0, 0.5):
        meshes = [Mesh(2.0, shift, shown)] * 2
        found = teeth_at(meshes, 2 * pi / count, count)
        assert len(found) == count
        apart = (np.array(found) - 2.0) * count / (2 * pi) - shift
        assert apart == pytest.approx(apart.round())


def test_a_slot_reaches_13_mm_to_both_sides_and_ends_4_mm_before_a_pin_of_its_bar():
    field = Field((0, 0, 100, 100), 500.0, 0j, (50.0, 50.0))
    mm = 1 / 500
    for on, low, high in (
        ([], -13, 13),
        ([-30 * mm, 30 * mm], -13, 13),
        ([-15 * mm], -11, 13),
        ([12 * mm], -13, 8),
        ([-10 * mm, 9 * mm], -6, 5),
        ([1 * mm, -1 * mm], -13, 13),
    ):
        found = slot_ends(field, 0.1, [0.1 + each for each in on])
        assert found == pytest.approx((0.1 + low * mm, 0.1 + high * mm))
    assert [nearest(x, [2.0, 5.0, 1.0]) for x in (0.0, 3.0, 7.0)] == [1.0, 3.0, 5.0]
