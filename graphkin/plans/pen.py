"""The pen: it writes steps down, one after the other, and knows what each point has become."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from graphkin.arithmetic import FLOAT
from graphkin.errors import ClosureError
from graphkin.scene.model import Scene
from graphkin.steps.program import Given, Part, Plane, Program, Step, Target
from graphkin.steps.run import StepFailed, run
from graphkin.steps.vocabulary import Action, pole

Says = dict[str, Any]
"""The names that a sentence needs."""

PRIME = "\N{PRIME}"


class Pen:
    """Writes a program: every call adds one step and returns its number."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.steps: list[Step] = []
        self.targets: dict[Target, int] = {}
        self.guides: dict[str, int] = {}
        self.scale_step: int | None = None
        self.shared: dict[tuple[Any, ...], int] = {}
        self.part, self.plane, self.hand = Part.SHAPE, Plane.NUMBERS, False

    @contextmanager
    def on(self, part: Part, plane: Plane) -> Iterator[None]:
        """Work at one part of the task, in one drawing."""
        before = self.part, self.plane
        self.part, self.plane = part, plane
        yield
        self.part, self.plane = before

    @contextmanager
    def hands_way(self) -> Iterator[None]:
        """Steps that only the hand's way of a composite step needs."""
        before, self.hand = self.hand, True
        yield
        self.hand = before

    def draw(
        self,
        action: Action,
        *args: int,
        name: str = "",
        extra: tuple[int, ...] = (),
        by_hand: int | None = None,
        **says: Any,
    ) -> int:
        """Add a step that follows from earlier ones."""
        return self._add(
            Step(
                action,
                args,
                self.part,
                self.plane,
                name,
                extra,
                None,
                by_hand,
                self.hand,
                says=says,
            )
        )

    def arrow(self, action: Action, *args: int, name: str, **says: Any) -> int:
        """Add an arrow: drawn where its ends are, used by no other step."""
        return self._add(
            Step(action, args, self.part, self.plane, name, hand=True, arrow=True, says=says)
        )

    def given(self, form: str, *quantities: Any, name: str = "", **says: Any) -> int:
        """Add a value that the scene states; the same value is written down once."""
        key = (form, quantities, name, self.plane)
        if key not in self.shared:
            given = Given(form, quantities)
            plane = self.plane if form == "point" else Plane.NUMBERS
            step = Step(None, (), self.part, plane, name, (), given, says=says)
            self.shared[key] = self._add(step)
        return self.shared[key]

    def _add(self, step: Step) -> int:
        self.steps.append(step)
        return len(self.steps) - 1

    def want(self, quantity: str, of: str, number: int) -> int:
        """Say which step carries a quantity of a point or link."""
        self.targets[quantity, of] = number
        return number

    def has(self, quantity: str, of: str) -> bool:
        """True when a quantity has been constructed."""
        return (quantity, of) in self.targets

    def the(self, quantity: str, of: str) -> int:
        """The step that carries a quantity."""
        return self.targets[quantity, of]

    def pole(self, plane: Plane) -> int:
        """The pole of a plan: o of the velocities, o′ of the accelerations."""
        key = ("pole", plane)
        if key not in self.shared:
            name = "o" if plane is Plane.VELOCITIES else "o" + PRIME
            part = Part.VELOCITY if plane is Plane.VELOCITIES else Part.ACCELERATION
            self.shared[key] = self._add(Step(pole, (), part, plane, name))
        return self.shared[key]

    def seconds(self) -> int:
        """kL/kv, by which velocities are set on the mechanism; with one crank it is 1/omega."""
        turning = [driver for driver in self.scene.drivers if driver.kind == "turn"]
        with self.on(Part.SHAPE, Plane.NUMBERS):
            if len(turning) == len(self.scene.drivers) == 1:
                number = self.given("seconds", turning[0].speed)
            else:
                number = self.given("one")
        self.scale_step = number
        return number

    def peek(self, number: int) -> Any:
        """Value of a step at the scene's own numbers, for choices that the drawing's shape needs.

        None when the mechanism does not close there.
        """
        program = self.program()
        wanted = Program(program.steps, {("step", ""): number}).needed([("step", "")])
        try:
            return run(program, wanted, self.scene.values, FLOAT).values[number]
        except (StepFailed, ClosureError):
            return None

    def program(self) -> Program:
        """The steps written so far."""
        return Program(tuple(self.steps), dict(self.targets), self.scale_step)


def image(point: str) -> str:
    """Name of a point's image in the velocity plan: the same letter, small."""
    return point.lower() if point.lower() != point else point + "_v"


def second_image(point: str) -> str:
    """Name of a point's image in the acceleration plan: the small letter with a prime."""
    return image(point) + PRIME


def about(pen: Pen, pin: str, pivot: str) -> str:
    """Index of a relative motion: BA for B about A, and B alone about a fixed pivot."""
    return pin if pivot in pen.scene.frame.points else pin + pivot
