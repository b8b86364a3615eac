"""Groups of one link: driven, closing at last, or tried."""

from __future__ import annotations

from msgspec import Struct

from graphkin.scene.model import FRAME, Driver
from graphkin.structure.pairs import Joint, Leading, Sliding
from graphkin.text.plain_table import listed


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
    def against(self) -> str:
        """Words for the link against which it turns; none for the frame."""
        other = other_of(self.driver, self.link)
        return "" if other == FRAME else f" against link {other}"

    @property
    def title(self) -> str:
        """What it is called."""
        return f"driven by a crank about {self.pivot}" + (self.against and f",{self.against}")

    @property
    def words(self) -> str:
        """Its kind, class and order, its links and what it is joined to."""
        return f"crank {self.link} about {self.pivot}{self.against} (class I)"


class Driven(OneLink, frozen=True):
    """A link that a driver moves along a guide or a track of a known link."""

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


def other_of(driver: Driver, link: str) -> str:
    """The link against which a link is driven."""
    return driver.against if driver.link == link else driver.link
