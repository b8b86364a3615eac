"""Driven links and Assur groups as records: what hangs on what, and what it is called."""

from __future__ import annotations

from msgspec import Struct

from graphkin.scene.findings import natural
from graphkin.scene.model import FRAME, Driver, joined_words, link_words
from graphkin.structure.assur import assur_class
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Contact, Joint, Leading, Pin, Sliding
from graphkin.text.plain_table import listed

ROMAN = ("", "I", "II", "III", "IV", "V", "VI", "VII", "VIII")


class OneLink(Struct, frozen=True):
    """What consists of one link."""

    link: str

    @property
    def links(self) -> tuple[str]:
        """The one link."""
        return (self.link,)


class Crank(OneLink, frozen=True):
    """A link that a driver turns about a pin whose motion is known."""

    driver: Driver
    pivot: str

    @property
    def title(self) -> str:
        """What it is called."""
        against = other_of(self.driver, self.link)
        beside = "" if against == FRAME else f", against link {against}"
        return f"driven by a crank about {self.pivot}{beside}"

    @property
    def words(self) -> str:
        """Its kind, class and order, its links and what it is joined to."""
        other = other_of(self.driver, self.link)
        against = "" if other == FRAME else f" against link {other}"
        return f"crank {self.link} about {self.pivot}{against} (class I)"


class Driven(OneLink, frozen=True):
    """A link that a driver slides along a guide, or rolls on a track, of a known link."""

    driver: Driver
    pair: Leading

    @property
    def outer(self) -> tuple[Joint]:
        """Its pair with what is known."""
        return (self.pair,)

    @property
    def title(self) -> str:
        """What it is called."""
        against = other_of(self.driver, self.link)
        beside = "frame" if against == FRAME else f"link {against}"
        return f"driven, {self.pair.moving} on {beside}"

    @property
    def words(self) -> str:
        """Its kind, class and order, its links and what it is joined to."""
        return f"link {self.link} driven (class I): {self.pair.words}"


class Dyad(Struct, frozen=True):
    """Two links and three pairs: each link joined to what is known, and to the other."""

    links: tuple[str, str]
    left: Joint
    inner: Joint
    right: Joint

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with what is known."""
        return self.left, self.right

    @property
    def type(self) -> str:
        """R for a pin, P for a slide, W for a wheel, from one outer pair to the other."""
        return "".join(pair.symbol for pair in (self.left, self.inner, self.right))

    @property
    def title(self) -> str:
        """What it is called."""
        return f"dyad {self.type}"

    @property
    def words(self) -> str:
        """Its kind, class and order, its links and what it is joined to."""
        outer = listed(pair.brief for pair in self.outer)
        of = f"{self.title} (class II, order 2) of links {listed(self.links)}"
        return f"{of}, inner {self.inner.brief}, outer {outer}"


class CamFollower(Struct, frozen=True):
    """A follower that a cam sets by its law, with the equivalent linkage of the instant.

    ``dyad`` are the link of that linkage and the follower: its plans are theirs.
    """

    dyad: Dyad

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with what is known."""
        return self.dyad.outer

    @property
    def links(self) -> tuple[str, str]:
        """The equivalent link and the follower."""
        return self.dyad.links

    @property
    def title(self) -> str:
        """What it is called."""
        return f"{self.dyad.title}, set by the law of a cam"

    @property
    def words(self) -> str:
        """It and its links."""
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
        """The pin of the bar that it stands for: the far link's point under the known pin."""
        return Pin(f"{self.pin.point}@{self.far}", (self.far, self.pin.links[1]))


