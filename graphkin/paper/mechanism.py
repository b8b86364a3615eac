"""The mechanism to scale with the field's symbols: bars, plates, pins, pivots, blocks, angles."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterable, Iterator
from math import degrees, hypot

from graphkin.paper.areas import Rect
from graphkin.paper.data import angle_symbol
from graphkin.paper.drawing import Drawing
from graphkin.paper.field import XY, Field, clipped
from graphkin.paper.labels import Board, Label
from graphkin.paper.marks import Arc, Line, Mark, polygon
from graphkin.paper.richtext import escape
from graphkin.paper.symbolic import symbol
from graphkin.paper.symbols import (
    PIN,
    block_on_guide,
    fixed_pivot,
    pin,
    turned_arrow,
)
from graphkin.plane import cross
from graphkin.scene.model import Driver, Link

REACH = 15.0
"""Half the length of a drawn guide in mm."""
ANGLE = 11.0
"""Radius of the arc of a driver's angle in mm."""


def draw_frame(board: Board, drawing: Drawing, field: Field) -> None:
    """The fixed pivots and the lines of fixed guides: what the task sheet shows, too."""
    pinned = moving_points(drawing)
    for name in drawing.scene.frame.points:
        at = field(drawing.positions[name])
        if name in pinned:
            board.marks += fixed_pivot(at, name)
            board.taken.append((at[0] - 5.6, at[1], at[0] + 5.6, at[1] + 8.2))
        else:
            board.marks += [Line(at[0] - 1, at[1], at[0] + 1, at[1], "link", name)]
        board.labels.append(
            Label(symbol(name), "", at, 3.5, name, away=(-0.8, -0.6), priority=2, radius=PIN)
        )


def moving_points(drawing: Drawing) -> set[str]:
    """The points that moving links own."""
    return {point for link in drawing.scene.links.values() for point in link.points}


def draw_guide_line(board: Board, drawing: Drawing, field: Field, block: Link) -> None:
    """The line of a fixed guide across the field, chain-dotted."""
    for slide in block.slides:
        line = drawing.guide(slide)
        if line is None:
            continue
        start, along = line
        part = clipped(*stretched(field(start), field(start + along)), field.rect)
        if part:
            board.marks.append(Line(*part[0], *part[1], "centre-line", f"guide {block.name}"))


def stretched(start: XY, end: XY) -> tuple[XY, XY]:
    """A segment through two places, long enough to leave any page on both sides."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    far = 2000 / max(abs(dx), abs(dy))
    return (start[0] - far * dx, start[1] - far * dy), (start[0] + far * dx, start[1] + far * dy)


def draw_plates(board: Board, drawing: Drawing, field: Field) -> None:
    """The plates, below everything else."""
    for link in drawing.scene.links.values():
        if corners_of(drawing, link) is not None:
            draw_body(board, drawing, field, link)


def draw_bars(board: Board, drawing: Drawing, field: Field) -> None:
    """Bars and blocks, each with its number."""
    links = list(drawing.scene.links.values())
    for link in links:
        if corners_of(drawing, link) is None:
            draw_body(board, drawing, field, link)
    for link in links:
        draw_guide_line(board, drawing, field, link)
        draw_blocks(board, drawing, field, link)


def draw_pins(board: Board, drawing: Drawing, field: Field) -> None:
    """The moving pins with their letters, on the side away from their bars."""
    fixed = set(drawing.scene.frame.points)
    for name in drawing.positions:
        if name not in fixed:
            at = field(drawing.positions[name])
            board.marks.append(pin(at, name))
            away = outward(drawing, field, name)
            board.labels.append(
                Label(symbol(name), "", at, 3.5, name, away=away, priority=2, radius=PIN)
            )


def draw_body(board: Board, drawing: Drawing, field: Field, link: Link) -> None:
    """A bar between two points, a plate through more, and the link's number beside it."""
    places = places_of(drawing, link)
    if len(places) < 2:
        return
    corners = corners_of(drawing, link)
    if corners is None:
        first, last = farthest(places)
        ends = field(first), field(last)
        board.marks.append(Line(*ends[0], *ends[1], "link", link.name))
    else:
        on_page = tuple(field(place) for place in corners)
        board.marks.append(polygon(on_page, "plate", link.name))
        ends = on_page[0], on_page[1]
    if not link.slides:
        board.labels.append(number_of(link, ends))


def number_of(link: Link, beside: tuple[XY, XY]) -> Label:
    """A link's number or name in its balloon, beside a segment."""
    return Label(escape(link.name), "", beside, 2.5, link.name, priority=3, ring=True)


