"""The loads of a link: weight, inertia force and moment, given forces, and passed reactions.

The inertia force −m·a_S is laid off against s′ of the acceleration plan. The inertia moment −J·ε
moves it sideways by h = J·ε/(m·a_S), so that one force replaces both.

Numbers of forces as printed, in N and in mm of a polygon.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise, permutations
from typing import Any, ClassVar, NamedTuple

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Canvas, Construction, Slip, constructions
from graphkin.construction.core.naming import sense
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane, Target
from graphkin.construction.core.quantities import (
    EPSILON,
    FORCES,
    PAIR_REACTION,
    OnPaper,
    in_millimetres,
    in_mm,
    quantity_text,
)
from graphkin.construction.core.relation import Relation, answer, put_in
from graphkin.construction.core.vocabulary import action, distance
from graphkin.construction.plan import omega_of
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.numbers.arithmetic import Point, Real, modulo, pick
from graphkin.numbers.plane import dot
from graphkin.scene.forces import ByDriver, Directed, Forces, Load, Mass, Size, Spring
from graphkin.scene.link_points import lettered
from graphkin.scene.model import FRAME, Scene
from graphkin.text import COMMA, saying


def newtons(drawing: Drawing, size: float) -> str:
    """A force as printed, in N or in the unit of results."""
    return f"{answer(drawing, size)} {drawing.words.unit('N')}"


def newton_metres(drawing: Drawing, moment: float) -> str:
    """The magnitude of a moment as printed, in N·m or in the unit of results."""
    return f"{answer(drawing, abs(moment))} {drawing.words.unit('N·m')}"


def drawn_force(drawing: Drawing, size: float) -> OnPaper:
    """The drawn length of a force in a polygon, in mm."""
    return OnPaper(1000 * size / drawing.scales.kF)


def on_lever(drawing: Drawing, speed: float) -> OnPaper:
    """The drawn length of a velocity on the lever, in mm."""
    return OnPaper(1000 * speed / drawing.scales.k_lever)


def force_amount(drawing: Drawing, size: float) -> str:
    """The drawn length of a force in a polygon, as text."""
    return in_millimetres(drawing.words, drawn_force(drawing, size))


def signed(terms: Iterable[tuple[bool, str]]) -> str:
    """A sum of terms with their signs; the first positive term comes first, without its sign."""
    said, some = "", [*terms]
    first = next((term for term in some if term[0]), None)
    for positive, term in sorted(some, key=lambda term: term is not first):
        sign = "+" if positive else "−"
        said += f" {sign} {term}" if said else term if positive else f"−{term}"
    return said


def sub(sign: str, link: str) -> str:
    """The index of a force or moment of a link after a sign: i3, or i,rod."""
    return sign + link if link.isdigit() else f"{sign},{link}"


def link_pair(one: str, other: str) -> str:
    """The index of a force of one link on another: 34, or crank,rod."""
    return one + other if len(one) == len(other) == 1 else f"{one},{other}"


def is_asked(scene: Scene, forces: Forces, target: Target) -> bool:
    """Whether a scene asks for a reaction or a balance, by its target in the plan of forces."""
    quantity, name = target
    if quantity == PAIR_REACTION.target:
        return name in reaction_names(scene, forces.reactions)
    return forces.balance and any(quantity == each.target for each in FORCES)


def reaction_names(scene: Scene, asked: Iterable[str]) -> Iterator[str]:
    """The symbols of the reactions in some pins and in all guides of some blocks, in both senses.

    A plan draws one of the two senses. A belt has one reaction for each strand.
    """
    for name in asked:
        block = scene.links.get(name)
        if block is None:
            owners = [link.name for link in scene.every_link if name in link.points]
            yield from (f"R_{link_pair(*pair)}" for pair in permutations(owners, 2))
            continue
        others = [*(e.on for e in block.slides), *(e.on for e in block.rolls if not e.belt)]
        others += [scene.cams[name].on] if name in scene.cams else []
        belts = [e.on for e in block.rolls if e.belt]
        primes = [("", other) for other in others]
        primes += [(prime, other) for other in belts for prime, _ in STRANDS.values()]
        for prime, other in primes:
            yield from (f"R{prime}_{link_pair(*e)}" for e in ((name, other), (other, name)))


STRANDS = {"left": ("′", 1), "right": ("″", -1)}
"""The prime and the side of each strand of a belt, seen from its wheel towards the other one."""
LENGTH = 13.0
"""Length in mm of the arrows of forces on the mechanism, which show sense and direction alone."""
MOST = 2.0
"""An inertia force is moved out by less than this many sizes of its link."""
COIL, TURNS, END = 2.5, 9, 0.1
"""Half the width of a spring in mm, its strokes, and the share of its straight ends."""
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


@action("directed")
def directed(size: Real, way: Point) -> Point:
    """A force of some size in a direction."""
    return size * way


@action("along-velocity")
def along_velocity(size: Real, pole: Point, image: Point, sense: int) -> Point:
    """A force along the velocity of its point, or against it; zero for a point at rest."""
    speed = abs(image - pole)
    return sense * size / pick(speed == 0, 1.0, speed) * (image - pole)


@action("by-table")
def by_table(coordinate: Real, *rest: Any) -> Real:
    """The number of a table at a coordinate, on the straight lines between its points.

    ``rest`` holds the numbers, then their coordinates, then the period; 0 without one.
    """
    *both, period = rest
    numbers, knots = both[: len(both) // 2], both[len(both) // 2 :]
    beyond = coordinate - knots[0]
    if period:
        beyond = modulo(beyond, period)
    total = numbers[0] + 0 * beyond
    for k in range(1, len(knots)):
        start, wide = knots[k - 1] - knots[0], knots[k] - knots[k - 1]
        share = (beyond - start) / wide
        share = pick(share > 0, share, 0 * share)
        share = pick(share < 1, share, 0 * share + 1)
        total = total + share * (numbers[k] - numbers[k - 1])
    return total


@action("spring-force")
def spring_force(one: Point, other: Point, stiffness: Real, free: Real) -> Point:
    """The force of a spring on its first end: towards the other one where it is stretched."""
    length = abs(other - one)
    return stiffness * (length - free) / pick(length == 0, 1.0, length) * (other - one)


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

    name: str
    look: str
    place: int
    force: int
    where: OwnStep

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


class PassedReaction(Construction, frozen=True, kw_only=True):
    """The opposite of a reaction, which acts on the other link of the pair."""

    slips: ClassVar[Mapping[str, Slip]] = {"reaction_reversed": Slip(-1, "moderate", ("force",))}

    name: str
    force: OwnStep


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
    force: OwnStep
    inertia: int | None = None
    epsilon: int | None = None
    moment: OwnStep | None = None
    place: OwnStep | None = None

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

    reasons: ClassVar[Mapping[str, str]] = {"couple": "why.force_inertia"}
    slips: ClassVar[Mapping[str, Slip]] = {
        "inertia_missing": Slip(0, "serious", ("couple",), inertia_moment),
        **moment_slips("couple"),
    }

    link: str
    inertia: int
    epsilon: int
    couple: OwnStep

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """Its magnitude and its sense; empty where a moved force replaces it."""
        moment = float(drawing.trace.values[self.couple])
        if not moment:
            return ""
        return drawing.words(
            "step.force-inertia-couple",
            turning=symbol("M_" + sub("i", self.link)),
            j=symbol(f"J_{self.link}"),
            e=drawing.symbol(f"ε_{self.link}"),
            size=newton_metres(drawing, moment),
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
    symbols = f"{symbol(f'J_{link}')}·{drawing.symbol(f'ε_{link}')}"
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
    symbols = drawing.in_signs(f"{turning}/({symbol(force.name)}·*k*_L)")
    put = f"{figures[0]}/({figures[1]}·{figures[2]})"
    return Relation(symbol(force.number), symbols, put, result, "mm")


class Weight(Construction, frozen=True, kw_only=True):
    """The weight of a ``link`` with its centre of mass in ``point``."""

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
    force: OwnStep

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


class ByTable(Construction, frozen=True, kw_only=True):
    """A given force or moment ``name`` from a table of a driver's coordinate."""

    name: str
    unit: str
    driver: int
    coordinate: int
    number: OwnStep

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The number, and the place in the table."""
        values, words = drawing.trace.values, drawing.words
        driver, number = drawing.scene.drivers[self.driver], values[self.number]
        return words(
            "step.force-table",
            p=symbol(self.name),
            size=f"{answer(drawing, float(number))} {words.unit(self.unit)}",
            at=quantity_text(drawing.scene, words, driver.position),
        )


class ForceAlong(Construction, frozen=True, kw_only=True):
    """A given force ``name`` along (``sense`` +1) or against the velocity of its point."""

    name: str
    point: str
    sense: int
    pole: int
    image: int
    force: OwnStep

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """Its size and its sense."""
        return drawing.words(
            "step.force-along" if self.sense > 0 else "step.force-against",
            p=symbol(self.name),
            size=newtons(drawing, drawing.settled(abs(drawing.trace.values[self.force]))),
            v=symbol(f"v_{lettered(self.point)}"),
        )


class SpringForce(Construction, frozen=True, kw_only=True):
    """The force of a spring on the link at its first end, towards the other end or away from it."""

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_spring"}

    name: str
    ends: tuple[str, str]
    one: int
    other: int
    stiffness: int
    free: int
    force: OwnStep
    coil: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the spring as a zigzag between its ends."""
        one, other = canvas.value(self.one), canvas.value(self.other)
        length = canvas.size(other - one)
        if role != "coil" or length <= 2 * COIL:
            return
        along, across = other - one, 1j * (other - one) * (COIL / length)
        corners = [one, one + END * along]
        for k in range(TURNS):
            share = END + (1 - 2 * END) * (2 * k + 1) / (2 * TURNS)
            corners.append(one + share * along + (across if k % 2 else -across))
        corners += [other - END * along, other]
        for start, end in pairwise(corners):
            canvas.leg(self.name, "construction", start, end)

    @property
    def letters(self) -> tuple[str, str]:
        """The symbols of its stiffness and of its free length."""
        stiff, free = spring_letters(self.name.removeprefix("F_s"))
        return symbol(stiff), symbol(free)

    def lengths(self, drawing: Drawing) -> tuple[float, float]:
        """The length of the spring and its free length in m."""
        values = drawing.trace.values
        return float(abs(values[self.other] - values[self.one])), float(values[self.free])

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """Stiffness times elongation, and whether it pulls."""
        if role != "force":
            return ""
        long, free = self.lengths(drawing)
        return drawing.words(
            "step.force-spring-pull" if long >= free else "step.force-spring-push",
            f=symbol(self.name),
            c=self.letters[0],
            l=self.letters[1],
            bar=bar(*map(lettered, self.ends)),
            size=newtons(drawing, drawing.settled(abs(drawing.trace.values[self.force]))),
        )

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Stiffness times elongation."""
        if role != "force":
            return
        long, free = self.lengths(drawing)
        stiffness = float(drawing.trace.values[self.stiffness])
        result = answer(drawing, stiffness * abs(long - free))
        some = put_in(drawing, result, lambda c, a, b: c * abs(a - b), stiffness, long, free)
        c, length, rest = some
        stiff, other = self.letters
        terms = [(bar(*map(lettered, self.ends)), length), (other, rest)]
        (one, put), (other, less) = terms if long >= free else reversed(terms)
        left, figures = symbol(self.name), f"{c}·({put} − {less})"
        yield Relation(left, f"{stiff}·({one} − {other})", figures, result, "N")


# --- writing their steps -------------------------------------------------------------------------


def loads_of(pen: Pen, forces: Forces, numbers: Iterator[str]) -> dict[str, list[LinkForce]]:
    """The loads of each moving link, in the order of a moment equation: weight, inertia, given.

    ``numbers`` gives the symbols of arms, in order.
    """
    found: dict[str, list[LinkForce]] = {link: [] for link in pen.scene.links}
    for link, mass in forces.masses.items():
        if not mass.mass.is_zero():
            found[link] += of_mass(pen, forces, link, mass, numbers)
    for load, index in zip(forces.loads, load_names(forces.loads), strict=True):
        if load.force is not None:
            force = force_step(pen, load, index)
            place = pen.the("position", load.at)
            acting = LinkForce(f"P_{index}", "load", force, place, at=load.at)
            found[load.link].append(applied(pen, acting))
        if load.moment is not None:
            name = moment_name(load, index)
            couple = size_step(pen, load.moment, name, "N·m")
            found[load.link].append(LinkForce(name, "load", couple=couple))
    for number, spring in enumerate(forces.springs, 1):
        name = "F_s" + (str(number) if len(forces.springs) > 1 else "")
        for link, acting in of_spring(pen, spring, name):
            found[link].append(acting)
    return found


def load_names(loads: Sequence[Load]) -> Iterator[str]:
    """The index of each load: its point, or its link for a moment alone."""
    counts: dict[str, int] = {}
    for load in loads:
        number = counts[load.at or load.link] = counts.get(load.at or load.link, 0) + 1
        tail = f",{number}" if number > 1 else ""
        yield (lettered(load.at) if load.force is not None else load.link) + tail


def spring_letters(number: str) -> tuple[str, str]:
    """The stiffness and the free length of a spring by its number, empty for a single one."""
    return (f"c_{number}" if number else "c"), f"l_0{number}"


def moment_name(load: Load, index: str) -> str:
    """The symbol of a given moment, from the index of its load."""
    _, comma, number = index.rpartition(",")
    return f"M_{load.link}" + (comma + number if comma else "")


def force_step(pen: Pen, load: Load, index: str) -> int:
    """The step of a given force: by its components, or by its size and direction."""
    given = load.force
    if not isinstance(given, Directed):
        with pen.on(Part.FORCE, Plane.NUMBERS):
            return pen.given("point", *(given or ()), name=f"load {index}")
    name = f"P_{index}"
    size = size_step(pen, given.size, name, "N")
    if not given.sense:
        with pen.on(Part.FORCE, Plane.NUMBERS):
            way = pen.given("direction", given.angle, name=f"direction {index}")
            return pen.draw(directed, size, way)
    pole, image = pen.pole(Plane.VELOCITIES), pen.the("velocity", load.at)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        force = pen.draw(along_velocity, size, pole, image, extra=(given.sense,))
    kind = ForceAlong(
        name=name, point=load.at, sense=given.sense, pole=pole, image=image, force=force
    )
    return pen.make(kind).force


def size_step(pen: Pen, size: Size, name: str, unit: str) -> int:
    """The step of a given number, or of one from a table of a driver's coordinate."""
    with pen.on(Part.FORCE, Plane.NUMBERS):
        if not isinstance(size, ByDriver):
            return pen.given("number", size, name=f"size {name}")
        driver = pen.scene.drivers[size.driver]
        coordinate = pen.given("number", driver.position, name="coordinate", of=size.driver)
        numbers = [
            pen.given("number", each, name=f"{name} {k}") for k, each in enumerate(size.ends)
        ]
        knots, period = size.knots
        number = pen.draw(by_table, coordinate, *numbers, extra=(*knots, period))
    kind = ByTable(name=name, unit=unit, driver=size.driver, coordinate=coordinate, number=number)
    return pen.make(kind).number


