"""The sentences of a page: those of a sheet, in parts where one would draw too much at once.

A part draws a line or two, or finds one point; what a sheet says of several points in one sentence
the page says of each.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from msgspec import Struct

from graphkin.construction.core.auxiliary_plan import AuxiliaryPlan, auxiliary_plan
from graphkin.construction.core.component import component_of
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence, construction
from graphkin.construction.higher_class.divided_point import DividedPoint
from graphkin.construction.higher_class.two_trials import divided_alone
from graphkin.construction.rate_relations import of_turning
from graphkin.construction.step_sentences import point_parts
from graphkin.documents.sentences import SET_ON, TURNING, set_on_mechanism, unexplained
from graphkin.drawing.symbol_markup import symbol
from graphkin.text.markup import AND

MOST = 3
"""Strokes that a sentence of the page draws at most, if it can be parted."""


class SentencePart(Struct, frozen=True):
    """A part of a sentence: the step that it ends with, and that of the point that it helps find.

    ``name`` and ``link`` are those of its sentence, ``reason`` is one of its reasons.
    """

    step: int
    point: int
    markup: str
    name: str = ""
    link: str = ""
    reason: str = ""

    @property
    def sentence(self) -> Sentence:
        """It as a sentence of its own."""
        return Sentence(self.step, self.name, self.markup, (), self.link, (self.reason,))


class PartedSentence(Struct, frozen=True):
    """A sentence of a sheet and its parts, one where it has no more."""

    said: Sentence
    parts: tuple[SentencePart, ...]
    plan: AuxiliaryPlan | None = None

    def sentences(self, drawing: Drawing, strokes: Sequence[int]) -> Iterator[tuple[Sentence, int]]:
        """The sentences of the page, each with the number of its parts, which draw so many
        ``strokes``: the sheet's own where all parts draw no more than one sentence may.
        """
        if sum(strokes) <= MOST and self.said.name != TURNING:
            yield self.said, len(self.parts)
            return
        for place, some in enumerate(grouped(self.parts, strokes)):
            markup: str = AND.join(part.markup for part in some)
            name = some[-1].name
            if self.plan is not None:
                begins = place == 0 and self.plan.begins(drawing, self.said.all_steps)
                markup = self.plan.introduced(drawing, markup, first=begins)
                name = name if place == 0 else ""
            steps = tuple(part.step for part in some) if len(some) > 1 else ()
            reasons = tuple(part.reason for part in some)
            yield Sentence(some[-1].step, name, markup, steps, some[-1].link, reasons), len(some)


def grouped(parts: Sequence[SentencePart], strokes: Sequence[int]) -> Iterator[list[SentencePart]]:
    """The parts that one sentence says: of one point, with no more strokes than it may draw."""
    for _, run in groupby(zip(parts, strokes, strict=True), lambda each: each[0].point):
        some, drawn = list[SentencePart](), 0
        for part, count in run:
            if some and drawn + count > MOST:
                yield some
                some, drawn = [], 0
            some, drawn = [*some, part], drawn + count
        yield some


def parted_sentences(drawing: Drawing) -> list[PartedSentence]:
    """The sentences of a sheet with their parts."""
    return [parted_sentence(drawing, said) for said in unexplained(drawing)]


def parted_sentence(drawing: Drawing, said: Sentence) -> PartedSentence:
    """A sentence of a sheet with its parts."""
    one = SentencePart(said.step, said.step, said.markup, said.name, said.link)
    if said.name == TURNING:
        return PartedSentence(said, tuple(readings(drawing)) or (one,))
    plan = auxiliary_plan(drawing, said.step)
    divided = isinstance(construction(drawing.trace.program.steps[said.step]), DividedPoint)
    if plan is not None and not divided:
        told = plan.told_in_parts(drawing, said.all_steps)
        parts = tuple(SentencePart(s, p, text, said.name) for p, s, text in told)
        return PartedSentence(said, parts, plan)
    parts = tuple(
        SentencePart(step, number, markup, said.name)
        for number in said.all_steps
        for step, markup in told_in_parts(drawing, number)
    )
    whole = len(parts) < 2 or not all(part.markup for part in parts)
    return PartedSentence(said, (one,) if whole else parts)


def told_in_parts(drawing: Drawing, number: int) -> Iterator[tuple[int, str]]:
    """What is said of a step alone, part by part, each with the step that it ends with."""
    program = drawing.trace.program
    component, kind = component_of(program, number), construction(program.steps[number])
    if component is not None:
        yield from component.told_in_parts(drawing)
    elif isinstance(kind, DividedPoint) and not kind.is_crossed(drawing.trace.values):
        yield number, divided_alone(drawing, kind)
    elif kind is not None:
        yield from point_parts(drawing, number)


def readings(drawing: Drawing) -> Iterator[SentencePart]:
    """What is read off at the end: which vectors are set on, then the rate of each link."""
    if markup := set_on_mechanism(drawing, ""):
        yield SentencePart(-1, -1, markup, SET_ON)
    rate, steps = drawing.rate, dict[str, int]()
    for (what, link), number in drawing.trace.program.targets.items():
        if what == rate.target:
            steps[symbol(f"{rate.letter}_{link}")] = number
    how: str = drawing.words(f"step.read-{rate.target}")
    for relation in of_turning(drawing):
        if (step := steps.get(relation.left)) is not None:
            told = " ".join(relation.parts(solved=True))
            markup = f"{how}: {told}" if how else told
            yield SentencePart(step, step, markup, TURNING, reason=relation.reason)
            how = ""
