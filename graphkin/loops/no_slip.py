"""Rolling without slip: wheels on straight tracks and on one another, as chains and linear rows.

A straight track guides the wheel's centre at a distance of the wheel's radius, and ties the wheel's
angle to the coordinate along the track. Two wheels tie their angles to the angle of the arm that
carries both centres. Where no link carries both, a massless arm from centre to centre is added.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.loops.rigid_bodies import Body, Guide, Numbers, Parallel, Reals, radius, written_line
from graphkin.numbers.arithmetic import Point, Real
from graphkin.scene.model import FRAME, Rolling, Scene, Wheel
from graphkin.text.errors import Message, StructureError, message


class Chain(Struct, frozen=True):
    """The sum of fixed[k]·e^{iθ_k} over turnings k and slid[j]·s_j·(direction j) over slides j."""

    fixed: Mapping[int, Point] = field(default_factory=dict)
    slid: Mapping[int, int] = field(default_factory=dict)

    def plus(self, turning: int, vector: Point) -> Chain:
        """The chain extended by a vector that is fixed in a turning."""
        return Chain({**self.fixed, turning: self.fixed.get(turning, 0j) + vector}, self.slid)

    def along(self, slide: int, sense: int) -> Chain:
        """The chain extended along a guide, or back along it with sense -1."""
        return Chain(self.fixed, {**self.slid, slide: self.slid.get(slide, 0) + sense})

    def minus(self, other: Chain) -> Chain:
        """The vector from the end of another chain to the end of this one."""
        fixed, slid = dict(self.fixed), dict(self.slid)
        for turning, vector in other.fixed.items():
            fixed[turning] = fixed.get(turning, 0j) - vector
        for slide, count in other.slid.items():
            slid[slide] = slid.get(slide, 0) - count
        return Chain(fixed, slid)


class Turnings(Struct, frozen=True):
    """The turning that each link belongs to, and the link's fixed lean (unit vector) against it.

    ``angle`` is the lean in radians, summed from guide to guide and not reduced. Turning 0 is the
    frame's, and its angle is zero.
    """

    of: Mapping[str, int]
    lean: Mapping[str, Point]
    angle: Mapping[str, Real]
    count: int


Found = tuple[dict[str, int], dict[str, Point], dict[str, Real]]


def turnings(
    links: Sequence[str], guides: Sequence[Guide], parallel: Sequence[Parallel]
) -> Turnings:
    """Collect the links that slide on one another, or that bars keep parallel, into turnings.

    The x axis of a block is parallel to its first guide.
    """
    tied = [(g.on, g.block, g.along) for g in guides if g.first and g.turns_alike]
    tied += [(*each.bodies, each.along) for each in parallel if {*each.bodies} <= {*links}]
    of: dict[str, int] = {}
    lean: dict[str, Point] = {}
    angle: dict[str, Real] = {}
    for seed in links:
        if seed not in of:
            of[seed], lean[seed], angle[seed] = max(of.values(), default=-1) + 1, 1 + 0j, 0.0
            spread(seed, tied, (of, lean, angle))
    return Turnings(of, lean, angle, max(of.values()) + 1)


def refuse_unknown_lean(turned: Turnings, guides: Sequence[Guide]) -> None:
    """Raise StructureError where a further guide of a block joins links of different turnings.

    The scene does not state the angle between the second link and the block.
    """
    for guide in guides:
        if guide.turns_alike and turned.of[guide.block] != turned.of[guide.on]:
            raise StructureError.at(
                f"links.{guide.block}.slides",
                message("the angle between this block and link {on} is not known", on=guide.on),
                hint=message(
                    "write link {on} as the block that slides on {block}",
                    on=guide.on,
                    block=guide.block,
                ),
            )


def spread(seed: str, tied: Sequence[tuple[str, str, Point]], found: Found) -> None:
    """Add every link that turns with the seed, from link to link.

    ``tied`` holds two links each, with the direction of the second in the axes of the first.
    """
    of, lean, angle = found
    waiting = [seed]
    while waiting:
        here = waiting.pop()
        for first, second, way in tied:
            if first == here and second not in of:
                other, along, turn = second, way, np.angle(way)
            elif second == here and first not in of:
                other, along, turn = first, 1 / way, -np.angle(way)
            else:
                continue
            of[other], lean[other], angle[other] = of[here], lean[here] * along, angle[here] + turn
            waiting.append(other)


class Tree:
    """A spanning tree of the joints from a root link; every joint outside it closes a loop."""

    def __init__(
        self,
        bodies: Mapping[str, Body],
        guides: Sequence[Guide],
        turned: Turnings,
        root: str = FRAME,
    ) -> None:
        self.bodies, self.guides, self.turned = bodies, guides, turned
        self.origins: dict[str, Chain] = {root: Chain()}
        self.spent: set[tuple[str, str]] = set()
        self.passed: set[int] = set()
        self.owners: dict[str, list[str]] = {}
        self.led: dict[str, list[int]] = {}
        for link, body in bodies.items():
            for point in body:
                self.owners.setdefault(point, []).append(link)
        for index, guide in enumerate(guides):
            for link in dict.fromkeys((guide.on, guide.block)):
                self.led.setdefault(link, []).append(index)
        waiting = [root]
        while waiting:
            waiting += self._reach_from(waiting.pop(0))

    def _reach_from(self, link: str) -> list[str]:
        """Attach to a link every body, not yet reached, that shares a pin or a guide with it."""
        reached = []
        for point in self.bodies[link]:
            for other in self.owners[point]:
                if other not in self.origins:
                    arm = -self.bodies[other][point]
                    self.origins[other] = self.step(self.at(link, point), other, arm)
                    self.spent |= {(point, link), (point, other)}
                    reached.append(other)
        for index in self.led.get(link, ()):
            guide = self.guides[index]
            if guide.on == link and guide.block not in self.origins:
                place = self.on_guide(index).along(index, 1)
                self.origins[guide.block] = self.step(place, guide.block, -self.head(index))
                reached.append(guide.block)
            elif guide.block == link and guide.on not in self.origins:
                way = self.step(self.origins[link], link, self.head(index)).along(index, -1)
                foot = guide.through + 1j * guide.offset * guide.along
                self.origins[guide.on] = self.step(way, guide.on, -foot)
                reached.append(guide.on)
            else:
                continue
            self.passed.add(index)
        return reached

    def step(self, chain: Chain, link: str, vector: Point) -> Chain:
        """The chain extended by a vector in the axes of a link."""
        return chain.plus(self.turned.of[link], self.turned.lean[link] * vector)

    def at(self, link: str, point: str) -> Chain:
        return self.step(self.origins[link], link, self.bodies[link][point])

    def on_guide(self, index: int) -> Chain:
        """The chain to the place of a block at slide coordinate zero."""
        guide = self.guides[index]
        foot = guide.through + 1j * guide.offset * guide.along
        return self.step(self.origins[guide.on], guide.on, foot)

    def head(self, index: int) -> Point:
        """The point of a block that lies on guide ``index``, in the block's axes."""
        guide = self.guides[index]
        return self.bodies[guide.block].get(guide.point, 0j)

    def closures(self) -> dict[str, Chain]:
        """The chains that must vanish: pins reached twice and blocks whose guide closes a loop."""
        found: dict[str, Chain] = {}
        holder: dict[str, str] = {}
        for link in self.origins:
            for point in self.bodies[link]:
                if holder.setdefault(point, link) == link:
                    continue
                if not {(point, link), (point, holder[point])} <= self.spent:
                    words = message(
                        "pin {point} of links {one} and {other}",
                        point=point,
                        one=holder[point],
                        other=link,
                    )
                    found[words] = self.at(holder[point], point).minus(self.at(link, point))
        for index, guide in enumerate(self.guides):
            if index not in self.passed:
                place = self.on_guide(index).along(index, 1)
                head = self.step(self.origins[guide.block], guide.block, self.head(index))
                words = message(
                    "guide {number} of link {block} on link {on}"
                    if guide.turns_alike
                    else "track {number} of link {block} on link {on}",
                    number=guide.number + 1,
                    block=guide.block,
                    on=guide.on,
                )
                found[words] = head.minus(place)
        return found


