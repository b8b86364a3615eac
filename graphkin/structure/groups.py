"""Driven links and Assur groups as records: their dependencies and their names."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from msgspec import Struct

from graphkin.scene.findings import natural
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME, Driver, joined_words, link_words
from graphkin.structure.pairs import (
    Contact,
    ContactName,
    Joint,
    Leading,
    ParallelSet,
    Pin,
    PinLine,
    Sliding,
    partner,
)
from graphkin.text.errors import NO_WORDS, Message, message
from graphkin.text.tables import listed

Joined = tuple[str, str]


def assur_class(inner: Sequence[Joined], outer: Sequence[str]) -> tuple[int, int]:
    """Class and order of a group, from its inner pairs (two links each) and its outer pairs (one).

    A link is a contour with as many sides as it has pairs. A loop of links is one with as many
    sides as links. Bars and blocks alone form class II. A pin of k of the group's links is k - 1
    inner pairs.
    """
    sides = Counter(outer)
    for pair in inner:
        sides.update(pair)
    return max(2, *sides.values(), *loop_sizes(inner)), len(outer)


def loop_sizes(joined: Sequence[Joined]) -> list[int]:
    """Numbers of links in the independent closed loops, each as short as possible.

    Horton's minimum cycle basis: short loops through every node and edge, kept while independent.
    """
    kept: dict[int, int] = {}
    sizes = []
    for loop in sorted(set(short_loops(joined)), key=lambda loop: (loop.bit_count(), loop)):
        rest = reduced(loop, kept)
        if rest:
            kept[rest.bit_length()] = rest
            sizes.append(loop.bit_count())
    return sizes


def reduced(loop: int, kept: Mapping[int, int]) -> int:
    """The remainder of a loop, a set of edges as bits, after reduction by the known loops."""
    while loop and loop.bit_length() in kept:
        loop ^= kept[loop.bit_length()]
    return loop


def short_loops(joined: Sequence[Joined]) -> Iterator[int]:
    """For each node and edge, the loop of shortest paths from the node to both ends of the edge."""
    for node in dict.fromkeys(link for pair in joined for link in pair):
        ways = shortest_ways(joined, node)
        for number, (one, other) in enumerate(joined):
            if one in ways and other in ways:
                yield ways[one] ^ ways[other] ^ (1 << number)


def shortest_ways(joined: Sequence[Joined], start: str) -> dict[str, int]:
    """The edges, as bits, of a shortest path from one link to each connected link."""
    ways, waiting = {start: 0}, [start]
    for here in waiting:
        for number, pair in enumerate(joined):
            if here in pair:
                there = pair[1] if pair[0] == here else pair[0]
                if there not in ways:
                    ways[there] = ways[here] | (1 << number)
                    waiting.append(there)
    return ways


ROMAN = ("", "I", "II", "III", "IV", "V", "VI", "VII", "VIII")


class OneLink(Struct, frozen=True):
    """A group of one link."""

    link: str

    @property
    def links(self) -> tuple[str]:
        return (self.link,)


class Crank(OneLink, frozen=True):
    """A link that a driver turns about a pin with known motion.

    Link ``base`` carries the pin. It may be another than the one against which the driver turns.
    """

    driver: Driver
    pivot: str
    base: str

    @property
    def against(self) -> str:
        """Words for the reference link of its rotation; empty for the frame."""
        other = other_of(self.driver, self.link)
        return "" if other == FRAME else f" against link {other}"

    @property
    def title(self) -> str:
        return f"driven by a crank about {self.pivot}" + (self.against and f",{self.against}")

    @property
    def words(self) -> str:
        """Its kind, class and order, its links and the pairs that join it."""
        named = "crank" if self.link == "crank" else f"crank {self.link}"
        return f"{named} about {self.pivot}{self.against} (class I)"


class Driven(OneLink, frozen=True):
    """A link that a driver moves along a guide or a track of a known link."""

    driver: Driver
    pair: Leading

    @property
    def outer(self) -> tuple[Joint]:
        """Its pair with a known link."""
        return (self.pair,)

    @property
    def title(self) -> str:
        against = other_of(self.driver, self.link)
        beside = "frame" if against == FRAME else f"link {against}"
        return f"driven, {self.pair.moving} on {beside}"

    @property
    def words(self) -> str:
        """Its kind, class and order, its links and the pairs that join it."""
        return f"link {self.link} driven (class I): {self.pair.words}"


class Tie(OneLink, frozen=True):
    """A link that two pairs join to known links: idle on two pins, a wedge on two guides."""

    first: Joint
    second: Joint

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with known links."""
        return self.first, self.second

    @property
    def title(self) -> str:
        if isinstance(self.first, Sliding):
            return "led by two guides"
        return "idle: joins what moves together without it"

    @property
    def words(self) -> str:
        """Its link, and the pairs that hold it."""
        held = listed(pair.brief for pair in self.outer)
        if isinstance(self.first, Sliding):
            led = f"link {self.link} led by {held}"
            return f"{led}: both tell how it is turned, so that one is idle"
        return f"link {self.link} between {held}, which are placed already: it must be idle"


