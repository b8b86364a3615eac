"""The images of wheels' points, and their rates: a wheel moves with its track at the contact.

A rolling contact point accelerates along the radius, relative to what it rolls on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

from msgspec import Struct

from graphkin.construction.core.bases import Base, contact_name
from graphkin.construction.core.component import Component, OwnSizes, Size, components_on
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, Canvas, Construction, GivesRate, Run, Wording
from graphkin.construction.core.naming import laid_off_words, length_drawn, rate_symbol
from graphkin.construction.core.pen import (
    Pen,
    component_arrow,
    letter,
    relative_arrow,
    second_image,
)
from graphkin.construction.core.program import OwnStep, Part, Plane, PlanVector
from graphkin.construction.core.quantities import EPSILON
from graphkin.construction.core.relation import Relation, answer, figure, length_of, squared
from graphkin.construction.core.vocabulary import (
    action,
    along_bar,
    in_proportion,
    join,
    lay_off,
    speed_at_rim,
)
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.normal_component import known_and_free
from graphkin.construction.plan import ACCELERATION, VELOCITY, Plan, omega_of, turning_of_link
from graphkin.construction.rolling import rolling
from graphkin.construction.rolling.contact_points import by_contact
from graphkin.construction.rolling.rolling import radius_of, seen_from
from graphkin.construction.velocity.image_of_link import (
    crossed_image,
    found_by_turning,
    image_of_link,
    image_under,
    translated_image,
)
from graphkin.construction.velocity.relative_motion import parallel_through
from graphkin.drawing.symbol_markup import bar, of_wheel, symbol
from graphkin.numbers.arithmetic import Point, Real
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


# --- the acceleration of a rolling contact point, along the radius --------------------------------


@action("rolling-normal")
def rolling_normal(centre: Point, contact: Point, omega: Real, omega_track: Real) -> Point:
    """The acceleration of a wheel's contact point relative to its straight track: to the centre."""
    relative = omega - omega_track
    return (centre - contact) * (relative * relative)


@action("rolling-on-wheel")
def rolling_on_wheel(
    centre: Point, contact: Point, track: Point, omega: Real, omega_track: Real
) -> Point:
    """The acceleration of a wheel's contact point relative to that of the wheel on which it rolls.

    ``track`` is the other wheel's centre. The acceleration is that on a straight track times a
    ratio: that centre's distance from the contact over its distance from the wheel's own centre.
    The diameter of the inflection circle takes the place of the radius (Euler, Savary).
    """
    relative = omega - omega_track
    return (centre - contact) * ((track - contact) / (track - centre)) * (relative * relative)


