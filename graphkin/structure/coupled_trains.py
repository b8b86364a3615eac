"""Trains of wheels that hang together in a loop: planets in series on a free arm, coupled sets.

No wheel follows from known links alone. Once one link is tried, each of the others is turned by its
contact with the one before, and a contact with a known wheel says which trial is right.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from graphkin.structure.groups import CoupledTrain, Geared, TriedLink
from graphkin.structure.joints import Joints, partner
from graphkin.structure.next_group import geared_of
from graphkin.structure.pairs import Contact, Pin


def next_coupled(joints: Joints, known: Collection[str]) -> CoupledTrain | None:
    """The train of fewest links that closes once one link on a known pin is tried."""
    contacts = [*left_over(joints, known)]
    if not contacts:
        return None
    found = (
        train
        for link in joints.unknown(known)
        for pin in pins_held(joints, known, link)
        for last in contacts
        if (train := closed(joints, known, TriedLink(link, pin), last))
    )
    return min(found, key=lambda train: len(train.links), default=None)


def left_over(joints: Joints, known: Collection[str]) -> Iterator[Contact]:
    """The contacts of wheels with known ones, about arms that do not stand yet."""
    for link in joints.unknown(known):
        for pair in joints.others[link]:
            if not isinstance(pair, Contact) or pair.track is None or pair.alike:
                continue
            if pair.arm in known:
                continue
            if partner(pair, link) in known:
                yield pair


def pins_held(joints: Joints, known: Collection[str], link: str) -> list[Pin]:
    """The one pin that holds a link, where nothing else that takes two freedoms does."""
    held = [pair for pair in joints.between(link, known) if pair.taken == 2]
    return [pair for pair in held if isinstance(pair, Pin)] if len(held) == 1 else []


def closed(
    joints: Joints, known: Collection[str], trial: TriedLink, last: Contact
) -> CoupledTrain | None:
    """The train that a tried link and a last contact make, wheel after wheel, if they make one."""
    grown, chain, ends = {*known, trial.link}, list[Geared](), {*last.links, last.arm}
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
    return CoupledTrain(trial, tuple(kept), last) if trial.link in needs else None


def next_wheel(joints: Joints, known: Collection[str], last: Contact) -> Geared | None:
    """The first wheel, as written, that a wheel of a known link turns about a known pin."""
    for link in joints.unknown(known):
        joined = tuple(pair for pair in joints.between(link, known) if pair != last)
        wheel = geared_of(link, joined, known)
        if wheel is None or wheel.contact.track is None or wheel.contact.alike:
            continue
        if isinstance(wheel.pair, Pin):
            return wheel
    return None
