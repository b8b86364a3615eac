"""Groups of wheels, and the turns of links since the start of their wheels.

Wheels are turned by others, driven on a track, between two known wheels, or in a loop. In a loop no
wheel follows from known links alone. Once one link is tried, each further wheel is turned by its
contact with the one before. A contact with a known wheel then gives the position.

Pins show the direction of a link but not its number of turns, on which its wheels depend. The angle
is taken within half a turn of a reference: its start, plus the whole turns that the scene adds.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from graphkin.numbers.plane import Line, cross
from graphkin.scene.expression import CONSTANT, Name, Number, Pair, Tree
from graphkin.scene.findings import numbered
from graphkin.scene.model import FRAME, Driver, Rolling, Scene, of_one_size
from graphkin.scene.phrases import place_of
from graphkin.scene.quantity import Quantity, exact
from graphkin.structure.groups import (
    CoupledTrain,
    Driven,
    Geared,
    PinnedWheel,
    Spun,
    Train,
    TriedLink,
)
from graphkin.structure.pairs import (
    Contact,
    Joint,
    Joints,
    Pin,
    Placed,
    Sliding,
    contacts,
    partner,
)
from graphkin.structure.turning import LEVEL
from graphkin.text.errors import Problem, StructureError, message

FREE = 1e-12
"""Rate of a slip, per unit rate of the tried link, below which it is rounding."""


def pinned_wheels(
    placed: Placed, links: Sequence[str], placing: Collection[Joint]
) -> tuple[PinnedWheel, ...]:
    """The wheels or bars of a group that touch known links in rolling contact.

    A link that keeps them in contact belongs to the group. A contact that is not among the pairs
    ``placing`` the group is idle, or locks the mechanism; the rank shows which.
    """
    return tuple(
        PinnedWheel(pair, link, partner(pair, link))
        for link in links
        for pair in placed.joints.others[link]
        if isinstance(pair, Contact)
        and pair.rolling.belt is None
        and pair in placing
        and partner(pair, link) in placed.known
        and (pair.arm in links or (pair.track is None and pair.links[0] == link))
    )


def turned_wheel(joints: Joints, driver: Driver, link: str) -> Driven | None:
    """A wheel that a driver turns relative to the straight track on which it rolls."""
    for pair in joints.between(link, (driver.against,)):
        if isinstance(pair, Contact) and pair.links == (driver.link, driver.against):
            return Driven(link, driver, pair) if link == driver.link and pair.taken == 2 else None
    return None


def spun(placed: Placed, driver: Driver, link: str) -> Spun | None:
    """A link that a driver turns and that rolls on a known wheel, on an arm or block of its own."""
    joined = placed.held(link)
    if len(joined) != 1 or not isinstance(joined[0], Contact) or joined[0].alike:
        return None
    if driver.link != link:
        return None
    contact, holder = joined[0], joined[0].arm
    if holder is None or holder in placed.known:
        return None
    pivots, held = placed.held(holder), placed.inner(link, holder)
    if len(pivots) != 1 or len(held) != 1 or not isinstance(pivots[0], Pin):
        return None
    rolls = isinstance(held[0], Pin) if contact.track else contact.links[1] == link
    slides = contact.track is None and isinstance(held[0], Sliding)
    if not rolls or isinstance(held[0], Contact) or not (contact.track or slides):
        return None
    return Spun(link, driver, holder, pivots[0], held[0], contact)


def train_with(placed: Placed, arm: str, left: tuple[Joint, ...]) -> Train | None:
    """The arm of a planet that rolls on two known links, such as a sun and a ring."""
    if len(left) != 1 or not isinstance(left[0], Pin):
        return None
    for wheel in placed.joints.neighbours(arm):
        if wheel in placed.known:
            continue
        inner, outer = placed.inner(arm, wheel), placed.held(wheel)
        rolled = [pair for pair in outer if isinstance(pair, Contact) and not pair.alike]
        contacts = [pair for pair in rolled if pair.arm == arm]
        if len(inner) == 1 and isinstance(inner[0], Pin) and len(contacts) == len(outer) == 2:
            return Train(arm, wheel, left[0], inner[0], (contacts[0], contacts[1]))
    return None


def geared_of(link: str, joined: tuple[Joint, ...], known: Collection[str]) -> Geared | None:
    """A link with one pair and a contact that removes one freedom; further contacts are idle.

    A contact determines a rotation once the arm that keeps its distance is known, too.
    """
    ones = [pair for pair in joined if isinstance(pair, Contact) and pair.arm in known]
    twos = [pair for pair in joined if pair.taken == 2]
    return Geared(link, twos[0], ones[0]) if ones and len(twos) == 1 else None


def by_known(joints: Joints, wheel: Geared, known: Collection[str]) -> Geared:
    """A wheel turned by its contact with a known link if it has one, not through others."""
    return geared_of(wheel.link, joints.between(wheel.link, known), known) or wheel


def by_centres(inner: Joint, outer: tuple[Joint, Joint], links: tuple[str, str]) -> bool:
    """Whether the wheels of a dyad's two links are pinned to one another at their centres."""
    if isinstance(inner, Contact):
        return False
    wheels = [pair.wheel for pair in outer if isinstance(pair, Contact) and pair.links[0] in links]
    pins = [pair for pair in outer if isinstance(pair, Contact)]
    return not pins or (
        isinstance(inner, Pin) and all(wheel.centre == inner.point for wheel in wheels)
    )


