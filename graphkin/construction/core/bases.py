"""The base of a link for the plans: two of its points, and the points that follow from them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from msgspec import Struct

from graphkin.scene.link_points import is_under, under
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.groups import (
    CamFollower,
    CoupledTrain,
    Crank,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    KeptParallel,
    Spun,
    Stretched,
    Tie,
    Train,
    TriedLink,
    Unresolved,
)
from graphkin.structure.pairs import (
    Contact,
    ContactName,
    Joint,
    Pin,
    PinLine,
    Sliding,
    contacts,
    partner,
)
from graphkin.text.errors import NO_WORDS, StructureError, joined, message


class Base(Struct, frozen=True):
    """Two points of a link that its group constructs, and the points that follow from them.

    ``end`` may be a point of this link under a point of another link, such as A@3. If ``end`` is
    None, the rotation of the link is known from elsewhere: all its points follow from ``start``,
    the axis and omega.
    """

    link: str
    start: str
    end: str | None
    others: tuple[str, ...]


def base_of(scene: Scene, link: str, start: str, end: str | None) -> Base:
    """The base of a link; its other points keep the order of the scene."""
    points = scene.link(link).points
    return Base(link, start, end, tuple(p for p in points if p not in (start, end)))


def contact_name(contact: Contact) -> ContactName:
    """The name of the contact point of a wheel, which is the relative centre of the two links."""
    return ContactName(contact.letter)


def kept_touches(scene: Scene, links: Collection[str]) -> Iterator[ContactName]:
    """The contact points of the wheels that these links keep on their tracks."""
    return (contact_name(each) for each in contacts(scene) if each.rolling.keeper in links)


def crank_tip(scene: Scene, crank: Crank) -> str | None:
    """The first point of a driven link other than its pivot.

    The points of the line whose angle is given come first. None for a wheel or a cam that has no
    point other than its pivot.
    """
    points = tuple(p for p in scene.link(crank.link).points if p not in scene.cam_centres)
    line = (crank.driver.of if crank.driver.link == crank.link else None) or points[:2]
    return next((point for point in (*line, *points) if point != crank.pivot), None)


def bases(scene: Scene, group: Group | TriedLink) -> tuple[Base, ...]:
    """The bases of the links of a group.

    Raises StructureError for a group that cannot be constructed.
    """
    match group:
        case Crank(link=link, pivot=pivot):
            return (base_of(scene, link, pivot, crank_tip(scene, group)),)
        case Driven(link=link, pair=pair) | TriedLink(link=link, pair=pair):
            return (held_base(scene, link, pair),)
        case Dyad():
            return dyad_bases(scene, group)
        case CamFollower(dyad=dyad):
            return dyad_bases(scene, dyad)
        case Stretched(cylinders=cylinders, dyad=dyad):
            first, second = dyad_bases(scene, dyad)
            tubes = [base_of(scene, each.near, each.pin.point, None) for each in cylinders]
            return own_first(first), tubes[0], own_first(second), *tubes[1:]
        case KeptParallel(link=link, pivot=Pin(point=pivot)):
            return (base_of(scene, link, pivot, None),)
        case Geared():
            return (geared_base(scene, group),)
        case Spun(link=link, holder=arm, pivot=pivot, held=Pin(point=centre), contact=contact):
            rim = under(contact_name(contact), link)
            return base_of(scene, arm, pivot.point, centre), base_of(scene, link, centre, rim)
        case Spun(link=link, holder=block, pivot=pivot):
            own = scene.link(link).points[0]
            return base_of(scene, block, pivot.point, None), base_of(scene, link, own, None)
        case Train(arm, wheel, Pin(point=pivot), Pin(point=centre), (contact, _)):
            rim = under(contact_name(contact), wheel)
            return base_of(scene, arm, pivot, centre), base_of(scene, wheel, centre, rim)
        case Tie(link, Pin(point=first), Pin(point=second)):
            return (base_of(scene, link, first, second),)
        case Tie(link, Sliding(), Sliding()):
            return (base_of(scene, link, scene.link(link).points[0], None),)
        case Tie(link, Pin(point=first), _):
            return (base_of(scene, link, first, None),)
        case CoupledTrain() | Higher():
            return tuple(base for part in group.parts for base in bases(scene, part))
    raise no_construction(group)


def own_first(base: Base) -> Base:
    """The same base, starting at the link's own point instead of a point under another one."""
    if base.end is None or not is_under(base.start):
        return base
    return Base(base.link, base.end, base.start, base.others)


