"""The sheet of positions: the mechanism in all of them, paths of points, dead points, the stroke.

One position is drawn strongly, with all its symbols. The others are thin, with numbered pins.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import pairwise
from math import acos, cos, degrees, dist, hypot, inf, pi, radians, sin

import numpy as np
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import data
from graphkin.construction.core.layout import centre
from graphkin.construction.core.naming import angle_symbol, stated_scale
from graphkin.construction.core.paper_canvas import above_foot, clipped_path
from graphkin.construction.core.quantities import FORCE
from graphkin.construction.frame_over_motion import standing, travelling
from graphkin.construction.links.link_shapes import (
    corners_of,
    farthest,
    is_all_wheel,
    places_of,
    rails_of,
)
from graphkin.construction.links.mechanism_symbols import (
    draw_bars,
    draw_ground,
    draw_pins,
    draw_plates,
    settle_in_plates,
)
from graphkin.documents.positions import (
    Position,
    PositionSet,
    ValueRow,
    at_position,
    is_whole,
    numbers_of,
    travel_row,
)
from graphkin.documents.sentences import force_data
from graphkin.documents.sheet import (
    LETTERS,
    NAME,
    in_lines,
    in_table,
    page_in,
    title_block,
    title_line,
    title_of,
)
from graphkin.documents.sheet import caption as heading_of_field
from graphkin.drawing.clearance import pieces_of
from graphkin.drawing.field import XY, Field, Rect
from graphkin.drawing.labels import FieldContent, Label
from graphkin.drawing.marks import (
    Arc,
    CircleMark,
    LineMark,
    Mark,
    Page,
    Text,
    box,
    polygon,
    reach,
    style_class,
)
from graphkin.drawing.richtext import extent, flowed
from graphkin.drawing.scale import Extent, Scales, preferred_scales
from graphkin.drawing.shapes import Array, struck
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.drawing.symbols import PIN, across, distance, head, toward
from graphkin.motion.follower_limits import Follower
from graphkin.scene.model import FRAME
from graphkin.scene.quantity import LENGTHS
from graphkin.text import Words
from graphkin.text.errors import PageError

AROUND, OVER = 22.0, 13.0
"""Room at the sides of the drawing, and above and below it, for numbers, in mm."""
DOT, FINE_DOT = 0.7, 0.5
"""Radius of a numbered pin in mm, and where many are drawn."""
CROWD = 80
"""Number of labels from which none gets a leader."""
MANY = 16
"""Number of positions from which numbers are as small as lettering allows."""
ASIDE, BEYOND = 13.0, 1.5
"""Distance of the stroke's dimension from the path, and length of extension lines beyond it, mm."""
STROKE_ROOM = ASIDE + 1.0
"""Distance from the path at which the dimension of the stroke needs room, in mm."""
SHARE = 0.45
"""Radius of the arc of a swing, as a share of the link."""
TRIES = 18
"""Number of places tried for a dimension on each side of its path."""
WEAK, DEAD = "weak-link", "dead-link"
"""Classes of the links in the other positions, and at dead points."""
LIGHT = (WEAK, DEAD, "trajectory", "centre-line")
"""Classes of thin lines that a letter may interrupt."""
AIR = 0.3
"""Room around a letter that interrupts lines, in mm."""
LEVEL = 1e-3
"""Breadth of a path, as a share of its length squared, below which it is run to and fro."""


def positions_page(found: PositionSet, number: str) -> Page:
    """The sheet of the mechanism in all positions."""
    strong = at_scale(found)
    drawing, words = strong.alone, strong.alone.words
    field = field_of(found, drawing)
    board, numbers = drawn(found, strong, field)
    letters = [*placed(board, [], board.labels)]
    numerals = [*placed(board, letters, numbers)]
    marks: list[Mark] = [
        *heading(found, drawing, words("sheet.positions")),
        *caption(found, drawing),
        *board.marks,
        *letters,
        *numerals,
        *foot_line(found),
        *places_table(
            *(found, found.every, legend(found, whole=is_whole_set(numbers, numerals))),
            travel_row(found),
        ),
        *proof(found),
    ]
    title = f"{words('sheet.positions')} – {title_of(drawing)}"
    kind, scale = document(drawing, "mechanism"), words.decimal(drawing.scales.words)
    return framed(drawing, number, kind, scale, marks, title)