class RollingNormal(Component, frozen=True, kw_only=True):
    """a_ν = ω²·r of a rolling contact point relative to the touched one, laid off by number.

    The vector runs along the radius from the point ``p`` to ``q``, at the positions ``foot`` and
    ``head``. The point's link turns at ``omega``, the touched link at ``omega_track``. In the plan,
    the vector runs from ``start``, the touched point's image, to ``image``, the rolling point's.
    ``on_bar`` means that a bar rolls on a wheel.
    """

    sign: ClassVar[str] = "ν"
    look: ClassVar[str] = "normal"
    reasons: ClassVar[Mapping[str, str]] = {"image": "why.normal"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"image": ByHand.LAID_OFF}
    imaged: ClassVar[frozenset[str]] = frozenset({"image"})

    p: str
    q: str
    head: int
    foot: int
    omega: int
    omega_track: int
    start: int
    image: OwnStep
    on_bar: bool = False

    def symbols(self) -> Mapping[str, str]:
        """The symbols of the ends of the radius."""
        return {"p": symbol(self.p), "q": symbol(self.q), "bar": bar(self.p, self.q)}

    # --- sentences -------------------------------------------------------------------------------

    def rate(self, drawing: Drawing) -> str:
        """The symbol of the link's rate relative to what it rolls on."""
        own, other = (rate_symbol(drawing, each) for each in (self.omega, self.omega_track))
        if not drawing.trace.values[self.omega]:
            return other
        return f"({own} − {other})" if drawing.trace.values[self.omega_track] else own

    def bars(self) -> tuple[tuple[str, str], ...]:
        """The bars whose lengths the acceleration is computed from."""
        return ((self.p, self.q),)

    def lengths(self, *lengths: str) -> str:
        """The factor of the squared rate, from the lengths of these bars."""
        return "·".join(lengths)

    def formula(self, drawing: Drawing) -> str:
        """The squared rate, times the radius or the length that replaces it."""
        return f"{self.rate(drawing)}^2·{self.lengths(*(bar(*each) for each in self.bars()))}"

    def sentence(self, drawing: Drawing, *, first: bool) -> Wording:
        """Empty: the sentence for the image covers the component."""
        return Wording("", "")

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How it is laid off; the first time, also why it is the whole acceleration."""
        first = next(self.alike(drawing))
        key = "step.lay-off-rolling-bar" if self.on_bar else "step.lay-off-rolling"
        return self.laid_off(drawing, key if self is first else "step.lay-off-named")

    def alike(self, drawing: Drawing) -> Iterator[RollingNormal]:
        """The components of its kind on a sheet, in order."""
        return (each for each in components_on(drawing) if type(each) is type(self))

    def laid_off(self, drawing: Drawing, key: str, **fields: str) -> str:
        """A sentence for how it is laid off."""
        return drawing.words(
            key,
            s=drawing.lettered(self.start),
            name=drawing.lettered(self.image),
            vector=self.symbol(drawing),
            omega=self.rate(drawing),
            drawn=length_drawn(drawing, self.start, self.image),
            **self.symbols(),
            **fields,
        )

    def section(self, drawing: Drawing) -> str:
        """The section of the calculation that holds its relation."""
        return "normals_turning"

    def relation(self, drawing: Drawing) -> Relation:
        """The squared relative rate times the radius, with the drawn length."""
        values, size = drawing.trace.values, drawing.settled(self.size(drawing))
        rate = abs(float(values[self.omega]) - float(values[self.omega_track]))
        lengths = self.lengths(*(figure(drawing, length_of(drawing, *bar)) for bar in self.bars()))
        return Relation(
            self.symbol(drawing),
            self.formula(drawing),
            f"{squared(figure(drawing, rate))}·{lengths}",
            answer(drawing, size),
            "m/s^2",
            laid_off_words(drawing, "laid_off", size, p=symbol(self.q), q=symbol(self.p)),
            over=self.bars(),
        )

    # --- grading ---------------------------------------------------------------------------------

    def sizes(self, own: OwnSizes) -> Iterator[Size]:
        """ω²·r from the student's own values; none against a turning track.

        The reason is that the student's own rates carry no sense.
        """
        if any(track.size for track in own.turnings(self.omega_track)):
            return
        radius = own.length(self.foot, self.head)
        for omega in own.turnings(self.omega):
            yield Size((omega, omega), omega.size**2 * radius, radius)

    def power_of(self, args: tuple[int, ...]) -> int:
        """Zero: the component is computed from the steps of the rates."""
        return 0


class RollingOnWheel(RollingNormal, frozen=True, kw_only=True):
    """a_ν = ω²·r·R/(R ± r) of a contact point relative to that of the wheel on which it rolls.

    ``r`` names the centre of the other wheel, whose position is ``hub``.
    """

    r: str
    hub: int

    def bars(self) -> tuple[tuple[str, str], ...]:
        """The bars between the contact and both centres."""
        return (self.p, self.q), (self.r, self.p), (self.r, self.q)

    def lengths(self, *lengths: str) -> str:
        """r·R/(R ± r)."""
        radius, far, apart = lengths
        return f"{radius}·{far}/{apart}"

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How it is laid off; the first time, also why it is along the line of centres."""
        first = self is next(self.alike(drawing))
        key = "step.lay-off-rolling-on" if first else "step.lay-off-named"
        return self.laid_off(drawing, key, formula=self.formula(drawing))

    def sizes(self, own: OwnSizes) -> Iterator[Size]:
        """The sizes on a straight track, times the ratio of the distances of the other centre."""
        ratio = own.length(self.hub, self.foot) / own.length(self.hub, self.head)
        for size in super().sizes(own):
            yield Size(size.factors, size.size * ratio, size.bar)


