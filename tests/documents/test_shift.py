"""Law 1: what is drawn is a step. A step that moves takes with it exactly what follows from it."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

import pytest
from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.layout import Layout, lay_out
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.run import StepFailed, Trace, run
from graphkin.documents.sheet import left_board, right_board
from graphkin.documents.sheet_documents import targets_of
from graphkin.drawing.marks import CircleMark as Dot
from graphkin.drawing.marks import Mark, Text, numbers
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.plane import Circle, Line, Ratio, Vector, cross
from tests.documents.sheet_tools import KINDS, OTHERS, drawing_of, kind_of, named
from tests.mechanisms import SHIPPED

STEADY = 1e-7
"""What rounding may move, in mm."""
WAY = rect(1, 0.7331)
"""A direction that no line of the mechanisms has."""


def shifted(value: Any, size: float) -> Any:
    """A value a little elsewhere; ``size`` is in its own unit."""
    match value:
        case Line(point, along):
            return Line(point + size * WAY, along * rect(1, 0.03))
        case Circle(centre, radius):
            return Circle(centre + size * WAY, radius + 0.3 * size)
        case Vector(tail, tip):
            return Vector(tail + size * WAY, tip + 1j * size * WAY)
        case Ratio(start, shift, divisor):
            return Ratio(start + size * WAY, shift * rect(1.01, 0.03), divisor)
        case complex():
            return value + size * WAY
    return value * 1.01


def rerun(drawing: Drawing, number: int, size: float) -> Trace:
    """The trace of a drawing with one step's value shifted, all later ones following from it."""
    program, values = drawing.trace.program, drawing.scene.values

    def hook(here: int, _, value: Any) -> Any:
        return shifted(value, size) if here == number else value

    needed = sorted(drawing.trace.values)
    shares = [step for step in program.steps if step.action and step.action.key == "share"]
    tried = {place for step in shares for place in step.of.rates}
    overrides = {place: drawing.trace.values[place] for place in tried & set(needed)}
    overrides[program.seconds] = drawing.scales.seconds
    return run(program, needed, values, FLOAT, hook=hook, overrides=overrides)


Marks = Mapping[int | str, list[Mark]]


def marks_by_step(drawing: Drawing, layout: Layout) -> Marks:
    """The marks of both fields but for lettering, by their step; those without one by name."""
    found: dict[int | str, list[Mark]] = {}
    for board in (left_board, right_board):
        for mark in board(drawing, layout, "key").marks:
            if not isinstance(mark, Text):
                key = f"{kind_of(mark)} {mark.name}" if mark.step is None else mark.step
                found.setdefault(key, []).append(mark)
    return found


def moved(before: list[Mark], after: list[Mark]) -> bool:
    """True when marks are not all where they were."""
    if [type(mark) for mark in before] != [type(mark) for mark in after]:
        return True
    pairs = zip(before, after, strict=True)
    return any(
        abs(a - b) > STEADY
        for old, new in pairs
        for a, b in zip(numbers(old), numbers(new), strict=True)
    )


FOLLOWED = ("crank-slot", "oldham", "rapid-return", "gears-planet", "belts-arm")
"""Example scenes of which every step is followed."""
CASES = [(lab, n, kind) for lab in SHIPPED for n in (9,) for kind in KINDS]
CASES += [(name, None, kind) for name in OTHERS for kind in KINDS if name != "parallelogram"]
MORE = [(name, None, kind) for name in FOLLOWED for kind in KINDS]


class Moved(Struct, frozen=True):
    """A drawing, its marks by step, and both again after each step has been shifted."""

    drawing: Drawing
    before: Marks
    after: tuple[tuple[int, Trace, Marks], ...]


@cache
def all_moved(*which: Any) -> Moved:
    """Every step of a sheet shifted by about 2 mm, one after the other; done only once."""
    drawing = drawing_of(*which)
    layout = lay_out(drawing)
    after = [
        (number, trace, marks_by_step(replace(drawing, trace=trace), layout))
        for number, trace in shifts(drawing)
    ]
    return Moved(drawing, marks_by_step(drawing, layout), tuple(after))


@pytest.fixture(params=CASES, ids=named)
def case(request) -> Moved:
    return all_moved(*request.param)


@pytest.fixture(params=[*CASES, *MORE], ids=named)
def any_case(request) -> Moved:
    return all_moved(*request.param)


def shifts(drawing: Drawing) -> Iterator[tuple[int, Trace]]:
    """Every step, given ones left out, with the trace in which it is shifted by about 2 mm."""
    for number in drawing.trace.values:
        step = drawing.trace.program.steps[number]
        if step.given is not None or isinstance(drawing.trace.values[number], tuple):
            continue
        millimetres = 2.0
        while True:
            try:
                yield number, rerun(drawing, number, size_of(drawing, step.plane, millimetres))
                break
            except StepFailed:
                millimetres /= 4
                assert millimetres > 0.01, step


def size_of(drawing: Drawing, plane: Plane, millimetres: float) -> float:
    """A length of paper in the unit of a plane."""
    scales = drawing.scales
    factor = {Plane.VELOCITIES: scales.kv, Plane.ACCELERATIONS: scales.ka}.get(plane, scales.kL)
    return factor * millimetres / 1000


