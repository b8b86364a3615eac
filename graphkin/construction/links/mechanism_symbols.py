"""The mechanism to scale with the field's symbols: bars, plates, pins, pivots and cams.

The numbers of links are inside their plates, or next to their bars.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise, product
from typing import TYPE_CHECKING, NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.paper_canvas import draw_line
from graphkin.construction.guides.slide_symbols import (
    RAIL,
    Segment,
    away_from,
    between_rails,
    draw_blocks,
    draw_frame_guides,
    draw_guide_bars,
    ground_ways,
    grounds_of,
    is_covered,
    number_side,
)
from graphkin.construction.links.link_shapes import (
    corners_of,
    farthest,
    is_all_wheel,
    places_of,
    rails_of,
)
from graphkin.construction.links.wheel_symbols import (
    draw_edges,
    draw_fixed_wheels,
    draw_touches,
    draw_track_line,
    draw_tracks,
    draw_wheels,
    number_beside,
    part_of_rim,
)
from graphkin.drawing.clearance import pieces_of
from graphkin.drawing.field import XY, Field, Rect
from graphkin.drawing.labels import GAP, NUMBER, FieldContent, Label
from graphkin.drawing.marks import CircleMark, LineMark, Polyline, Shown, polygon, reach
from graphkin.drawing.placement import Spot
from graphkin.drawing.richtext import extent
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.drawing.symbols import FIXED, FREE, HINGE, PIN, TALL, across, legs, pin, pivot_ground
from graphkin.numbers.arithmetic import smaller
from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME, Link

if TYPE_CHECKING:
    from graphkin.construction.core.cam_profiles import CamProfile


LONG = 14.0
"""Length of a sliding link's own bar, in mm, from which its number is placed there."""
EDGE = 0.8
"""Distance of a plate's number from the plate's sides, in mm."""
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
"""Positions of a number along a bar, in order of preference."""
ENOUGH = 6.0
"""Distance of a number's middle from other links, in mm, beyond which more does not count."""
HALF = 4.0
"""Half the part of a bar to which its number belongs, in mm, at most."""
SHIFT = 8.0
"""Cost of a place at the end of a bar instead of its middle, in mm of clearance."""
PARTS = 8
"""Number of parts into which the sides of a plate are divided in the search for room."""


class Body(NamedTuple):
    """A bar or a plate on the page: sides, the corners of a plate in order around it, its box."""

    sides: list[Segment]
    corners: list[complex]
    box: Rect

    def near(self, start: complex, end: complex, far: float) -> bool:
        """Whether its box is within a distance of the box of a line."""
        left, top, right, low = self.box
        return (
            min(start.real, end.real) - far <= right
            and max(start.real, end.real) + far >= left
            and min(start.imag, end.imag) - far <= low
            and max(start.imag, end.imag) + far >= top
        )

    def apart(self, place: complex) -> float:
        """The distance of a place from it; zero inside a plate."""
        return 0.0 if self.holds(place) else min(away_from(place, side) for side in self.sides)

    def holds(self, place: complex) -> bool:
        """Whether a place is inside a plate."""
        if not self.corners:
            return False
        turns = [cross(q - p, place - p) > 0 for p, q in self.sides]
        return all(turns) or not any(turns)


