"""Where a train stands whose wheels turn one another in a loop: how far the tried link has turned.

What the last contact misses grows in proportion to how far the tried link has turned (Willis).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from graphkin.construction.core.bases import bases
from graphkin.construction.core.determined import Determined
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import action, difference
from graphkin.construction.higher_class.higher import Each
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.links.placed_point import place_point
from graphkin.construction.links.plate_points import plate_points
from graphkin.construction.rolling.rolling import (
    rolled_on_wheel,
    rolled_to,
    seen_from,
    settle_turn,
    touch_wheels,
)
from graphkin.construction.rolling.touching import by_contact
from graphkin.numbers.arithmetic import Real, below, pick
from graphkin.structure.groups import CoupledTrain
from graphkin.structure.pairs import Contact
from graphkin.text.errors import Problem

FREE = 1e-12
"""Ratios that differ less than this leave the tried link free."""


class SettledTurn(Determined, frozen=True, kw_only=True):
    """The ``turn`` of a tried ``link``, which a contact settles with all wheels between."""

    gives: ClassVar[tuple[str, ...]] = ("turn",)
    has_angle: ClassVar[bool] = False

    link: str
    wheels: tuple[str, ...]
    turn: int

    def undetermined(self, args: Sequence[Any]) -> Problem:
        """The ratios of the wheels cancel."""
        return Problem(
            f"position of link {self.link}",
            f"the wheels of links {', '.join(self.wheels)} let link {self.link} turn as it likes",
            "ratios of the wheels that do not cancel",
            "change a wheel, or drive one link more",
        )


def position(pen: Pen, shapes: LinkShapes, group: CoupledTrain, each: Each) -> None:
    """The tried link at its angle, and one wheel after the other on its pin."""
    link, (base,) = group.trial.link, bases(pen.scene, group.trial)
    pen.bases[link] = base
    settle_turn(pen, link, turn_of_tried(pen, shapes, group))
    if base.end is not None:
        ends = shapes.local(link, base.start), shapes.local(link, base.end)
        with pen.on(Part.POSITION, Plane.MECHANISM):
            start, lead = pen.the("position", base.start), pen.the("axis", link)
            found = place_point(pen, link, (base.start, base.end), start, lead, *ends)
        pen.want("position", base.end, found)
    plate_points(pen, shapes, base)
    for wheel in group.chain:
        each(pen, shapes, wheel, bases(pen.scene, wheel))
    touch_last(pen, group.last)


@by_contact
def touch_last(pen: Pen, contact: Contact) -> None:
    """Where the wheels touch that close the train."""
    touch_wheels(pen, contact, contact.links[0])


@action("closing-turn")
def closing_turn(missed: Real, rate: Real) -> Real:
    """The angle at which a miss vanishes that grows at a ``rate`` from what nought misses.

    One that does not grow leaves the link free: it raises ZeroDivisionError on a scalar.
    """
    return -missed / pick(below(abs(rate), FREE), 0 * rate, rate)


def turn_of_tried(pen: Pen, shapes: LinkShapes, group: CoupledTrain) -> int:
    """How far the tried link has turned, in radians: where the last contact misses nothing."""
    own = group.closing
    with pen.on(Part.POSITION, Plane.NUMBERS):
        nought, one = pen.given("nought"), pen.given("one")
    turns, rates = {group.trial.link: nought}, {group.trial.link: one}
    for wheel in group.chain:
        turns[wheel.link] = rolled_to(pen, shapes, wheel.contact, wheel.link, turns)
        rates[wheel.link] = rate_rolled(pen, wheel.contact, wheel.link, rates)
    ends = rolled_to(pen, shapes, group.last, own, turns), rate_rolled(pen, group.last, own, rates)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        missed = pen.draw(difference, turns[own], ends[0])
        rate = pen.draw(difference, rates[own], ends[1])
        turn = pen.draw(closing_turn, missed, rate)
    wheels = tuple(wheel.link for wheel in group.chain)
    pen.make(SettledTurn(link=group.trial.link, wheels=wheels, turn=turn))
    return turn


@by_contact
def rate_rolled(pen: Pen, contact: Contact, link: str, rates: Mapping[str, int]) -> int:
    """How fast a wheel turns while only the links of some ``rates`` do (Willis)."""
    side = seen_from(pen, contact, link)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        found = (rates.get(each, pen.given("nought")) for each in (contact.arm or "", side.other))
        return pen.draw(rolled_on_wheel, *found, side.track_radius, side.radius)
