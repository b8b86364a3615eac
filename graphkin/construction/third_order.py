"""The jerk of points: the steps of the acceleration plan, followed once more with their rates.

The rate of a step follows from its inputs and their rates by the chain rule. Where the program has
constructed a rate, such as the velocity of a position, that step serves. A jerk has no plan.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

from msgspec import Struct

from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import EPSILON, JERK, KINDS, OMEGA, RATES, SLIDING
from graphkin.construction.core.vocabulary import Action, action
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.dual_numbers import at_rest, rate_of, with_rate
from graphkin.scene.link_points import ends_of, is_under
from graphkin.structure.pairs import Pin, Sliding

RATE = "rate"
"""The key of a step that gives the rate of another."""
FOLLOWING = [
    *pairwise(KINDS),
    tuple(each.target for each in RATES),
    *pairwise(SLIDING[kind].target for kind in KINDS),
]
"""Targets with those that are their rates."""


class StepRate(Struct, frozen=True):
    """The rate of an action, from its inputs, then the rates of those that are ``moved``."""

    action: Action
    count: int
    moved: tuple[int, ...]

    def __call__(self, *args: Any) -> Any:
        """The rate of the action's value."""
        inputs = [at_rest(value) for value in args[: self.count]]
        rates, extra = args[self.count :][: len(self.moved)], args[self.count + len(self.moved) :]
        for place, rate in zip(self.moved, rates, strict=True):
            inputs[place] = with_rate(args[place], rate)
        return rate_of(self.action.value(*inputs, *extra))


@action("rate-of-direction")
def rate_of_direction(direction: Point, omega: Real) -> Point:
    """The rate of a driver's direction."""
    return 1j * direction * omega


@action("jerk-of-link-under")
def jerk_of_link_under(
    rate: Point, omega: Real, epsilon: Real, velocity: Point, under: Point
) -> Point:
    """The jerk of the point of a link under another, which moves along the link.

    ``rate`` is that of the acceleration under the moving point. It holds the share (iε - ω²)·v_r
    of the points that it passes, which does not belong to the jerk of one of them.
    """
    slip = velocity - under
    return rate - 1j * slip * epsilon + slip * omega * omega


def draw_jerks(pen: Pen) -> None:
    """Write the jerk of every point that asks for it."""
    names = pen.scene.ask.jerk
    ends = [pen.the("acceleration", name) for name in names]
    aside = {name: shares(pen, name) for name in names if is_under(name)}
    with pen.on(Part.RESULT, Plane.NUMBERS), pen.calls_for("jerk"):
        rates = Rates(pen, ends)
        for name, end in zip(names, ends, strict=True):
            found = rates.found.get(end)
            number = pen.given("origin") if found is None else found
            if name in aside:
                number = pen.draw(jerk_of_link_under, number, *aside[name])
            pen.want(JERK, name, number)


def shares(pen: Pen, name: str) -> tuple[int, ...]:
    """The rotation of the link of A@3, and the velocities of A and of the point under A."""
    point, link = ends_of(name)
    rotation = (pen.the(OMEGA, link), pen.the(EPSILON, link))
    return (*rotation, pen.the("velocity", point), pen.the("velocity", name))


class Rates:
    """The steps that hold the rates of others; a step at rest has none."""

    def __init__(self, pen: Pen, ends: list[int]) -> None:
        self.pen = pen
        self.found: dict[int, int | None] = {}
        self.known = self.constructed()
        for number in self.waiting(ends):
            self.found[number] = self.known[number] if number in self.known else self.drawn(number)

    def constructed(self) -> Mapping[int, int | None]:
        """The rates that the program has: of drivers, points, links and blocks.

        A centre of curvature moves on its cam. Its velocity is that of the cam there, not its rate.
        """
        pen, scene = self.pen, self.pen.scene
        unseen = {*scene.cam_centres, *scene.cam_links}
        found: dict[int, int | None] = {}
        for drive in pen.drives.values():
            driver = scene.drivers[drive.driver]
            found[drive.position] = drive.speed
            if driver.kind == "turn":
                found[drive.position] = pen.draw(rate_of_direction, drive.position, drive.speed)
            if drive.angle is not None:
                found[drive.angle] = drive.speed
            found[drive.speed] = drive.acceleration
            found[drive.acceleration] = pen.given("number", driver.jerk, of=drive.driver)
        for step in [*pen.steps]:
            if step.closes and isinstance(step.of, ClosedGroup):
                found |= dict(self.trials(step.of))
        pole = [pen.pole(plane) for plane in (Plane.VELOCITIES, Plane.ACCELERATIONS)]
        for target, rate in FOLLOWING:
            for (what, of), number in pen.targets.items():
                if what == target and of not in unseen and not is_under(of):
                    own = pen.targets.get((rate, of))
                    if own is not None:
                        found.setdefault(number, None if own in pole else own)
        return found

    def trials(self, closed: ClosedGroup) -> Iterator[tuple[int, int | None]]:
        """The rates of the trial values of a group that closes, and of its dyads' signs."""
        for one, number in zip(closed.group.nested, closed.tried, strict=True):
            link, pair = one.tried.link, one.tried.pair
            if isinstance(pair, Pin):
                omega = self.pen.the(OMEGA, link)
                yield number, self.pen.draw(rate_of_direction, number, omega)
            elif isinstance(pair, Sliding):
                yield number, self.pen.the(SLIDING["velocity"].target, pair.block)
        yield from ((number, None) for number in closed.sides)

    def waiting(self, ends: list[int]) -> list[int]:
        """The steps without a constructed rate behind some steps, in order."""
        wanted, left = set[int](), [*ends]
        while left:
            number = left.pop()
            if number not in wanted:
                wanted.add(number)
                if number not in self.known:
                    left += self.pen.steps[number].args
        return sorted(wanted)

    def drawn(self, number: int) -> int | None:
        """The step with the rate of another; None where it is at rest."""
        step = self.pen.steps[number]
        moved = tuple(i for i, arg in enumerate(step.args) if self.found[arg] is not None)
        if step.action is None or not moved:
            return None
        rates = [self.found[step.args[i]] for i in moved]
        rate = Action(RATE, StepRate(step.action, len(step.args), moved))
        return self.pen.draw(
            rate, *step.args, *(n for n in rates if n is not None), extra=step.extra
        )
