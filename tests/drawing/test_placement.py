"""Labels keep clear of all that is drawn, and sit where a reader looks for them."""

from __future__ import annotations

import math
from itertools import combinations, pairwise
from math import dist
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace
from shapely import LineString, MultiLineString, Point, box

from graphkin.drawing import clearance, placement
from graphkin.drawing.clearance import LONGEST, PAD, Blots, Subjects, distance_cost, tries
from graphkin.drawing.placement import CLEAR, Segment, Spot, Wish, place
from graphkin.drawing.shapes import LOOSE, merged, segments, separation

FIELD = (0.0, 0.0, 80.0, 60.0)
NONE = np.empty((0, 4))

inner = st.tuples(st.floats(2, 78), st.floats(2, 58))
sizes = st.tuples(st.floats(2, 9), st.floats(1.8, 4))
angles = st.floats(0, 2 * math.pi)


def ink(wish: Wish, spot: Spot):
    return box(
        spot.x - wish.width / 2,
        spot.y - wish.height / 2,
        spot.x + wish.width / 2,
        spot.y + wish.height / 2,
    )


@st.composite
def wishes(draw) -> Wish:
    width, height = draw(sizes)
    start = draw(inner)
    turn, length = draw(angles), draw(st.floats(0.5, 30))
    end = (start[0] + length * math.cos(turn), start[1] + length * math.sin(turn))
    line = draw(st.booleans())
    lean = draw(st.none() | angles)
    return Wish(
        width,
        height,
        (start, end) if line else start,
        away=None if lean is None else (math.cos(lean), math.sin(lean)),
        priority=draw(st.integers(0, 2)),
        gap=draw(st.sampled_from([0.8, 1.0, 1.5])),
        radius=0.0 if line else draw(st.sampled_from([0.0, 0.5, 1.5])),
    )


@st.composite
def knots(draw):
    """Short vectors and points within a few millimetres, with boxes and lines around them."""
    at = st.tuples(st.floats(37, 43), st.floats(27, 33))
    short = [(a, b) for a, b in draw(st.lists(st.tuples(at, at), min_size=4, max_size=8))]
    points = draw(st.lists(at, min_size=2, max_size=6))
    asked = [Wish(6.5, 4, (a, b) if math.dist(a, b) > 0.5 else a) for a, b in short]
    asked += [Wish(3, 2.5, p, radius=0.5) for p in points]
    turns = draw(st.lists(angles, min_size=2, max_size=5))
    away = [(40 + 11 * math.cos(t), 30 + 11 * math.sin(t)) for t in turns]
    boxes = [(x - 2, y - 1, x + 2, y + 1) for x, y in away]
    return asked, [(*a, *b) for a, b in short], boxes


@st.composite
def crowds(draw):
    asked = draw(st.lists(wishes(), min_size=1, max_size=14))
    lines = [(*a, *b) for a, b in draw(st.lists(st.tuples(inner, inner), min_size=0, max_size=14))]
    for wish in asked:
        if isinstance(wish.subject[0], tuple):
            lines.append((*wish.subject[0], *wish.subject[1]))
    boxes = [
        (x, y, x + w, y + h)
        for (x, y), (w, h) in draw(st.lists(st.tuples(inner, sizes), min_size=0, max_size=5))
    ]
    return asked, lines, boxes


def settled(asked, lines, boxes, field=FIELD):
    spots = place(asked, lines or NONE, boxes or NONE, field)
    assert len(spots) == len(asked)
    return [(w, s, ink(w, s)) for w, s in zip(asked, spots, strict=True) if s.free]


