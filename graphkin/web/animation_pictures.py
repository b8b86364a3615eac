"""The pictures of an animation as marks, at scales that are fixed for the whole motion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from math import ceil

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout
from graphkin.construction.core.naming import angle_symbol
from graphkin.construction.core.paper_canvas import Plot
from graphkin.construction.core.quantities import MOTION, points_asked
from graphkin.construction.drivers.driver_symbols import draw_drivers
from graphkin.construction.frame_over_motion import standing, travelling
from graphkin.construction.links.mechanism_symbols import (
    draw_bars,
    draw_ground,
    draw_pins,
    draw_plates,
)
from graphkin.construction.step_marks import Free, draw_plan_steps, is_point, is_shown, plan_box
from graphkin.documents.sheet import title_of
from graphkin.drawing.field import Field, Rect, clipped
from graphkin.drawing.labels import FieldContent
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Polyline, Text, reach
from graphkin.drawing.richtext import extent
from graphkin.drawing.scale import Extent, extent_of, preferred
from graphkin.drawing.symbol_markup import escape
from graphkin.motion.driving import TURN
from graphkin.numbers.arithmetic import np
from graphkin.text import Words
from graphkin.web.frames import Frame, FrameSequence, goes_round
from graphkin.web.moving_labels import (
    FAR,
    LETTER,
    FrameView,
    PointLetter,
    Rule,
    lettering,
    rules_over,
)

PICTURE = (240.0, 140.0)
"""Width and height of a picture in mm."""
HEAD = 11.0
"""Room for the title above the panes, in mm."""
AREA: Rect = (3.0, HEAD, PICTURE[0] - 3, PICTURE[1] - 3)
"""The part of a picture that the panes fill."""
CAPTION = 5.0
"""Extra room above the drawing of a pane for its caption, in mm."""
ROOM = 13.0
"""Room around a mechanism within its pane, for letters and ground, in mm."""
AIR = 8.0
"""Room around a plan, for its letters, in mm."""
SHARES = (0.4, 0.5, 0.6, 0.7)
"""Shares of the picture's width or height that the mechanism may take."""
HELD = (1.0, 0.95, 0.9, 0.85, 0.8, 0.75)
"""Shares of a motion during which a plan fits its pane; the largest usable share is taken.

A share is usable if it leaves the plan large enough. Below three quarters the plan would leave its
pane too often.
"""
ENOUGH = 0.5
"""A plan is large enough when its median size over the motion is this part of its room."""


def arrangements(plans: int) -> Iterator[list[Rect]]:
    """Ways to divide a picture into panes, the mechanism first: each share in the order of WAYS."""
    if not plans:
        yield [AREA]
        return
    for share in SHARES:
        for way in WAYS:
            yield way(share, plans)


def beside_plans(share: float, plans: int) -> list[Rect]:
    """The mechanism on the left, its plans one above the other on the right."""
    left, top, right, bottom = AREA
    x, down = left + share * (right - left), (bottom - top) / plans
    return [
        (left, top, x, bottom),
        *((x, top + i * down, right, top + (i + 1) * down) for i in range(plans)),
    ]


def above_plans(share: float, plans: int) -> list[Rect]:
    """The mechanism above, its plans side by side below."""
    left, top, right, bottom = AREA
    y, across = top + share * (bottom - top), (right - left) / plans
    return [
        (left, top, right, y),
        *((left + i * across, y, left + (i + 1) * across, bottom) for i in range(plans)),
    ]


def in_a_row(share: float, plans: int) -> list[Rect]:
    """The mechanism and its plans side by side."""
    left, top, right, bottom = AREA
    x = left + share * (right - left)
    across = (right - x) / plans
    return [
        (left, top, x, bottom),
        *((x + i * across, top, x + (i + 1) * across, bottom) for i in range(plans)),
    ]


WAYS = (beside_plans, above_plans, in_a_row)


