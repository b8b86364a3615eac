"""The drawing as a sequence of steps, each using only earlier steps.

The vectors of the plans and of the mechanism: the owner and the kind of each.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from typing import Any, ClassVar, Literal

from msgspec import Struct

from graphkin.construction.core.vocabulary import Action
from graphkin.numbers.arithmetic import Kind, at, pick

Effect = Literal[
    "laws of time",
    "data and shapes",
    "position",
    "rolling",
    "gears",
    "velocity",
    "rates of links and slides",
    "acceleration",
    "driver acceleration",
    "normal components",
    "tangential components",
    "Coriolis",
    "jerk",
    "instantaneous centres",
    "centrodes",
    "acceleration poles",
    "loads",
    "reactions and balance",
]
"""The purpose of a step in the motion, in the order of the work."""


class Part(Enum):
    """The part of the work to which a step belongs, in the order of the work."""

    SHAPE = "shape"
    POSITION = "position"
    VELOCITY = "velocity"
    NORMAL = "normal"
    ACCELERATION = "acceleration"
    CENTRE = "centre"
    POLE = "pole"
    RESULT = "result"
    FORCE = "force"


OF_PART: Mapping[Part, Effect] = {
    Part.SHAPE: "data and shapes",
    Part.POSITION: "position",
    Part.VELOCITY: "velocity",
    Part.NORMAL: "normal components",
    Part.ACCELERATION: "acceleration",
    Part.CENTRE: "instantaneous centres",
    Part.POLE: "acceleration poles",
    Part.RESULT: "rates of links and slides",
    Part.FORCE: "reactions and balance",
}
"""The effect of a step that names none itself."""


class Plane(Enum):
    """The drawing in which the value of a step lies; numbers lie in no drawing."""

    NUMBERS = "numbers"
    MECHANISM = "mechanism"
    VELOCITIES = "velocities"
    ACCELERATIONS = "accelerations"
    FORCES = "forces"
    LEVER = "lever"


CONSTANTS: Mapping[str, Any] = {"one": 1.0, "zero": 0.0, "origin": 0j, "ahead": 1 + 0j}
"""Values that need nothing from the scene; ahead is the direction of the x axis."""


class Given(Struct, frozen=True):
    """A value that the scene states: its quantities, and how they form a number or a point."""

    form: str
    quantities: tuple[Any, ...]

    def uses(self) -> frozenset[str]:
        """The names of the parameters on which the value depends."""
        return frozenset().union(*(quantity.uses() for quantity in self.quantities))

    def value(self, values: Mapping[str, Any], kind: Kind) -> Any:
        """The given value in SI, as a number of a kind."""
        if not self.quantities:
            return CONSTANTS[self.form]
        first = self.quantities[0]
        match self.form:
            case "direction":
                return first.direction(values, kind)
            case "point":
                return at(first.si(values, kind), self.quantities[1].si(values, kind))
            case "seconds":
                speed = abs(first.si(values, kind))
                return 1 / pick(speed == 0, 1.0, speed)
            case _:
                return first.si(values, kind)


OwnStep = int
"""The number of a step that a construction draws itself, in the field of its role."""


class Roles(Struct, frozen=True):
    """The steps of one construction by their roles: a record of step numbers.

    ``gives`` are the roles of the steps that it draws itself: its fields of the type OwnStep. A
    role that it does not use is None. The other numbers are the steps of its inputs. ``corners``
    are the roles of points on the mechanism that have no name but need room.
    """

    gives: ClassVar[tuple[str, ...]] = ()
    corners: ClassVar[frozenset[str]] = frozenset()

    def __init_subclass__(cls, **settings: Any) -> None:
        """Gather the roles of the steps that a kind draws itself."""
        super().__init_subclass__(**settings)
        own = [role for role, kind in cls.__annotations__.items() if kind.startswith("OwnStep")]
        if own:
            cls.gives = (*cls.gives, *own)

    def given(self) -> Iterator[tuple[str, int]]:
        """The role and the number of each of its own steps."""
        for role in self.gives:
            number = getattr(self, role)
            if number is not None:
                yield role, number

    def comes_along(self, role: str, found: Container[int]) -> bool:
        """Whether an arrow brings along the step of a role, once its inputs are there."""
        return False


class PlanAside:
    """An auxiliary plan next to the right one; its points' names end with the ``tag``."""

    tag: str


