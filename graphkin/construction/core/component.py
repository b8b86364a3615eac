"""Acceleration components that follow from velocities: found by triangles, then laid off."""

from __future__ import annotations

from abc import abstractmethod
from collections import Counter
from collections.abc import Container, Iterator, Mapping
from typing import Any, ClassVar, Protocol

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import (
    ByHand,
    Canvas,
    Construction,
    EndsComponent,
    Wording,
    construction,
    constructions,
)
from graphkin.construction.core.naming import TINY, drawn_between, is_short, letter_at, plan_amount
from graphkin.construction.core.palette import PaletteAction, Picks
from graphkin.construction.core.program import Effect, OwnStep, Part, Plane, Program, sign_of
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.run import Trace
from graphkin.numbers.arithmetic import smaller
from graphkin.scene.model import Scene
from graphkin.text import EQUALS, NOTHING, Markup


class Size(Struct, frozen=True):
    """A component computed from a student's own values, in SI.

    ``factors`` are the values it follows from; ``bar`` is the measured length (m), infinite where
    none is measured.
    """

    factors: tuple[Any, ...]
    size: float
    bar: float


class OwnSizes(Protocol):
    """A student's measurements in SI with their fields, or the answer key where there are none."""

    def vectors(self, tail: int, tip: int) -> Iterator[Any]:
        """Magnitudes of the vector between two images."""

    def turnings(self, rate: int) -> Iterator[Any]:
        """Angular velocities, by the step that finds them."""

    def turnings_over(self, ends: tuple[int, ...]) -> Iterator[Any]:
        """The student's angular velocities that are read off the same places and images."""

    def slidings(self, tail: int, tip: int) -> Iterator[Any]:
        """Velocities along a guide, by their ends in the plan."""

    def length(self, p: int, q: int) -> float:
        """The distance of two points in metres."""


class Component(Construction, frozen=True, kw_only=True):
    """A component of an acceleration, with its ``index`` and its ``vector``.

    ``vector`` is the step with the numerically stable value. ``read`` is the step that reads the
    same vector off a triangle on the mechanism; None where no triangle is drawn. ``palette`` is the
    page action that draws the component, if there is one. ``limited`` names the figure where its
    proportions decide whether it can be drawn.
    ``forgotten`` and ``turned`` are the keys of the sentences of a page for a student who goes on
    without it, or lays it off backwards.
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

    forgotten: ClassVar[str] = ""
    turned: ClassVar[str] = ""

    index: str
    vector: OwnStep | None = None
    read: OwnStep | None = None

    @property
    def name(self) -> str:
        """The name of the component: a, its index, its sign."""
        return f"a_{self.index}^{self.sign}"

    def symbol(self, drawing: Drawing) -> Markup:
        """Its symbol with the signs of a sheet."""
        return drawing.symbol(self.name)

    @classmethod
    def cause(cls, scene: Scene) -> str:
        """What in a scene causes this effect; empty where only the question does."""
        return ""

    @classmethod
    def absence(cls, scene: Scene) -> str:
        """What in a scene rules out this effect; empty where only the question does."""
        return ""

    # --- in words and figures --------------------------------------------------------------------

    def size(self, drawing: Drawing) -> float:
        """The magnitude of the component on a sheet, in m/s²."""
        assert self.vector is not None
        return float(abs(drawing.trace.values[self.vector]))

    def is_drawn(self, drawing: Drawing) -> bool:
        """Whether the triangle is drawn on a sheet and the component is long enough for it."""
        if self.read not in drawing.trace.values:
            return False
        return not is_short(drawing, self.size(drawing), drawing.plane)

    def is_left_out(self, drawing: Drawing) -> bool:
        """Whether the component is too short to be drawn in the plan, though not zero."""
        size = self.size(drawing)
        return bool(drawing.settled(size)) and is_short(drawing, size, drawing.plane)

    @abstractmethod
    def formula(self, drawing: Drawing) -> str:
        """The formula of the component, as markup."""

    def left_out(self, drawing: Drawing) -> str:
        """The text for a component too short to be drawn: its formula and its drawn length."""
        drawn = plan_amount(drawing, drawing.plane, self.size(drawing))
        return EQUALS.join((self.symbol(drawing), self.formula(drawing))) + f" ({drawn})"

    @abstractmethod
    def sentence(self, drawing: Drawing, *, first: bool) -> Wording:
        """The instruction to draw the component; in full if it is the ``first`` of its kind."""

    def parts_of_sentence(self, drawing: Drawing) -> Iterator[tuple[int, str]]:
        """The instruction for the component alone, in parts, each with the step that ends it."""
        assert self.vector is not None
        if self.is_left_out(drawing):
            yield self.vector, drawing.words("step.too-short", list=self.left_out(drawing))
        else:
            yield self.vector, self.sentence(drawing, first=True).markup

    def laid_alone(self, drawing: Drawing, **fields: str) -> str:
        """The sentence where only a vector along a guide remains after it; else empty."""
        return ""

    def stands_at(self, drawing: Drawing) -> int | None:
        """The pin's step where this figure is drawn if other figures are too; otherwise None."""
        return None

    def picked_from(self, picks: Picks) -> tuple[str | None, ...]:
        """The inputs of its palette action."""
        return ()

    def shown_between(self) -> tuple[int | None, ...]:
        """The steps of the two points between which it is drawn on the mechanism; or empty."""
        return ()

    @abstractmethod
    def section(self, drawing: Drawing) -> str:
        """The section of the calculation that holds its relation."""

    @abstractmethod
    def relation(self, drawing: Drawing) -> Relation:
        """The line of the component on the calculation page."""

    # --- marking students' work ------------------------------------------------------------------

    @abstractmethod
    def sizes(self, own: OwnSizes) -> Iterator[Size]:
        """The component by each relation that the student's values allow."""

    @abstractmethod
    def power_of(self, args: tuple[int, ...]) -> int:
        """The power of a rate or speed in the component; ``args`` are the steps of its reading."""

    def proportions(self, values: Mapping[int, Any], seconds: Any) -> Iterator[tuple[str, Any]]:
        """The ratio of its velocity to its bar, where that ratio decides whether it can be drawn.

        Each ratio comes with the symbol of the velocity, drawn as its displacement in ``seconds``.
        """
        yield from ()

    def as_measured(self, found: Mapping[int, Any], key: Mapping[int, Any]) -> Any:
        """The vector from a student's measured values; None where the construction gives it."""
        return None