@given(crowds() | knots())
def test_a_free_label_touches_nothing(crowd):
    asked, lines, boxes = crowd
    free = settled(asked, lines, boxes)
    drawn = MultiLineString([((a, b), (c, d)) for a, b, c, d in lines])
    for wish, _, label in free:
        assert box(*FIELD).buffer(1e-9).covers(label)
        assert not lines or drawn.distance(label) >= CLEAR - 1e-9
        assert all(box(*taken).distance(label) >= PAD - 1e-9 for taken in boxes)
        subject = wish.subject
        subject = LineString(subject) if isinstance(subject[0], tuple) else Point(subject)
        assert subject.distance(label) >= wish.gap + wish.radius - 1e-6
    for (_, _, one), (_, _, other) in combinations(free, 2):
        assert one.distance(other) >= PAD - 1e-9


@given(knots())
def test_leaders_cross_no_label_no_box_and_no_other_leader(crowd):
    asked, lines, boxes = crowd
    free = settled(asked, lines, boxes)
    leaders = [(LineString(s.leader), s) for _, s, _ in free if s.leader]
    for path, spot in leaders:
        assert not any(path.intersects(label) for _, other, label in free if other is not spot)
        foot = Point(spot.leader[1])
        taken = [box(*b) for b in boxes]
        assert not any(path.intersects(b) for b in taken if b.distance(foot) > 1.0)
    assert not any(a.crosses(b) for (a, _), (b, _) in combinations(leaders, 2))


@given(crowds() | knots())
def test_far_labels_have_a_leader_to_their_subject(crowd):
    for wish, spot, label in settled(*crowd):
        line = isinstance(wish.subject[0], tuple)
        subject = LineString(wish.subject) if line else Point(wish.subject)
        if subject.distance(label) > wish.gap + wish.radius + 6.0:
            assert spot.leader
        if spot.leader:
            start, foot = spot.leader
            assert label.distance(Point(start)) < 0.75
            assert subject.distance(Point(foot)) == pytest.approx(wish.radius, abs=1e-6)


@pytest.mark.parametrize("turn", range(0, 360, 15))
@pytest.mark.parametrize("line", [False, True])
def test_the_preferred_side_is_kept_in_free_space(turn, line):
    u = (math.cos(math.radians(turn)), math.sin(math.radians(turn)))
    along = ((40 - 10 * u[1], 30 + 10 * u[0]), (40 + 10 * u[1], 30 - 10 * u[0]))
    wish = Wish(6, 3, along if line else (40, 30), away=u)
    drawn = [(*along[0], *along[1])] if line else NONE
    (spot,) = place([wish], drawn, NONE, FIELD)
    assert spot.free
    assert spot.leader is None
    way = (spot.x - 40, spot.y - 30)
    assert (way[0] * u[0] + way[1] * u[1]) / math.hypot(*way) > 0.8


def test_labels_of_two_near_lines_take_the_outer_sides():
    upper, lower = ((10.0, 28.0), (70.0, 28.0)), ((10.0, 33.0), (70.0, 33.0))
    lines = [(*a, *b) for a, b in (upper, lower)]
    one, two = place([Wish(6, 3, upper), Wish(6, 3, lower)], lines, NONE, FIELD)
    assert one.y < 28
    assert two.y > 33


def test_a_walled_label_gets_a_leader():
    walls = [(30, 24, 50, 24), (30, 36, 50, 36), (30, 24, 30, 36), (50, 24, 50, 36)]
    grid = [(x, 24, x, 36) for x in range(32, 50, 2) if x != 40]
    wish = Wish(6, 3, (40, 30))
    (spot,) = place([wish], walls + grid, NONE, FIELD)
    assert spot.free
    assert spot.leader
    assert spot.leader[1] == pytest.approx((40, 30))


def test_the_higher_priority_gets_the_only_place():
    low, high = Wish(9, 4, (5.0, 6.0)), Wish(9, 4, (7.0, 6.0), priority=1)
    field = (0.0, 0.0, 10.0, 6.5)
    assert place([low], NONE, NONE, field)[0].free
    assert [s.free for s in place([low, high], NONE, NONE, field)] == [False, True]
    assert [s.free for s in place([high, low], NONE, NONE, field)] == [True, False]


