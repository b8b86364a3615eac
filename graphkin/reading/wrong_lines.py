"""Known wrong lines on which a student found a point of a plan, each with the sentence about it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from graphkin.construction.core.component import LaidOff
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction, PlanPole, construction, constructions
from graphkin.construction.core.naming import letter_at
from graphkin.construction.core.palette import PERPENDICULAR, KnownError
from graphkin.construction.core.program import Plane
from graphkin.numbers.plane import Line
from graphkin.web.your_turn import vector_on

PLANS = (Plane.VELOCITIES, Plane.ACCELERATIONS)


class FollowedThings:
    """The things that known errors start from (``ErrorPicks``), with a student's own values.

    A key holds one step, or both ends of a bar.
    """

    def __init__(self, drawing: Drawing, values: Mapping[int, Any]) -> None:
        self.drawing, self.values = drawing, values
        self.steps = drawing.trace.program.steps

    def point_or_line(self, number: int) -> str | None:
        return str(number) if number in self.values else None

    def bar(self, p: int, q: int) -> str | None:
        return f"{p}-{q}"

    def pole_of(self, number: int) -> str | None:
        """The pole of the plan in which a step lies."""
        own = self.steps[number].plane, self.steps[number].aside
        poles = (
            each
            for each, step in enumerate(self.steps)
            if isinstance(step.of, PlanPole) and (step.plane, step.aside) == own
        )
        return next(map(str, poles), None)

    def way(self, key: str) -> complex:
        """The direction of a bar or a line."""
        first, _, last = key.partition("-")
        if last:
            return complex(self.values[int(last)] - self.values[int(first)])
        return complex(self.values[int(first)].along)

    def name(self, key: str) -> str:
        """The letters of a bar or a point; empty for a line."""
        letters = (letter_at(self.drawing, int(end)) for end in key.split("-"))
        return "".join(self.drawing.symbol(letter) for letter in letters if letter)


def wrong_lines(drawing: Drawing, values: Mapping[int, Any]) -> Iterator[tuple[int, Line, str]]:
    """Each known wrong line: the step in whose place it is drawn, the line, and what is wrong.

    ``values`` are those that follow from a student's own points.
    """
    things = FollowedThings(drawing, values)
    for kind in constructions(drawing.trace.program, Construction):
        for error in kind.errors(things, things.steps):
            step = things.steps[error.line]
            if step.plane is not drawing.plane or error.line not in values:
                continue
            if step.plane in PLANS and None not in error.inputs:
                yield error.line, line_of(error, things), said(error, things)
    yield from turned_components(drawing, values)


def turned_components(
    drawing: Drawing, values: Mapping[int, Any]
) -> Iterator[tuple[int, Line, str]]:
    """Each line drawn from the end of a component that was laid off backwards."""
    steps = drawing.trace.program.steps
    for number, value in values.items():
        if steps[number].plane is not drawing.plane or not isinstance(value, Line):
            continue
        end = steps[number].args[0]
        laid = construction(steps[end])
        if isinstance(laid, LaidOff) and laid.component.turned and laid.start in values:
            back = Line(2 * values[laid.start] - values[end], value.along)
            yield number, back, drawing.words(laid.component.turned)


def line_of(error: KnownError, things: FollowedThings) -> Line:
    """The line of a known error."""
    start, along = (key for key in error.inputs if key is not None)
    way = things.way(along)
    return Line(things.values[int(start)], 1j * way if error.action is PERPENDICULAR else way)


def said(error: KnownError, things: FollowedThings) -> str:
    """The sentence about a known error."""
    start, along = (things.name(key) for key in error.inputs if key is not None)
    kind = construction(things.steps[error.line])
    about = vector_on(things.drawing, error.line, kind, start)
    return things.drawing.words(error.key, about=about, along=along, chosen=start)