# --- rolling without slip -------------------------------------------------------------------------


TOUCH = 1e-6
"""Largest gap between wheels that touch, as a share of their distance."""


ROUND = 1e-9
"""Radians by which rounding may move an angle across half a turn."""


class NoSlip(Struct, frozen=True, eq=False):
    """No slip: the sum of weight·(angle - start) over links, plus side·s of a track, is zero.

    ``weights`` are in metres and ``starts`` in radians, by link. ``track`` is the straight track,
    or None between two wheels. ``links`` are the wheel, the track or other wheel, and the arm.
    ``turned`` holds the angles (radians) near which the scene states links to be, with whole turns;
    ``near`` holds their angles at the start.
    """

    links: tuple[str, ...]
    weights: Mapping[str, Real]
    starts: Mapping[str, Real]
    turned: Mapping[str, Real]
    near: Mapping[str, Real]
    track: Guide | None = None
    side: int = 0


class Gear(Struct, frozen=True, eq=False):
    """Two wheels in contact or on one belt, their radii (m) and the arm that carries both centres.

    ``sense`` is +1 for external contact or a crossed belt, -1 for a wheel in a ring or an open
    belt.
    """

    links: tuple[str, str]
    wheels: tuple[Wheel, Wheel]
    radii: tuple[Real, Real]
    sense: int
    arm: str
    rolling: Rolling