def of_spring(pen: Pen, spring: Spring, name: str) -> Iterator[tuple[str, LinkForce]]:
    """The forces of a spring on the links at its ends; none on the frame."""
    one, other = (pen.the("position", end) for end in spring.ends)
    with pen.on(Part.FORCE, Plane.NUMBERS):
        stiffness = pen.given("number", spring.stiffness, name=f"stiffness {name}")
        free = pen.given("number", spring.free, name=f"free length {name}")
        force = pen.draw(spring_force, one, other, stiffness, free)
    with pen.on(Part.FORCE, Plane.MECHANISM):
        coil = pen.draw(acts_at, one, force)
    kind = SpringForce(
        name=name,
        ends=spring.ends,
        one=one,
        other=other,
        free=free,
        stiffness=stiffness,
        force=force,
        coil=coil,
    )
    pen.make(kind)
    for link, end, place, sign in zip(
        spring.links, spring.ends, (one, other), (1, -1), strict=True
    ):
        if link == FRAME:
            continue
        own = force
        if sign < 0:
            with pen.on(Part.FORCE, Plane.NUMBERS):
                own = pen.draw(opposite, force)
        yield link, applied(pen, LinkForce(name, "load", own, place, at=end))


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
            name=acting.name, look=acting.look, place=acting.place, force=acting.force, where=where
        )
    )
    return acting
