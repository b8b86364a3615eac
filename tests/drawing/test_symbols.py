"""The symbols of links and pairs stand where the pairs are, and look like the field's own.

ISO 3952-1 (kinematic diagrams) for pairs, ISO 2203 for gears; shapes as commonly drawn.
"""

from __future__ import annotations

from cmath import phase, rect
from math import cos, degrees, hypot, pi, radians

import pytest
import shapely

from graphkin.drawing.marks import LineMark, Mark, Polyline
from graphkin.drawing.symbols import (
    BLOCK,
    PIN,
    SLOT,
    bearing,
    hatched,
    pivot_ground,
    sense_head,
    square_mark,
    turned_arrow,
    weld,
)
from tests.documents.made_up import board_of, made_up, of_kind
from tests.scene_files import scene_text

NEAR = 1e-6
GAP = 0.2
"""Least gap between the teeth of two wheels, in modules: their lines do not run together."""

LEVER = """
[frame]
O = [0, 0]
Q = [0, -100]
[links.1]
O-A = 40
[links.2]
A = [0, 0]
slides = { on = 3, along = "Q-B"%s }
[links.3]
Q-B = 200
[[drivers]]
turn = 1
angle = 30
speed = 2
"""


def lever(more: str = "") -> tuple:
    """A crank with a block, or a pin, on a lever."""
    tip = rect(40, radians(30))
    way = (tip + 100j) / abs(tip + 100j)
    points = {"O": 0j, "Q": -100j, "A": tip, "B": -100j + 200 * way}
    return made_up(LEVER % more, points), way, tip / 1000


def middle(mark: Mark) -> tuple[float, float]:
    """The middle of the corners of a polygon."""
    assert isinstance(mark, Polyline)
    xs, ys = zip(*mark.points, strict=True)
    return sum(xs) / len(xs), sum(ys) / len(ys)


def area(mark: Mark) -> shapely.Polygon:
    """What a polygon covers."""
    assert isinstance(mark, Polyline) and mark.closed
    return shapely.Polygon(mark.points)


def line(mark: Mark) -> shapely.LineString:
    """A line as geometry."""
    assert isinstance(mark, LineMark)
    return shapely.LineString([(mark.x1, mark.y1), (mark.x2, mark.y2)])


# --- blocks and slots ----------------------------------------------------------------------------


def test_a_block_on_a_lever_is_turned_along_it_and_stands_on_its_pin():
    drawing, way, tip = lever()
    board, field = board_of(drawing)
    (block,) = of_kind(board, "block", "2")
    assert middle(block) == pytest.approx(field(tip), abs=NEAR)
    first, second = block.points[:2]
    along = (second[0] - first[0]) / BLOCK[0], (second[1] - first[1]) / BLOCK[0]
    assert along == pytest.approx(field.way(way), abs=NEAR)
    (bar,) = of_kind(board, "guide-bar", "3")
    assert line(bar).distance(shapely.Point(field(tip))) < NEAR


def test_a_pin_in_a_slot_has_two_parallel_sides_with_round_ends_and_no_block():
    drawing, way, tip = lever(", pin = true")
    board, field = board_of(drawing)
    assert not of_kind(board, "block") and not of_kind(board, "slider")
    (slot,) = of_kind(board, "slot")
    pin = shapely.Point(field(tip))
    assert area(slot).contains(pin.buffer(PIN))
    u, v = field.way(way)
    x, y = field(tip)
    across = [abs((px - x) * -v + (py - y) * u) for px, py in slot.points]
    assert max(across) == pytest.approx(SLOT, abs=NEAR)
    assert area(slot).exterior.distance(pin) == pytest.approx(SLOT, abs=NEAR)
    along = [(px - x) * u + (py - y) * v for px, py in slot.points]
    straight = area(slot).area - pi * SLOT**2
    assert area(slot).is_valid and straight > 0
    assert (max(along) - min(along) - 2 * SLOT) * 2 * SLOT == pytest.approx(straight, rel=0.02)


def test_a_slot_ends_before_the_pins_of_its_lever():
    drawing = made_up(
        LEVER % ", pin = true",
        {"O": 0j, "Q": -100j, "A": -94j, "B": 100j},
    )
    board, field = board_of(drawing)
    (slot,) = of_kind(board, "slot")
    pivot = shapely.Point(field(-0.1j))
    assert area(slot).distance(pivot) >= PIN
    assert area(slot).contains(shapely.Point(field(-0.094j)))


