"""Groups at an instant: a wheel turns on its track about the point in which it touches it.

A wheel turns as far as it rolls, so that a place needs a trial where the motion may need none.
"""

from __future__ import annotations

from collections.abc import Collection

from graphkin.scene.model import Driver
from graphkin.structure.groups import Group, Higher
from graphkin.structure.joints import Joints
from graphkin.structure.next_group import next_driven, next_group, next_stretched, settle
from graphkin.structure.pairs import Contact, ContactName, Pin


def pinned_wheels(joints: Joints, group: Higher, known: Collection[str]) -> tuple[Contact, ...]:
    """The contacts of a group's wheels with straight tracks of known links."""
    return tuple(
        pair
        for link in group.links
        for pair in joints.others[link]
        if isinstance(pair, Contact)
        and pair.arm is None
        and pair.track is None
        and pair.links[0] == link
        and pair.links[1] in known
    )


def rim_of(contact: Contact) -> Pin:
    """The pin about which a wheel turns on its track at the instant: its own point of contact."""
    wheel, on = contact.links
    return Pin(ContactName(f"{contact.letter}@{wheel}"), (wheel, on))


def groups_at_instant(
    joints: Joints,
    group: Higher,
    known: Collection[str],
    waiting: Collection[Driver],
    contacts: tuple[Contact, ...],
) -> tuple[Group, ...]:
    """The groups that construct the plans of a higher one, its wheels pinned where they touch.

    None where no wheel of it touches a known track, or where one would have to be tried all the
    same.
    """
    if not contacts:
        return ()
    pinned = joints.part(group.links).with_pins([(pair, rim_of(pair)) for pair in contacts])
    left = [each for each in waiting if {each.link, each.against} & {*group.links}]
    grown, found = {*known}, list[Group]()
    while not grown.issuperset(group.links):
        each = (
            next_driven(pinned, grown, left)
            or next_group(pinned, grown)
            or next_stretched(pinned, grown, left)
        )
        if each is None:
            return ()
        found.append(each)
        settle(each, grown, left)
    return () if left else tuple(found)
