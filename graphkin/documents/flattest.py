"""The line on the sheet's margin that says where a pencil error grows most."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from math import degrees

from graphkin.construction.core.auxiliary_plan import falls_on_sources
from graphkin.construction.core.component import TriangleComponent, is_hidden
from graphkin.construction.core.crossings import Crossing, crossings, flattest
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.program import Part
from graphkin.construction.core.quantities import FORCE
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.documents.sentences import sentences
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.richtext import extent
from graphkin.drawing.symbol_markup import without_index

HEIGHT = 2.5
"""Height of the lettering in mm."""
APART = 2.5
"""Room in mm between this line and the text before it."""
BESIDE = 22.0
"""Distance in mm of the line's end from the title block, clear of the centring mark."""
OWN = {
    "velocity": (Part.POSITION, Part.VELOCITY, Part.CENTRE),
    "acceleration": (Part.POSITION, Part.NORMAL, Part.ACCELERATION, Part.POLE),
    FORCE: (Part.FORCE,),
}
"""The parts of the work that are drawn on each sheet."""


def flattest_line(drawing: Drawing, start: float) -> Iterator[Mark]:
    """The flattest crossing of a sheet, its angle, and the effect of a millimetre of pencil error.

    ``start`` is where the free room begins, in mm. Where the room is too short, the name is
    shortened, then the effect is left out. Empty where no lines cross. Crossings drawn on the sheet
    before this one are not counted again.
    """
    worst = flattest(crossings_on(drawing))
    if worst is None:
        return
    paper = drawing.paper
    end = paper.left[2] if paper.is_leaf else paper.tables[0] - BESIDE
    forms = "page.flattest", "page.flattest_angle"
    for form, name in product(forms, names_of_crossing(drawing, worst)):
        text = drawing.words(
            form,
            name=name,
            angle=drawing.words.fixed(degrees(worst.angle), 0),
            factor=drawing.words.significant(worst.factor, 2),
        )
        if end - extent(text, HEIGHT)[0] >= start + APART:
            yield Text(end, paper.below[3] + 0.8, text, "caption", HEIGHT, "end", name="flattest")
            return


def crossings_on(drawing: Drawing) -> tuple[Crossing, ...]:
    """The lettered crossings that a sheet itself draws and uses."""
    parts = [part for part in OWN[drawing.kind] if not (drawing.again and part is Part.POSITION)]
    return tuple(
        crossing
        for crossing in crossings(drawing.trace)
        if crossing.name and crossing.part in parts and crossing.number in drawing.trace.values
        if not falls_on_sources(drawing, crossing.number)
        if not is_hidden(drawing, crossing.number)
    )


def group_closed(drawing: Drawing, crossing: Crossing) -> ClosedGroup | None:
    """The group of higher class that a crossing closes; None for any other crossing."""
    kind = construction(drawing.trace.program.steps[crossing.number])
    return kind if isinstance(kind, ClosedGroup) else None


def is_gap(drawing: Drawing, crossing: Crossing) -> bool:
    """Whether two loci close a group where they are a bar apart, rather than where they cross."""
    group = group_closed(drawing, crossing)
    return group is not None and len(group.traced) > 1


def names_of_crossing(drawing: Drawing, crossing: Crossing) -> tuple[str, str]:
    """Markup of the name of a crossing, and a shorter form.

    The name is the letter as drawn. A crossing that closes a group has the letter of its locus. A
    triangle whose corners no sentence names is called by its component.
    """
    group, step = group_closed(drawing, crossing), drawing.trace.program.steps[crossing.number]
    kind, letter = construction(step), step.name or crossing.name
    if group is not None and group.locus:
        letter = group.locus
    elif isinstance(kind, TriangleComponent):
        letter = kind.letter(drawing, step.role)
        if not any(drawing.symbol(letter) in said.markup for said in sentences(drawing)):
            return (drawing.words("page.crossing_for", a=kind.symbol(drawing)),) * 2
    return drawing.symbol(letter), drawing.symbol(without_index(letter))
