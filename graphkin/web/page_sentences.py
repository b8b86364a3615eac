"""The sentences of a page: those of a sheet, in parts where one would draw too much at once.

A part draws a line or two, or finds one point; what a sheet says of several points in one sentence
the page says of each.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from msgspec import Struct

from graphkin.construction.core.auxiliary_plan import auxiliary_plan
from graphkin.construction.core.component import component_of
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.sentence import Sentence
from graphkin.construction.higher_class.divided_point import DividedPoint
from graphkin.construction.higher_class.trial_plan import TrialPlan
from graphkin.construction.higher_class.two_trials import divided_alone
from graphkin.construction.rate_relations import of_turning
from graphkin.construction.step_sentences import point_parts
from graphkin.documents.sentences import SET_ON, TURNING, set_on_mechanism, unexplained
from graphkin.drawing.symbol_markup import symbol

MOST = 3
"""Strokes that a sentence of the page draws at most, if it can be parted."""
AND = "; "
"""What stands between parts that are said in one."""


class Piece(Struct, frozen=True):
    """A part of a sentence: the step that it ends with, and that of the point that it helps find.

    ``name`` is that of its sentence.
    """

    step: int
    point: int
    markup: str
    name: str = ""

    @property
    def sentence(self) -> Sentence:
        """It as a sentence of its own."""
        return Sentence(self.step, self.name, self.markup)


class Whole(Struct, frozen=True):
    """A sentence of a sheet and its parts, one where it has no more."""

    said: Sentence
    pieces: tuple[Piece, ...]
    plan: TrialPlan | None = None

    def sentences(self, drawing: Drawing, strokes: Sequence[int]) -> Iterator[tuple[Sentence, int]]:
        """The sentences of the page, each with the number of its parts, which draw so many
        ``strokes``: the sheet's own where all parts draw no more than one sentence may.
        """
        if sum(strokes) <= MOST and self.said.name != TURNING:
            yield self.said, len(self.pieces)
            return
        for place, some in enumerate(grouped(self.pieces, strokes)):
            markup = AND.join(piece.markup for piece in some)
            name = some[-1].name
            if self.plan is not None:
                markup = self.plan.introduced(drawing, markup, first=place == 0)
                name = name if place == 0 else ""
            steps = tuple(piece.step for piece in some) if len(some) > 1 else ()
            yield Sentence(some[-1].step, name, markup, steps), len(some)


def grouped(pieces: Sequence[Piece], strokes: Sequence[int]) -> Iterator[list[Piece]]:
    """The parts that one sentence says: of one point, with no more strokes than it may draw."""
    for _, run in groupby(zip(pieces, strokes, strict=True), lambda each: each[0].point):
        some, drawn = list[Piece](), 0
        for piece, count in run:
            if some and drawn + count > MOST:
                yield some
                some, drawn = [], 0
            some, drawn = [*some, piece], drawn + count
        yield some


def wholes(drawing: Drawing) -> list[Whole]:
    """The sentences of a sheet with their parts."""
    return [whole(drawing, said) for said in unexplained(drawing)]


def whole(drawing: Drawing, said: Sentence) -> Whole:
    """A sentence of a sheet with its parts."""
    if said.name == TURNING:
        return Whole(said, tuple(readings(drawing)))
    plan = auxiliary_plan(drawing, said.step)
    if isinstance(plan, TrialPlan):
        parts = plan.told_in_parts(drawing)
        return Whole(said, tuple(Piece(s, p, text, said.name) for p, s, text in parts), plan)
    pieces = tuple(
        Piece(step, number, markup, said.name)
        for number in said.all_steps
        for step, markup in parted(drawing, number)
    )
    one = Piece(said.step, said.step, said.markup, said.name)
    return Whole(said, pieces if len(pieces) > 1 and all(p.markup for p in pieces) else (one,))


def parted(drawing: Drawing, number: int) -> Iterator[tuple[int, str]]:
    """What is said of a step alone, part by part, each with the step that it ends with."""
    program = drawing.trace.program
    component, kind = component_of(program, number), construction(program.steps[number])
    if component is not None:
        yield from component.told_in_parts(drawing)
    elif isinstance(kind, DividedPoint) and not kind.is_crossed(drawing.trace.values):
        yield number, divided_alone(drawing, kind)
    elif kind is not None:
        yield from point_parts(drawing, number)


def readings(drawing: Drawing) -> Iterator[Piece]:
    """What is read off at the end: which vectors are set on, then the rate of each link."""
    if markup := set_on_mechanism(drawing, ""):
        yield Piece(-1, -1, markup, SET_ON)
    rate, steps = drawing.rate, dict[str, int]()
    for (what, link), number in drawing.trace.program.targets.items():
        if what == rate.target:
            steps[symbol(f"{rate.letter}_{link}")] = number
    how = drawing.words(f"step.read-{rate.target}").removeprefix(AND)
    for relation in of_turning(drawing):
        if (step := steps.get(relation.left)) is not None:
            told = " ".join(relation.parts(solved=True))
            yield Piece(step, step, f"{how}: {told}" if how else told, TURNING)
            how = ""
