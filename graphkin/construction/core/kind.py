"""The base class of all constructions: what pages, marking and reports ask of them."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from enum import Enum
from typing import Any, ClassVar, TypeVar

from msgspec import Struct
from msgspec.structs import asdict

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.palette import ErrorPicks, KnownError
from graphkin.construction.core.program import OwnStep, PlanAside, Program, Roles, Step
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vocabulary import Action
from graphkin.numbers.plane import Ratio
from graphkin.text.errors import message

K = TypeVar("K", bound=Roles)


class Run(Struct, frozen=True):
    """The direction of a line in a report: along ``what``, or perpendicular to it if ``square``."""

    what: str
    square: bool = False


class ByHand(Enum):
    """How a mark is made by hand, where it is neither a marked point nor a line."""

    LAID_OFF = "laid off from a point, along a line"
    TURNED = "a direction"
    KNOWN = "not made: the point is there already"


Taken = Callable[[Any, Any, Callable[[int], Any]], Any]
"""A result as a student has it, from its construction, its right value, and other steps' values."""


class Slip(Struct, frozen=True):
    """A common mistake in a construction: the ``factor`` by which it multiplies a result.

    ``grade`` says how grave it is: slight, moderate or serious. ``roles`` are those of the results
    with the mistake, drawn by ``action`` if one is given. ``taken`` gives the value of such a
    result as a student has it, from its construction and its right value, and from the values of
    other steps. It replaces the factor.
    """

    factor: complex
    grade: str
    roles: tuple[str, ...] = ("vector", "found")
    action: Action | None = None
    taken: Taken | None = None

    def meets(self, step: Step) -> bool:
        """Whether a step of the construction is a result with the mistake."""
        return step.role in self.roles and self.action in (None, step.action)

    def value(self, kind: Any, value: Any, get: Callable[[int], Any]) -> Any:
        """The value of a result as a student with the mistake has it."""
        if self.taken is not None:
            return self.taken(kind, value, get)
        if isinstance(value, Ratio):
            return value._replace(shift=self.factor * value.shift)
        return self.factor * value


class Construction(Roles, frozen=True):
    """One construction: the steps of its roles are its fields.

    For reports: ``titled`` says what is found, and ``lines`` names the line of a role. ``guided``
    is the role of the block or wheel along whose guide its line lies.

    For sheets: ``reasons`` holds the key of the reason for a role's step. ``lines_before`` lists
    the roles of the lines that a sentence names before its step. ``between`` lists the roles of the
    names of the points that it joins. ``imaged`` lists the roles of points marked with their
    letters in a plan. ``laid_at`` is the role of the step that lays off the distance of the first
    and the last of the joined points.

    For drawing by hand: ``pencil`` says how the mark of a role is made, where it is neither a
    marked point nor a line. ``slips`` are common mistakes of students in it.
    """

    reasons: ClassVar[Mapping[str, str]] = {}
    lines: ClassVar[Mapping[str, str]] = {}
    pencil: ClassVar[Mapping[str, ByHand]] = {}
    slips: ClassVar[Mapping[str, Slip]] = {}
    lines_before: ClassVar[tuple[str, ...]] = ()
    between: ClassVar[tuple[str, ...]] = ()
    laid_at: ClassVar[str] = ""
    guided: ClassVar[str] = ""
    imaged: ClassVar[frozenset[str]] = frozenset()
    titled: ClassVar[str] = ""

    def reason(self, drawing: Drawing, role: str) -> str:
        """The key of the reason for the step of a role; empty where it needs none."""
        return self.reasons.get(role, "")

    def title(self, role: str) -> str:
        """What is found at the step of a role, as a report calls it."""
        return self.titled.format_map(asdict(self)) if self.titled else ""

    def symbols(self) -> Mapping[str, str]:
        """The letters used in reasons and in names of lines."""
        return {}

    def line_name(self, steps: Sequence[Step], role: str) -> str:
        """The name of a role's line in a report; empty for other roles."""
        letters = {each: steps[number].name for each, number in self.given()}
        return self.lines.get(role, "").format_map({**asdict(self), **letters})

    @property
    def runs(self) -> Run | None:
        """The direction of its line in a report: along the guide of a block; None for others."""
        if not self.guided:
            return None
        return Run(message("the guide of {block}", block=getattr(self, self.guided)))

    @property
    def points(self) -> tuple[str, ...]:
        """The points of the mechanism that it joins."""
        return tuple(point for role in self.between if (point := getattr(self, role)))

    def laid_length(self, role: str) -> LaidLength | None:
        """The length laid off at the step of a role; None for other roles."""
        return LaidLength(self.points[0], self.points[-1]) if role == self.laid_at else None

    def vector_to(self, role: str) -> str:
        """The vector that ends at the point of a role, or lies on its line; empty for others."""
        return ""

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The sentence for a role's step that finds no point; empty for other roles."""
        return ""

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The steps of the lines that the text names before the step of a role."""
        return tuple(getattr(self, each) for each in self.lines_before)

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for a role's line within the sentence of the point that it helps to find."""
        return ""

    def path_name(self, drawing: Drawing) -> str:
        """The name of the line on which something is guided; empty for other lines."""
        return ""

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence that says how the point of a role is found; empty for other roles."""
        return ""

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The sentence for a point whose lines already have sentences of their own.

        Empty where the lines never have them.
        """
        return ""

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The vector equations of a plan, or of a centre, that belong to the step of a role."""
        yield from ()

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """The wrong moves that students make in place of those that draw its steps."""
        yield from ()

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the step of a role."""
        if role in self.imaged:
            canvas.image()


