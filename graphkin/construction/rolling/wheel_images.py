"""The images of wheels' points, and their rates: a wheel moves with its track at the contact."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from graphkin.construction.core.bases import Base, contact_name
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import GivesRate
from graphkin.construction.core.naming import rate_symbol
from graphkin.construction.core.pen import Pen, component_arrow, letter, relative_arrow
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.quantities import EPSILON
from graphkin.construction.core.vocabulary import action, in_proportion, speed_at_rim
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.normal_component import known_and_free
from graphkin.construction.plan import ACCELERATION, VELOCITY, Plan, omega_of, turning_of_link
from graphkin.construction.rolling import rolling
from graphkin.construction.rolling.contact_points import by_contact
from graphkin.construction.rolling.rolling import radius_of, seen_from
from graphkin.construction.rolling.rolling_normal import common_normal, rolled_image
from graphkin.construction.velocity.image_of_link import (
    crossed_image,
    found_by_turning,
    image_of_link,
    image_under,
    translated_image,
)
from graphkin.construction.velocity.relative_motion import parallel_through
from graphkin.drawing.symbol_markup import of_wheel
from graphkin.numbers.arithmetic import Real
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME, Driver
from graphkin.structure.groups import Geared, Train
from graphkin.structure.pairs import Contact, Pin, Sliding, partner

# --- rates of wheels on fixed pins, by their radii ------------------------------------------------


@action("rate-by-radii")
def rate_by_radii(rate: Real, track: Real, wheel: Real) -> Real:
    """The rate of a wheel that another drives at the rim, both about fixed pins."""
    return -rate * (track / wheel)


class RateByRadii(GivesRate, frozen=True, kw_only=True):
    """The ``rate`` of a wheel, the ``link``, from the rate of the ``other`` link, which turns it.

    ``radii`` are the steps of the other's radius and of its own, negative for a ring or by an open
    belt. ``signs`` are the names of both wheels.
    """

    link: str
    other: str
    turning: int
    radii: tuple[int, int]
    signs: tuple[str, str]
    rate: OwnStep

    def source_of_rate(self, drawing: Drawing) -> str:
        """The other's rate by the radii, with its value."""
        values = drawing.trace.values
        track, wheel = (float(values[each]) for each in self.radii)
        sign = "" if track * wheel < 0 else "−"
        other = rate_symbol(drawing, self.turning, drawing.rate.letter)
        radii = "/".join(of_wheel("r", sign) for sign in self.signs)
        value = drawing.words.significant(float(values[self.rate]))
        unit = drawing.words.spelled(drawing.rate.caret_unit)
        return f" = {sign}{other}·{radii} = {value} {unit}"


@by_contact
def turned_by_radii(pen: Pen, contact: Contact, link: str, turning: int) -> int:
    """The rate of a wheel on a fixed pin; the other's rate itself where that is always zero."""
    if pen.is_zero(turning):
        return turning
    side = seen_from(pen, contact, link)
    radii = side.track_radius, side.radius
    with pen.on(Part.RESULT, Plane.NUMBERS), pen.calls_for(None):
        rate = pen.draw(rate_by_radii, turning, *radii, name=link)
    signs = contact.sign_of(pen.scene, side.other), contact.sign_of(pen.scene, link)
    found = RateByRadii(
        link=link, other=side.other, turning=turning, radii=radii, signs=signs, rate=rate
    )
    return pen.make(found).rate


# --- images -------------------------------------------------------------------------------------


@by_contact
def given_speed(pen: Pen, driver: Driver, contact: Contact, which: str) -> int:
    """The speed, or acceleration, of a driven wheel's centre along its track."""
    given = getattr(pen.drive(driver), which)
    if driver.kind == "roll":
        return int(given)
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        return pen.draw(speed_at_rim, given, radius_of(pen, contact))


@by_contact
def touched(pen: Pen, contact: Contact, link: str, known: str) -> int:
    """The image of one link's contact point, from the other link."""
    name = contact_name(contact)
    return pen.want("velocity", under(name, link), image_under(pen, known, name, VELOCITY))


