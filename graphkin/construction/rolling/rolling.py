"""Wheels that roll without slip: their contacts, their angles, and their positions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from msgspec import Struct

from graphkin.construction.core.bases import contact_name, no_construction
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import (
    Action,
    action,
    coordinate,
    difference,
    product,
    sum_of,
)
from graphkin.construction.guides.guides import (
    axis,
    guide_line,
    local_line,
    path_of,
    set_at,
    set_point,
)
from graphkin.construction.links.link_shapes import local_place
from graphkin.construction.links.plate_points import place_point, plate_points
from graphkin.construction.links.rolled_turn import (
    CountedTurn,
    TurnOnTrack,
    TurnOnWheel,
    counted_link,
    counted_near,
    turned_ahead,
)
from graphkin.construction.rolling.contact_points import (
    CentreOfBelt,
    CentrePath,
    ContactOfWheels,
    ContactOnTrack,
    PointOfContact,
    RackPoint,
    RollerCentre,
    Track,
    between_tracks,
    by_contact,
    contact_of_wheels,
    contact_on_track,
    rack_at,
    radius_along,
)
from graphkin.numbers.arithmetic import Point, Real, phase, turn_by
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME, Driver, Link, Wheel
from graphkin.scene.quantity import exact
from graphkin.structure.groups import Geared, Train, other_of
from graphkin.structure.pairs import Contact, Pin, Sliding, partner
from graphkin.structure.wheel_groups import stated_rolling
from graphkin.text.errors import Problem, StructureError, message


@action("rolled-on-track")
def rolled_on_track(lead: Real, start: Real, coordinate: Real, radius: Real) -> Real:
    """Angle of a wheel that rolled a way from its start; ``radius`` is negative on the right."""
    return lead + start - coordinate / radius


@action("way-rolled")
def way_rolled(turn: Real, start: Real, radius: Real) -> Real:
    """The distance rolled along a track, from the wheel's angle relative to the track."""
    return -(turn - start) * radius


@action("less-axis")
def less_axis(turn: Real, axis: Point) -> Real:
    """An angle less the angle of a link that keeps its direction."""
    return turn - turned_ahead(axis)


@action("opposite")
def opposite(number: Real) -> Real:
    return -number


@action("turned-to")
def turned_to(before: Real, angle: Real, here: Point, there: Point) -> Real:
    """The angle of a driven link, from the angle of one of its lines (here to there)."""
    return before + angle - phase(there - here)


@action("turned-from")
def turned_from(before: Real, angle: Real, here: Point, there: Point) -> Real:
    """The angle of a link against which another is driven, from the angle of the other."""
    return before - angle + phase(there - here)


@action("rolled-on-wheel")
def rolled_on_wheel(turn_arm: Real, turn_track: Real, track: Real, wheel: Real) -> Real:
    """The rotation of a wheel that rolls on another, both on one arm (Willis)."""
    return turn_arm - (turn_track - turn_arm) * (track / wheel)


@action("arm-between")
def arm_between(
    turn: Real,
    other_turn: Real,
    start: Real,
    other_start: Real,
    planet: Real,
    other_planet: Real,
    track: Real,
    other_track: Real,
    wheel: Real,
    other_wheel: Real,
) -> Real:
    """The angle of an arm whose planet rolls on two wheels of known rotation (Willis).

    For both contacts, the arguments are:
    - the track's rotation;
    - the angles of the arm and of the planet at the start;
    - the radii of the track and of the planet's wheel, a ring's negative.

    Equal ratios leave the arm free: they raise ZeroDivisionError on a scalar.
    """
    first, second = track / wheel, other_track / other_wheel
    near = planet - (turn + start) * first - start
    far = other_planet - (other_turn + other_start) * second - other_start
    return (far - near) / (first - second)


@action("arm-rolled")
def arm_rolled(
    turn: Real, start: Real, track_turn: Real, arm_start: Real, track: Real, wheel: Real
) -> Real:
    """The angle of an arm whose wheel has turned by a known angle on another (Willis).

    ``turn`` and ``start`` are the wheel's angles now and at the start; ``track_turn`` is the other
    wheel's rotation since then. ``track`` and ``wheel`` are the radii; a ring's is negative. A ring
    of equal radius leaves the arm free and raises ZeroDivisionError on a scalar.
    """
    return arm_start + (turn - start + track_turn * (track / wheel)) / (1 + track / wheel)


@action("axis")
def axis_turned(turn: Real) -> Point:
    """Axis of a link at an angle in radians."""
    return turn_by(turn)


