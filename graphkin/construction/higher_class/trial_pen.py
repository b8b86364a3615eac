"""A pen that writes the program of a trial: what the real one knows comes in from outside."""

from __future__ import annotations

from typing import Any

from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Given, Part, Plane, Step


class TrialPen(Pen):
    """Writes a program of its own; ``inputs`` maps each of its inputs to the real pen's step."""

    def __init__(self, parent: Pen) -> None:
        super().__init__(parent.scene)
        self.parent = parent
        self.bases |= parent.bases
        self.leads |= parent.leads
        self.turning = parent.turning
        self.inputs: dict[int, int] = {}

    def input_step(self) -> int:
        """A step whose value comes from outside."""
        return self._add(Step(None, (), Part.POSITION, Plane.NUMBERS, given=Given("input", ())))

    def given(
        self, form: str, *quantities: Any, name: str = "", of: int | str | None = None
    ) -> int:
        """A value that the scene states comes in too, so that it may vary in a batch."""
        number = self.parent.given(form, *quantities, name=name, of=of)
        key = ("given", number)
        if key not in self.shared:
            self.shared[key] = self.input_step()
            self.inputs[self.shared[key]] = number
        return self.shared[key]

    def keep_inputs(self, *results: int | None) -> None:
        """Let go of the inputs that neither a step nor a result uses, such as a driver's speed."""
        used = {*results, *(arg for step in self.steps for arg in step.args)}
        self.inputs = {own: known for own, known in self.inputs.items() if own in used}

    def peek(self, number: int) -> Any:
        """Value of a step at the scene's own numbers; None where it hangs on what is tried."""
        for step, known in self.inputs.items():
            if step not in self.peeked:
                self.peeked[step] = self.parent.peek(known)
        return super().peek(number)

    def has(self, quantity: str, of: str) -> bool:
        """True when a quantity has been constructed here, or by the real pen."""
        return super().has(quantity, of) or self.parent.has(quantity, of)

    def the(self, quantity: str, of: str) -> int:
        """The step that carries a quantity; one of the real pen's comes in as an input."""
        if not super().has(quantity, of):
            number = self.input_step()
            self.inputs[number] = self.parent.the(quantity, of)
            self.targets[quantity, of] = number
        return super().the(quantity, of)
