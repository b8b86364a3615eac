"""Groups of class III and higher: which link to try so that dyads do the rest, or none.

Cutting one constraint of a group leaves a chain that dyads construct; what was cut closes it. Where
the chain comes to a stand, a link of a group within it is tried as well.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from msgspec.structs import replace

from graphkin.scene.model import Driver, Scene
from graphkin.structure.groups import (
    Crank,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    Last,
    Spun,
    Tie,
    TriedLink,
)
from graphkin.structure.joints import Joints, partner
from graphkin.structure.next_group import (
    left_by,
    next_driven,
    next_group,
    next_on_two_pins,
    next_stretched,
    next_tie,
    settle,
)
from graphkin.structure.pairs import Joint, Pin
from graphkin.structure.wheel_groups import (
    by_known,
    let_slip,
    over_rolled,
    pinned_wheels,
    turned_by_smaller,
)


def at_instant(
    joints: Joints, group: Higher, known: Collection[str], waiting: Collection[Driver]
) -> Higher:
    """A group with what constructs its plans, its wheels pinned where they touch.

    The same where no wheel of it touches a known track, or where one would have to be tried all the
    same; or where an arm and its wheel would close as a dyad, for its three pins lie in line.
    """
    wheels = pinned_wheels(joints, group.links, group.placing, known)
    if not wheels:
        return group
    pinned = joints.part(group.links).with_pins([(wheel.joint, wheel.rim) for wheel in wheels])
    left = [each for each in waiting if {each.link, each.against} & {*group.links}]
    in_line = [wheel.three for wheel in wheels]
    grown, found = {*known}, list[Group]()
    while not grown.issuperset(group.links):
        each = (
            next_driven(pinned, grown, left)
            or next_group(pinned, grown)
            or next_stretched(pinned, grown, left)
            or next_tie(pinned, grown)
        )
        if each is None:
            return group
        if isinstance(each, Dyad) and any({*each.links} <= three for three in in_line):
            return group
        found.append(each)
        settle(each, grown, left)
    return group if left else replace(group, wheels=wheels, at_instant=tuple(found))


MOST_TRIED = 4
"""Links of a group that are tried together at most."""


def next_higher(
    joints: Joints, known: Collection[str], waiting: list[Driver], *, by_wheels: bool = False
) -> Higher | None:
    """The smallest group that closes after the fewest links have been tried, as written first.

    Of two wheels that turn one another the larger is tried: all round it the smaller goes farther.
    A link is tried among those that pairs and drivers join it to: no other can follow it.
    ``by_wheels`` also finds those that only a wheel closes which must not slip.
    """
    for count in range(1, MOST_TRIED + 1):
        if least := least_tried(joints, known, waiting, count, by_wheels):
            return at_instant(joints, least, known, waiting)
    return None


def least_tried(
    joints: Joints, known: Collection[str], waiting: list[Driver], count: int, by_wheels: bool
) -> Higher | None:
    """The smallest group that closes after so many links have been tried."""
    tied = [{driver.link, driver.against} for driver in waiting]
    part_of = {
        link: part
        for links in joints.apart(known, tied)
        for part in (joints.part(links),)
        for link in links
    }
    found = [
        group
        for one in triable(joints, known)
        for group in closing(part_of[one.link], known, waiting, one, count, by_wheels)
    ]
    scene = joints.scene
    return min(found, key=lambda group: (len(group.links), speeding(scene, group)), default=None)


def speeding(scene: Scene, group: Higher) -> int:
    """How many wheels of a group are turned by smaller ones."""
    geared = [each for each in group.members if isinstance(each, Geared)]
    return sum(turned_by_smaller(scene, each) for each in geared)


def triable(joints: Joints, known: Collection[str]) -> Iterator[TriedLink]:
    """The links that can be tried: about a known pin first, then along a guide or track."""
    joined = [
        (link, pair) for link in joints.unknown(known) for pair in joints.between(link, known)
    ]
    joined = [(link, pair) for link, pair in joined if pair.taken == 2]
    for kind in (Pin, object):
        for link, pair in joined:
            if isinstance(pair, kind) and (kind is Pin or not isinstance(pair, Pin)):
                yield TriedLink(link, pair)


def closing(
    joints: Joints,
    known: Collection[str],
    waiting: list[Driver],
    tried: TriedLink,
    count: int,
    by_wheels: bool,
) -> Iterator[Higher]:
    """The group that closes when a link's place is taken as known, if one does.

    Those within it may try ``count`` links less one.
    """
    grown, left, count = {*known, tried.link}, list(waiting), count - 1
    chain: list[Group] = []
    while True:
        last: Last | None = over_given(known, grown, left)
        last = last or next_tie(joints, grown)
        if by_wheels and last is None:
            last = over_rolled(joints, known, grown, chain)
        if isinstance(last, Tie) and not isinstance(last.first, Pin):
            return
        if last is not None:
            break
        group = (
            next_driven(joints, grown, left)
            or next_group(joints, grown)
            or next_stretched(joints, grown, left)
            or next_on_two_pins(joints, grown, left)
            or (next_group(let_slip(joints, grown), grown) if by_wheels else None)
            or (least_tried(joints, grown, left, count, by_wheels) if count else None)
        )
        if group is None:
            return
        if isinstance(group, Geared):
            group = by_known(joints, group, {*known, tried.link})
        chain.append(group)
        settle(group, grown, left)
        joints = left_by(group, joints)
        count -= len(group.nested) if isinstance(group, Higher) else 0
    ends = needed_by(last)
    kept = needed(joints, chain, ends)
    if tried.link not in kept.needs:
        return
    higher = Higher(tried, kept.chain, last, ((), ()))
    yield replace(higher, joints=pairs_of(joints, higher, known))


def over_given(
    known: Collection[str], grown: Collection[str], waiting: list[Driver]
) -> Driver | None:
    """A driver whose two links have become known without it."""
    for driver in waiting:
        ends = {driver.link, driver.against}
        if ends <= set(grown) and not ends <= set(known):
            return driver
    return None


def needed_by(last: Last) -> set[str]:
    """The links that must stand before what closes a group does."""
    match last:
        case Driver():
            return {last.link, last.against}
        case Tie():
            return supports(last)
    return last.needs


def supports(group: Group) -> set[str]:
    """The links on which a group hangs."""
    if isinstance(group, Higher):
        parts = (*group.chain, *([group.last] if isinstance(group.last, Tie) else []))
        found = {partner(group.tried.pair, group.tried.link)}.union(*map(supports, parts))
        if not isinstance(group.last, Tie):
            found |= needed_by(group.last)
        return found - set(group.links)
    found = {link for pair in getattr(group, "outer", ()) for link in pair.links}
    if isinstance(group, Crank | Driven | Spun):
        found |= {group.driver.link, group.driver.against}
    return found - set(group.links)


class Needed:
    """The part of a chain that its end hangs on, and the links that it needs."""

    def __init__(self, chain: tuple[Group, ...], needs: set[str]) -> None:
        self.chain, self.needs = chain, needs


def needed(joints: Joints, chain: list[Group], ends: set[str]) -> Needed:
    """Drop what hangs on the chain without helping it to close."""
    needs, kept = set(ends), list[Group]()
    for group in reversed(chain):
        if needs.intersection(group.links):
            kept.insert(0, group)
            needs |= supports(group) | pivots(joints, group)
    return Needed(tuple(kept), needs)


def pivots(joints: Joints, group: Group) -> set[str]:
    """The links that own the pin about which a crank turns."""
    if isinstance(group, Higher):
        return set[str]().union(*(pivots(joints, each) for each in group.chain)) - {*group.links}
    pivot = getattr(group, "pivot", None)
    pivot = pivot.point if isinstance(pivot, Pin) else pivot
    return set(joints.owners[pivot]) - set(group.links) if pivot else set()


def pairs_of(
    joints: Joints, group: Higher, known: Collection[str]
) -> tuple[tuple[tuple[str, str], ...], tuple[str, ...]]:
    """The inner pairs of a group as pairs of links, and the link of each outer pair."""
    links, inner, outer = group.links, list[tuple[str, str]](), list[str]()
    for i, link in enumerate(links):
        outer += [link for pair in joints.between(link, known) if pair.taken == 2]
        for j, other in enumerate(links[i + 1 :], i + 1):
            held = joints.inner(link, other, known)
            inner += [(link, other) for pair in held if is_next(joints, pair, links[i + 1 : j])]
    return tuple(inner), tuple(outer)


def is_next(joints: Joints, pair: Joint, between: Collection[str]) -> bool:
    """Whether none of some links has the pin too: a pin of k links is k - 1 pairs, in a row."""
    return not isinstance(pair, Pin) or set(between).isdisjoint(joints.owners[pair.point])
