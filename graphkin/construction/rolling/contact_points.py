"""Contacts of wheels with the tracks or wheels that they roll on: constructions and positions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import wraps
from typing import Any, ClassVar, Concatenate, ParamSpec, TypeVar

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import (
    ByHand,
    Construction,
    PlanPole,
    construction,
    constructions,
)
from graphkin.construction.core.naming import arrow_of, drawn_amount, straight, way_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Effect, OwnStep, Plane, Step, plan_vector
from graphkin.construction.core.quantities import OMEGA
from graphkin.construction.core.relation import Relation, answer
from graphkin.construction.core.vocabulary import action
from graphkin.construction.plan import TurningOfLink
from graphkin.construction.velocity.relative_motion import PerpendicularThrough
from graphkin.drawing.symbol_markup import bar, escape, of_wheel, symbol
from graphkin.numbers.arithmetic import Point, Real, at
from graphkin.numbers.plane import Line, dot
from graphkin.scene.link_points import lettered, under
from graphkin.scene.model import FRAME, Belt, Rolling, Scene, Wheel
from graphkin.structure.groups import Geared, Spun, Train
from graphkin.structure.pairs import Contact, contacts, meshes

SAME = 1e-9
"""Radii and angles closer than this, relative or in radians, are equal."""

P = ParamSpec("P")
R = TypeVar("R")


def by_contact(draw: Callable[Concatenate[Pen, P], R]) -> Callable[Concatenate[Pen, P], R]:
    """Attribute all steps that a function draws to the contact among its arguments.

    The contact may be in a group. Steps inside that are attributed to another effect keep that
    effect.
    """

    @wraps(draw)
    def drawn(pen: Pen, /, *args: P.args, **options: P.kwargs) -> R:
        contact = contact_among(args)
        effect: Effect = "gears" if meshes(pen.scene, contact) else "rolling"
        with pen.calls_for(effect):
            return draw(pen, *args, **options)

    return drawn


def contact_among(args: tuple[Any, ...]) -> Contact:
    """The contact among some arguments, or the contact of a group among them."""
    for arg in args:
        match arg:
            case Contact():
                return arg
            case Geared(contact=contact) | Spun(contact=contact):
                return contact
            case Train(contacts=contacts):
                return contacts[0]
    raise TypeError("no contact is given")


class TouchingEffect(Struct, frozen=True):
    """Why the steps for wheels in mesh, or for wheels that only roll, are in or left out."""

    effect: Effect
    in_mesh: bool
    brings: str
    lacks: str

    def touching(self, scene: Scene) -> list[str]:
        """The wheels of a scene with what they touch, such as "3 on 0"."""
        found = (each for each in contacts(scene) if meshes(scene, each) is self.in_mesh)
        return [words_of(each) for each in found]

    def cause(self, scene: Scene) -> str:
        """The words for the wheels that call for the steps."""
        return f"{self.brings} {', '.join(self.touching(scene))}"

    def absence(self, scene: Scene) -> str:
        """The words for their absence; empty where there are such wheels."""
        return "" if self.touching(scene) else self.lacks


def words_of(contact: Contact) -> str:
    """The words for a wheel and what it rolls on, or runs with by a belt."""
    wheel, on = contact.links
    other = "the frame" if on == FRAME else on
    return f"{wheel} with {other} by a belt" if contact.rolling.belt else f"{wheel} on {other}"


TOUCHING = (
    TouchingEffect("rolling", False, "without slip roll", "no wheel rolls along a track"),
    TouchingEffect("gears", True, "in mesh are", "no wheels are in mesh"),
)


# --- values of tracks, contacts, racks and rollers -----------------------------------------------


@action("radius-along")
def radius_along(line: Line, radius: Real) -> Line:
    """The path of the centre of a wheel that rolls to the left of its track."""
    return Line(line.point + 1j * line.along * (radius / abs(line.along)), line.along)


@action("contact-on-track")
def contact_on_track(line: Line, centre: Point) -> Point:
    """The foot of the perpendicular from a wheel's centre to its straight track."""
    unit = line.along / abs(line.along)
    return line.point + unit * dot(unit, centre - line.point)


@action("contact-of-wheels")
def contact_of_wheels(track_centre: Point, centre: Point, track: Real, wheel: Real) -> Point:
    """The contact of two wheels on their line of centres; a ring's radius is negative."""
    return track_centre + (centre - track_centre) * (track / (track + wheel))


@action("rack-at")
def rack_at(
    centre: Point, axis: Point, here: Point, along: Point, point: Point, radius: Real, way: Real
) -> Point:
    """A point of a rack, from the wheel that has rolled a way along its track through ``here``."""
    line = axis * (along / abs(along))
    return centre - line * at(way, radius) + axis * (point - here)


