"""At which sentence of the construction each mark of a sheet appears, for pages that grow."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from graphkin.paper.drawing import Drawing
from graphkin.paper.marks import Mark
from graphkin.paper.sentence import Sentence
from graphkin.steps.program import Part, Program

READ_OFF = ("set-on", "set-on-twice")
"""Arrows on the mechanism, which the last sentence asks for."""
BEFORE = -1
"""The stage of what stands before the first sentence."""


def stages(drawing: Drawing, said: Sequence[Sentence]) -> dict[int, int]:
    """For each step that was run the number of the sentence, from 0, that draws it.

    A sentence draws what its own points hang on and no sentence before has drawn. An arrow or any
    other step that no sentence finds appears as soon as all that it is drawn from is there.
    """
    program = drawing.trace.program
    found: dict[int, int] = {}
    if drawing.again:
        found |= dict.fromkeys(
            (n for n in drawing.trace.values if program.steps[n].part is Part.POSITION), BEFORE
        )
    for stage, sentence in enumerate(said):
        for number in behind(program, sentence.all_steps):
            found.setdefault(number, stage)
    for number in drawing.trace.values:
        step = program.steps[number]
        if step.action is not None and step.action.key in READ_OFF:
            found[number] = len(said) - 1
        elif number not in found:
            found[number] = max((found.get(arg, BEFORE) for arg in step.args), default=BEFORE)
    return found


def behind(program: Program, numbers: Iterable[int]) -> set[int]:
    """Some steps and all those that they are drawn from, in the hand's way too."""
    found: set[int] = set()
    waiting = [number for number in numbers if number >= 0]
    while waiting:
        number = waiting.pop()
        if number in found:
            continue
        found.add(number)
        step = program.steps[number]
        waiting += step.args
        if step.by_hand is not None:
            waiting.append(step.by_hand)
    return found


def stage_of(drawing: Drawing, mark: Mark, staged: dict[int, int], said: Sequence[Sentence]) -> int:
    """The sentence at which a mark of a field appears; BEFORE for what stands from the start.

    A mark that belongs to no step is that of a point, or of a link, whose bars appear with the
    last of its points.
    """
    if mark.step is not None:
        return staged.get(mark.step, BEFORE)
    if mark.name == "note":
        return len(said) - 1
    classes = mark.cls.split()
    for stage, sentence in enumerate(said):
        if sentence.step < 0 and sentence.name and sentence.name in classes:
            return stage
    scene, targets = drawing.scene, drawing.trace.program.targets
    name = mark.name.partition(" ")[2] if mark.name.startswith("omega ") else mark.name
    points = scene.links[name].points if name in scene.links else (name,)
    numbers = (targets.get(("position", point), -1) for point in points)
    return max((staged.get(number, BEFORE) for number in numbers), default=BEFORE)
