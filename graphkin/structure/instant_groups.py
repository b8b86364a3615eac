"""Groups at an instant: a wheel turns on its track about the point in which it touches it.

A wheel turns as far as it rolls, so that a place needs a trial where the motion may need none.
"""

from __future__ import annotations

from collections.abc import Collection

from graphkin.scene.model import Driver
from graphkin.structure.groups import Dyad, Group, Higher, Tie
from graphkin.structure.joints import Joints, partner
from graphkin.structure.next_group import (
    next_driven,
    next_group,
    next_stretched,
    next_tie,
    settle,
)
from graphkin.structure.pairs import Contact, ContactName, Joint, Pin


def pinned_wheels(joints: Joints, group: Higher, known: Collection[str]) -> tuple[Contact, ...]:
    """The contacts of a group's wheels, or bars, with what is known and they roll on.

    What keeps them there, if a link does, belongs to the group. A contact from which no place of it
    follows is left out: it is idle, or the mechanism is held fast, which the rank tells.
    """
    placing = [group.trial.pair, *outer_pairs(group)]
    return tuple(
        pair
        for link in group.links
        for pair in joints.others[link]
        if isinstance(pair, Contact)
        and pair.rolling.belt is None
        and pair in placing
        and partner(pair, link) in known
        and (pair.arm in group.links or (pair.track is None and pair.links[0] == link))
    )


def outer_pairs(group: Higher) -> list[Joint]:
    """The pairs by which the parts of a group hang on what is known before them."""
    parts = (*group.chain, group.last) if isinstance(group.last, Tie) else group.chain
    contacts = [pair for part in parts for pair in getattr(part, "contacts", ())]
    return [*contacts, *(pair for part in parts for pair in getattr(part, "outer", ()))]


def rim_of(contact: Contact, known: Collection[str]) -> Pin:
    """The pin about which a wheel turns on its track at the instant: its own point of contact."""
    on, own = sorted(contact.links, key=lambda link: link not in known)
    return Pin(ContactName(f"{contact.letter}@{own}"), (own, on))


def groups_at_instant(
    joints: Joints,
    group: Higher,
    known: Collection[str],
    waiting: Collection[Driver],
    contacts: tuple[Contact, ...],
) -> tuple[Group, ...]:
    """The groups that construct the plans of a higher one, its wheels pinned where they touch.

    None where no wheel of it touches a known track, or where one would have to be tried all the
    same; nor where an arm and its wheel would close as a dyad, for its three pins lie in line.
    """
    if not contacts:
        return ()
    pinned = joints.part(group.links).with_pins([(pair, rim_of(pair, known)) for pair in contacts])
    left = [each for each in waiting if {each.link, each.against} & {*group.links}]
    in_line = [{*pair.links, pair.arm} for pair in contacts]
    grown, found = {*known}, list[Group]()
    while not grown.issuperset(group.links):
        each = (
            next_driven(pinned, grown, left)
            or next_group(pinned, grown)
            or next_stretched(pinned, grown, left)
            or next_tie(pinned, grown)
        )
        if each is None:
            return ()
        if isinstance(each, Dyad) and any({*each.links} <= three for three in in_line):
            return ()
        found.append(each)
        settle(each, grown, left)
    return () if left else tuple(found)
