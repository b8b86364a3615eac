"""What every kind of construction has: the faces that pages, marking and reports ask for."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from typing import ClassVar, TypeVar

from msgspec import Struct
from msgspec.structs import asdict

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import Program, Roles, Step
from graphkin.construction.core.relation import Relation

K = TypeVar("K", bound=Roles)


class Run(Struct, frozen=True):
    """What a line lies along, or is ``square`` to, as a report calls it."""

    what: str
    square: bool = False


class ByHand(Enum):
    """How a hand makes a mark that is neither a point marked by itself nor a line."""

    LAID_OFF = "laid off from a point, along a line"
    TURNED = "a direction"
    KNOWN = "not made: the point is there already"


class Construction(Roles, frozen=True):
    """One construction: its roles are fields, and beside them is all that is known of it.

    For reports: ``titled`` is what is found, ``lines`` what a role's line is called, ``guided`` the
    role of the block or wheel along whose guide its line lies.

    For sheets: ``reasons`` has the key of the reason behind a role's step, ``told_after`` the roles
    of the lines that a sentence names before its step, ``between`` those of the names of the points
    that it joins, ``imaged`` those of points marked in a plan with their letters. ``laid_at`` is
    the role of the step that lays off the distance of the first and the last of these points.

    For pencils: ``pencil`` says how a hand makes the mark of a role, where it does not mark a
    point or draw a line.
    """

    reasons: ClassVar[Mapping[str, str]] = {}
    lines: ClassVar[Mapping[str, str]] = {}
    pencil: ClassVar[Mapping[str, ByHand]] = {}
    told_after: ClassVar[tuple[str, ...]] = ()
    between: ClassVar[tuple[str, ...]] = ()
    laid_at: ClassVar[str] = ""
    guided: ClassVar[str] = ""
    imaged: ClassVar[frozenset[str]] = frozenset()
    titled: ClassVar[str] = ""

    def reason(self, drawing: Drawing, role: str) -> str:
        """The key of the reason behind the step of a role; nothing where it needs none."""
        return self.reasons.get(role, "")

    def title(self, role: str) -> str:
        """What is found at a role's step, as a report calls it."""
        return self.titled.format_map(asdict(self)) if self.titled else ""

    def symbols(self) -> Mapping[str, str]:
        """The letters that reasons and names of lines speak of."""
        return {}

    def line_name(self, steps: Sequence[Step], role: str) -> str:
        """What a role's line is called in a report; nothing for other roles."""
        letters = {each: steps[number].name for each, number in self.given()}
        return self.lines.get(role, "").format_map({**asdict(self), **letters})

    @property
    def runs(self) -> Run | None:
        """How its line lies, in a report: along the guide of a block; None for others."""
        return Run(f"the guide of {getattr(self, self.guided)}") if self.guided else None

    @property
    def points(self) -> tuple[str, ...]:
        """The points of the mechanism that it joins."""
        return tuple(point for role in self.between if (point := getattr(self, role)))

    def laid_length(self, role: str) -> LaidLength | None:
        """The length that is laid off at a role's step; None for other roles."""
        return LaidLength(self.points[0], self.points[-1]) if role == self.laid_at else None

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """What is said of a role's step that finds no point; nothing for other roles."""
        return ""

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The steps of the lines that are told before the step of a role."""
        return tuple(getattr(self, each) for each in self.told_after)

    def clause(self, drawing: Drawing, role: str) -> str:
        """What is said of a role's line within the sentence of the point that it helps to find."""
        return ""

    def path_name(self, drawing: Drawing) -> str:
        """What the line is called on which something is guided; nothing for other lines."""
        return ""

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How the point of a role is found; nothing for other roles."""
        return ""

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The same after its lines have been told in sentences of their own; nothing where it is
        never told apart from them.
        """
        return ""

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The vector equations of a plan that the step of a role follows, if they are its own."""
        yield from ()

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the step of a role."""
        if role in self.imaged:
            canvas.image()


# --- faces that some kinds have -------------------------------------------------------------------


class LaidLength(Struct, frozen=True):
    """A length that a compass takes off: the distance of two points, or half of it."""

    first: str
    last: str
    half: bool = False


class ClosesGroup(Construction, frozen=True):
    """What closes a group of higher class: the links that it ``closes`` together."""

    @property
    def closes(self) -> tuple[str, ...]:
        """The links of the group."""
        return ()

    def branch_words(self, drawing: Drawing) -> str:
        """Which of the ways in which they close is meant, among what is given."""
        return ""


class PlacesLink(Construction, frozen=True):
    """What finds how a link lies, where it finds no point."""

    @property
    @abstractmethod
    def found_link(self) -> str:
        """The link; nothing where a point of it is found."""


