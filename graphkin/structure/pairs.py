"""The kinematic pairs of a scene, each between two links, and the pairs of each link.

Two links joined by equal bars, at congruent figures of pins, translate along circles relative to
one another. Two of the bars could also cross; the third one does not fit then. Each bar beyond the
first removes a freedom that the common direction has removed already.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations, pairwise
from typing import Any, ClassVar

from msgspec import Struct

from graphkin.scene.link_points import ends_of
from graphkin.scene.model import (
    FRAME,
    Driver,
    Link,
    Rolling,
    Scene,
    Slide,
    Wheel,
    joined_words,
    link_words,
    of_one_size,
)
from graphkin.structure.turning import body
from graphkin.text.errors import StructureError, both, message


class Pin(Struct, frozen=True):
    """A turning pair, a point of two links; its dyad letter and the freedoms that it removes."""

    symbol: ClassVar[str] = "R"
    taken: ClassVar[int] = 2

    point: str
    links: tuple[str, str]

    @property
    def brief(self) -> str:
        return f"pin {self.point}"

    @property
    def words(self) -> str:
        return f"{self.brief} of {joined_words(self.links)}"

    @property
    def place(self) -> str:
        """The pin's point; ``point`` may be one link's own point under it, such as A@3."""
        return ends_of(self.point)[0]


class Sliding(Struct, frozen=True):
    """A sliding pair, a block on a guide of another link, with its driver words as written."""

    symbol: ClassVar[str] = "P"
    moved_by: ClassVar[str] = "slide"
    moving: ClassVar[str] = "sliding"
    taken: ClassVar[int] = 2

    slide: Slide
    links: tuple[str, str]

    @property
    def words(self) -> str:
        return f"slide of block {self.block} on {link_words(self.links[1])}"

    brief = words

    @property
    def block(self) -> str:
        return self.links[0]

    def led_point(self, scene: Scene, link: str) -> str:
        """The point of one of its links that it guides along a line."""
        return scene.link(link).points[0]


class PinLine(Sliding, frozen=True):
    """The line along which two blocks guide each other, both on parallel guides of ``rail``.

    ``links`` are the later block and the first one, from which the line starts. ``slides`` are
    their pairs with the rail and ``pins`` their pins, in the same order. ``slide`` is the line as a
    guide of the first. ``on`` is the link that carries both pins, None where two links do.
    ``spare`` is the slide that is left out once the direction is known.
    """

    rail: str
    slides: tuple[Sliding, Sliding]
    pins: tuple[str, str]
    on: str | None
    spare: Sliding

    @property
    def named(self) -> str:
        """The link under which a scene states the direction of the rail.

        It is the rail, or another link if the rail has a way of its own as a block.
        """
        led = next((p.links[1] for p in self.slides if p.block == self.rail), None)
        return self.rail if led is None else next(link for link in self.links if link != led)

    @property
    def words(self) -> str:
        """Both blocks with the link on whose guides they slide."""
        block, start = self.links
        return f"slides of blocks {start} and {block} on {link_words(self.rail)}"

    brief = words


class ContactName(str):
    """The name of a contact point, which belongs to no scene: T, and T@3 as a point of link 3."""

    __slots__ = ()


class SlippingName(ContactName):
    """The name of a contact point where wheels may slip, with its own image on either link."""

    __slots__ = ()


def is_in_scene(point: str) -> bool:
    """Whether a scene names a point, so that it may be requested and a solution has it."""
    return not isinstance(point, ContactName)


def name_words(point: str) -> str:
    """A point by its name; a contact point is named as one."""
    return point if is_in_scene(point) else f"the contact {point}"


class Contact(Struct, frozen=True):
    """A wheel that rolls without slip on a straight track or on a wheel of another link.

    ``links`` are the wheel's and the track's. ``track`` is the wheel it rolls on, None for a
    straight track. ``arm`` is the link that already keeps the two in contact, None where only the
    contact does. ``letter`` names the contact point.
    """

    symbol: ClassVar[str] = "W"
    moving: ClassVar[str] = "rolling"

    rolling: Rolling
    links: tuple[str, str]
    wheel: Wheel
    track: Wheel | None
    arm: str | None
    letter: str

    @property
    def brief(self) -> str:
        return f"contact of {joined_words(self.links)}"

    @property
    def words(self) -> str:
        """The contact with its wheels, or its track, and the link that keeps their distance."""
        link, on = self.links
        track = "a track" if self.track is None else f"wheel {self.track.centre}"
        words = f"wheel {self.wheel.centre} of {link_words(link)} on {track} of {link_words(on)}"
        if self.rolling.belt is not None:
            kind = "crossed" if self.rolling.belt.crossed else "open"
            words = f"{kind} belt to wheel {self.wheel.centre} of link {link}"
            words += f" from {track} of {link_words(on)}"
        kept = "" if self.arm is None else f", at a distance that {link_words(self.arm)} keeps"
        return words + kept

    @property
    def moved_by(self) -> str:
        """A driver's word for it: a coordinate is counted only along a straight track."""
        return "roll" if self.track is None else ""

    @property
    def taken(self) -> int:
        """Freedoms that it removes: the slip, and the distance unless an arm keeps it."""
        return 2 if self.arm is None else 1

    @property
    def alike(self) -> bool:
        """Whether it is an open belt on wheels of one size, which turn alike without contact."""
        belt = self.rolling.belt
        if belt is None or belt.crossed or self.track is None:
            return False
        return of_one_size(self.wheel, self.track)

    @property
    def needs(self) -> set[str]:
        """The links that must be known before its slip can be checked."""
        return {*self.links} if self.arm is None else {*self.links, self.arm}

    def wheel_of(self, link: str) -> Wheel:
        """The wheel of one of its links."""
        wheel = self.wheel if self.links[0] == link else self.track
        assert wheel is not None
        return wheel

    def sign_of(self, scene: Scene, link: str) -> str:
        """The label of the wheel of one of its links."""
        return scene.link(link).wheel_sign(self.wheel_of(link))

    def led_point(self, scene: Scene, link: str) -> str:
        """The point of one of its links that it guides along a line: a wheel's centre."""
        return self.wheel.centre if self.links[0] == link else scene.link(link).points[0]


