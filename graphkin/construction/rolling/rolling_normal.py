"""The acceleration of a rolling contact point relative to what it rolls on: along the radius."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.component import Component, OwnSizes, Size, components_on
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, Construction, Run, Wording
from graphkin.construction.core.naming import drawn_between, laid_off_words, rate_symbol
from graphkin.construction.core.pen import Pen, letter, second_image
from graphkin.construction.core.program import OwnStep, Part, Plane, PlanVector
from graphkin.construction.core.quantities import in_mm
from graphkin.construction.core.relation import Relation, answer, figure, length_of, squared
from graphkin.construction.core.vocabulary import action, along_bar, join, lay_off
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real


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
            drawn=in_mm(
                drawing.words, drawn_between(drawing, self.start, self.image, drawing.plane)
            ),
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
