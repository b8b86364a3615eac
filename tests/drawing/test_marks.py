import math
import random

import pytest
import shapely

from graphkin.drawing.labels import NUMBER, Label
from graphkin.drawing.marks import (
    Arc,
    CircleMark,
    LineMark,
    Page,
    Polyline,
    Text,
    fault,
    fits,
    moved,
    polygon,
    reach,
)
from graphkin.drawing.placement import Spot
from graphkin.text.errors import PageError


def page(*marks):
    return Page(420, 297, marks, "t", "en")


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_numbers_that_are_not_finite_are_refused_by_name(bad):
    marks = [
        LineMark(1, 2, bad, 4, "link", "crank"),
        CircleMark(10, 10, bad, "pin", "crank"),
        Arc(10, 10, 5, 0, bad, "angle", "crank"),
        Polyline(((1, 1), (bad, 2)), "plate", "crank"),
        Text(bad, 10, "A", "label", name="crank"),
    ]
    for mark in marks:
        with pytest.raises(PageError, match="crank"):
            page(mark).check()


def test_every_mark_off_the_page_is_named():
    with pytest.raises(PageError) as caught:
        page(
            LineMark(0, 0, 420, 297, "link"),
            LineMark(0, 0, 420.1, 297, "link", "too far right"),
            CircleMark(2, 20, 3, "pin", "too far left"),
        ).check()
    names = [problem.place for problem in caught.value.problems]
    assert names == ["line link too far right", "circle pin too far left"]


def test_a_text_is_checked_with_its_real_extent():
    page(Text(410, 20, "AB", "label", 2.5)).check()
    with pytest.raises(PageError, match="ABCDEFGH"):
        page(Text(410, 20, "ABCDEFGH", "label", 2.5)).check()
    page(Text(410, 20, "ABCDEFGH", "label", 2.5, "end")).check()
    page(Text(410, 20, "ABCDEFGH", "label", 2.5, rotate=-90)).check()
    with pytest.raises(PageError):
        page(Text(410, 10, "ABCDEFGH", "label", 2.5, rotate=90)).check()


@pytest.mark.parametrize(
    "mark",
    [
        CircleMark(10, 10, 0, "pin"),
        Arc(10, 10, 5, 0, 360, "angle"),
        Polyline(((1, 1),), "link"),
        Text(10, 10, "A", "label", 0),
    ],
)
def test_marks_that_cannot_be_drawn_are_refused(mark):
    with pytest.raises(PageError):
        page(mark).check()


def scattered(draw):
    """One mark of each kind, as far from edges as eight decades reach, or not finite at all."""

    def some():
        return draw.choice((0, 0, 297, 420)) + draw.choice((-1, 1)) * 10 ** draw.uniform(-4, 4)

    def any_number():
        return draw.choice((math.nan, math.inf, -math.inf)) if draw.random() < 0.05 else some()

    anchor, lean = draw.choice(("start", "middle", "end")), draw.choice((0.0, 30.0))
    yield LineMark(*(any_number() for _ in range(4)), "link")
    yield CircleMark(*(any_number() for _ in range(3)), "pin")
    yield Arc(*(any_number() for _ in range(5)), "angle")
    points = tuple((any_number(), any_number()) for _ in range(draw.randint(0, 4)))
    yield Polyline(points, "link")
    place = any_number(), any_number()
    yield Text(*place, "*v*_A ⊥ OA", "label", any_number(), anchor, rotate=lean)


def test_what_fits_at_a_glance_has_no_fault():
    draw = random.Random(5)
    marks = [mark for _ in range(3000) for mark in scattered(draw)]
    seen = [mark for mark in marks if fits(mark, 420, 297)]
    assert {type(mark) for mark in seen} == {LineMark, CircleMark, Polyline, Text}
    assert [mark for mark in seen if fault(mark, 420, 297)] == []


@pytest.mark.parametrize(
    "mark",
    [
        LineMark(1, 2, 30, 4, "link", "oa", 3),
        polygon(((1, 1), (20, 2), (7, 30)), "plate", "crank"),
        CircleMark(10, 12, 5, "pin", "A"),
        Arc(50, 40, 10, 45, 135, "angle"),
        Text(30, 20, "ABC", "label", 2.5, "middle", "A", 2, rotate=30),
    ],
)
def test_a_mark_that_is_moved_reaches_as_far_from_its_new_place(mark):
    found = moved(mark, 7.5, -3.25)
    box_before, box_after = reach(mark), reach(found)
    assert box_after == pytest.approx(
        tuple(side + shift for side, shift in zip(box_before, (7.5, -3.25) * 2, strict=True))
    )
    assert (found.cls, found.name, found.step) == (mark.cls, mark.name, mark.step)
    assert moved(found, -7.5, 3.25) == mark


def test_the_reach_of_an_arc_counts_the_quarter_points_it_passes():
    assert reach(Arc(50, 50, 10, 45, 135, "angle")) == pytest.approx(
        (50 - 10 / 2**0.5, 40, 50 + 10 / 2**0.5, 50 - 10 / 2**0.5)
    )
    assert reach(Arc(50, 50, 10, 90, -90, "angle")) == pytest.approx((50, 40, 60, 60))


@pytest.mark.parametrize("name", ["1", "12", "m", "arm", "bucket", "connectingrod"])
def test_the_circle_about_a_number_is_drawn_out_for_a_name(name):
    """All stand in one look: every place of the frame is one radius from a middle line, and the
    name's ink is inside."""
    label = Label(name, "", (0.0, 0.0), ring=True)
    frame = label.balloon(Spot(20.0, 10.0, None, True))
    width, height = label.size()
    assert height == 2 * NUMBER
    if isinstance(frame, CircleMark):
        assert width == height and frame.r == NUMBER
        outline = shapely.Point(frame.cx, frame.cy).buffer(frame.r)
    else:
        half = width / 2 - NUMBER
        middle = shapely.LineString([(20 - half, 10), (20 + half, 10)])
        for place in frame.points:
            assert middle.distance(shapely.Point(place)) == pytest.approx(NUMBER, abs=1e-9)
        outline = shapely.Polygon(frame.points)
        assert outline.is_valid
    assert outline.contains(shapely.box(*label.area(Spot(20.0, 10.0, None, True))))
