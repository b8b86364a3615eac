"""Plans of groups whose wheels are pinned, at the instant, where they touch their tracks."""

from __future__ import annotations

from collections.abc import Callable

from graphkin.construction.core.bases import Base, bases, contact_name, leads_of, own_first, under
from graphkin.construction.core.pen import Pen
from graphkin.construction.guides.coincident_points import carried, omega_of
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.rolling import wheel_images
from graphkin.construction.rolling.rolling_normal import rolled_image
from graphkin.construction.rolling.touching import by_contact
from graphkin.structure.groups import Group, Higher
from graphkin.structure.pairs import Contact

Each = Callable[[Pen, LinkShapes, Group, tuple[Base, ...]], None]
"""How one group is put down in a plan."""


def move(pen: Pen, shapes: LinkShapes, group: Higher, each: Each) -> None:
    """The velocity plan: every wheel moves with its track where they touch."""
    for wheel in group.wheels:
        wheel_images.touched(pen, wheel.contact, wheel.own, wheel.known)
    for link in group.links:
        pen.leads.pop(link, None)
    for member in group.at_instant:
        found = tuple(map(own_first, bases(pen.scene, member)))
        pen.bases |= {base.link: base for base in found}
        pen.leads |= leads_of(member)
        each(pen, shapes, member, found)


def accelerate(pen: Pen, shapes: LinkShapes, group: Higher, each: Each) -> None:
    """The acceleration plan: there it moves against its track to its centre only."""
    for wheel in group.wheels:
        second_image_of_rim(pen, wheel.contact, wheel.own, wheel.known)
    for member in group.at_instant:
        each(pen, shapes, member, tuple(pen.bases[link] for link in member.links))


@by_contact
def second_image_of_rim(pen: Pen, contact: Contact, own: str, known: str) -> None:
    """The second image of a point of contact, from that of the point which it touches.

    A wheel's moves towards its centre, on a straight track with the square of its turning times its
    radius; a bar's away from the centre of the wheel on which the bar rolls.
    """
    name = contact_name(contact)
    start = carried(pen, known, name, "acceleration")
    rates, rim = (omega_of(pen, own), omega_of(pen, known)), under(name, own)
    if contact.track is not None:
        hubs = contact.wheel_of(own).centre, contact.wheel_of(known).centre
        rolled_image(pen, start, rim, (name, *hubs), rates)
    elif own == contact.links[0]:
        rolled_image(pen, start, rim, (name, contact.wheel.centre), rates)
    else:
        rolled_image(pen, start, rim, (contact.wheel.centre, name), rates[::-1], on_bar=True)