@pytest.mark.parametrize("angle", [0, 35, 90, 200])
def test_a_guide_of_the_frame_is_hatched_only_away_from_its_block(angle):
    here = rect(30, radians(angle))
    drawing = made_up(
        f"""
[frame]
O = [0, 0]
[links.1]
A = [0, 0]
slides = {{ on = 0, through = "O", angle = {angle} }}
""",
        {"O": 0j, "A": here},
    )
    board, field = board_of(drawing)
    (block,) = of_kind(board, "slider", "1")
    x, y = field(here / 1000)
    u, v = field.way(rect(1, radians(angle)))
    for mark in of_kind(board, "ground"):
        ends = [((mark.x1 - x) * -v + (mark.y1 - y) * u) for _ in (0,)]
        ends.append((mark.x2 - x) * -v + (mark.y2 - y) * u)
        assert abs(ends[0]) == pytest.approx(BLOCK[1] / 2, abs=NEAR)
        assert abs(ends[1]) > abs(ends[0]) and ends[0] * ends[1] > 0
    assert area(block).contains(shapely.Point(x, y))


def test_a_cylinder_holds_the_rod_that_slides_in_it():
    drawing = made_up(
        scene_text("drawing/cylinder"),
        {"A": 0j, "B": 60 + 25j},
    )
    board, field = board_of(drawing, drivers=False)
    standing = drawing.standing
    assert standing.guideways == ()  # nothing tells how the rod lies
    drawing = made_up(
        scene_text("drawing/cylinder-2"),
        {"A": 0j, "B": 60 + 25j},
        {"1": (60 + 25j) / 65},
    )
    board, field = board_of(drawing, drivers=True)
    (block,) = of_kind(board, "block", "1")
    assert middle(block) == pytest.approx(field(0j), abs=NEAR)
    (rod,) = of_kind(board, "guide-bar", "2")
    assert line(rod).distance(shapely.Point(field(0.06 + 0.025j))) < NEAR
    lengths = [line(mark).length for mark in of_kind(board, "drive")]
    assert any(length == pytest.approx(65, abs=NEAR) for length in lengths)


# --- hinges --------------------------------------------------------------------------------------


# --- wheels --------------------------------------------------------------------------------------

PAIR = """
module = 4
[frame]
O = [0, 0]
P = [100, 0]
[links.1]
O = [0, 0]
wheel = { centre = "O", teeth = 20 }
[links.2]
P = [0, 0]
wheel = { centre = "P", teeth = %d }
rolls = { on = 1 }
"""


def gears(board, *names: str) -> list[shapely.Polygon]:
    """The outlines of gears."""
    return [area(of_kind(board, kind, n)[0]) for kind in ("gear-disc",) for n in names]


@pytest.mark.parametrize("place", [100 + 0j, rect(100, 2.0)])
def test_gears_mesh_at_the_pitch_point_tooth_in_gap(place):
    text = (PAIR % 30).replace("P = [100, 0]", f"P = [{place.real}, {place.imag}]")
    drawing = made_up(text, {"O": 0j, "P": place}, {"1": 1 + 0j, "2": 1j})
    board, field = board_of(drawing)
    one, other = gears(board, "1", "2")
    assert one.is_valid and other.is_valid
    assert one.exterior.distance(other.exterior) > GAP * 4
    assert one.intersection(other).area == 0
    (contact,) = of_kind(board, "contact")
    at = field(0.4 * place / 1000)
    assert (contact.cx, contact.cy) == pytest.approx(at, abs=NEAR)
    assert sorted(c.r for c in of_kind(board, "pitch")) == pytest.approx([40, 60])
    x, y = field(0j)
    radii = [hypot(px - x, py - y) for px, py in one.exterior.coords]
    assert max(radii) == pytest.approx(44) and min(radii) == pytest.approx(35)


