"""The position of a train whose wheels turn one another in a loop: the angle of the tried link.

The error at the last contact is linear in the angle of the tried link (Willis).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from graphkin.construction.core.bases import bases, contact_name
from graphkin.construction.core.crossings import Determined
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.vocabulary import action, difference
from graphkin.construction.higher_class.divided_point import (
    LineMisclosure,
    lacks_across,
    line_through,
)
from graphkin.construction.higher_class.higher import Each
from graphkin.construction.links.plate_points import place_point, plate_points
from graphkin.construction.plan import ACCELERATION, Plan
from graphkin.construction.rolling.contact_points import by_contact
from graphkin.construction.rolling.rolling import (
    rolled_on_wheel,
    rolled_to,
    seen_from,
    settle_turn,
    touch_wheels,
)
from graphkin.construction.velocity.image_of_link import image_under
from graphkin.drawing.symbol_markup import bar
from graphkin.numbers.arithmetic import Real, below, pick
from graphkin.scene.link_points import under
from graphkin.structure.groups import CoupledTrain, Higher
from graphkin.structure.pairs import Contact, SlippingName, partner
from graphkin.text.errors import Problem, Sought, message

FREE = 1e-12
"""Ratios that differ by less than this leave the tried link free."""


class ContactMisclosure(LineMisclosure, frozen=True, kw_only=True):
    """The gap at a contact, across its radius, between the images of both wheels.

    ``ends`` are the ends of the radius, ``start`` is the known wheel's image and ``tip`` the other
    wheel's image.
    """

    ends: tuple[str, str]

    def fields(self, drawing: Drawing) -> tuple[str, Mapping[str, str]]:
        """The known wheel's image; for accelerations, the parallel to the radius through it."""
        start = drawing.lettered(self.start)
        key = "image" if drawing.kind == "velocity" else "radius"
        return key, {"bar": bar(*self.ends), "s": start}


class SettledTurn(Determined, frozen=True, kw_only=True):
    """The ``turn`` of a tried ``link``, which a contact determines through all wheels between."""

    has_angle: ClassVar[bool] = False

    link: str
    wheels: tuple[str, ...]
    turn: OwnStep

    def undetermined(self, args: Sequence[Any]) -> Problem:
        """The problem of wheel ratios that cancel."""
        return Problem(
            message("position of link {link}", link=self.link),
            message(
                "the wheels of links {wheels} let link {link} turn as it likes",
                wheels=", ".join(self.wheels),
                link=self.link,
            ),
            message("ratios of the wheels that do not cancel"),
            message("change a wheel, or drive one link more"),
            about=(Sought((self.link,)),),
        )


def position(pen: Pen, group: CoupledTrain, each: Each) -> None:
    """Place the tried link at its angle, then each wheel on its pin."""
    link, (base,) = group.tried.link, bases(pen.scene, group.tried)
    pen.bases[link] = base
    settle_turn(pen, link, turn_of_tried(pen, group))
    if base.end is not None:
        place_point(pen, link, base.start, base.end)
    plate_points(pen, base)
    for wheel in group.chain:
        each(pen, wheel, bases(pen.scene, wheel))
    touch_last(pen, group.last)


@by_contact
def touch_last(pen: Pen, contact: Contact) -> None:
    """Place the contact point of the wheels that close the train."""
    touch_wheels(pen, contact, contact.links[0])


@action("closing-turn")
def closing_turn(missed: Real, rate: Real) -> Real:
    """The angle at which an error is zero, if the error is ``missed`` at angle zero.

    The error grows by ``rate`` per radian. A rate of zero leaves the link free: raises
    ZeroDivisionError on a scalar.
    """
    return -missed / pick(below(abs(rate), FREE), 0 * rate, rate)


def turn_of_tried(pen: Pen, group: CoupledTrain) -> int:
    """The angle of the tried link, in radians, at which the error at the last contact is zero."""
    own = group.closing
    with pen.on(Part.POSITION, Plane.NUMBERS):
        zero, one = pen.given("zero"), pen.given("one")
    turns, rates = {group.tried.link: zero}, {group.tried.link: one}
    for wheel in group.chain:
        turns[wheel.link] = rolled_to(pen, wheel.contact, wheel.link, turns)
        rates[wheel.link] = rate_rolled(pen, wheel.contact, wheel.link, rates)
    ends = rolled_to(pen, group.last, own, turns), rate_rolled(pen, group.last, own, rates)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        missed = pen.draw(difference, turns[own], ends[0])
        rate = pen.draw(difference, rates[own], ends[1])
        turn = pen.draw(closing_turn, missed, rate)
    wheels = tuple(wheel.link for wheel in group.chain)
    pen.make(SettledTurn(link=group.tried.link, wheels=wheels, turn=turn))
    return turn


@by_contact
def rate_rolled(pen: Pen, contact: Contact, link: str, rates: Mapping[str, int]) -> int:
    """The rate at which a wheel turns while only the links of ``rates`` turn (Willis)."""
    side = seen_from(pen, contact, link)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        found = (rates.get(each, pen.given("zero")) for each in (contact.arm or "", side.other))
        return pen.draw(rolled_on_wheel, *found, side.track_radius, side.radius)


# --- in the plans --------------------------------------------------------------------------------


def known_rims(pen: Pen, group: CoupledTrain, plan: Plan) -> dict[str, int]:
    """Draw the images of known wheels at their contacts with the train, before the train's own.

    For velocities, the last image is returned under the name of the point of the train's own last
    wheel, which has the same image.
    """
    for contact in (*(wheel.contact for wheel in group.chain), group.last):
        for link in {*contact.links} - {*group.links}:
            rim = image_under(pen, link, contact_name(contact), plan)
    if plan is ACCELERATION:
        return {}
    return {under(contact_name(group.last), group.closing): rim}


def missed(pen: Pen, group: CoupledTrain | Higher, plan: Plan) -> ContactMisclosure:
    """The misclosure of a plan at the last contact of two links, across the radius.

    The contact must not slip. In a group that is no train, each link has its own image there.
    """
    contact, own = group.last, group.closing
    assert isinstance(contact, Contact)
    name = contact_name(contact)
    if isinstance(group, Higher):
        name = SlippingName(name)
    wheel = contact.wheel if contact.track is None else contact.wheel_of(own)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        radius = (pen.the("position", point) for point in (wheel.centre, name))
        normal = pen.draw(line_through, *radius)
    start, tip = (image_under(pen, x, name, plan) for x in (partner(contact, own), own))
    with pen.on(plan.part, Plane.NUMBERS):
        size = pen.draw(lacks_across, normal, start, tip)
    ends = letter(wheel.centre), letter(name)
    return ContactMisclosure(size=size, ends=ends, along=normal, start=start, tip=tip)