def framed(
    drawing: Drawing, number: str, document: str, scale: str, marks: Sequence[Mark], title: str
) -> Page:
    """A sheet with one field, with the type of document and the scale in its title block."""
    block = title_block(drawing, "positions", number)
    block = replace(block, document_type=document, scale=scale)
    paper = drawing.paper.leaf
    return page_in(paper, drawing, block, marks, title, paper.single)


def field_on(found: PositionSet) -> Rect:
    """The field of a sheet of a whole motion, in mm."""
    return found.shown.alone.paper.leaf.single


def foot_line(found: PositionSet) -> Iterator[Mark]:
    """The line below the field."""
    left, _, right, low = field_on(found)
    yield LineMark(left, low, right, low, "panel")


def document(drawing: Drawing, kind: str) -> str:
    """The type of document of a sheet of positions: the mechanism, or a kind of plan."""
    return drawing.words(f"sheet.document_{kind}", view=drawing.words("sheet.positions_view"))


def heading(found: PositionSet, drawing: Drawing, name: str) -> list[Mark]:
    """The title of a sheet and the data of the mechanism, or where these are if they do not fit."""
    own = replace(drawing, scene=found.cycle.scene)
    marks, x, y = title_line(own, named=name)
    paper = drawing.paper
    if paper.is_parted:
        marks = [mark for mark in marks if reach(mark)[2] < paper.across]
    by_time = found.cycle.sweep.driver is None
    if drawing.kind == FORCE:
        table = f"({own.words('sheet.force_table')})"
        given = force_data(own, solved=not by_time, by_table=table)
    else:
        given = data(own, solved=not by_time, laws=by_time)
    try:
        return [
            *marks,
            *(
                in_table(paper, own.words("clause_mark"), given, x, y)
                or in_lines(own, given, x, y, float)
            ),
        ]
    except PageError:
        elsewhere = drawing.words("positions.data_elsewhere")
        return [*marks, Text(x, y, elsewhere, "caption", LETTERS, name=NAME)]


def proof(
    found: PositionSet, key: str = "page.verified", difference: float | None = None
) -> Iterator[Mark]:
    """The sentence of a check at the foot of a sheet: of the residual check, or of another one."""
    words = found.shown.alone.words
    worst = found.difference if difference is None else difference
    text = words(key, difference=words.significant(worst, 2))
    left, _, _, low = found.shown.alone.paper.leaf.notes
    yield Text(left - 2, low - 1.2, text, "caption", 2.5, name="witness")


# --- scale and field ------------------------------------------------------------------------------


def box_of(found: PositionSet) -> Extent:
    """The box of the mechanism in all positions with the paths of its points."""
    boxes = [each.alone.bare_extent() for each in found.every]
    places = [place for path in found.paths.values() for place in path]
    return reduce(Extent.joined, boxes).grown(places)


def at_scale(found: PositionSet) -> Position:
    """The strong position at the largest preferred scale at which all positions fit."""
    whole = box_of(found)
    left, top, right, low = field_on(found)
    wide, high = right - left - 2 * AROUND, low - top - 2 * OVER
    metre = float(LENGTHS[found.cycle.scene.base])
    least = 1000 * max(whole.width / wide, whole.height / high) * metre
    drawn = (scaled(found.shown.alone, ratio) for ratio in preferred_scales(least))
    drawing = next(each for each in drawn if has_room_for_stroke(found, each))
    stated = found.cycle.scene.sheet.scale
    own = float(stated.number(found.cycle.scene.values)) if stated is not None else 0.0
    if own >= least:
        drawing = scaled(drawing, own)
    return replace(found.shown, alone=drawing)


def scaled(drawing: Drawing, ratio: float) -> Drawing:
    """A mechanism at a scale: the real length over the drawn one."""
    metre = float(LENGTHS[drawing.scene.base])
    return replace(drawing, scales=Scales(ratio / metre, 1.0, metre=metre))


