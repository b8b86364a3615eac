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
    Placed,
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


def settle(placed: Placed, group: Group) -> None:
    """Mark the group's links as known and its drivers as used."""
    placed.known.update(group.links)
    if isinstance(group, Higher):
        for each in group.chain:
            settle(placed, each)
        if isinstance(group.last, Driver):
            placed.waiting.remove(group.last)
    elif isinstance(group, Crank | Driven | Spun):
        placed.waiting.remove(group.driver)
    elif isinstance(group, Stretched):
        for driver in group.drivers:
            placed.waiting.remove(driver)
    elif isinstance(group, OnTwoPins):  # one of the two blocks that guide its link suffices
        placed.joints = placed.joints.without([group.inner.spare])


def next_driven(placed: Placed) -> Group | None:
    """The first link, in the order of drivers, that is driven against a known link."""
    for driver in placed.waiting:
        for link, against in ((driver.link, driver.against), (driver.against, driver.link)):
            if link in placed.known or against not in placed.known:
                continue
            group = driven_by(placed, driver, link, against)
            if group is not None:
                return group
    return None


def driven_by(
    placed: Placed, driver: Driver, link: str, against: str
) -> Crank | Driven | Spun | None:
    """The group of one driven link: a crank about any known pin, or a block along its own guide."""
    if driver.kind == "turn":
        pins = [pair for pair in placed.held(link) if isinstance(pair, Pin)]
        if pins:
            return Crank(link, driver, pins[0].point, partner(pins[0], link))
        return turned_wheel(placed.joints, driver, link) or spun(placed, driver, link)
    for pair in placed.joints.between(link, (against,)):
        if isinstance(pair, Pin) or pair.moved_by != driver.kind:
            continue
        if pair.links[0] == driver.link:
            return Driven(link, driver, pair)
    return None


def next_group(placed: Placed) -> Group | None:
    """The first dyad or geared wheel, in written order, that closes on known links."""
    for first in placed.unknown():
        left = placed.held(first)
        if not left:
            continue
        if geared := geared_of(first, left, placed.known):
            return geared
        if dyad := dyad_with(placed, first, left):
            return CamFollower(dyad) if {*dyad.links} & placed.scene.cam_links.keys() else dyad
        if train := train_with(placed, first, left):
            return train
    return None


def dyad_with(placed: Placed, first: str, left: tuple[Joint, ...]) -> Dyad | None:
    """The dyad of a link with the first neighbour that is joined to known links, too."""
    if len(left) != 1 or left[0].taken != 2:
        return None
    for second in placed.joints.neighbours(first):
        if second in placed.known:
            continue
        inner, right = placed.inner(first, second), placed.held(second)
        if len(inner) == len(right) == 1 and inner[0].taken == right[0].taken == 2:
            dyad = Dyad((first, second), left[0], inner[0], right[0])
            if can_close(placed.scene, dyad):
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


def next_stretched(placed: Placed) -> Stretched | None:
    """The first dyad, in the order of drivers, with a driven cylinder as a bar."""
    cylinders = [each for driver in placed.waiting for each in cylinders_of(placed, driver)]
    for cylinder in cylinders:
        for other in placed.joints.neighbours(cylinder.far):
            if found := stretched_dyad(placed, cylinder, other, cylinders):
                return found
    return None


def cylinders_of(placed: Placed, driver: Driver) -> Iterator[Cylinder]:
    """The cylinder that a driver lengthens, if one of its two links is on a known pin."""
    if driver.kind != "slide" or {driver.link, driver.against} & placed.known:
        return
    for near, far in ((driver.link, driver.against), (driver.against, driver.link)):
        left, slides = placed.held(near), placed.inner(near, far)
        if len(left) == len(slides) == 1 and not placed.held(far):
            pin, slide = left[0], slides[0]
            if isinstance(pin, Pin) and isinstance(slide, Sliding):
                yield Cylinder(driver, near, far, slide, pin)


def stretched_dyad(
    placed: Placed, cylinder: Cylinder, other: str, cylinders: Sequence[Cylinder]
) -> Stretched | None:
    """The dyad of a cylinder's far link with another that is on a known link or a cylinder."""
    joints, near, far = placed.joints, cylinder.near, cylinder.far
    if other in placed.known or other == near or joints.between(near, (other,)):
        return None
    inner, right = placed.inner(far, other), placed.held(other)
    if len(inner) != 1 or not isinstance(inner[0], Pin):
        return None
    if len(right) == 1 and isinstance(right[0], Pin | Sliding):
        return Stretched((cylinder,), Dyad((far, other), cylinder.foot, inner[0], right[0]))
    second = next((each for each in cylinders if each.far == other), None)
    if second is None or joints.between(second.near, (near, far)):
        return None
    return Stretched((cylinder, second), Dyad((far, other), cylinder.foot, inner[0], second.foot))


