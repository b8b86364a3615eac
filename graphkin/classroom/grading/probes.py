"""How a field of the form is read off a construction: a length, a rate, a sense, a coordinate."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from msgspec import Struct, structs

from graphkin.accuracy.pencil import Paper
from graphkin.classroom.lab.items import arrow_steps, is_of_travel, motion_of
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.kind import PlanPole, construction
from graphkin.construction.core.program import Part, Plane, Program, Step, Target
from graphkin.construction.core.quantities import BY_TARGET, FORCES
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import Ratio
from graphkin.scene.link_points import point_of
from graphkin.text.errors import NO_WORDS, Problem, SceneError, message


class Probe(Struct, frozen=True):
    """Reads one field: ``steps`` are the tail and tip of a vector, or the one step of a number.

    A place is read from the first fixed pivot; ``steps`` are the pivot's step and its own.
    ``plane`` is the drawing whose scale converts a length to millimetres.
    """

    item: Item
    steps: tuple[int, ...]
    plane: Plane
    vector: bool = False

    @property
    def step(self) -> int:
        """The step that carries the value."""
        return self.steps[-1]

    def read(self, found: Mapping[int, Any], paper: Paper) -> Any:
        """The value in the field's unit: the size of a vector, everything else with its sign.

        The result is an array where the construction holds arrays, and NaN where a step is missing.
        """
        if any(step not in found for step in self.steps):
            return float("nan")
        mm = paper.millimetre(self.plane)
        if self.item.what == "place":
            with np.errstate(all="ignore"):  # a centre at infinity is not a number
                way = (placed(found[self.steps[1]]) - found[self.steps[0]]) / mm
            return way.imag if self.item.axis == "y" else way.real
        size = found[self.step]
        size = abs(size - found[self.steps[0]]) if self.vector else size
        return size / mm if self.item.what == "segment" else size

    def error(self, found: Mapping[int, Any], paper: Paper, exact: Any) -> Any:
        """The errors of the value in some drawings; a size is compared without its sign."""
        return self.item.off(self.read(found, paper), exact)


def placed(value: Any) -> Any:
    """A centre as a point; NaN where it is at infinity."""
    if not isinstance(value, Ratio):
        return value
    if not hasattr(value.size, "shape") and value.size == 0:
        return complex("nan")
    return value.start + value.shift / value.size


def probes(mechanism: Mechanism, items: Iterable[Item]) -> tuple[Probe, ...]:
    """The probe of each item. Raises SceneError for all items that are not constructed."""
    found: list[Probe] = []
    problems: list[Problem] = []
    form = tuple(items)
    program = with_travel(mechanism.program, form)
    for item in form:
        probe = probe_of(mechanism, program, item)
        if probe is None:
            hint = message("graphkin solve shows what the construction has")
            problems.append(
                Problem(f"marks.{item.field}", message("is not constructed"), NO_WORDS, hint)
            )
        else:
            found.append(probe)
    if problems:
        raise SceneError(problems)
    return tuple(found)


def with_travel(program: Program, items: Iterable[Item]) -> Program:
    """The program with a step for each field that takes the whole motion.

    Such a step has no action: its value is found from the dead positions.
    """
    some = [(item.quantity, item.of) for item in items if is_of_travel(item)]
    if not some:
        return program
    first = len(program.steps)
    steps = (*program.steps, *(Step(None, (), Part.RESULT, Plane.NUMBERS) for _ in some))
    targets = {**program.targets, **{target: first + i for i, target in enumerate(some)}}
    return structs.replace(program, steps=steps, targets=targets)


def probe_of(mechanism: Mechanism, program: Program, item: Item) -> Probe | None:
    """The probe of one item; None where it is not constructed."""
    if item.what == "place":
        number = program.targets.get((item.quantity, item.of))
        pivot = program.targets[("position", mechanism.scene.frame.points[0])]
        return None if number is None else Probe(item, (pivot, number), Plane.MECHANISM)
    plane = plane_of(item)
    if plane is not None:
        ends = vector_ends(mechanism, item)
        return None if ends is None else Probe(item, ends, plane, vector=True)
    number = program.targets.get((item.quantity, item.of))
    return None if number is None else Probe(item, (number,), BY_TARGET[item.quantity].plane)


def plane_of(item: Item) -> Plane | None:
    """The plan with a field's vector; None where the field is no vector."""
    quantity = motion_of(item)
    return quantity.plane if quantity.sort == "vector" else None


def vector_ends(mechanism: Mechanism, item: Item) -> tuple[int, ...] | None:
    """The tail and tip of a vector; None where it is not constructed.

    The vector of a point starts at the pole, a force at the tail of its side. Any other vector is
    the arrow with its symbol.
    """
    program = mechanism.program
    if item.vector is not None:
        arrow = arrow_steps(program).get(item.of)
        return None if arrow is None else program.steps[arrow].args[:2]
    quantity = BY_TARGET[item.quantity]
    of = item.of if quantity in FORCES else point_of(mechanism.scene, item.of)
    target = (item.quantity, of)
    if target not in program.targets:
        return None
    if quantity in FORCES:
        return program.steps[program.targets[target]].args
    plane = quantity.plane
    on_plan = (n for n, step in enumerate(program.steps) if step.plane is plane)
    pole = next(n for n in on_plan if isinstance(construction(program.steps[n]), PlanPole))
    return pole, program.targets[target]


def targets_of(mechanism: Mechanism, items: Iterable[Item]) -> tuple[Target, ...]:
    """The targets that a construction needs for its items: all that is asked, and theirs."""
    wanted = dict.fromkeys(mechanism.asked())
    program = mechanism.program
    at_step = {number: target for target, number in program.targets.items()}
    for probe in probes(mechanism, items):
        if motion_of(probe.item) in FORCES:
            wanted[probe.item.quantity, probe.item.of] = None
        for step in probe.steps:
            if step in at_step:
                wanted[at_step[step]] = None
    return tuple(wanted)
