"""Decomposition into driven links and Assur groups, in an order of construction.

Assur: a mechanism consists of its frame and drivers, to which groups of links without mobility of
their own are added one after another. The smallest group, two links and three pairs, is the dyad.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import combinations

from msgspec.structs import replace

from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME, Cam, Driver, Scene, Side, Slide
from graphkin.scene.quantity import exact
from graphkin.structure.groups import (
    CamFollower,
    Crank,
    Cylinder,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    KeptParallel,
    Last,
    OnTwoPins,
    Spun,
    Stretched,
    Tie,
    TriedLink,
    Unresolved,
)
from graphkin.structure.pairs import (
    Joint,
    Joints,
    Pair,
    Pin,
    PinLine,
    Sliding,
    is_spare,
    partner,
    way_between,
)
from graphkin.structure.turning import LEVEL, body, guide_line, guide_on, metres
from graphkin.structure.wheel_groups import (
    by_centres,
    by_known,
    geared_of,
    let_slip,
    next_coupled,
    over_rolled,
    pinned_wheels,
    spun,
    tracks_held,
    train_with,
    turned_by_smaller,
    turned_wheel,
    wedged_wheels,
)
from graphkin.text.errors import Problem, StructureError, message


def settle(group: Group, known: set[str], waiting: list[Driver]) -> None:
    """Mark the group's links as known and its drivers as used."""
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
    """The first link, in the order of drivers, that is driven against a known link."""
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
    """The group of one driven link: a crank about any known pin, or a block along its own guide."""
    if driver.kind == "turn":
        pins = [pair for pair in joints.between(link, known) if isinstance(pair, Pin)]
        if pins:
            first, second = pins[0].links
            return Crank(link, driver, pins[0].point, second if first == link else first)
        return turned_wheel(joints, driver, link) or spun(joints, known, driver, link)
    for pair in joints.between(link, (against,)):
        if isinstance(pair, Pin) or pair.moved_by != driver.kind:
            continue
        if pair.links[0] == driver.link:
            return Driven(link, driver, pair)
    return None


def next_group(joints: Joints, known: Collection[str]) -> Group | None:
    """The first dyad or geared wheel, in written order, that closes on known links."""
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
    """The dyad of a link with the first neighbour that is joined to known links, too."""
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
    """Whether a dyad can close.

    False for slides that leave it loose (three, or two along one direction of their link), and for
    wheels pinned off centre.
    """
    if dyad.type == "PPP" or not by_centres(dyad.inner, dyad.outer, dyad.links):
        return False
    inner = dyad.inner
    ends = zip(dyad.links, dyad.outer, strict=True)
    led = [(link, pair) for link, pair in ends if isinstance(pair, Sliding)]
    if not isinstance(inner, Sliding):
        return True
    return not any(is_parallel(scene, link, inner, pair) for link, pair in led)


def in_order(dyad: Dyad) -> Dyad:
    """The dyad read from its pin: RRP instead of PRR, with the driver's side first."""
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
    """The first dyad, in the order of drivers, with a driven cylinder as a bar."""
    cylinders = [each for driver in waiting for each in cylinders_of(joints, known, driver)]
    for cylinder in cylinders:
        for other in joints.neighbours(cylinder.far):
            if found := stretched_dyad(joints, known, cylinder, other, cylinders):
                return found
    return None


