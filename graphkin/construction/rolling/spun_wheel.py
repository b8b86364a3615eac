"""A wheel, or a bar that rolls on a drum, whose own angle a driver gives; it moves its holder.

At the contact with a known link, both have the same velocity. The holder, an arm or a block on a
known pin, has turned by the angle that the rolling gives.
"""

from __future__ import annotations

from graphkin.construction.core.bases import bases, contact_name, leads_of, own_first
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import sum_of
from graphkin.construction.group_images import GroupImages
from graphkin.construction.guides.guides import turned_with
from graphkin.construction.higher_class.higher import Each
from graphkin.construction.links.plate_points import place_point
from graphkin.construction.links.rolled_turn import counted_near
from graphkin.construction.plan import VELOCITY, Plan
from graphkin.construction.rolling import rolling, wheel_images
from graphkin.construction.rolling.contact_points import by_contact
from graphkin.construction.rolling.rolling import arm_rolled, axis_turned
from graphkin.scene.link_points import under
from graphkin.structure.groups import Geared, Higher, Spun
from graphkin.structure.pairs import Pin, partner

# --- the mechanism -------------------------------------------------------------------------------


def place(pen: Pen, group: Spun) -> None:
    """Place the driven link at its angle, and its holder accordingly."""
    turn = rolling.angle_of(pen, group.link)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        if not pen.has("axis", group.link):
            pen.want("axis", group.link, pen.draw(axis_turned, turn))
    if isinstance(group.held, Pin):
        set_arm(pen, group, group.held.point, turn)
    else:
        turned_with(pen, group.held, group.link)
        with pen.on(Part.POSITION, Plane.NUMBERS):
            if group.holder in pen.scene.keepers:
                lean = pen.given("number", group.contact.rolling.angle)
                held = pen.draw(sum_of, turn, lean)
            else:
                axes = (pen.the("axis", each) for each in group.links)
                held = pen.draw(counted_near, *axes, turn)
            pen.want("turned", group.holder, held)
        rolling.rack(pen, as_rack(group), group.held)


@by_contact
def set_arm(pen: Pen, group: Spun, centre: str, turn: int) -> None:
    """Place the arm, turned about its pin, the wheel's centre, and the contact."""
    contact, arm, pivot = group.contact, group.holder, group.pivot.point
    side = rolling.seen_from(pen, contact, group.link)
    ends = turn, rolling.start_turn(pen, contact, group.link)
    since = rolling.turned_by(pen, contact, side.other)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        radii = side.track_radius, side.radius
        start = rolling.start_turn(pen, contact, arm)
        rolling.settle_turn(pen, arm, pen.draw(arm_rolled, *ends, since, start, *radii))
    place_point(pen, arm, pivot, centre)
    rolling.touch_wheels(pen, contact, group.link)


def as_rack(group: Spun) -> Geared:
    """A bar that slides on its holder, as the rack that its contact moves along the holder."""
    return Geared(group.link, group.held, group.contact)


# --- the plans -----------------------------------------------------------------------------------


def move(images: GroupImages, pen: Pen, group: Spun) -> None:
    """Draw a plan: the link's rate is given, and its contact moves with the other's point.

    The accelerations at the contact differ along the normal alone.
    """
    images.turn_driven(pen, group)
    if isinstance(group.held, Pin):
        move_centre(pen, group, group.held.point, images.plan)
    else:
        draw = wheel_images.geared if images.plan is VELOCITY else wheel_images.second_geared
        draw(pen, as_rack(group))


@by_contact
def move_centre(pen: Pen, group: Spun, centre: str, plan: Plan) -> None:
    """Draw the image of a wheel's centre from the image of its contact point."""
    contact, link = group.contact, group.link
    wheel_images.image_of_rim(plan, pen, contact, link, partner(contact, link))
    rim = under(contact_name(contact), link)
    wheel_images.turn_from_rim(pen, link, rim, centre, plan)


# --- wheels pinned at the instant where they touch their tracks -----------------------------------


def move_pinned(images: GroupImages, pen: Pen, group: Higher, each: Each) -> None:
    """Draw a plan of wheels pinned at their contacts.

    At a contact, both links have the same velocity, and their accelerations differ towards the
    centres only.
    """
    for wheel in group.wheels:
        wheel_images.image_of_rim(images.plan, pen, wheel.contact, wheel.own, wheel.known)
    for link in group.links:
        pen.leads.pop(link, None)
    for member in group.at_instant:
        found = tuple(map(own_first, bases(pen.scene, member)))
        pen.bases |= {base.link: base for base in found}
        pen.leads |= leads_of(member)
        each(pen, member, found)