def has_room_for_stroke(found: PositionSet, drawing: Drawing) -> bool:
    """Whether the stroke of a block has room for its dimension on the outer side of its path."""
    field = field_of(found, drawing)
    path = stroke_of(found, drawing, field)
    if path is None:
        return True
    low, high, along = path
    sides = [across(low, along, distance(low, high) / 2, side * STROKE_ROOM) for side in (1, -1)]
    outer = max(sides, key=lambda at: dist(at, centre(field.rect)))
    return inside(outer, field.rect)


def field_of(found: PositionSet, drawing: Drawing) -> Field:
    """The field of the mechanism, with all positions in its middle."""
    rect = field_on(found)
    return Field(rect, 1000 / drawing.scales.kL, box_of(found).middle, centre(rect))


def caption(found: PositionSet, drawing: Drawing) -> Iterator[Mark]:
    """The caption of the field: the scale, and what is drawn how."""
    words = drawing.words
    count = len(found.numbered) if is_whole(found.cycle) else len(found.numbered) - 1
    scale, kL = words.decimal(drawing.scales.words), stated_scale(drawing)
    said = words("page.mechanism_heading", scale=scale, kL=kL)
    more = words("positions.strong", number=found.shown.name, count=count)
    text = f"{said};  {more}"
    yield from headline(found, text)


def headline(found: PositionSet, said: str) -> list[Mark]:
    """The caption of the field of a sheet of a whole motion."""
    return heading_of_field(said, field_on(found), 2.5)


# --- the mechanism in all positions ---------------------------------------------------------------


def drawn(found: PositionSet, strong: Position, field: Field) -> tuple[FieldContent, list[Label]]:
    """The field with all but the numbers of pins, and these numbers.

    It holds paths, thin positions, dead points, the strong position and the stroke.
    """
    board = FieldContent(field.rect)
    board.marks += paths(found, field)
    draw_plates(board, strong.alone, field)
    board.marks += over_motion(found, field)
    for each in found.numbered:
        if each.name != strong.name:
            board.marks += outlines(each, field, WEAK)
    for each in found.dead:
        board.marks += outlines(each, field, DEAD)
    draw_strong(board, found, strong, field)
    numbers = [
        *number_pins(board, found, strong, field),
        *turn_followers_back(board, found, strong, field),
    ]
    draw_stroke(board, found, field)
    return board, numbers


def placed(board: FieldContent, shown: Sequence[Mark], labels: Sequence[Label]) -> Iterator[Mark]:
    """Labels at free places of a field, clear of its marks and of some already ``shown``.

    A label without such a place interrupts thin lines, as a hand leaves them out there. Of many
    labels none has a leader, and those for which this leaves no room either are left out.
    """
    many = len(labels) > CROWD
    some = [replace(label, optional=many) for label in labels]
    spots = board.spots(shown, some)
    marks = [m for k, spot in zip(some, spots, strict=True) if spot.free for m in k.marks(spot)]
    yield from marks
    lost = [label for label, spot in zip(some, spots, strict=True) if not spot.free]
    if not lost:
        return
    heavy = replace(board, marks=[m for m in board.marks if style_class(m) not in LIGHT])
    for label, spot in zip(lost, heavy.spots([*shown, *marks], lost), strict=True):
        if spot.free:
            left_of, top, right, low = label.area(spot)
            yield box(
                left_of - AIR, top - AIR, right - left_of + 2 * AIR, low - top + 2 * AIR, "white"
            )
            yield from label.marks(spot)


def is_whole_set(numbers: Sequence[Label], marks: Sequence[Mark]) -> bool:
    """Whether every number has found a place."""
    return len(numbers) == sum(isinstance(mark, Text) for mark in marks)


def paths(found: PositionSet, field: Field) -> Iterator[Mark]:
    """The paths of the moving points."""
    for point, path in found.paths.items():
        on_page = [field(place) for place in path]
        yield from clipped_path(on_page, above_foot(field.rect), "trajectory", f"path {point}")


def over_motion(found: PositionSet, field: Field) -> Iterator[Mark]:
    """The guides, slots and tracks of the frame, as long as all positions need them."""
    left, top, right, low = field.rect
    inner = replace(field, rect=(left + 3, top + 3, right - 3, low - 3))
    yield from standing([each.alone for each in found.every], inner)