def cylinders_of(joints: Joints, known: Collection[str], driver: Driver) -> Iterator[Cylinder]:
    """The cylinder that a driver lengthens, if one of its two links is on a known pin."""
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
    """The dyad of a cylinder's far link with another that is on a known link or a cylinder."""
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
    """The first two blocks, in written order, that guide a link: on known pins, in parallel guides.

    A block that a driver slides along the link is kept for the link's position.
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
    """The slide between a link and a block held only by one known pin, with that pin."""
    block = partner(pair, rail)
    if block in known or not isinstance(pair, Sliding):
        return
    held = joints.between(block, known)
    if len(held) == 1 and isinstance(held[0], Pin) and len(joints.inner(rail, block, known)) == 1:
        yield pair, held[0]


def is_parallel(scene: Scene, rail: str, *pairs: Sliding) -> bool:
    """Whether two guides are parallel on a link; false where its block names one of them second."""
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
    """Two blocks that guide a link: the later one with its pin, and the first."""
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


def next_parallel(
    joints: Joints, known: Collection[str], *, unstated: bool = False
) -> KeptParallel | None:
    """The first link on a known pin, in written order, that bars keep parallel to a known link.

    Links for whose pins the scene states a side can be left to the dyad of which that is the side:
    with ``unstated``, they are.
    """
    scene = joints.scene
    for link in joints.unknown(known) if joints.parallel else ():
        stated = (isinstance(scene.branches.get(p), Side) for p in scene.link(link).points)
        if unstated and any(stated):
            continue
        pins = [pair for pair in joints.between(link, known) if isinstance(pair, Pin)]
        if pins and (way := way_between(joints.parallel, link, known)):
            return KeptParallel(link, pins[0], *way)
    return None


def next_tie(joints: Joints, known: Collection[str]) -> Tie | None:
    """The first link, in written order, that two pins or slides join to known links.

    Two slides on one link would leave it free to slide along them, if it can move at all.
    """
    for link in joints.unknown(known):
        pairs = joints.between(link, known)
        if len(pairs) == 2 and all(pair.taken == 2 for pair in pairs):
            first, second = sorted(pairs, key=lambda pair: not isinstance(pair, Pin))
            on_two = isinstance(first, Pin) or partner(first, link) != partner(second, link)
            if on_two and isinstance(first, Pair) and isinstance(second, Pair):
                return Tie(link, first, second)
    return None


# --- decomposition into driven links and Assur groups ---------------------------------------------


ALONG = 1e-9
"""Sine of the angle below which a follower's guide counts as parallel to a plate's path."""


def decompose(scene: Scene) -> tuple[Group, ...]:
    """The groups in order of construction.

    Raises StructureError for a follower that misses its cam.
    """
    refuse_far_guides(scene)
    joints = Joints(scene)
    known = {FRAME}
    waiting = list(scene.drivers)
    groups: list[Group] = []
    while len(known) <= len(scene.links):
        group = (
            next_driven(joints, known, waiting)
            or next_parallel(joints, known, unstated=True)
            or next_group(joints, known)
            or next_stretched(joints, known, waiting)
            or next_tie(joints, known)
            or next_on_two_pins(joints, known, waiting)
            or next_parallel(joints, known)
            or next_tried(joints, known, waiting)
            or unresolved(joints, known, waiting)
        )
        groups.append(group)
        settle(group, known, waiting)
        joints = left_by(group, joints)
    return tuple(groups)


def next_tried(joints: Joints, known: Collection[str], waiting: list[Driver]) -> Group | None:
    """The next group that closes after some of its links are tried."""
    return (
        next_coupled(joints, known)
        or next_higher(joints, known, waiting)
        or next_coupled(joints, known, idle=True)
        or next_higher(joints, known, waiting, by_wheels=True)
    )


def unresolved(joints: Joints, known: Collection[str], waiting: Sequence[Driver]) -> Unresolved:
    """The remaining links, with those features that no construction accepts."""
    from graphkin.structure.touching_wheels import asked_of

    links = tuple(joints.unknown(known))
    driven = tuple(each for each in waiting if {each.link, each.against} & {*links})
    held, wedged = tracks_held(joints, links), wedged_wheels(joints, known, links)
    return Unresolved(links, driven, held, wedged, asked_of(joints.scene, held))


def refuse_far_guides(scene: Scene) -> None:
    """Raise StructureError for each follower that cannot rest on the cam's prime circle."""
    problems = []
    for follower, cam in scene.cams.items():
        refuse = far_from_plate if cam.slides else far_lever if cam.lever else far_guide
        problem = refuse(scene, follower, cam)
        if problem is not None:
            problems.append(problem)
    if problems:
        raise StructureError(problems)


def far_from_plate(scene: Scene, follower: str, cam: Cam) -> Problem | None:
    """The error for a follower that a plate cannot lift.

    Its guide is parallel to the plate's path, or the plate is out of a lever's reach.
    """
    slide = scene.link(cam.on).slides[0]
    plate = guide_line(scene, slide)
    if cam.lever is None:
        guide = guide_line(scene, scene.link(follower).slides[0])
        if abs(cross(plate.along, guide.along)) > ALONG:
            return None
        found = message(
            "link {follower} slides along the path of link {on}", follower=follower, on=cam.on
        )
        return Problem(
            f"links.{follower}.slides.angle", found, message("a guide that crosses this path")
        )
    fixed, own = body(scene, cam.carrier), body(scene, follower)
    above = abs(
        cross(plate.along, fixed[cam.lever.pin] - plate.point) - metres(scene, slide.offset)
    )
    arm = abs(own[cam.point] - own[cam.lever.pin])
    prime = metres(scene, cam.base) + metres(scene, cam.roller)
    if above > ALONG * arm and abs(above - prime) < arm:
        return None
    bar = f"{cam.lever.pin}-{cam.point}"
    found = message(
        "{pin} is {above:.6g} mm from the path of {pivot}, {bar} is {arm:.6g} mm long",
        pin=cam.lever.pin,
        above=1e3 * above,
        pivot=cam.pivot,
        bar=bar,
        arm=1e3 * arm,
    )
    expected = message(
        "a pin beside this path, from which {bar} reaches {prime:.6g} mm above it",
        bar=bar,
        prime=1e3 * prime,
    )
    return Problem(f"links.{follower}.cam.base", found, expected)


def far_guide(scene: Scene, follower: str, cam: Cam) -> Problem | None:
    """The error for a guide that misses the prime circle."""
    slide = scene.link(follower).slides[0]
    line, pivot = guide_line(scene, slide), body(scene, slide.on)[cam.pivot]
    aside = abs(cross(line.along, line.point - pivot) + metres(scene, slide.offset))
    prime = metres(scene, cam.base) + metres(scene, cam.roller)
    if cam.is_flat or aside < prime:
        return None
    found = message(
        "the follower passes {aside:.6g} mm beside {pivot}", aside=1e3 * aside, pivot=cam.pivot
    )
    expected = message("less than base and roller together, {prime:.6g} mm", prime=1e3 * prime)
    return Problem(f"links.{follower}.cam.base", found, expected)