def next_on_two_pins(placed: Placed) -> OnTwoPins | None:
    """The first two blocks, in written order, that guide a link: on known pins, in parallel guides.

    A block that a driver slides along the link is kept for the link's position.
    """
    joints = placed.joints
    driven = [{driver.link, driver.against} for driver in placed.waiting if driver.kind == "slide"]
    for rail in placed.unknown():
        blocks = [each for pair in joints.others[rail] for each in pinned(placed, rail, pair)]
        blocks.sort(key=lambda each: joints.order[partner(each[0], rail)])
        for (first, start), (second, end) in combinations(blocks, 2):
            if start.place != end.place and is_parallel(joints.scene, rail, first, second):
                spare = first if {*second.links} in driven else second
                return on_two_pins(placed, rail, (second, first), (end, start), spare)
    return None


def pinned(placed: Placed, rail: str, pair: Joint) -> Iterator[tuple[Sliding, Pin]]:
    """The slide between a link and a block held only by one known pin, with that pin."""
    block = partner(pair, rail)
    if block in placed.known or not isinstance(pair, Sliding):
        return
    held = placed.held(block)
    if len(held) == 1 and isinstance(held[0], Pin) and len(placed.inner(rail, block)) == 1:
        yield pair, held[0]


def is_parallel(scene: Scene, rail: str, *pairs: Sliding) -> bool:
    """Whether two guides are parallel on a link; false where its block names one of them second."""
    if any(pair.block == rail and pair.slide != scene.link(rail).slides[0] for pair in pairs):
        return False
    one, other = (guide_on(scene, rail, pair.block, pair.slide) for pair in pairs)
    return bool(abs(cross(one, other)) <= LEVEL)


def on_two_pins(
    placed: Placed,
    rail: str,
    slides: tuple[Sliding, Sliding],
    pins: tuple[Pin, Pin],
    spare: Sliding,
) -> OnTwoPins:
    """Two blocks that guide a link: the later one with its pin, and the first."""
    block, start = (partner(pair, rail) for pair in slides)
    carriers = ({*placed.joints.owners[pin.place]} & placed.known for pin in pins)
    shared = sorted(set.intersection(*carriers), key=placed.joints.order.__getitem__)
    own, guide = slides[1].slide, Slide(start, pins[1].place, exact(0, "deg"), None, exact(0, "m"))
    if own.on == start:
        guide = replace(guide, angle=own.angle, along=own.along)
    places = pins[0].place, pins[1].place
    on = next(iter(shared), None)
    line = PinLine(guide, (block, start), rail, slides, places, on, spare)
    return OnTwoPins((start, block), pins[1], line, pins[0])


def next_parallel(placed: Placed, *, unstated: bool = False) -> KeptParallel | None:
    """The first link on a known pin, in written order, that bars keep parallel to a known link.

    Links for whose pins the scene states a side can be left to the dyad of which that is the side:
    with ``unstated``, they are.
    """
    scene, sets = placed.scene, placed.joints.parallel
    for link in placed.unknown() if sets else ():
        stated = (isinstance(scene.branches.get(p), Side) for p in scene.link(link).points)
        if unstated and any(stated):
            continue
        pins = [pair for pair in placed.held(link) if isinstance(pair, Pin)]
        if pins and (way := way_between(sets, link, placed.known)):
            return KeptParallel(link, pins[0], *way)
    return None


def next_tie(placed: Placed) -> Tie | None:
    """The first link, in written order, that two pins or slides join to known links.

    Two slides on one link would leave it free to slide along them, if it can move at all.
    """
    for link in placed.unknown():
        pairs = placed.held(link)
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
    placed = Placed(Joints(scene), {FRAME}, scene.drivers)
    groups: list[Group] = []
    while len(placed.known) <= len(scene.links):
        group = (
            next_driven(placed)
            or next_parallel(placed, unstated=True)
            or next_group(placed)
            or next_stretched(placed)
            or next_tie(placed)
            or next_on_two_pins(placed)
            or next_parallel(placed)
            or next_tried(placed)
            or unresolved(placed)
        )
        groups.append(group)
        settle(placed, group)
    return tuple(groups)


def next_tried(placed: Placed) -> Group | None:
    """The next group that closes after some of its links are tried."""
    return (
        next_coupled(placed)
        or next_higher(placed)
        or next_coupled(placed, idle=True)
        or next_higher(placed, by_wheels=True)
    )


def unresolved(placed: Placed) -> Unresolved:
    """The remaining links, with those features that no construction accepts."""
    from graphkin.structure.touching_wheels import asked_of

    links = tuple(placed.unknown())
    driven = tuple(each for each in placed.waiting if {each.link, each.against} & {*links})
    held, wedged = tracks_held(placed.joints, links), wedged_wheels(placed, links)
    return Unresolved(links, driven, held, wedged, asked_of(placed.scene, held))


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