@by_contact
def geared(pen: Pen, group: Geared) -> None:
    """Draw a wheel or rack in the velocity plan; the touching points have one velocity."""
    link, contact = group.link, group.contact
    if contact.alike:
        return
    name = contact_name(contact)
    start = touched(pen, contact, link, partner(contact, link))
    match group.pair:
        case Pin():
            return
        case Sliding():
            point, rim = pen.bases[link].start, under(name, link)
            if pen.turns(link):
                turn_from_rim(pen, link, rim, point, VELOCITY, along=rim)
                return
            with VELOCITY.drawn(pen):
                ends, called = (letter(name), point), VELOCITY.named(point)
                start = translated_image(pen, start, ends, called)
            VELOCITY.settle(pen, point, start)
        case Contact() as own:
            first = touched(pen, own, link, partner(own, link))
            rims = [under(contact_name(own), link), under(name, link)]
            images, centre = (first, start), own.wheel.centre
            touching = VELOCITY.named(rims[0]), VELOCITY.named(rims[1])
            found = image_between(pen, rims, images, centre, VELOCITY, touching=touching)
            VELOCITY.settle(pen, centre, found)
            relative_arrow(pen, rims[1], rims[0])
            turning_of_contacts(pen, link, rims, images, VELOCITY)


def image_between(
    pen: Pen,
    rims: Sequence[str],
    images: Sequence[int],
    centre: str,
    plan: Plan,
    *,
    name: str = "",
    touching: tuple[str, ...] = (),
) -> int:
    """The image of a wheel's centre, which divides the line of its two contacts' images."""
    places = [pen.the("position", each) for each in (*rims, centre)]
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        ratio = pen.draw(in_proportion, *places)
    first, second = images
    letters, called = (letter(rims[0]), letter(rims[1]), centre), name or plan.named(centre)
    with plan.drawn(pen):
        ends = first, second, ratio
        return image_of_link(pen, ends, letters, name=called, touching=touching)


@by_contact
def second_touched(pen: Pen, contact: Contact, link: str, known: str) -> int:
    """The second image of one link's contact point, from the link's centre and the other link.

    The accelerations of two rolling points differ along the common normal only. So the parallel to
    the normal through the other point's image crosses the tangential line of the wheel.
    """
    name = contact_name(contact)
    own = under(name, link)
    centre = pen.bases[link].start
    other = image_under(pen, known, name, ACCELERATION)
    corner, line = known_and_free(pen, centre, own)
    with ACCELERATION.drawn(pen):
        along = common_normal(pen, other, (centre, own), belted=contact.rolling.belt is not None)
        found = crossed_image(pen, line, along, name=ACCELERATION.named(own), of=own)
        component_arrow(pen, corner, found, "τ", own, centre)
    return pen.want("acceleration", own, found)


@by_contact
def train(pen: Pen, group: Train) -> None:
    """Draw a planet between two wheels: its centre divides the line of its contacts' images."""
    link, centre = group.wheel, group.centre.point
    names = [contact_name(contact) for contact in group.contacts]
    images = [touched(pen, each, link, partner(each, link)) for each in group.contacts]
    pen.want("velocity", centre, image_between(pen, names, images, centre, VELOCITY))
    VELOCITY.arrows(pen, centre)


@by_contact
def second_train(pen: Pen, group: Train) -> None:
    """Draw the second image of a planet's centre, from the arm's pin and from its contacts.

    Along the arm, the contacts leave the centre's acceleration open. Across the arm, they give the
    acceleration of m, which divides the line of their second images as the centre divides their own
    line.
    """
    link, centre, pivot = group.wheel, group.centre.point, group.pivot.point
    names = [contact_name(contact) for contact in group.contacts]
    others = [
        image_under(pen, partner(each, link), contact_name(each), ACCELERATION)
        for each in group.contacts
    ]
    corner, line = known_and_free(pen, pivot, centre)
    with ACCELERATION.drawn(pen):
        across = image_between(pen, names, others, centre, ACCELERATION, name=f"m_{centre}")
        along = common_normal(pen, across, (pivot, centre))
        called = ACCELERATION.named(centre)
        found = crossed_image(pen, line, along, name=called, of=centre)
        component_arrow(pen, corner, found, "τ", centre, pivot)
    ACCELERATION.settle(pen, centre, found)
    second_touched(pen, group.contacts[0], link, partner(group.contacts[0], link))


