"""The mechanism to scale, with compass and ruler: cranks by their angle, dyads by two loci."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from msgspec import Struct

from graphkin.construction.core.bases import crank_tip
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.group_images import led_by
from graphkin.construction.guides.guides import (
    axis,
    axis_with_guide,
    cross_guides,
    direction_on,
    path_of,
    turned_back,
    turned_with,
)
from graphkin.construction.links.driven_crank import turn_about
from graphkin.construction.links.dyad_by_arcs import cut_line, meet_arcs
from graphkin.construction.links.link_shapes import bar_length, local_place, place
from graphkin.construction.links.plate_points import arc, plate_points
from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME, Apart, Link, Scene
from graphkin.structure.groups import CamFollower, Crank, Driven, Dyad, Group, OnTwoPins, Tie
from graphkin.structure.pairs import Joint, Pin, Sliding
from graphkin.structure.turning import body
from graphkin.text.errors import NO_WORDS, Message, StructureError, message

FITS = 1e-6
"""Misfit of an idle link, as a fraction of its length, that printed lengths may cause."""


def frame(pen: Pen) -> None:
    """Draw the fixed points."""
    done: dict[str, int] = {}
    with pen.on(Part.POSITION, Plane.MECHANISM):
        for placing in pen.scene.frame.placings:
            done[placing.point] = place(pen, placing, done, name=placing.point)
            pen.want("position", placing.point, done[placing.point])


# --- driven links --------------------------------------------------------------------------------


def crank(pen: Pen, group: Crank) -> None:
    """Draw the tip of a driven bar: the line at the driver's angle, and the bar laid off on it."""
    driver, link = group.driver, group.link
    given, ends = pen.drive(driver).position, (group.pivot, crank_tip(pen.scene, group))
    with pen.on(Part.POSITION, Plane.MECHANISM):
        if driver.link == link:
            line = driver.of or axis_line(pen.scene.link(link))
            turn = direction_on(pen, driver.against, given)
            turn_about(pen, link, ends, line, turn)
        else:
            lead = axis(pen, driver.link)
            if driver.of:
                locals_ = [local_place(pen, driver.link, point) for point in driver.of]
                lead = pen.draw(axis_with_guide, lead, *locals_)
            turn_about(pen, link, ends, (), pen.draw(turned_back, lead, given))


def axis_line(link: Link) -> tuple[str, ...]:
    """The two points on the x axis of a link given by lengths; none if it has its own axes."""
    return link.points[:2] if any(isinstance(each, Apart) for each in link.placings) else ()


def driven(pen: Pen, group: Driven) -> None:
    """Draw a point of a driven slider, or the centre of a driven wheel, at its coordinate."""
    led = led_by(group.pair)
    led.set_at(pen, group.link, led.driven(pen, group.driver, "position"))


# --- dyads and ties ------------------------------------------------------------------------------


def dyad(pen: Pen, group: Dyad) -> None:
    """Draw a dyad: two links and three pairs, placed by a crossing of two loci."""
    if isinstance(group, OnTwoPins):
        from graphkin.construction.guides.swung_guide import guide_by_pins

        guide_by_pins(pen, group)
        return
    match group.left, group.inner, group.right:
        case Pin(point=left), Pin(point=pin), _:
            with pen.on(Part.POSITION, Plane.MECHANISM):
                near = arc(pen, group.links[0], left, pin)
            dyad_on(pen, group, near)
        case Pin(), Sliding(), Pin():
            from graphkin.construction.guides.swung_guide import swing_guide

            swing_guide(pen, group)
        case _, Pin(point=pin), _:
            two_guides(pen, pin, (group.left, group.right), group.links)
        case Pin(), Sliding() as inner, Sliding() as right:
            first, second = group.links
            led = pen.scene.link(second).points[0]
            path_of(pen, right, second, led)
            turned_with(pen, inner, second)
            plate_points(pen, pen.bases[first])
            two_guides(pen, led, (inner, right), (second, second))


def dyad_on(pen: Pen, group: Dyad, near: int) -> None:
    """Draw the inner pin of a dyad whose first bar already has its arc."""
    if isinstance(group.right, Pin):
        with pen.on(Part.POSITION, Plane.MECHANISM):
            assert isinstance(group.inner, Pin)
            far = arc(pen, group.links[1], group.right.point, group.inner.point)
        two_arcs(pen, group, near, far)
    else:
        bar_and_guide(pen, group, near)


def two_arcs(pen: Pen, group: Dyad, near: int, far: int) -> None:
    """Draw the inner pin of a dyad RRR, where two arcs meet."""
    assert isinstance(group.left, Pin) and isinstance(group.right, Pin)
    assert isinstance(group.inner, Pin)
    pin, centres = group.inner.point, (group.left.place, group.right.place)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        side, extra = pen.choice(group)
        found = meet_arcs(pen, pin, centres, (near, far), *side, sign=extra)
    pen.want("position", pin, found)


def bar_and_guide(pen: Pen, group: Dyad, near: int) -> None:
    """Draw the inner pin of a dyad RRP, where the bar's arc cuts the pin's guide line."""
    assert isinstance(group.left, Pin) and isinstance(group.inner, Pin)
    assert not isinstance(group.right, Pin)
    left, pin, link = group.left.place, group.inner.point, group.links[1]
    led = led_by(group.right)
    path = led.path(pen, link, pin)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        way, extra = pen.choice(group)
        found = cut_line(pen, pin, left, (path, near), *way, sign=extra)
    pen.want("position", pin, found)
    led.finish(pen)


