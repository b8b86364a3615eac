"""A small picture at a smaller scale for a centre or pole that lies off its field."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin import plane
from graphkin.paper.drawing import Drawing
from graphkin.paper.field import XY, Field
from graphkin.paper.free import free_disc
from graphkin.paper.labels import Board, Label
from graphkin.paper.marks import Circle, Line, Mark, Text, box
from graphkin.paper.paths import ring
from graphkin.paper.scale import Scales, extent_of, preferred
from graphkin.paper.symbolic import symbol
from graphkin.plane import Ratio
from graphkin.steps.program import Part, Step

WIDTH, HEIGHT = 46.0, 30.0
"""Size of an inset in mm."""
EDGE = 8.0
"""Room inside an inset for names, in mm."""
FARTHEST = 200.0
"""A centre this many times farther than the field is wide is only named, not shown."""


def insets(drawing: Drawing, field: Field, marks: Sequence[Mark]) -> list[Mark]:
    """The insets of a mechanism's field, each where there is a free place for it."""
    found: list[Mark] = []
    for _, step, value in drawing.mechanism_steps():
        if step.part not in (Part.CENTRE, Part.POLE) or not isinstance(value, Ratio):
            continue
        point = drawing.place(value)
        if point is None or field.holds(point, 2.0):
            continue
        if abs(point - value.start) * field.mm > FARTHEST * (field.rect[2] - field.rect[0]):
            continue
        room = (WIDTH**2 + HEIGHT**2) ** 0.5 / 2 + 2
        disc = free_disc([*marks, *found], field.rect, field.at, room)
        if disc is not None:
            found += inset(drawing, step, point, disc.at)
    return found


def inset(drawing: Drawing, step: Step, centre: complex, at: XY) -> Iterator[Mark]:
    """The lines that find a far centre from where they begin, at a preferred scale."""
    lines = lines_to(drawing, step)
    if not lines:
        return
    circle = circle_on(drawing, step)
    around = ring(circle) if circle else []
    extent = extent_of([*(end for line in lines for end in line.values()), centre, *around])
    least = 1000 * max(extent.width / (WIDTH - 2 * EDGE), extent.height / (HEIGHT - 2 * EDGE))
    kL = next(preferred(least))
    rect = (at[0] - WIDTH / 2, at[1] - HEIGHT / 2, at[0] + WIDTH / 2, at[1] + HEIGHT / 2)
    field = Field(rect, 1000 / kL, extent.middle, at)
    board = Board(rect)
    far = field(centre)
    firsts = [field(next(iter(line.values()))) for line in lines]
    board.marks = [
        box(rect[0], rect[1], WIDTH, HEIGHT, "panel"),
        *base_of(drawing, step, firsts),
        *(Line(*first, *far, "ray inset") for first in firsts),
        *around_of(circle, field, drawing.kind),
        *(Circle(*field(end), 0.5, "point inset") for line in lines for end in line.values()),
        Circle(*far, 0.9, f"centre {drawing.kind} inset"),
        Text(rect[2] - 1.5, rect[3] - 1.5, Scales(kL, 1.0).words, "caption", 2.5, "end"),
    ]
    names = {name: end for line in lines for name, end in line.items()}
    board.labels = [Label(symbol(name), "", field(end), 2.5) for name, end in names.items()]
    board.labels.append(Label(symbol(step.name), drawing.kind, far, 2.5, radius=0.9))
    yield from board.marks
    yield from board.placed()


def base_of(drawing: Drawing, step: Step, ends: Sequence[XY]) -> Iterator[Mark]:
    """The base of a link between the two points whose rays find its centre."""
    if "q" in step.says:
        (x0, y0), (x1, y1) = ends
        yield Line(x0, y0, x1, y1, "link inset")


def circle_on(drawing: Drawing, step: Step) -> plane.Circle | None:
    """The inflection circle on which a far inflection pole lies."""
    children = drawing.children.get(number_of(drawing, step), ())
    values = (drawing.trace.values[child] for child in children)
    return next((value for value in values if isinstance(value, plane.Circle)), None)


def around_of(circle: plane.Circle | None, field: Field, kind: str) -> Iterator[Mark]:
    """The inflection circle."""
    if circle is not None:
        yield Circle(*field(circle.centre), circle.radius * field.mm, f"inflection {kind} inset")


def lines_to(drawing: Drawing, step: Step) -> list[dict[str, complex]]:
    """For each line to a centre the places on it by name, the farthest from the centre first."""
    if "q" in step.says:
        return [{step.says[key]: drawing.standing.spot(step.says[key])} for key in ("p", "q")]
    values, steps = drawing.trace.values, drawing.trace.program.steps
    if step.by_hand is None or step.by_hand not in values:
        return []
    found = []
    centre = drawing.place(values[number_of(drawing, step)])
    for line in steps[step.by_hand].args:
        names = {steps[arg].name: values[arg] for arg in steps[line].args}
        places = {n: drawing.place(v) for n, v in names.items() if isinstance(v, Ratio)}
        if not places:
            first = steps[line].args[0]
            places = {steps[first].name or steps[line].says["p"]: values[first]}
        known = {name: place for name, place in places.items() if place is not None}
        if centre is None or not known:
            return []
        found.append(dict(sorted(known.items(), key=lambda item: -abs(item[1] - centre))))
    return found


def number_of(drawing: Drawing, step: Step) -> int:
    """The number of a step in its program."""
    return drawing.trace.program.steps.index(step)