@given(inner, st.floats(0.2, 9), st.integers(3, 60), st.floats(0.1, 2 * math.pi))
def test_chords_merged_keep_labels_as_far_as_all_of_them(at, r, count, turn):
    steps = [turn * k / count for k in range(count + 1)]
    points = [(at[0] + r * math.cos(t), at[1] + r * math.sin(t)) for t in steps]
    chords = np.array([(*a, *b) for a, b in pairwise(points)])
    fewer, clear = merged(chords, np.full(count, CLEAR))
    assert len(fewer) <= count
    assert (clear <= CLEAR + LOOSE).all()
    kept = MultiLineString([((a, b), (c, d)) for a, b, c, d in fewer])
    slack = float(clear.max()) - CLEAR
    assert all(kept.distance(Point(point)) <= slack + 1e-9 for point in points)


@given(st.lists(st.tuples(inner, inner), min_size=1, max_size=10), st.lists(inner), sizes)
def test_what_is_ruled_out_at_a_glance_is_too_near_a_line(ends, at, size):
    lines = np.array([(*a, *b) for a, b in ends])
    x, y = np.array(at).reshape(-1, 2).T
    hx, hy = np.full(len(x), size[0] / 2), np.full(len(x), size[1] / 2)
    hit = Blots(lines, FIELD, 0.7 * CLEAR).hit(x, y, hx, hy)
    apart = separation(x[:, None], y[:, None], hx[:, None], hy[:, None], segments(lines))
    assert (apart[hit] < CLEAR).any(axis=1).all()


def test_a_label_walled_in_around_still_finds_a_place_within_the_longest_leader():
    walls = [(k, 18.0, k, 42.0) for k in np.arange(20, 61, 2.0)]
    wish = Wish(6, 3, (40, 30))
    (spot,) = place([wish], walls, NONE, FIELD)
    assert spot.free
    assert spot.leader and dist(*spot.leader) <= LONGEST
    farther = [(k, 10.0, k, 50.0) for k in np.arange(20, 61, 2.0)]
    (spot,) = place([wish], farther, NONE, FIELD)
    assert not spot.free
    (spot,) = place([replace(wish, optional=True)], walls, NONE, FIELD)
    assert not spot.free  # so far no place is looked for


def test_a_line_drawn_there_and_back_is_not_merged_away():
    there = (37.0, 27.0, 40.5, 29.0)
    wish = Wish(width=3, height=2.5, subject=(37.0, 27.0), radius=0.5)
    (spot,) = place([wish], [there, (*there[2:], *there[:2])], NONE, FIELD)
    line = LineString([there[:2], there[2:]])
    assert spot.free and line.distance(ink(wish, spot)) >= CLEAR - 1e-9


def test_a_spare_label_has_no_place_rather_than_a_leader_across_a_strong_line():
    walls = [(k, 20.0, k, 40.0) for k in np.arange(20, 61, 2.0)]
    ring = [(37, 27, 43, 27), (43, 27, 43, 33), (43, 33, 37, 33), (37, 33, 37, 27)]
    wish = Wish(6, 3, (40, 30))
    for strong, spare in ((NONE, True), (ring, False), (ring, True)):
        (spot,) = place([replace(wish, spare=spare)], walls, NONE, FIELD, strong=strong)
        assert spot.free == (not spare or strong is NONE)


def test_labels_keep_to_a_field_of_their_own_each():
    fields = [(0.0, 0.0, 40.0, 40.0), (40.0, 0.0, 80.0, 40.0)]
    wishes = [Wish(12.0, 4.0, (x, 20.0)) for x in (38.0, 42.0)]
    found = place(wishes, [], [], fields)
    for spot, field in zip(found, fields, strict=True):
        assert spot.free
        assert field[0] <= spot.x - 6.0 and spot.x + 6.0 <= field[2]