class CountedApart(Struct, frozen=True, eq=False):
    """A link in equation ``row`` that turns as one with others but counts its own whole turns.

    The link is ``lean`` (radians) ahead of its ``turning``. It stays within half a turn of
    ``near``, whatever the whole turns of the others: its pins only show its direction. ``weight``
    is the factor of its angle in the equation.
    """

    row: int
    turning: int
    weight: Real
    lean: Reals
    near: Reals

    def excess(self, unknowns: Reals) -> Reals:
        """The contribution to the equation of whole turns that this link does not count: (N,)."""
        angle = unknowns[:, self.turning - 1] + self.lean
        return np.asarray(self.weight * (angle - within_half_a_turn(angle, self.near)))


class Slips(Struct, frozen=True, eq=False):
    """All no-slip conditions: ``rows`` (N, R, K + m) times the unknowns plus ``constant`` (N, R).

    The result is in metres. ``links`` are the links that each row ties. ``apart`` are those of them
    that count their own turns. ``counted`` gives, by turning, the angle (radians) near which it is
    counted (N,).
    """

    rows: Reals
    constant: Reals
    links: tuple[tuple[str, ...], ...]
    counted: Mapping[int, Reals]
    apart: tuple[CountedApart, ...]

    @property
    def words(self) -> list[Message]:
        """The description of each row."""
        return [
            message("the contact of link {wheel} with {on}", wheel=wheel, on=on)
            for wheel, on, *_ in self.links
        ]

    def residual(self, unknowns: Reals) -> Reals:
        """The slip (m): shape (N, R)."""
        slipped = np.asarray((self.rows @ unknowns[:, :, None])[:, :, 0] + self.constant)
        for link in self.apart:
            slipped[:, link.row] -= link.excess(unknowns)
        return slipped

    @property
    def waits(self) -> Reals:
        """The unknowns that must be known before each row can determine another: (R, K + m)."""
        return waiting(self.apart, self.rows.shape[1:])


def waiting(apart: Sequence[CountedApart], shape: tuple[int, ...]) -> Reals:
    """The unknowns that an equation needs before it determines another: of links apart."""
    found = np.zeros(shape)
    for link in apart:
        found[link.row, link.turning - 1] = 1
    return found