class TriangleComponent(Component, frozen=True, kw_only=True):
    """A component that a triangle on the mechanism gives by hand."""

    drawn_in: ClassVar[str] = "right triangle"

    @abstractmethod
    def sides(self, canvas: Canvas | Measured) -> Iterator[Any]:
        """The sides of the triangle that must be long enough to be drawn."""

    def is_drawn(self, drawing: Drawing) -> bool:
        """Whether the triangle is drawn on a sheet."""
        return super().is_drawn(drawing) and not self.is_hidden(drawing)

    def reason(self, drawing: Drawing, role: str) -> str:
        """The reason for a step; for a vector without a triangle, why it is laid off."""
        if role == "vector" and not self.is_drawn(drawing):
            return self.laid_off_reason
        return super().reason(drawing, role)

    def room(self, canvas: Canvas | Measured) -> Any:
        """The excess of the shortest side over the smallest length that is drawn, in mm."""
        return smaller(*(canvas.size(side) for side in self.sides(canvas))) - TINY

    def is_hidden(self, drawing: Drawing) -> bool:
        """Whether the triangle is not drawn, or is too small to be drawn."""
        return not self.is_whole(drawing.trace.values) or bool(self.room(Measured(drawing)) < 0)

    def is_whole(self, known: Container[int]) -> bool:
        return all(number in known for _, number in self.given())

    def corner_symbols(self, drawing: Drawing, *roles: str) -> dict[str, str]:
        """The symbols of the triangle's corners by role, as the sheet writes them."""
        steps = drawing.trace.program.steps
        names = {role: steps[getattr(self, role)].name for role in roles}
        return {role: drawing.symbol(names[role], self.letter(drawing, role)) for role in roles}

    @abstractmethod
    def corner_letter(self, role: str) -> str:
        """The letter of a corner without its index; empty if the role is not a corner."""

    def letter(self, drawing: Drawing, role: str) -> str:
        """The letter of a corner, with its index only where another triangle has that letter."""
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
    """The values of a sheet and their drawn lengths."""

    drawing: Drawing

    def value(self, number: int) -> Any:
        return self.drawing.trace.values[number]

    def size(self, way: Any) -> Any:
        """The drawn length of a vector of the mechanism, in mm."""
        return abs(way) * (1000 / self.drawing.scales.kL)


