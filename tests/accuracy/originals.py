"""Drawings without errors for the laws of the pencil to hold on."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from msgspec.structs import replace

from graphkin.accuracy.pencil import Original, Paper, original
from graphkin.construction.core import vocabulary
from graphkin.construction.core.program import Given, Part, Plane, Program, Step
from graphkin.construction.core.run import run
from graphkin.construction.normal_component import (
    NormalComponent,
    bar_line,
    normal,
    normal_by_hand,
    turn_over,
)
from graphkin.documents.sheet_documents import scales
from graphkin.mechanism import load
from graphkin.numbers.arithmetic import FLOAT

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
D_AWAY = ("acceleration", "D")


@cache
def pump(n: int = 7, lab: str = "pump") -> Original:
    """What the pump of a student asks, at the scales of its sheets."""
    mechanism = load(lab, n=n)
    return original(mechanism, scales(mechanism))


@cache
def scene(name: str) -> Original:
    """What a scene that comes with the program asks, at the scales of its sheets."""
    mechanism = load(SCENES / f"{name}.toml")
    return original(mechanism, scales(mechanism))


TRIANGLE = ("acceleration", "B")


def triangle(ratio: float, bar: float = 0.1) -> Original:
    """The right triangle of one bar drawn ``bar`` metres long, its velocity ``ratio`` as long."""
    steps: list[Step] = []

    def put(step: Step) -> int:
        steps.append(step)
        return len(steps) - 1

    def given(plane: Plane, form: str = "origin") -> int:
        return put(Step(None, (), Part.POSITION, plane, given=Given(form, ())))

    def draw(action: vocabulary.Action, *args: int, plane: Plane = Plane.MECHANISM) -> int:
        return put(Step(action, args, Part.NORMAL, plane))

    pivot, pin = given(Plane.MECHANISM), given(Plane.MECHANISM)
    seconds = given(Plane.NUMBERS, "one")
    pole = draw(vocabulary.pole, plane=Plane.VELOCITIES)
    image = given(Plane.VELOCITIES)
    tip = draw(vocabulary.set_way, pin, pole, image, seconds)
    square = draw(vocabulary.perpendicular_at, tip, pivot)
    line = draw(bar_line, pivot, pin)
    foot = draw(vocabulary.meet, square, line)
    end = draw(turn_over, foot, pin)
    hand = draw(normal_by_hand, pin, end, seconds, plane=Plane.NUMBERS)
    found = put(
        Step(
            normal,
            (pivot, pin, pole, image),
            Part.NORMAL,
            Plane.NUMBERS,
            by_hand=hand,
        )
    )
    corners = {"tip": tip, "edge": square, "line": line, "cut": foot, "end": end}
    ends = {"pivot": pivot, "pin": pin, "pivot_image": pole, "pin_image": image}
    made = NormalComponent(index="BA", p="A", q="B", v="BA", **ends, **corners)
    for role, number in made.given():
        steps[number] = replace(steps[number], of=made, role=role)
    program = Program(tuple(steps), {TRIANGLE: found})
    values = {pin: complex(bar), image: 1j * ratio * bar}
    trace = run(program, range(len(steps)), {}, FLOAT, overrides=values)
    return Original(trace, Paper(1.0, 1.0, 1.0), (TRIANGLE,))