@action("between-tracks")
def between_tracks(
    own: Line, other: Line, lean: Real, radius: Real, other_radius: Real, way: int
) -> Real:
    """The coordinate of a roller between two parallel tracks, on the first, from its rotation.

    The distances rolled on both tracks give the same rotation. ``lean`` is the rotation at the zero
    of the first track less that at the zero of the second. ``way`` is +1 for tracks of the same
    sense and -1 for opposite ones.
    """
    unit = own.along / abs(own.along)
    shift = dot(unit, own.point - other.point)
    return -(lean * other_radius + way * shift) / (way - other_radius / radius)


# --- constructions -------------------------------------------------------------------------------


class Track(Construction, frozen=True, kw_only=True):
    """The ``line`` of a straight track, on which a ``wheel`` rolls as ``rolling`` says.

    ``sign`` is the wheel's name among the wheels of its link.
    """

    guided: ClassVar[str] = "wheel"

    wheel: str
    sign: str
    rolling: Rolling
    line: OwnStep

    def line_name(self, steps: Sequence[Step], role: str) -> str:
        """The track, by the point through which it is drawn, or by its wheel."""
        through = self.rolling.through
        return f"the line through {through}" if isinstance(through, str) else f"guide {self.wheel}"

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the track: on the frame, or through a point of a moving link."""
        if self.rolling.on == FRAME:
            return drawing.words("step.guide-named", guide=way_of(drawing, self.wheel))
        line = straight(drawing, self.rolling, on_paper=True)
        names = {"g": escape(self.sign), "h": escape(self.rolling.on)}
        key = "step.track-of-bar" if self.wheel == FRAME else "step.track-of"
        return drawing.words(key, line=line, **names)


class CentrePath(Construction, frozen=True, kw_only=True):
    """The ``line`` of the ``centre`` of a ``wheel``, parallel to its straight ``track``.

    ``sign`` is the wheel's name among the wheels of its link.
    """

    lines: ClassVar[Mapping[str, str]] = {"line": "the path of the centre of {wheel}"}
    lines_before: ClassVar[tuple[str, ...]] = ("track",)
    guided: ClassVar[str] = "wheel"

    wheel: str
    sign: str
    centre: str
    track: int
    line: OwnStep

    def path_name(self, drawing: Drawing) -> str:
        return drawing.words("page.trajectory", of=symbol(self.centre))

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the parallel to the track at the radius."""
        return drawing.words("step.radius-along", k=escape(self.sign))


class PointOfContact(Construction, frozen=True, kw_only=True):
    """The ``point``, called ``name``, in which a ``wheel`` touches what it rolls ``on``.

    ``found_from`` are the steps of the values that give the point.
    """

    reasons: ClassVar[Mapping[str, str]] = {"point": "why.touch"}
    marked_as: ClassVar[str] = "contact"

    name: str
    wheel: str
    on: str
    found_from: tuple[int, ...]
    point: OwnStep

    def symbols(self) -> dict[str, str]:
        """The symbols of the contact, of the wheel's own point there, and of both links."""
        own = symbol(lettered(under(self.name, self.wheel)))
        both = {"k": escape(self.wheel), "g": escape(self.on)}
        return {"name": symbol(self.name), "t": own, **both}


class ContactOnTrack(PointOfContact, frozen=True, kw_only=True):
    """The foot of the perpendicular from the wheel's centre to its straight track.

    ``sign`` is the wheel's name among the wheels of its link.
    """

    sign: str

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The track of a moving link, unless the path of the wheel's centre includes it."""
        track, _ = self.found_from
        steps, users = drawing.trace.program.steps, drawing.children.get(track, ())
        is_named = any(isinstance(construction(steps[user]), CentrePath) for user in users)
        return () if is_named or self.on == FRAME else (track,)

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the foot of the perpendicular."""
        key = "contact-on-track" if self.on == FRAME else "contact-on-track-of"
        key = "contact-on-bar" if self.wheel == FRAME else key
        return drawing.words(f"step.{key}", **self.symbols() | {"k": escape(self.sign)})


class ContactOfWheels(PointOfContact, frozen=True, kw_only=True):
    """A contact on the line of centres, at the radius of one wheel from its centre.

    ``signs`` are the names of the wheel and of the other one. The radius is that of the wheel
    ``about``.
    """

    signs: tuple[str, str]
    about: tuple[str, Wheel]

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the contact by a radius; a gear's follows from its module and teeth."""
        size = abs(float(drawing.trace.values[self.found_from[2]]))
        sign, wheel = self.about
        count = f" = *m*·{of_wheel('z', sign)}/2" if wheel.teeth else ""
        both = {"k": escape(self.signs[0]), "g": escape(self.signs[1])}
        return drawing.words(
            "step.contact-of-wheels",
            radius=f"{of_wheel('r', sign)}{count} ({drawn_amount(drawing, size)})",
            o=symbol(wheel.centre),
            **self.symbols() | both,
        )