Pair = Pin | Sliding
Leading = Sliding | Contact
"""A pair that guides a point of one link along a line of the other."""
Joint = Pair | Contact
"""A pair that joins two links: a pin, a slide or a rolling contact."""


def meshes(scene: Scene, contact: Contact) -> bool:
    """Whether a contact is one of gears: two wheels, or a wheel on its pin with a rack.

    Other wheels roll along their track.
    """
    pinned = contact.arm is not None and contact.wheel.centre in scene.link(contact.arm).points
    return contact.track is not None or pinned


def pairs(scene: Scene) -> tuple[Pair, ...]:
    """All lower pairs; a pin shared by k links counts as k - 1 pairs (the multiple hinge)."""
    found: list[Pair] = []
    for point, links in sharers(scene).items():
        found += [Pin(point, joined) for joined in pairwise(links)]
    for link in scene.links.values():
        found += [Sliding(slide, (link.name, slide.on)) for slide in link.slides]
    return tuple(found)


def all_pairs(scene: Scene) -> tuple[Joint, ...]:
    """All pairs: pins, slides, rolling pairs. Raises StructureError for a gap of wheels."""
    return (*pairs(scene), *contacts(scene))


def refuse_loose(joints: Sequence[Joint]) -> None:
    """Raise StructureError for wheels that roll on one another with no arm between them."""
    for contact in joints:
        if not isinstance(contact, Contact) or contact.track is None or contact.arm is not None:
            continue
        centres = both((contact.track.centre, contact.wheel.centre))
        raise StructureError.at(
            f"links.{contact.links[0]}.rolls",
            message("no link carries both centres, {centres}", centres=centres),
            message(
                "an arm: a link with {track}-{wheel} = …",
                track=contact.track.centre,
                wheel=contact.wheel.centre,
            ),
            message("the arm keeps the wheels together; its weight and shape do not matter"),
        )


def sharers(scene: Scene) -> dict[str, tuple[str, ...]]:
    """The links that have each point, the frame first, then in written order."""
    owners: dict[str, list[str]] = {}
    for link in scene.every_link:
        for point in link.points:
            owners.setdefault(point, []).append(link.name)
    return {point: tuple(links) for point, links in owners.items()}


def contacts(scene: Scene) -> tuple[Contact, ...]:
    """All rolling pairs, in written order. Raises StructureError for wheels that do not touch."""
    if not any(link.rolls for link in scene.every_link):
        return ()
    from graphkin.scene.wheels import contact_letters

    letters = contact_letters(scene)
    return tuple(each for link in letters for each in contacts_of(scene, link, letters[link]))


def contacts_of(scene: Scene, link: str, letters: tuple[str, ...]) -> list[Contact]:
    """The rolling pairs of a link; each may rest on the tracks before it."""
    from graphkin.structure.touching_wheels import touching

    found: list[Contact] = []
    for rolling, letter in zip(scene.link(link).rolls, letters, strict=True):
        before = [(each.rolling, each.wheel) for each in found if each.track is None]
        touch = touching(scene, link, rolling, before)
        ends = touch.wheel, touch.track, touch.arm
        found.append(Contact(rolling, (link, rolling.on), *ends, letter))
    return found


