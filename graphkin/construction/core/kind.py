"""What every kind of construction has: the faces that pages, marking and reports ask for."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from typing import ClassVar, TypeVar

from msgspec import Struct
from msgspec.structs import asdict

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import Program, Roles, Step
from graphkin.construction.core.relation import Relation

K = TypeVar("K", bound=Roles)


class Construction(Roles, frozen=True):
    """One construction: its roles are fields, and beside them stands all that is known of it.

    ``reasons`` has the key of the reason behind a role's step, ``lines`` what its line is called,
    ``laid_off`` the roles of points that are laid off from another (``laid_from``),
    ``unmarked`` those of points that a pencil need not mark, ``directions`` those of unit vectors,
    ``slips`` by what a student's slip multiplies its result, ``drawn_in`` what a report calls the
    drawing of its crossings where that is not the plan's. ``joins`` are the roles of lines drawn as
    far as the points through which they lead. ``marked_as`` is the class of the circle by which the
    mechanism shows its point, where no mark of its own step does.

    ``told_after`` are the roles of the lines that are told before its step, ``between`` those of
    the names of the points that it joins: ``laid_at`` is the role of the step that lays off the
    distance of the first and the last, or half of it, as of two points that stand already, where
    it ``lays_half``. ``guided`` is the role of the block or wheel along whose
    guide its line lies, ``imaged`` are those of points marked in a plan with their letters,
    ``titled`` is what a report calls what it finds.
    """

    reasons: ClassVar[Mapping[str, str]] = {}
    lines: ClassVar[Mapping[str, str]] = {}
    laid_off: ClassVar[frozenset[str]] = frozenset()
    unmarked: ClassVar[frozenset[str]] = frozenset()
    directions: ClassVar[frozenset[str]] = frozenset()
    slips: ClassVar[Mapping[str, complex]] = {}
    drawn_in: ClassVar[str] = ""
    joins: ClassVar[frozenset[str]] = frozenset()
    marked_as: ClassVar[str] = ""
    told_after: ClassVar[tuple[str, ...]] = ()
    between: ClassVar[tuple[str, ...]] = ()
    laid_at: ClassVar[str] = ""
    lays_half: ClassVar[bool] = False
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

    def symbols_on(self, drawing: Drawing) -> Mapping[str, str]:
        """The same as a sheet writes them."""
        return self.symbols()

    def line_name(self, steps: Sequence[Step], role: str) -> str:
        """What a role's line is called in a report; nothing for other roles."""
        letters = {each: steps[number].name for each, number in self.given()}
        return self.lines.get(role, "").format_map({**asdict(self), **letters})

    @property
    def lies_along(self) -> str:
        """The bar, guide or track along which its line lies, in a report; nothing for others."""
        return f"the guide of {getattr(self, self.guided)}" if self.guided else ""

    @property
    def perpendicular_to(self) -> str:
        """The bar to which its line is perpendicular, in a report; nothing for others."""
        return ""

    @property
    def closes(self) -> tuple[str, ...]:
        """The links that it closes together; none for others."""
        return ()

    @property
    def found_link(self) -> str:
        """The link whose place it finds; nothing where it finds a point."""
        return ""

    def branch_words(self, drawing: Drawing) -> str:
        """Which of the ways in which its links close is meant, among what is given."""
        return ""

    @property
    def sought(self) -> str:
        """The point whose image it finds by crossing lines; nothing for others."""
        return ""

    @property
    def falls_on(self) -> int | None:
        """The step of the image on which its own falls whatever the motion; None for others."""
        return None

    @property
    def points(self) -> tuple[str, ...]:
        """The points of the mechanism that it joins."""
        return tuple(point for role in self.between if (point := getattr(self, role)))

    def laid_from(self, step: Step) -> int:
        """The point from which a step lays off: the first value that it takes."""
        return step.args[0]

    def laid_length(self, role: str) -> tuple[str, str] | None:
        """The points whose distance is laid off at a role's step; None for other roles."""
        return (self.points[0], self.points[-1]) if role == self.laid_at else None

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """What is said of a role's step that finds no point; nothing for other roles."""
        return ""

    def rate_relation(
        self, drawing: Drawing, link: str, tail: tuple[str, str, str]
    ) -> Relation | None:
        """How the rate of a link that it gives is found: with result, unit and sense at the end."""
        return None

    def rate_reason(self, drawing: Drawing) -> str:
        """The key of why a rate that it gives is found as it is."""
        return "why.rate"

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

    def sentence_parts(self, drawing: Drawing, role: str) -> Iterator[tuple[int, str]]:
        """What is said of a role's step part by part, each with the step that it ends with; nothing
        where it is said at once, or by its lines and ``point_apart``.
        """
        yield from ()

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The vector equations of a plan that the step of a role follows, if they are its own."""
        yield from ()

    def known_by(self, drawing: Drawing) -> str:
        """Direction and size of the vector that it finds, where these are known before."""
        return ""

    def rate_taken(self, drawing: Drawing, role: str) -> str:
        """The symbol of the rate of a sheet by which the vector of a role is computed."""
        return ""

    def source_of_rate(self, drawing: Drawing) -> str:
        """From what the rate is found that it gives, as is said where that is used first."""
        return ""

    def index_at(self, role: str) -> str:
        """The index of the relative acceleration that ends in a role's point; nothing for none."""
        return ""

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the step of a role."""
        if role in self.imaged:
            canvas.image()

    def is_whole(self, known: Container[int]) -> bool:
        """Whether its marks can be drawn from the steps that are known."""
        return True

    def is_hidden(self, drawing: Drawing) -> bool:
        """Whether it is too small on a sheet to be drawn."""
        return False


class PlanPole(Construction, frozen=True, kw_only=True):
    """The ``pole`` of a plan, chosen freely: the image of everything that stands still."""

    gives: ClassVar[tuple[str, ...]] = ("pole",)
    unmarked: ClassVar[frozenset[str]] = frozenset({"pole"})

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
    return kind.lies_along if kind is not None else ""


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