CLOSE = "close"
"""The action of a step that closes a group in several ways; values give the number."""


class Step(Struct, frozen=True):
    """One step: an action on earlier steps, or a given value.

    ``by_hand`` is the step that gives the same value by hand. ``hand`` marks steps that only the
    construction by hand uses, ``arrow`` those that are only drawn. ``name`` is the letter on the
    drawing. ``effect`` is the purpose of the step in the motion, None where its part of the work
    decides. ``of`` is its construction, ``role`` its role there, ``aside`` its auxiliary plan.
    """

    action: Action | None
    args: tuple[int, ...]
    part: Part
    plane: Plane
    name: str = ""
    extra: tuple[float, ...] = ()
    given: Given | None = None
    by_hand: int | None = None
    hand: bool = False
    arrow: bool = False
    effect: Effect | None = None
    of: Roles | None = None
    role: str = ""
    aside: PlanAside | None = None

    @property
    def closes(self) -> bool:
        """Whether the step closes a group of which several closures exist."""
        return self.action is not None and self.action.key == CLOSE

    @property
    def letter(self) -> str:
        """The letter without the tag of an auxiliary plan."""
        return self.name.removesuffix(self.aside.tag) if self.aside is not None else self.name


PLACES = ("axis", "guide", "track", "rolled")
"""Quantities for the poses of links and guides: the drawing needs them, no answer does."""
SPEEDS = "speeds"
"""The target for a link's point on the line of speeds."""


Target = tuple[str, str]
"""A wanted quantity ("velocity", "omega", …) and the point or link it belongs to."""


class Drive(Roles, frozen=True):
    """The steps that hold the given position, speed and acceleration of a ``driver`` (a number).

    The position is a direction (unit complex) for a turning driver, otherwise a length in metres.
    ``angle`` also holds the angle in radians; None where no wheel needs it.
    """

    driver: int
    position: OwnStep
    speed: OwnStep
    acceleration: OwnStep
    angle: OwnStep | None = None


class PairForce(Struct, frozen=True):
    """The force of one link of a pair on the other: the steps that hold it.

    ``name`` is that of the pair, ``links`` the link on which the force acts and the other one.
    ``block`` is the block or wheel of a guide or contact, None for a pin. ``about`` is the point
    about which the moment counts, None where it is zero, ``couple`` the couple of a guide.
    """

    name: str
    links: tuple[str, str]
    block: str | None
    force: int
    place: int
    about: int | None = None
    couple: int | None = None

    @property
    def steps(self) -> tuple[int, ...]:
        """The steps from which it follows."""
        every = (self.force, self.place, self.about, self.couple)
        return tuple(number for number in every if number is not None)


class DriverForce(Struct, frozen=True):
    """The balance of a driver on a ``link``: the step of its force or of its moment.

    ``sense`` is -1 where the link is not the driver's own.
    """

    driver: str
    link: str
    name: str
    step: int
    turns: bool
    sense: int