def far_lever(scene: Scene, follower: str, cam: Cam) -> Problem | None:
    """The error for a lever that does not reach the prime circle, or whose face cannot touch it."""
    lever, fixed, own = cam.lever, body(scene, cam.carrier), body(scene, follower)
    assert lever is not None
    apart = abs(fixed[lever.pin] - fixed[cam.pivot])
    prime = metres(scene, cam.base) + metres(scene, cam.roller)
    pins = message(
        "{pivot} and {pin} are {apart:.6g} mm apart",
        pivot=cam.pivot,
        pin=lever.pin,
        apart=1e3 * apart,
    )
    place = f"links.{follower}.cam.base"
    if cam.is_flat:
        gap = prime + metres(scene, lever.face)
        if abs(gap) < apart:
            return None
        expected = message("more than base and face together, {gap:.6g} mm", gap=1e3 * gap)
        return Problem(place, pins, expected)
    arm = abs(own[cam.point] - own[lever.pin])
    if abs(apart - arm) < prime < apart + arm:
        return None
    bar = f"{lever.pin}-{cam.point}"
    found = message("{pins}, {bar} is {arm:.6g} mm long", pins=pins, bar=bar, arm=1e3 * arm)
    expected = message(
        "a triangle of these and base and roller together, {prime:.6g} mm", prime=1e3 * prime
    )
    return Problem(place, found, expected)


# --- groups of class III and higher: the link to try so that dyads do the rest --------------------


def at_instant(
    joints: Joints, group: Higher, known: Collection[str], waiting: Collection[Driver]
) -> Higher:
    """A group with the groups for its plans at the instant, its wheels pinned at their contacts.

    The group is unchanged where none of its wheels touches a known track, or where a link would
    have to be tried anyway. The same holds where an arm and its wheel would close as a dyad,
    because its three pins are in line.
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
"""The most links of a group that are tried together."""


def next_higher(
    joints: Joints, known: Collection[str], waiting: list[Driver], *, by_wheels: bool = False
) -> Higher | None:
    """The smallest group that closes after the fewest links are tried, in written order.

    Of two wheels in mesh, the larger is tried: in one turn of it the smaller turns further. A link
    is tried among the links that pairs and drivers join to it, because no other can follow it.
    ``by_wheels`` also finds groups that only the no-slip condition of a wheel closes.
    """
    for count in range(1, MOST_TRIED + 1):
        if least := least_tried(joints, known, waiting, count, by_wheels):
            return at_instant(joints, least, known, waiting)
    return None


def least_tried(
    joints: Joints, known: Collection[str], waiting: list[Driver], count: int, by_wheels: bool
) -> Higher | None:
    """The smallest group that closes after ``count`` links are tried."""
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
    """The number of wheels in a group that smaller ones turn."""
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
    """The group that closes when a link's position is assumed known, if one does.

    Groups within it may try one link less than ``count``.
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
        spare = (
            last if isinstance(last, Tie) and is_spare(joints.parallel, last.link, grown) else None
        )
        if last is not None and spare is None:
            break
        group = (
            spare
            or next_driven(joints, grown, left)
            or next_parallel(joints, grown)
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
    """The links that must be known before the closing condition can be checked."""
    match last:
        case Driver():
            return {last.link, last.against}
        case Tie():
            return supports(last)
    return last.needs


def supports(group: Group) -> set[str]:
    """The links on which a group depends."""
    if isinstance(group, Higher):
        parts = (*group.chain, *([group.last] if isinstance(group.last, Tie) else []))
        found = {partner(group.tried.pair, group.tried.link)}.union(*map(supports, parts))
        if not isinstance(group.last, Tie):
            found |= needed_by(group.last)
        return found - set(group.links)
    found = {link for pair in getattr(group, "outer", ()) for link in pair.links}
    if isinstance(group, KeptParallel):
        found.add(group.lead)
    if isinstance(group, Crank | Driven | Spun):
        found |= {group.driver.link, group.driver.against}
    return found - set(group.links)


class Needed:
    """The part of a chain on which its end depends, and the links that this part needs."""

    def __init__(self, chain: tuple[Group, ...], needs: set[str]) -> None:
        self.chain, self.needs = chain, needs


def needed(joints: Joints, chain: list[Group], ends: set[str]) -> Needed:
    """The chain without groups that do not help to close it."""
    needs, kept = set(ends), list[Group]()
    for group in reversed(chain):
        if needs.intersection(group.links):
            kept.insert(0, group)
            needs |= supports(group) | pivots(joints, group)
    return Needed(tuple(kept), needs)


def pivots(joints: Joints, group: Group) -> set[str]:
    """The links that have the pin about which a crank turns."""
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
    """Whether none of some links has the pin, too: a pin of k links is k - 1 pairs in a row."""
    return not isinstance(pair, Pin) or set(between).isdisjoint(joints.owners[pair.point])
