"""The symbols of links and pairs stand where the pairs are, and look like the field's own.

ISO 3952-1 (kinematic diagrams) for pairs, ISO 2203 for gears; shapes as commonly drawn.
"""

from __future__ import annotations

from cmath import phase, rect
from math import cos, degrees, hypot, pi, radians

import pytest
import shapely

from graphkin.construction.guides.slide_symbols import covered
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Polyline, polygon
from graphkin.drawing.symbols import BLOCK, HINGE, PIN, SLOT
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


def test_a_slot_of_the_frame_is_hatched_on_both_outer_sides():
    drawing = made_up(
        scene_text("drawing/slot-of-the-frame"),
        {"O": 0j, "A": rect(30, radians(20)), "B": rect(30, radians(20)) + 50j},
    )
    board, _ = board_of(drawing)
    (slot,) = of_kind(board, "slot")
    strokes = [line(mark) for mark in of_kind(board, "ground")]
    assert strokes and not any(s.intersects(area(slot).buffer(-NEAR)) for s in strokes)
    assert all(s.distance(area(slot).exterior) < 1e-6 for s in strokes)
    assert drawing.standing.axis("1") is not None


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


def test_two_blocks_near_each_other_share_one_pair_of_rails():
    drawing = made_up(
        scene_text("drawing/two-blocks-on-rails"),
        {"O": 0j, "A": 10 + 0j, "B": 28 + 0j},
    )
    board, _ = board_of(drawing)
    assert len(of_kind(board, "slider")) == 2
    rails = of_kind(board, "guide")
    assert [mark.x2 - mark.x1 for mark in rails] == pytest.approx([48, -48])


def swivelling_block():
    """A crank whose bar slides through a block that turns about the frame's point C."""
    return made_up(
        scene_text("drawing/swivelling-block"),
        {"O": 0j, "C": 90 - 30j, "A": 40j, "B": 40j + 150 * (90 - 70j) / abs(90 - 70j)},
    )


def test_a_bar_slides_through_the_block_that_swivels_on_the_frame():
    board, field = board_of(swivelling_block())
    (block,) = of_kind(board, "block", "3")
    (bar,) = [mark for mark in of_kind(board, "link", "2") if line(mark).length > 10]
    assert middle(block) == pytest.approx(field(0.09 - 0.03j), abs=NEAR)
    assert line(bar).intersection(area(block)).length == pytest.approx(BLOCK[0], abs=1e-3)


def test_the_ground_that_bears_a_block_is_seen_through_it_as_far_as_the_pin():
    board, field = board_of(swivelling_block())
    (block,) = of_kind(board, "block", "3")
    at = field(0.09 - 0.03j)
    above = board.marks[board.marks.index(block) :]
    legs = [m for m in above if m.cls == "ground" and (m.x1, m.y1) == pytest.approx(at)]
    assert len(legs) == 2
    triangle = next(m for m in of_kind(board, "fixed-pivot") if m.points[0] == pytest.approx(at))
    assert board.marks.index(triangle) < board.marks.index(block)
    assert {(leg.x2, leg.y2) for leg in legs} == {*triangle.points[1:]}
    assert all(line(leg).length > line(leg).intersection(area(block)).length > 3 for leg in legs)


def test_loci_of_a_block_are_drawn_above_it_and_others_below_the_ground():
    near, far = (LineMark(x, 0, x + 9, 0, "construction", "OA", 7) for x in (100, 130))
    block = polygon(((104, -3), (115, -3), (115, 3), (104, 3)), "block", "2")
    track = LineMark(100, 0, 109, 0, "guide", "2")
    assert covered([near, far, track], [near, far, track, block]) == [near]


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


def test_a_guide_beside_its_link_is_joined_to_it_by_an_arm_and_a_filled_corner():
    drawing = made_up(
        scene_text("drawing/guide-beside-its-link"),
        {"O": 0j, "A": 60 + 0j, "B": 20 + 30j},
    )
    board, field = board_of(drawing)
    bars = [line(mark) for mark in of_kind(board, "guide-bar", "1")]
    guide = [b for b in bars if b.distance(shapely.Point(field(0.02 + 0.03j))) < NEAR]
    arms = [b for b in bars if b not in guide]
    assert len(guide) == len(arms) == 1 and len(of_kind(board, "weld", "1")) == 1
    assert guide[0].touches(arms[0]) or guide[0].intersects(arms[0])
    points = [shapely.Point(field(p)) for p in (0j, 0.06 + 0j)]
    assert min(arms[0].distance(p) for p in points) < NEAR


def test_a_block_whose_pin_is_beside_the_guide_has_an_arm_to_it():
    drawing = made_up(
        LEVER % ", offset = 12",
        {"O": 0j, "Q": -100j, "B": 100j, "A": -12 + 20j},
    )
    board, field = board_of(drawing)
    (block,) = of_kind(board, "block", "2")
    assert middle(block) == pytest.approx(field(0.02j), abs=NEAR)
    arms = [line(mark) for mark in of_kind(board, "guide-bar", "2")]
    assert any(arm.length == pytest.approx(12, abs=NEAR) for arm in arms)


# --- hinges --------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [2, 3, 4])
def test_a_multiple_hinge_has_a_circle_for_each_turning_pair(count):
    links = "".join(f"[links.{k}]\nA-B{k} = {40 + k}\n" for k in range(1, count + 1))
    points = {"A": 0j} | {f"B{k}": rect(40 + k, k) for k in range(1, count + 1)}
    drawing = made_up(f"[frame]\nO = [0, 90]\n{links}", {"O": 90j, **points})
    board, _ = board_of(drawing)
    rings = of_kind(board, "hinge", "A")
    assert len(rings) + len(of_kind(board, "pin", "A")) == count - 1
    assert sorted(ring.r for ring in rings) == pytest.approx(
        [PIN + HINGE * i for i in range(1, count - 1)]
    )