@pytest.mark.parametrize("turn", [2, 3, 4, 5, 6])
@pytest.mark.parametrize("length", [14, 20, 30, 40])
def test_no_label_sits_beyond_another_line_without_a_leader(turn, length):
    """One line between two longer ones that all begin at one place, in degrees and mm."""

    def ray(degrees: float, far: float) -> Segment:
        way = math.radians(degrees)
        return (20.0, 40.0), (20.0 + far * math.cos(way), 40.0 - far * math.sin(way))

    rays = [ray(0, 60), ray(turn, length), ray(2 * turn, 60)]
    wishes = [Wish(5, 3, ends, gap=0.9) for ends in rays]
    spots = place(wishes, [(*a, *b) for a, b in rays], NONE, (0.0, 0.0, 120.0, 90.0))
    own, bare = LineString(rays[1]), spots[1].leader is None
    way = LineString([(spots[1].x, spots[1].y), own.interpolate(own.length / 2)])
    assert not bare or not any(way.crosses(LineString(rays[k])) for k in (0, 2))


def test_a_leader_goes_round_a_strong_line_where_there_is_another_place():
    """A crowd above its point leaves a label places with a leader only, most behind a bar."""
    near = [(14.0 + 3 * i, 8.0, 14.0 + 3 * i, 32.0) for i in range(5)]
    bar = (0.0, 36.0, 60.0, 36.0)
    wish = Wish(6.0, 3.0, (20.0, 30.0))
    field = (0.0, 0.0, 60.0, 60.0)
    (free,) = place([wish], [*near, bar], [], field)
    (led,) = place([wish], [*near, bar], [], field, strong=[bar])
    assert free.leader is not None and free.y > 36
    assert led.leader is not None and led.y < 36


def crowd(count: int) -> list[Wish]:
    """Labels for points on a short line, more than have room around it."""
    return [Wish(6, 3, (20 + 0.4 * i, 30.0), priority=i % 3) for i in range(count)]


def test_places_compared_a_few_at_a_time_rule_out_the_same(monkeypatch):
    at_one_go = place(crowd(30), [[10, 31, 60, 31]], NONE, FIELD)
    monkeypatch.setattr(clearance, "AT_ONCE", 7)
    monkeypatch.setattr(placement, "AT_ONCE", 3)
    assert place(crowd(30), [[10, 31, 60, 31]], NONE, FIELD) == at_one_go


def test_no_more_places_are_offered_than_a_page_may_have(monkeypatch):
    """What is placed is clear all the same; with all places more labels find one."""
    found = place(crowd(60), NONE, NONE, FIELD)
    monkeypatch.setattr(placement, "MOST", 300)
    offered: list[int] = []
    add = clearance.Clashes.add

    def counted(self, more):
        add(self, more)
        offered.append(len(self.places.label))

    monkeypatch.setattr(clearance.Clashes, "add", counted)
    fewer = place(crowd(60), NONE, NONE, FIELD)
    assert 250 < max(offered) <= 300
    assert 0 < sum(spot.free for spot in fewer) <= sum(spot.free for spot in found)
    boxes = [ink(w, spot) for w, spot in zip(crowd(60), fewer, strict=True) if spot.free]
    assert not any(a.intersects(b) for a, b in combinations(boxes, 2))


def subject(ends: tuple[float, ...], radius: float = 0.0) -> Subjects:
    """One label of 6 by 3 mm, 1 mm from what it names, that wishes to stand to the right."""
    columns = (ends, (3.0, 1.5), 1.0, radius, (1.5, 0.0), ends[:2] != ends[2:], False)
    return Subjects(*(np.array([column]) for column in columns))