class TriedLink(OneLink, frozen=True):
    """A link whose position in its pair with a known link is tried until the rest closes."""

    pair: Joint

    @property
    def words(self) -> str:
        return f"tried at link {self.link} on {self.pair.brief}"


def other_of(driver: Driver, link: str) -> str:
    return driver.against if driver.link == link else driver.link


class Geared(OneLink, frozen=True):
    """A wheel or a rack on a pair with a known link, turned by a contact."""

    pair: Joint
    contact: Contact

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with known links."""
        return self.pair, self.contact

    @property
    def title(self) -> Message:
        return message(
            "has a belt with link {name}" if self.is_belted else "rolls on link {name}",
            name=partner(self.contact, self.link),
        )

    @property
    def words(self) -> str:
        """Its pair, and the contact that moves it."""
        other = link_words(partner(self.contact, self.link))
        return f"link {self.link} on {self.pair.brief}, moved by its contact with {other}"

    @property
    def is_belted(self) -> bool:
        """Whether a belt turns it."""
        return self.contact.rolling.belt is not None

    @property
    def one_way(self) -> Message:
        """Why it has only one closure."""
        return message("link {link} follows from its contact in one way only", link=self.link)


class Spun(Struct, frozen=True):
    """A wheel or bar turned by a driver, on a ``holder`` that follows from its contact.

    The holder, on a known pin, is the arm of a wheel (``held`` by a pin). For a bar that rolls on a
    drum, it is the block on which the bar slides.
    """

    link: str
    driver: Driver
    holder: str
    pivot: Pin
    held: Pin | Sliding
    contact: Contact

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with known links."""
        return self.pivot, self.contact

    @property
    def links(self) -> tuple[str, str]:
        """The holder, and the link it holds."""
        return (self.holder, self.link)

    @property
    def title(self) -> str:
        on = partner(self.contact, self.link)
        return f"link {self.link} turned by its driver, rolling on link {on}"

    @property
    def words(self) -> str:
        """Its class, the link it rolls on, and the holder that follows."""
        other = link_words(partner(self.contact, self.link))
        follows = f"link {self.holder} on {self.pivot.brief} follows"
        return f"link {self.link} driven (class I): it rolls on {other}; {follows}"


class Train(Struct, frozen=True):
    """An arm on a known pin and a wheel on the arm that rolls on two known links (epicyclic)."""

    arm: str
    wheel: str
    pivot: Pin
    centre: Pin
    contacts: tuple[Contact, Contact]

    @property
    def placed_by(self) -> tuple[Joint, ...]:
        """Its pairs with known links except the pin."""
        return self.contacts

    @property
    def links(self) -> tuple[str, str]:
        return (self.arm, self.wheel)

    @property
    def title(self) -> str:
        links = " and ".join(partner(contact, self.wheel) for contact in self.contacts)
        return f"wheel {self.wheel} on arm {self.arm}, between links {links}"

    @property
    def words(self) -> str:
        """Its arm, its wheel, and the links it rolls on."""
        others = listed(link_words(partner(contact, self.wheel)) for contact in self.contacts)
        arm = f"arm {self.arm} on {self.pivot.brief}"
        return f"{arm} with wheel {self.wheel}, which rolls on {others}"


class CoupledTrain(Struct, frozen=True):
    """Wheels that turn one another in a loop: once one link is tried, each follows from the next.

    A contact with a wheel of a known link closes the train.
    """

    tried: TriedLink
    chain: tuple[Geared, ...]
    last: Contact

    @property
    def links(self) -> tuple[str, ...]:
        """All links, the tried one first."""
        return (self.tried.link, *(each.link for each in self.chain))

    @property
    def parts(self) -> tuple[TriedLink | Geared, ...]:
        """The tried link, and the wheels in turn."""
        return (self.tried, *self.chain)

    @property
    def closing(self) -> str:
        """The link whose wheel touches a known link's wheel in the closing contact."""
        return next(link for link in self.last.links if link in self.links)

    @property
    def title(self) -> str:
        return "coupled train of wheels"

    @property
    def words(self) -> str:
        """Its links, the tried one, and the contact that closes it."""
        names = listed(sorted(self.links, key=natural))
        start = f"{self.title} (links {names}): {self.tried.words}"
        return f"{start}, closed by the {self.last.brief}"


