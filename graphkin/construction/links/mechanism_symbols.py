"""The mechanism to scale with the field's symbols: bars, plates, pins and pivots."""

from __future__ import annotations

from graphkin.construction.cams.cam_symbols import draw_cams
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.paper_canvas import draw_line
from graphkin.construction.guides.pivot_grounds import ground_ways, grounds_of, is_covered
from graphkin.construction.guides.rails import places_of, rails_of
from graphkin.construction.guides.slide_symbols import (
    draw_blocks,
    draw_frame_guides,
    draw_guide_bars,
)
from graphkin.construction.links.link_numbers import draw_numbers
from graphkin.construction.links.link_shapes import corners_of, farthest, is_all_wheel
from graphkin.construction.links.wheel_symbols import (
    draw_edges,
    draw_fixed_wheels,
    draw_touches,
    draw_track_line,
    draw_tracks,
    draw_wheels,
)
from graphkin.drawing.field import XY, Field
from graphkin.drawing.labels import FieldContent, Label
from graphkin.drawing.marks import CircleMark, LineMark, Shown, polygon, reach
from graphkin.drawing.symbol_markup import symbol
from graphkin.drawing.symbols import FIXED, FREE, HINGE, PIN, TALL, across, legs, pin, pivot_ground
from graphkin.numbers.arithmetic import smaller
from graphkin.scene.model import Link


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
    """Label a point with its letter, clear of a fixed point's ground or away from its bars."""
    at = field(drawing.positions[name])
    if name in drawing.scene.fixed_points:
        ground = ground_ways(drawing, field.mm).get(name, -1j)
        away: XY | None = field.way(ground * (-0.6 - 0.8j))
    else:
        away = outward(drawing, field, name)
    radius = PIN + HINGE * max(0, sharers(drawing, name) - 2)
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
    """Draw wheels and plates, below everything else; an arm is below the wheels that it carries."""
    plates = [x for x in drawing.scene.links.values() if corners_of(drawing, x) is not None]
    arms = [link for link in plates if bears_wheels(drawing, link)]
    for link in arms:
        draw_body(board, drawing, field, link)
    draw_wheels(board, drawing, field)
    for link in plates:
        if link not in arms:
            draw_body(board, drawing, field, link)


def bears_wheels(drawing: Drawing, link: Link) -> bool:
    """Whether a link carries the centres of wheels of at least two other links."""
    wheels = {disc.link for disc in drawing.standing.discs if disc.wheel.centre in link.points}
    return len(wheels - {link.name}) > 1


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
        if name not in link.points or len(places) < 3 or corners_of(drawing, link) is not None:
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
