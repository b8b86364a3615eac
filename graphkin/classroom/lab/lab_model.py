"""Plain records of what a lab states: its rule, its limits of fairness and its rubric.

The names of known causes, and how grave each is unless a lab says otherwise.

Derives the data of each student from the rule of a lab, so that anyone can repeat it.

A formula is evaluated exactly at the student's number; ``number mod 30`` is the remainder.

A value of a range is drawn by a separate hash for each parameter, so that adding a parameter
changes no other. The hash is SHA-256 over the UTF-8 bytes of the JSON list [course, lab, id,
attempt, parameter], written without spaces and with unescaped letters. The hash as an integer,
modulo the number of values, is the index of the value. Indices count from the least value; in a
list, they follow its order.

Several positions are picked without repetition: the hash for "p 2" instead of "p", modulo the
number of values that are left, is the index of the second among them. Picked values are then put
in order. The id is that of the class list.

Attempt 0 is the first; unfair data are drawn again with 1, 2, … In a shell::

    printf '%s' '["mechanics 2026","pump","0042",0,"n"]' | sha256sum
"""

from __future__ import annotations

import hashlib
import json
from bisect import insort
from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Literal

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.classroom.roster.students import Student
from graphkin.construction.core.program import PlanVector
from graphkin.construction.registry import SLIPS
from graphkin.mechanism import Mechanism
from graphkin.scene.house import PLAIN, House
from graphkin.scene.model import Parameter
from graphkin.scene.parameters import out_of_range
from graphkin.scene.quantity import Quantity, has_size, shortest, size_in_si
from graphkin.scene.read_scene import read_scene
from graphkin.text.errors import Problem, SceneError, message

SHARES = {"slight": 0.1, "moderate": 0.15, "serious": 0.2}
"""The share of all points that a cause costs, by its grade."""
ANOTHER = "data_of_another"
"""The cause that another student's data were drawn."""
GRADES: Mapping[str, str] = {
    "angle_clockwise": "slight",
    "other_scale_of_protractor": "slight",
    "driver_reversed": "slight",
    "diameter_for_radius": "slight",
    "radius_for_diameter": "slight",
    "plate_flipped": "slight",
    "letters_exchanged": "slight",
    "other_side": "slight",
    "rpm_as_rad": "moderate",
    "turns_as_rad": "moderate",
    "rad_as_rpm": "moderate",
    "degrees_as_radians": "moderate",
    "driver_acceleration_missing": "moderate",
    "parallel_for_perpendicular": "serious",
    **{name: slip.grade for name, slip in SLIPS.items()},
    "sense_reversed": "slight",
    "ruler_scale": "slight",
    "ruler_from_ten": "slight",
    "wrong_scale": "moderate",
    "own_scale": "slight",
    "scale_missing": "moderate",
    "drawn_in_full": "slight",
    "length_not_scaled": "moderate",
    "power_of_ten": "slight",
    "decimal_point_lost": "slight",
    "rate_in_degrees": "slight",
    "rate_in_turns": "slight",
    "swapped": "moderate",
    "normal_for_tangential": "serious",
    "whole_for_tangential": "moderate",
    "absolute_for_relative": "moderate",
    "ratio_inverted": "slight",
    "axes_swapped": "slight",
    "opposite": "slight",
    "answers_exchanged": "slight",
    ANOTHER: "serious",
}
"""The grade of each cause. Of equally good explanations, the first in this order is named."""
NAMES = tuple(GRADES)
"""All causes."""


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
    ``number``; where nothing is drawn, the same number always gets the same data. ``positions``
    gives each student several values of one parameter, each on its own sheet.
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
        if self.unit == "mm" or not has_size(self.unit):
            return 1.0
        return float(size_in_si(self.unit)[0])

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


Settings = dict[str, Fraction]
"""Exact values of parameters by name."""


