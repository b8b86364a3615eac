"""Components of an acceleration that follow from velocities: drawn by triangles, then laid off."""

from __future__ import annotations

from abc import abstractmethod
from collections import Counter
from collections.abc import Container, Iterator, Mapping
from typing import Any, ClassVar, Protocol

from msgspec import Struct

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import (
    ByHand,
    Construction,
    EndsComponent,
    Wording,
    construction,
    constructions,
)
from graphkin.construction.core.naming import drawn_between, plan_amount
from graphkin.construction.core.palette import PaletteAction, Picks
from graphkin.construction.core.plan_vector import sign_of
from graphkin.construction.core.program import Effect, Part, Plane, Program
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.run import Trace
from graphkin.construction.core.segments import TINY, is_short, letter_at
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import smaller
from graphkin.scene.model import Scene
from graphkin.text.markup import EQUALS, NOTHING


class Size(Struct, frozen=True):
    """A student's size of a component in SI: the own sizes that it follows from, and the bar (m)
    that is measured for it, infinite where none is.
    """

    factors: tuple[Any, ...]
    size: float
    bar: float


class OwnSizes(Protocol):
    """What a student has measured, or the key where nothing is: sizes in SI, with their fields."""

    def vectors(self, tail: int, tip: int) -> Iterator[Any]:
        """Sizes of the vector between two images."""

    def turnings(self, rate: int) -> Iterator[Any]:
        """Angular velocities, by the step that finds them."""

    def turnings_over(self, ends: tuple[int, ...]) -> Iterator[Any]:
        """Own angular velocities that are read off the same places and images."""

    def slidings(self, tail: int, tip: int) -> Iterator[Any]:
        """Velocities along a guide, by their ends in the plan."""

    def length(self, p: int, q: int) -> float:
        """Distance of two points in metres."""


