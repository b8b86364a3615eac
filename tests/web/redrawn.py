"""The fields of a sheet drawn anew by Python at another place of the driver, at the same scales.

The construction runs step by step on floats there; nothing of it is shared with a page but the
steps themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import hypot, inf, radians, sqrt
from typing import Any

import numpy as np
from msgspec.structs import replace

from graphkin.construction.core.layout import Layout, spans
from graphkin.construction.core.program import Program, Step
from graphkin.construction.core.run import StepFailed, Trace, run
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.construction.higher_class.trial_rates import followed_rates
from graphkin.documents.sheet import left_board, right_board
from graphkin.drawing.field import Field
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Text
from graphkin.drawing.style import BRIEF
from graphkin.mechanism import Mechanism
from graphkin.motion.course import Course
from graphkin.motion.pieces import Path, reachable_ranges
from graphkin.motion.sweep import names, sweep_of
from graphkin.numbers.arithmetic import FLOAT
from graphkin.scene.model import Closure
from graphkin.web.field_binder import room_of
from graphkin.web.page_driver import PageDriver
from graphkin.web.screen_sheets import ScreenSheet

CLOSURES = range(1, 9)
"""The closures of a group of class III that are tried."""
PAGE = 420.0
"""How long a page is, in mm."""
Fields = tuple[list[Mark], list[Mark]]


def redrawn(
    mechanism: Mechanism, driven: PageDriver, sheet: ScreenSheet, x: float, program: Program
) -> Fields:
    """The marks of both fields of a sheet, but for labels, at a place of the driver, where they
    stand on the side that is chosen on the sheet."""
    scene, drawn = mechanism.scene, sheet.drawing.trace.values
    sweep = sweep_of(scene)
    place = x * driven.metres
    values = sweep.values(np.array([place]))
    overrides: dict[int, Any] = {}
    for n, (driver, drive) in enumerate(zip(scene.drivers, program.drives, strict=True), 1):
        if names(n)[0] not in values:
            continue
        at, speed, push = (float(np.ravel(values[name])[0]) for name in names(n))
        overrides |= {drive.speed: speed, drive.acceleration: push}
        overrides[drive.position] = FLOAT.direction(at) if driver.kind == "turn" else at
        if drive.angle is not None:
            overrides[drive.angle] = radians(at)
    if program.seconds is not None and program.seconds in drawn:
        overrides[program.seconds] = drawn[program.seconds]
    overrides = {n: value for n, value in overrides.items() if n in drawn}

    def ran(rates: Mapping[int, Any]) -> Trace:
        return run(program, sorted(drawn), scene.values, FLOAT, overrides={**overrides, **rates})

    chosen = {n: rate for n, rate in mechanism.trial_rates.items() if n in drawn}
    trace = ran(followed_rates(program, drawn, chosen, lambda rates: ran(rates).values))
    standing = Course(sweep, scene.branches).standing(place)
    here = replace(sheet.drawing, scene=standing, trace=trace, chosen=sheet.drawing)
    fields = Layout(roomy(sheet.layout.mechanism), roomy(sheet.layout.plan), {})
    layout = Layout(fields.mechanism, fields.plan, spans(here, fields))
    boards = left_board(here, layout, "key"), right_board(here, layout, "key")
    left, right = ([m for m in board.marks if not isinstance(m, Text)] for board in boards)
    return left, right


def roomy(field: Field) -> Field:
    """A field with all the room that it can grow to, lines' ends and centres included."""
    return replace(field, rect=room_of(field.rect))


def redrawn_near(
    mechanism: Mechanism,
    driven: PageDriver,
    sheet: ScreenSheet,
    x: float,
    pins: Mapping[str, Sequence[float]],
) -> Fields:
    """The same in the closure of a group of class III whose pins stand nearest to given ones.

    So is the side of points of which a cycle tells none, for bars keep their links parallel.
    """
    program, found = taken_at(mechanism, driven, sheet, x), list[Fields]()
    closing = next((n for n, step in enumerate(program.steps) if is_closing(step)), None)
    if closing is None:
        ways = [program, *without_a_side(program, mechanism)]
        found = [redrawn(mechanism, driven, sheet, x, way) for way in ways]
        return min(found, key=lambda fields: farthest(fields[0], pins))
    for number in CLOSURES:
        try:
            here = in_closure(program, closing, number)
            found.append(redrawn(mechanism, driven, sheet, x, here))
        except StepFailed:
            continue
    return min(found, key=lambda fields: farthest(fields[0], pins), default=([], []))


PATHS: dict[int, tuple[Mechanism, Path]] = {}
"""The ways of mechanisms by their identities, with what holds these."""


def path_of(mechanism: Mechanism) -> Path:
    """The ranges of the driver of a mechanism, found once."""
    key = id(mechanism)
    if key not in PATHS:
        PATHS[key] = mechanism, reachable_ranges(sweep_of(mechanism.scene))
    return PATHS[key][1]