# --- interfaces of some kinds of constructions ---------------------------------------------------


class LaidLength(Struct, frozen=True):
    """A length taken with the compass: the distance of two points, or half of it."""

    first: str
    last: str
    half: bool = False


class ClosesGroup(Construction, frozen=True):
    """A construction that closes a group of higher class: the links that it ``closes`` together."""

    @property
    def closes(self) -> tuple[str, ...]:
        """The links of the group."""
        return ()

    def branch_words(self, drawing: Drawing) -> str:
        """The sentence among the given data for the chosen closure."""
        return ""


class PlacesLink(Construction, frozen=True):
    """A construction that finds the orientation of a link, but no point of it."""

    @property
    @abstractmethod
    def found_link(self) -> str:
        """The link; empty where a point of the link is found."""


class FindsImage(Construction, frozen=True):
    """A construction that finds the image of a point where lines cross."""

    @property
    @abstractmethod
    def sought(self) -> str:
        """The point whose image is found; empty where similarity finds the image."""


class FallsOnImage(Construction, frozen=True):
    """The image of a point that moves as another does, on a link that only translates."""

    @property
    @abstractmethod
    def falls_on(self) -> int:
        """The step of the image with which its own always coincides."""


class GivesRate(Construction, frozen=True):
    """A construction that finds the angular velocity or acceleration of a link."""

    def rate_relation(
        self, drawing: Drawing, link: str, tail: tuple[str, str, str]
    ) -> Relation | None:
        """The relation that gives the rate, with result, unit and sense at its end."""
        return None

    def rate_reason(self, drawing: Drawing) -> str:
        """The key of the reason why the rate is found in this way."""
        return "why.rate"

    def source_of_rate(self, drawing: Drawing) -> str:
        """The source of the rate, for the sentence that uses it first."""
        return ""


class GivenVector(Construction, frozen=True):
    """A vector whose direction and magnitude are known before the plan."""

    @abstractmethod
    def known_by(self, drawing: Drawing) -> str:
        """The direction and the magnitude; empty where these are not known before."""

    @abstractmethod
    def rate_taken(self, drawing: Drawing, role: str) -> str:
        """The symbol of the rate from which the vector of a role is computed."""


class EndsComponent(Construction, frozen=True):
    """A construction that lays off a component of a relative acceleration."""

    @abstractmethod
    def index_at(self, role: str) -> str:
        """The index of the component that ends in a role's point; empty for other roles."""


class SaidInParts(Construction, frozen=True):
    """A construction whose step is described in several parts."""

    @abstractmethod
    def sentence_parts(self, drawing: Drawing, role: str) -> Iterator[tuple[int, str]]:
        """The parts, each with the step that ends it; none where one sentence suffices."""


class JoinsPoints(Construction, frozen=True):
    """A construction with lines as far as the points they pass through; ``joins`` are its roles."""

    joins: ClassVar[frozenset[str]]