# --- drawing -------------------------------------------------------------------------------------


def rolled_image(
    pen: Pen,
    start: int,
    rolls: str,
    ends: tuple[str, ...],
    rates: tuple[int, int],
    *,
    on_bar: bool = False,
) -> int:
    """Draw the second image of a point that ``rolls``, from the image of the point that it touches.

    Its relative acceleration runs from the first of the ``ends`` to the second; a third is the
    centre of the wheel on which it rolls. ``rates`` are the steps of the rates of its link and of
    what it rolls on.
    """
    foot, head, *hub = (pen.the("position", end) for end in ends)
    p, q, *r = map(letter, ends)
    index = letter(rolls) + (q if letter(rolls) == p else p)
    name = f"a_{index}^ν"
    law = rolling_on_wheel if hub else rolling_normal
    with pen.on(Part.NORMAL, Plane.NUMBERS):
        vector = pen.draw(law, head, foot, *hub, *rates, name=name)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        image = pen.draw(lay_off, start, vector, name=second_image(rolls))
        pen.vector(join, start, image, of=PlanVector("a", index, q, p, "ν"))
    omega, omega_track = rates
    own: dict[str, Any] = {
        "index": index,
        "p": p,
        "q": q,
        "head": head,
        "foot": foot,
        "on_bar": on_bar,
    }
    own |= {"omega": omega, "omega_track": omega_track, "vector": vector}
    own |= {"start": start, "image": image}
    pen.make(RollingOnWheel(r=r[0], hub=hub[0], **own) if hub else RollingNormal(**own))
    return pen.want("acceleration", rolls, image)


class CommonNormal(Construction, frozen=True, kw_only=True):
    """The ``line`` through one contact point's image ``start``, a locus of the other's image.

    The line is parallel to the radius from ``p`` to ``q``; for ``belted`` links, it is parallel to
    their line of centres.
    """

    reasons: ClassVar[Mapping[str, str]] = {"line": "why.no_slip"}
    lines: ClassVar[Mapping[str, str]] = {"line": "∥ {p}{q}"}

    p: str
    q: str
    belted: bool = False
    start: int
    line: OwnStep

    @property
    def runs(self) -> Run:
        """The radius to which the line is parallel."""
        return Run(self.p + self.q)

    def symbols(self) -> Mapping[str, str]:
        """The symbols of the ends of the radius."""
        return {"p": symbol(self.p), "q": symbol(self.q), "bar": bar(self.p, self.q)}

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the parallel to the radius."""
        start = drawing.lettered(self.start)
        key = "common-normal-belt" if self.belted else "common-normal"
        return drawing.words(f"step.{key}", s=start, **self.symbols())

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the line, labelled with the radius to which it is parallel."""
        canvas.locus(f"∥{self.p}{self.q}", f"∥ {bar(self.p, self.q)}")

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The statement that accelerations at a contact differ along the common normal only."""
        key = "belted" if self.belted else "touching"
        yield Relation(drawing.words(f"calculation.{key}", bar=bar(self.p, self.q)))


def common_normal(pen: Pen, start: int, ends: tuple[str, str], *, belted: bool = False) -> int:
    """Draw the parallel to the radius between two points, through an image."""
    line = pen.draw(along_bar, start, *(pen.the("position", end) for end in ends))
    p, q = map(letter, ends)
    pen.make(CommonNormal(p=p, q=q, belted=belted, start=start, line=line))
    return line
