"""Students at random: drawings with a pencil, read with a ruler, written down as they would be."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from math import isnan
from pathlib import Path
from typing import Any

import numpy as np
from msgspec.structs import replace

from graphkin.accuracy.pencil import STRAIGHT, Pencil
from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.standard import Standard, joint_drawings, standard
from graphkin.classroom.lab.items import items
from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.roster.students import Student, Taker
from tests.chosen import EVERY

LABS = ("pump", "slotted-lever", "offset-slider-crank", "pump-collinear")[: 4 if EVERY else 3]
"""Labs that are shipped; the last differs from the first by a plate in line."""
RULER = 0.25
"""Millimetres within which 95 of 100 readings lie."""
NO_POINTS: Mapping[str, Fraction] = {}


@lru_cache
def lab_of(name: str) -> Lab:
    """A shipped lab."""
    return read_lab(name)


@lru_cache
def book_of(name: str) -> Book:
    """What marks a shipped lab."""
    lab = lab_of(name)
    return Book(lab, lab.scene.read_text(encoding="utf-8"))


@lru_cache
def marker_of(name: str, n: int) -> Marker:
    """What marks the variant of a student's number."""
    return book_of(name).marker({"n": str(n)})


def marker_with(
    name: str,
    fields: tuple[str, ...],
    n: int = 7,
    points: Mapping[str, Fraction] = NO_POINTS,
    **changes: object,
) -> Marker:
    """A marker of a shipped lab whose rubric asks for more fields, or gives other ``points``."""
    lab = lab_of(name)
    every = {**lab.rubric.points, **dict.fromkeys(fields, Fraction(2)), **points}
    rubric = replace(lab.rubric, points=every, **changes)
    mechanism = book_of(name).mechanism({"n": str(n)})
    return Marker(standard(mechanism, items(mechanism, replace(lab, rubric=rubric)), rubric))


def taker(n: int = 7, who: str = "") -> Taker:
    """A student with a number."""
    return Taker(Student(n, who or f"s{n:03d}", n), {"n": str(n)})


def given(values: Mapping[str, float]) -> dict[str, Answer]:
    """Values as answers, just as they are."""
    return {field: Answer(repr(value), value) for field, value in values.items()}


def key_answers(standard: Standard) -> dict[str, Answer]:
    """The key as a student would hand it in."""
    return given({field: value for field, value in standard.key.items() if not isnan(value)})


def drawn(standard: Standard, pencil: float, count: int, seed: int) -> dict[str, Any]:
    """Each field as so many students read it off their drawings."""
    found = joint_drawings(standard.exact, Pencil(pencil), count, seed)
    reading = np.random.Generator(np.random.PCG64([seed, 10**6]))
    columns: dict[str, Any] = {}
    for probe in standard.layout.probes:
        value = np.broadcast_to(probe.read(found, standard.paper), count)
        if probe.item.what == "sense":
            value = np.sign(value)
        elif probe.item.unit == "mm":
            value = value + reading.normal(0, RULER / STRAIGHT, count)
        columns[probe.item.field] = value
    return columns


def row(columns: Mapping[str, Any], index: int) -> dict[str, Answer]:
    """The answers of one of them, to four digits."""
    values = {field: float(f"{column[index]:.4g}") for field, column in columns.items()}
    return given({field: value for field, value in values.items() if not isnan(value)})


def scene_of(name: str) -> Path:
    """The scene of a shipped lab."""
    return lab_of(name).scene