def gears_of(
    scene: Scene, bodies: Mapping[str, Body], numbers: Numbers
) -> tuple[tuple[Gear, ...], dict[str, Body]]:
    """All pairs of wheels that roll on one another, and the bodies of the added arms."""
    gears, added = list[Gear](), dict[str, Body]()
    for link in scene.every_link:
        for rolling in link.rolls:
            if rolling.through is not None or rolling.on not in bodies:
                continue
            kept = carried_pairs(scene, link.name, rolling, bodies, numbers)
            gear = touching(link.name, rolling, kept, bodies, numbers) if kept else None
            if gear is None:
                gear = replace(
                    pair(scene, link.name, rolling, *(rolling.wheels or (0, 0)), numbers),
                    arm=f"{link.name}~{rolling.on}",
                )
                first, second = (wheel.centre for wheel in gear.wheels)
                apart = abs(gear.radii[1] + gear.sense * gear.radii[0])
                added[gear.arm] = {second: 0j, first: apart + 0j}
            gears.append(gear)
    return tuple(gears), added


def pair(scene: Scene, name: str, rolling: Rolling, i: int, k: int, numbers: Numbers) -> Gear:
    """The i-th wheel of a link with the k-th of the link that it rolls on, without an arm."""
    wheels = scene.link(name).wheels[i], scene.link(rolling.on).wheels[k]
    radii = radius(wheels[0], numbers), radius(wheels[1], numbers)
    sense = -1 if wheels[0].inside or wheels[1].inside else 1
    if rolling.belt is not None:
        sense = rolling.belt.sense
    return Gear((name, rolling.on), wheels, radii, sense, "", rolling)


def carried_pairs(
    scene: Scene, name: str, rolling: Rolling, bodies: Mapping[str, Body], numbers: Numbers
) -> list[Gear]:
    """Every pair of wheels of two links whose centres lie on a third link."""
    found = []
    for i in range(len(scene.link(name).wheels)):
        for k in range(len(scene.link(rolling.on).wheels)):
            if rolling.wheels is not None and (i, k) != rolling.wheels:
                continue
            gear = pair(scene, name, rolling, i, k, numbers)
            centres = {wheel.centre for wheel in gear.wheels}
            arms = [each for each in bodies if each not in gear.links]
            arm = next((each for each in arms if centres <= set(bodies[each])), None)
            if arm is not None:
                found.append(replace(gear, arm=arm))
    return found


def touching(
    name: str, rolling: Rolling, kept: Sequence[Gear], bodies: Mapping[str, Body], numbers: Numbers
) -> Gear:
    """The pair whose radii fit the distance of the centres best.

    Raises StructureError in a single scene where none fit.
    """

    def gap(gear: Gear) -> float:
        body = bodies[gear.arm]
        apart = abs(body[gear.wheels[0].centre] - body[gear.wheels[1].centre])
        needed = abs(gear.radii[0] + gear.sense * gear.radii[1])
        return float(np.nanmax(numbers.reals(abs(apart - needed) / np.maximum(apart, needed))))

    best = min(kept, key=gap)
    if best.rolling.belt is None and numbers.single and not gap(best) <= TOUCH:
        first, second = (wheel.centre for wheel in best.wheels)
        raise StructureError.at(
            f"links.{name}.rolls",
            message("the wheels of links {name} and {on} do not touch", name=name, on=rolling.on),
            message(
                "radii that make the distance {first}-{second} on link {arm}",
                first=first,
                second=second,
                arm=best.arm,
            ),
        )
    return best


def tracks_of(
    scene: Scene,
    bodies: Mapping[str, Body],
    starts: Mapping[str, Point],
    slides: tuple[Guide, ...],
    turned: Turnings,
    numbers: Numbers,
) -> tuple[tuple[Guide, ...], tuple[tuple[int, Rolling, Real], ...]]:
    """The slides and, after them, the straight tracks; for each track its rolling and radius (m).

    A link with several wheels rolls on the wheel whose radius equals the height at which other
    joints hold its centre. If there is none, the first written wheel counts. A ring never does.
    """
    guides, rolled = list(slides), list[tuple[int, Rolling, Real]]()
    for link in scene.every_link:
        for number, rolling in enumerate(link.rolls):
            if rolling.through is None or rolling.on not in bodies:
                continue
            line = written_line(rolling, bodies[rolling.on], starts[rolling.on], numbers)
            first = not any(guide.block == link.name for guide in guides)
            plain = Guide(link.name, rolling.on, *line, 0.0, first, "", number, "roll")
            found = [
                replace(plain, offset=rolling.side * radius(wheel, numbers), point=wheel.centre)
                for wheel in link.wheels
                if not wheel.inside
            ]
            track = found[0]
            if len(found) > 1:
                track = kept(Tree(bodies, guides, turned, rolling.on), found)
            rolled.append((len(guides), rolling, abs(track.offset)))
            guides.append(track)
    return tuple(guides), tuple(rolled)


