"""The loads of a link: weight, inertia force and moment, given forces, and passed reactions.

The inertia force −m·a_S is laid off against s′ of the acceleration plan. The inertia moment −J·ε
moves it sideways by h = J·ε/(m·a_S), so that one force replaces both.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, NamedTuple

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction, Slip, constructions
from graphkin.construction.core.naming import sense
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.quantities import EPSILON, in_mm
from graphkin.construction.core.relation import Relation, answer, put_in
from graphkin.construction.core.vocabulary import action, distance
from graphkin.construction.forces.force_words import newtons, sub
from graphkin.construction.plan import omega_of
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import dot
from graphkin.scene.forces import Forces, Mass
from graphkin.scene.link_points import lettered
from graphkin.text.markup import COMMA, saying

LENGTH = 13.0
"""Length in mm of the arrows of forces on the mechanism, which show sense and direction alone."""
MOST = 2.0
"""An inertia force is moved out by less than this many sizes of its link."""
SEEN = 0.4
"""A displacement of an inertia force below this, in mm, is not dimensioned."""


@action("inertia-force")
def inertia_force(mass: Real, pole: Point, image: Point) -> Point:
    """The inertia force −m·a_S, from s′ to o′ of the acceleration plan."""
    return mass * (pole - image)


@action("inertia-moment")
def inertia_moment(inertia: Real, epsilon: Real) -> Real:
    """The inertia moment −J·ε, counter-clockwise positive."""
    return -inertia * epsilon


@action("moved-out")
def moved_out(centre: Point, force: Point, moment: Real, reach: Real) -> Point:
    """The foot of the centre of mass on the one force that replaces force and moment.

    It is the centre itself where the force is too small to be moved that far.
    """
    square, far = dot(force, force), is_far(force, moment, reach)
    return centre - 1j * force * (pick(far, 0.0, moment) / pick(far, 1.0, square))


@action("left-moment")
def left_moment(force: Point, moment: Real, reach: Real) -> Real:
    """The inertia moment where the force is too small to be moved out for it, otherwise zero."""
    return pick(is_far(force, moment, reach), moment, 0.0)


def is_far(force: Point, moment: Real, reach: Real) -> Any:
    """Whether a force would have to be moved out by more than MOST of the size of its link."""
    return abs(moment) >= MOST * reach * abs(force)


@action("weight")
def weight(mass: Real, gravity: Point) -> Point:
    """The weight m·g."""
    return mass * gravity


@action("opposite")
def opposite(force: Point) -> Point:
    """The opposite force, which the other link of a pair feels."""
    return -force


@action("acts-at")
def acts_at(place: Point, force: Point) -> Point:
    """The place at which a force acts on the drawing."""
    return place


# --- the forces that act on a link ---------------------------------------------------------------


class LinkForce(NamedTuple):
    """A force or a moment on a link: its symbol and its style, and the steps that hold it.

    ``at`` is the point of the mechanism through which the force passes; empty for a moved inertia
    force and for the reaction of a guide.
    """

    name: str
    look: str
    force: int | None = None
    place: int | None = None
    couple: int | None = None
    at: str = ""


class AppliedForce(Construction, frozen=True, kw_only=True):
    """A ``force`` at its ``place`` on the mechanism, drawn as an arrow without scale."""

    gives: ClassVar[tuple[str, ...]] = ("where",)

    name: str
    look: str
    place: int
    force: int
    where: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the arrow from the place; a note says that the place is beyond the field."""
        place, force = canvas.value(self.place), canvas.value(self.force)
        if not canvas.drawing.settled(abs(force)):
            return
        if not canvas.holds(place):
            canvas.note(canvas.drawing.words("page.force_beyond", name=symbol(self.name)))
            return
        way = force / abs(force) * LENGTH / canvas.mm
        canvas.vector(self.name, self.look, place, place + way)


def moment_slips(role: str) -> Mapping[str, Slip]:
    """The slips in an inertia moment, which is the result of a role."""
    return {
        "inertia_moment_missing": Slip(0, "moderate", (role,), inertia_moment),
        "inertia_moment_reversed": Slip(-1, "moderate", (role,), inertia_moment),
    }


