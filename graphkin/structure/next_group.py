"""The next group that what is known lets one construct: driven links, dyads, trains, ties."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import combinations

from msgspec.structs import replace

from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME, Driver, Scene, Slide
from graphkin.scene.quantity import exact
from graphkin.structure.groups import (
    CamFollower,
    Crank,
    Cylinder,
    Driven,
    Dyad,
    Group,
    Higher,
    OnTwoPins,
    Spun,
    Stretched,
    Tie,
)
from graphkin.structure.joints import Joints, partner
from graphkin.structure.pairs import Joint, Pair, Pin, PinLine, Sliding
from graphkin.structure.turning import LEVEL, guide_on
from graphkin.structure.wheel_groups import by_centres, geared_of, spun, train_with, turned_wheel


def settle(group: Group, known: set[str], waiting: list[Driver]) -> None:
    """The group's links are known now, and its drivers used."""
    known.update(group.links)
    if isinstance(group, Higher):
        for each in group.chain:
            settle(each, known, waiting)
        if isinstance(group.last, Driver):
            waiting.remove(group.last)
    elif isinstance(group, Crank | Driven | Spun):
        waiting.remove(group.driver)
    elif isinstance(group, Stretched):
        for driver in group.drivers:
            waiting.remove(driver)


def next_driven(joints: Joints, known: Collection[str], waiting: list[Driver]) -> Group | None:
    """The first link, as its driver is written, that a known one drives."""
    for driver in waiting:
        for link, against in ((driver.link, driver.against), (driver.against, driver.link)):
            if link in known or against not in known:
                continue
            group = driven_by(joints, known, driver, link, against)
            if group is not None:
                return group
    return None


def driven_by(
    joints: Joints, known: Collection[str], driver: Driver, link: str, against: str
) -> Crank | Driven | Spun | None:
    """The group of one driven link: a crank about any known pin, or along its own guide."""
    if driver.kind == "turn":
        pins = [pair for pair in joints.between(link, known) if isinstance(pair, Pin)]
        if pins:
            return Crank(link, driver, pins[0].point)
        return turned_wheel(joints, driver, link) or spun(joints, known, driver, link)
    for pair in joints.between(link, (against,)):
        if isinstance(pair, Pin) or pair.moved_by != driver.kind:
            continue
        if pair.links[0] == driver.link:
            return Driven(link, driver, pair)
    return None


def next_group(joints: Joints, known: Collection[str]) -> Group | None:
    """The first dyad or geared wheel, as written, that closes on known links."""
    for first in joints.unknown(known):
        left = joints.between(first, known)
        if not left:
            continue
        if geared := geared_of(first, left, known):
            return geared
        if dyad := dyad_with(joints, known, first, left):
            return CamFollower(dyad) if {*dyad.links} & joints.scene.cam_links.keys() else dyad
        if train := train_with(joints, known, first, left):
            return train
    return None


def dyad_with(
    joints: Joints, known: Collection[str], first: str, left: tuple[Joint, ...]
) -> Dyad | None:
    """The dyad of a link with the first of its neighbours that is joined to known links too."""
    if len(left) != 1 or left[0].taken != 2:
        return None
    for second in joints.neighbours(first):
        if second in known:
            continue
        inner = joints.inner(first, second, known)
        right = joints.between(second, known)
        if len(inner) == len(right) == 1 and inner[0].taken == right[0].taken == 2:
            dyad = Dyad((first, second), left[0], inner[0], right[0])
            if can_close(joints.scene, dyad):
                return in_order(dyad)
    return None


def can_close(scene: Scene, dyad: Dyad) -> bool:
    """False for slides that leave the group loose: three of them, or two along one direction of
    their link; and for wheels pinned off centre."""
    if dyad.type == "PPP" or not by_centres(dyad.inner, dyad.outer, dyad.links):
        return False
    inner = dyad.inner
    ends = zip(dyad.links, dyad.outer, strict=True)
    led = [(link, pair) for link, pair in ends if isinstance(pair, Sliding)]
    if not isinstance(inner, Sliding):
        return True
    return not any(is_parallel(scene, link, inner, pair) for link, pair in led)


def in_order(dyad: Dyad) -> Dyad:
    """The dyad read from its pin: RRP rather than PRR, the driver's side first."""
    turned = Dyad((dyad.links[1], dyad.links[0]), dyad.right, dyad.inner, dyad.left)
    if not isinstance(dyad.left, Pin) and isinstance(dyad.right, Pin):
        return turned
    both = isinstance(dyad.left, Pin) and isinstance(dyad.right, Pin)
    if both and FRAME in dyad.left.links and FRAME not in dyad.right.links:
        return turned
    return dyad


def next_stretched(
    joints: Joints, known: Collection[str], waiting: list[Driver]
) -> Stretched | None:
    """The first dyad, as its driver is written, with a driven cylinder for a bar."""
    cylinders = [each for driver in waiting for each in cylinders_of(joints, known, driver)]
    for cylinder in cylinders:
        for other in joints.neighbours(cylinder.far):
            if found := stretched_dyad(joints, known, cylinder, other, cylinders):
                return found
    return None