@pytest.mark.parametrize("teeth", [16, 20, 40])
def test_a_planet_meshes_with_its_ring_from_inside(teeth):
    arm = 120 - 2 * teeth
    drawing = made_up(
        f"""
module = 4
[frame]
O = [0, 0]
wheel = {{ centre = "O", teeth = 60, inside = true }}
[links.arm]
O-P = {arm}
[links.planet]
P = [0, 0]
wheel = {{ centre = "P", teeth = {teeth} }}
rolls = {{ on = 0 }}
""",
        {"O": 0j, "P": rect(arm, 1.0)},
        {"planet": 1j},
    )
    board, field = board_of(drawing)
    (hole,) = (area(mark) for mark in of_kind(board, "gear") if isinstance(mark, Polyline))
    (planet,) = gears(board, "planet")
    assert planet.exterior.distance(hole.exterior) > GAP * 4
    assert planet.difference(hole).area == 0
    (contact,) = of_kind(board, "contact")
    assert (contact.cx, contact.cy) == pytest.approx(field(rect(0.12, 1.0)), abs=NEAR)
    assert len(of_kind(board, "ground")) > 40
    (spoke,) = of_kind(board, "spoke", "planet")
    turned = degrees(phase(complex(spoke.x2 - spoke.x1, spoke.y1 - spoke.y2)))
    assert turned == pytest.approx(90)


def test_a_rack_takes_the_teeth_of_its_pinion():
    drawing = made_up(
        scene_text("drawing/rack"),
        {"O": 0j, "B": 70 - 40j},
        {"1": 1 + 0j, "2": 1 + 0j},
    )
    board, field = board_of(drawing)
    pinion, rack = gears(board, "1", "2")
    assert pinion.is_valid and rack.is_valid
    assert pinion.exterior.distance(rack.exterior) > GAP * 4
    assert pinion.intersection(rack).area == 0
    assert not any(line(bar).crosses(rack) for bar in of_kind(board, "guide-bar", "2"))
    below = field(-0.04j)[1]
    assert min(y for _, y in rack.exterior.coords) == pytest.approx(below - 4)


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("angle", [0, 30, 130])
def test_a_wheel_touches_its_track_whose_ground_lies_beyond(side, angle):
    way = rect(1, radians(angle))
    square = 1j * way * (1 if side == "left" else -1)
    drawing = made_up(
        f"""
[frame]
T = [0, 0]
[links.1]
C-P = 10
wheel = {{ centre = "C", radius = 25 }}
rolls = {{ on = 0, through = "T", angle = {angle}, side = "{side}" }}
""",
        {"T": 0j, "C": 20 * way + 25 * square, "P": 20 * way + 25 * square + 10},
    )
    board, field = board_of(drawing)
    (contact,) = of_kind(board, "contact")
    assert (contact.cx, contact.cy) == pytest.approx(field(0.02 * way), abs=NEAR)
    (disc,) = of_kind(board, "disc")
    assert disc.r == pytest.approx(25)
    (track,) = of_kind(board, "guide")
    assert line(track).distance(shapely.Point(contact.cx, contact.cy)) < NEAR
    round_ = shapely.Point(disc.cx, disc.cy).buffer(25 - 0.01)
    assert not any(line(mark).intersects(round_) for mark in of_kind(board, "ground"))
    centre = shapely.Point(disc.cx, disc.cy)
    for mark in of_kind(board, "ground"):
        far = shapely.Point(mark.x2, mark.y2)
        assert centre.distance(far) * cos(0) > 25


# --- drivers -------------------------------------------------------------------------------------


def test_a_relative_angle_is_drawn_from_the_axis_of_the_link_it_is_relative_to():
    drawing = made_up(
        scene_text("drawing/relative-angle"),
        {
            "O": 0j,
            "A": rect(50, radians(50)),
            "B": rect(50, radians(50)) + rect(40, radians(-30)),
        },
        {"1": rect(1, radians(50))},
    )
    board, _ = board_of(drawing, drivers=True)
    arc = of_kind(board, "angle")[1]
    assert (arc.start, arc.end) == pytest.approx((50, -30))
    said = [label.markup for label in board.labels]
    assert "*φ*_{2/1} = −80°" in said and "*ω*_{2/1}" in said


# --- labels --------------------------------------------------------------------------------------


