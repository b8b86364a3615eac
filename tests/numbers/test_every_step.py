"""Every step of the vocabulary in every number kind: within its bound, and of its type."""

from __future__ import annotations

import inspect
import random
from fractions import Fraction
from functools import cache
from importlib import import_module
from pkgutil import walk_packages
from typing import Any

import pytest

from graphkin import construction
from graphkin.construction.core.program import Given, Part, Plane, Program, Step
from graphkin.construction.core.vocabulary import Action
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.kinds import decimal_kind
from graphkin.numbers.plane import Circle, Line, Ratio, Vector
from tests.numbers import number_kinds as nk

ROOM = "graphkin.construction."
MODULES = [import_module(found.name) for found in walk_packages(construction.__path__, ROOM)]
STEPS = {
    f"{room.__name__.rpartition('.')[2]}.{name}": value
    for room in MODULES
    for name, value in vars(room).items()
    if isinstance(value, Action) and value.value.__module__ == room.__name__
}
"""Every action, once, under its module and name."""
DRAWS = 4
TRIALS = 200
ROUNDINGS = 16
"""Rounding units of a value's size and condition that a step may lose."""
NARROW = 200
"""The same for the radius of a ball."""
MADE = {"Line": (Line, 2, "pp"), "Circle": (Circle, 2, "pr"), "Ratio": (Ratio, 3, "ppr")}
"""How what a step takes is put together: of points (p) and positive numbers (r)."""
PARTS = {Line: 2, Circle: 2, Ratio: 3, Vector: 2}
EXTRA = {"way": 1, "side": -1, "sense": -1, "place": 1, "size": 1.0, "inside": 1, "ring": 1}
EXTRA["slant"] = 0.36
"""What a step is told beside its arguments."""
MANY = {f"higher.{name}": ("rrpp", (2,)) for name in ("reach", "span")} | {
    f"cam_centre.{name}": ("rrrr", (-1.0, 3.0, 4.0))
    for laws in (("lift", "lift_rate", "lift_bend"), ("plate_lift", "plate_rate", "plate_bend"))
    for name in laws
}
MANY |= {
    f"cam_centre.{name}": ("rrrrrrrr", (-1.0,))
    for name in ("table_lift", "table_rate", "table_bend")
}
MANY["two_trials.pace"] = ("rrr", (2,))
MANY["loads.by_table"] = ("rrr", (0.5, 1.5, 4.0, 9.0))
MANY["lever.lever_rate"] = ("ppppr", (2,))
MANY["lever.lever_balance"] = ("ppppr", (2,))
MANY |= {
    f"moments.{name}": ("ppppr", (2,))
    for name in ("tangential_part", "balancing_moment", "place_by_moments", "left_couple")
}
MANY["line_force.slide_pressure"] = ("pprppr", (1, 1, 3))
MANY["line_force.line_force"] = ("ppr", (1,))
MANY["line_force.tooth_force"] = ("ppr", (1, 0.36))
MANY["line_force.strand_force"] = ("ppr", (1, 1.0, 1.0))
"""What steps take any number of, and what these are told; two points where nothing is said."""


class Builder:
    """Writes a program of one step, from single numbers and points to single numbers and points."""

    def __init__(self) -> None:
        self.steps: list[Step] = []
        self.shapes: dict[int, str] = {}

    def put(self, action: Action | None, args: tuple[int, ...] = (), extra: Any = ()) -> int:
        given = Given("one", ()) if action is None else None
        self.steps.append(Step(action, args, Part.RESULT, Plane.NUMBERS, extra=extra, given=given))
        return len(self.steps) - 1

    def leaf(self, shape: str) -> int:
        number = self.put(None)
        self.shapes[number] = shape
        return number

    def made(self, annotation: str) -> int:
        if annotation in MADE:
            of, _, shapes = MADE[annotation]
            return self.put(Action("made", of), tuple(self.leaf(shape) for shape in shapes))
        if annotation.startswith("tuple"):
            return self.put(Action("made", lambda *v: v), tuple(self.leaf("r") for _ in range(3)))
        return self.leaf({"Point": "p", "Real": "r"}[annotation])


@cache
def built(name: str) -> tuple[nk.Work, dict[int, str]]:
    """The program of a step, and the shapes of what enters it."""
    action, builder = STEPS[name], Builder()
    args: list[int] = []
    extra: list[Any] = []
    for parameter in inspect.signature(action.value).parameters.values():
        if parameter.kind is parameter.VAR_POSITIONAL:
            many, told = MANY.get(name, ("pp", ()))
            args += [builder.leaf(shape) for shape in many]
            extra += told
        elif parameter.annotation in ("int", "float"):
            extra.append(EXTRA[parameter.name])
        else:
            assert not extra, "what a step is told comes last"
            args.append(builder.made(parameter.annotation))
    step = builder.put(action, tuple(args), tuple(extra))
    probe = sample(builder.shapes, random.Random(name))
    wanted = [step]
    for _ in range(TRIALS):
        work = nk.Work(Program(tuple(builder.steps), {}), (step,), {})
        found = nk.drawn(work, FLOAT, probe)
        if found is not None:
            count = PARTS.get(type(found[0]), 0)
            places = [Action("of", lambda value, k: value[k])] * count
            wanted = [builder.put(get, (step,), (k,)) for k, get in enumerate(places)] or wanted
            break
        probe = sample(builder.shapes, random.Random(str(probe)))
    else:
        pytest.fail("no place was found where the step can be drawn")
    return nk.Work(Program(tuple(builder.steps), {}), tuple(wanted), {}), builder.shapes