@by_contact
def second_geared(pen: Pen, group: Geared) -> None:
    """Draw a wheel or rack in the acceleration plan, from the contact that determines it."""
    link, contact = group.link, group.contact
    if contact.alike:
        return
    match group.pair:
        case Pin() if contact.track is not None and contact.arm == FRAME:
            second_about_fixed_pin(pen, contact, link, partner(contact, link))
        case Pin():
            second_touched(pen, contact, link, partner(contact, link))
        case Sliding() as slide:
            second_rack(pen, group, slide)
        case Contact() as own:
            second_roller(pen, group, own)


@by_contact
def second_about_fixed_pin(pen: Pen, contact: Contact, link: str, known: str) -> None:
    """Draw second images of the points of a wheel on a fixed pin, turned by a wheel on another.

    Its rates follow from the other's by the radii, so its points are drawn without the contact's
    image.
    """
    omega_of(pen, link)
    pen.want(EPSILON, link, turned_by_radii(pen, contact, link, omega_of(pen, known, EPSILON)))
    name, start = contact_name(contact), pen.bases[link].start
    pen.bases[link] = Base(link, start, None, pen.bases[link].others)
    touching = under(name, link)
    pen.want("acceleration", touching, found_by_turning(pen, link, touching, ACCELERATION))
    for point in pen.bases[link].others:
        if not pen.has("acceleration", point):
            turn_from_rim(pen, link, start, point, ACCELERATION)


def second_rack(pen: Pen, group: Geared, slide: Sliding) -> None:
    """Draw the second image of a rack's point: by its guide, and by the wheel across it."""
    link, contact = group.link, group.contact
    if pen.turns(link):
        turning_rack(pen, group)
        return
    point, wheel = pen.bases[link].start, contact.links[0]
    name = contact_name(contact)
    start = image_under(pen, partner(slide, link), point, ACCELERATION)
    other = image_under(pen, wheel, name, ACCELERATION)
    guide = known_guide(pen, slide)
    with ACCELERATION.drawn(pen):
        line = parallel_through(pen, start, guide, link)
        along = common_normal(pen, other, (contact.wheel.centre, name))
        found = crossed_image(pen, line, along, name=ACCELERATION.named(point), of=point)
    ACCELERATION.settle(pen, point, found)


def turning_rack(pen: Pen, group: Geared) -> None:
    """Draw the second image of a point of a turning rack, from its contact point's image.

    The contact point's acceleration relative to the wheel's point is directed away from the wheel's
    centre.
    """
    link, contact = group.link, group.contact
    second_image_of_rim(pen, contact, link, contact.links[0])
    rim, point = under(contact_name(contact), link), pen.bases[link].start
    turn_from_rim(pen, link, rim, point, ACCELERATION)


def turn_from_rim(
    pen: Pen, link: str, rim: str, point: str, plan: Plan, along: str | None = None
) -> None:
    """Draw the image of a link's point, from the image of its contact point or pin.

    The link's rates are known. ``along`` is the point from whose image a velocity arrow is drawn,
    too. A link that a driver turns steadily has no tangential component.
    """
    plan.turn(pen, link, rim, point, steady=plan.is_steady(pen, link), along=along)


def second_roller(pen: Pen, group: Geared, own: Contact) -> None:
    """Draw a roller between tracks; its contact points accelerate towards its centre only.

    These accelerations are relative to the tracks.
    """
    link, centre, contacts = group.link, own.wheel.centre, (own, group.contact)
    known = [partner(each, link) for each in contacts]
    first, second = (
        second_image_of_rim(pen, each, link, other)
        for each, other in zip(contacts, known, strict=True)
    )
    names = [contact_name(each) for each in contacts]
    rims = [under(name, link) for name in names]
    with ACCELERATION.drawn(pen):
        found = image_between(pen, rims, (first, second), centre, ACCELERATION)
        if not any(map(pen.turns, known)):
            pairs = zip(known, names, strict=True)
            tail, tip = (image_under(pen, on, name, ACCELERATION) for on, name in pairs)
            component_arrow(pen, tail, tip, "τ", rims[1], rims[0])
    ACCELERATION.settle(pen, centre, found)
    turning_of_contacts(pen, link, rims, (first, second), ACCELERATION)