@pytest.mark.parametrize("far", [None, np.array([6.0, 11.0])], ids=["near", "far"])
@pytest.mark.parametrize("radius", [0.0, 1.3])
def test_places_around_a_point_keep_its_gap_and_lie_all_around(radius, far):
    """The box is as far from the point as it is asked, and hardly farther."""
    steps = np.array([0.0, 2.0])
    found = tries(subject((40, 30, 40, 30), radius), steps, far)
    away = [
        box(x - 3, y - 1.5, x + 3, y + 1.5).distance(Point(40, 30))
        for x, y in zip(found.x[0], found.y[0], strict=True)
    ]
    asked = 1.0 + radius + (steps if far is None else far)
    count = 20 if far is None else 36
    more = np.array(away).reshape(2, count) - asked[:, None]
    assert (more > -1e-9).all() and more.max() < 0.03
    turns = np.sort(np.arctan2(found.toward_y[0], found.toward_x[0])[:count] % (2 * np.pi))
    assert np.diff(turns) == pytest.approx(2 * np.pi / count)
    assert set(found.root_x[0]) == {40.0} and set(found.root_y[0]) == {30.0}


@pytest.mark.parametrize("end", [(70.0, 30.0), (61.0, 12.0), (40.0, 3.0)])
def test_places_beside_a_segment_stand_along_its_middle_two_thirds(end):
    """On both sides, the near edge of the box as far from the line as it is asked."""
    steps = np.array([0.0, 2.5])
    found = tries(subject((40, 30, *end)), steps)
    line, count = np.subtract(end, (40, 30)), 14
    endless = LineString([np.array((40, 30)) - 9 * line, np.array((40, 30)) + 9 * line])
    roots = np.stack([found.root_x[0], found.root_y[0]])[:, : 2 * count] - [[40], [30]]
    shares = np.unique((roots * line[:, None]).sum(axis=0).round(9) / (line @ line))
    assert shares == pytest.approx(np.linspace(1 / 6, 5 / 6, 7))
    away = [
        box(x - 3, y - 1.5, x + 3, y + 1.5).distance(endless)
        for x, y in zip(found.x[0][: 2 * count], found.y[0][: 2 * count], strict=True)
    ]
    assert sorted(away) == pytest.approx(sorted([*(1 + steps)] * count))
    side = line[0] * (found.y[0] - 30) - line[1] * (found.x[0] - 40)
    assert (side[: 2 * count] > 0).sum() == count


def test_a_place_costs_its_distance_its_side_and_its_shift_along_a_segment():
    """1.5 mm more square to the preferred side, twice that opposite; up to 1 mm for a quarter of a
    segment's length along it, in the square of the shift."""
    own = subject((40, 30, 60, 30))
    found = tries(own, np.array([0.0]))
    cost = distance_cost(found, np.full_like(found.x, 4.0), own)[0]
    share = np.abs(found.root_x[0] - 50) / 20 + np.abs(found.root_y[0] - 30) / 20
    assert cost == pytest.approx(4.0 - 1.0 + 1.5 * (1 - found.toward_x[0]) + 4 * share**2)


def test_beside_the_middle_of_a_segment_is_as_dear_whichever_way_it_runs():
    """By the share of its length; at its middle it costs nothing, either way the same."""
    ways, shares = np.exp(1j * np.radians([0, 30, 90, 135, 270])), np.array([0.1, 0.3, 0.5, 0.9])
    ends = np.array([[0, 0, 40 * way.real, 40 * way.imag] for way in ways])
    roots = 40 * ways[:, None] * shares
    none = np.zeros(roots.shape)
    subjects = SimpleNamespace(lean=np.zeros((5, 2)), ends=ends, gap=np.zeros(5))
    some = SimpleNamespace(root_x=roots.real, root_y=roots.imag, toward_x=none, toward_y=none)
    cost = distance_cost(some, none, subjects)
    assert cost == pytest.approx(np.tile(cost[0], (5, 1)))
    assert cost[0, 2] == pytest.approx(0)
    assert cost[0, 0] == pytest.approx(cost[0, 3]) and cost[0, 0] > cost[0, 1] > 0.01
