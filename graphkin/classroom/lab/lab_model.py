"""What a lab states: its rule, its limits of fairness and its rubric, as plain records."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Literal

from msgspec import Struct, field

from graphkin.construction.core.plan_vector import PlanVector
from graphkin.mechanism import Mechanism
from graphkin.scene.quantity import Quantity
from graphkin.scene.read_scene import read_scene

NUMBER = "number"
"""The name under which a formula knows the student's number."""
What = Literal["segment", "value", "sense", "place"]


class Range(Struct, frozen=True):
    """From a least to a most, in steps counted from the least."""

    least: Fraction
    most: Fraction
    step: Fraction

    def __len__(self) -> int:
        """How many values there are."""
        return int((self.most - self.least) / self.step) + 1

    def value(self, index: int) -> Fraction:
        """The value of an index from nought."""
        return self.least + index * self.step


class ValueList(Struct, frozen=True):
    """Values of several ranges, in the order written; a single value is a range of one."""

    parts: tuple[Range, ...]

    def __len__(self) -> int:
        """How many values there are."""
        return sum(map(len, self.parts))

    def value(self, index: int) -> Fraction:
        """The value of an index from nought, counted on from range to range."""
        for part in self.parts:
            if index < len(part):
                return part.value(index)
            index -= len(part)
        raise IndexError(index)


class LabRule(Struct, frozen=True):
    """What gives each student other data.

    ``draws`` are ranges of parameters, from which a hash of course, lab and student picks; what is
    unfair is drawn again, at most ``tries`` times. ``settings`` gives parameters as expressions in
    ``number``; where nothing is drawn, the same number always gets the same data.
    """

    course: str = ""
    draws: Mapping[str, Range | ValueList] = {}
    tries: int = 100
    settings: Mapping[str, Quantity] = field(default_factory=dict)

    @property
    def counts(self) -> bool:
        """Whether each student needs a number."""
        return any(NUMBER in formula.uses() for formula in self.settings.values())

    @property
    def attempts(self) -> int:
        """How often a student's data are tried, at most: formulas give the same again."""
        return self.tries if self.draws else 1


class Fair(Struct, frozen=True):
    """What a variant must keep to be fair to its student.

    ``crossing``: the flattest angle of a crossing in degrees; ``segment``: the shortest length to
    be measured, in mm; ``triangle``: between which v/l a triangle can be drawn; ``apart``:
    the largest share of the points that another's right values may earn on the own sheet;
    ``pencil``: the largest error of a careful drawing in what earns points, in parts of the value.
    """

    crossing: float = 15.0
    segment: float = 3.0
    triangle: tuple[float, float] = (0.05, 4.0)
    apart: float | None = None
    pencil: float | None = None

    @property
    def needs_keys(self) -> bool:
        """Whether only the keys of variants tell that they keep all limits."""
        return self.apart is not None or self.pencil is not None


class Rubric(Struct, frozen=True):
    """What earns marks: points of each field of the form, and how they are given.

    ``follow`` is the share for what follows rightly from the student's own earlier values;
    ``slips`` the share for each slip by name; ``point`` and ``line`` the drawing error that is
    forgiven (mm, degrees); ``ruler`` the error of reading (mm); ``floor`` and ``cap`` the least
    and the most tolerance, in parts of the value. ``hold`` keeps back the marks of students whose
    answers seem to be another's, until the lecturer has decided.
    """

    points: Mapping[str, Fraction] = field(default_factory=dict)
    follow: float = 0.8
    slips: Mapping[str, float] = field(default_factory=dict)
    point: float = 0.5
    line: float = 0.5
    ruler: float = 0.25
    floor: float = 0.01
    cap: float = 0.25
    hold: bool = False


class Lab(Struct, frozen=True, dict=True):
    """A lab's folder, its scene as a file, and what ``lab.toml`` states.

    ``text`` is the very text of lab.toml, for the manifest's hash.
    """

    name: str
    folder: Path
    scene: Path
    rule: LabRule
    fair: Fair = Fair()
    rubric: Rubric = Rubric()
    text: str = ""

    @cached_property
    def mechanism(self) -> Mechanism:
        """The mechanism of its scene as that is written."""
        return self.variant({})

    def variant(self, settings: Mapping[str, Fraction]) -> Mechanism:
        """The mechanism with some exact data. Raises SceneError."""
        return Mechanism(read_scene(self.scene, settings))


class Item(Struct, frozen=True, dict=True):
    """One field of the form: what a student reads off or reckons.

    ``name`` is that of its quantity in files (v_D, omega_3, J_3), by which all fields of that are
    called (v_D_mm, v_D, omega_3, omega_3_sense, J_3_x_mm), with a ``tail`` where another has it;
    ``symbol`` its markup; ``unit`` in which it is asked (empty for a sense). ``of`` is the point or
    link, ``quantity`` the program's name of the quantity (velocity, omega, …). What is of an arrow
    of a plan has its ``vector``, a coordinate its ``axis``: x or y.
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
        """Its name in files."""
        return self.beside(self.what)

    def beside(self, what: What, axis: str = "") -> str:
        """The name of what another field asks of the same quantity."""
        ends = {"segment": "_mm", "sense": "_sense", "place": f"_{axis or self.axis}_mm"}
        return f"{self.name}{ends.get(what, '')}{self.tail}"

    def size(self, value: float) -> float:
        """A value as it is marked: the sizes of vectors and rates, whose senses are fields of their
        own, have no sign.
        """
        return abs(value) if self.what in ("segment", "value") else value

    def off(self, value: float, right: float) -> float:
        """How far a value, or each of an array, lies from the right one."""
        return self.size(value) - self.size(right)

    @cached_property
    def sized(self) -> str:
        """The field whose sense it is; itself where it is none."""
        return self.beside("value") if self.what == "sense" else self.field

    @cached_property
    def segment(self) -> str:
        """The field of the segment off which a value is read; empty for all that is no value."""
        return self.beside("segment") if self.what == "value" else ""