@by_contact
def track_of(pen: Pen, contact: Contact) -> int:
    """The line of a straight track in the plane."""
    key = ("track", *contact.links)
    if key not in pen.shared:
        wheel, on = contact.links
        with pen.on(Part.POSITION, Plane.MECHANISM):
            line = guide_line(pen, contact.rolling, on, wheel)
        sign = contact.sign_of(pen.scene, wheel)
        pen.make(Track(wheel=wheel, sign=sign, rolling=contact.rolling, line=line))
        pen.shared[key] = pen.want("track", wheel, line)
    return pen.shared[key]


@by_contact
def radius_of(pen: Pen, contact: Contact, wheel: bool = True) -> int:
    """The radius of a wheel, negative to the right of a track and for a ring.

    The radius of the wheel from which an open belt comes is negative, too.
    """
    chosen = contact.wheel if wheel else contact.track
    assert chosen is not None
    belt = contact.rolling.belt
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        radius = pen.given("length", chosen.radius)
        if not wheel and belt is not None and not belt.crossed:
            return pen.draw(opposite, radius)
        if chosen.inside or (contact.track is None and contact.rolling.side < 0):
            return pen.draw(opposite, radius)
    return radius


@by_contact
def path_of_centre(pen: Pen, contact: Contact) -> int:
    """The line on which a wheel's centre moves along a straight track."""
    track = track_of(pen, contact)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        line = pen.draw(radius_along, track, radius_of(pen, contact))
    wheel = contact.links[0]
    sign = contact.sign_of(pen.scene, wheel)
    centre = contact.wheel.centre
    pen.make(CentrePath(wheel=wheel, sign=sign, centre=centre, track=track, line=line))
    return line


def start_turn(pen: Pen, contact: Contact, link: str) -> int:
    """The angle in radians of a link's x axis in the position from which the rolling is counted."""
    angle = contact.rolling.start.get(link)
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        return pen.given("zero") if angle is None else pen.given("number", angle)


@by_contact
def driven_way(pen: Pen, driver: Driver, contact: Contact) -> int:
    """The distance that a driver has made a wheel roll along a straight track."""
    if driver.kind == "roll":
        return pen.drive(driver).position
    with pen.on(Part.POSITION, Plane.NUMBERS):
        ends = start_turn(pen, contact, contact.links[0]), radius_of(pen, contact)
        return pen.draw(way_rolled, pen.driven_angle(driver), *ends)


@by_contact
def set_on_track(pen: Pen, contact: Contact, centre: str, way: int) -> None:
    """Place a wheel that has rolled a way along a straight track: centre, contact, axis."""
    path = path_of_centre(pen, contact)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        found = set_point(pen, centre, contact.links, path, way)
    pen.want("position", centre, found)
    touch_and_turn(pen, contact)


@by_contact
def touch(pen: Pen, contact: Contact) -> None:
    """Draw the contact of a placed wheel with what it rolls on."""
    if contact.track is not None:
        touch_wheels(pen, contact, contact.links[0])
    else:
        touch_track(pen, contact)


@by_contact
def touch_track(pen: Pen, contact: Contact) -> int:
    """Draw the contact of a wheel with its straight track, and return its coordinate there."""
    line, centre = track_of(pen, contact), pen.the("position", contact.wheel.centre)
    kind = partial(ContactOnTrack, sign=contact.sign_of(pen.scene, contact.links[0]))
    touching = mark_contact(pen, contact, kind, contact_on_track, line, centre)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        return pen.draw(coordinate, line, touching)


@by_contact
def slip(pen: Pen, contact: Contact) -> int:
    """The angle of a wheel less its rolled angle, as a length at its rim."""
    own = contact.links[0]
    if contact.track is None:
        rolled = turned_along(pen, contact, touch_track(pen, contact))
    else:
        rolled = rolled_to(pen, contact, own)
    turn = pen.draw(difference, angle_of(pen, own), rolled)
    return pen.draw(product, turn, radius_of(pen, contact))


@by_contact
def touch_and_turn(pen: Pen, contact: Contact) -> None:
    """Draw the contact of a wheel with a straight track, and set its axis; its centre is placed."""
    wheel, _ = contact.links
    way = touch_track(pen, contact)
    pen.want("rolled", wheel, way)
    if pen.has("axis", wheel):
        return
    with pen.on(Part.POSITION, Plane.NUMBERS):
        turn = turned_along(pen, contact, way)
        settle_turn(pen, wheel, turn)
    tell_on_track(pen, contact, turn)