class Stretched(Struct, frozen=True):
    """A dyad of which the first bar, or both, are cylinders: tubes on known pins, rods driven.

    The links of the ``dyad`` are the far ones of the cylinders; its outer pins are their feet.
    """

    cylinders: tuple[Cylinder, ...]
    dyad: Dyad

    @property
    def drivers(self) -> tuple[Driver, ...]:
        """What drives the cylinders."""
        return tuple(each.driver for each in self.cylinders)

    @property
    def outer(self) -> tuple[Joint, ...]:
        """Its pairs with what is known."""
        pins = tuple(each.pin for each in self.cylinders)
        return pins if len(pins) == 2 else (*pins, self.dyad.right)

    @property
    def links(self) -> tuple[str, ...]:
        """All links of the cylinders, and the other of the dyad."""
        near = [each.near for each in self.cylinders]
        return (near[0], *self.dyad.links, *near[1:])

    @property
    def title(self) -> str:
        """What it is called."""
        pairs = [f"links {each.near}, {each.far}" for each in self.cylinders]
        if len(pairs) == 2:
            return f"{self.dyad.title} with driven cylinders of {pairs[0]} and of {pairs[1]}"
        return f"{self.dyad.title} with a driven cylinder of {pairs[0]}"

    @property
    def words(self) -> str:
        """It and its links."""
        return titled(self)


class Geared(OneLink, frozen=True):
    """A wheel or a rack on a pair with a known link, whose turning a contact settles."""

    pair: Joint
    contact: Contact

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with what is known."""
        return self.pair, self.contact

    @property
    def title(self) -> str:
        """What it is called."""
        does = "has a belt with" if self.contact.rolling.belt else "rolls on"
        return f"{does} link {partner(self.contact, self.link)}"

    @property
    def words(self) -> str:
        """What it is joined to, and what moves it."""
        other = link_words(partner(self.contact, self.link))
        return f"link {self.link} on {self.pair.brief}, moved by its contact with {other}"


class Spun(Struct, frozen=True):
    """A wheel or bar whose angle a driver gives, on a ``holder`` that follows from its contact.

    The holder, on a known pin, is the arm of a wheel (``held`` by a pin) or the block along which
    a bar slides that rolls on a drum.
    """

    link: str
    driver: Driver
    holder: str
    pivot: Pin
    held: Pin | Sliding
    contact: Contact

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with what is known."""
        return self.pivot, self.contact

    @property
    def links(self) -> tuple[str, str]:
        """The holder, and what it holds."""
        return (self.holder, self.link)

    @property
    def title(self) -> str:
        """What it is called."""
        on = partner(self.contact, self.link)
        return f"link {self.link} turned by its driver, rolling on link {on}"

    @property
    def words(self) -> str:
        """Its class, what it rolls on, and what follows from that."""
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
    def links(self) -> tuple[str, str]:
        """Arm and wheel."""
        return (self.arm, self.wheel)

    @property
    def title(self) -> str:
        """What it is called."""
        links = " and ".join(partner(contact, self.wheel) for contact in self.contacts)
        return f"wheel {self.wheel} on arm {self.arm}, between links {links}"

    @property
    def words(self) -> str:
        """Its arm, its wheel, and what that rolls on."""
        others = listed(link_words(partner(contact, self.wheel)) for contact in self.contacts)
        arm = f"arm {self.arm} on {self.pivot.brief}"
        return f"{arm} with wheel {self.wheel}, which rolls on {others}"


class Tie(OneLink, frozen=True):
    """A link that two pairs join to known links: at two pins it is idle, on two guides a wedge."""

    first: Joint
    second: Joint

    @property
    def outer(self) -> tuple[Joint, Joint]:
        """Its pairs with what is known."""
        return self.first, self.second

    @property
    def title(self) -> str:
        """What it is called."""
        if isinstance(self.first, Sliding):
            return "led by two guides"
        return "idle: joins what moves together without it"

    @property
    def words(self) -> str:
        """Its link, and what holds it."""
        held = listed(pair.brief for pair in self.outer)
        if isinstance(self.first, Sliding):
            led = f"link {self.link} led by {held}"
            return f"{led}: both tell how it is turned, so that one is idle"
        return f"link {self.link} between {held}, which stand already: it must be idle"


class TriedLink(OneLink, frozen=True):
    """A link whose place in its pair with a known one is tried until the rest closes."""

    pair: Joint

    @property
    def words(self) -> str:
        """What is tried of it."""
        return f"tried at link {self.link} on {self.pair.brief}"