def kept(tree: Tree, found: Sequence[Guide]) -> Guide:
    """The track of the wheel whose radius is the height that other joints hold, or the first."""
    for track in found:
        level = height(tree, track)
        if level is not None and np.all(abs(level - track.offset) <= TOUCH * abs(level)):
            return track
    return found[0]


def height(tree: Tree, track: Guide) -> Real | None:
    """The height (m) to the left of a track at which other joints hold a wheel's centre."""
    if not {track.block, track.on} <= set(tree.origins):
        return None
    foot = tree.step(tree.origins[track.on], track.on, track.through)
    holders = [link for link, body in tree.bodies.items() if track.point in body]
    turning = tree.turned.of[track.on]
    along = tree.turned.lean[track.on] * track.along
    for holder in (link for link in holders if link in tree.origins):
        way = tree.at(holder, track.point).minus(foot)
        fixed = {k: vector for k, vector in way.fixed.items() if np.any(abs(vector) > 0)}
        slid = [tree.guides[j] for j, count in way.slid.items() if count]
        level = [tree.turned.lean[g.on] * g.along * np.conj(along) for g in slid]
        inside = all(tree.turned.of[g.on] == turning for g in slid)
        if set(fixed) <= {turning} and inside and all(np.all(abs(z.imag) < TOUCH) for z in level):
            return (fixed.get(turning, 0j) * np.conj(along)).imag
    return None


def slips_of(
    gears: Sequence[Gear],
    rolled: Sequence[tuple[int, Rolling, Real]],
    guides: Sequence[Guide],
    numbers: Numbers,
) -> tuple[NoSlip, ...]:
    """The no-slip conditions, tracks first."""
    found = []
    for index, rolling, size in rolled:
        track = guides[index]
        wheel, on = track.block, track.on
        starts = {wheel: at_start(rolling, wheel, numbers), on: 0.0}
        near = {link: at_start(rolling, link, numbers) for link in (wheel, on)}
        turned, weights = counted_at(rolling, numbers), {wheel: size, on: -size}
        if wheel == FRAME:
            turned.setdefault(on, near[on])
        found.append(NoSlip((wheel, on), weights, starts, turned, near, track, side=rolling.side))
    for gear in gears:
        (wheel, on), (own, other) = gear.links, gear.radii
        weights = {wheel: own, on: gear.sense * other, gear.arm: -own - gear.sense * other}
        starts = {link: at_start(gear.rolling, link, numbers) for link in weights}
        turned = counted_at(gear.rolling, numbers)
        found.append(NoSlip((wheel, on, gear.arm), weights, starts, turned, starts))
    return tuple(found)


def at_start(rolling: Rolling, link: str, numbers: Numbers) -> Real:
    """The angle of a link (radians) in the position from which a rolling counts."""
    return numbers.si(rolling.start[link]) if link in rolling.start else 0.0


def counted_at(rolling: Rolling, numbers: Numbers) -> dict[str, Real]:
    """The stated angles (radians) of links: the angle at the start plus the stated whole turns."""
    return {
        link: at_start(rolling, link, numbers) + 2 * np.pi * numbers.si(turns)
        for link, turns in rolling.turns.items()
    }