def outlines(position: Position, field: Field, look: str) -> Iterator[Mark]:
    """The links at one position as thin lines: bars, plates, guides, wheels that travel."""
    drawing = position.alone
    centres = {*drawing.scene.cam_centres}
    for link in drawing.scene.links.values():
        name = at_position(link.name, position.name)
        unseen = link.name in drawing.scene.unseen or not centres.isdisjoint(link.points)
        if unseen or is_all_wheel(drawing, link.name):
            continue
        places, corners = places_of(drawing, link.name), corners_of(drawing, link)
        if corners is not None:
            yield polygon(tuple(field(place) for place in corners), look, name)
        elif len(places) > 1:
            first, last = farthest(places)
            if abs(last - first) * field.mm > 0.1:
                yield LineMark(*field(first), *field(last), look, name)
    for rail in rails_of(drawing):
        if rail.owner != FRAME and rail.marks:
            along = [rail.along_of(place) for place in places_of(drawing, rail.owner)]
            ends = [*rail.marks, *along]
            low, high = field(rail.at(min(ends))), field(rail.at(max(ends)))
            if distance(low, high) > 0.1:
                yield LineMark(*low, *high, look, at_position(rail.owner, position.name))
    for disc in drawing.standing.discs:
        own = drawing.scene.link(disc.link)
        if disc.link != FRAME and disc.wheel.centre not in drawing.scene.fixed_points:
            name, at = at_position(disc.link, position.name), field(disc.centre)
            yield CircleMark(*at, disc.radius * field.mm, look, name)
            for place in (drawing.positions.get(point) for point in own.points):
                if place is not None and abs(place - disc.centre) * field.mm > DOT:
                    yield LineMark(*at, *field(place), look, name)


def draw_strong(board: FieldContent, found: PositionSet, strong: Position, field: Field) -> None:
    """Draw the strong position above its plates, its letters numbered like its pins."""
    drawing, own = strong.alone, FieldContent(field.rect)
    same = travelling(drawing, field)
    draw_ground(own, drawing, field)
    draw_bars(own, drawing, field)
    draw_pins(own, drawing, field)
    settle_in_plates(own)
    board.marks += [mark for mark in own.marks if mark not in same]
    board.taken += own.taken
    names = {name: at_position(name, strong.name) for name in found.moving}
    for label in own.labels:
        name = "" if label.ring else names.get(label.name, "")
        numbered = replace(label, markup=symbol(name), name=name, priority=4)
        board.labels.append(numbered if name else label)