def turning_of_contacts(
    pen: Pen, link: str, rims: Sequence[str], images: tuple[int, int], plan: Plan
) -> None:
    """Set the rate of a roller from the images of both its contact points."""
    ends = pen.the("position", rims[0]), pen.the("position", rims[1])
    letters, index = (letter(rims[0]), letter(rims[1])), plan.index(pen, rims[1], rims[0])
    with pen.on(Part.RESULT, Plane.NUMBERS):
        found = turning_of_link(pen, plan.rate, link, letters, index, (ends, images))
    pen.want(plan.rate, link, found)


def image_of_rim(plan: Plan, pen: Pen, contact: Contact, own: str, known: str) -> int:
    """The image of one link's contact point in a plan, from the image of the other link's."""
    draw = touched if plan is VELOCITY else second_image_of_rim
    return draw(pen, contact, own, known)


@by_contact
def second_image_of_rim(pen: Pen, contact: Contact, own: str, known: str) -> int:
    """The second image of a contact point, from the image of the point that it touches.

    A wheel's contact point accelerates towards the wheel's centre, on a straight track by the
    square of its rate times its radius. A bar's accelerates away from the centre of the wheel on
    which it rolls.
    """
    name = contact_name(contact)
    start = image_under(pen, known, name, ACCELERATION)
    rates, rim = (omega_of(pen, own), omega_of(pen, known)), under(name, own)
    if contact.track is not None:
        hubs = contact.wheel_of(own).centre, contact.wheel_of(known).centre
        return rolled_image(pen, start, rim, (name, *hubs), rates)
    if own == contact.links[0]:
        return rolled_image(pen, start, rim, (name, contact.wheel.centre), rates)
    ends = contact.wheel.centre, name
    return rolled_image(pen, start, rim, ends, rates[::-1], on_bar=True)


class LedWheel(Struct, frozen=True):
    """A wheel and what it touches: the straight track of a known link, or a placed wheel."""

    pair: Contact

    def line(self, pen: Pen) -> int:
        return rolling.track_of(pen, self.pair)

    def path(self, pen: Pen, link: str, point: str) -> int:
        """The line on which its centre moves."""
        return rolling.path_of_centre(pen, self.pair)

    def direction(self, pen: Pen) -> int:
        """A line along which its centre moves relative to the track."""
        return rolling.path_of_centre(pen, self.pair)

    def driven(self, pen: Pen, driver: Driver, which: str) -> int:
        """The driver's position, speed or acceleration of the centre along the track."""
        if which == "position":
            return rolling.driven_way(pen, driver, self.pair)
        return given_speed(pen, driver, self.pair, which)

    def set_at(self, pen: Pen, link: str, where: int) -> None:
        """Place the wheel where it has rolled a way along the track."""
        centre = self.pair.led_point(pen.scene, link)
        rolling.set_on_track(pen, self.pair, centre, where)

    def finish(self, pen: Pen) -> None:
        """Draw its contact and set its angle, once its centre is placed."""
        rolling.touch_and_turn(pen, self.pair)

    def stand(self, pen: Pen) -> None:
        """Draw its contact with a placed link, whether it slips or not."""
        rolling.touch(pen, self.pair)

    def slip(self, pen: Pen) -> int:
        """The wheel's angle less its rolled angle, as a length at its rim."""
        return rolling.slip(pen, self.pair)

    def touch(self, pen: Pen, plan: Plan) -> None:
        """Draw the image of its contact point."""
        draw = touched if plan is VELOCITY else second_touched
        draw(pen, self.pair, *self.pair.links)

    def rim(self, pen: Pen) -> int | None:
        """The radius that relates its rotation to its coordinate."""
        return rolling.radius_of(pen, self.pair)