def packed_slips(
    slips: Sequence[NoSlip],
    counted: Mapping[int, Reals],
    own_turns: OwnTurns,
    turned: Turnings,
    guides: Sequence[Guide],
    numbers: Numbers,
) -> Slips:
    """The no-slip conditions as arrays."""
    alone = list[CountedApart]()
    rows = np.zeros((numbers.count, len(slips), turned.count + len(guides)))
    constant = np.zeros((numbers.count, len(slips)))
    for r, slip in enumerate(slips):
        if slip.track is not None:
            j = next(j for j, guide in enumerate(guides) if guide is slip.track)
            rows[:, r, turned.count + j] += slip.side
        for link, weight in slip.weights.items():
            start, angle = numbers.reals(slip.starts[link]), numbers.reals(turned.angle[link])
            rows[:, r, turned.of[link]] += weight
            constant[:, r] += weight * (angle - start)
            alone += own_turns.of(r, link, weight, turned, numbers)
    links = tuple(slip.links for slip in slips)
    return Slips(rows[:, :, 1:], constant, links, counted, tuple(alone))


class OwnTurns(Struct, frozen=True, eq=False):
    """The links that count their own whole turns, although they turn as one with others.

    Each of ``links`` is within half a turn of its angle in ``near`` (radians). ``doubtful`` marks a
    choice that depends on which of several links the pins determine first.
    """

    links: Collection[str]
    near: Mapping[str, Real]
    doubtful: bool

    def of(
        self, row: int, link: str, weight: Real, turned: Turnings, numbers: Numbers
    ) -> list[CountedApart]:
        """The link's correction to an equation, if it counts differently from its turning."""
        if link not in self.links or not turns_with_others(link, turned):
            return []
        lean, near = (numbers.reals(z) for z in (turned.angle[link], self.near.get(link, 0.0)))
        return [CountedApart(row, turned.of[link], weight, lean, near)]


def turns_with_others(link: str, turned: Turnings) -> bool:
    return list(turned.of.values()).count(turned.of[link]) > 1


def own_turns_of(
    scene: Scene,
    slips: Sequence[NoSlip],
    turned: Turnings,
    near: Mapping[str, Real],
    known: Mapping[str, int],
) -> OwnTurns:
    """The links that count their own whole turns.

    Excluded are links that turn with a driven link, or with a link whose angle a contact
    determines. Contacts are taken one after another, as soon as only one angle of theirs is
    unknown. Where none is ready, pins determine one angle: that of the first group that is
    ``known``, and of a link other than a wheel first.
    """
    of, led, doubtful = turned.of, set[str](), False
    turning = turning_ends(scene, known)
    from_frame = turned_from_frame(scene, turned)
    driven = from_frame | {of[end] for end, _ in turning.values()}
    determined, left = set(driven), list(slips)

    def unknown(slip: NoSlip) -> list[str]:
        return [link for link in slip.weights if of[link] not in determined]

    def leads(slip: NoSlip) -> bool:
        return slip.track is None or slip.links[0] in unknown(slip) or not unknown(slip)

    while left:
        ready = (slip for slip in left if len(unknown(slip)) < 2 and leads(slip))
        if (slip := next(ready, None)) is not None:
            left.remove(slip)
            led.update(unknown(slip))
            determined.update(of[link] for link in slip.weights)
            continue
        wheels = {of[slip.links[0]] for slip in left}
        missing = [link for slip in left for link in unknown(slip)]
        doubtful |= len({of[link] for link in missing}) > 1
        determined.add(of[min(missing, key=lambda link: (known.get(link, 0), of[link] in wheels))])
    counted = driven | {of[link] for link in led}
    links = {each for slip in slips for each in slip.weights}
    links |= {base for _, base in turning.values()}
    own = frozenset(link for link in links if of[link] not in counted)
    concerned = any(turns_with_others(link, turned) for link in links if of[link] not in driven)
    free = (end for ends in turning.values() for end in ends if of[end] not in from_frame)
    either = bool(slips) and any(turns_with_others(end, turned) for end in free)
    return OwnTurns(own, near, (doubtful and concerned) or either)


def starting_angles(scene: Scene, slips: Sequence[NoSlip], numbers: Numbers) -> dict[str, Real]:
    """The angle (radians) near which each link of a wheel contact is counted.

    The order of precedence: the angle given by a motion, the turns that the scene states, and the
    start of the rolling written first.
    """
    found = {link: numbers.si(angle) for link, angle in scene.near.items()}
    order = [FRAME, *scene.links]
    written = sorted(slips, key=lambda slip: order.index(slip.links[0]))
    for angles in (*(slip.turned for slip in slips), *(slip.near for slip in written)):
        for link, angle in angles.items():
            found.setdefault(link, angle)
    return found