def leads_of(group: Group | TriedLink) -> dict[str, str]:
    """The links that turn with another because of a slide or of parallel bars, and that other."""
    match group:
        case CamFollower(dyad=dyad):
            return leads_of(dyad)
        case Driven(link=link, pair=Sliding() as pair):
            return {link: partner(pair, link)}
        case Stretched(cylinders=cylinders, dyad=dyad):
            return {each.near: each.far for each in cylinders} | leads_of(dyad)
        case Geared(link=link, pair=Sliding() as pair):
            return {link: partner(pair, link)}
        case Geared(link=link, contact=contact) if contact.alike:
            return {link: partner(contact, link)}
        case Spun(link=link, holder=block, held=Sliding()):
            return {block: link}
        case KeptParallel(link=link, lead=lead):
            return {link: lead}
        case Tie(link=link, second=Sliding() as pair):
            return {link: partner(pair, link)}
        case TriedLink(link=link, pair=Sliding() as pair):
            return {link: partner(pair, link)}
        case Dyad(links=(first, second), left=Pin(), inner=Sliding(), right=Sliding() as right):
            return {second: partner(right, second), first: second}
        case Dyad(inner=PinLine(links=(block, start), on=str(on))):
            return {start: on, block: start}
        case Dyad(inner=Sliding(links=(block, carrier))):
            return {block: carrier}
        case Dyad(links=links, left=left, right=right):
            ends = zip(links, (left, right), strict=True)
            return {each: partner(p, each) for each, p in ends if isinstance(p, Sliding)}
        case Higher():
            return {link: by for part in group.parts for link, by in leads_of(part).items()}
    return {}


def ending(group: CoupledTrain | Higher) -> tuple[Tie, ...]:
    """The link that closes a group last, if there is one."""
    return (group.last,) if isinstance(group.last, Tie) else ()


def dyad_bases(scene: Scene, dyad: Dyad) -> tuple[Base, ...]:
    """The bases of the two links of a dyad."""
    first, second = dyad.links
    match dyad.left, dyad.inner, dyad.right:
        case Pin(left), PinLine(on=str()), Pin(right):
            return base_of(scene, first, left, None), base_of(scene, second, right, None)
        case Pin(left), Pin(pin), Pin(right):
            return base_of(scene, first, left, pin), base_of(scene, second, right, pin)
        case Pin(left), Pin(pin), Sliding():
            return base_of(scene, first, left, pin), base_of(scene, second, pin, None)
        case Pin(left), Pin(pin), Contact() as contact:
            return base_of(scene, first, left, pin), wheel_base(scene, second, pin, contact)
        case Pin(left), Sliding() as slide, Pin(right):
            block, carrier = slide.links
            pins = {first: left, second: right}
            foot = Base(carrier, pins[carrier], under(pins[block], carrier), ())
            others = tuple(p for p in scene.link(carrier).points if p != foot.start)
            found = {
                carrier: Base(carrier, foot.start, foot.end, others),
                block: base_of(scene, block, pins[block], None),
            }
            return found[carrier], found[block]
        case Sliding() | Contact(), Pin(pin), Sliding() | Contact():
            return led_base(scene, first, pin, dyad.left), led_base(scene, second, pin, dyad.right)
        case Pin(left), Sliding(), Sliding():
            led = scene.link(second).points[0]
            return base_of(scene, first, left, None), base_of(scene, second, led, None)
    raise no_construction(dyad)


def sides_of(known: Mapping[str, Base], dyad: Dyad) -> tuple[str, str, list[tuple[Joint, str]]]:
    """The point that closes a dyad in the plans, the point where it lies, and the free sides.

    Each side is a pair and the link that it holds. For an RPR dyad the closing point is the point
    of the guide's link under the block's pin. It turns with the guide and slides along it.
    """
    first, second = dyad.links
    match dyad.left, dyad.inner, dyad.right:
        case left, Pin(point=pin), right:
            return pin, pin, [(left, first), (right, second)]
        case Pin(), Sliding() as inner, Pin():
            block, carrier = inner.links
            base = known[carrier]
            assert base.end is not None
            pivot = Pin(base.start, (carrier, FRAME))
            return base.end, known[block].start, [(pivot, carrier), (inner, carrier)]
        case _, inner, right:
            led = known[second].start
            return led, led, [(inner, second), (right, second)]


