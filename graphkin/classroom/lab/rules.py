"""Derives the data of each student from the rule of a lab, so that anyone can repeat it.

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

from msgspec.structs import replace

from graphkin.classroom.lab.lab_model import (
    NUMBER,
    Lab,
    LabRule,
    Range,
    SeveralValues,
    ValueList,
)
from graphkin.classroom.roster.student import Student
from graphkin.scene.model import Parameter
from graphkin.scene.parameters import out_of_range
from graphkin.scene.quantity import Quantity, shortest
from graphkin.text.errors import Problem, SceneError, message

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
            raise SceneError(Problem(place, wrong, message("different values")))
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
        raise SceneError(Problem("", message("has no number, and the lab's formula needs one")))
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
        raise SceneError(Problem(place, wrong))
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
