"""Plain records of what a lab states: its rule, its limits of fairness and its rubric."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Literal

from msgspec import Struct, field

from graphkin.classroom.lab.cause_names import GRADES, SHARES
from graphkin.construction.core.plan_vector import PlanVector
from graphkin.mechanism import Mechanism
from graphkin.scene.house import PLAIN, House
from graphkin.scene.quantity import LENGTHS, Quantity
from graphkin.scene.read_scene import read_scene

NUMBER = "number"
"""The name of the student's number in a formula."""
What = Literal["segment", "value", "sense", "place"]


class Range(Struct, frozen=True):
    """Values from a least to a most, in steps counted from the least."""

    least: Fraction
    most: Fraction
    step: Fraction

    def __len__(self) -> int:
        return int((self.most - self.least) / self.step) + 1

    def value(self, index: int) -> Fraction:
        """The value at an index, counted from zero."""
        return self.least + index * self.step


class ValueList(Struct, frozen=True):
    """Values of several ranges, in the order written; a single value is a range of one."""

    parts: tuple[Range, ...]

    def __len__(self) -> int:
        return sum(map(len, self.parts))

    def value(self, index: int) -> Fraction:
        """The value at an index, counted from zero through all ranges."""
        for part in self.parts:
            if index < len(part):
                return part.value(index)
            index -= len(part)
        raise IndexError(index)


class SeveralValues(Struct, frozen=True):
    """The values of a parameter that each student gets, on a sheet of its own each.

    They are ``formulas`` in ``number``, or ``count`` different values of a range that a hash picks.
    """

    parameter: str
    formulas: tuple[Quantity, ...] = ()
    range: Range | None = None
    count: int = 0

    def __len__(self) -> int:
        return len(self.formulas) or self.count


class LabRule(Struct, frozen=True):
    """The rule that gives each student's data.

    ``draws`` are ranges of parameters, from which a hash of course, lab and student picks. Unfair
    data are drawn again, at most ``tries`` times. ``settings`` gives parameters as expressions in
    ``number``; where nothing is drawn, the same number always gets the same data. ``positions`` are
    the values of a parameter of which each student gets several.
    """

    course: str = ""
    draws: Mapping[str, Range | ValueList] = {}
    tries: int = 100
    settings: Mapping[str, Quantity] = field(default_factory=dict)
    positions: SeveralValues | None = None

    @property
    def is_drawn(self) -> bool:
        """Whether a hash picks some of the data."""
        return bool(self.draws) or (self.positions is not None and bool(self.positions.count))

    @property
    def counts(self) -> bool:
        """Whether each student needs a number."""
        several = self.positions.formulas if self.positions is not None else ()
        return any(NUMBER in each.uses() for each in (*self.settings.values(), *several))

    @property
    def attempts(self) -> int:
        """The most attempts at a student's data. Formulas give the same again, so they have one."""
        return self.tries if self.is_drawn else 1


class Fair(Struct, frozen=True):
    """The limits that a variant must keep to be fair to its student.

    ``crossing`` is the smallest angle of a crossing, in degrees. ``segment`` is the shortest length
    to measure, in mm. ``triangle`` is the range of v/l in which a triangle can be drawn. ``apart``
    is the largest share of the points that another student's right values may earn. ``pencil`` is
    the largest error of a careful drawing in what earns points, relative to the value.
    """

    crossing: float = 15.0
    segment: float = 3.0
    triangle: tuple[float, float] = (0.05, 4.0)
    apart: float | None = None
    pencil: float | None = None

    @property
    def needs_keys(self) -> bool:
        """Whether some limits need the keys of variants."""
        return self.apart is not None or self.pencil is not None


class OwnCause(Struct, frozen=True):
    """A mistake that a lab names: the data as a student took them, by formulas in the parameters.

    ``cost`` is a grade or a share of all points. ``said`` has its sentence in each language.
    """

    name: str
    settings: Mapping[str, Quantity]
    cost: float | str
    said: Mapping[str, str]