class PlanPole(Construction, frozen=True, kw_only=True):
    """The freely chosen ``pole`` of a plan: the image of everything at rest."""

    pencil: ClassVar[Mapping[str, ByHand]] = {"pole": ByHand.KNOWN}

    pole: OwnStep

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the pole, larger than an image."""
        canvas.pole()


def construction(step: Step) -> Construction | None:
    """The construction to which a step belongs; None for a single step."""
    return step.of if isinstance(step.of, Construction) else None


def lies_along(step: Step) -> str:
    """The guide, track or bar along which a line lies, in a report; empty for other steps."""
    kind = construction(step)
    runs = kind.runs if kind is not None else None
    return runs.what if runs is not None and not runs.square else ""


def constructions(program: Program, kind: type[K]) -> Iterator[K]:
    """The constructions of one kind in a program, each once, in the order of the work."""
    found = {id(step.of): step.of for step in program.steps}
    return (each for each in found.values() if isinstance(each, kind))


# --- sentences -----------------------------------------------------------------------------------


class Sentence(Struct, frozen=True):
    """A sentence of the construction with the number of its last step.

    ``steps`` are all its steps, where it joins several sentences. ``link`` is the idle link that it
    is about. ``reasons`` are the keys of its reasons; a key is empty where the construction of the
    step gives the reason.
    """

    step: int
    name: str
    markup: str
    steps: tuple[int, ...] = ()
    link: str = ""
    reasons: tuple[str, ...] = ()

    @property
    def all_steps(self) -> tuple[int, ...]:
        """All steps of the sentence; none where it is about no single step."""
        return self.steps or ((self.step,) if self.step >= 0 else ())


class Wording(Struct, frozen=True):
    """The sentence of a component: its kind and its markup."""

    kind: str
    markup: str


def in_one(some: Sequence[Sentence], name: str, markup: str) -> Sentence:
    """Several sentences merged into one."""
    steps = tuple(n for said in some for n in said.all_steps)
    return Sentence(some[-1].step, name, markup, steps)


def together(found: list[Sentence], some: Sequence[Sentence], markup: str) -> list[Sentence]:
    """The list with several sentences merged into one, at the place of the first of them."""
    place = found.index(some[0])
    kept = [said for said in found if said not in some]
    return [*kept[:place], in_one(some, some[-1].name, markup), *kept[place:]]


# --- auxiliary plans, drawn only to find the right plan ------------------------------------------


class AuxiliaryPlan(PlanAside):
    """A plan drawn only to find the right plan."""

    @property
    def repeats(self) -> bool:
        """Whether this plan repeats the lines of another plan, without equations of its own."""
        return False

    def reason(self, name: str) -> str:
        """The key of the reason for this plan, for its opening sentence; otherwise empty."""
        return ""

    def turned_by(self, rate: int) -> str:
        """The link whose rate is assumed at a step; empty where no rate is assumed there."""
        return ""

    def is_idle(self, drawing: Drawing, number: int) -> bool:
        """Whether a line only finds points that coincide with the point where it begins."""
        return False

    def begins(self, drawing: Drawing, named: Sequence[int]) -> bool:
        """Whether these are the points with which this plan begins."""
        return False

    def parts_of_sentence(
        self, drawing: Drawing, named: Sequence[int]
    ) -> Iterator[tuple[int, int, str]]:
        """The points of this plan by line: step of the point, last step of the part, sentence."""
        yield from ()

    def introduced(self, drawing: Drawing, how: str, *, first: bool) -> str:
        """The sentence ``how`` of a part, after a phrase that names this plan.

        For the ``first`` part the phrase also states what the plan assumes.
        """
        return how

    def falls_on(self, drawing: Drawing, number: int) -> str:
        """The point that coincides with a point of this plan and all its sources; else empty."""
        return ""

    def sentences(self, drawing: Drawing, number: int) -> Iterator[Sentence]:
        """The sentences that go with one step of this plan."""
        yield from ()

    def marks(self, canvas: Canvas, number: int) -> None:
        """Draw one step of this plan."""


def auxiliary_plan(drawing: Drawing, number: int) -> AuxiliaryPlan | None:
    """The auxiliary plan that alone uses a step; None where there is no such plan."""
    plan = drawing.auxiliary.get(number)
    return plan if isinstance(plan, AuxiliaryPlan) else None


def falls_on_sources(drawing: Drawing, number: int) -> bool:
    """Whether a point of an auxiliary plan coincides with all the points that it is drawn from."""
    plan = auxiliary_plan(drawing, number)
    return plan is not None and bool(plan.falls_on(drawing, number))