def test_rounding_takes_no_stroke_from_a_whole_number_of_them():
    """A page that moves counts the strokes of its own numbers, and must find as many as paper."""
    for k in range(90):
        start, way = complex(*divmod(k * k, 17)) / 7, rect(1, k)
        end = start + 10 * 2.2 * way
        assert len([*hatched((start.real, start.imag), (end.real, end.imag))]) == 1 + 10


@pytest.mark.parametrize("angle", [0, 50, 200])
@pytest.mark.parametrize(("length", "strokes"), [(2.1, 0), (2.3, 1), (10.9, 4), (11.1, 5)])
def test_a_line_of_the_frame_is_hatched_every_2_2_mm_on_its_right_hand_side(angle, length, strokes):
    """Strokes of 2 mm both back and away; y runs down the page."""
    way = rect(1, radians(angle))
    ground, *found = hatched((5.0, 7.0), (5.0 + length * way.real, 7.0 + length * way.imag))
    assert (ground.cls, len(found)) == ("guide", strokes)
    for k, stroke in enumerate(found):
        foot, end = ((complex(x, y) - (5 + 7j)) / way for x, y in line(stroke).coords)
        assert foot == pytest.approx(2.2 * (k + 0.8))
        assert end - foot == pytest.approx(-2 + 2j)


@pytest.mark.parametrize("angle", [90, 10, 260])
def test_a_pivot_stands_on_hatched_ground_square_to_its_way(angle):
    """5.6 mm from its pin, 6.4 mm wide, the ground 2 mm wider on each side and beyond it."""
    way = rect(1, radians(angle))
    triangle, ground, *strokes = pivot_ground((3.0, 4.0), (way.real, way.imag))
    corners = {
        complex(round(z.real, 9), round(z.imag, 9))
        for z in ((complex(*p) - (3 + 4j)) / way for p in triangle.points)
    }
    assert corners == {0j, 5.6 + 3.2j, 5.6 - 3.2j}
    ends = [(complex(*p) - (3 + 4j)) / way for p in line(ground).coords]
    assert sorted(z.imag for z in ends) == pytest.approx([-5.2, 5.2])
    assert [z.real for z in ends] == pytest.approx([5.6, 5.6])
    assert len(strokes) == 4
    for stroke in strokes:
        assert max(
            (complex(*p) - (3 + 4j)).real * way.real + (complex(*p) - (3 + 4j)).imag * way.imag
            for p in line(stroke).coords
        ) == pytest.approx(7.6)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("angle", [0, 75, 190])
def test_the_head_of_a_turning_arrow_lies_along_its_chord(side, angle):
    """Its tip on the arc; its back at the place of the arc 2.2 mm before, 0.9 mm wide."""
    centre, radius = 20 + 30j, 8.0
    way = rect(1, radians(-angle))
    mark = sense_head((20.0, 30.0), radius, (way.real, way.imag), side, "omega")
    tip, *back = [complex(*p) - centre for p in mark.points]
    assert tip == pytest.approx(radius * way)
    middle = sum(back) / 2
    assert abs(middle) == pytest.approx(radius)
    assert phase(middle / tip) == pytest.approx(-side * 2.2 / radius)
    assert abs(back[0] - back[1]) == pytest.approx(0.9)
    assert ((back[0] - back[1]) * (tip - middle).conjugate()).real == pytest.approx(0)
    arc, again = turned_arrow(
        (20.0, 30.0), radius, (way.real, way.imag), (angle, 70.0 * side), "omega"
    )
    assert again == mark
    assert (arc.start, arc.end) == (angle + 70.0 * side, angle)
    assert bearing((way.real, way.imag)) % 360 == pytest.approx(angle % 360)


@pytest.mark.parametrize("angle", [0, 33, 140])
def test_a_right_angle_is_marked_by_a_square_of_2_mm_and_a_weld_by_its_corner(angle):
    first, second = rect(1, radians(angle)), rect(1, radians(angle + 90))
    ways = [(way.real, way.imag) for way in (first, second)]
    points = [complex(*p) - (9 + 8j) for p in square_mark((9.0, 8.0), *ways, 3).points]
    assert points == pytest.approx([2 * first, 2 * first + 2 * second, 2 * second])
    corners = [complex(*p) - (9 + 8j) for p in weld((9.0, 8.0), *ways, "w").points]
    assert corners == pytest.approx([0, 2.4 * first, 2.4 * second])