class FindsImage(Construction, frozen=True):
    """What finds the image of a point by crossing lines."""

    @property
    @abstractmethod
    def sought(self) -> str:
        """The point; nothing where its place says nothing of it."""


class FallsOnImage(Construction, frozen=True):
    """The image of a point that has the motion of another: of a link that only shifts."""

    @property
    @abstractmethod
    def falls_on(self) -> int:
        """The step of the image on which its own falls whatever the motion."""


class GivesRate(Construction, frozen=True):
    """What finds how a link turns."""

    def rate_relation(
        self, drawing: Drawing, link: str, tail: tuple[str, str, str]
    ) -> Relation | None:
        """How the rate is found: with result, unit and sense at the end."""
        return None

    def rate_reason(self, drawing: Drawing) -> str:
        """The key of why the rate is found as it is."""
        return "why.rate"

    def source_of_rate(self, drawing: Drawing) -> str:
        """From what the rate is found, as the sentence says that uses it first."""
        return ""


class GivenVector(Construction, frozen=True):
    """A vector whose direction and size are known before the plan."""

    @abstractmethod
    def known_by(self, drawing: Drawing) -> str:
        """Direction and size; nothing where these are not known before."""

    @abstractmethod
    def rate_taken(self, drawing: Drawing, role: str) -> str:
        """The symbol of the rate of a sheet by which the vector of a role is computed."""


class EndsComponent(Construction, frozen=True):
    """What lays off a component of a relative acceleration."""

    @abstractmethod
    def index_at(self, role: str) -> str:
        """The index of the component that ends in a role's point; nothing for other roles."""


class SaidInParts(Construction, frozen=True):
    """What is said of a step part by part."""

    @abstractmethod
    def sentence_parts(self, drawing: Drawing, role: str) -> Iterator[tuple[int, str]]:
        """The parts, each with the step that it ends with; none where it is said at once."""


class JoinsPoints(Construction, frozen=True):
    """What draws lines as far as the points through which they lead: ``joins`` are their roles."""

    joins: ClassVar[frozenset[str]]


class PlanPole(Construction, frozen=True, kw_only=True):
    """The ``pole`` of a plan, chosen freely: the image of everything that stands still."""

    gives: ClassVar[tuple[str, ...]] = ("pole",)
    pencil: ClassVar[Mapping[str, ByHand]] = {"pole": ByHand.KNOWN}

    pole: int

    def marks(self, canvas: Canvas, role: str) -> None:
        """The point, larger than those of images."""
        canvas.pole()


def construction(step: Step) -> Construction | None:
    """The construction that a step is part of; None for a step by itself."""
    return step.of if isinstance(step.of, Construction) else None


def lies_along(step: Step) -> str:
    """The guide, track or bar along which a line lies, in a report; nothing for other steps."""
    kind = construction(step)
    runs = kind.runs if kind is not None else None
    return runs.what if runs is not None and not runs.square else ""


def constructions(program: Program, kind: type[K]) -> Iterator[K]:
    """The constructions of a kind in a program, each once, in the order of the work."""
    found = {id(step.of): step.of for step in program.steps}
    return (each for each in found.values() if isinstance(each, kind))


# --- what is said of them -------------------------------------------------------------------------


class Sentence(Struct, frozen=True):
    """A sentence of the construction with the number of the step that it ends with.

    ``steps`` are all the steps that it speaks of, where it stands for several sentences;
    ``link`` is the idle link that it is of. ``reasons`` are keys of why, each empty where the
    construction of the step says it.
    """

    step: int
    name: str
    markup: str
    steps: tuple[int, ...] = ()
    link: str = ""
    reasons: tuple[str, ...] = ()

    @property
    def all_steps(self) -> tuple[int, ...]:
        """The steps that it speaks of; none where it speaks of no single one."""
        return self.steps or ((self.step,) if self.step >= 0 else ())


class Wording(Struct, frozen=True):
    """What a component says of itself: the kind of the sentence, and its markup."""

    kind: str
    markup: str


def in_one(some: Sequence[Sentence], name: str, markup: str) -> Sentence:
    """Several sentences said in one."""
    steps = tuple(n for said in some for n in said.all_steps)
    return Sentence(some[-1].step, name, markup, steps)


def together(found: list[Sentence], some: Sequence[Sentence], markup: str) -> list[Sentence]:
    """Several sentences said in one, at the place of the first of them."""
    place = found.index(some[0])
    kept = [said for said in found if said not in some]
    return [*kept[:place], in_one(some, some[-1].name, markup), *kept[place:]]