def sample(shapes: dict[int, str], chance: random.Random) -> dict[int, tuple[Fraction, ...]]:
    """Numbers between 0.2 and 1.2, points within a unit of the origin, all of three digits.

    No two numbers are equal: their difference would be zero, and its square more narrow than that.
    """
    found: dict[int, tuple[Fraction, ...]] = {}
    for number, shape in shapes.items():
        if shape == "r":
            size = None
            while size is None or size in found.values():
                size = (Fraction(chance.randint(200, 1200), 1000),)
            found[number] = size
        else:
            found[number] = tuple(Fraction(chance.randint(-1000, 1000), 1000) for _ in "xy")
    return found


@cache
def cases(name: str) -> list[tuple[dict[int, tuple[Fraction, ...]], list[Any], list[float]]]:
    """Inputs, reference and conditions where the step can be drawn."""
    work, shapes = built(name)
    chance, found = random.Random(f"cases of {name}"), []
    for _ in range(TRIALS):
        inputs = sample(shapes, chance)
        reference = nk.drawn(work, nk.REFERENCE, inputs)
        if reference is None:
            continue
        condition = nk.conditions(lambda i: nk.drawn(work, nk.REFERENCE, i), inputs, reference)
        if condition is not None:
            found.append((inputs, [nk.REFERENCE.pi.context.mpc(r) for r in reference], condition))
        if len(found) == DRAWS:
            return found
    pytest.fail(f"only {len(found)} places were found where the step can be drawn")


def held(
    name: str, found: list[Any], reference: list[Any], condition: list[float], unit: float
) -> None:
    """Hold every value to the bound."""
    for value, true, moved in zip(found, reference, condition, strict=True):
        allowed = ROUNDINGS * unit * (float(abs(true)) + moved)
        assert nk.far(value, true) <= allowed, name


ROOMS = sorted({name.partition(".")[0] for name in STEPS})
every_room = pytest.mark.parametrize("room", ROOMS)


def every(room: str) -> list[tuple[Any, ...]]:
    """Every case of every step of a room: its name, program, inputs, reference and conditions."""
    names = [name for name in STEPS if name.startswith(f"{room}.")]
    return [(name, built(name)[0], *case) for name in names for case in cases(name)]


def test_the_vocabulary_is_there():
    assert len(STEPS) > 110
    assert {"vocabulary.meet", "coriolis.coriolis", "contact_points.rack_at"} <= set(STEPS)
    assert "two_trials.share" in STEPS


@every_room
def test_a_step_on_one_scene_in_floats(room):
    for name, work, inputs, reference, condition in every(room):
        found = nk.by_one(work, FLOAT, inputs)
        assert all(type(value) in (float, complex) for value in found), name
        held(name, found, reference, condition, nk.UNITS["float"])


@pytest.mark.parametrize("kind", nk.ARRAYS)
@every_room
def test_a_step_on_arrays(room, kind):
    for name, work, inputs, reference, condition in every(room):
        found = nk.by_array(work, kind, nk.arrays_of(kind, inputs))
        assert all(nk.is_of(value, kind) for value in found), name
        held(name, found, reference, condition, nk.UNITS[kind])


@pytest.mark.parametrize("kind", nk.ARRAYS)
@every_room
def test_a_step_keeps_its_type_beside_what_all_variants_share(room, kind):
    for name, work, inputs, reference, condition in every(room)[::DRAWS]:
        for number in inputs:
            one, others = {number: inputs[number]}, {n: v for n, v in inputs.items() if n != number}
            for shared, moving in ((one, others), (others, one)):
                found = nk.by_array(nk.with_shared(work, shared), kind, nk.arrays_of(kind, moving))
                assert all(nk.is_of(value, kind) for value in found), name
                held(name, found, reference, condition, nk.UNITS[kind])


@every_room
def test_a_step_in_emitted_source(room):
    for name, work, inputs, reference, condition in every(room):
        found = nk.by_source(work, nk.arrays_of("float64", inputs))
        held(name, found, reference, condition, nk.UNITS["float64"])


@pytest.mark.parametrize("digits", nk.DIGITS)
@every_room
def test_a_step_in_decimals_never_asks_for_numpy(room, digits, monkeypatch):
    known = every(room)
    monkeypatch.setitem(__import__("sys").modules, "numpy", None)
    for name, work, inputs, reference, condition in known:
        found = nk.by_one(work, decimal_kind(digits), inputs)
        for value, true, moved in zip(found, reference, condition, strict=True):
            allowed = 10.0**-digits * (float(abs(true)) + moved)
            assert float(abs(value - true)) <= allowed, name


@pytest.mark.parametrize("bits", nk.BITS)
@every_room
def test_a_step_in_balls_contains_the_value_and_is_narrow(room, bits, monkeypatch):
    from graphkin.numbers.kinds import ball_kind

    known = every(room)
    monkeypatch.setitem(__import__("sys").modules, "numpy", None)
    kind = ball_kind(bits)
    for name, work, inputs, reference, condition in known:
        found = nk.by_one(work, kind, inputs)
        with kind.working():
            for value, true, moved in zip(found, reference, condition, strict=True):
                ball = nk.as_ball(value)
                assert nk.contains(ball, true), name
                assert nk.width(ball) <= NARROW * 2.0**-bits * (float(abs(true)) + moved), name
