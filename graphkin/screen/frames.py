"""The pictures of an animation as marks: mechanism and plans at scales fixed for all of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from graphkin.motion.sweep import TURN
from graphkin.paper.areas import Rect
from graphkin.paper.data import angle_symbol
from graphkin.paper.drawing import METRES, Drawing
from graphkin.paper.field import Field
from graphkin.paper.marks import Line, Mark, Polyline, Text
from graphkin.paper.richtext import escape, extent
from graphkin.paper.scale import Extent, extent_of, preferred
from graphkin.paper.sheet import title_of
from graphkin.plane import Vector
from graphkin.screen.grounds import standing
from graphkin.screen.moments import Moment, Motion, goes_round
from graphkin.screen.pictured import LETTER, mechanism_marks, plan_marks
from graphkin.text import Words

PICTURE = (240.0, 140.0)
"""Width and height of a picture in mm."""
HEAD = 11.0
"""Room for the title above the fields, in mm."""
AREA: Rect = (3.0, HEAD, PICTURE[0] - 3, PICTURE[1] - 3)
"""The part of a picture for all fields."""
ROOM = 13.0
"""Room around a drawing within its field, for letters and ground, in mm."""
CAPTION = 4.0
"""Room for the caption of a field, in mm, more than there is around its drawing."""
BAR = 30.0
"""Longest bar of a scale, in mm."""
STEEPEST = 2.5
"""Ratio of two round numbers that follow one another, at most."""
SMALL = 2.5
"""Height of captions, in mm."""
UNITS = {"velocity": "m/s", "acceleration": "m/s²"}
SHARES = (0.4, 0.5, 0.6, 0.7)
"""Parts of a picture that the mechanism may take."""


@dataclass(frozen=True)
class Stage:
    """Where mechanism and plans stand in every picture, and how large, so that nothing leaves.

    ``plans`` are the fields by kind. ``paths`` are those of points over the motion, in metres.
    """

    motion: Motion
    words: Words
    mechanism: Field
    plans: dict[str, Field]
    paths: tuple[tuple[complex, ...], ...]

    def moving(self, moment: Moment) -> list[Mark]:
        """The marks of one picture that another does not have."""
        marks = list(self.heading(moment))
        marks += mechanism_marks(moment.alone, self.mechanism)
        for kind, drawing in moment.drawings.items():
            marks += plan_marks(drawing, self.plans[kind])
        return marks

    @cached_property
    def still(self) -> list[Mark]:
        """What all pictures share: captions, scales, paths, lines between the fields."""
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
        """Each field with its name, the unit of its scale, and what that is in SI."""
        words, length = self.words, self.motion.cycle.scene.units["length"]
        yield self.mechanism, escape(words("animation.mechanism")), length, METRES[length]
        for kind, field in self.plans.items():
            yield field, escape(words(f"sheet.{kind}")), UNITS[kind], 1.0

    @property
    def ground(self) -> Iterator[Mark]:
        """What stands below the mechanism in every picture: paths, and what it slides on."""
        for path in self.paths:
            yield Polyline(tuple(self.mechanism(place) for place in path), "construction")
        yield from standing([moment.alone for moment in self.motion.moments], self.mechanism)

    def heading(self, moment: Moment) -> Iterator[Mark]:
        """Where the driver is, at the right of the title."""
        sweep, words = self.motion.cycle.sweep, self.words
        if sweep.driver is None:
            text = f"*t* = {words.significant(moment.at, 3)} s"
        else:
            name = angle_symbol(sweep.original, sweep.driver)
            if sweep.what == "turn":
                angle = moment.at % TURN if goes_round(self.motion.cycle) else moment.at
                text = f"{name} = {words.fixed(angle, 1)}°"
            else:
                unit = sweep.original.units["length"]
                text = f"{name} = {words.significant(moment.at / METRES[unit], 4)} {unit}"
        yield Text(PICTURE[0] - 45, 7.5, text, "caption", LETTER)


def stage(motion: Motion, words: Words, *, beside: bool = False) -> Stage:
    """Fields and scales that hold for a whole motion, as large as one arrangement lets them be.

    ``beside`` keeps the plans one above the other at the right of the mechanism.
    """
    paths = tuple(paths_of(motion))
    places = [p for path in paths for p in path]
    box = extent_of([*places, *(p for moment in motion.moments for p in taken(moment.alone))])
    kinds = tuple(motion.moments[0].drawings)
    plans = {kind: plan_extent(motion, kind) for kind in kinds}
    boxes = [box, *plans.values()]
    ways = list(arrangements(len(kinds)))
    ways = ways[:: len(WAYS)] if beside else ways
    found = max(ways, key=lambda rects: worth(rects, boxes))
    fields = [placed(rect, extent) for rect, extent in zip(found, boxes, strict=True)]
    return Stage(motion, words, fields[0], dict(zip(kinds, fields[1:], strict=True)), paths)


def taken(drawing: Drawing) -> Iterator[complex]:
    """The points that a mechanism takes up, with the corners of its wheels and blocks."""
    yield from drawing.positions.values()
    yield from drawing.corners()


def plan_extent(motion: Motion, kind: str) -> Extent:
    """The box of a plan over a whole motion, in its own unit."""
    points: list[complex] = []
    for moment in motion.moments:
        drawing = moment.drawings[kind]
        for _, step, value in drawing.steps(drawing.plane):
            if isinstance(value, Vector) and step.arrow:
                points += [value.tail, value.tip]
            elif step.name and isinstance(value, complex):
                points.append(value)
    return extent_of(points)


def paths_of(motion: Motion) -> Iterator[tuple[complex, ...]]:
    """The paths of the points whose velocities, accelerations or paths are asked."""
    import numpy as np

    cycle = motion.cycle
    ask, fixed = cycle.scene.ask, cycle.scene.frame.points
    rows = np.isin(cycle.piece, range(1, len(cycle.path.ranges[0]) + 1))
    closes = cycle.sweep.whole and cycle.path.whole and cycle.path.returns
    for name in dict.fromkeys((*ask.velocity, *ask.acceleration, *ask.curves)):
        point = cycle.solution.points.get(name)
        if point is None or name in fixed or point.position is None or not rows.any():
            continue
        path = np.broadcast_to(point.position, len(rows))[rows]
        yield tuple(complex(z) for z in (np.append(path, path[:1]) if closes else path))


def arrangements(plans: int) -> Iterator[list[Rect]]:
    """Ways to part a picture, the mechanism first, in the order of WAYS for each of its shares."""
    if not plans:
        yield [AREA]
        return
    for share in SHARES:
        for way in WAYS:
            yield way(share, plans)


def beside_plans(share: float, plans: int) -> list[Rect]:
    """The mechanism beside its plans, which stand one above the other."""
    left, top, right, bottom = AREA
    x, down = left + share * (right - left), (bottom - top) / plans
    return [
        (left, top, x, bottom),
        *((x, top + i * down, right, top + (i + 1) * down) for i in range(plans)),
    ]


def above_plans(share: float, plans: int) -> list[Rect]:
    """The mechanism above its plans, which stand side by side."""
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


def worth(rects: Sequence[Rect], boxes: Sequence[Extent]) -> float:
    """How large all drawings are together; the mechanism counts twice."""
    mm, *others = (scale_in(rect, box) for rect, box in zip(rects, boxes, strict=True))
    found = mm * mm
    for other in others:
        found *= other
    return found


def scale_in(rect: Rect, box: Extent) -> float:
    """Millimetres for each unit of a drawing at which it fits a field."""
    width, height = rect[2] - rect[0] - 2 * ROOM, rect[3] - rect[1] - 2 * ROOM - CAPTION
    size = max(box.width / width, box.height / height)
    return 1 / size if size > 0 else 1.0


def placed(rect: Rect, box: Extent) -> Field:
    """The field of a drawing, in the middle of its room below the caption."""
    middle = (rect[0] + rect[2]) / 2, (rect[1] + CAPTION + rect[3]) / 2
    return Field(rect, scale_in(rect, box), box.middle, middle)


def scale_bar(field: Field, unit: str, size: float, words: Words) -> Iterator[Mark]:
    """The bar of a field's scale at its foot, the longest round one."""
    left, _, right, bottom = field.rect
    longest = min(BAR, (right - left) / 2 - 4) / field.mm / size
    number = next(preferred(longest / STEEPEST))
    length = number * size * field.mm
    x, y = right - 4 - length, bottom - 3.5
    yield Line(x, y, x + length, y, "frame")
    for end in (x, x + length):
        yield Line(end, y - 1, end, y + 1, "border")
    written = f"{words.decimal(f'{number:g}')} {escape(unit)}"
    yield Text(x - 2, y + 1, written, "caption", SMALL, "end")


def between(fields: Iterable[Field]) -> Iterator[Mark]:
    """The lines that part the fields."""
    for left, top, right, bottom in (field.rect for field in fields):
        yield Line(left, top, right, top, "panel")
        if left > HEAD:
            yield Line(left, top, left, bottom, "panel")