def worth(rects: Sequence[Rect], box: Extent, plans: Sequence[Sequence[Extent]]) -> float:
    """A measure of how large the drawings are together; the mechanism counts twice."""
    own, *others = rects
    found = scale_in(room_in(own, ROOM), [box]) ** 2
    for rect, boxes in zip(others, plans, strict=True):
        found *= scale_in(room_in(rect, AIR), boxes)
    return found


def room_in(rect: Rect, around: float) -> Rect:
    """The part of a pane for a drawing, below its caption."""
    left, top, right, bottom = rect
    return left + around, top + around + CAPTION, right - around, bottom - around


def scale_in(room: Rect, boxes: Sequence[Extent]) -> float:
    """Millimetres per unit of a drawing: one scale for all the boxes that it fills in turn."""
    width, height = room[2] - room[0], room[3] - room[1]
    sizes = sorted(max(box.width / width, box.height / height) for box in boxes)
    usual, size = sizes[len(sizes) // 2], sizes[-1]
    for part in HELD:
        size = sizes[ceil(part * len(sizes)) - 1] or size
        if usual >= ENOUGH * size:
            break
    return 1 / size if size > 0 else 1.0


def mechanism_pane(rect: Rect, box: Extent) -> Field:
    """The field of a mechanism, centred in its room below the caption."""
    room = room_in(rect, ROOM)
    return Field(rect, scale_in(room, [box]), box.middle, middle_of(room))


def posed(rect: Rect, boxes: Sequence[Extent]) -> Field:
    """The field of a plan, with the pole placed so that the plan has to be moved least."""
    room = room_in(rect, AIR)
    sides = [sorted(each) for each in zip(*(b.sides for b in boxes), strict=True)]
    half = len(boxes) // 2
    usual = extent_of([complex(sides[i][half], sides[i + 1][half]) for i in (0, 2)])
    field = Field(rect, scale_in(room, boxes), usual.middle, middle_of(room))
    return field if field.holds(0j, AIR) else replace(field, middle=0j)


def middle_of(room: Rect) -> tuple[float, float]:
    return (room[0] + room[2]) / 2, (room[1] + room[3]) / 2


def plan_pane(field: Field, box: Extent) -> Field:
    """The field of a plan at one moment: the pole is moved aside where the plan would not fit."""
    left, top, right, bottom = room_in(field.rect, AIR)
    (x, y), (low, high) = field(0j), field(complex(box.left, box.top))
    far, deep = field(complex(box.right, box.bottom))
    across, down = aside(low, far, x, left, right), aside(high, deep, y, top, bottom)
    return replace(field, at=(field.at[0] + across, field.at[1] + down))


def aside(low: float, high: float, pole: float, start: float, end: float) -> float:
    """The shift, along one axis, that moves a plan from ``low``..``high`` into ``start``..``end``.

    A larger plan overhangs the room on both sides, in proportion to its parts on each side of the
    pole.
    """
    if high - low <= end - start:
        return max(start - low, 0.0) + min(end - high, 0.0)
    return start + (pole - low) / (high - low) * (end - start) - pole


def leaves(field: Field, box: Extent) -> bool:
    """Whether part of a drawing lies outside its pane."""
    corners = complex(box.left, box.bottom), complex(box.right, box.top)
    return not all(field.holds(corner) for corner in corners)


# --- the marks of one moment of a motion ----------------------------------------------------------


MOST = 4
"""Largest number of points that may guide the letter of another point."""


def mechanism_seen(drawing: Drawing, field: Field) -> FrameView:
    """The bars, plates, pins and ground, and the points with their letters."""
    board, away_with = FieldContent(field.rect), travelling(drawing, field)
    draw_plates(board, drawing, field)
    draw_ground(board, drawing, field)
    draw_bars(board, drawing, field)
    draw_pins(board, drawing, field)
    marks = [mark for mark in board.marks if mark not in away_with]
    places = {name: field(place) for name, place in drawing.positions.items()}
    letters = {name: PointLetter(drawing.symbol(name)) for name in places}
    return FrameView(letters, places, marks, {name: linked(drawing, name) for name in places})


def driver_marks(drawing: Drawing, field: Field) -> list[Mark]:
    """The angle or displacement of each driver and its sense, without the value at one position."""
    if drawing.kind != "velocity":
        return []
    board = FieldContent(field.rect)
    draw_drivers(board, drawing, field)
    return list(board.marks)


def linked(drawing: Drawing, name: str) -> tuple[str, ...]:
    """The other points of the links that hold a moving point."""
    scene = drawing.scene
    if name in scene.fixed_points:
        return ()
    links = [link for link in scene.links.values() if name in link.points]
    others = dict.fromkeys(other for link in links for other in link.points if other != name)
    return tuple(other for other in others if other in drawing.positions)[:MOST]


def plan_seen(drawing: Drawing, field: Field) -> FrameView:
    """The vectors and points of a plan with their letters, without the construction."""
    board = FieldContent(field.rect)
    draw_plan_steps(Plot(board, field, drawing, Layout(field, field, Free())))
    marks = [mark for mark in board.marks if is_shown(drawing, mark)]
    parts = {mark.step: mark.part for mark in board.marks if isinstance(mark, CircleMark)}
    letters, places = dict[str, PointLetter](), {}
    for number, step, value in drawing.steps(drawing.plane):
        if is_point(step) and isinstance(value, complex):
            own = number, parts.get(number, 0)
            letters[step.name] = PointLetter(drawing.symbol(step.name), drawing.kind, *own)
            places[step.name] = field(value)
    return FrameView(
        letters, places, marks, {name: joined(drawing, name, letters) for name in letters}
    )


def joined(drawing: Drawing, name: str, letters: dict[str, PointLetter]) -> tuple[str, ...]:
    """The points of a plan that a vector joins to the named one, the pole first."""
    steps = drawing.trace.program.steps
    ends = [(steps[tail].name, steps[tip].name) for tail, tip in drawing.joins]
    found = {a if b == name else b for a, b in ends if name in (a, b)} & letters.keys()
    return tuple(sorted(found - {name}, key=lambda each: (each != drawing.pole, each))[:MOST])


def cut(marks: Sequence[Mark], rect: Rect) -> Iterator[Mark]:
    """The marks of a plan in its pane: lines are clipped, other marks are kept or dropped."""
    left, top, right, bottom = rect
    for mark in marks:
        if isinstance(mark, LineMark):
            if part := clipped((mark.x1, mark.y1), (mark.x2, mark.y2), rect):
                (x1, y1), (x2, y2) = part
                yield replace(mark, x1=x1, y1=y1, x2=x2, y2=y2)
            continue
        low, high = reach(mark)[:2], reach(mark)[2:]
        if isinstance(mark, Polyline):
            low = high = mark.points[0]
        if left <= low[0] and top <= low[1] and high[0] <= right and high[1] <= bottom:
            yield mark


# --- the layout of the whole animation ------------------------------------------------------------


BAR = 30.0
"""Longest bar of a scale, in mm."""
WIDE = 85.0
"""Width of a field from which caption and bar stand side by side, in mm."""
STEEPEST = 2.5
"""Largest ratio of two successive round numbers."""
SMALL = 2.5
"""Height of captions, in mm."""
TRIED = 16
"""Number of moments over which the places of letters are chosen."""
EDGE = 3.0
"""Distance from the edge of a field at which guides and tracks end, in mm."""
MECHANISM = "mechanism"
"""The name of the mechanism's field, next to the names of the kinds of plans."""


class Stage(Struct, frozen=True, dict=True):
    """The fields of the mechanism and the plans, which hold in every picture.

    ``plans`` are the fields by kind, with the pole at its usual place. ``paths`` are the paths of
    points over the motion, in metres.
    """

    motion: FrameSequence
    words: Words
    mechanism: Field
    plans: dict[str, Field]
    paths: tuple[tuple[complex, ...], ...]

    def moving(self, moment: Frame) -> list[Mark]:
        """The marks that differ from picture to picture."""
        marks = [*self.heading(moment), *self.mechanism_marks(moment.alone)]
        for drawing in moment.drawings.values():
            field, box = self.seated(drawing), plan_box(drawing)
            marks += cut(self.plan_marks(drawing, field), field.rect)
            if leaves(field, box):
                marks.append(self.larger(field))
        return marks

    def seated(self, drawing: Drawing) -> Field:
        """The field of a plan at its moment."""
        return plan_pane(self.plans[drawing.kind], plan_box(drawing))

    def mechanism_marks(self, drawing: Drawing) -> list[Mark]:
        """The mechanism at one moment with its letters."""
        seen = mechanism_seen(drawing, self.mechanism)
        return [*seen.marks, *lettering(seen, self.rules[MECHANISM], self.mechanism.rect)]

    def plan_marks(self, drawing: Drawing, field: Field) -> list[Mark]:
        """A plan at one moment with its letters."""
        seen = plan_seen(drawing, field)
        return [*seen.marks, *lettering(seen, self.rules[drawing.kind], field.rect)]

    def larger(self, field: Field) -> Text:
        """The note at the foot of a plan that is larger than its pane."""
        return Text(field.rect[0] + 3, field.rect[3] - 2, self.beyond, "caption", SMALL)

    @property
    def beyond(self) -> str:
        """The words that say that a plan leaves its pane, as markup."""
        return escape(self.words("animation.beyond"))

    @cached_property
    def rules(self) -> dict[str, dict[str, Rule]]:
        """The rules for placing letters, for the mechanism and for each kind of plan."""
        some = self.motion.moments[:: max(len(self.motion.moments) // TRIED, 1)]
        own, ground = self.mechanism, [*self.ground]
        seen = [mechanism_seen(moment.alone, own) for moment in some]
        about = [[*ground, *driver_marks(moment.alone, own)] for moment in some]
        seen = [replace(s, marks=[*s.marks, *a]) for s, a in zip(seen, about, strict=True)]
        found = {MECHANISM: rules_over(seen, free_in(own), FAR)}
        for kind, field in self.plans.items():
            drawings = [moment.drawings[kind] for moment in some]
            seen = [plan_seen(drawing, self.seated(drawing)) for drawing in drawings]
            found[kind] = rules_over(seen, free_in(field), FAR[:2])
        return found

    @cached_property
    def still(self) -> list[Mark]:
        """The marks that all pictures share: captions, scales, paths, lines between the fields."""
        words = self.words
        title = title_of(self.motion.moments[0].alone)
        height = LETTER if extent(escape(title), LETTER)[0] < PICTURE[0] - 60 else SMALL
        marks: list[Mark] = [Text(5, 7.5, escape(title), "title", height)]
        for field, name, unit, size in self.captions:
            marks.append(Text(field.rect[0] + 3, field.rect[1] + 4.5, name, "caption", SMALL))
            marks += scale_bar(field, unit, size, words)
        marks += self.ground
        return [*marks, *between([self.mechanism, *self.plans.values()])]

    @property
    def captions(self) -> Iterator[tuple[Field, str, str, float]]:
        """Each field with its name, the unit of its scale, and that unit in SI."""
        words, scene = self.words, self.motion.cycle.scene
        yield (
            self.mechanism,
            escape(words("animation.mechanism")),
            scene.units["length"],
            scene.unit_length,
        )
        for kind, field in self.plans.items():
            yield field, escape(words(f"sheet.{kind}")), words.unit(MOTION[kind].unit), 1.0

    @property
    def ground(self) -> Iterator[Mark]:
        """The marks below the mechanism in every picture: paths, guides, slots and tracks."""
        for path in self.paths:
            yield Polyline(tuple(self.mechanism(place) for place in path), "construction")
        left, top, right, bottom = self.mechanism.rect
        inner = (left + EDGE, top + EDGE, right - EDGE, bottom - EDGE)
        drawings = [moment.alone for moment in self.motion.moments]
        yield from standing(drawings, replace(self.mechanism, rect=inner))

    def heading(self, moment: Frame) -> Iterator[Mark]:
        """The position of the driver, at the right of the title."""
        sweep, words = self.motion.cycle.sweep, self.words
        if sweep.driver is None:
            text = f"*t* = {words.significant(moment.at, 3)} s"
        else:
            name = angle_symbol(sweep.original, sweep.driver)
            if sweep.what == "turn":
                circle = self.motion.cycle.path.period or TURN
                angle = moment.at % circle if goes_round(self.motion.cycle) else moment.at
                text = f"{name} = {words.fixed(angle, 1)}°"
            else:
                scene = sweep.original
                place = words.significant(moment.at / scene.unit_length, 4)
                text = f"{name} = {place} {scene.units['length']}"
        yield Text(PICTURE[0] - 45, 7.5, text, "caption", LETTER)


def free_in(field: Field) -> Rect:
    """The part of a field for letters, below its caption."""
    left, top, right, bottom = field.rect
    return left, top + CAPTION, right, bottom


def stage(motion: FrameSequence, words: Words, *, beside: bool = False) -> Stage:
    """The stage of a motion: fields and scales that hold for the whole motion.

    The picture is divided so that the drawings are as large as possible. ``beside`` forces the
    mechanism to the left of its plans.
    """
    paths = tuple(paths_of(motion))
    places = [p for path in paths for p in path]
    box = extent_of([*places, *(p for moment in motion.moments for p in taken(moment.alone))])
    kinds = tuple(motion.moments[0].drawings)
    boxes = {kind: [plan_box(m.drawings[kind]) for m in motion.moments] for kind in kinds}
    ways = list(arrangements(len(kinds)))
    ways = ways[:: len(WAYS)] if beside else ways
    own, *others = max(ways, key=lambda rects: worth(rects, box, [*boxes.values()]))
    plans = {kind: posed(rect, boxes[kind]) for kind, rect in zip(kinds, others, strict=True)}
    return Stage(motion, words, mechanism_pane(own, box), plans, paths)


def taken(drawing: Drawing) -> Iterator[complex]:
    """The points that a mechanism occupies, including the corners of its wheels and blocks."""
    yield from drawing.positions.values()
    yield from drawing.corners()


def paths_of(motion: FrameSequence) -> Iterator[tuple[complex, ...]]:
    """The paths of the points of which anything is asked for."""
    cycle = motion.cycle
    ask, fixed = cycle.scene.ask, cycle.scene.fixed_points
    rows = np.isin(cycle.piece, range(1, len(cycle.path.ranges[0]) + 1))
    closes = cycle.sweep.whole and cycle.path.whole and cycle.path.returns
    for name in points_asked(ask):
        point = cycle.solution.points.get(name)
        if point is None or name in fixed or point.position is None or not rows.any():
            continue
        path = np.broadcast_to(point.position, len(rows))[rows]
        yield tuple(complex(z) for z in (np.append(path, path[:1]) if closes else path))


def scale_bar(field: Field, unit: str, size: float, words: Words) -> Iterator[Mark]:
    """The bar of a field's scale at its upper right, as long as a round number allows.

    It lies next to the caption, or below the caption in a narrow field.
    """
    left, top, right, _ = field.rect
    longest = min(BAR, (right - left) / 2 - 4) / field.mm / size
    number = next(preferred(longest / STEEPEST))
    length = number * size * field.mm
    x, y = right - 4 - length, top + (3.5 if right - left > WIDE else 8)
    yield LineMark(x, y, x + length, y, "frame")
    for end in (x, x + length):
        yield LineMark(end, y - 1, end, y + 1, "border")
    written = f"{words.decimal(f'{number:g}')} {escape(unit)}"
    yield Text(x - 2, y + 1, written, "caption", SMALL, "end")


def between(fields: Iterable[Field]) -> Iterator[Mark]:
    """The lines that separate the fields."""
    for left, top, right, bottom in (field.rect for field in fields):
        yield LineMark(left, top, right, top, "panel")
        if left > HEAD:
            yield LineMark(left, top, left, bottom, "panel")