def tracks_held(joints: Joints, links: Sequence[str]) -> tuple[str, ...]:
    """The links whose straight tracks carry wheels that no other link keeps in contact."""
    keepers = (None, *joints.scene.keepers)
    rolled = (pair for link in links for pair in joints.others[link] if isinstance(pair, Contact))
    tracks = (pair.links[1] for pair in rolled if pair.track is None and pair.arm in keepers)
    return tuple(dict.fromkeys(link for link in tracks if link in links))


def wedged_wheels(placed: Placed, links: Sequence[str]) -> tuple[str, ...]:
    """The links that roll on several straight tracks of known links."""
    straight = {
        link: [p for p in placed.held(link) if isinstance(p, Contact) and not p.track]
        for link in links
    }
    return tuple(link for link, pairs in straight.items() if len(pairs) > 1)


def let_slip(placed: Placed) -> Placed:
    """The mechanism without the wheels that determine nothing until their arm is known."""
    every = [pair for pairs in placed.joints.others.values() for pair in pairs]
    rolling = (pair for pair in every if isinstance(pair, Contact) and pair.arm is not None)
    loose = [pair for pair in rolling if pair.arm not in placed.known]
    return placed.by(placed.joints.without(loose))


def over_rolled(placed: Placed, grown: Placed, chain: Sequence[Any]) -> Contact | None:
    """A wheel that is known with all that it touches, but whose rolling is not used yet."""
    used = [pair for group in chain for pair in rolled_by(group)]
    joints = grown.joints
    for link in (each for each in joints.unknown(placed.known) if each in grown.known):
        for pair in joints.others[link]:
            if not isinstance(pair, Contact) or pair.arm is None or pair.alike or pair in used:
                continue
            if pair.needs <= grown.known and not keeps_parallel(joints, pair):
                return pair
    return None


def keeps_parallel(joints: Joints, contact: Contact) -> bool:
    """Whether a wheel of the same size rolls between the same two straight lines.

    The lines then stay parallel, however the wheels roll, so that the contact determines nothing.
    """
    own, on = contact.links
    tracks = straight_tracks(joints, own)
    for pair in joints.others[on]:
        if not isinstance(pair, Contact) or pair.links[0] == own:
            continue
        others = straight_tracks(joints, pair.links[0])
        shared = [on for on in tracks.keys() & others.keys() if same_line(tracks[on], others[on])]
        if len(shared) > 1 and of_one_size(contact.wheel, pair.wheel):
            return True
    return False


def straight_tracks(joints: Joints, wheel: str) -> dict[str, Line]:
    """The links on whose straight tracks a wheel rolls, with the lines of the tracks."""
    from graphkin.structure.touching_wheels import track_line

    pairs = (pair for pair in joints.others[wheel] if isinstance(pair, Contact))
    return {
        pair.links[1]: track_line(joints.scene, pair.rolling)
        for pair in pairs
        if pair.track is None and pair.links[0] == wheel
    }