def two_guides(pen: Pen, point: str, pairs: tuple[Joint, Joint], links: tuple[str, str]) -> None:
    """Draw a point that two guides determine, where their lines cross."""
    sides = zip(pairs, links, strict=True)
    leading = [(led_by(pair), link) for pair, link in sides if not isinstance(pair, Pin)]
    paths = [led.path(pen, link, point) for led, link in leading]
    with pen.on(Part.POSITION, Plane.MECHANISM):
        found = cross_guides(pen, point, *paths)
    pen.want("position", point, found)
    for led, _ in leading:
        led.finish(pen)


def follower(pen: Pen, group: CamFollower) -> None:
    """Place the follower at the coordinate or angle that the law of its cam gives."""
    from graphkin.construction.cams import cam_centre

    dyad = group.dyad
    link = next(each for each in dyad.links if each in pen.scene.cams)
    cam = pen.scene.cams[link]
    if cam.carrier != FRAME:
        pen.want("position", cam.centre, cam_centre.curvature_centre(pen, cam.centre))
    lever = cam.lever
    if lever:
        cam_centre.set_lever(pen, link, lever)
        if isinstance(dyad.inner, Sliding):
            block_on(pen, dyad.inner, link)
        return
    if cam.slides:
        *_, where = cam_centre.over_plate(pen, link)
    else:
        line = cam_centre.height(pen, link)
        with pen.on(Part.POSITION, Plane.NUMBERS):
            where = pen.draw(cam_centre.coordinate, *line)
    assert not isinstance(dyad.right, Pin)
    led_by(dyad.right).set_at(pen, link, where)
    if isinstance(dyad.inner, Sliding):
        turned_with(pen, dyad.inner, link)


def block_on(pen: Pen, pair: Sliding, lever: str) -> None:
    """Place the block that represents the contact on the face of a lever already placed."""
    turned_with(pen, pair, lever)
    under, block = pen.bases[lever].end, pen.bases[pair.block].start
    pen.want("position", under or "", pen.the("position", block))


def tie(pen: Pen, group: Tie) -> None:
    """Place a link between two known points: only its angle on a guide is unknown."""
    if isinstance(group.first, Sliding):
        point = pen.bases[group.link].start
        two_guides(pen, point, (group.first, group.second), (group.link, group.link))
    elif isinstance(group.second, Sliding):
        assert isinstance(group.first, Pin)
        path_of(pen, group.second, group.link, group.first.point)


def refuse_misfit(pen: Pen, group: Tie) -> None:
    """Raise StructureError for an idle link that does not fit between its neighbours."""
    if not isinstance(group.first, Pin) or not isinstance(group.second, Pin | Sliding):
        return
    link, p = group.link, group.first.point
    place = pen.peek(pen.the("position", p))
    if isinstance(group.second, Sliding):
        found = off_guide_words(pen, group.second, link, p)
        expected = message("a guide through it: the link is idle, the rest moves without it")
    else:
        q = group.second.point
        end, length = pen.peek(pen.the("position", q)), pen.peek(bar_length(pen, link, p, q))
        if None in (place, end, length) or abs(abs(end - place) - length) <= FITS * length:
            return
        found = message(
            "{p} and {q} are {value:.6g} mm apart without it, but it is {length:.6g} mm long",
            p=p,
            q=q,
            value=1e3 * abs(end - place),
            length=1e3 * length,
        )
        expected = message("a length that fits: the link is idle, the rest moves without it")
    if not found:
        return
    raise StructureError.at(
        f"links.{link}",
        found,
        expected,
        message(
            "another closure may fit, and graphkin check lists them; or take a driver "
            "away, if the link is to move the rest"
        ),
    )


def off_guide_words(pen: Pen, pair: Sliding, link: str, point: str) -> Message:
    """The words for an idle block's pin that is off its guide; empty within printed accuracy."""
    from graphkin.construction.guides.swung_guide import breadth_about

    at = pen.the("position", point)
    line, place = pen.peek(path_of(pen, pair, link, point)), pen.peek(at)
    if line is None or place is None:
        return NO_WORDS
    away = abs(cross(line.along, place - line.point)) / abs(line.along)
    if away <= FITS * breadth_about(pen, at):
        return NO_WORDS
    return message(
        "{point} is {away:.6g} mm beside its guide without it", point=point, away=1e3 * away
    )


class IdleBar(Struct, frozen=True):
    """An idle link between two points that stand without it, and its length (m)."""

    link: str
    ends: tuple[str, str]
    length: float

    def fits(self, places: Mapping[str, complex]) -> bool:
        """Whether its pins stand as far apart as it is long, where both are known."""
        known = [places[end] for end in self.ends if end in places]
        return len(known) < 2 or abs(abs(known[1] - known[0]) - self.length) <= FITS * self.length


def idle_bars(scene: Scene, groups: tuple[Group, ...]) -> Iterator[IdleBar]:
    """The links that join two pins of what moves without them."""
    for group in groups:
        match group:
            case Tie(link=link, first=Pin(point=p), second=Pin(point=q)):
                own = body(scene, link)
                yield IdleBar(link, (p, q), abs(own[q] - own[p]))
