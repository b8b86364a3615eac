"""Trains of wheels that hang together in a loop: planets in series on a free arm, coupled sets.

No wheel follows from known links alone. Once one link is tried, each of the others is turned by its
contact with the one before, and a contact with a known wheel says which trial is right.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from graphkin.scene.model import Scene
from graphkin.structure.groups import CoupledTrain, Geared, TriedLink
from graphkin.structure.joints import Joints, partner
from graphkin.structure.next_group import geared_of
from graphkin.structure.pairs import Contact, Pin

FREE = 1e-12
"""Rate of a miss, for one of the tried link, below which rounding alone makes it."""


def next_coupled(joints: Joints, known: Collection[str], idle: bool = False) -> CoupledTrain | None:
    """The train of fewest links that closes once one link on a known pin is tried.

    One whose ratios cancel closes in every place of the link and so says nothing of it: two planets
    between one sun and one ring. Such are found where ``idle`` is asked for, and no others.
    """
    contacts = [*left_over(joints, known)]
    if not contacts:
        return None
    found = (
        train
        for link in joints.unknown(known)
        for pin in pins_held(joints, known, link)
        for last in contacts
        if (train := closed(joints, known, TriedLink(link, pin), last))
        and idle == cancels(joints.scene, train)
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


def cancels(scene: Scene, train: CoupledTrain) -> bool:
    """Whether the last contact misses nothing however the tried link turns, by every parameter."""
    contacts = [*(each.contact for each in train.chain), train.last]
    radii = [w.radius for c in contacts for w in (c.wheel, c.track) if w and w.radius]
    names = sorted({name for radius in radii for name in radius.uses()} & {*scene.values})
    settings = [dict[str, Any](scene.values)]
    if names:
        more = {name: 1 + Fraction(1, 1009 + 2 * k) for k, name in enumerate(names)}
        settings.append({**settings[0], **{n: settings[0][n] * more[n] for n in names}})
    return all(abs(rate_missed(train, values)) < FREE for values in settings)


def rate_missed(train: CoupledTrain, values: Mapping[str, Any]) -> Any:
    """How fast the last contact slips while the tried link turns with rate one (Willis)."""
    rates: dict[str, Any] = {train.trial.link: 1}
    for wheel in train.chain:
        rates[wheel.link] = rate_rolled(wheel.contact, wheel.link, rates, values)
    own = train.closing
    return rates[own] - rate_rolled(train.last, own, rates, values)


def rate_rolled(
    contact: Contact, link: str, rates: Mapping[str, Any], values: Mapping[str, Any]
) -> Any:
    """The rate of a wheel from those of its arm and of the wheel that it touches."""
    sizes = dict(zip(contact.links, signed_radii(contact, values), strict=True))
    other = partner(contact, link)
    arm = rates.get(contact.arm or "", 0)
    return arm - (rates.get(other, 0) - arm) * sizes[other] / sizes[link]


def signed_radii(contact: Contact, values: Mapping[str, Any]) -> Sequence[Any]:
    """The radii of wheel and track, negative for a ring and where an open belt comes from."""
    belt = contact.rolling.belt
    found = []
    for wheel in (contact.wheel, contact.track):
        assert wheel is not None and wheel.radius is not None
        opposed = wheel.inside or (wheel is contact.track and belt is not None and not belt.crossed)
        found.append(wheel.radius.number(values) * (-1 if opposed else 1))
    return found