def sheets(rule: LabRule, student: Student) -> list[Student]:
    """The entries of a student: one, or one for each position, with its number after the id."""
    if rule.positions is None:
        return [student]
    return [
        replace(student, id=f"{student.id}-{part}", owner=student.id, part=part)
        for part in range(1, len(rule.positions) + 1)
    ]


def settings(lab: Lab, student: Student, attempt: int = 0) -> Settings:
    """The exact data of one student; ``attempt`` is the number of earlier draws.

    Raises SceneError where a formula needs a number that is missing, or gives no rational value.
    """
    rule = lab.rule
    found = by_formula(rule, student)
    for name, values in rule.draws.items():
        found[name] = drawn(values, rule.course, lab.name, student.whose, attempt, name)
    if rule.positions is not None:
        several = own_values(lab, rule.positions, student, attempt)
        found[rule.positions.parameter] = several[max(student.part, 1) - 1]
    return found


def own_values(lab: Lab, several: SeveralValues, student: Student, attempt: int) -> list[Fraction]:
    """The values of a parameter that a student gets, one for each sheet.

    Drawn values are in order. Raises SceneError where a formula gives no rational value, or two of
    them the same.
    """
    if several.range is None:
        place = f"positions.{several.parameter}"
        found = [
            at_number(each, student, f"{place}[{i}]") for i, each in enumerate(several.formulas)
        ]
        twice = next((value for value in found if found.count(value) > 1), None)
        if twice is not None:
            wrong = message(
                "number {number} gets {value} twice", number=student.number, value=shortest(twice)
            )
            raise SceneError.at(place, wrong, message("different values"))
        return found
    places: list[int] = []
    for part in range(1, several.count + 1):
        name = f"{several.parameter} {part}"
        place_of_left = picked(lab.rule.course, lab.name, student.whose, attempt, name)
        index = place_of_left % (len(several.range) - len(places))
        for taken in places:
            index += taken <= index
        insort(places, index)
    return [several.range.value(index) for index in places]


def by_formula(rule: LabRule, student: Student) -> Settings:
    """The value of each formula at the student's number.

    Raises SceneError where the number is missing, or a value is not rational.
    """
    if rule.counts and student.number is None:
        raise SceneError.at("", message("has no number, and the lab's formula needs one"))
    return {
        name: at_number(formula, student, f"set.{name}") for name, formula in rule.settings.items()
    }


def at_number(formula: Quantity, student: Student, place: str) -> Fraction:
    """The value of a formula at the student's number. Raises SceneError if it is not rational."""
    value = formula.number({NUMBER: Fraction(student.number or 0)})
    if not isinstance(value, Fraction):
        wrong = message(
            "{text} gives {value} for number {number}, which is not rational",
            text=formula.text,
            value=shortest(value),
            number=student.number,
        )
        raise SceneError.at(place, wrong)
    return value


def drawn(
    values: Range | ValueList, course: str, lab: str, student: str, attempt: int, parameter: str
) -> Fraction:
    """The value of a range that the hash of all other arguments picks."""
    return values.value(picked(course, lab, student, attempt, parameter) % len(values))


def picked(course: str, lab: str, student: str, attempt: int, parameter: str) -> int:
    """The hash that picks a value, as an integer of 256 bits."""
    words = json.dumps(
        [course, lab, student, attempt, parameter], ensure_ascii=False, separators=(",", ":")
    )
    return int.from_bytes(hashlib.sha256(words.encode("utf-8")).digest(), "big")


def outside(parameters: Mapping[str, Parameter], given: Settings) -> list[Problem]:
    """The problems of data that the scene does not allow: out of range, or off the steps."""
    return [
        problem
        for name, value in given.items()
        for problem in out_of_range(parameters[name], value, name)
    ]


def exact_text(value: Fraction) -> str:
    """An exact number as text that a scene reads back unchanged: 44, 0.25, 1/3."""
    text = shortest(value)
    return text if Fraction(text) == value else f"{value.numerator}/{value.denominator}"
