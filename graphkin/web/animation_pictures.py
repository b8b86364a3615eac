"""The pictures of an animation as marks: mechanism and plans at scales fixed for all of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import METRES, Drawing
from graphkin.construction.core.naming import angle_symbol
from graphkin.construction.core.quantities import MOTION
from graphkin.documents.sheet import title_of
from graphkin.drawing.areas import Rect
from graphkin.drawing.field import Field
from graphkin.drawing.marks import LineMark, Mark, Polyline, Text
from graphkin.drawing.richtext import extent
from graphkin.drawing.scale import extent_of, preferred
from graphkin.drawing.symbol_markup import escape
from graphkin.motion.driving import TURN
from graphkin.numbers.arrays import np
from graphkin.text import Words
from graphkin.web.fixed_parts import standing
from graphkin.web.frame_marks import cut, driver_marks, mechanism_seen, plan_box, plan_seen
from graphkin.web.frames import Frame, FrameSequence, goes_round
from graphkin.web.moving_labels import FAR, LETTER, Rule, lettering, rules_over
from graphkin.web.panes import (
    CAPTION,
    HEAD,
    PICTURE,
    WAYS,
    arrangements,
    leaves,
    mechanism_pane,
    plan_pane,
    posed,
    worth,
)

BAR = 30.0
"""Longest bar of a scale, in mm."""
WIDE = 85.0
"""Width of a field, in mm, in which caption and bar stand side by side."""
STEEPEST = 2.5
"""Ratio of two round numbers that follow one another, at most."""
SMALL = 2.5
"""Height of captions, in mm."""
TRIED = 16
"""Moments over which the places of letters are chosen."""
EDGE = 3.0
"""Guides and tracks end so far within the edge of their field, in mm."""
MECHANISM = "mechanism"
"""The name of the field of the mechanism, beside those of the kinds of plans."""


class Stage(Struct, frozen=True, dict=True):
    """Where mechanism and plans stand in every picture, and how large.

    ``plans`` are the fields by kind, where the pole need not move aside. ``paths`` are those of
    points over the motion, in metres.
    """

    motion: FrameSequence
    words: Words
    mechanism: Field
    plans: dict[str, Field]
    paths: tuple[tuple[complex, ...], ...]

    def moving(self, moment: Frame) -> list[Mark]:
        """The marks of one picture that another does not have."""
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
        """The word at the foot of a plan that is larger than its pane."""
        return Text(field.rect[0] + 3, field.rect[3] - 2, self.beyond, "caption", SMALL)

    @property
    def beyond(self) -> str:
        """That a plan leaves its pane, as markup."""
        return escape(self.words("animation.beyond"))

    @cached_property
    def rules(self) -> dict[str, dict[str, Rule]]:
        """Where letters stand, for the mechanism and for each kind of plan."""
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
            yield field, escape(words(f"sheet.{kind}")), MOTION[kind].unit, 1.0

    @property
    def ground(self) -> Iterator[Mark]:
        """What stands below the mechanism in every picture: paths, and what it slides on."""
        for path in self.paths:
            yield Polyline(tuple(self.mechanism(place) for place in path), "construction")
        left, top, right, bottom = self.mechanism.rect
        inner = (left + EDGE, top + EDGE, right - EDGE, bottom - EDGE)
        drawings = [moment.alone for moment in self.motion.moments]
        yield from standing(drawings, replace(self.mechanism, rect=inner))

    def heading(self, moment: Frame) -> Iterator[Mark]:
        """Where the driver is, at the right of the title."""
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
                unit = sweep.original.units["length"]
                text = f"{name} = {words.significant(moment.at / METRES[unit], 4)} {unit}"
        yield Text(PICTURE[0] - 45, 7.5, text, "caption", LETTER)


def free_in(field: Field) -> Rect:
    """The part of a field for letters, below its caption."""
    left, top, right, bottom = field.rect
    return left, top + CAPTION, right, bottom


def stage(motion: FrameSequence, words: Words, *, beside: bool = False) -> Stage:
    """The stage of a motion: fields and scales that stay as they are over all of it.

    The picture is parted in the way in which the drawings are largest; ``beside`` has the
    mechanism beside its plans in any case.
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
    """The points that a mechanism takes up, with the corners of its wheels and blocks."""
    yield from drawing.positions.values()
    yield from drawing.corners()


def paths_of(motion: FrameSequence) -> Iterator[tuple[complex, ...]]:
    """The paths of the points whose velocities, accelerations or paths are asked."""
    cycle = motion.cycle
    ask, fixed = cycle.scene.ask, cycle.scene.fixed_points
    rows = np.isin(cycle.piece, range(1, len(cycle.path.ranges[0]) + 1))
    closes = cycle.sweep.whole and cycle.path.whole and cycle.path.returns
    for name in dict.fromkeys((*ask.velocity, *ask.acceleration, *ask.curves)):
        point = cycle.solution.points.get(name)
        if point is None or name in fixed or point.position is None or not rows.any():
            continue
        path = np.broadcast_to(point.position, len(rows))[rows]
        yield tuple(complex(z) for z in (np.append(path, path[:1]) if closes else path))


def scale_bar(field: Field, unit: str, size: float, words: Words) -> Iterator[Mark]:
    """The bar of a field's scale at its upper right, the longest round one.

    It stands beside the caption, or below where that leaves no room.
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
    """The lines that part the fields."""
    for left, top, right, bottom in (field.rect for field in fields):
        yield LineMark(left, top, right, top, "panel")
        if left > HEAD:
            yield LineMark(left, top, left, bottom, "panel")