def number_pins(
    board: FieldContent, found: PositionSet, strong: Position, field: Field
) -> list[Label]:
    """Draw the pins of the other positions, each with the number of its position.

    Pins of one point that touch each other share a label.
    """
    many = len(found.numbered) >= MANY
    radius, height = (FINE_DOT, 1.8) if many else (DOT, 2.5)
    numbers: list[Label] = []
    for point in found.moving:
        path = [field(place) for place in found.paths[point]]
        pins = [(each, field(each.alone.positions[point])) for each in found.every]
        others = [(each, at) for each, at in pins if each.name != strong.name]
        board.marks += [
            CircleMark(*at, radius, "pin", at_position(point, e.name)) for e, at in others
        ]
        own = field(strong.alone.positions[point])
        if strong.also:
            away = outward(found, path, own, strong)
            name = at_position(point, strong.also)
            board.labels.append(Label(strong.also, "", own, height, name, away=away, radius=PIN))
        for group in touching(others, 2 * radius):
            each, at = group[len(group) // 2]
            text = ", ".join(" ≡ ".join(filter(None, (e.name, e.also))) for e, _ in group)
            name = " ".join(at_position(point, e.name) for e, _ in group)
            away = outward(found, path, at, each)
            numbers.append(Label(text, "", at, height, name, away=away, radius=radius))
    return numbers


def turn_followers_back(
    board: FieldContent, found: PositionSet, strong: Position, field: Field
) -> Iterator[Label]:
    """Draw the tips of cam followers on the cam as it is drawn; the labels with their numbers.

    The cam is held, and the frame turns back with the follower: as cams are drawn.
    """
    for follower, cam in found.cycle.scene.cams.items():
        own = strong.alone.standing.axis(cam.on)
        if cam.slides or cam.carrier != FRAME or own is None:
            continue
        for each in found.every:
            axis, place = each.alone.standing.axis(cam.on), each.alone.positions.get(cam.point)
            pivot = each.alone.positions.get(cam.pivot)
            if axis is None or place is None or pivot is None or each.name == strong.name:
                continue
            at, name = field(pivot + (place - pivot) * own / axis), f"reversed {follower}"
            name = at_position(name, each.name)
            board.marks.append(CircleMark(*at, FINE_DOT, "pin", name))
            board.marks.append(LineMark(*field(pivot), *at, "construction", name))
            away = toward(field(pivot), at)[1]
            yield Label(each.name, "", at, 1.8, name, away=away, radius=FINE_DOT)


def touching(pins: Sequence[tuple[Position, XY]], least: float) -> list[list[tuple[Position, XY]]]:
    """The pins of one point in groups whose circles touch, each in the order of the motion."""
    left, found = list(pins), []
    while left:
        group = [left.pop(0)]
        while near := [one for one in left if any(dist(one[1], at) < least for _, at in group)]:
            group += near
            left = [one for one in left if one not in near]
        found.append(sorted(group, key=lambda one: in_order(one[0])))
    return found


def in_order(each: Position) -> tuple[bool, float]:
    """Numbered positions first, as they are numbered, then dead points."""
    numbered = each.name.isdigit()
    return not numbered, float(each.name) if numbered else each.at


def outward(found: PositionSet, path: Sequence[XY], at: XY, each: Position) -> XY | None:
    """The side of a path on which a number is written: outside a loop.

    Beside a path that is run to and fro, it is the right of the motion, so that the numbers of both
    ways lie on different sides.
    """
    near = min(range(len(path)), key=lambda i: dist(path[i], at))
    if area(path) == 0:
        near = place_on(found, each, len(path))
    first, last = path[max(near - 1, 0)], path[min(near + 1, len(path) - 1)]
    length = hypot(last[0] - first[0], last[1] - first[1])
    if length < 1e-6:
        return None
    u, v = (last[0] - first[0]) / length, (last[1] - first[1]) / length
    side = -1.0 if area(path) > 0 else 1.0
    return -side * v, side * u


def place_on(found: PositionSet, each: Position, count: int) -> int:
    """The index of a position on the path of a point."""
    low, high = found.cycle.ranges[0]
    shifts = found.cycle.path.shifts(each.at)
    at = next((each.at + s for s in shifts if low <= each.at + s <= high), low)
    share = min(max((at - low) / (high - low), 0.0), 1.0)
    share = share if is_whole(found.cycle) else acos(1 - 2 * share) / pi
    return round(share * (count - 1))


def area(path: Sequence[XY]) -> float:
    """Twice the signed area of a closed path, positive clockwise on the page; 0 for a line."""
    pairs = [*pairwise((*path, path[0]))]
    twice = sum(x * v - u * y for (x, y), (u, v) in pairs)
    long = sum(hypot(u - x, v - y) for (x, y), (u, v) in pairs)
    return 0.0 if abs(twice) < LEVEL * long**2 else twice


# --- the stroke -----------------------------------------------------------------------------------


def draw_stroke(board: FieldContent, found: PositionSet, field: Field) -> None:
    """Dimension the stroke of a block between its limits, or the swing of a link."""
    travel, drawing = found.follower, found.shown.alone
    if travel is None:
        return
    name, words = f"stroke {travel.name}", drawing.words
    if travel.line is not None:
        text = f"*ψ* = {words.fixed(travel.extent, 2)}°"
        draw_swing(board, travel, [field(drawing.positions[p]) for p in travel.line], name, text)
    elif ends := block_ends(board, found, field):
        size = words.significant(drawing.length(travel.extent), 4)
        text = f"*H* = {size} {drawing.words.spelled(drawing.scene.units['length'])}"
        board.marks += dimension(*ends, name)
        board.labels.append(Label(text, "", ends[2:], 2.5, name, priority=3))


def draw_swing(
    board: FieldContent, travel: Follower, line: Sequence[XY], name: str, text: str
) -> None:
    """Draw the arc between the limits of a link, with the lines of the link there."""
    pivot, radius = line[0], SHARE * dist(*line)
    low, high = travel.low.value, travel.high.value
    board.marks.append(Arc(*pivot, radius, low, high, "drive", name))
    for angle, inward in ((low, 1), (high, -1)):
        tip = across(pivot, direction(angle), radius, 0)
        board.marks.append(
            LineMark(*pivot, *across(pivot, direction(angle), radius + 4, 0), "drive", name)
        )
        back = min(degrees(4 / radius), (high - low) / 2)
        tail = across(pivot, direction(angle + inward * back), radius, 0)
        board.marks.append(head(tail, tip, "sense", name))
    away = direction((low + high) / 2)
    at = across(pivot, away, radius, 0)
    board.labels.append(Label(text, "", at, 2.5, name, away=away, priority=3))


def direction(angle: float) -> XY:
    """The unit vector on the page for an angle in degrees."""
    return cos(radians(angle)), -sin(radians(angle))


def stroke_of(found: PositionSet, drawing: Drawing, field: Field) -> tuple[XY, XY, XY] | None:
    """The ends of the stroke of a block on the frame, and its direction; None without any."""
    travel = found.follower
    if travel is None or travel.line is not None:
        return None
    way = next((w for w in drawing.standing.guideways if w.block == travel.name), None)
    if way is None or way.slide.on != FRAME:
        return None
    start = way.at + (travel.low.value - way.coordinate) * way.along
    end = way.at + (travel.high.value - way.coordinate) * way.along
    return field(start), field(end), field.way(way.along)


def block_ends(
    board: FieldContent, found: PositionSet, field: Field
) -> tuple[XY, XY, XY, XY] | None:
    """The ends of a block's stroke on its path, and those of its dimension line beside it."""
    path = stroke_of(found, found.shown.alone, field)
    if path is None:
        return None
    first, last, along = path
    lines = struck_lines(board)
    sides = [side * (ASIDE + 6 * i) for i in range(TRIES) for side in (1, -1)]

    def cost(aside: float) -> float:
        low, high = across(first, along, 0, aside), across(last, along, 0, aside)
        if not all(inside(end, field.rect) for end in (low, high)):
            return inf
        return float(struck(np.array([[low, high]]).reshape(-1, 4), lines)[0]) + abs(aside) / 8

    aside = min(sides, key=cost)
    return first, last, across(first, along, 0, aside), across(last, along, 0, aside)


def struck_lines(board: FieldContent) -> Array:
    """The lines of the field that a dimension should not cross, without the paths of points."""
    return pieces_of(
        [m for m in board.marks if style_class(m) not in ("trajectory", "centre-line")]
    )


def inside(at: XY, rect: Rect) -> bool:
    """Whether a place is in a field, clear of its edges."""
    return rect[0] + 5 < at[0] < rect[2] - 5 and rect[1] + 5 < at[1] < rect[3] - 5


def dimension(
    first: XY,
    last: XY,
    low: XY,
    high: XY,
    name: str,
) -> Iterator[Mark]:
    """The extension lines and the dimension line with its two arrowheads."""
    for start, end in ((first, low), (last, high)):
        far = distance(start, end)
        u, v = (end[0] - start[0]) / far, (end[1] - start[1]) / far
        yield LineMark(*start, end[0] + BEYOND * u, end[1] + BEYOND * v, "drive", name)
    yield LineMark(*low, *high, "drive", name)
    if distance(low, high) > 4:
        yield head(low, high, "sense", name)
        yield head(high, low, "sense", name)


# --- the places of the driver in a table ----------------------------------------------------------


ROW, FIRST, PAD = 4.6, 26.0, 1.4
"""Height of a row, width of its head, and least padding of a cell, in mm."""
IN_ROW = 16
"""The most positions in one row of the table, where there is room for all rows."""
CLOSE = (3.1, 0.5)
"""Height of a row and distance of pairs of rows in a table of many positions, in mm."""
PROOF = 4.0
"""Room for the sentence of the residual check at the foot, in mm."""


def places_table(
    found: PositionSet,
    some: Sequence[Position],
    said: Sequence[str],
    more: Sequence[ValueRow] = (),
) -> Iterator[Mark]:
    """The numbers of some positions above the places of the driver there, and sentences below.

    ``more`` are rows of values that are shown where there is room.
    """
    words, sweep = found.shown.alone.words, found.cycle.sweep
    left, top, right, foot = found.shown.alone.paper.leaf.notes
    top += 4
    unit = "°" if sweep.what == "turn" else sweep.original.units["length"]
    if sweep.driver is None:
        head_of = f"*t* ({words.spelled('s')})"
    else:
        name = angle_symbol(sweep.original, sweep.driver)
        head_of = f"{name} ({words.spelled(unit)})"
    names, values = [each.name for each in some], numbers_of(found)
    lines = flowed(said, words("clause_mark"), right - left, 2.5)
    widest = PAD + max(extent(each, 2.5)[0] for each in (*names, *values))
    count = -(-len(names) // min(IN_ROW, int((right - left - FIRST) / widest)))
    room = foot - PROOF - top - 4.2 * len(lines)
    own, gap = (ROW, 1.5) if count * (2 * ROW + 1.5) <= room else CLOSE
    count = min(count, max(int(room / (2 * own + gap)), 1))
    per = -(-len(names) // count)
    width = (right - left - FIRST) / per
    whole = [(words("positions.number"), names), (head_of, values)]
    if count == 1 and own == ROW:
        free = int((room - gap) / ROW) - len(whole)
        whole += [*fitting(more, words, width - PAD)][:free]
    small = width < widest or own < ROW
    for k in range(count):
        row = slice(k * per, (k + 1) * per)
        begin = top + k * (len(whole) * own + gap)
        rows = [(first, texts[row]) for first, texts in whole]
        end = left + FIRST + width * len(names[row])
        yield box(left, begin, end - left, own, "shade")
        for i, (first, texts) in enumerate(rows):
            base = begin + i * own + (own if own == ROW else own + 0.6) - 1.3
            tall = 2.5 if own == ROW else 1.8
            yield Text(left + 1.5, base, first, "table", tall, name="positions")
            for j, text in enumerate(texts):
                x = left + FIRST + width * (j + 0.5)
                height = 1.8 if small else 2.5
                yield Text(x, base, text, "table", height, "middle", "positions")
        for i in range(len(rows) + 1):
            yield LineMark(left, begin + i * own, end, begin + i * own, "panel")
        for x in (left, *(left + FIRST + width * j for j in range(len(names[row]) + 1))):
            yield LineMark(x, begin, x, begin + len(rows) * own, "panel")
    low = top + count * (len(whole) * own + gap) + 3.5
    for i, line in enumerate(lines):
        yield Text(left, low + 4.2 * i, line, "caption", 2.5, name="legend")


def fitting(
    rows: Sequence[ValueRow], words: Words, width: float
) -> Iterator[tuple[str, list[str]]]:
    """The rows of values that a column has room for, with four digits or with three."""
    for row in rows:
        for digits in (4, 3):
            values = row.written(words, digits)
            if max(extent(each, 2.5)[0] for each in values) <= width:
                yield row.head, values
                break


def legend(found: PositionSet, *, whole: bool) -> list[str]:
    """What the kinds of lines and the letters of the sheet mean; not ``whole`` lacks numbers."""
    words, travel = found.shown.alone.words, found.follower
    said: list[str] = [words("positions.paths")]
    if any(not cam.slides and cam.carrier == FRAME for cam in found.cycle.scene.cams.values()):
        said.append(words("positions.reversed"))
    dead = [*(each.name for each in found.dead), *(e.also for e in found.numbered if e.also)]
    if dead:
        said.append(words("positions.dead", list=words("list_mark").join(sorted(dead))))
    if travel is not None:
        key = "positions.stroke" if travel.line is None else "positions.swing"
        said.append(words(key, k=escape(travel.name)))
    return said if whole else [*said, words("positions.no_room")]