class InertiaForce(Construction, frozen=True, kw_only=True):
    """The inertia force of a ``link`` with its centre of mass in ``point``, and its displacement.

    ``moment`` and ``place`` are None for a link that does not turn, or turns at a constant rate.
    """

    gives: ClassVar[tuple[str, ...]] = ("force", "moment", "place")
    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_inertia"}
    slips: ClassVar[Mapping[str, Slip]] = {
        "inertia_along": Slip(-1, "moderate", ("force",)),
        "inertia_missing": Slip(0, "serious", ("force", "moment")),
        **moment_slips("moment"),
    }

    link: str
    point: str
    name: str
    number: str
    mass: int
    image: int
    pole: int
    centre: int
    force: int
    inertia: int | None = None
    epsilon: int | None = None
    moment: int | None = None
    place: int | None = None

    def size(self, drawing: Drawing) -> float:
        """The magnitude of the force in N; zero for rounding."""
        return drawing.settled(abs(drawing.trace.values[self.force]))

    def shift(self, drawing: Drawing) -> float:
        """The displacement in metres."""
        values = drawing.trace.values
        return 0.0 if self.place is None else abs(values[self.place] - values[self.centre])

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the displacement from the centre of mass, with its dimension."""
        if role == "place" and self.place is not None:
            centre, place = canvas.value(self.centre), canvas.value(self.place)
            if canvas.size(place - centre) > SEEN:
                canvas.dimension(self.number, centre, place)

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The instruction: direction, magnitude, and the displacement with its side."""
        if role != "force":
            return ""
        size = self.size(drawing)
        fields = {
            "f": symbol(self.name),
            "k": escape(self.link),
            "m": symbol(f"m_{self.link}"),
            "s": symbol(self.point),
            "a": symbol(f"a_{lettered(self.point)}"),
            "image": symbol(drawing.trace.program.steps[self.image].name),
            "size": newtons(drawing, size),
        }
        if not size:
            return drawing.words("step.force-inertia-none", **fields)
        if self.moment is None or not self.shift(drawing):
            return drawing.words("step.force-inertia", **fields)
        moment = float(drawing.trace.values[self.moment])
        return drawing.words(
            "step.force-inertia-moved",
            h=symbol(self.number),
            mm=in_mm(drawing.words, drawing.on_paper(self.shift(drawing))),
            turning=symbol("M_" + sub("i", self.link)),
            sense=drawing.words("page.anticlockwise" if moment > 0 else "page.clockwise"),
            **fields,
        )

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """m·a_S, then J·ε and the displacement."""
        values = drawing.trace.values
        size, mass = self.size(drawing), float(values[self.mass])
        if role != "force":
            return
        a = abs(values[self.image] - values[self.pole])
        result = answer(drawing, size)
        figures = put_in(drawing, result, lambda m, a: m * a, mass, a)
        left, acceleration = symbol(self.name), symbol(f"a_{lettered(self.point)}")
        yield Relation(
            left, f"{symbol(f'm_{self.link}')}·{acceleration}", "·".join(figures), result, "N"
        )
        if self.moment is None or not self.shift(drawing):
            return
        assert self.epsilon is not None and self.inertia is not None
        moment = abs(values[self.moment])
        yield of_moment(drawing, self.link, self.inertia, self.epsilon)
        yield of_shift(drawing, self, moment, size)


class InertiaMoment(Construction, frozen=True, kw_only=True):
    """The inertia moment of a ``link`` that acts as a couple, in N·m."""

    gives: ClassVar[tuple[str, ...]] = ("couple",)
    reasons: ClassVar[Mapping[str, str]] = {"couple": "why.force_inertia"}
    slips: ClassVar[Mapping[str, Slip]] = {
        "inertia_missing": Slip(0, "serious", ("couple",), inertia_moment),
        **moment_slips("couple"),
    }

    link: str
    inertia: int
    epsilon: int
    couple: int

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """Its magnitude and its sense; empty where a moved force replaces it."""
        moment = float(drawing.trace.values[self.couple])
        if not moment:
            return ""
        return drawing.words(
            "step.force-inertia-couple",
            turning=symbol("M_" + sub("i", self.link)),
            j=symbol(f"J_{self.link}"),
            e=symbol(f"ε_{self.link}"),
            size=f"{answer(drawing, abs(moment))} N·m",
            sense=sense(drawing.words, moment),
        )

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """J·ε."""
        if drawing.trace.values[self.couple]:
            yield of_moment(drawing, self.link, self.inertia, self.epsilon)