def places_of(drawing: Drawing, link: Link) -> list[complex]:
    """Where the points of a link stand."""
    return [drawing.positions[p] for p in link.points if p in drawing.positions]


def farthest(places: list[complex]) -> tuple[complex, complex]:
    """The two places that are farthest apart."""
    return max(
        ((p, q) for i, p in enumerate(places) for q in places[i + 1 :]),
        key=lambda ends: abs(ends[1] - ends[0]),
    )


def corners_of(drawing: Drawing, link: Link) -> list[complex] | None:
    """The corners of a plate in order around it; None for a bar, whose points lie in line."""
    places = places_of(drawing, link)
    if len(places) < 3:
        return None
    first, last = farthest(places)
    along = last - first
    if all(abs(cross(along, p - first)) <= 1e-6 * abs(along) ** 2 for p in places):
        return None
    middle = sum(places) / len(places)
    return sorted(places, key=lambda p: phase(p - middle))


def draw_blocks(board: Board, drawing: Drawing, field: Field, link: Link) -> None:
    """A block between the sides of its fixed guide."""
    for slide in link.slides:
        line = drawing.guide(slide)
        if line is None or link.points[0] not in drawing.positions:
            continue
        at = field(drawing.positions[link.points[0]])
        way = field.way(line[1])
        board.marks += within(block_on_guide(at, way, REACH, link.name), field.rect)
        u, v = way
        side = (
            (at[0] - 3 * u + 3.2 * v, at[1] - 3 * v - 3.2 * u),
            (at[0] + 3 * u + 3.2 * v, at[1] + 3 * v - 3.2 * u),
        )
        board.labels.append(number_of(link, side))


def within(marks: Iterable[Mark], rect: Rect) -> Iterator[Mark]:
    """Marks whose lines end at the edge of a field."""
    for mark in marks:
        if not isinstance(mark, Line):
            yield mark
        elif part := clipped((mark.x1, mark.y1), (mark.x2, mark.y2), rect):
            yield Line(*part[0], *part[1], mark.cls, mark.name)


def outward(drawing: Drawing, field: Field, name: str) -> XY | None:
    """The way from the middle of a point's neighbours to the point, on the page."""
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


def draw_drivers(board: Board, drawing: Drawing, field: Field) -> None:
    """The angle of each crank from the x axis, with its value, and the sense of its turning."""
    for driver in drawing.scene.drivers:
        link = drawing.scene.links[driver.link]
        start = (driver.of or link.points)[0]
        if driver.kind != "turn" or start not in drawing.positions:
            continue
        centre = field(drawing.positions[start])
        end = drawn_angle(drawing, driver)
        board.marks.append(
            Line(*centre, centre[0] + ANGLE + 6, centre[1], "centre-line", f"x {driver.link}")
        )
        if abs(end) > 0.5:
            board.marks.append(Arc(*centre, ANGLE, 0, end, "angle", "phi"))
        middle = Arc(*centre, ANGLE, 0, 1, "angle").at(end / 2)
        value = drawing.words.decimal(driver.position.written(drawing.scene.values))
        board.labels.append(
            Label(
                f"{angle_symbol(drawing.scene, driver)} = {value}°",
                "",
                middle,
                2.5,
                "phi",
                away=unit(centre, middle),
            )
        )
        draw_sense(board, drawing, centre, end, driver.link)


def drawn_angle(drawing: Drawing, driver: Driver) -> float:
    """The driver's angle in degrees, as written where that is less than a turn either way."""
    turn = degrees(phase(complex(driver.position.direction(drawing.scene.values))))
    written = degrees(float(driver.position.si(drawing.scene.values)))
    return written if abs(written) < 360 else turn % 360


def unit(start: XY, end: XY) -> XY:
    """The way from one place to another as a unit vector."""
    length = hypot(end[0] - start[0], end[1] - start[1])
    return (end[0] - start[0]) / length, (end[1] - start[1]) / length


def draw_sense(board: Board, drawing: Drawing, centre: XY, end: float, link: str) -> None:
    """A turning arrow beyond the crank, in the sense of its angular velocity."""
    omega = drawing.trace.value("omega", link)
    if not omega:
        return
    sign = 1 if omega > 0 else -1
    arc = (end + sign * 12, end + sign * 70)
    board.marks += turned_arrow(centre, ANGLE - 3, *arc, "sense")
    at = Arc(*centre, ANGLE - 3, 0, 1, "sense").at((arc[0] + arc[1]) / 2)
    board.labels.append(Label(f"*ω*_{{{escape(link)}}}", "", at, 2.5, f"omega {link}"))