def tell_on_track(pen: Pen, contact: Contact, turn: int) -> None:
    """Record how a wheel's angle follows from its coordinate along a straight track."""
    rolling, (wheel, on) = contact.rolling, contact.links
    assert rolling.through is not None
    lead, start, way, radius = pen.steps[turn].args
    drivers = (d for d in pen.scene.drivers if d.kind == "roll" and d.link == wheel)
    kind = TurnOnTrack(
        link=wheel,
        start=start,
        turn=turn,
        leads={on: lead},
        sign=contact.sign_of(pen.scene, wheel),
        on=on,
        through=rolling.through,
        touching=letter(contact_name(contact)),
        way=way,
        radius=radius,
        driver=next((each for each in drivers if each.against == on), None),
    )
    pen.make(kind)


@by_contact
def turned_along(pen: Pen, contact: Contact, way: int) -> int:
    """The angle of a wheel, from its coordinate along its straight track."""
    wheel, on = contact.links
    with pen.on(Part.POSITION, Plane.NUMBERS):
        lead, start = angle_of(pen, on), start_turn(pen, contact, wheel)
        return pen.draw(rolled_on_track, lead, start, way, radius_of(pen, contact))


def mark_contact(
    pen: Pen, contact: Contact, kind: Callable[..., PointOfContact], action: Action, *args: int
) -> int:
    """Draw the point of a contact, under its name and as a point of either link."""
    name, (wheel, on) = contact_name(contact), contact.links
    if not pen.has("position", name):
        with pen.on(Part.POSITION, Plane.MECHANISM):
            point = pen.want("position", name, pen.draw(action, *args, name=letter(name)))
        pen.make(kind(name=letter(name), wheel=wheel, on=on, found_from=args, point=point))
        for link in contact.links:
            pen.want("position", under(name, link), point)
    return pen.the("position", name)


@by_contact
def geared(pen: Pen, group: Geared) -> None:
    """Place a wheel on its pin, a rack on its guide, or a roller between two tracks."""
    match group.pair:
        case Contact() as own:
            roller(pen, group, own)
        case Sliding() as slide:
            rack(pen, group, slide)
        case Pin():
            if group.contact.track is None:
                touch_and_turn(pen, group.contact)
            else:
                wheel_on_wheel(pen, group)


class ContactSide(Struct, frozen=True):
    """A contact from the side of one of its wheels: the other link, both wheels and both radii."""

    other: str
    own: Wheel
    track: Wheel
    radius: int
    track_radius: int


def seen_from(pen: Pen, contact: Contact, link: str) -> ContactSide:
    """A contact of two wheels from the side of one of them."""
    assert contact.track is not None
    mine, its = radius_of(pen, contact), radius_of(pen, contact, wheel=False)
    if contact.links[0] == link:
        return ContactSide(contact.links[1], contact.wheel, contact.track, mine, its)
    return ContactSide(contact.links[0], contact.track, contact.wheel, its, mine)


def wheel_on_wheel(pen: Pen, group: Geared) -> None:
    """Place a wheel on its pin: the contact on the line of centres, and its angle by the radii."""
    contact, link = group.contact, group.link
    assert contact.arm is not None
    if not contact.alike:
        touch_wheels(pen, contact, link)
    if not pen.has("axis", link):
        roll_round(pen, contact, link)


def touch_wheels(pen: Pen, contact: Contact, link: str) -> None:
    """Draw the contact of two wheels whose centres are placed."""
    side = seen_from(pen, contact, link)
    centres = side.track.centre, side.own.centre
    ends = tuple(pen.the("position", centre) for centre in centres)
    radii = side.track_radius, side.radius
    if contact.rolling.belt is None:
        wheel, on = (contact.sign_of(pen.scene, each) for each in contact.links)
        about = contact.sign_of(pen.scene, side.other), side.track
        wheels = partial(ContactOfWheels, signs=(wheel, on), about=about)
        mark_contact(pen, contact, wheels, contact_of_wheels, *ends, *radii)
    else:
        kind = partial(CentreOfBelt, belt=contact.rolling.belt, ends=centres)
        mark_contact(pen, contact, kind, contact_of_wheels, *ends, *radii)


def roll_round(pen: Pen, contact: Contact, link: str) -> None:
    """Set the axis of a wheel from its contact with another."""
    turn, arm, other = rolled_to(pen, contact, link), contact.arm, partner(contact, link)
    assert arm is not None
    settle_turn(pen, link, turn)
    start, since = pen.steps[turn].args
    carried, rolled, track, radius = pen.steps[since].args
    kind = TurnOnWheel(
        link=link,
        start=start,
        turn=turn,
        leads={arm: carried, other: rolled},
        arm=arm,
        other=other,
        wheels=(contact.wheel_of(link), contact.wheel_of(other)),
        signs=(contact.sign_of(pen.scene, link), contact.sign_of(pen.scene, other)),
        radii=(radius, track),
    )
    pen.make(kind)