def test_a_bar_goes_on_through_a_pin_where_another_ends():
    drawing = made_up(
        scene_text("drawing/bar-through-a-pin"),
        {"O": 50j, "A": 0j, "B": 80 + 0j, "C": 40 + 0j, "D": 40 + 30j},
    )
    board, _ = board_of(drawing)
    through = [line(m) for m in of_kind(board, "link", "1") if line(m).length < 10]
    assert [t.length for t in through] == pytest.approx([2 * PIN])
    pin = next(i for i, m in enumerate(board.marks) if m.cls == "pin" and m.name == "C")
    assert any(m.cls == "link" and m.name == "1" for m in board.marks[pin:])


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


def test_the_guide_of_a_plate_is_drawn_clear_of_the_wheel_on_it():
    drawing = made_up(
        scene_text("drawing/plate-with-wheel-and-guide"),
        {"O": 0j, "B": 0j, "C": 10 + 40j},
        {"1": 1 + 0j, "2": 1 + 0j},
    )
    board, field = board_of(drawing)
    round_ = shapely.Point(field(0.01 + 0.04j)).buffer(40)
    (block,) = of_kind(board, "slider")
    (plate,) = of_kind(board, "guide-bar", "2")
    assert area(block).distance(round_) > 1 and line(plate).intersects(area(block))
    rails = [line(m) for m in of_kind(board, "guide") if line(m).length > 12]
    assert rails and not any(rail.intersects(round_) for rail in rails)


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


def test_a_wheel_with_points_on_it_has_spokes_and_neither_bar_nor_plate():
    points = {"T": 0j, "C": 25j, "P": 25 + 25j, "Q": 50j, "R": -25 + 25j}
    drawing = made_up(
        scene_text("drawing/wheel-with-points"),
        points,
    )
    board, _ = board_of(drawing)
    assert len(of_kind(board, "spoke", "1")) == 3
    assert not of_kind(board, "plate") and not of_kind(board, "link", "1")


def test_the_extent_of_a_drawing_holds_its_wheels():
    drawing = made_up(PAIR % 30, {"O": 0j, "P": 100 + 0j})
    box = drawing.mechanism_extent()
    assert (box.left, box.right) == pytest.approx((-0.044, 0.164))
    assert (box.bottom, box.top) == pytest.approx((-0.064, 0.064))


def test_every_disc_stands_for_its_wheel_at_scale():
    drawing = made_up((PAIR % 30).replace("module = 4", "module = 2"), {"O": 0j, "P": 50 + 0j})
    assert [disc.radius for disc in drawing.standing.discs] == pytest.approx([0.03, 0.02])
    assert all(isinstance(mark, CircleMark) for mark in of_kind(board_of(drawing)[0], "pitch"))


# --- drivers -------------------------------------------------------------------------------------


def test_two_drivers_at_one_pin_have_arcs_of_different_size_and_their_own_names():
    drawing = made_up(
        scene_text("drawing/two-drivers-at-one-pin"),
        {"O": 0j, "P": rect(50, radians(40))},
        {"sun": rect(1, radians(100))},
    )
    board, _ = board_of(drawing, drivers=True)
    arcs = of_kind(board, "angle")
    assert [arc.end - arc.start for arc in arcs] == pytest.approx([40, 100])
    assert arcs[0].r < arcs[1].r and arcs[0].name != arcs[1].name
    senses = [arc for arc in of_kind(board, "sense") if hasattr(arc, "start")]
    assert [arc.end > arc.start for arc in senses] == [True, False]


def test_a_relative_angle_is_drawn_from_the_axis_of_the_link_it_is_relative_to():
    drawing = made_up(
        scene_text("drawing/relative-angle"),
        {
            "O": 0j,
            "A": rect(50, radians(50)),
            "B": rect(50, radians(50)) + rect(40, radians(-30)),
        },
    )
    board, _ = board_of(drawing, drivers=True)
    arc = of_kind(board, "angle")[1]
    assert (arc.start, arc.end) == pytest.approx((50, -30))
    said = [label.markup for label in board.labels]
    assert "*φ*_{2/1} = −80°" in said and "*ω*_{2/1}" in said


def test_a_driven_slide_is_dimensioned_from_the_zero_of_its_guide():
    drawing = made_up(
        scene_text("drawing/driven-slide"),
        {"O": 0j, "A": rect(70, radians(25))},
    )
    board, field = board_of(drawing, drivers=True)
    lines = [line(mark) for mark in of_kind(board, "drive")]
    assert any(each.length == pytest.approx(70, abs=NEAR) for each in lines)
    (arrow,) = [mark for mark in of_kind(board, "sense") if isinstance(mark, LineMark)]
    u, v = field.way(rect(1, radians(25)))
    assert (arrow.x2 - arrow.x1) * u + (arrow.y2 - arrow.y1) * v < 0


# --- labels --------------------------------------------------------------------------------------


def test_letters_and_numbers_keep_clear_of_all_symbols():
    drawing = lever()[0]
    board, _ = board_of(drawing, drivers=True)
    marks = board.finish()
    assert {mark.markup for mark in marks if hasattr(mark, "markup")} >= {"1", "2", "3"}
    drawing = made_up(PAIR % 30, {"O": 0j, "P": 100 + 0j}, {"1": 1 + 0j, "2": 1j})
    marks = board_of(drawing)[0].finish()
    assert {mark.markup for mark in marks if hasattr(mark, "markup")} >= {"1", "2", "*O*", "*P*"}
