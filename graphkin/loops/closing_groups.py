"""The groups of links that close together, from the joints alone, in the order of their solution.

A set of links is ready when its joints and drivers remove at least 3 freedoms per link. Joints
within the set and joints to known links count. Examples are a driven crank (1 link), a dyad (2
links, 3 joints) and a wheel on an arm. Groups of higher class have 4 links and 6 joints, or 6 and
9. The smallest such set comes first. Where the count may be misleading, the rank of the equations
in a random position decides.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from itertools import combinations
from math import comb

import numpy as np
from msgspec import Struct

from graphkin.loops.equations import Equations, joined, part_of, tied_by
from graphkin.loops.loop_motion import setting_of
from graphkin.loops.rigid_bodies import Complexes, Reals, spare_bars
from graphkin.scene.model import FRAME, Closure, Scene, Side, Way
from graphkin.text.errors import StructureError

LARGEST = 6
MOST = 20_000
"""The most sets of links that are examined for a group of higher class."""
FULL = 1e-9
"""Ratio of the smallest to the largest singular value above which equations determine a group."""

Set = tuple[int, tuple[int, ...]]
"""The size of a set of links, and the links by their numbers."""
Mask = np.ndarray[tuple[int], np.dtype[np.bool_]]


class Joint(Struct, frozen=True):
    """A pair: a pin, named by its point, or a slide or track, named by its guide's number.

    Without either it only ties coordinates of its links: two wheels, or a driver (``drives``).
    """

    links: tuple[str, ...]
    pin: str = ""
    slide: int = -1
    turns_alike: bool = False
    drives: bool = False

    @property
    def takes(self) -> int:
        """The freedoms that the joint removes."""
        return 2 if self.pin or self.slide >= 0 else 1


class Group(Struct, frozen=True):
    """Links that close together, the joints between them and the joints to links known before.

    ``ties`` are the wheel contacts and the drivers of the group.
    """

    links: tuple[str, ...]
    inner: tuple[Joint, ...]
    outer: tuple[Joint, ...]
    known: frozenset[str]
    ties: tuple[Joint, ...] = ()

    @property
    def slides(self) -> tuple[Joint, ...]:
        return tuple(joint for joint in (*self.inner, *self.outer) if joint.slide >= 0)

    @property
    def is_dyad(self) -> bool:
        """Whether the group is two links with one joint between them and one outward from each."""
        pairs = (*self.inner, *self.outer)
        ends = [joint for joint in self.outer if self.links[0] in joint.links]
        plain = not self.ties and all(joint.pin or joint.turns_alike for joint in pairs)
        three = len(self.inner) == len(ends) == 1 and len(self.outer) == 2
        return plain and len(self.links) == 2 and three

    @property
    def is_driven(self) -> bool:
        """Whether the group is one driven link on a known pin or a known guide."""
        return (
            len(self.links) == len(self.outer) == len(self.ties) == 1
            and self.ties[0].drives
            and bool(self.outer[0].pin or self.outer[0].turns_alike)
        )

    def only_follows(self, link: str) -> bool:
        """Whether a link is a wheel on a known pin, turned by one other link of the group."""
        mine = [j for j in (*self.inner, *self.outer, *self.ties) if link in j.links]
        pins = [joint for joint in mine if joint.pin]
        turned = not any(joint.turns_alike or joint.drives for joint in mine)
        return turned and len(mine) == 2 and len(pins) == 1 and pins[0] in self.outer

    @property
    def is_geared(self) -> bool:
        """Whether the group is one wheel on a known pin, turned by one other wheel or belt."""
        if not (len(self.links) == len(self.outer) == len(self.ties) == 1 and self.outer[0].pin):
            return False
        return not self.ties[0].drives and self.links[0] in self.ties[0].links[:2]


def groups(scene: Scene, loops: Equations) -> list[Group]:
    """The groups of two or more links, in the order in which they become known."""
    return [group for group in stages(scene, loops) if len(group.links) > 1]


def stages(scene: Scene, loops: Equations) -> list[Group]:
    """All groups, single links included, in the order in which they become known.

    Links that nothing determines belong to no group. A set of one or two links is examined when a
    neighbour has become known. The work is thus proportional to the number of joints.
    """
    net, known, found = Net(scene, loops), frozenset({FRAME}), list[Group]()
    waiting = net.sets_beside({FRAME}, known)
    while True:
        group = first_ready(net, known, waiting) or larger(net, known)
        if group is None:
            return found
        found.append(group)
        known |= set(group.links)
        waiting = sorted([*waiting, *net.sets_beside(group.links, known)])


def counted_in_order(loops: Equations) -> Equations:
    """The equations with whole turns counted in the order in which groups become known."""
    if not loops.doubtful:
        return loops
    order = enumerate(stages(loops.scene, loops), 1)
    known = {link: number for number, group in order for link in group.links}
    return joined(loops.scene, loops.parts, loops.links, known)


def speaks_of(name: str, branch: Side | Way | Closure, group: Group, loops: Equations) -> bool:
    """Whether a way or a closure number stated under a name refers to a group.

    - A number refers to the group of the named link.
    - A way under a block's name refers to the group of its slide. The block itself may be known
      before, as part of another group.
    - A way under the name of a wheel on a straight track refers to the wheel's group: a track on a
      known wheel has no way of its own.
    - A way does not refer to a group whose closure has a number.
    - A way under a pin's name refers to the group that the pin joins, whatever is stated for its
      block.
    """
    if isinstance(branch, Way) and name not in loops.bodies:
        return bool(group.slides) and any(joint.pin == name for joint in group.inner)
    stated = (loops.scene.branches.get(joint.pin) for joint in group.inner if joint.pin)
    if isinstance(branch, Way) and group.slides and any(isinstance(each, Way) for each in stated):
        return False
    numbered = (isinstance(loops.scene.branches.get(link), Closure) for link in group.links)
    if isinstance(branch, Way) and any(numbered):
        return False
    own = {j: guide.turns_alike for j, guide in enumerate(loops.guides) if guide.block == name}
    if isinstance(branch, Way) and own:
        led = (own[joint.slide] for joint in group.slides if joint.slide in own)
        return any(slides or name in group.links for slides in led)
    return name in group.links


def joints(loops: Equations) -> tuple[Joint, ...]:
    """The pins, slides and straight tracks, each between two links."""
    bodies, order = loops.bodies, [*loops.bodies]
    owners = defaultdict[str, list[int]](list)
    for number, body in enumerate(bodies.values()):
        for point in body:
            owners[point].append(number)
    beside = sorted({pair for each in owners.values() for pair in combinations(each, 2)})
    pins = [
        Joint((p, q), pin=point)
        for p, q in ((order[i], order[k]) for i, k in beside)
        for point in bodies[p]
        if point in bodies[q]
    ]
    slides = [
        Joint((guide.block, guide.on), slide=j, turns_alike=guide.turns_alike)
        for j, guide in enumerate(loops.guides)
    ]
    return (*pins, *slides)


def tied(scene: Scene, loops: Equations) -> tuple[Joint, ...]:
    """The wheel contacts with their arms, and the drivers; they only tie coordinates of links."""
    wheels = [Joint((*gear.links, gear.arm)) for gear in loops.gears]
    drivers = [Joint(tied_by(each), drives=True) for each in scene.drivers]
    return (*wheels, *drivers)


class Net:
    """The joints and ties of a scene, by the links that they join.

    Links are numbered in the order written. Sets sort by size, then by the order written.
    """

    def __init__(self, scene: Scene, loops: Equations) -> None:
        self.scene, self.loops = scene, loops
        self.order = {link: n for n, link in enumerate(loops.links)}
        self.joints = by_link(joints(loops))
        self.ties = by_link(tied(scene, loops))
        self.spare = spare_bars(loops.bodies, busy(scene, loops))

    def near(self, links: Iterable[str]) -> tuple[tuple[Joint, ...], tuple[Joint, ...]]:
        """The joints and the ties of some links, in order."""
        chosen = tuple(links)
        first, second = (
            {n: joint for link in chosen for n, joint in table[link]}
            for table in (self.joints, self.ties)
        )
        return tuple(first[n] for n in sorted(first)), tuple(second[n] for n in sorted(second))

    def sets_beside(self, links: Iterable[str], known: frozenset[str]) -> list[Set]:
        """The sets of one and of two joined unknown links that adjoin the given known links.

        A pin shared with links known earlier is left out, because its links adjoined those already.
        A pin that is known joins no two unknown links.
        """
        chosen = tuple(links)
        every, ties = self.near(chosen)
        before = self.pins_of(known.difference(chosen))
        new = [joint for joint in every if joint.pin not in before]
        beside = {link for joint in (*new, *ties) for link in joint.links} - known
        known_pins = self.pins_of(known)
        found: set[Set] = set()
        for link in beside & self.order.keys():
            found.add((1, (self.order[link],)))
            mine, tied_to = self.near((link,))
            others = {each for joint in mine if joint.pin not in known_pins for each in joint.links}
            others |= {each for tie in tied_to if link in tie.links[:2] for each in tie.links[:2]}
            pairs = ({link, each} for each in (others & self.order.keys()) - known - {link})
            found |= {(2, tuple(sorted(self.order[each] for each in pair))) for pair in pairs}
        return sorted(found)

    def pins_of(self, links: Iterable[str]) -> set[str]:
        return {point for link in links for point in self.loops.bodies[link]}

    def ready(self, links: tuple[str, ...], known: frozenset[str]) -> Group | None:
        """The group that the links form, or None if they are not determined.

        A spare bar determines nothing but itself.
        """
        if len(links) > 1 and not self.spare.isdisjoint(links):
            return None
        group = group_of(links, known, *self.near(links))
        taken = sum(joint.takes for joint in (*group.inner, *group.outer, *group.ties))
        if taken >= 3 * len(links) and determined(self.scene, self.loops, group, taken):
            return group
        return None


def busy(scene: Scene, loops: Equations) -> set[str]:
    """The links that guides, wheels or drivers join to others."""
    guides = ((guide.block, guide.on) for guide in loops.guides)
    wheels = ((*gear.links, gear.arm) for gear in loops.gears)
    drivers = (tied_by(driver) for driver in scene.drivers)
    return {link for links in (*guides, *wheels, *drivers) for link in links}


def by_link(every: tuple[Joint, ...]) -> dict[str, list[tuple[int, Joint]]]:
    """The joints of each link, numbered in their order."""
    found = defaultdict[str, list[tuple[int, Joint]]](list)
    for number, joint in enumerate(every):
        for link in dict.fromkeys(joint.links):
            found[link].append((number, joint))
    return found


def first_ready(net: Net, known: frozenset[str], waiting: list[Set]) -> Group | None:
    """The first of the waiting sets that the known links determine.

    Sets that are not determined are dropped until one of their neighbours becomes known.
    """
    while waiting:
        _, numbers = waiting.pop(0)
        links = tuple(net.loops.links[number] for number in numbers)
        if known.isdisjoint(links) and (group := net.ready(links, known)):
            return group
    return None


def larger(net: Net, known: frozenset[str]) -> Group | None:
    """The smallest group of three or more links that the known links determine, in written order.

    None where there are more than ``MOST`` sets of one size.
    """
    unknown = [link for link in net.loops.links if link not in known and link not in net.spare]
    for size in range(3, min(LARGEST, len(unknown)) + 1):
        if comb(len(unknown), size) > MOST:
            return None
        for links in combinations(unknown, size):
            if group := net.ready(links, known):
                return group
    return None


def group_of(
    links: tuple[str, ...], known: frozenset[str], every: tuple[Joint, ...], ties: tuple[Joint, ...]
) -> Group:
    """The group of some links, with those of their joints that belong to it."""
    mine = set(links)
    outer = between(mine, known, every)
    inner = among(mine, every, {joint.pin for joint in outer})
    within = tuple(j for j in ties if mine | known >= set(j.links))
    return Group(links, inner, outer, known, within)


def between(links: set[str], others: frozenset[str], every: tuple[Joint, ...]) -> tuple[Joint, ...]:
    """The joints from links to others; a pin shared by several of the others counts once."""
    found: dict[tuple[str, str, int], Joint] = {}
    for joint in every:
        for mine, other in (joint.links, joint.links[::-1]):
            if mine in links and other in others:
                found.setdefault((mine, joint.pin, joint.slide), joint)
    return tuple(found.values())


def among(links: set[str], every: tuple[Joint, ...], met: set[str]) -> tuple[Joint, ...]:
    """The joints within a set of links, without pins that join the set to others.

    A pin of k links of the set counts k - 1 times.
    """
    inside = [j for j in every if links >= set(j.links) and (not j.pin or j.pin not in met)]
    first = {joint.pin: joint.links[0] for joint in reversed(inside) if joint.pin}
    return tuple(j for j in inside if not j.pin or first[j.pin] in j.links)


def determined(scene: Scene, loops: Equations, group: Group, taken: int) -> bool:
    """Whether the equations up to a group determine it, by their rank in a random open position.

    Guides that lead one point of a link are first made to agree on its place, as in a closed
    position. Otherwise a block that keeps a wheel from its track would seem to hold the track's
    link, too.
    """
    exact = taken == 3 * len(group.links)
    if exact and ((group.is_dyad and len(group.slides) < 3) or is_sure(scene, group)):
        return True
    try:
        part = part_of(loops, group.known | set(group.links), setting_of(loops, 0))
    except StructureError:
        return False
    moving = moved_by(part, group)
    thrown = np.random.default_rng(7).uniform(-1, 1, (1, part.unknown_count)) * part.columns
    thrown = led_together(part, thrown)
    with np.errstate(all="ignore"):
        jacobian = part.scaled_jacobian(part.chains.at(thrown))[0][:, moving]
    if jacobian.shape[0] < jacobian.shape[1] or not np.isfinite(jacobian).all():
        return False
    values = np.linalg.svd(jacobian, compute_uv=False)
    return bool(values.min(initial=np.inf) > FULL * values.max(initial=0))


def led_together(part: Equations, unknowns: Reals) -> Reals:
    """The unknowns (1, K + m), changed so that guides that lead one point agree on its place.

    The guides belong to one link and to the blocks that slide along it, as for a plank on rollers
    or racks on one wheel. If the link itself has the point, the link gives its place.
    """
    found, places = unknowns.copy(), dict[tuple[str, str], Complexes]()
    blocks = {g.block: j for j, g in enumerate(part.guides) if g.turns_alike and g.first}

    def carriers(link: str) -> list[int]:
        """The guides along which a link slides, and those below it, one after the other."""
        under: list[int] = []
        while link in blocks and blocks[link] not in under:
            under.append(blocks[link])
            link = part.guides[under[-1]].on
        return under

    under = {guide.on: carriers(guide.on) for guide in part.guides}
    for j in sorted(range(len(part.guides)), key=lambda j: len(under[part.guides[j].on])):
        on, point = part.guides[j].on, part.guides[j].point
        below = under[on]
        root = part.guides[below[-1]].on if below else on
        place = places.get((root, point), part.bodies[root].get(point))
        if not point:
            continue
        if place is None:
            place = foot_of(part, found, j)
            for k in below:
                place = foot_of(part, found, k) + (place - own(part, k)) * part.guides[k].along
            places[root, point] = place
            continue
        for k in reversed(below):
            place = own(part, k) + (place - foot_of(part, found, k)) * np.conj(part.guides[k].along)
        slide_to(part, found, j, place)
    return found


def own(part: Equations, j: int) -> Complexes:
    """The point that a guide leads, in the axes of the guide's block."""
    guide = part.guides[j]
    return np.ravel(part.bodies[guide.block][guide.point])