@by_contact
def rolled_to(pen: Pen, contact: Contact, link: str, tried: Mapping[str, int] | None = None) -> int:
    """The angle of a wheel, from the rotation of its arm and of the wheel that it rolls on.

    ``tried`` holds the angles of links that are not placed.
    """
    side, arm = seen_from(pen, contact, link), contact.arm
    assert arm is not None
    turns = [turned_by(pen, contact, each, tried) for each in (arm, side.other)]
    with pen.on(Part.POSITION, Plane.NUMBERS):
        since = pen.draw(rolled_on_wheel, *turns, side.track_radius, side.radius)
        return pen.draw(sum_of, start_turn(pen, contact, link), since)


def settle_turn(pen: Pen, link: str, turn: int) -> None:
    """Set the angle of a link's x axis, in radians with whole turns, and thus its axis."""
    pen.counted.add(link)
    pen.want("turned", link, turn)
    pen.want("axis", link, pen.draw(axis_turned, turn))


@by_contact
def train(pen: Pen, group: Train) -> None:
    """Place the arm of a planet between two wheels, from the wheels' rotation."""
    sides = [seen_from(pen, contact, group.wheel) for contact in group.contacts]
    contact, centre = group.contacts[0], group.centre.point
    both = list(zip(group.contacts, sides, strict=True))
    turns = [turned_by(pen, each, side.other) for each, side in both]
    starts = [start_turn(pen, each, group.arm) for each in group.contacts]
    planets = [start_turn(pen, each, group.wheel) for each in group.contacts]
    with pen.on(Part.POSITION, Plane.NUMBERS):
        radii = [side.track_radius for side in sides] + [side.radius for side in sides]
        turn = pen.draw(arm_between, *turns, *starts, *planets, *radii)
        settle_turn(pen, group.arm, turn)
    place_point(pen, group.arm, group.pivot.point, centre)
    for each in group.contacts:
        touch_wheels(pen, each, group.wheel)
    roll_round(pen, contact, group.wheel)


def turned_by(pen: Pen, contact: Contact, link: str, tried: Mapping[str, int] | None = None) -> int:
    """The rotation of a link from the start of a contact."""
    angle = tried[link] if tried and link in tried else angle_of(pen, link)
    if link == FRAME or link not in contact.rolling.start:
        return angle
    with pen.on(Part.POSITION, Plane.NUMBERS):
        return pen.draw(difference, angle, start_turn(pen, contact, link))


def angle_of(pen: Pen, link: str) -> int:
    """The angle of a link's x axis in radians.

    Whole turns are counted for driven links, for links that contacts turn, and for links that slide
    along either. For other links, the angle is within half a turn of the angle stated for them.
    """
    with pen.on(Part.POSITION, Plane.NUMBERS):
        if link == FRAME:
            return pen.given("zero")
        if pen.has("turned", link):
            return pen.the("turned", link)
        if (driver := driven_from(pen, link)) is not None:
            return pen.want("turned", link, driven_turn(pen, driver, link))
        known = turned_with(pen, link)
        if known is not None and is_placed(pen, known):
            axes = axis(pen, link), axis(pen, known)
            found = pen.draw(counted_near, *axes, angle_of(pen, known))
            return pen.want("turned", link, found)
        near = pen.near.get(link, exact(0, "deg"))
        ends = pen.given("direction", near, of=link), pen.given("number", near, of=link)
        found = pen.draw(counted_near, axis(pen, link), *ends)
        if pen.turns(link):
            pen.make(CountedTurn(link=link, heading=ends[0], radians=ends[1], turn=found))
        return pen.want("turned", link, found)


def is_placed(pen: Pen, link: str) -> bool:
    """Whether a link is placed: a link against which a driver turns another may come later."""
    return link == FRAME or link in pen.bases


def refuse_idle_turns(pen: Pen) -> None:
    """Raise StructureError for stated turns of links whose whole turns no wheel needs."""
    counted = {counted_link(step) for step in pen.steps}
    problems = []
    for link, rolling in stated_rolling(pen.scene).items():
        if link in counted:
            continue
        found = message("no wheel depends on how often link {link} went round", link=link)
        if driven_from(pen, link) or turned_with(pen, link) is not None:
            found = message(
                "a driver gives the angle of link {link}, whole turns included", link=link
            )
        elif pen.has("turned", link):
            found = message("link {link} rolls, which counts its whole turns", link=link)
        expected = message("links that only their pins turn, and that carry wheels")
        problems.append(
            Problem(rolling.turns[link].place, found, expected, message("leave it out"))
        )
    if problems:
        raise StructureError(problems)