ALIKE = 1e-9
"""Relative difference of two lengths, or of two directions, that rounding leaves."""


class Bar(Struct, frozen=True):
    """A link by its length and its pins on two others, with their places on these."""

    link: str
    length: float
    pins: tuple[str, str]
    near: complex
    far: complex


class ParallelSet(Struct, frozen=True):
    """The ``bars`` that keep two ``links`` parallel, and the pins of each bar on the two."""

    links: tuple[str, str]
    bars: tuple[str, ...]
    pins: tuple[tuple[str, str], ...]

    def line_on(self, link: str) -> tuple[str, str]:
        """Two pins on one of the links: their line is parallel to that of the other two."""
        on = self.links.index(link)
        return self.pins[0][on], self.pins[1][on]


def parallel_sets(scene: Scene) -> tuple[ParallelSet, ...]:
    """The sets of three or more bars between two links that stay parallel, in written order."""
    return tuple(
        found
        for links, pins in joining(scene).items()
        if len(pins) > 2
        for found in alike(links, bars_between(scene, links, pins))
    )


def way_between(
    sets: Sequence[ParallelSet], link: str, known: Collection[str]
) -> tuple[str, tuple[ParallelSet, ...]] | None:
    """The nearest known link to which sets keep a link parallel, and the sets from there on."""
    ways: dict[str, tuple[ParallelSet, ...]] = {link: ()}
    waiting = [link]
    for here in waiting:
        if here in known:
            return here, ways[here]
        for each in sets:
            if here in each.links:
                there = each.links[1] if each.links[0] == here else each.links[0]
                if there not in ways:
                    ways[there] = each, *ways[here]
                    waiting.append(there)
    return None


def is_spare(sets: Sequence[ParallelSet], bar: str, known: Collection[str]) -> bool:
    """Whether a bar belongs to a set of which another bar is known."""
    return any(bar in each.bars and {*each.bars} & {*known} - {bar} for each in sets)


Pins = tuple[str, str, str]
"""A link that joins two others, and its pin on each."""


def joining(scene: Scene) -> Mapping[tuple[str, str], list[Pins]]:
    """The links that join each two others by pins of their own, in written order."""
    owners = sharers(scene)
    found: dict[tuple[str, str], list[Pins]] = {}
    for link in (*scene.links.values(), scene.frame):
        for one, other in combinations(pinned_to(link, owners), 2):
            if one[0] != other[0] and one[1] != other[1]:
                (near, p), (far, q) = sorted((one, other))
                found.setdefault((near, far), []).append((link.name, p, q))
    return found


def pinned_to(link: Link, owners: Mapping[str, tuple[str, ...]]) -> Iterator[tuple[str, str]]:
    """The links that share a point with a link, each with that point."""
    for point in link.points:
        for other in owners[point]:
            if other != link.name:
                yield other, point


def bars_between(scene: Scene, links: tuple[str, str], every: Sequence[Pins]) -> list[Bar]:
    """The bars between two links."""
    near, far = (body(scene, link) for link in links)
    return [
        Bar(link, abs(own[q] - own[p]), (p, q), near[p], far[q])
        for link, p, q in every
        for own in (body(scene, link),)
    ]


def alike(links: tuple[str, str], left: list[Bar]) -> Iterator[ParallelSet]:
    """The sets of three or more equal bars between two links, at congruent figures of pins."""
    while len(left) > 2:
        first, *others = left
        left = others
        same = [bar for bar in others if abs(bar.length - first.length) <= ALIKE * first.length]
        for other in same:
            turn = turned(first, other)
            found = [bar for bar in same if turn and is_turned(first, bar, turn)]
            if len(found) > 1:
                every = first, *found
                bars, pins = (bar.link for bar in every), (bar.pins for bar in every)
                yield ParallelSet(links, tuple(bars), tuple(pins))
                left = [bar for bar in others if bar not in found]
                break


def turned(one: Bar, other: Bar) -> complex:
    """The rotation of the vector between two pins from link to link; 0 if lengths differ."""
    near, far = other.near - one.near, other.far - one.far
    if not near or abs(abs(far) - abs(near)) > ALIKE * abs(near):
        return 0j
    return far / near


def is_turned(one: Bar, other: Bar, turn: complex) -> bool:
    """Whether the vector between two pins has a given rotation from one link to the other."""
    near, far = other.near - one.near, other.far - one.far
    return bool(near) and abs(far - turn * near) <= ALIKE * abs(near)