def foot_of(part: Equations, unknowns: Reals, j: int) -> Complexes:
    """The place of the block's point on a guide, in the axes of the guide's link."""
    guide = part.guides[j]
    here = unknowns[0, part.turning_count + j] + 1j * guide.offset
    return np.ravel(guide.through + here * guide.along)


def slide_to(part: Equations, unknowns: Reals, j: int, foot: Complexes) -> None:
    """Slide a block along its guide until its point is nearest to a place."""
    guide = part.guides[j]
    way = (foot - guide.through) * np.conj(guide.along)
    unknowns[0, part.turning_count + j] = np.ravel(way.real)[0]


def is_sure(scene: Scene, group: Group) -> bool:
    """Whether a group is surely determined: one link driven about a pin or along a guide.

    A link turned about a pin by another wheel counts, too.
    """
    if not group.is_driven:
        return group.is_geared
    wanted = {tuple(sorted(joint.links[:2])) for joint in group.ties}
    kinds = {d.kind for d in scene.drivers if tuple(sorted((d.link, d.against))) in wanted}
    return kinds == ({"turn"} if group.outer[0].pin else {"slide"})


def moved_by(loops: Equations, group: Group) -> Mask:
    """The unknowns that belong to a group."""
    turned = loops.turned.of
    fixed = {turned[link] for link in group.known if link in turned}
    mine = {turned[link] for link in group.links} - fixed
    turnings = [k in mine for k in range(1, loops.turned.count)]
    settled = group.known | set(group.links)
    slides = [
        {guide.block, guide.on} <= settled and not {guide.block, guide.on} <= group.known
        for guide in loops.guides
    ]
    return np.array([*turnings, *slides], dtype=np.bool_)