def of_moment(drawing: Drawing, link: str, inertia: int, epsilon: int) -> Relation:
    """The relation of an inertia moment."""
    j, spun = (abs(float(drawing.trace.values[n])) for n in (inertia, epsilon))
    result = answer(drawing, j * spun)
    figures = put_in(drawing, result, lambda j, e: j * e, j, spun)
    symbols = f"{symbol(f'J_{link}')}·{symbol(f'ε_{link}')}"
    return Relation(symbol("M_" + sub("i", link)), symbols, "·".join(figures), result, "N·m")


def of_shift(drawing: Drawing, force: InertiaForce, moment: float, size: float) -> Relation:
    """The displacement of an inertia force on paper: M/(F·k_L)."""
    scale, words = drawing.scales.kL / 1000, drawing.words
    result = words.fixed(moment / size / scale, 2)
    figures = put_in(
        drawing,
        result,
        lambda m, f, k: m / (f * k),
        moment,
        size,
        scale,
        shown_as=lambda drawing, value: drawing.words.fixed(value, 2),
    )
    turning = symbol("M_" + sub("i", force.link))
    symbols = f"{turning}/({symbol(force.name)}·*k*_L)"
    put = f"{figures[0]}/({figures[1]}·{figures[2]})"
    return Relation(symbol(force.number), symbols, put, result, "mm")


