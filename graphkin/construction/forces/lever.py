"""Zhukovsky's lever: the velocity plan turned by 90°, with every force at the image of its point.

The moment of a force about the pole is its power. The sum of all moments is zero, and no reaction
enters, so the lever gives the balance of the driver without any polygon (N. E. Zhukovsky, 1909).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import sense
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import OwnStep, Part, Plane
from graphkin.construction.core.relation import Relation, answer, figure
from graphkin.construction.core.vocabulary import action
from graphkin.construction.forces.loads import (
    LENGTH,
    LinkForce,
    newton_metres,
    newtons,
    on_lever,
    signed,
)
from graphkin.construction.forces.moments import (
    SEEN,
    arm,
    of_moments,
    pairs_and_couples,
    right_angle,
)
from graphkin.construction.plan import omega_of
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import cross


@action("lever-pole")
def lever_pole() -> Point:
    """The pole of the turned velocity plan."""
    return 0j


@action("lever-image")
def lever_image(image: Point) -> Point:
    """The image of a point in the velocity plan turned clockwise by 90°."""
    return -1j * image


@action("lever-moved")
def lever_moved(turned: Point, omega: Real, centre: Point, place: Point) -> Point:
    """The image of a place near a point of the same link: parallel to it in the turned plan."""
    return turned + omega * (place - centre)


@action("lever-couple")
def lever_couple(moment: Real, omega: Real) -> Real:
    """The moment of a couple on the lever: its power M·ω."""
    return moment * omega


@action("lever-balance")
def lever_balance(turned: Point, *rest: Any) -> Point:
    """The force at the image of the driven point, normal to it, that balances the lever.

    ``rest`` holds pairs of the foot of an arm and its force, then the moments of couples, then the
    number of pairs.
    """
    square = turned.real * turned.real + turned.imag * turned.imag
    return -power_of(rest) / square * (1j * turned)


@action("lever-moment")
def lever_moment(start: Point, end: Point, force: Point) -> Real:
    """The moment of the balancing force about the crank's pivot."""
    return cross(end - start, force)


@action("lever-rate")
def lever_rate(omega: Real, *rest: Any) -> Real:
    """The moment on a link with a rate that balances the powers of all loads.

    ``rest`` holds pairs of the foot of an arm and its force, then the moments of couples, then the
    number of pairs.
    """
    return -power_of(rest) / omega


def power_of(rest: tuple[Any, ...]) -> Real:
    """The sum of the moments of all loads on the lever."""
    pairs, couples = pairs_and_couples(rest)
    total: Any = 0.0
    for moment in chain((cross(foot, force) for foot, force in pairs), couples):
        total = total + moment
    return total


class LeverPole(Construction, frozen=True, kw_only=True):
    """The pole of the lever."""

    pole: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the pole."""
        canvas.pole()


class LeverImage(Construction, frozen=True, kw_only=True):
    """The ``turned`` image of a point, named as in the velocity plan; its ray from the pole."""

    image: int
    turned: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the image with its ray."""
        turned = canvas.value(self.turned)
        canvas.leg("", "construction", 0 * turned, turned)
        canvas.image()


class LeverMoved(Construction, frozen=True, kw_only=True):
    """The ``turned`` image of the place of a moved inertia force, near that of its centre."""

    name: str
    near: int
    turned: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the short side from the image of the centre of mass."""
        canvas.leg("", "construction", canvas.value(self.near), canvas.value(self.turned))


class LeverForce(Construction, frozen=True, kw_only=True):
    """A force at the image of its point on the lever, and its arm about the pole."""

    name: str
    look: str
    number: str
    pole: int
    turned: int
    force: int
    foot: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the force without scale, and its arm with its dimension."""
        turned, foot, force = map(canvas.value, (self.turned, self.foot, self.force))
        if not canvas.drawing.settled(abs(force)):
            return
        canvas.vector(
            self.name, self.look, turned, turned + force / abs(force) * LENGTH / canvas.mm
        )
        if canvas.size(foot) > SEEN:
            canvas.leg(self.name, "ray", turned, foot)
            canvas.dimension(self.number, 0 * foot, foot)
            right_angle(canvas, foot, 0 * foot, force)