def same_line(one: Line, other: Line) -> bool:
    """Whether two lines along unit vectors coincide but for rounding."""
    ways = other.along, other.point - one.point
    return all(abs(cross(one.along, way)) <= LEVEL * abs(way) for way in ways)


def rolled_by(group: Any) -> Iterator[Contact]:
    """The contacts by which the wheels of a group have been turned."""
    for each in getattr(group, "chain", ()):
        yield from rolled_by(each)
    pairs = (*getattr(group, "outer", ()), *getattr(group, "contacts", ()))
    last = getattr(group, "last", None)
    yield from (pair for pair in (*pairs, last) if isinstance(pair, Contact))


def next_coupled(placed: Placed, *, idle: bool = False) -> CoupledTrain | None:
    """The train of fewest links that closes once one link on a known pin is tried.

    A train whose ratios cancel closes in every position of the link, and so does not determine it.
    An example is two planets between one sun and one ring. With ``idle`` only these are found,
    otherwise only others.
    """
    contacts = [*left_over(placed)]
    if not contacts:
        return None
    found = (
        train
        for link in placed.unknown()
        for pin in pins_held(placed, link)
        for last in contacts
        if (train := closed(placed, TriedLink(link, pin), last))
        and idle == cancels(placed.scene, train)
    )
    return min(found, key=lambda train: len(train.links), default=None)


def left_over(placed: Placed) -> Iterator[Contact]:
    """The contacts of wheels with known ones, about arms that are not known yet."""
    for link in placed.unknown():
        for pair in placed.joints.others[link]:
            if not isinstance(pair, Contact) or pair.track is None or pair.alike:
                continue
            if pair.arm not in placed.known and partner(pair, link) in placed.known:
                yield pair


def pins_held(placed: Placed, link: str) -> list[Pin]:
    """The one pin that holds a link, if nothing else removes two freedoms."""
    held = [pair for pair in placed.held(link) if pair.taken == 2]
    return [pair for pair in held if isinstance(pair, Pin)] if len(held) == 1 else []


def closed(placed: Placed, tried: TriedLink, last: Contact) -> CoupledTrain | None:
    """The train formed by a tried link and a last contact, wheel after wheel, or None."""
    grown = Placed(placed.joints, {*placed.known, tried.link})
    chain, ends = list[Geared](), {*last.links, last.arm}
    while not ends <= grown.known:
        wheel = next_wheel(grown, last)
        if wheel is None:
            return None
        chain.append(wheel)
        grown.known.add(wheel.link)
    needs, kept = ends, list[Geared]()
    for each in reversed(chain):
        if each.link in needs:
            kept.insert(0, each)
            needs = {*needs, each.contact.arm, *each.contact.links, *each.pair.links}
    return CoupledTrain(tried, tuple(kept), last) if tried.link in needs else None


def next_wheel(placed: Placed, last: Contact) -> Geared | None:
    """The first wheel, in written order, that a wheel of a known link turns about a known pin."""
    for link in placed.unknown():
        joined = tuple(pair for pair in placed.held(link) if pair != last)
        wheel = geared_of(link, joined, placed.known)
        if wheel is None or wheel.contact.track is None or wheel.contact.alike:
            continue
        if isinstance(wheel.pair, Pin):
            return wheel
    return None


def cancels(scene: Scene, train: CoupledTrain) -> bool:
    """Whether the last contact never slips, however the tried link turns, for all parameters."""
    contacts = [*(each.contact for each in train.chain), train.last]
    radii = [w.radius for c in contacts for w in (c.wheel, c.track) if w and w.radius]
    names = sorted({name for radius in radii for name in radius.uses()} & {*scene.values})
    settings = [dict[str, Any](scene.values)]
    if names:
        more = {name: 1 + Fraction(1, 1009 + 2 * k) for k, name in enumerate(names)}
        settings.append({**settings[0], **{n: settings[0][n] * more[n] for n in names}})
    return all(abs(rate_missed(train, values)) < FREE for values in settings)


