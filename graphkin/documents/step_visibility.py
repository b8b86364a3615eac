"""What stands in the fields of a sheet at each sentence of the construction, and what is new."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Part
from graphkin.documents.mark_dependencies import ground_of
from graphkin.documents.step_numbers import stage_of
from graphkin.drawing.field import Field
from graphkin.drawing.labels import BETWEEN, NOTE
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Text, style_class
from graphkin.drawing.richtext import extent
from graphkin.drawing.style import NOW
from graphkin.drawing.symbol_markup import symbol


def appearing(
    drawing: Drawing,
    field: Field,
    marks: Sequence[Mark],
    staged: dict[int, int],
    said: Sequence[Sentence],
) -> Iterator[tuple[int, Mark]]:
    """The marks of a field, each with the sentence at which it appears."""
    ground = ground_of(drawing, field)
    for mark, beside in accompanied(marks):
        yield stage_of(drawing, beside, staged, said, ground), mark


def accompanied(marks: Sequence[Mark]) -> Iterator[tuple[Mark, Mark]]:
    """The marks of a field, each with the one with which it appears: the frame around a link's name
    with the name after it, all others with themselves.
    """
    for mark, after in zip(marks, (*marks[1:], *marks[-1:]), strict=True):
        yield mark, after if style_class(mark) == "number" and not mark.name else mark


def when_told(drawing: Drawing, staged: Mapping[int, int]) -> dict[str, int]:
    """The sentence that finds each letter of the plan, each centre, each vector by its symbol."""
    found: dict[str, int] = {}
    for number, step in enumerate(drawing.trace.program.steps):
        if number in staged:
            vector = plan_vector(step)
            name = symbol(vector.symbol if vector else step.name)
            found.setdefault(name, staged[number])
            if vector and vector.foot:
                found.setdefault(vector.foot, staged[number])
            if step.plane is drawing.plane or step.part in (Part.CENTRE, Part.POLE):
                found[step.name] = staged[number]
    return found


def marks_at_stage(
    timed: Sequence[tuple[int, Mark]], stage: int, telling: Mapping[str, int]
) -> Iterator[Mark]:
    """The marks that stand at a sentence; those that it draws are marked as new.

    ``telling`` gives the sentence at which each letter and each vector is found.
    """
    subjects = {mark.step: mark.cx for _, mark in timed if isinstance(mark, CircleMark)}
    subjects |= {
        m.step: m.x1 for _, m in timed if isinstance(m, LineMark) and style_class(m) == "leader"
    }
    texts = [(at, mark) for at, mark in timed if isinstance(mark, Text)]
    explained = {part.name for _, mark in texts if mark.name == NOTE for part in mark.letters}
    keys = {mark.markup: at for at, mark in texts if mark.markup in explained - {""}}
    for appears, mark in timed:
        if isinstance(mark, Text) and len(mark.letters) > 1 and mark.step is not None:
            stages = [telling[letter.name] for letter in mark.letters]
            yield from shared(mark, stage, stages, subjects[mark.step])
        elif isinstance(mark, Text) and mark.name == NOTE and stage < appears:
            yield from noted(mark, stage, {**telling, **keys})
        elif appears <= stage:
            yield mark if appears < stage else replace(mark, cls=f"{mark.cls} {NOW}")


def shared(mark: Text, stage: int, stages: Sequence[int], subject: float) -> Iterator[Mark]:
    """Of the letters that share a label those that stand already, as near as all to their point.

    ``stages`` are those at which the letters appear, ``subject`` is where their leader or their
    point stands from left to right.
    """
    every = zip(mark.letters, stages, strict=True)
    seen = [letter for letter, appears in every if appears <= stage]
    if seen:
        markup = seen[0].markup + "".join(letter.joined for letter in seen[1:])
        whole, width = (extent(each, mark.height)[0] for each in (mark.markup, markup))
        aside = min(max(subject - mark.x - width / 2, 0.0), whole - width)
        cls = f"{mark.cls} {NOW}" if stage in stages else mark.cls
        yield replace(mark, x=mark.x + aside, markup=markup, cls=cls)


def noted(mark: Text, stage: int, telling: Mapping[str, int]) -> Iterator[Mark]:
    """Of the notes in a line at the foot those of vectors and key numbers that stand already."""
    parts = mark.letters
    stands = [telling.get(part.name, stage + 1) <= stage for part in parts]
    for i, part in enumerate(parts):
        if stands[i]:
            before = extent("".join(each.joined for each in parts[: i + 1]), mark.height)[0]
            ended = part.markup + BETWEEN.rstrip() if any(stands[i + 1 :]) else part.markup
            aside = before - extent(part.markup, mark.height)[0]
            yield replace(mark, x=mark.x + aside, markup=ended)