class Joints:
    """The pairs of a scene, by link."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.owners = sharers(scene)
        self.order = {name: i for i, name in enumerate((FRAME, *scene.links))}
        self.names: tuple[str, ...] = tuple(scene.links)
        self.others: dict[str, list[Joint]] = {name: [] for name in self.order}
        every = all_pairs(scene)
        refuse_loose(every)
        for pair in every:
            if not isinstance(pair, Pin):
                for link in pair.links:
                    self.others[link].append(pair)
        self.beside = {name: self._beside(name) for name in self.order}
        self.found: dict[tuple[str, frozenset[str]], tuple[Joint, ...]] = {}

    def _beside(self, link: str) -> frozenset[str]:
        found = {o for point in self.scene.link(link).points for o in self.owners[point]}
        return frozenset((found | {partner(pair, link) for pair in self.others[link]}) - {link})

    def between(self, link: str, others: Collection[str]) -> tuple[Joint, ...]:
        """The pairs that join a link to a set of others; a shared pin counts once."""
        near = self.beside[link].intersection(others)
        if (link, near) not in self.found:
            self.found[link, near] = tuple(self._joining(link, near))
        return self.found[link, near]

    def _joining(self, link: str, near: Collection[str]) -> Iterator[Joint]:
        for point in self.scene.link(link).points if near else ():
            other = next((o for o in self.owners[point] if o in near), None)
            if other is not None:
                yield Pin(point, (link, other))
        for pair in self.others[link]:
            if partner(pair, link) in near:
                yield pair

    def inner(self, first: str, second: str, known: Collection[str]) -> tuple[Joint, ...]:
        """The pairs between two links, except pins that are already located on known links."""
        return tuple(
            pair
            for pair in self.between(first, (second,))
            if not isinstance(pair, Pin) or not any(o in known for o in self.owners[pair.point])
        )

    def neighbours(self, link: str) -> list[str]:
        """The links joined to a link by any pair, in written order."""
        return sorted(self.beside[link], key=self.order.__getitem__)

    def unknown(self, known: Collection[str]) -> Iterator[str]:
        """The links that are not known, in written order."""
        return (name for name in self.names if name not in known)

    def part(self, links: Collection[str]) -> Joints:
        """The pairs, with only some links treated as unknown."""
        return self._but(names=tuple(name for name in self.names if name in links))

    @cached_property
    def parallel(self) -> tuple[ParallelSet, ...]:
        """The sets of bars that keep two links parallel."""
        return parallel_sets(self.scene)

    def with_pins(self, pins: Sequence[tuple[Joint, Pin]]) -> Joints:
        """The pairs, with pins in place of some of them."""
        others = {
            link: [next((pin for held, pin in pins if held == pair), pair) for pair in pairs]
            for link, pairs in self.others.items()
        }
        owners = self.owners | {pin.point: pin.links for _, pin in pins}
        return self._but(found={}, others=others, owners=owners)

    def without(self, pairs: Collection[Joint]) -> Joints:
        """The pairs without some of them."""
        others = {
            link: [pair for pair in own if pair not in pairs] for link, own in self.others.items()
        }
        return self._but(found={}, others=others)

    def _but(self, **parts: Any) -> Joints:
        """A copy with some attributes replaced."""
        other = object.__new__(Joints)
        vars(other).update(vars(self) | parts)
        return other

    def apart(self, known: Collection[str], tied: Iterable[set[str]]) -> Iterator[set[str]]:
        """The unknown links in parts not joined by pairs or the sets ``tied``, in written order."""
        left = set(self.unknown(known))
        for first in self.names:
            if first not in left:
                continue
            part, new = {first}, {first}
            while new:
                beside = {other for link in new for other in self.neighbours(link)}
                beside |= {link for each in tied if each & new for link in each}
                new = (beside & left) - part
                part |= new
            left -= part
            yield part


class Placed:
    """The pairs of a mechanism, its links with known positions, and the drivers not used yet."""

    def __init__(
        self, joints: Joints, known: Iterable[str], waiting: Iterable[Driver] = ()
    ) -> None:
        self.joints, self.known, self.waiting = joints, {*known}, [*waiting]
        self.scene = joints.scene

    def held(self, link: str) -> tuple[Joint, ...]:
        """The pairs that join a link to known links; a shared pin counts once."""
        return self.joints.between(link, self.known)

    def inner(self, first: str, second: str) -> tuple[Joint, ...]:
        """The pairs between two links, except pins that are already located on known links."""
        return self.joints.inner(first, second, self.known)

    def unknown(self) -> Iterator[str]:
        """The links that are not known, in written order."""
        return self.joints.unknown(self.known)

    def by(self, joints: Joints) -> Placed:
        """The same links and drivers with other pairs."""
        return Placed(joints, self.known, self.waiting)


def partner(pair: Joint, link: str) -> str:
    """The other link of a pair."""
    return pair.links[1] if pair.links[0] == link else pair.links[0]