class Component(Construction, frozen=True, kw_only=True):
    """A component of an acceleration: its ``index`` and its ``vector``, by both ways.

    ``vector`` is the stable value; ``read`` reads the same off a triangle on the mechanism, None
    where no triangle is drawn. ``palette`` is the action of a page that draws it, if one does;
    ``limited`` is what its figure is called where its proportions decide whether it can be drawn.
    ``slips`` are the factors by which a student's mistakes multiply it.
    """

    limited: ClassVar[str] = ""
    palette: ClassVar[PaletteAction | None] = None
    sign: ClassVar[str]
    look: ClassVar[str]
    laid_off_key: ClassVar[str]
    laid_off_reason: ClassVar[str]
    effect: ClassVar[Effect | None] = None
    follows: ClassVar[bool] = False
    gives_way: ClassVar[bool] = False

    slips: ClassVar[Mapping[str, complex]] = {}

    index: str
    vector: int | None = None
    read: int | None = None

    @property
    def name(self) -> str:
        """The component's name: a, its index, its sign."""
        return f"a_{self.index}^{self.sign}"

    @property
    def symbol(self) -> str:
        """Markup of its symbol."""
        return symbol(self.name)

    @classmethod
    def cause(cls, scene: Scene) -> str:
        """What in a scene brings its effect in; nothing where only what is asked does."""
        return ""

    @classmethod
    def absence(cls, scene: Scene) -> str:
        """What in a scene keeps its effect out; nothing where only what is asked does."""
        return ""

    # --- in words and figures --------------------------------------------------------------------

    def size(self, drawing: Drawing) -> float:
        """Its magnitude on a sheet, in m/s²."""
        assert self.vector is not None
        return float(abs(drawing.trace.values[self.vector]))

    def is_drawn(self, drawing: Drawing) -> bool:
        """Whether its triangle is drawn on a sheet, and is not too short for it."""
        if self.read not in drawing.trace.values:
            return False
        return not is_short(drawing, self.size(drawing), drawing.plane)

    def is_left_out(self, drawing: Drawing) -> bool:
        """Whether it is too short to be drawn in the plan, though not zero."""
        size = self.size(drawing)
        return bool(drawing.settled(size)) and is_short(drawing, size, drawing.plane)

    @abstractmethod
    def formula(self, drawing: Drawing) -> str:
        """Markup of what it is computed from."""

    def left_out(self, drawing: Drawing) -> str:
        """What is said of one that is too short to be drawn: what it is, how long it would be."""
        drawn = plan_amount(drawing, drawing.plane, self.size(drawing))
        return EQUALS.join((self.symbol, self.formula(drawing))) + f" ({drawn})"

    @abstractmethod
    def sentence(self, drawing: Drawing, *, first: bool) -> Wording:
        """What to draw, in full the ``first`` time."""

    def told_in_parts(self, drawing: Drawing) -> Iterator[tuple[int, str]]:
        """What is said of it alone, part by part, each with the step that it ends with."""
        assert self.vector is not None
        if self.is_left_out(drawing):
            yield self.vector, drawing.words("step.too-short", list=self.left_out(drawing))
        else:
            yield self.vector, self.sentence(drawing, first=True).markup

    def laid_alone(self, drawing: Drawing, **fields: str) -> str:
        """What is said of it where it leads to a point that is known; nothing where it is clear."""
        return ""

    def stands_at(self, drawing: Drawing) -> int | None:
        """The step of the pin at which its figure stands, where others do; None for others."""
        return None

    def picked_from(self, picks: Picks) -> tuple[str | None, ...]:
        """What its action of the palette is drawn from."""
        return ()

    def shown_between(self) -> tuple[int | None, ...]:
        """The steps of the points on the mechanism between which it is seen; none for others."""
        return ()

    @abstractmethod
    def section(self, drawing: Drawing) -> str:
        """The section of the calculation that holds its relation."""

    @abstractmethod
    def relation(self, drawing: Drawing) -> Relation:
        """Its line on the calculation page."""

    # --- what students make of it ----------------------------------------------------------------

    @abstractmethod
    def sizes(self, own: OwnSizes) -> Iterator[Size]:
        """Its size by each relation to sizes that a student has."""

    @abstractmethod
    def power_of(self, args: tuple[int, ...]) -> int:
        """With which power of a rate or speed, given by the steps that it is read off, it goes."""

    def proportions(self, values: Mapping[int, Any], seconds: Any) -> Iterator[tuple[str, Any]]:
        """How long its velocity is drawn to its bar, where that decides whether it can be drawn.

        With the velocity's symbol, set as its way in so many ``seconds``.
        """
        yield from ()

    def as_measured(self, found: Mapping[int, Any], key: Mapping[int, Any]) -> Any:
        """Its vector from own values as they are measured; None where the construction says it."""
        return None


class TriangleComponent(Component, frozen=True, kw_only=True):
    """A component that a triangle on the mechanism gives by hand."""

    drawn_in: ClassVar[str] = "right triangle"

    @abstractmethod
    def sides(self, canvas: Canvas | Measured) -> Iterator[Any]:
        """The sides of its triangle that must be long enough to be drawn."""

    def is_drawn(self, drawing: Drawing) -> bool:
        """Whether its triangle is drawn on a sheet."""
        return super().is_drawn(drawing) and not self.is_hidden(drawing)

    def reason(self, drawing: Drawing, role: str) -> str:
        """Why it is there, where no triangle is drawn that has reasons of its own."""
        if role == "vector" and not self.is_drawn(drawing):
            return self.laid_off_reason
        return super().reason(drawing, role)

    def room(self, canvas: Canvas | Measured) -> Any:
        """By how much its shortest side is longer than what is drawn at all, in mm."""
        return smaller(*(canvas.size(side) for side in self.sides(canvas))) - TINY

    def is_hidden(self, drawing: Drawing) -> bool:
        """Whether its triangle is not drawn, or too small to be."""
        return not self.is_whole(drawing.trace.values) or bool(self.room(Measured(drawing)) < 0)

    def is_whole(self, known: Container[int]) -> bool:
        """Whether all its steps are known."""
        return all(number in known for _, number in self.given())

    def corner_symbols(self, drawing: Drawing, *roles: str) -> dict[str, str]:
        """The symbols of its corners by their roles, as its sheet writes them."""
        steps = drawing.trace.program.steps
        names = {role: steps[getattr(self, role)].name for role in roles}
        return {role: symbol(names[role], self.letter(drawing, role)) for role in roles}

    @abstractmethod
    def corner_letter(self, role: str) -> str:
        """The letter of a corner without its index; nothing for what is no corner."""

    def letter(self, drawing: Drawing, role: str) -> str:
        """The letter of a corner: with its index only where another triangle has the same."""
        own, name = self.corner_letter(role), drawing.trace.program.steps[getattr(self, role)].name
        others = ((construction(step), step.role) for _, step in drawing.normals)
        alike = [
            kind
            for kind, other in others
            if isinstance(kind, TriangleComponent)
            and kind.corner_letter(other) == own
            and not kind.is_hidden(drawing)
        ]
        return own if len(alike) == 1 else name