class CoupledTrain(Struct, frozen=True):
    """Wheels that turn one another in a loop: once one link is tried, each follows from the next.

    What closes it at last is a contact with a wheel of a known link.
    """

    trial: TriedLink
    chain: tuple[Geared, ...]
    last: Contact

    @property
    def links(self) -> tuple[str, ...]:
        """All links, that which is tried first."""
        return (self.trial.link, *(each.link for each in self.chain))

    @property
    def closing(self) -> str:
        """The link whose wheel touches that of a known link at last."""
        return next(link for link in self.last.links if link in self.links)

    @property
    def title(self) -> str:
        """What it is called."""
        return "coupled train of wheels"

    @property
    def words(self) -> str:
        """Its links, where it is tried, and what closes it."""
        names = listed(sorted(self.links, key=natural))
        start = f"{self.title} (links {names}): {self.trial.words}"
        return f"{start}, closed by the {self.last.brief}"


class Higher(Struct, frozen=True):
    """A group of class III or more: once one link is tried, the others follow as dyads.

    What closes it at last is a link between two known points, or a driver's given motion. Where
    dyads alone do not do the rest, its chain holds groups within it that are tried in their turn.
    Where
    ``wheels`` of it roll on straight tracks that are known, and pinning them where they touch
    leaves groups that need no trial, those move it ``at_instant``.
    """

    trial: TriedLink
    chain: tuple[Group, ...]
    last: Tie | Driver
    joints: tuple[tuple[tuple[str, str], ...], tuple[str, ...]]
    wheels: tuple[Contact, ...] = ()
    at_instant: tuple[Group, ...] = ()

    @property
    def links(self) -> tuple[str, ...]:
        """All links, that whose place is tried first and that which closes last."""
        last = self.last.links if isinstance(self.last, Tie) else ()
        return (*self.trial.links, *(link for g in self.chain for link in g.links), *last)

    @property
    def nested(self) -> tuple[Higher, ...]:
        """It, and the groups within it that are tried in their turn, from the outermost inwards."""
        inner = (each for each in self.chain if isinstance(each, Higher))
        return (self, *(one for each in inner for one in each.nested))

    @property
    def members(self) -> tuple[Group, ...]:
        """What is constructed after trials, with that of the groups within it, in order."""
        parts = (each.members if isinstance(each, Higher) else (each,) for each in self.chain)
        return tuple(member for part in parts for member in part)

    @property
    def order(self) -> tuple[int, int]:
        """Assur's class, and the order: the number of pairs with known links."""
        return assur_class(*self.joints)

    @property
    def title(self) -> str:
        """What it is called."""
        if isinstance(self.last, Driver):
            return "group closed by a driver within it"
        rank, order = self.order
        return f"group of class {ROMAN[min(rank, 8)]}, order {order}"

    @property
    def words(self) -> str:
        """Its class, its links, where it is tried, and what closes it."""
        names, last = listed(sorted(self.links, key=natural)), self.last
        end = f"link {last.link}" if isinstance(last, Tie) else f"the driver of link {last.link}"
        return f"{self.title} (links {names}): {self.trial.words}, closed by {end}"


class Unresolved(Struct, frozen=True):
    """What is left when no driver and no group applies.

    ``driven`` are the drivers that move two of its links against one another, ``tracks`` those of
    its links on which wheels roll straight on, ``wedged`` the wheels between two known tracks.
    """

    links: tuple[str, ...]
    driven: tuple[Driver, ...] = ()
    tracks: tuple[str, ...] = ()
    wedged: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """What it is called."""
        return "a group for which no construction was found"

    @property
    def words(self) -> str:
        """It and its links."""
        return titled(self)


Group = (
    Crank
    | Driven
    | Dyad
    | CamFollower
    | Stretched
    | Geared
    | Spun
    | Train
    | Tie
    | CoupledTrain
    | Higher
    | Unresolved
)


def other_of(driver: Driver, link: str) -> str:
    """The link against which a link is driven."""
    return driver.against if driver.link == link else driver.link


def titled(group: CamFollower | Stretched | Unresolved) -> str:
    """What a group is called, with its links."""
    return f"{group.title}: {joined_words(group.links)}"