class Program(Struct, frozen=True):
    """Steps in drawing order, and the step that holds each quantity.

    ``seconds`` is the step that holds kL/kv, where velocities are set on the mechanism. ``drives``
    are the given motions, in the order of the scene's drivers. ``reactions`` and ``balances`` are
    those of a plan of forces.
    """

    steps: tuple[Step, ...]
    targets: Mapping[Target, int]
    seconds: int | None = None
    drives: tuple[Drive, ...] = ()
    reactions: tuple[PairForce, ...] = ()
    balances: tuple[DriverForce, ...] = ()

    @property
    def answers(self) -> tuple[Target, ...]:
        """The targets that are motions, centres and poles: everything that a scene can request."""
        return tuple(
            target
            for target, number in self.targets.items()
            if target[0] not in PLACES and self.steps[number].part is not Part.FORCE
        )

    def needed(self, targets: Iterable[Target], *, by_hand: bool = False) -> tuple[int, ...]:
        """The steps that the targets need, in order: the backward slice.

        With ``by_hand`` it includes the construction by hand of each composite step, and every
        arrow between points that are there.
        """
        found = self.behind((self.targets[target] for target in targets), by_hand=by_hand)
        return tuple(sorted({*found, *self._arrows({*found})})) if by_hand else found

    def behind(self, numbers: Iterable[int], *, by_hand: bool = False) -> tuple[int, ...]:
        """The steps that some steps need, themselves included, in order.

        With ``by_hand`` it includes the steps of the construction by hand.
        """
        wanted = {*numbers}
        for number in range(max(wanted, default=-1), -1, -1):
            if number not in wanted:
                continue
            step = self.steps[number]
            wanted.update(step.args)
            if by_hand and step.by_hand is not None:
                wanted.add(step.by_hand)
        return tuple(sorted(wanted))

    def also_found(
        self, targets: Iterable[Target], quantities: Sequence[str], without: Iterable[Target]
    ) -> list[Target]:
        """The targets of some quantities that ``targets`` need and ``without`` do not.

        Given values do not count.
        """
        needed = set(self.needed(targets)) - set(self.needed(without))
        needed -= {number for number in needed if not self.steps[number].args}
        mine = ((target, n) for target, n in self.targets.items() if target[0] in quantities)
        return [target for target, number in mine if number in needed]

    def _arrows(self, wanted: set[int]) -> set[int]:
        """The arrows whose ends are all there, with the steps that they bring along."""
        found = set(wanted)
        for number, step in enumerate(self.steps):
            if not step.arrow:
                continue
            along = {arg for arg in step.args if self._comes_along(arg, found)}
            if found.issuperset(set(step.args) - along):
                found |= {number, *along}
        return found - wanted

    def _comes_along(self, number: int, found: set[int]) -> bool:
        """Whether an arrow brings a step: a given value, or one that its construction allows."""
        step = self.steps[number]
        if step.of is None or not step.of.comes_along(step.role, found):
            return step.given is not None
        return found.issuperset(step.args)

    def descendants(self, number: int, among: Iterable[int] | None = None) -> frozenset[int]:
        """The steps that depend on a step, itself included; ``among`` limits them, in order."""
        found = {number}
        for later in range(number + 1, len(self.steps)) if among is None else among:
            if not found.isdisjoint(self.steps[later].args):
                found.add(later)
        return frozenset(found)


class PlanVector(Roles, frozen=True):
    """A velocity or acceleration, by ``letter`` and ``index``: of ``q``, about ``p`` if given.

    ``sign`` marks the components of an acceleration: ν, τ, c, r; it is empty for a whole vector.
    ``foot`` is the letter of the point where a component ends, or where it begins if it is laid
    ``back``. ``ends`` are the letters of both ends where no steps have them.
    """

    letter: str
    index: str
    q: str = ""
    p: str = ""
    sign: str = ""
    foot: str = ""
    back: bool = False
    ends: tuple[str, str] = ("", "")
    arrow: OwnStep | None = None

    @property
    def symbol(self) -> str:
        """The name of its symbol: v_BA, a_BA^ν."""
        return f"{self.letter}_{self.index}" + (f"^{self.sign}" if self.sign else "")


FEET = {"ν": "n", "c": "k"}
"""The letters of the feet of components, by their signs."""


def foot_of(sign: str, index: str) -> str:
    """The letter of the foot of a component; empty for a component that has none."""
    return f"{FEET[sign]}_{index}" if sign in FEET else ""


def plan_vector(step: Step) -> PlanVector | None:
    """The vector that a step draws; None for a step that draws none."""
    return step.of if isinstance(step.of, PlanVector) else None


def sign_of(step: Step) -> str:
    """The sign of the component that a step draws; empty for whole vectors and other steps."""
    vector = plan_vector(step)
    return vector.sign if vector else ""


def is_set_on(step: Step) -> bool:
    """Whether a step sets a vector of a plan on the mechanism."""
    return step.plane is Plane.MECHANISM and plan_vector(step) is not None