class LaidOff(EndsComponent, frozen=True, kw_only=True):
    """A component laid off in the plan from a known point, or back from its own tip."""

    pencil: ClassVar[Mapping[str, ByHand]] = {"corner": ByHand.LAID_OFF}

    component: Component
    start: int
    corner: OwnStep
    back: bool = False

    def reason(self, drawing: Drawing, role: str) -> str:
        return self.component.laid_off_reason

    def symbols(self) -> Mapping[str, str]:
        return self.component.symbols()

    def index_at(self, role: str) -> str:
        return self.component.index

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The component after which this one is laid off."""
        return (self.start,) if self.component.follows else ()

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for this component within the sentence of the point found from its end."""
        if self.is_short(drawing):
            return ""
        start = drawing.trace.program.steps[self.start]
        before = construction(start)
        if self.component.follows and isinstance(before, LaidOff) and before.is_short(drawing):
            start = drawing.trace.program.steps[before.start]
        key = self.component.laid_off_key
        key = f"lay-back-{key}" if self.back else f"lay-off-{key}" if key else "lay-off"
        fields = {**self.symbols(), "s": drawing.symbol(start.name)}
        return drawing.words(f"step.{key}", vector=self.segment(drawing, fields["s"]), **fields)

    def segment(self, drawing: Drawing, start: str) -> str:
        """The symbol of the component, after its segment if the end has a letter of its own."""
        foot = drawing.symbol(letter_at(drawing, self.corner))
        if foot in ("", start):
            return self.component.symbol(drawing)
        ends = (foot, start) if self.back else (start, foot)
        return EQUALS.join((NOTHING.join(ends), self.component.symbol(drawing)))

    def sentence(self, drawing: Drawing) -> str:
        """The sentence where only a vector along a guide remains, to a point that is known.

        Empty where a line is drawn from its end: the sentence of the point on that line covers it.
        """
        steps = drawing.trace.program.steps
        users = [steps[user] for user in drawing.children.get(self.corner, ())]
        left = [user for user in users if sign_of(user) == "r"]
        if self.back or not left:
            return ""
        if not all(user.arrow or user.part is Part.RESULT for user in users):
            return ""
        end = drawing.symbol(steps[left[0].args[1]].name)
        fields = {"s": drawing.lettered(self.start), "r": drawing.symbol(left[0].name)}
        foot = drawing.symbol(letter_at(drawing, self.corner)) or fields["s"]
        vector = self.segment(drawing, fields["s"])
        return self.component.laid_alone(drawing, q=end, k=foot, c=vector, **fields)

    def is_short(self, drawing: Drawing) -> bool:
        """Whether the component is laid off from a named point and is too short to be drawn."""
        steps = drawing.trace.program.steps
        if not steps[self.start].name:
            return False
        return drawn_between(drawing, self.start, self.corner, steps[self.corner].plane) < TINY


def component_ending_at(program: Program, number: int) -> LaidOff | None:
    """The component whose end a step of the plan is; None where it ends no component."""
    kind = construction(program.steps[number])
    return kind if isinstance(kind, LaidOff) and kind.corner == number else None


def end_before(drawing: Drawing, number: int) -> int:
    """The start of the component that ends at a step and is too short to be drawn.

    For any other step, the step itself.
    """
    laid = component_ending_at(drawing.trace.program, number)
    return laid.start if laid is not None and laid.is_short(drawing) else number


def index_before(program: Program, number: int) -> str:
    """The index of the component that ends in a point of a plan; empty where none does."""
    kind = construction(program.steps[number])
    return kind.index_at(program.steps[number].role) if isinstance(kind, EndsComponent) else ""


def components(program: Program) -> Iterator[Component]:
    """The components of a program, each once, in the order of the work."""
    return (each for each in constructions(program, Construction) if isinstance(each, Component))


def component_of(program: Program, number: int) -> Component | None:
    """The component whose vector a step holds; None for any other step."""
    kind = construction(program.steps[number])
    return kind if isinstance(kind, Component) and kind.vector == number else None


def is_hidden(drawing: Drawing, number: int) -> bool:
    """Whether a step belongs to a triangle on the mechanism that is too small to be drawn."""
    kind = construction(drawing.trace.program.steps[number])
    return isinstance(kind, TriangleComponent) and kind.is_hidden(drawing)


def components_on(drawing: Drawing) -> Iterator[Component]:
    """The components of a sheet, in the order of the work."""
    for number, _, _ in drawing.steps(Plane.NUMBERS):
        found = component_of(drawing.trace.program, number)
        if found is not None:
            yield found


def crowded_pins(drawing: Drawing, least: int) -> list[complex]:
    """The pins of a sheet at which at least ``least`` figures of components are drawn."""
    kinds = {id(step.of): step.of for _, step in drawing.normals}.values()
    pins = Counter(kind.stands_at(drawing) for kind in kinds if isinstance(kind, Component))
    return [
        drawing.trace.values[pin]
        for pin, count in pins.items()
        if pin is not None and count >= least
    ]


# --- drawn, or given by number -------------------------------------------------------------------


MANY = 13
"""The number of triangles from which a sheet is too crowded; all of them are then computed."""


def as_drawn(trace: Trace, *, triangles: bool) -> Trace:
    """A trace without the steps that only omitted triangles need.

    The omitted triangles are those that give way, unless ``triangles`` asks for them; all are
    omitted on a crowded sheet.
    """
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
    """Whether there are too many triangles to draw any of them."""
    return sum(c.read in trace.values for c in components(trace.program)) >= MANY


def may_give_way(program: Program) -> bool:
    """Whether a program has triangles that are omitted where they leave too little room."""
    return any(component.gives_way for component in components(program))