def standing(turned: Turnings, near: Mapping[str, Real], numbers: Numbers) -> Turnings:
    """The turnings with each link that never turns within half a turn of its angle in ``near``.

    A link without such an angle is taken near zero.
    """
    still = [link for link, k in turned.of.items() if k == turned.of[FRAME] and link != FRAME]
    found = {
        link: within_half_a_turn(
            numbers.reals(turned.angle[link]), numbers.reals(near.get(link, 0.0))
        )
        for link in still
    }
    return replace(turned, angle={**turned.angle, **found})


def within_half_a_turn(angle: Reals, start: Reals) -> Reals:
    """The angle shifted by whole turns to within half a turn of ``start``, in radians."""
    beyond = np.ceil((angle - start - np.pi - ROUND) / (2 * np.pi))
    return np.asarray(angle - 2 * np.pi * beyond)


def counted_turnings(
    scene: Scene,
    slips: Sequence[NoSlip],
    turned: Turnings,
    numbers: Numbers,
    known: Mapping[str, int],
) -> dict[int, Reals]:
    """By turning, the angle (radians) within half a turn of which it is counted: (N,).

    The whole turns that the scene states come first, then the start of the rolling written first. A
    reference link of a driver that turns others counts from zero, where no wheel states more.
    """
    found: dict[int, Reals] = {}

    def count(link: str, angle: Real) -> None:
        if link in turned.of:
            found.setdefault(turned.of[link], numbers.reals(angle - turned.angle[link]))

    if not slips:
        return found
    for link, angle in scene.near.items():
        count(link, numbers.si(angle))
    for slip in slips:
        for link, angle in slip.turned.items():
            count(link, angle)
    order = [FRAME, *scene.links]
    for slip in sorted(slips, key=lambda slip: order.index(slip.links[0])):
        for link, angle in slip.near.items():
            count(link, angle)
    for base in turned_from(scene, turned, known).values():
        count(base, 0.0)
    found.pop(turned.of[FRAME], None)
    return found


def turning_ends(scene: Scene, known: Mapping[str, int]) -> dict[int, tuple[str, str]]:
    """By the number of a driver that turns: the link that it turns, and the link it turns it from.

    The latter is of the group that is ``known`` first, if it is given, whichever of the two the
    driver names first.
    """
    found = dict[int, tuple[str, str]]()
    for d, driver in enumerate(scene.drivers):
        if driver.kind == "turn":
            first, second = known.get(driver.link, 0), known.get(driver.against, 0)
            ends = driver.link, driver.against
            found[d] = ends[::-1] if 0 < first < second else ends
    return found


def turned_from(scene: Scene, turned: Turnings, known: Mapping[str, int]) -> dict[int, str]:
    """The links from which drivers turn others and which no driver turns, by the driver's number.

    Where two drivers turn one link, the later of them moves its second-named link instead.
    """
    ends = turning_ends(scene, known)
    turning = [turned.of.get(link, -1) for link, _ in ends.values()]
    determined = turned_from_frame(scene, turned)
    return {
        d: base
        for n, ((d, (_, base)), k) in enumerate(zip(ends.items(), turning, strict=True))
        if k not in determined
        and (k < 0 or k not in turning[:n])
        and turned.of.get(base) not in turning
    }


def turned_from_frame(scene: Scene, turned: Turnings) -> set[int]:
    """The turnings that drivers determine, one against the other, starting from the frame."""
    pairs = [
        {turned.of.get(driver.link, -1), turned.of.get(driver.against, -1)}
        for driver in scene.drivers
        if driver.kind == "turn"
    ]
    found, more = set[int](), {turned.of[FRAME]}
    while more:
        found |= more
        more = {k for pair in pairs if pair & found for k in pair} - found - {-1}
    return found