def taken_at(mechanism: Mechanism, driven: PageDriver, sheet: ScreenSheet, x: float) -> Program:
    """The steps with the sides that the motion takes beyond its change points, as a cycle says."""
    drawn, scene, place = sheet.drawing.trace.program, mechanism.scene, x * driven.metres
    path = path_of(mechanism)
    turns = (-2, -1, 0, 1, 2) if path.whole else (0,)
    taken = (p.branches for k in turns for p in path.ranges[0] if p.holds(place + k * path.period))
    own = {name: each for name, each in next(taken, {}).items() if not isinstance(each, Closure)}
    other = Mechanism(replace(scene, branches={**scene.branches, **own})).program
    return other if len(other.steps) == len(drawn.steps) and own else drawn


def without_a_side(program: Program, mechanism: Mechanism) -> Iterator[Program]:
    """The steps with the points at their other crossing whose side no part of a cycle tells."""
    told_of = {name for piece in path_of(mechanism).ranges[0] for name in piece.branches}
    for name in {*mechanism.scene.branches} - told_of:
        over = [
            replace(step, extra=(-step.extra[0],))
            if step.name == name and step.extra in ((1,), (-1,))
            else step
            for step in program.steps
        ]
        yield replace(program, steps=tuple(over))


def is_closing(step: Step) -> bool:
    """Whether a step closes a group of class III."""
    return closer_of(step) is not None


def in_closure(program: Program, closing: int, number: int) -> Program:
    """The same steps, of which one closes its group in the closure of a number."""
    step = program.steps[closing]
    assert step.action is not None
    action = replace(step.action, value=replace(step.action.value, number=number))
    steps = (*program.steps[:closing], replace(step, action=action), *program.steps[closing + 1 :])
    return replace(program, steps=steps)


def farthest(left: Sequence[Mark], pins: Mapping[str, Sequence[float]]) -> float:
    """How far the pins of a field stand from given ones, at most."""
    here = {m.name: m for m in left if isinstance(m, CircleMark) and m.cls == "pin"}
    return max((hypot(m.cx - pins[n][0], m.cy - pins[n][1]) for n, m in here.items()), default=inf)


def numbers(mark: Mark) -> list[float]:
    """What places a mark: the ends of lines, corners, middles; of an arc what its path has: start,
    both radii, whether it is more than half a turn, whether it goes clockwise, end."""
    if isinstance(mark, LineMark):
        return [mark.x1, mark.y1, mark.x2, mark.y2]
    if isinstance(mark, CircleMark):
        return [mark.cx, mark.cy]
    if isinstance(mark, Arc):
        large, clockwise = float(abs(mark.end - mark.start) > 180), float(mark.end < mark.start)
        return [*mark.at(mark.start), mark.r, mark.r, large, clockwise, *mark.at(mark.end)]
    assert not isinstance(mark, Text)
    return [number for point in mark.points for number in point]


def kind_of(mark: Mark) -> tuple[str, str, str, int | None]:
    """What tells a mark from others of its sheet, where it may stand, a vector long or short."""
    return type(mark).__name__, mark.cls.removesuffix(f" {BRIEF}"), mark.name, mark.step


def apart(one: Sequence[float], other: Sequence[float]) -> float:
    """How far two marks of a kind lie apart, in mm; infinite where one has more corners."""
    if len(one) != len(other):
        return inf
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def off_by(cls: str) -> Callable[[Sequence[float], Sequence[float]], float]:
    """What tells how far marks of a class lie apart."""
    if cls in ("plate", "outline"):
        return around_apart
    return {"ground": strokes_apart, "ray": rays_apart}.get(cls, apart)


def around_apart(one: Sequence[float], other: Sequence[float]) -> float:
    """The same of two polygons, whose corners may be counted from any one."""
    turned = (apart([*one[i:], *one[:i]], other) for i in range(0, len(one), 2))
    return min(turned, default=0.0)


def rays_apart(one: Sequence[float], other: Sequence[float]) -> float:
    """The same of two rays; of those that leave the page only their carriers are told apart, for a
    point at infinity lies both ways."""
    (start, end), (first, last) = places(one), places(other)
    if min(abs(end - start), abs(last - first)) < PAGE:
        return apart(one, other)
    along = (last - first) / abs(last - first)
    return float(max(abs(((at - first) * along.conjugate()).imag) for at in (start, end)))


def strokes_apart(one: Sequence[float], other: Sequence[float]) -> float:
    """The same of two strokes of a hatching, which stays with what bears it while its guide is
    drawn from another end: how far they lie across the guide, and how far from parallel."""
    (start, end), (first, last) = places(one), places(other)
    way, along = (each / abs(each) for each in (end - start, last - first))
    across = ((start - first) * (along * (-1 - 1j) / sqrt(2)).conjugate()).imag
    return float(max(abs(across), abs(way - along)))


def places(at: Sequence[float]) -> Any:
    """The corners of a mark as complex numbers."""
    return np.array(at[::2]) + 1j * np.array(at[1::2])