class Weight(Construction, frozen=True, kw_only=True):
    """The weight of a ``link`` with its centre of mass in ``point``."""

    gives: ClassVar[tuple[str, ...]] = ("force",)
    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_weight"}
    slips: ClassVar[Mapping[str, Slip]] = {
        "weight_missing": Slip(0, "serious", ("force",)),
        "mass_for_weight": Slip(
            0, "moderate", ("force",), taken=lambda kind, force, get: force / abs(get(kind.gravity))
        ),
    }

    link: str
    point: str
    name: str
    mass: int
    gravity: int
    force: int

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sentence for all weights together, at the first of them."""
        every = [*constructions(drawing.trace.program, Weight)]
        if self is not every[0]:
            return ""
        values = drawing.trace.values
        falls = values[self.gravity]
        names = (
            saying(f"{symbol(e.name)} = {newtons(drawing, abs(values[e.force]))}", symbol(e.name))
            for e in every
        )
        one, many = "step.force-weight", "step.force-weights"
        if falls.real or falls.imag > 0:
            one, many = "step.force-weight-along", "step.force-weights-along"
        return drawing.words(many if len(every) > 1 else one, list=COMMA.join(names))

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """m·g."""
        values = drawing.trace.values
        mass, g = float(values[self.mass]), abs(values[self.gravity])
        result = answer(drawing, mass * g)
        figures = put_in(drawing, result, lambda m, g: m * g, mass, g)
        symbols = f"{symbol(f'm_{self.link}')}·*g*"
        yield Relation(symbol(self.name), symbols, "·".join(figures), result, "N")


# --- writing their steps -------------------------------------------------------------------------


def loads_of(pen: Pen, forces: Forces, numbers: Iterator[str]) -> dict[str, list[LinkForce]]:
    """The loads of each moving link, in the order of a moment equation: weight, inertia, given.

    ``numbers`` gives the symbols of arms, in order.
    """
    found: dict[str, list[LinkForce]] = {link: [] for link in pen.scene.links}
    for link, mass in forces.masses.items():
        if not mass.mass.is_zero():
            found[link] += of_mass(pen, forces, link, mass, numbers)
    counts: dict[str, int] = {}
    for load in forces.loads:
        number = counts[load.at or load.link] = counts.get(load.at or load.link, 0) + 1
        tail = f",{number}" if number > 1 else ""
        with pen.on(Part.FORCE, Plane.NUMBERS):
            if load.force is not None:
                force = pen.given("point", *load.force, name=f"load {load.at}{tail}")
                place = pen.the("position", load.at)
                name = f"P_{lettered(load.at)}{tail}"
                found[load.link].append(
                    applied(pen, LinkForce(name, "load", force, place, at=load.at))
                )
            if load.moment is not None:
                couple = pen.given("number", load.moment, name=f"moment {load.link}{tail}")
                found[load.link].append(LinkForce(f"M_{load.link}{tail}", "load", couple=couple))
    return found


def of_mass(
    pen: Pen, forces: Forces, link: str, mass: Mass, numbers: Iterator[str]
) -> Iterator[LinkForce]:
    """The weight and the inertia force of a link."""
    point = mass.centre
    centre = pen.the("position", point)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        own = pen.given("number", mass.mass, name=f"mass {link}")
        if forces.gravity is not None and not all(q.is_zero() for q in forces.gravity):
            gravity = pen.given("point", *forces.gravity, name="gravity")
            force = pen.draw(weight, own, gravity)
            name = f"G_{link}"
            pen.make(
                Weight(link=link, point=point, name=name, mass=own, gravity=gravity, force=force)
            )
            yield applied(pen, LinkForce(name, "load", force, centre, at=point))
        rests = point in pen.scene.frame.points
        turns = mass.inertia is not None and not mass.inertia.is_zero() and pen.turns(link)
        epsilon = omega_of(pen, link, EPSILON) if turns else None
        turns = epsilon is not None and not pen.is_zero(epsilon)
        inertia = moment = None
        if turns and epsilon is not None:
            inertia = pen.given("number", mass.inertia, name=f"inertia {link}")
            moment = pen.draw(inertia_moment, inertia, epsilon)
        if rests:
            if moment is not None and inertia is not None and epsilon is not None:
                yield couple_of(pen, link, inertia, epsilon, moment)
            return
        pole, image = pen.pole(Plane.ACCELERATIONS), pen.the("acceleration", point)
        force = pen.draw(inertia_force, own, pole, image)
    place = left = None
    if moment is not None:
        reach = reach_of(pen, link, centre)
        with pen.on(Part.FORCE, Plane.MECHANISM):
            place = pen.draw(moved_out, centre, force, moment, reach)
        with pen.on(Part.FORCE, Plane.NUMBERS):
            left = pen.draw(left_moment, force, moment, reach)
    name = "F_" + sub("i", link)
    pen.make(
        InertiaForce(
            link=link,
            point=point,
            name=name,
            number=next(numbers) if place is not None else "",
            mass=own,
            image=image,
            pole=pole,
            centre=centre,
            force=force,
            inertia=inertia if place is not None else None,
            epsilon=epsilon if place is not None else None,
            moment=moment,
            place=place,
        )
    )
    if left is not None and inertia is not None and epsilon is not None:
        yield couple_of(pen, link, inertia, epsilon, left)
    if place is None:
        yield applied(pen, LinkForce(name, "inertia", force, centre, at=point))
    else:
        yield applied(pen, LinkForce(name, "inertia", force, place))


def couple_of(pen: Pen, link: str, inertia: int, epsilon: int, couple: int) -> LinkForce:
    """The inertia moment of a link as a couple."""
    pen.make(InertiaMoment(link=link, inertia=inertia, epsilon=epsilon, couple=couple))
    return LinkForce("M_" + sub("i", link), "inertia", couple=couple)


def reach_of(pen: Pen, link: str, centre: int) -> int:
    """The distance of the centre of mass from another point of its link, or of the mechanism."""
    points = (*pen.scene.link(link).points, *pen.scene.points)
    places = (pen.the("position", point) for point in points)
    other = next(place for place in places if place != centre)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        return pen.draw(distance, centre, other)


def applied(pen: Pen, acting: LinkForce) -> LinkForce:
    """Draw a force on the mechanism."""
    assert acting.force is not None and acting.place is not None
    with pen.on(Part.FORCE, Plane.MECHANISM):
        where = pen.draw(acts_at, acting.place, acting.force)
    pen.make(
        AppliedForce(
            name=acting.name,
            look=acting.look,
            place=acting.place,
            force=acting.force,
            where=where,
        )
    )
    return acting
