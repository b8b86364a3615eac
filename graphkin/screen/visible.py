"""What of the steps of a field is large enough, or near enough, to be seen at a place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from graphkin.arithmetic import smaller
from graphkin.paper.desk import TINY, Desk
from graphkin.paper.labels import Board
from graphkin.paper.layout import Layout
from graphkin.paper.letters import ends_of, is_coriolis
from graphkin.screen.binding import Bench
from graphkin.steps.program import Part, Plane, Step

ALIKE = 1e-6
"""Millimetres within which two places of the page are one."""


@dataclass(frozen=True)
class Seen:
    """The steps of one field, as they are drawn and while they move."""

    bench: Bench
    layout: Layout

    @property
    def desk(self) -> Desk:
        """The field as paper knows it, without any marks."""
        board = Board(self.bench.field.rect)
        return Desk(board, self.bench.field, self.bench.places.drawing, self.layout)

    def step(self, number: int) -> Step:
        """A step of the program."""
        return self.bench.places.trace.program.steps[number]

    def key(self, number: int) -> str:
        """The key of its action."""
        action = self.step(number).action
        return action.key if action else "given"

    def value(self, number: int) -> Any:
        """Its value while it moves."""
        return self.bench.places.values[number]

    def drawn(self, number: int) -> Any:
        """Its value where the scene stands."""
        return self.bench.places.drawing.trace.values[number]

    def seen(self, number: int) -> Any:
        """By how much a triangle on the mechanism is larger than what is drawn at all, in mm.

        None for what belongs to none.
        """
        step, spots = self.step(number), self.bench.places.spots
        if step.part is not Part.NORMAL or step.plane is not Plane.MECHANISM:
            return None
        if is_coriolis(step):
            return self.shortest(number)
        pin = spots.get(step.says.get("q", ""))
        if pin is None:
            return None
        ends = ends_of(self.bench.places.drawing, step)
        return smaller(*(self.apart(self.value(end), pin) for end in ends)) - TINY

    def shortest(self, number: int) -> Any:
        """The same of the similar triangles of a Coriolis component."""
        drawing = self.bench.places.drawing
        for user in sorted(drawing.trace.program.descendants(number)):
            if self.key(user) == "coriolis-by-hand":
                base, top = self.step(user).args[:2]
                pivot = self.step(self.step(top).args[1]).args[1]
                places = [self.value(each) for each in (base, top, pivot)]
                sides = self.apart(places[1], places[0]), self.apart(places[0], places[2])
                return smaller(*sides) - TINY
        return None

    def apart(self, one: Any, other: Any) -> Any:
        """How far two points stand apart on the page, in mm."""
        return abs(self.bench.shelf.lifted(one - other)) * self.bench.field.mm

    def within(self, point: Any, margin: float = 2.0) -> Any:
        """How far a point lies within what the field can grow to, less a margin, in mm."""
        left, top, right, bottom = self.bench.room
        place = self.bench.page(point)
        x, y = place.real, place.imag
        across = smaller(x - left, right - x)
        return smaller(across, smaller(y - top, bottom - y)) - margin + ALIKE