def cylinders_of(joints: Joints, known: Collection[str], driver: Driver) -> Iterator[Cylinder]:
    """The cylinder that a driver makes longer, if one of its two links is on a known pin."""
    if driver.kind != "slide" or driver.link in known or driver.against in known:
        return
    for near, far in ((driver.link, driver.against), (driver.against, driver.link)):
        left, slides = joints.between(near, known), joints.inner(near, far, known)
        if len(left) == len(slides) == 1 and not joints.between(far, known):
            pin, slide = left[0], slides[0]
            if isinstance(pin, Pin) and isinstance(slide, Sliding):
                yield Cylinder(driver, near, far, slide, pin)


def stretched_dyad(
    joints: Joints,
    known: Collection[str],
    cylinder: Cylinder,
    other: str,
    cylinders: Sequence[Cylinder],
) -> Stretched | None:
    """The dyad of a cylinder's far link with another: with a known one, or with a cylinder."""
    near, far = cylinder.near, cylinder.far
    if other in known or other == near or joints.between(near, (other,)):
        return None
    inner, right = joints.inner(far, other, known), joints.between(other, known)
    if len(inner) != 1 or not isinstance(inner[0], Pin):
        return None
    if len(right) == 1 and isinstance(right[0], Pin | Sliding):
        return Stretched((cylinder,), Dyad((far, other), cylinder.foot, inner[0], right[0]))
    second = next((each for each in cylinders if each.far == other), None)
    if second is None or joints.between(second.near, (near, far)):
        return None
    return Stretched((cylinder, second), Dyad((far, other), cylinder.foot, inner[0], second.foot))


def next_on_two_pins(
    joints: Joints, known: Collection[str], waiting: Sequence[Driver]
) -> OnTwoPins | None:
    """The first two blocks, as written, that guide a link together: on known pins, parallel.

    What a driver slides along the link is kept to tell how far this has come.
    """
    driven = [{driver.link, driver.against} for driver in waiting if driver.kind == "slide"]
    for rail in joints.unknown(known):
        slides = joints.others[rail]
        blocks = [each for pair in slides for each in pinned(joints, known, rail, pair)]
        blocks.sort(key=lambda each: joints.order[partner(each[0], rail)])
        for (first, start), (second, end) in combinations(blocks, 2):
            if start.place != end.place and is_parallel(joints.scene, rail, first, second):
                spare = first if {*second.links} in driven else second
                return on_two_pins(joints, known, rail, (second, first), (end, start), spare)
    return None


def pinned(
    joints: Joints, known: Collection[str], rail: str, pair: Joint
) -> Iterator[tuple[Sliding, Pin]]:
    """The slide between a link and a block on one known pin, with that pin; nothing else."""
    block = partner(pair, rail)
    if block in known or not isinstance(pair, Sliding):
        return
    held = joints.between(block, known)
    if len(held) == 1 and isinstance(held[0], Pin) and len(joints.inner(rail, block, known)) == 1:
        yield pair, held[0]


def is_parallel(scene: Scene, rail: str, *pairs: Sliding) -> bool:
    """Whether two guides lie in one direction on a link; false where its block names one second."""
    if any(pair.block == rail and pair.slide != scene.link(rail).slides[0] for pair in pairs):
        return False
    one, other = (guide_on(scene, rail, pair.block, pair.slide) for pair in pairs)
    return bool(abs(cross(one, other)) <= LEVEL)


def on_two_pins(
    joints: Joints,
    known: Collection[str],
    rail: str,
    slides: tuple[Sliding, Sliding],
    pins: tuple[Pin, Pin],
    spare: Sliding,
) -> OnTwoPins:
    """Two blocks that guide a link: the later written with its pin, and the first."""
    block, start = (partner(pair, rail) for pair in slides)
    carriers = ({*joints.owners[pin.place]} & {*known} for pin in pins)
    shared = sorted(set.intersection(*carriers), key=joints.order.__getitem__)
    own, guide = slides[1].slide, Slide(start, pins[1].place, exact(0, "deg"), None, exact(0, "m"))
    if own.on == start:
        guide = replace(guide, angle=own.angle, along=own.along)
    places = pins[0].place, pins[1].place
    on = next(iter(shared), None)
    line = PinLine(guide, (block, start), rail, slides, places, on, spare)
    return OnTwoPins((start, block), pins[1], line, pins[0])


def left_by(group: Group, joints: Joints) -> Joints:
    """The pairs that count once a group is known: one of two blocks that guide a link suffices."""
    return joints.without([group.inner.spare]) if isinstance(group, OnTwoPins) else joints


def next_tie(joints: Joints, known: Collection[str]) -> Tie | None:
    """The first link, as written, that two pins or slides join to known links.

    Two slides on one link leave it free to go along them, if it can go at all.
    """
    for link in joints.unknown(known):
        pairs = joints.between(link, known)
        if len(pairs) == 2 and all(pair.taken == 2 for pair in pairs):
            first, second = sorted(pairs, key=lambda pair: not isinstance(pair, Pin))
            on_two = isinstance(first, Pin) or partner(first, link) != partner(second, link)
            if on_two and isinstance(first, Pair) and isinstance(second, Pair):
                return Tie(link, first, second)
    return None