class LeverBalance(Construction, frozen=True, kw_only=True):
    """The balancing ``force`` at the image of the driven point, and the ``moment`` of a crank.

    A crank with no point but its pivot has no ``force``; its ``omega`` gives the moment.
    """

    reasons: ClassVar[Mapping[str, str]] = {"force": "why.force_lever"}

    name: str
    moment_name: str
    ends: tuple[str, str] = ("", "")
    turned: int | None = None
    start: int | None = None
    end: int | None = None
    forces: tuple[tuple[str, str, int, int], ...]
    couples: tuple[tuple[str, str, int], ...]
    other: int
    force: OwnStep | None = None
    moment: OwnStep | None = None
    omega: int | None = None
    link: str = ""

    @property
    def last(self) -> str:
        """The role of its result."""
        return "force" if self.omega is None else "moment"

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the balancing force at the image of the driven point."""
        if role != "force" or self.turned is None or self.force is None:
            return
        turned, force = canvas.value(self.turned), canvas.value(self.force)
        if canvas.drawing.settled(abs(force)):
            way = force / abs(force) * LENGTH / canvas.mm
            canvas.vector(self.name, "balance", turned, turned + way)

    def terms(self, drawing: Drawing) -> Iterator[tuple[str, str, float, float, float]]:
        """Each term: its symbol, its arm's, its moment in W, its force in N and its arm in mm."""
        values = drawing.trace.values
        for name, number, foot, force in self.forces:
            moment, size = float(cross(values[foot], values[force])), abs(values[force])
            arm = on_lever(drawing, abs(values[foot]))
            if drawing.settled(size) and arm > SEEN:
                yield name, number, moment, float(size), arm
        for name, number, couple in self.couples:
            if values[couple]:
                yield name, number, float(values[couple]), 0.0, 0.0

    def size(self, drawing: Drawing) -> float:
        """The moment (N·m) or the force (N) along the motion, by the lever; zero for rounding."""
        values = drawing.trace.values
        if self.moment is not None:
            moment = float(values[self.moment])
            return moment if drawing.settled(abs(moment) / drawing.reach) else 0.0
        assert self.force is not None
        return drawing.settled(abs(values[self.force]))

    def difference(self, drawing: Drawing) -> float:
        """The difference of both routes, as a share of the larger one."""
        values = drawing.trace.values
        number = self.force if self.moment is None else self.moment
        assert number is not None
        found = values[number]
        other = values[self.other]
        largest = max(abs(found), abs(other))
        return float(abs(found - other) / largest) if largest else 0.0

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The lever with its sum of moments, and its result."""
        if role != self.last:
            return ""
        words, size = drawing.words, self.size(drawing)
        if self.turned is None or self.force is None:
            return self.by_rate(drawing, size)
        force = abs(drawing.trace.values[self.force])
        letter = symbol(drawing.trace.program.steps[self.turned].name)
        fields = {
            "p": letter,
            "f": symbol(self.name),
            "below": self.below(drawing),
            "sum": self.sums(drawing)[0],
            "force": newtons(drawing, drawing.settled(force)),
            "m": symbol(self.moment_name),
            "bar": bar(*self.ends),
            "size": newton_metres(drawing, size),
            "sense": sense(words, size),
        }
        if not size:
            return words("step.force-lever-none", **fields)
        said = words("step.force-lever", **fields)
        return (
            said + words("step.force-lever-moment", **fields) if self.moment is not None else said
        )

    def by_rate(self, drawing: Drawing, size: float) -> str:
        """The sum of moments divided by the crank's rate, without a balancing force."""
        words = drawing.words
        fields = {"m": symbol(self.moment_name), "f": symbol(self.moment_name)}
        if not size:
            return words("step.force-lever-none", **fields)
        return words(
            "step.force-lever-rate",
            sum=self.sums(drawing)[0],
            below=symbol(f"ω_{self.link}"),
            size=newton_metres(drawing, size),
            sense=sense(words, size),
            **fields,
        )

    def in_metres(self, drawing: Drawing) -> bool:
        """Whether arms are in m/s: where there are couples, or where a rate divides the sum."""
        return self.omega is not None or any(not each[3] for each in self.terms(drawing))

    def below(self, drawing: Drawing) -> str:
        """The arm of the balancing force in symbols, in m/s beside couples."""
        assert self.turned is not None
        arm = drawing.in_signs("*o*") + drawing.lettered(self.turned)
        return f"({arm}·{drawing.in_signs('*k*_v')})" if self.in_metres(drawing) else arm

    def sums(self, drawing: Drawing) -> tuple[str, str]:
        """The sum of moments in symbols and in figures, positive as a whole."""
        some = list(self.terms(drawing))
        turned = sum(each[2] for each in some) < 0
        symbols, figures = [], []
        for name, number, moment, force, length in some:
            said, put = f"{symbol(name)}·{symbol(number)}", figure(drawing, abs(moment))
            if force:
                put = f"{figure(drawing, force)}·{figure(drawing, length)}"
                if self.in_metres(drawing):
                    said += drawing.in_signs("·*k*_v")
                    put += f"·{figure(drawing, drawing.scales.k_lever / 1000)}"
            symbols.append(((moment > 0) is not turned, said))
            figures.append(((moment > 0) is not turned, put))
        return signed(symbols), signed(figures)

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The force, then the moment of the crank."""
        size = self.size(drawing)
        if role != self.last or not size:
            return
        values = drawing.trace.values
        if self.turned is None or self.force is None:
            assert self.omega is not None
            omega, rate = symbol(f"ω_{self.link}"), figure(drawing, abs(values[self.omega]))
            symbols, figures = self.sums(drawing)
            put = f"({symbols})/{omega} = ({figures})/{rate}"
            result, said = answer(drawing, abs(size)), sense(drawing.words, size)
            left, about = symbol(self.moment_name), drawing.in_signs(f"Σ*M*(*o*)/{omega}")
            yield Relation(left, about, put, result, "N·m", said, turns=True)
            return
        metres = self.in_metres(drawing)
        along = figure(drawing, on_lever(drawing, abs(values[self.turned])))
        put = along
        if metres:
            put = f"({along}·{figure(drawing, drawing.scales.k_lever / 1000)})"
        force = float(abs(values[self.force]))
        arm = drawing.in_signs("*o*") + drawing.lettered(self.turned)
        yield of_moments(
            (symbol(self.name), answer(drawing, force), "N"),
            drawing.in_signs("*o*"),
            self.sums(drawing),
            (self.below(drawing), put),
            by=arm,
        )
        if self.moment is None:
            return
        assert self.start is not None and self.end is not None
        length = float(abs(values[self.end] - values[self.start]))
        yield Relation(
            symbol(self.moment_name),
            f"{symbol(self.name)}·{bar(*self.ends)}",
            f"{figure(drawing, force)}·{figure(drawing, length)}",
            answer(drawing, abs(size)),
            "N·m",
            sense(drawing.words, size),
            turns=True,
        )


# --- writing its steps ---------------------------------------------------------------------------


class LeverPlan:
    """The lever while it is drawn."""

    def __init__(self, pen: Pen) -> None:
        self.pen = pen
        with pen.on(Part.FORCE, Plane.LEVER):
            self.pole = pen.draw(lever_pole, name="o")
        pen.make(LeverPole(pole=self.pole))
        self.images: dict[int, int] = {}
        self.forces: list[tuple[str, str, int, int]] = []
        self.couples: list[tuple[str, str, int]] = []

    def image(self, point: str) -> int:
        """The turned image of a point; the pole itself for a point at rest."""
        pen = self.pen
        image = pen.the("velocity", point)
        if image == pen.pole(Plane.VELOCITIES):
            return self.pole
        if image not in self.images:
            with pen.on(Part.FORCE, Plane.LEVER):
                turned = pen.draw(lever_image, image, name=pen.steps[image].name)
            pen.make(LeverImage(image=image, turned=turned))
            self.images[image] = turned
        return self.images[image]

    def moved(self, link: str, name: str, point: str, place: int) -> int:
        """The turned image of the place of a moved inertia force."""
        pen, near = self.pen, self.image(point)
        omega, centre = omega_of(pen, link), pen.the("position", point)
        with pen.on(Part.FORCE, Plane.LEVER):
            turned = pen.draw(lever_moved, near, omega, centre, place)
        return pen.make(LeverMoved(name=name, near=near, turned=turned)).turned

    def put(self, acting: LinkForce, turned: int, number: str) -> None:
        """Put a force at an image, with its arm."""
        assert acting.force is not None
        with self.pen.on(Part.FORCE, Plane.LEVER):
            foot = self.pen.draw(arm, self.pole, turned, acting.force)
        self.pen.make(
            LeverForce(
                name=acting.name,
                look=acting.look,
                number=number,
                pole=self.pole,
                turned=turned,
                force=acting.force,
                foot=foot,
            )
        )
        self.forces.append((acting.name, number, foot, acting.force))

    def couple(self, link: str, acting: LinkForce) -> None:
        """Add a couple on a link."""
        pen = self.pen
        assert acting.couple is not None
        omega = omega_of(pen, link)
        with pen.on(Part.FORCE, Plane.NUMBERS):
            found = pen.draw(lever_couple, acting.couple, omega)
        self.couples.append((acting.name, f"ω_{link}", found))

    @property
    def loads(self) -> list[int]:
        """The inputs of the sum of moments: feet and forces, then couples."""
        steps = [n for _, _, foot, force in self.forces for n in (foot, force)]
        return [*steps, *(step for _, _, step in self.couples)]

    def by_rate(self, name: str, link: str, other: int) -> None:
        """The moment of a crank with no point but its pivot, from the loads' power and its rate."""
        pen, omega = self.pen, omega_of(self.pen, link)
        with pen.on(Part.FORCE, Plane.NUMBERS):
            moment = pen.draw(lever_rate, omega, *self.loads, extra=(float(len(self.forces)),))
        pen.make(
            LeverBalance(
                name=name,
                moment_name=name,
                forces=tuple(self.forces),
                couples=tuple(self.couples),
                other=other,
                moment=moment,
                omega=omega,
                link=link,
            )
        )

    def balance(
        self, names: tuple[str, str], ends: tuple[str, str], other: int, *, turns: bool
    ) -> None:
        """The balance at the image of the second of two points, ``other`` being the polygons'."""
        pen = self.pen
        start, end = (pen.the("position", e) for e in ends) if turns else (None, None)
        turned = self.image(ends[1])
        with pen.on(Part.FORCE, Plane.LEVER):
            force = pen.draw(lever_balance, turned, *self.loads, extra=(float(len(self.forces)),))
        moment = None
        if start is not None and end is not None:
            with pen.on(Part.FORCE, Plane.NUMBERS):
                moment = pen.draw(lever_moment, start, end, force)
        pen.make(
            LeverBalance(
                name=names[0],
                moment_name=names[1],
                ends=(letter(ends[0]), letter(ends[1])),
                turned=turned,
                start=start,
                end=end,
                forces=tuple(self.forces),
                couples=tuple(self.couples),
                other=other,
                force=force,
                moment=moment,
            )
        )