class CentreOfBelt(PointOfContact, frozen=True, kw_only=True):
    """The crossing of the strands of a ``belt`` with the line of the wheels' centres, ``ends``.

    The strands are common tangents of the wheels. At the crossing, both wheels, extended as plates,
    have the same velocity.
    """

    reasons: ClassVar[Mapping[str, str]] = {"point": "why.belt"}

    belt: Belt
    ends: tuple[str, str]

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the crossing of the strands, produced if the belt is open."""
        key = "centre-of-crossed-belt" if self.belt.crossed else "centre-of-open-belt"
        return drawing.words(f"step.{key}", bar=bar(*self.ends), **self.symbols())


class RackPoint(Construction, frozen=True, kw_only=True):
    """A ``point`` of a ``rack``, from the ``wheel`` that has rolled a ``way`` along it.

    It is called a rack where the wheel has teeth; a strand of a rope or a bar moves in the same
    way.
    """

    pencil: ClassVar[Mapping[str, ByHand]] = {"point": ByHand.LAID_OFF}

    rack: str
    wheel: str
    way: int
    point: OwnStep

    def is_toothed(self, drawing: Drawing) -> bool:
        """Whether its wheel is a gear."""
        return any(wheel.teeth for wheel in drawing.scene.link(self.wheel).wheels)

    def reason(self, drawing: Drawing, role: str) -> str:
        """The reason: the rack moves as far as the rim."""
        if role != "point":
            return ""
        return "why.rack" if self.is_toothed(drawing) else "why.strand"

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the point by the arc through which the wheel has turned."""
        key = "step.rack-at" if self.is_toothed(drawing) else "step.strand-at"
        return drawing.words(
            "step.bar-at" if self.wheel == FRAME else key,
            name=drawing.lettered(self.point),
            g=escape(self.rack),
            arc=drawn_amount(drawing, abs(float(drawing.trace.values[self.way]))),
        )


class RollerCentre(Construction, frozen=True, kw_only=True):
    """The ``centre`` of a roller between two tracks, on its ``path`` along the first of them.

    ``where`` is its coordinate there. It follows from the difference ``lean`` of the roller's
    angles at the zeros of the tracks, and from its ``radii`` on both tracks.
    """

    reasons: ClassVar[Mapping[str, str]] = {"centre": "why.roller"}
    lines_before: ClassVar[tuple[str, ...]] = ("path",)

    path: int
    lean: int
    radii: tuple[int, int]
    where: OwnStep
    centre: OwnStep

    def is_halfway(self, drawing: Drawing) -> bool:
        """Whether the roller has rolled equally far on both tracks."""
        lean, one, two = (float(drawing.trace.values[n]) for n in (self.lean, *self.radii))
        return abs(lean) < SAME and abs(abs(one) - abs(two)) < SAME * abs(one)

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence for the centre by its coordinate, or halfway."""
        name = drawing.lettered(self.centre)
        if self.is_halfway(drawing):
            return drawing.words("step.set-halfway", name=name)
        what = drawn_amount(drawing, float(drawing.trace.values[self.where]))
        return drawing.words("step.set-at", name=name, what=what)


# --- velocities ----------------------------------------------------------------------------------


def of_contacts(drawing: Drawing) -> Iterator[Relation]:
    """The velocities at contacts that the plan holds under another name, as nothing slips there."""
    if drawing.kind != "velocity":
        return
    for contact, index, (tail, tip), key in at_contacts(drawing):
        arrow = arrow_of(drawing, tail, tip)
        vector = plan_vector(arrow) if arrow else None
        if vector is None or vector.symbol == f"v_{index}":
            continue
        name = drawing.symbol(vector.symbol)
        size = drawing.settled(abs(drawing.trace.values[tip] - drawing.trace.values[tail]))
        fields = {"contact": symbol(f"v_{contact}"), "v": name}
        remark = drawing.words(f"calculation.{key}", **fields)
        yield Relation(symbol(f"v_{index}"), name, "", answer(drawing, size), "m/s", remark)


def at_contacts(drawing: Drawing) -> Iterator[tuple[str, str, tuple[int, int], str]]:
    """The velocities used at contacts: contact, index, ends in the plan, key of the words."""
    program, pole = drawing.trace.program, -1
    contacts = {each.point for each in constructions(program, PointOfContact)}
    for number, step, _ in drawing.steps(drawing.plane, Plane.NUMBERS):
        match construction(step):
            case PlanPole():
                pole = number
            case PerpendicularThrough(touch=touch, p=p, start=start) if touch:
                yield p, p, (pole, start), "no_slip"
            case TurningOfLink(places=(_, place)) as turning if (
                place in contacts and turning.quantity == OMEGA
            ):
                key = "contact_rests_opposite" if turning.images[1] == pole else "no_slip"
                yield turning.q, turning.index, turning.images, key
