"""What finds free places: boxes that meet, chords of arcs, discs, places that exclude others."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiLineString, Point, box

from graphkin.documents.detail import within
from graphkin.drawing.clearance import BESIDE, PAD, SAGITTA, Clashes, OpenPlaces, chords_of
from graphkin.drawing.free_space import Space
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Text, reach
from graphkin.drawing.shapes import NOWHERE, meeting, merged

spots = st.tuples(st.floats(0, 80), st.floats(0, 60))
halves = st.tuples(st.floats(0.1, 6), st.floats(0.1, 3))
boxes = st.lists(st.tuples(spots, halves), max_size=40)


def sides(found) -> np.ndarray:
    rows = [(x - a, y - b, x + a, y + b) for (x, y), (a, b) in found]
    return np.array(rows).reshape(-1, 4).T


@given(boxes, boxes)
def test_boxes_that_meet_are_all_found_and_no_others(one, other):
    a, b = sides(one), sides(other)
    found = set(zip(*(index.tolist() for index in meeting(a, b)), strict=True))
    for i, j in np.ndindex(len(one), len(other)):
        gap = max(*(a[:2, i] - b[2:, j]), *(b[:2, j] - a[2:, i]))
        assert (i, j) in found or gap > 0
        assert (i, j) not in found or gap < 0.01


@pytest.mark.parametrize(("count", "left"), [(2, 1), (3, 1), (8, 1), (9, 2)])
def test_tiny_lines_in_a_row_are_taken_for_one_two_by_two_in_three_rounds(count, left):
    """Eight become one from the first to the last, straight ones without more clearance, bent ones
    with as much as the chord misses them by."""
    for bend in (0.0, 0.001):
        x = 0.1 * np.arange(count + 1)
        y = bend * np.sin(9 * x)
        found, clear = merged(np.column_stack([x[:-1], y[:-1], x[1:], y[1:]]), np.full(count, 0.3))
        assert len(found) == left
        assert found[0, :2] == pytest.approx((0.0, 0.0))
        assert found[-1, 2:] == pytest.approx((x[-1], y[-1]))
        for (x0, y0, x1, y1), room in zip(found, clear, strict=True):
            chord = LineString([(x0, y0), (x1, y1)])
            within = (x >= x0 - 1e-9) & (x <= x1 + 1e-9)
            off = max(
                chord.distance(Point(*each)) for each in zip(x[within], y[within], strict=True)
            )
            assert off - 1e-12 <= room - 0.3 <= 4 * bend + 1e-12


@given(spots, st.floats(0.2, 200), st.floats(0, 360), st.floats(1, 359))
def test_chords_stay_with_their_arc(at, r, start, turn):
    chords = chords_of(Arc(*at, r, start, start + turn, "compass"))
    path = MultiLineString([((a, b), (c, d)) for a, b, c, d in chords])
    for i in range(60):
        angle = math.radians(start + turn * i / 59)
        point = Point(at[0] + r * math.cos(angle), at[1] - r * math.sin(angle))
        assert path.distance(point) <= SAGITTA + 1e-9


@st.composite
def crowded_places(draw):
    """Places of some labels, those of a label together, some with a leader."""
    found = []
    for label in range(draw(st.integers(1, 4))):
        for _ in range(draw(st.integers(1, 5))):
            (x, y), (hx, hy) = draw(spots), draw(halves)
            tip = draw(st.none() | spots)
            leader = (x + hx + 0.5, y, *tip) if tip else (NOWHERE,) * 4
            found.append((label, x, y, hx, hy, leader))
    return found


def as_places(found) -> OpenPlaces:
    label, *columns = zip(*found, strict=True)
    x, y, hx, hy, leader = (np.array(column, dtype=float) for column in columns)
    return OpenPlaces(np.array(label), x, y, hx, hy, np.zeros(len(x)), leader.reshape(-1, 4))


def apart(one, other) -> float:
    """How much room there is beyond what two places need, in mm; below 0 they clash."""
    (_, x0, y0, a0, b0, way0), (_, x1, y1, a1, b1, way1) = one, other
    room = [max(abs(x0 - x1) - a0 - a1 - BESIDE, abs(y0 - y1) - b0 - b1 - PAD)]
    paths = [LineString([w[:2], w[2:]]) if w[0] < NOWHERE else None for w in (way0, way1)]
    for path, (x, y, a, b) in zip(paths, ((x1, y1, a1, b1), (x0, y0, a0, b0)), strict=True):
        if path:
            room.append(path.distance(box(x - a, y - b, x + a, y + b)) - PAD)
    if all(paths):
        room.append(paths[0].distance(paths[1]))
    return min(room)


@settings(max_examples=100, deadline=None)
@given(crowded_places(), st.integers(0, 20))
def test_places_rule_out_those_too_near_and_those_across_their_leader(found, cut):
    clashes = Clashes()
    for part in (found[:cut], found[cut:]):
        if part:
            clashes.add(as_places(part))
            clashes.rows()
    rows = clashes.rows()
    for i, j in combinations(range(len(found)), 2):
        if found[i][0] == found[j][0]:
            continue  # what is noted between places of one label means nothing
        room, clash = apart(found[i], found[j]), bool(rows[i] >> j & 1)
        assert clash is bool(rows[j] >> i & 1)
        assert not clash or room < PAD  # a gap across a corner is taken for less than it is
        assert clash or room > -1e-9


@given(st.lists(st.tuples(spots, spots), max_size=12), spots, st.floats(4, 15))
def test_a_free_disc_is_free(ends, near, room):
    marks = [LineMark(*a, *b, "link") for a, b in ends]
    marks.append(Text(40, 30, "note", "caption", 2.5))
    disc = Space(marks, (0.0, 0.0, 80.0, 60.0)).disc(near, room)
    if disc is not None:
        place = disc.at
        assert room <= place[0] <= 80 - room
        assert room <= place[1] <= 60 - room
        drawn = [LineString([(m.x1, m.y1), (m.x2, m.y2)]) for m in marks[:-1]]
        drawn.append(box(*reach(marks[-1])))
        assert all(shape.distance(Point(place)) >= room - 1e-9 for shape in drawn)


@pytest.mark.parametrize("centre", [False, True])
def test_the_nearest_free_disc_is_taken_and_one_in_sight_before_it(centre):
    """Neither lettering nor the circle of a centre is to be crossed by the line to it."""
    rect, near = (0.0, 0.0, 100.0, 40.0), (50.0, 20.0)
    blocks = [LineMark(50, 5, 50, 35, "link")]
    right = Space(blocks, rect).disc(near, 10.0)
    assert right is not None
    assert right.in_sight
    assert math.dist(right.at, near) <= 15
    x, y = (right.at[0] + near[0]) / 2, (right.at[1] + near[1]) / 2
    text, circle = Text(x - 1.5, y + 1, "W", "caption", 2.5), CircleMark(x, y, 1, "centre velocity")
    hidden = circle if centre else text
    other = Space([*blocks, hidden], rect).disc(near, 10.0)
    assert other is not None
    assert other.in_sight
    way = LineString([near, other.at])
    assert way.distance(box(*reach(hidden))) >= 0.5
    grid = [LineMark(x, 0, x, 40, "link") for x in range(0, 101, 15)]
    assert Space(grid, rect).disc(near, 10.0) is None


def test_a_rectangle_that_is_taken_is_kept_free():
    rect, near = (0.0, 0.0, 100.0, 40.0), (50.0, 20.0)
    space = Space([], rect)
    first = space.disc(near, 10.0)
    assert first is not None
    assert math.dist(first.at, near) <= 5
    taken = (first.at[0] - 8, first.at[1] - 8, first.at[0] + 8, first.at[1] + 8)
    space.take(taken)
    second = space.disc(near, 10.0)
    assert second is not None
    assert box(*taken).distance(Point(second.at)) >= 10
    space.take(rect)
    assert space.disc(near, 10.0) is None


def test_a_disc_behind_lettering_is_taken_where_there_is_no_other():
    rect, near = (0.0, 0.0, 60.0, 20.0), (5.0, 10.0)
    wall = [Text(20, y, "W", "caption", 2.5) for y in range(3, 20, 3)]
    marks = [LineMark(9, 0, 9, 20, "link"), *wall]
    disc = Space(marks, rect).disc(near, 9.0)
    assert disc is not None
    assert not disc.in_sight


@given(spots, spots, spots, st.floats(1, 20))
def test_what_lies_in_a_circle_is_cut_out_of_a_line(start, end, centre, radius):
    assume(math.dist(start, end) > 0.01)
    line = LineString([start, end])
    part = within(LineMark(*start, *end, "link"), centre, radius)
    near = line.distance(Point(centre))
    if part is None:
        assert near >= radius - 1e-6
        return
    assert near <= radius + 1e-6
    for point in part:
        assert line.distance(Point(point)) < 1e-6
        assert math.dist(point, centre) <= radius + 1e-6
    for end_of_line, end_of_part in zip((start, end), part, strict=True):
        on_circle = math.dist(end_of_part, centre) == pytest.approx(radius, abs=1e-6)
        assert on_circle or end_of_part == end_of_line
