"""A label that is nearer to something else of its kind than to what it names gets a leader."""

from __future__ import annotations

from math import dist

import pytest
from shapely import Point, box

from graphkin.drawing.labels import Label, with_leaders
from graphkin.drawing.marks import LineMark
from graphkin.drawing.placement import Spot


def at(x: float, y: float) -> Spot:
    """A place without a leader."""
    return Spot(x, y, None, True)


def letters(own: tuple[float, float], other: tuple[float, float], spot: Spot) -> Spot:
    """What becomes of the place of a letter beside another letter's point."""
    labels = [
        Label("*a*", "velocity", own, radius=0.7),
        Label("*b*", "velocity", other, radius=0.7),
    ]
    return with_leaders(labels, [spot, at(*other)], ())[0]


def test_a_letter_that_is_nearer_to_another_letters_point_gets_a_leader_to_its_own_circle():
    found = letters((10.0, 10.0), (10.0, 14.0), at(6.0, 17.0))
    assert found.leader is not None
    start, end = found.leader
    assert dist(end, (10.0, 10.0)) == pytest.approx(0.7)
    width, height = Label("*a*", "velocity", (0.0, 0.0)).size()
    ink = box(6 - width / 2, 17 - height / 2, 6 + width / 2, 17 + height / 2)
    assert 0 < ink.distance(Point(start)) < 0.5


def test_a_letter_that_is_nearest_to_its_own_point_has_none():
    assert letters((10.0, 10.0), (10.0, 14.0), at(7.0, 8.0)).leader is None


@pytest.mark.parametrize(
    ("cls", "kind"), [("construction", "construction"), ("velocity", "velocity")]
)
def test_a_name_that_is_nearer_to_another_line_of_its_kind_gets_a_leader(cls, kind):
    """Directions are held against lines of the construction, names of vectors against vectors."""
    lines = [LineMark(10, 10, 30, 10, kind, "one"), LineMark(10, 14, 30, 14, kind, "other")]
    label = Label("⊥ *AB*", cls, ((10.0, 10.0), (30.0, 10.0)), name="one")
    near, far = at(20.0, 8.0), at(20.0, 16.5)
    assert with_leaders([label], [near], lines)[0].leader is None
    found = with_leaders([label], [far], lines)[0].leader
    assert found is not None
    assert found[1] == pytest.approx((20.0, 10.0))


def test_a_direction_is_not_held_against_vectors():
    lines = [
        LineMark(10, 10, 30, 10, "construction", "one"),
        LineMark(10, 14, 30, 14, "velocity", "v"),
    ]
    label = Label("⊥ *AB*", "construction", ((10.0, 10.0), (30.0, 10.0)), name="one")
    assert with_leaders([label], [at(20.0, 16.5)], lines)[0].leader is None


def test_a_line_in_two_parts_is_as_near_as_the_nearer_of_them():
    """A line of the construction is drawn at both ends of the vector that lies on it."""
    lines = [
        LineMark(10, 10, 14, 10, "construction", "one"),
        LineMark(40, 10, 44, 10, "construction", "one"),
    ]
    lines.append(LineMark(10, 6, 44, 6, "construction", "other"))
    label = Label("⊥ *AB*", "construction", ((40.0, 10.0), (44.0, 10.0)), name="one")
    assert with_leaders([label], [at(12.0, 12.5)], lines)[0].leader is None