def idle_lines(drawing: Drawing) -> set[int]:
    """The lines of trials that are not drawn, for what they find falls on where they begin."""
    lines = {n for n in drawing.auxiliary if isinstance(drawing.trace.values[n], Line)}
    return {number for number in lines if drawing.auxiliary[number].is_idle(drawing, number)}


def appears(drawing: Drawing, trace: Trace, number: int) -> bool:
    """Whether a step is of a construction that only one of two traces draws."""
    made = construction(drawing.trace.program.steps[number])
    return made is not None and made.is_hidden(drawing) != made.is_hidden(
        replace(drawing, trace=trace)
    )


def test_shifting_any_step_moves_no_mark_but_those_of_its_descendants(any_case):
    """But for lines of a trial that begin and cross in one point, drawn once it moves, and for
    a construction that becomes too small to be drawn, or large enough."""
    drawing, before = any_case.drawing, any_case.before
    idle = idle_lines(drawing)
    for number, trace, after in any_case.after:
        family = drawing.trace.program.descendants(number) | idle
        strangers = {key for key in before.keys() | after.keys() if isinstance(key, int)} - family
        astray = [key for key in strangers if moved(before.get(key, []), after.get(key, []))]
        astray = [key for key in astray if not appears(drawing, trace, key)]
        assert not astray, (number, drawing.trace.program.steps[number], astray)


def test_shifting_any_step_moves_the_marks_of_every_descendant_whose_value_changes(any_case):
    drawing, before = any_case.drawing, any_case.before
    for number, trace, after in any_case.after:
        for key in drawing.trace.program.descendants(number) & before.keys():
            old, new = drawing.trace.values[key], trace.values.get(key)
            same = new is not None and alike(old, new)
            if not any(isinstance(mark, Dot) for mark in before[key]) and isinstance(old, Ratio):
                continue  # of a centre off its field only the direction is drawn
            assert moved(before[key], after.get(key, [])) or same, (number, key)


def test_all_that_follows_from_a_drawn_step_changes_with_it(case):
    """But for the pole, which takes its whole plan along, and for what a rocker keeps: the
    velocity of its pin has one line, and so has the normal through the instantaneous centre.
    """
    drawing, program = case.drawing, case.drawing.trace.program
    for number in (key for key in case.before if isinstance(key, int)):
        if program.steps[number].action.key == "pole":
            continue
        trace = rerun(drawing, number, size_of(drawing, program.steps[number].plane, 0.5))
        family = program.descendants(number) & drawing.trace.values.keys()
        kept = {k for k in family if alike(drawing.trace.values[k], trace.values[k])}
        assert all(program.steps[k].part is Part.CENTRE for k in kept), (number, kept)
        assert number not in kept


def alike(old: Any, new: Any) -> bool:
    """True for values that are the same but for rounding; a line may be told by any vector."""
    if isinstance(old, Line):
        turn = cross(old.along, new.along) / abs(old.along) / abs(new.along)
        return abs(turn) <= 1e-9 and alike(old.point, new.point)
    if isinstance(old, Ratio) and old.size and new.size:
        places = (ratio.start + ratio.shift / ratio.size for ratio in (old, new))
        return alike(*places)
    if isinstance(old, int | float | complex):
        return abs(old - new) <= 1e-9 * max(abs(old), abs(new), 1e-3)
    return all(alike(a, b) for a, b in zip(parts(old), parts(new), strict=True))


def parts(value: Any) -> tuple[Any, ...]:
    """The numbers of a line, circle, vector or ratio."""
    return tuple(getattr(value, name) for name in value.__match_args__)


def test_pins_and_links_follow_the_positions_of_their_points(case):
    drawing, before = case.drawing, case.before
    program, links = drawing.trace.program, drawing.scene.links
    for number, _, after in case.after:
        family = program.descendants(number)
        loose = {p for p in drawing.positions if program.targets["position", p] in family}
        for name in drawing.positions:
            assert moved(before[f"pin {name}"], after[f"pin {name}"]) == (name in loose), name
        for name, link in links.items():
            shapes = [f"{kind} {name}" for kind in ("link", "plate", "slider")]
            changed = any(moved(before.get(s, []), after.get(s, [])) for s in shapes)
            follows = bool(loose.intersection(link.points))
            assert changed == follows or (follows and len(link.points) > 2), (number, name)


def test_every_step_of_the_plan_and_of_what_is_asked_on_the_mechanism_is_drawn(any_case):
    drawing, shown = any_case.drawing, any_case.before
    corners = ("lay-off", "centripetal", "lay-back")
    trace = drawing.trace
    for number, step, value in drawing.steps(drawing.plane):
        corner = step.action.key in corners and not step.name
        nothing = step.arrow and not drawing.settled(abs(value.tip - value.tail))
        nothing = nothing or number in idle_lines(drawing)
        if not corner and not nothing and number not in drawing.results:
            assert number in shown, step
    for target in targets_of(Mechanism(drawing.scene), drawing.kind):
        if target[0] in ("centre", "pole"):
            assert trace.program.targets[target] in shown, target