class Measured(Struct, frozen=True):
    """The values of a sheet, and how long they are drawn."""

    drawing: Drawing

    def value(self, number: int) -> Any:
        """The value of a step."""
        return self.drawing.trace.values[number]

    def size(self, way: Any) -> Any:
        """How long a way of the mechanism is drawn, in mm."""
        return abs(way) * (1000 / self.drawing.scales.kL)


class LaidOff(EndsComponent, frozen=True, kw_only=True):
    """A component laid off in the plan from a known point, or back from the tip that it ends in."""

    gives: ClassVar[tuple[str, ...]] = ("corner",)
    pencil: ClassVar[Mapping[str, ByHand]] = {"corner": ByHand.LAID_OFF}

    component: Component
    start: int
    corner: int
    back: bool = False

    def reason(self, drawing: Drawing, role: str) -> str:
        """Why it is laid off as it is."""
        return self.component.laid_off_reason

    def symbols(self) -> Mapping[str, str]:
        """The letters of its component."""
        return self.component.symbols()

    def index_at(self, role: str) -> str:
        """The index of its component."""
        return self.component.index

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The component that it follows."""
        return (self.start,) if self.component.follows else ()

    def clause(self, drawing: Drawing, role: str) -> str:
        """What is said of it within the sentence of the point that is found from its end."""
        if self.is_short(drawing):
            return ""
        start = drawing.trace.program.steps[self.start]
        before = construction(start)
        if self.component.follows and isinstance(before, LaidOff) and before.is_short(drawing):
            start = drawing.trace.program.steps[before.start]
        key = self.component.laid_off_key
        key = f"lay-back-{key}" if self.back else f"lay-off-{key}" if key else "lay-off"
        fields = {**self.symbols(), "s": symbol(start.name)}
        return drawing.words(f"step.{key}", vector=self.segment(drawing, fields["s"]), **fields)

    def segment(self, drawing: Drawing, start: str) -> str:
        """Its component, after the segment from a point if its end has a letter of its own."""
        foot = symbol(letter_at(drawing, self.corner))
        if foot in ("", start):
            return self.component.symbol
        ends = (foot, start) if self.back else (start, foot)
        return EQUALS.join((NOTHING.join(ends), self.component.symbol))

    def sentence(self, drawing: Drawing) -> str:
        """What is said where it leads to a point that is known: what is left lies along a guide.

        Nothing where a line is drawn from its end: the point on that line tells of it.
        """
        steps = drawing.trace.program.steps
        users = [steps[user] for user in drawing.children.get(self.corner, ())]
        left = [user for user in users if sign_of(user) == "r"]
        if self.back or not left:
            return ""
        if not all(user.arrow or user.part is Part.RESULT for user in users):
            return ""
        end = symbol(steps[left[0].args[1]].name)
        fields = {"s": drawing.lettered(self.start), "r": symbol(left[0].name)}
        foot = symbol(letter_at(drawing, self.corner)) or fields["s"]
        vector = self.segment(drawing, fields["s"])
        return self.component.laid_alone(drawing, q=end, k=foot, c=vector, **fields)

    def is_short(self, drawing: Drawing) -> bool:
        """Whether it is laid off from a point with a name, and too short to be drawn."""
        steps = drawing.trace.program.steps
        if not steps[self.start].name:
            return False
        return drawn_between(drawing, self.start, self.corner, steps[self.corner].plane) < TINY


def laid_off(program: Program, number: int) -> LaidOff | None:
    """The component at whose end a step lies in the plan; None where it is the end of none."""
    kind = construction(program.steps[number])
    return kind if isinstance(kind, LaidOff) and kind.corner == number else None


def end_before(drawing: Drawing, number: int) -> int:
    """A step of a plan; where it is the end of a component too short to be drawn, where that is
    laid off."""
    laid = laid_off(drawing.trace.program, number)
    return laid.start if laid is not None and laid.is_short(drawing) else number


def index_before(program: Program, number: int) -> str:
    """The index of the component that ends in a point of a plan; nothing where none does."""
    kind = construction(program.steps[number])
    return kind.index_at(program.steps[number].role) if isinstance(kind, EndsComponent) else ""


def components(program: Program) -> Iterator[Component]:
    """The components of a program, each once, in the order of the work."""
    return (each for each in constructions(program, Construction) if isinstance(each, Component))


def component_of(program: Program, number: int) -> Component | None:
    """The component of whose vector a step holds the value; None for any other."""
    kind = construction(program.steps[number])
    return kind if isinstance(kind, Component) and kind.vector == number else None


def is_hidden(drawing: Drawing, number: int) -> bool:
    """Whether a step is part of a triangle on the mechanism that is too small to be drawn."""
    kind = construction(drawing.trace.program.steps[number])
    return isinstance(kind, TriangleComponent) and kind.is_hidden(drawing)


def components_on(drawing: Drawing) -> Iterator[Component]:
    """The components of a sheet, in the order of the work."""
    for number, _, _ in drawing.steps(Plane.NUMBERS):
        found = component_of(drawing.trace.program, number)
        if found is not None:
            yield found


def crowded_pins(drawing: Drawing, least: int) -> list[complex]:
    """Where at least so many figures of components stand at one pin of a sheet."""
    kinds = {id(step.of): step.of for _, step in drawing.normals}.values()
    pins = Counter(kind.stands_at(drawing) for kind in kinds if isinstance(kind, Component))
    return [
        drawing.trace.values[pin]
        for pin, count in pins.items()
        if pin is not None and count >= least
    ]


# --- drawn, or given by number -------------------------------------------------------------------


MANY = 13
"""So many triangles on one sheet lie upon one another: all of them are computed."""


def as_drawn(trace: Trace, *, triangles: bool) -> Trace:
    """A trace without the steps that only triangles need which give way, unless all are drawn."""
    crowded = has_many_triangles(trace)
    if triangles and not crowded:
        return trace
    steps, left = trace.program.steps, dict(trace.values)
    waiting = [
        c.read for c in components(trace.program) if c.read is not None and (crowded or c.gives_way)
    ]
    while waiting:
        number = waiting.pop()
        used = any(number in steps[other].args for other in left)
        if number in left and steps[number].hand and not used:
            del left[number]
            waiting += steps[number].args
    return Trace(trace.program, left, trace.margins)


def has_many_triangles(trace: Trace) -> bool:
    """Whether so many triangles would be drawn that none is."""
    return sum(c.read in trace.values for c in components(trace.program)) >= MANY


def may_give_way(program: Program) -> bool:
    """Whether a program has triangles that give way where they leave too little room."""
    return any(component.gives_way for component in components(program))
