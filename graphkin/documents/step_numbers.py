"""At which sentence of the construction each mark of a sheet appears, for pages that grow."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from graphkin.construction.centres.instant_centre import set_before
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence, construction
from graphkin.construction.core.plan_vector import is_set_on, plan_vector
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.construction.links.idle_links import IDLE
from graphkin.documents.mark_dependencies import Target, rests_on
from graphkin.documents.sentences import SET_ON
from graphkin.drawing.marks import Mark, style_class
from graphkin.scene.link_points import lettered

AT_LAST = ("detail", "note")
"""The names of marks that stand when all is drawn."""
PINS = ("pin", "hinge", "label", "leader")
"""The classes of a pin, and of its letter."""
TOLD_BY = {"fixed-centrode": "moving-centrode"}
"""The names of sentences that tell of a curve of another kind than their name."""
BEFORE = -1
"""The stage of what stands before the first sentence."""


def stages(drawing: Drawing, said: Sequence[Sentence]) -> dict[int, int]:
    """For each step that was run the number of the sentence, from 0, that draws it.

    A sentence draws what its own points hang on and no sentence before has drawn. An arrow or any
    other step that no sentence finds appears as soon as all that it is drawn from is there. What
    is given, the points of the frame and the pole of the plan, stands before the first sentence.
    """
    program = drawing.trace.program
    found: dict[int, int] = {}
    if drawing.again:
        found |= dict.fromkeys(
            (n for n in drawing.trace.values if program.steps[n].part is Part.POSITION), BEFORE
        )
    for stage, sentence in enumerate(said):
        own = (number for number in sentence.all_steps if number >= 0)
        for number in program.behind(own, by_hand=True):
            found.setdefault(number, stage)
    early = set_before(drawing)
    setting = next((at for at, one in enumerate(said) if one.name == SET_ON), len(said) - 1)
    for number in drawing.trace.values:
        step = program.steps[number]
        if not step.args:
            found[number] = BEFORE
        elif number in early:
            found.setdefault(number, found.get(early[number], setting))
        elif is_set_on(step):
            found[number] = setting
        elif number not in found:
            ends = (*step.args, *of_component(drawing, step))
            found[number] = max((found.get(end, BEFORE) for end in ends), default=BEFORE)
    return found


def of_component(drawing: Drawing, step: Step) -> Iterator[int]:
    """The images between which a tangential component is told: it is not there before them."""
    vector = plan_vector(step)
    if vector is not None and vector.sign == "τ":
        ends = (vector.p, vector.q)
        for (what, name), number in drawing.trace.program.targets.items():
            if what == "acceleration" and lettered(name) in ends:
                yield number


def stage_of(
    drawing: Drawing,
    mark: Mark,
    staged: dict[int, int],
    said: Sequence[Sentence],
    ground: Mapping[Mark, tuple[Target, ...]],
) -> int:
    """The sentence at which a mark of a field appears; BEFORE for what stands from the start.

    A mark that belongs to no step appears with the last of what it rests on: one of the ``ground``
    with the points about which it is drawn.
    """
    if mark.step is not None:
        return staged.get(mark.step, BEFORE)
    if mark.name in AT_LAST:
        return len(said) - 1
    told = stage_of_closing(drawing, mark, said)
    if told is None:
        told = stage_of_curve(drawing, mark, said)
    if told is not None:
        return told
    targets = drawing.trace.program.targets
    rests = ground[mark] if mark in ground else rests_on(drawing, mark)
    numbers = (targets[target] for target in rests if target in targets)
    idle = (stage for stage, one in enumerate(said) if one.name == IDLE and one.link == mark.name)
    return max((*idle, *(settled(drawing, number, staged) for number in numbers)), default=BEFORE)


def settled(drawing: Drawing, number: int, staged: dict[int, int]) -> int:
    """The sentence by which a value stands; that of a number as soon as it can be reckoned."""
    step = drawing.trace.program.steps[number]
    closes = isinstance(step.of, ClosedGroup) and step.role == "closing"
    if number in staged and (closes or step.plane is not Plane.NUMBERS):
        return staged[number]
    return max((settled(drawing, arg, staged) for arg in step.args), default=BEFORE)


def stage_of_curve(drawing: Drawing, mark: Mark, said: Sequence[Sentence]) -> int | None:
    """The sentence that tells of a curve, of several of its kind each its own; else None."""
    for curve in drawing.curves:
        if mark.name == curve.name:
            if curve.kind == "locus":
                return next(at for at, one in enumerate(said) if curve.of in traced(drawing, one))
            alike = [other.of for other in drawing.curves if other.kind == curve.kind]
            name = TOLD_BY.get(curve.kind, curve.kind)
            stages = [stage for stage, sentence in enumerate(said) if sentence.name == name]
            return stages[min(alike.index(curve.of), len(stages) - 1)]
    return None


def stage_of_closing(drawing: Drawing, mark: Mark, said: Sequence[Sentence]) -> int | None:
    """The sentence that closes a group at a pin, for the pin's marks; None for all others."""
    if style_class(mark) not in PINS or mark.name in drawing.scene.links:
        return None
    return next((at for at, one in enumerate(said) if mark.name in traced(drawing, one)), None)


def traced(drawing: Drawing, said: Sentence) -> tuple[str, ...]:
    """The points whose loci a sentence has drawn."""
    kind = construction(drawing.trace.program.steps[said.step]) if said.step >= 0 else None
    return kind.traced if isinstance(kind, ClosedGroup) else ()