def draw_numbers(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the number or name of each link in its balloon."""
    bodies = {name: body_of(drawing, field, link) for name, link in drawing.scene.links.items()}
    for name, link in drawing.scene.bare.links.items():
        others = [body for other, body in bodies.items() if body and other != name]
        wished = wish(board, drawing, field, link, bodies[name], others)
        if wished is not None:
            board.labels.append(wished)
    for disc in {each.sign: each for each in drawing.standing.discs}.values():
        link = drawing.scene.link(disc.link)
        if disc.sign != link.name or (disc.link == FRAME and len(link.wheels) > 1):
            board.labels.append(labelled(link, part_of_rim(drawing, field, disc), sign=disc.sign))


def wish(
    board: FieldContent,
    drawing: Drawing,
    field: Field,
    link: Link,
    body: Body | None,
    others: Sequence[Body],
) -> Label | None:
    """The preferred place of a link's number: at its plate, its bar, its block or its wheel."""
    aside = number_side(drawing, field, link.name)
    if body is not None and body.corners:
        (start, end), *_ = body.sides
        first = (start.real, start.imag), (end.real, end.imag)
        return label_inside(link, body, others) or labelled(link, first)
    short = body is None or abs(body.sides[0][1] - body.sides[0][0]) < LONG
    if aside and (short or any(slide.on == FRAME for slide in link.slides)):
        return labelled(link, aside)
    if body is not None:
        return label_beside(link, *body.sides[0], others)
    beside = number_beside(drawing, field, link) or guide_bar_of(board, link)
    return labelled(link, beside) if beside else None


def labelled(
    link: Link, subject: XY | tuple[XY, XY], away: XY | None = None, sign: str = ""
) -> Label:
    """The label of a link, with its number or the sign of one of its wheels, at a subject."""
    said = escape(sign or link.name)
    return Label(said, "", subject, 2.5, link.name, away=away, priority=3, ring=True)


def body_of(drawing: Drawing, field: Field, link: Link) -> Body | None:
    """The bar or the plate of a link on the page; None where it has neither."""
    corners = [complex(*field(corner)) for corner in corners_of(drawing, link) or ()]
    if corners:
        return Body([*pairwise([*corners, corners[0]])], corners, around(corners))
    places = places_of(drawing, link.name)
    if len(places) < 2:
        return None
    first, last = (complex(*field(place)) for place in farthest(places))
    return Body([(first, last)], [], around((first, last))) if first != last else None


def around(places: Sequence[complex]) -> Rect:
    """The upright box around places."""
    xs, ys = [place.real for place in places], [place.imag for place in places]
    return min(xs), min(ys), max(xs), max(ys)


def label_inside(link: Link, body: Body, others: Sequence[Body]) -> Label | None:
    """A label inside its plate, where it is farthest from the sides and from other links.

    None where there is no room.
    """
    wide = max(NUMBER, (extent(escape(link.name), 2.5)[0] + NUMBER) / 2)
    sides = [*body.sides, *(side for other in others for side in other.sides)]

    def room(place: complex) -> float:
        return min(away_from(place, side) for side in sides)

    place = max(within(body.corners), key=room)
    if min(away_from(place, side) for side in body.sides) < wide + EDGE:
        return None
    return labelled(link, (place.real - wide - GAP, place.imag), (1.0, 0.0))


def within(corners: Sequence[complex]) -> Iterator[complex]:
    """Places spread over a plate, all of them inside."""
    first = corners[0]
    for second, third in pairwise(corners[1:]):
        for i, j in combinations(range(1, PARTS), 2):
            yield (i * first + (j - i) * second + (PARTS - j) * third) / PARTS


def label_beside(link: Link, start: complex, end: complex, others: Sequence[Body]) -> Label:
    """A label next to its bar, on the side and at the place farthest from other links."""
    length = abs(end - start)
    way = (end - start) / length
    off = (NUMBER + GAP) * 1j * way
    beside = [other for other in others if other.near(start, end, ENOUGH + abs(off))]
    found: list[tuple[float, float, int]] = []
    for share, side in product(SHARES, (1, -1)):
        place = start + share * (end - start) + side * off
        room = min((other.apart(place) for other in beside), default=ENOUGH)
        found.append((min(room, ENOUGH) - SHIFT * (share - 0.5) ** 2, share, side))
        if room >= ENOUGH:
            break
    _, share, side = max(found, key=lambda each: each[0])
    middle, half = start + share * (end - start), min(HALF, 0.2 * length) * way
    low, high, away = middle - half, middle + half, side * off / abs(off)
    return labelled(link, ((low.real, low.imag), (high.real, high.imag)), (away.real, away.imag))


def guide_bar_of(board: FieldContent, link: Link) -> tuple[XY, XY] | None:
    """The drawn guide of a link that has neither a bar, a block nor a wheel."""
    for mark in board.marks:
        if isinstance(mark, LineMark) and mark.cls == "guide-bar" and mark.name == link.name:
            return (mark.x1, mark.y1), (mark.x2, mark.y2)
    return None


def settle_in_plates(board: FieldContent) -> None:
    """Place the numbers of plates inside them, clear of all marks.

    They are placed before other labels. A number without such a place is left to be placed with the
    others.
    """
    from shapely import MultiLineString, Point, Polygon, box, buffer, get_parts, union_all
    from shapely.ops import nearest_points

    plates = {m.name: m for m in board.marks if isinstance(m, Polyline) and m.cls == "plate"}
    lines = [((a, b), (c, d)) for a, b, c, d in pieces_of(board.marks).tolist()]
    waiting = list[Label]()
    for label in board.labels:
        x, y = label.subject
        if not label.ring or label.name not in plates or isinstance(x, tuple):
            waiting.append(label)
            continue
        wide = label.size()[0] / 2
        body = Polygon(plates[label.name].points).buffer(-wide - EDGE)
        near = MultiLineString(lines).intersection(body.buffer(wide + EDGE))
        taken = [*get_parts(near), *(box(*rect) for rect in board.taken)]
        free = body - union_all(buffer(taken, wide + EDGE))  # one union: 20 times as fast
        if free.is_empty:
            waiting.append(label)
            continue
        assert isinstance(y, float)
        place = nearest_points(free, Point(x + wide + GAP, y))[0]
        board.marks += label.marks(Spot(place.x, place.y, None, True))
        board.taken.append(place.buffer(wide).bounds)  # keeps leaders off its ring
    board.labels = waiting


def draw_frame(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the parts of the mechanism on the task sheet: pivots, fixed wheels, lines of guides."""
    for link in drawing.scene.links.values():
        draw_guide_line(board, drawing, field, link)
        draw_track_line(board, drawing, field, link)
    draw_fixed_wheels(board, drawing, field)
    draw_ground(board, drawing, field)
    pinned = moving_points(drawing)
    for name in drawing.scene.fixed_points:
        radius = FIXED if name in pinned else FREE
        board.marks.append(pin(field(drawing.positions[name]), name, radius))
        letter(board, drawing, field, name)


def draw_ground(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the grounds of the fixed pivots, without their pins."""
    for name, (way, height) in grounds_of(drawing, field.mm).items():
        ground = [*pivot_ground(field(drawing.positions[name]), field.way(way), height)]
        board.marks += ground
        boxes = [*zip(*(reach(mark) for mark in ground if mark.cls != "fixed-pivot"), strict=True)]
        board.taken.append((min(boxes[0]), min(boxes[1]), max(boxes[2]), max(boxes[3])))


def letter(board: FieldContent, drawing: Drawing, field: Field, name: str) -> None:
    """Label a point with its letter, clear of a fixed point's ground or away from its bars.

    The letter of a slider's pin is outside the hatching of its guide.
    """
    at = field(drawing.positions[name])
    if name in drawing.scene.fixed_points:
        ground = ground_ways(drawing, field.mm).get(name, -1j)
        away: XY | None = field.way(ground * (-0.6 - 0.8j))
    else:
        away = outward(drawing, field, name)
    radius = PIN + HINGE * max(0, sharers(drawing, name) - 2)
    if between_rails(drawing, name):
        radius = RAIL
    board.labels.append(
        Label(symbol(name), "", at, 3.5, name, away=away, priority=2, radius=radius)
    )


def moving_points(drawing: Drawing) -> set[str]:
    return {point for link in drawing.scene.links.values() for point in link.points}


def sharers(drawing: Drawing, point: str) -> int:
    """The number of links that share a point, with the frame, without hollows about the point."""
    scene = drawing.scene
    return sum(
        point in link.points and not link.is_hollow_about(point)
        for link in (scene.frame, *scene.links.values())
    )


def draw_guide_line(board: FieldContent, drawing: Drawing, field: Field, block: Link) -> None:
    """Draw the line of a fixed guide across the field, chain-dotted."""
    for slide in block.slides:
        line = drawing.guide(slide)
        if line is not None:
            draw_line(board, field, line, f"guide {block.name}", Shown("guide", block.name))


def draw_links(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the links with their plates, bars, guides, blocks, wheels, profiles and pins."""
    draw_plates(board, drawing, field)
    draw_slides(board, drawing, field)
    draw_shapes(board, drawing, field)
    draw_pins(board, drawing, field)


def draw_plates(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw wheels and plates, below everything else; a plate is below the wheels that it bears."""
    plates = [x for x in drawing.scene.links.values() if corners_of(drawing, x) is not None]
    arms = [link for link in plates if bears_wheels(drawing, link)]
    for link in arms:
        draw_body(board, drawing, field, link)
    draw_wheels(board, drawing, field)
    for link in plates:
        if link not in arms:
            draw_body(board, drawing, field, link)


def bears_wheels(drawing: Drawing, link: Link) -> bool:
    """Whether a link has a wheel, or carries the centres of wheels of at least two others."""
    wheels = {disc.link for disc in drawing.standing.discs if disc.wheel.centre in link.points}
    return link.name in wheels or len(wheels) > 1


def draw_bars(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw guides with their blocks, and the parts above them."""
    draw_guides(board, drawing, field)
    draw_upper(board, drawing, field)


def draw_guides(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw guides and the bars on which blocks slide, then blocks and the grounds under them."""
    for link in drawing.scene.links.values():
        draw_guide_line(board, drawing, field, link)
    draw_slides(board, drawing, field)
    for name, way in ground_ways(drawing, field.mm).items():
        here = drawing.positions[name]
        if is_covered(drawing, here, field.mm):
            board.marks += legs(field(here), field.way(way), TALL)


def draw_slides(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw tracks, guides and the bars on which blocks slide, then the blocks."""
    draw_tracks(board, drawing, field)
    draw_frame_guides(board, drawing, field)
    draw_bodies(board, drawing, field, carriers=True)
    draw_guide_bars(board, drawing, field)
    draw_blocks(board, drawing, field)


def draw_upper(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the parts above blocks, and the links' numbers."""
    draw_shapes(board, drawing, field)
    draw_numbers(board, drawing, field)


def draw_shapes(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the other bars, the sides of plates, profiles, and the angles of wheels."""
    draw_bodies(board, drawing, field, carriers=False)
    draw_outlines(board, drawing, field)
    draw_edges(board, drawing, field)
    draw_cams(board, drawing, field)
    draw_touches(board, drawing, field)


def draw_bodies(board: FieldContent, drawing: Drawing, field: Field, *, carriers: bool) -> None:
    """Draw the bars on which blocks slide, or all others."""
    owners = {rail.owner for rail in rails_of(drawing)}
    for link in drawing.scene.links.values():
        if corners_of(drawing, link) is None and (link.name in owners) is carriers:
            draw_body(board, drawing, field, link)


def draw_outlines(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the sides of plates once more, above the construction lines along them."""
    for link in drawing.scene.links.values():
        if corners := corners_of(drawing, link):
            on_page = tuple(field(place) for place in corners)
            board.marks.append(polygon(on_page, "outline", link.name))


def draw_pins(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the pins with their letters, with one more circle for each further link at a pin."""
    fixed, pinned = set(drawing.scene.fixed_points), moving_points(drawing)
    for name, place in drawing.positions.items():
        at, count = field(place), sharers(drawing, name)
        rings = [PIN + HINGE * i for i in range(1, count - 1)]
        board.marks += [CircleMark(*at, r, "hinge", name) for r in reversed(rings)]
        radius = FIXED if name in fixed & pinned else PIN if count > 1 else FREE
        board.marks.append(pin(at, name, radius))
        draw_unbroken(board, drawing, field, name)
        letter(board, drawing, field, name)


def draw_unbroken(board: FieldContent, drawing: Drawing, field: Field, name: str) -> None:
    """Draw the bars that continue through a pin at which others end."""
    if sharers(drawing, name) < 2:
        return
    here = drawing.positions[name]
    for link in drawing.scene.links.values():
        places = places_of(drawing, link.name)
        if name not in link.points or len(places) < 3 or is_all_wheel(drawing, link.name):
            continue
        if corners_of(drawing, link) is not None:
            continue
        first, last = farthest(places)
        reach = smaller(abs(here - first), abs(here - last)) * field.mm
        if reach > 2 * PIN:
            at, way = field(here), field.way(last - first)
            ends = across(at, way, -PIN, 0), across(at, way, PIN, 0)
            board.marks.append(LineMark(*ends[0], *ends[1], "link", link.name))


def draw_body(board: FieldContent, drawing: Drawing, field: Field, link: Link) -> None:
    """Draw a bar between two points, or a plate through more; a wheel needs no further body."""
    if is_all_wheel(drawing, link.name):
        return
    places = places_of(drawing, link.name)
    if len(places) < 2:
        return
    if link.name in drawing.scene.unseen:
        board.marks.append(LineMark(*field(places[0]), *field(places[1]), "locus", link.name))
        return
    corners = corners_of(drawing, link)
    if corners is None:
        first, last = farthest(places)
        board.marks.append(LineMark(*field(first), *field(last), "link", link.name))
    else:
        on_page = tuple(field(place) for place in corners)
        board.marks.append(polygon(on_page, "plate", link.name))


def outward(drawing: Drawing, field: Field, name: str) -> XY | None:
    """The direction from the middle of a point's neighbours to the point, on the page."""
    here = drawing.positions[name]
    near = [
        drawing.positions[other]
        for link in drawing.scene.links.values()
        if name in link.points
        for other in link.points
        if other != name and other in drawing.positions
    ]
    ways = [(here - other) / abs(here - other) for other in near if other != here]
    total = sum(ways)
    return field.way(total) if ways and abs(total) > 0.1 else None


BEYOND = 1.15
"""Drawn half-length of a flat face, as a multiple of the part that touches the cam in one turn."""


def draw_cams(board: FieldContent, drawing: Drawing, field: Field) -> None:
    """Draw the profiles of all placed cams, and the rollers and faces of their followers."""
    from graphkin.construction.core.cam_profiles import DRAWN, profiles_of

    scene, places = drawing.scene, drawing.positions
    for follower, cam in scene.cams.items():
        tip = cam.point
        axis = drawing.standing.axis(cam.on)
        if cam.pivot not in places or tip not in places or axis is None:
            continue
        profile, *second = profiles_of(scene, follower, DRAWN)
        pivot = places[cam.pivot]
        for each in (profile, *second):
            outline = tuple(field(pivot + axis * complex(place)) for place in each.outline)
            board.marks.append(polygon(outline, "profile", cam.on))
        for each in second:
            assert cam.conjugate is not None
            at = field(places[cam.conjugate.at])
            board.marks.append(CircleMark(*at, each.roller * field.mm, "profile", follower))
        if cam.tip == "roller":
            radius = profile.roller * field.mm
            board.marks.append(CircleMark(*field(places[tip]), radius, "profile", follower))
        elif cam.is_flat:
            pin = places[cam.lever.pin] if cam.lever else None
            carrier = drawing.standing.axis(cam.carrier)
            seen = 1 + 0j if carrier is None else carrier
            (x1, y1), (x2, y2) = map(field, face_ends(profile, pin, places[tip], seen))
            board.marks.append(LineMark(x1, y1, x2, y2, "profile", follower))


def face_ends(
    profile: CamProfile, pin: complex | None, tip: complex, carrier: complex
) -> tuple[complex, complex]:
    """The ends of a flat face whose point, or whose lever's point, is at ``tip``.

    ``carrier`` is the axis of the link that carries the follower.
    """
    lever, far = profile.cam.lever, BEYOND * profile.face
    if lever is None or pin is None:
        along, aside = profile.guide[0] * carrier, profile.guide[1]
        foot = tip - 1j * along * aside
        return foot - 1j * along * far, foot + 1j * along * far
    way = (tip - pin) / abs(tip - pin)
    start = pin + 1j * way * lever.side * float(lever.face.si(profile.scene.values))
    return start, start + far * way


def face_words(drawing: Drawing, link: Link) -> str:
    """The sentence about a block that represents a flat face on its cam; empty for other links."""
    follower = drawing.scene.cam_links.get(link.name)
    if follower is None or not link.slides:
        return ""
    fields = {"k": escape(link.name), "f": escape(follower), "p": symbol(link.points[0])}
    return drawing.words("step.cam-face", **fields)