class PinnedWheel(Struct, frozen=True):
    """A wheel, or a bar on one, that at the instant turns about its contact with a known link.

    ``own`` is its link, and ``known`` the link that it touches.
    """

    contact: Contact
    own: str
    known: str

    @property
    def joint(self) -> Joint:
        """Its pair with the known link."""
        return self.contact

    @property
    def three(self) -> set[str | None]:
        """Its link, the known one, and the arm between them."""
        return {self.own, self.known, self.contact.arm}

    @property
    def rim(self) -> Pin:
        """The pin about which it turns: its own point of contact."""
        name = ContactName(under(self.contact.letter, self.own))
        return Pin(name, (self.own, self.known))


class Dyad(Struct, frozen=True):
    """Two links and three pairs: each link is joined to known links and to the other."""

    links: tuple[str, str]
    left: Joint
    inner: Joint
    right: Joint

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with known links."""
        return self.left, self.right

    @property
    def type(self) -> str:
        """R for a pin, P for a slide, W for a wheel, from one outer pair to the other."""
        return "".join(pair.symbol for pair in (self.left, self.inner, self.right))

    @property
    def title(self) -> Message:
        return message("dyad {type}", type=self.type)

    @property
    def words(self) -> str:
        """Its kind, class and order, its links and the pairs that join it."""
        outer = listed(pair.brief for pair in self.outer)
        of = f"{self.title} (class II, order 2) of links {listed(self.links)}"
        return f"{of}, inner {self.inner.brief}, outer {outer}"


class OnTwoPins(Dyad, frozen=True):
    """Two blocks on known pins in parallel guides of one link, so that their pins guide that link.

    The link's direction follows from both pins. Its position along the guides is left to later
    groups. The dyad consists of the blocks, each of which guides the other along the line of the
    guides.
    """

    inner: PinLine

    @property
    def rail(self) -> str:
        """The link that both guide."""
        return self.inner.rail

    @property
    def title(self) -> Message:
        return message("guide of link {rail} through two pins", rail=self.rail)

    @property
    def words(self) -> str:
        """Its links, the link that they guide, and the pins."""
        pins = listed(pair.brief for pair in self.outer)
        return f"{joined_words(self.links)} on {pins} guide link {self.rail}"


class KeptParallel(OneLink, frozen=True):
    """A link on a known pin that sets of parallel bars keep parallel to a known link ``lead``.

    ``sets`` lead from the known link to this one.
    """

    pivot: Pin
    lead: str
    sets: tuple[ParallelSet, ...]

    @property
    def outer(self) -> tuple[Joint]:
        """Its pin on a known link."""
        return (self.pivot,)

    @property
    def bars(self) -> tuple[str, ...]:
        return tuple(bar for each in self.sets for bar in each.bars)

    @property
    def title(self) -> str:
        return f"kept parallel to {link_words(self.lead)}"

    @property
    def words(self) -> str:
        """Its link, its pin, and the bars that keep its direction."""
        held = f"link {self.link} on {self.pivot.brief}"
        return f"{held}, {self.title} by bars {listed(self.bars)}"


class CamFollower(Struct, frozen=True):
    """A follower set by the law of a cam, with the equivalent linkage of the instant.

    ``dyad`` consists of the link of that linkage and the follower; its plans are used.
    """

    dyad: Dyad

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with known links."""
        return self.dyad.outer

    @property
    def links(self) -> tuple[str, str]:
        """The equivalent link and the follower."""
        return self.dyad.links

    @property
    def title(self) -> Message:
        return message("{title}, set by the law of a cam", title=self.dyad.title)

    @property
    def words(self) -> str:
        """Its title with its links."""
        return titled(self)


class Cylinder(Struct, frozen=True):
    """A link ``near`` on a known pin and a link ``far``, driven along the guide between them."""

    driver: Driver
    near: str
    far: str
    slide: Sliding
    pin: Pin

    @property
    def foot(self) -> Pin:
        """The pin of the equivalent bar: the far link's point under the known pin."""
        return Pin(under(self.pin.point, self.far), (self.far, self.pin.links[1]))


class Stretched(Struct, frozen=True):
    """A dyad in which one or both bars are driven cylinders: tubes on known pins, with rods.

    The links of the ``dyad`` are the far links of the cylinders; its outer pins are their feet.
    """

    cylinders: tuple[Cylinder, ...]
    dyad: Dyad

    @property
    def drivers(self) -> tuple[Driver, ...]:
        return tuple(each.driver for each in self.cylinders)

    @property
    def outer(self) -> tuple[Joint, ...]:
        """Its pairs with known links."""
        pins = tuple(each.pin for each in self.cylinders)
        return pins if len(pins) == 2 else (*pins, self.dyad.right)

    @property
    def links(self) -> tuple[str, ...]:
        """All links of the cylinders, and the other link of the dyad."""
        near = [each.near for each in self.cylinders]
        return (near[0], *self.dyad.links, *near[1:])

    @property
    def title(self) -> Message:
        pairs = [f"{each.near}, {each.far}" for each in self.cylinders]
        if len(pairs) == 2:
            return message(
                "{title} with driven cylinders of links {first} and of links {second}",
                title=self.dyad.title,
                first=pairs[0],
                second=pairs[1],
            )
        return message(
            "{title} with a driven cylinder of links {pair}", title=self.dyad.title, pair=pairs[0]
        )

    @property
    def words(self) -> str:
        """Its title with its links."""
        return titled(self)


