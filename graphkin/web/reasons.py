"""Why a step is drawn as it is: the law of rigid bodies, guides or wheels behind each line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.component import component_of, is_hidden
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import GivesRate, Sentence, construction
from graphkin.construction.core.program import Part, Step
from graphkin.construction.links.idle_links import IDLE
from graphkin.construction.normal_component import NormalComponent
from graphkin.construction.velocity.relative_motion import PerpendicularThrough
from graphkin.documents.sentences import OWN, SET_ON, TURNING
from graphkin.numbers.plane import Line

AGAIN = {
    "why.height": "why.height_again",
    "why.normal": "why.normal_again",
    "why.tangential": "why.tangential_again",
}
"""The shorter reason for the second and each further step of a kind."""
LAST, LAST_OF_MANY = "why.meet", "why.meet_many"
"""The reason that comes last, once for all points."""
VECTORS_APART = "vectors"
"""The name of a sentence that draws vectors between images found by the sentence before."""
BY_NAME = {
    VECTORS_APART: "why.vectors",
    "again": "why.again",
    SET_ON: "why.set_on",
    IDLE: "why.idle",
    "moving-centrode": "why.centrodes",
    "trajectory": "why.path",
}
"""The reason of a sentence that belongs to no step, by the sentence's name."""
NO_STEP = -1
"""The step number of a reason that belongs to no single step."""


def reasons(drawing: Drawing, numbers: Iterable[int]) -> list[tuple[str, int]]:
    """The reasons for some steps as markup, each with its step, in order and without repeats."""
    parts = [part for part in OWN[drawing.kind] if not (drawing.again and part is Part.POSITION)]
    found: dict[str, int] = {}
    given: set[str] = set()
    met: dict[str, int] = {}
    for number in sorted(numbers):
        step = drawing.trace.program.steps[number]
        key, known = reason(drawing, step), fields(drawing, step)
        if isinstance(kind := construction(step), PerpendicularThrough):
            known["s"] = drawing.lettered(kind.start)
        if step.part not in parts or not key or is_nothing(drawing, number):
            continue
        if component_of(drawing.trace.program, number) is None and is_hidden(drawing, number):
            continue
        if not all(known[gap] for gap in drawing.words.gaps(key)):
            continue
        if key == LAST:
            met[known["name"]] = number
            continue
        text = drawing.words(AGAIN.get(key, key) if key in given else key, **known)
        given.add(key)
        found.setdefault(text, number)
    if met:
        names, (first, *more) = drawing.words("list_mark").join(met), met.values()
        text = drawing.words(LAST_OF_MANY if more else LAST, name=names)
        found[text] = NO_STEP if more else first
    return list(found.items())


def of_sentence(drawing: Drawing, sentence: Sentence) -> Iterator[tuple[str, int]]:
    """The reasons of a sentence without a step, of a reading, and of an auxiliary plan's start."""
    steps, words = drawing.trace.program.steps, drawing.words
    plan = auxiliary_plan(drawing, sentence.step)
    if sentence.name == TURNING:
        kind = construction(steps[sentence.step])
        read = kind.rate_reason(drawing) if isinstance(kind, GivesRate) else "why.rate"
        keys = dict.fromkeys(reason or read for reason in sentence.reasons or ("",))
        yield from ((words(key), NO_STEP) for key in keys)
    elif sentence.name in BY_NAME:
        yield words(BY_NAME[sentence.name]), NO_STEP
    elif plan and (key := plan.reason(sentence.name)):
        yield words(key), NO_STEP


def is_nothing(drawing: Drawing, number: int) -> bool:
    """Whether a step of an auxiliary plan adds nothing.

    A point adds nothing if it falls on the point it is drawn from; a line, if it finds only such
    points.
    """
    plan, step = auxiliary_plan(drawing, number), drawing.trace.program.steps[number]
    if plan is None:
        return False
    if isinstance(drawing.trace.values[number], Line):
        return plan.is_idle(drawing, number)
    return bool(step.name and plan.falls_on(drawing, number))


def reason(drawing: Drawing, step: Step) -> str:
    """The key of a step's reason; empty where the step needs none."""
    kind = construction(step)
    return kind.reason(drawing, step.role) if kind is not None else ""


def fields(drawing: Drawing, step: Step) -> dict[str, str]:
    """The letters of a step as markup; a letter that the step lacks is empty."""
    known = dict.fromkeys(("p", "q", "r", "g", "k", "i", "bar"), "")
    kind = construction(step)
    if kind is not None:
        known |= kind.symbols()
        if isinstance(kind, NormalComponent):
            known |= kind.corner_symbols(drawing, *kind.lettered)
    return known | {"name": drawing.symbol(step.name) if step.name else ""}