def rate_missed(train: CoupledTrain, values: Mapping[str, Any]) -> Any:
    """The slip rate of the last contact at unit rate of the tried link (Willis)."""
    rates: dict[str, Any] = {train.tried.link: 1}
    for wheel in train.chain:
        rates[wheel.link] = rate_rolled(wheel.contact, wheel.link, rates, values)
    own = train.closing
    return rates[own] - rate_rolled(train.last, own, rates, values)


def rate_rolled(
    contact: Contact, link: str, rates: Mapping[str, Any], values: Mapping[str, Any]
) -> Any:
    """The rate of a wheel from the rates of its arm and of the wheel that it touches."""
    sizes = dict(zip(contact.links, signed_radii(contact, values), strict=True))
    other = partner(contact, link)
    arm = rates.get(contact.arm or "", 0)
    return arm - (rates.get(other, 0) - arm) * sizes[other] / sizes[link]


def signed_radii(contact: Contact, values: Mapping[str, Any]) -> Sequence[Any]:
    """The radii of wheel and track, negative for a ring and for the track of an open belt."""
    belt = contact.rolling.belt
    found = []
    for wheel in (contact.wheel, contact.track):
        assert wheel is not None and wheel.radius is not None
        opposed = wheel.inside or (wheel is contact.track and belt is not None and not belt.crossed)
        found.append(wheel.radius.number(values) * (-1 if opposed else 1))
    return found


def turned_by_smaller(scene: Scene, wheel: Geared) -> bool:
    """Whether a wheel is turned by a smaller one, and so turns more slowly."""
    from graphkin.structure.touching_wheels import radius

    contact, link = wheel.contact, wheel.link
    if contact.track is None:
        return False
    own, other = radius(scene, contact.wheel), radius(scene, contact.track)
    return own > other if contact.links[0] == link else other > own


WHOLE: Mapping[str, Tree] = {
    "deg": Number(Fraction(360)),
    "rad": Pair("*", Number(Fraction(2)), Name(CONSTANT)),
}
"""A full turn in the units of angles."""


def counted_near(scene: Scene) -> Mapping[str, Quantity]:
    """The angle of each link within half a turn of which its angle is taken.

    It counts from the start of the rolling that states its turns, else of the first rolling. Raises
    StructureError where two rollings state turns of one link.
    """
    found = {link: near(rolling, link) for link, rolling in counting(scene).items()}
    return {**found, **scene.near}


def counting(scene: Scene) -> Mapping[str, Rolling]:
    """The rolling that counts the angle of each wheel's, track's and arm's link."""
    found: dict[str, Rolling] = {}
    for contact in contacts(scene):
        for link in (*contact.links, *([contact.arm] if contact.arm else [])):
            found.setdefault(link, contact.rolling)
            for driver in scene.drivers:
                if driver.kind == "turn" and driver.link == link:
                    found.setdefault(driver.against, contact.rolling)
    found.pop(FRAME, None)
    return found | stated_rolling(scene)


def stated_rolling(scene: Scene) -> dict[str, Rolling]:
    """The rolling that states the turns of a link, by link."""
    found: dict[str, Rolling] = {}
    problems = []
    for each in scene.every_link:
        for rolling in each.rolls:
            for link, count in rolling.turns.items():
                if link in found:
                    first = found[link].turns[link].place
                    problems.append(
                        Problem(
                            count.place,
                            message("{first} states them too", first=first),
                            message("one of both"),
                        )
                    )
                found.setdefault(link, rolling)
    if problems:
        raise StructureError(problems)
    return found


def near(rolling: Rolling, link: str) -> Quantity:
    """The angle of a link at the start, plus the stated whole turns."""
    start = rolling.start.get(link, exact(0, "deg"))
    if link not in rolling.turns:
        return start
    turns = rolling.turns[link]
    tree: Tree = Pair("+", start.tree, Pair("*", turns.tree, WHOLE[start.unit]))
    return Quantity(f"({start.text}) + ({turns.text}) turns", tree, start.unit, turns.place)


def place_of_turns(scene: Scene, link: str) -> str:
    """The key of the rolling that counts the angle of a link."""
    rolling = counting(scene).get(link)
    return next(
        numbered(f"{place_of(each.name)}.rolls", n, len(each.rolls))
        for each in scene.every_link
        for n, own in enumerate(each.rolls)
        if own is rolling or rolling is None
    )