class Rubric(Struct, frozen=True):
    """The points of each field of the form, and how they are given.

    ``follow`` is the share for what follows correctly from the student's own earlier values.
    ``causes`` has the share of all points that a cause costs by name, where the lab states one.
    ``own`` are causes of this lab alone, by name.
    ``grades`` has the shares of slight, moderate and serious causes.

    ``point`` and ``line`` are the forgiven drawing errors, in mm and degrees. ``ruler`` is the
    reading error, in mm. ``floor`` and ``cap`` are the least and the largest tolerance, relative to
    the value.

    ``digits`` are the fewest and the most significant digits of a value, where the lab wants some.
    ``rounded`` is the share for a value that is right but for its digits.

    ``hold`` keeps back the marks of students whose answers seem to be another's, until the lecturer
    has decided. ``says_right`` lets the task page say when a drawn point is right.
    """

    points: Mapping[str, Fraction] = field(default_factory=dict)
    follow: float = 0.8
    causes: Mapping[str, float | str] = field(default_factory=dict)
    grades: Mapping[str, float] = field(default_factory=lambda: dict(SHARES))
    point: float = 0.5
    line: float = 0.5
    ruler: float = 0.25
    floor: float = 0.01
    cap: float = 0.25
    hold: bool = False
    says_right: bool = False
    own: Mapping[str, OwnCause] = field(default_factory=dict)
    digits: tuple[int, int] | None = None
    rounded: float = 0.8

    def cost(self, cause: str) -> float:
        """The share of all points that a cause costs."""
        own = self.own.get(cause)
        stated = own.cost if own else self.causes.get(cause, GRADES.get(cause, "moderate"))
        return self.grades[stated] if isinstance(stated, str) else stated


class Lab(Struct, frozen=True, dict=True):
    """A lab: its folder, its scene file, and what ``lab.toml`` states.

    ``text`` is the exact text of lab.toml, for the manifest's hash. ``house`` are the conventions
    of its school.
    """

    name: str
    folder: Path
    scene: Path
    rule: LabRule
    fair: Fair = Fair()
    rubric: Rubric = Rubric()
    text: str = ""
    house: House = PLAIN

    @cached_property
    def mechanism(self) -> Mechanism:
        """The mechanism of its scene, with the scene's own values."""
        return self.variant({})

    def variant(self, settings: Mapping[str, Fraction]) -> Mechanism:
        """The mechanism with some exact data. Raises SceneError."""
        return Mechanism(read_scene(self.scene, settings, self.house))


class Item(Struct, frozen=True, dict=True):
    """One field of the form, which a student reads off or computes.

    ``name`` is the name of its quantity in files: v_D, omega_3, J_3. All fields of the quantity
    start with it: v_D_mm, v_D, omega_3, omega_3_sense, J_3_x_mm. A ``tail`` is added where another
    quantity has the name.

    ``symbol`` is markup. ``unit`` is that of the answer, empty for a sense. ``of`` is the point or
    link; ``quantity`` is the program's name of the quantity, such as velocity or omega. A field of
    an arrow of a plan has a ``vector``; a coordinate has an ``axis``, x or y.
    """

    name: str
    what: What
    symbol: str
    unit: str
    quantity: str
    of: str
    vector: PlanVector | None = None
    axis: str = ""
    tail: str = ""

    @cached_property
    def field(self) -> str:
        """The name of the field in files."""
        return self.beside(self.what)

    @cached_property
    def one(self) -> float:
        """One of its unit as it is marked: in SI, but lengths on paper in mm."""
        length, per, _ = self.unit.partition("/")
        return float(LENGTHS[length]) if per and length in LENGTHS else 1.0

    def beside(self, what: What, axis: str = "") -> str:
        """The name of another field of the same quantity."""
        ends = {"segment": "_mm", "sense": "_sense", "place": f"_{axis or self.axis}_mm"}
        return f"{self.name}{ends.get(what, '')}{self.tail}"

    def size(self, value: float) -> float:
        """A value as it is marked.

        The sizes of vectors and rates have no sign, since their senses are fields of their own.
        """
        return abs(value) if self.what in ("segment", "value") else value

    def off(self, value: float, right: float) -> float:
        """The difference between a value, or each value of an array, and the right one."""
        return self.size(value) - self.size(right)

    @cached_property
    def sized(self) -> str:
        """For a sense, the field of its value; otherwise the field itself."""
        return self.beside("value") if self.what == "sense" else self.field

    @cached_property
    def segment(self) -> str:
        """The field of the segment from which a value is read; empty for any other field."""
        return self.beside("segment") if self.what == "value" else ""