Last = Tie | Driver | Contact
"""What closes a group with a tried link: a link, a given motion, or a wheel's no-slip condition."""


class Higher(Struct, frozen=True):
    """A group of class III or higher: once one link is tried, the others follow as dyads.

    The group closes by a link between two known points, by a driver's given motion, or by a wheel
    that must not slip. Where dyads alone are not enough, its chain contains inner groups with tried
    links of their own. If ``wheels`` pinned to known tracks leave groups without a tried link,
    those groups move it ``at_instant``.
    """

    tried: TriedLink
    chain: tuple[Group, ...]
    last: Last
    joints: tuple[tuple[tuple[str, str], ...], tuple[str, ...]]
    wheels: tuple[PinnedWheel, ...] = ()
    at_instant: tuple[Group, ...] = ()

    @property
    def links(self) -> tuple[str, ...]:
        """All links: the tried one first, the closing one last."""
        last = self.last.links if isinstance(self.last, Tie) else ()
        return (*self.tried.links, *(link for g in self.chain for link in g.links), *last)

    @property
    def parts(self) -> tuple[TriedLink | Group, ...]:
        """The tried link, its chain, and the closing link, if there is one."""
        return (self.tried, *self.chain, *((self.last,) if isinstance(self.last, Tie) else ()))

    @property
    def closing(self) -> str:
        """The link, or the first of two, whose rolling the last contact checks."""
        assert isinstance(self.last, Contact)
        return next(link for link in self.last.links if link in self.links)

    @property
    def placing(self) -> list[Joint]:
        """The pairs by which its parts depend on earlier ones."""
        among = (getattr(part, "placed_by", ()) for part in self.parts[1:])
        outer = (getattr(part, "outer", ()) for part in self.parts[1:])
        return [self.tried.pair, *(pair for pairs in (*among, *outer) for pair in pairs)]

    @property
    def nested(self) -> tuple[Higher, ...]:
        """The group and the inner groups with tried links, from the outermost inwards."""
        inner = (each for each in self.chain if isinstance(each, Higher))
        return (self, *(one for each in inner for one in each.nested))

    @property
    def members(self) -> tuple[Group, ...]:
        """The groups that follow from the tried link, with those of inner groups, in order."""
        parts = (each.members if isinstance(each, Higher) else (each,) for each in self.chain)
        return tuple(member for part in parts for member in part)

    @property
    def order(self) -> tuple[int, int]:
        """Assur's class, and the order: the number of pairs with known links."""
        return assur_class(*self.joints)

    @property
    def title(self) -> Message:
        if isinstance(self.last, Driver):
            return message("group closed by a driver within it")
        if isinstance(self.last, Contact):
            return message("group closed by a wheel within it")
        rank, order = self.order
        return message(
            "group of class {roman}, order {order}", roman=ROMAN[min(rank, 8)], order=order
        )

    @property
    def words(self) -> str:
        """Its class, its links, the tried link, and what closes it."""
        names, last = listed(sorted(self.links, key=natural)), self.last
        match last:
            case Tie():
                end = f"link {last.link}"
            case Driver():
                end = f"the driver of link {last.link}"
            case Contact():
                end = f"the {last.brief}"
        return f"{self.title} (links {names}): {self.tried.words}, closed by {end}"


class Unresolved(Struct, frozen=True):
    """The links that remain when no driver and no group applies.

    ``driven`` are drivers between two of these links, ``tracks`` the links with straight tracks of
    wheels, and ``wedged`` the wheels between two known tracks. ``asked`` says what to write where a
    wheel on such a track may need a link that keeps it there.
    """

    links: tuple[str, ...]
    driven: tuple[Driver, ...] = ()
    tracks: tuple[str, ...] = ()
    wedged: tuple[str, ...] = ()
    asked: Message = NO_WORDS

    @property
    def title(self) -> Message:
        return message("a group for which no construction was found")

    @property
    def words(self) -> str:
        """Its title with its links."""
        return titled(self)


Group = (
    Crank
    | Driven
    | Dyad
    | CamFollower
    | Stretched
    | KeptParallel
    | Geared
    | Spun
    | Train
    | Tie
    | CoupledTrain
    | Higher
    | Unresolved
)


def titled(group: CamFollower | Stretched | Unresolved) -> str:
    return f"{group.title}: {joined_words(group.links)}"