def turned_with(pen: Pen, link: str) -> str | None:
    """The first link on the way along slides from a link to a driven or counted one.

    All links on that way turn together.
    """
    towards, waiting = {link: link}, [link]
    while waiting:
        here = waiting.pop(0)
        if here != link and (here in pen.counted or driven_from(pen, here)):
            return towards[here]
        beside = slid_on(pen.scene.link(here))
        beside += [name for name, each in pen.scene.links.items() if here in slid_on(each)]
        for each in beside:
            if each not in (FRAME, *towards):
                towards[each] = each if here == link else towards[here]
                waiting.append(each)
    return None


def slid_on(link: Link) -> list[str]:
    """The links on which a block slides."""
    return [slide.on for slide in link.slides]


def driven_from(pen: Pen, link: str) -> Driver | None:
    """The driver that turns a link against one placed before it, in either order of naming."""
    order = [FRAME, *pen.bases]
    here = order.index(link) if link in order else len(order)
    before = set(order[:here])
    turning = (driver for driver in pen.scene.drivers if driver.kind == "turn")
    own = (driver for driver in turning if link in (driver.link, driver.against))
    return next((driver for driver in own if other_of(driver, link) in before), None)


def driven_turn(pen: Pen, driver: Driver, link: str) -> int:
    """The angle of the x axis of a link that a driver turns, with whole turns."""
    before = angle_of(pen, other_of(driver, link))
    angle = pen.driven_angle(driver)
    if driver.of:
        ends = [local_place(pen, driver.link, point) for point in driver.of]
    else:
        ends = [pen.given("origin"), pen.given("ahead")]
    return pen.draw(turned_to if link == driver.link else turned_from, before, angle, *ends)


def roller(pen: Pen, group: Geared, own: Contact) -> None:
    """Place a roller between two parallel tracks: by its coordinate, then as any wheel."""
    other = group.contact
    lines = [track_of(pen, each) for each in (own, other)]
    values = [pen.peek(line) for line in lines]
    way = -1 if all(values) and (values[0].along.conjugate() * values[1].along).real < 0 else 1
    leads = []
    for each in (own, other):
        angle = angle_of(pen, each.links[1])
        with pen.on(Part.POSITION, Plane.NUMBERS):
            leads.append(pen.draw(sum_of, angle, start_turn(pen, each, group.link)))
    with pen.on(Part.POSITION, Plane.NUMBERS):
        lean = pen.draw(difference, *leads)
        radii = radius_of(pen, own), radius_of(pen, other)
        where = pen.draw(between_tracks, *lines, lean, *radii, extra=(way,))
    path = path_of_centre(pen, own)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        centre = own.wheel.centre
        found = pen.draw(set_at, path, where, name=centre)
    pen.make(RollerCentre(path=path, lean=lean, radii=radii, where=where, centre=found))
    pen.want("position", centre, found)
    for each in (own, other):
        touch_and_turn(pen, each)


def rack(pen: Pen, group: Geared, slide: Sliding) -> None:
    """Place a rack on its guide: the wheel's angle gives its position along the track."""
    contact, link = group.contact, group.link
    point, wheel = pen.scene.link(link).points[0], contact.links[0]
    if wheel == link or contact.track is not None:
        raise no_construction(group)
    path_of(pen, slide, link, point)
    track = local_line(pen, contact.rolling, link)
    radius, axis_ = radius_of(pen, contact), axis(pen, link)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        turn = angle_of(pen, wheel)
        if pen.turns(link):
            known = partner(slide, link)
            if known in pen.scene.keepers and contact.rolling.angle is not None:
                lean = pen.given("number", contact.rolling.angle)
                own = pen.draw(difference, angle_of(pen, known), lean)
            else:
                own = angle_of(pen, link)
            turn = pen.draw(difference, turn, own)
        else:
            turn = pen.draw(less_axis, turn, axis_)
        way = pen.draw(way_rolled, turn, start_turn(pen, contact, wheel), radius)
    centre = pen.the("position", contact.wheel.centre)
    with pen.on(Part.POSITION, Plane.MECHANISM):
        where = centre, axis_, *track, local_place(pen, link, point), radius, way
        found = pen.want("position", point, pen.draw(rack_at, *where, name=point))
    pen.make(RackPoint(rack=link, wheel=wheel, way=way, point=found))
    plate_points(pen, pen.bases[link])  # its track may pass through another point of it
    touch_and_turn(pen, contact)