def held_base(scene: Scene, link: str, pair: Joint) -> Base:
    """The base of a link held by one pair: its pin and another point, or the guided point."""
    if isinstance(pair, Pin):
        own = (p for p in scene.link(link).points if p not in scene.cam_centres)
        return base_of(scene, link, pair.point, next((p for p in own if p != pair.point), None))
    return led_base(scene, link, pair.led_point(scene, link), pair)


def led_base(scene: Scene, link: str, pin: str, pair: Joint) -> Base:
    """The base of a link guided by a slide or a track, starting at its pin."""
    if isinstance(pair, Contact):
        return wheel_base(scene, link, pin, pair)
    return base_of(scene, link, pin, None)


def wheel_base(scene: Scene, link: str, pin: str, contact: Contact) -> Base:
    """The base of a wheel on a track: its pin and its contact point."""
    if contact.links[0] != link:
        raise no_track(scene, contact)
    return base_of(scene, link, pin, under(contact_name(contact), link))


def no_track(scene: Scene, contact: Contact) -> StructureError:
    """The error for a straight track held only by a wheel and a pin.

    The hint says what would keep the wheel on the track.
    """
    from graphkin.structure.touching_wheels import keeper_asked

    wheel, track = contact.links
    found = message("is a straight track that only a wheel and a pin hold")
    hint = NO_WORDS if contact.rolling.keeper else keeper_asked(scene.links, wheel, track)
    return StructureError.at(f"links.{track}", found, HELD, hint)


def geared_base(scene: Scene, group: Geared) -> Base:
    """The base of a geared wheel: its centre and its contact point; a rack only translates."""
    match group.pair:
        case Pin(point=point) if group.contact.alike:
            return base_of(scene, group.link, point, None)
        case Pin(point=point):
            return base_of(scene, group.link, point, under(contact_name(group.contact), group.link))
        case Contact() as own:
            return base_of(scene, group.link, own.wheel.centre, None)
        case _:
            return base_of(scene, group.link, scene.link(group.link).points[0], None)


def no_construction(group: Group) -> StructureError:
    """The error for a group of links that cannot be constructed.

    It names the limit. A straight track may be held by wheels and pins alone, or a wheel by tracks
    that are not parallel. A group may have several drivers, or too many trial links.
    """
    hint = NO_WORDS
    if not isinstance(group, Unresolved):
        found, expected = message("{title} that cannot be constructed", title=group.title), CLOSING
    elif group.tracks:
        found = message(
            "hold link {tracks}, a straight track, by wheels and pins alone",
            tracks=", ".join(group.tracks),
        )
        expected, hint = HELD, group.asked or LEVEL
    elif len(group.driven) > 1:
        pairs = joined(
            ", ",
            (
                message("link {link} on {against}", link=each.link, against=each.against)
                for each in group.driven
            ),
        )
        found = message(
            "close only with {count} drivers at once: {pairs}", count=len(group.driven), pairs=pairs
        )
        expected = message("one driver within a group that is tried")
    elif group.wedged:
        found = message(
            "hold wheel {wheels} between two tracks that are not parallel"
            if len(group.wedged) == 1
            else "hold wheels {wheels} between two tracks that are not parallel",
            wheels=", ".join(group.wedged),
        )
        expected, hint = message("parallel tracks"), SLIPPING
    else:
        found, expected = message("do not close after four of them are tried at once"), CLOSING
        hint = message(
            "is a driver missing, or does it drive a link that cannot be reached by itself?"
        )
    place, about = "links." + ", ".join(group.links), (("links", group.links[0]),)
    return StructureError.at(place, found, expected, hint, about=about)


HELD = message("a track that slides, is driven, or belongs to the frame")
LEVEL = message(
    "wheels of one size on one track keep it parallel to that: write slides = {{ … }} for it"
)
SLIPPING = message(
    "where a wheel slips on one of them, a block at its centre slides beside that instead"
)
CLOSING = message(
    "links that close on known ones, two at a time or after some of them have been tried"
)
