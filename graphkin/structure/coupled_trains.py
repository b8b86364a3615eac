"""Trains of wheels that hang together in a loop: planets in series on a free arm, coupled sets.

No wheel follows from known links alone. Once one link is tried, each of the others is turned by its
contact with the one before, and a contact with a known wheel says which trial is right.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from graphkin.structure.groups import CoupledTrain, Geared, TriedLink
from graphkin.structure.joints import Joints
from graphkin.structure.next_group import geared_of
from graphkin.structure.pairs import Contact, Pin


def next_coupled(joints: Joints, known: Collection[str]) -> CoupledTrain | None:
    """The train of fewest links that closes once one link on a known pin is tried."""
    found = (
        train
        for link in joints.unknown(known)
        for last in left_over(joints, known, link)
        if (train := closed(joints, known, link, last))
    )
    return min(found, key=lambda train: len(train.links), default=None)


def left_over(joints: Joints, known: Collection[str], tried: str) -> Iterator[Contact]:
    """The contacts with wheels of known links by which a trial of a link may be judged."""
    held = [pair for pair in joints.between(tried, known) if pair.taken == 2]
    if len(held) != 1 or not isinstance(held[0], Pin):
        return
    for link in joints.unknown(known):
        for pair in joints.between(link, known):
            if isinstance(pair, Contact) and pair.track is not None and pair.arm not in known:
                yield pair


def closed(
    joints: Joints, known: Collection[str], tried: str, last: Contact
) -> CoupledTrain | None:
    """The train that a tried link and a last contact make, wheel after wheel, if they make one."""
    grown, chain, ends = {*known, tried}, list[Geared](), {*last.links, last.arm}
    while not ends <= {*grown}:
        wheel = next_wheel(joints, grown, last)
        if wheel is None:
            return None
        chain.append(wheel)
        grown.add(wheel.link)
    needs, kept = ends, list[Geared]()
    for each in reversed(chain):
        if each.link in needs:
            kept.insert(0, each)
            needs = {*needs, each.contact.arm, *each.contact.links, *each.pair.links}
    pin = next(pair for pair in joints.between(tried, known) if pair.taken == 2)
    return CoupledTrain(TriedLink(tried, pin), tuple(kept), last) if tried in needs else None


def next_wheel(joints: Joints, known: Collection[str], last: Contact) -> Geared | None:
    """The first wheel, as written, that a wheel of a known link turns about a known pin."""
    for link in joints.unknown(known):
        joined = tuple(pair for pair in joints.between(link, known) if pair != last)
        wheel = geared_of(link, joined, known)
        if wheel and isinstance(wheel.pair, Pin) and wheel.contact.track is not None:
            return wheel
    return None