def at_instant(placed: Placed, group: Higher) -> Higher:
    """A group with the groups for its plans at the instant, its wheels pinned at their contacts.

    The group is unchanged where none of its wheels touches a known track, or where a link would
    have to be tried anyway. The same holds where an arm and its wheel would close as a dyad,
    because its three pins are in line.
    """
    wheels = pinned_wheels(placed, group.links, group.placing)
    if not wheels:
        return group
    own = placed.joints.part(group.links).with_pins([(wheel.joint, wheel.rim) for wheel in wheels])
    left = (each for each in placed.waiting if {each.link, each.against} & {*group.links})
    in_line = [wheel.three for wheel in wheels]
    grown, found = Placed(own, placed.known, left), list[Group]()
    while not grown.known.issuperset(group.links):
        each = next_driven(grown) or next_group(grown) or next_stretched(grown) or next_tie(grown)
        if each is None:
            return group
        if isinstance(each, Dyad) and any({*each.links} <= three for three in in_line):
            return group
        found.append(each)
        settle(grown, each)
    return group if grown.waiting else replace(group, wheels=wheels, at_instant=tuple(found))


MOST_TRIED = 4
"""The most links of a group that are tried together."""


def next_higher(placed: Placed, *, by_wheels: bool = False) -> Higher | None:
    """The smallest group that closes after the fewest links are tried, in written order.

    Of two wheels in mesh, the larger is tried: in one turn of it the smaller turns further. A link
    is tried among the links that pairs and drivers join to it, because no other can follow it.
    ``by_wheels`` also finds groups that only the no-slip condition of a wheel closes.
    """
    for count in range(1, MOST_TRIED + 1):
        if least := least_tried(placed, count, by_wheels):
            return at_instant(placed, least)
    return None


def least_tried(placed: Placed, count: int, by_wheels: bool) -> Higher | None:
    """The smallest group that closes after ``count`` links are tried."""
    joints, scene = placed.joints, placed.scene
    tied = [{driver.link, driver.against} for driver in placed.waiting]
    part_of = {
        link: part
        for links in joints.apart(placed.known, tied)
        for part in (placed.by(joints.part(links)),)
        for link in links
    }
    found = [
        group
        for one in triable(placed)
        for group in closing(part_of[one.link], one, count, by_wheels)
    ]
    return min(found, key=lambda group: (len(group.links), speeding(scene, group)), default=None)


def speeding(scene: Scene, group: Higher) -> int:
    """The number of wheels in a group that smaller ones turn."""
    geared = [each for each in group.members if isinstance(each, Geared)]
    return sum(turned_by_smaller(scene, each) for each in geared)


def triable(placed: Placed) -> list[TriedLink]:
    """The links that can be tried: about a known pin first, then along a guide or track."""
    joined = ((link, pair) for link in placed.unknown() for pair in placed.held(link))
    found = [TriedLink(link, pair) for link, pair in joined if pair.taken == 2]
    return sorted(found, key=lambda one: not isinstance(one.pair, Pin))


def closing(placed: Placed, tried: TriedLink, count: int, by_wheels: bool) -> Iterator[Higher]:
    """The group that closes when a link's position is assumed known, if one does.

    Groups within it may try one link less than ``count``.
    """
    grown = Placed(placed.joints, {*placed.known, tried.link}, placed.waiting)
    count -= 1
    chain: list[Group] = []
    while True:
        last: Last | None = over_given(placed, grown)
        last = last or next_tie(grown)
        if by_wheels and last is None:
            last = over_rolled(placed, grown, chain)
        if isinstance(last, Tie) and not isinstance(last.first, Pin):
            return
        sets = grown.joints.parallel
        spare = last if isinstance(last, Tie) and is_spare(sets, last.link, grown.known) else None
        if last is not None and spare is None:
            break
        group = (
            spare
            or next_driven(grown)
            or next_parallel(grown)
            or next_group(grown)
            or next_stretched(grown)
            or next_on_two_pins(grown)
            or (next_group(let_slip(grown)) if by_wheels else None)
            or (least_tried(grown, count, by_wheels) if count else None)
        )
        if group is None:
            return
        if isinstance(group, Geared):
            group = by_known(grown.joints, group, {*placed.known, tried.link})
        chain.append(group)
        settle(grown, group)
        count -= len(group.nested) if isinstance(group, Higher) else 0
    ends = needed_by(last)
    kept, needs = needed(grown.joints, chain, ends)
    if tried.link not in needs:
        return
    higher = Higher(tried, kept, last, ((), ()))
    yield replace(higher, joints=pairs_of(grown.joints, higher, placed.known))


def over_given(placed: Placed, grown: Placed) -> Driver | None:
    """A driver whose two links have become known without it."""
    for driver in grown.waiting:
        ends = {driver.link, driver.against}
        if ends <= grown.known and not ends <= placed.known:
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


def needed(
    joints: Joints, chain: list[Group], ends: set[str]
) -> tuple[tuple[Group, ...], set[str]]:
    """The chain without groups that do not help to close it, and the links that it needs."""
    needs, kept = set(ends), list[Group]()
    for group in reversed(chain):
        if needs.intersection(group.links):
            kept.insert(0, group)
            needs |= supports(group) | pivots(joints, group)
    return tuple(kept), needs


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
