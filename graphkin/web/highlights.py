"""What a page highlights next to the strokes of a step: turning links and similar triangles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from graphkin.construction.centres.instant_centre import AccelerationPole
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.program import plan_vector
from graphkin.construction.forces.force_drawing import ForceDrawing, balance_rows, sorted_sides
from graphkin.construction.plan import TurningOfLink
from graphkin.construction.rate_relations import of_turning
from graphkin.documents.step_pages import BODY
from graphkin.drawing.marks import CircleMark, Text, style_class
from graphkin.drawing.style import DRAWN
from graphkin.web.facts import SLIDES
from graphkin.web.protocol import PageProtocol
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.writers.templates import marked_up

BODIES = tuple(set(BODY) - {"number", "label", "leader"})
"""The classes of bars and plates."""
HIDDEN = {*DRAWN, "detail", "note", "caption"}
"""The classes that the beginning does not show: the construction."""


def rates(
    sheets: Sequence[ScreenSheet], protocol: PageProtocol
) -> dict[int, list[dict[str, object]]]:
    """The rates that each sentence reads off, by the number of the sentence.

    Each rate has its row, its formula, and its sense as drawn. It has the ids of its link's marks
    and of the ring around the link's number, the ends of its bar, and its vector.
    """
    found: dict[int, list[dict[str, object]]] = {}
    for at, said in enumerate(protocol.said, 1):
        drawing = sheets[said.sheet].drawing
        for link in said.rates:
            body, number = marks_of_link(protocol, said.sheet, link)
            one: dict[str, object] = {
                "row": f"{drawing.rate.letter}{link}",
                "text": spoken_rate(drawing, link),
                "sense": float(drawing.turning(link) or 0.0),
                "body": body,
                "number": number,
            }
            step = drawing.trace.program.targets[drawing.rate.target, link]
            kind = construction(drawing.trace.program.steps[step])
            if isinstance(kind, TurningOfLink):
                one |= {"bar": kind.places, "vector": vector_of(drawing, kind)}
            found.setdefault(at, []).append(one)
    return found


def spoken_rate(drawing: Drawing, link: str) -> str:
    """The formula for the rate of a link, in symbols, as HTML."""
    name = drawing.symbol(f"{drawing.rate.letter}_{link}")
    relation = next(each for each in of_turning(drawing) if each.left == name)
    return marked_up(f"{name} = {relation.symbols}" if relation.symbols else name)


def marks_of_link(protocol: PageProtocol, sheet: int, link: str) -> tuple[list[str], str]:
    """The ids of the bars and plates of a link on a sheet, and of the ring around its number."""
    body, number = [], ""
    for k, timed in enumerate(protocol.timed[sheet]):
        if timed.mark.name == link:
            look = style_class(timed.mark)
            if look in BODIES:
                body.append(f"m{sheet}-{k}")
            elif look == "number" and isinstance(timed.mark, CircleMark):
                number = f"m{sheet}-{k}"
    return body, number


def vector_of(drawing: Drawing, kind: TurningOfLink) -> int | None:
    """The step that draws the relative vector over the bar; None without such a step."""
    names = {kind.vector(kind.index), kind.vector(kind.p + kind.q)}
    for number, step, _ in drawing.steps(drawing.plane):
        vector = plan_vector(step)
        if vector is not None and vector.symbol in names:
            return number
    return None


def triangles(sheets: Sequence[ScreenSheet]) -> dict[int, list[list[int]]]:
    """The corners of the similar triangles that find each acceleration pole.

    They are the pole and points of the mechanism, then the pole of the plan and images.
    """
    found = {}
    for sheet in sheets:
        for number, value in enumerate(sheet.drawing.trace.program.steps):
            kind = construction(value)
            if not isinstance(kind, AccelerationPole) or kind.found != number or kind.o is None:
                continue
            if number in sheet.drawing.trace.values and kind.is_by_hand(sheet.drawing):
                found[number] = [[number, *kind.places], [kind.o, *kind.images]]
    return found


def ghosts(sheet: ScreenSheet, protocol: PageProtocol) -> list[int]:
    """The numbers of the marks of the mechanism on the first sheet, without the construction."""
    curves = {curve.name for curve in sheet.drawing.curves}
    found = []
    for k, timed in enumerate(protocol.timed[0][: len(sheet.left)]):
        if timed.mark.name in curves:
            continue
        looks = timed.mark.cls.split()
        if isinstance(timed.mark, Text):
            looks = looks[1:] or looks
        elif looks[0] in ("leader", "arrowhead"):
            looks = looks[1:]
        if timed.at and not HIDDEN & {*looks}:
            found.append(k)
    return found


def rows_found(sheets: Sequence[ScreenSheet], protocol: PageProtocol) -> dict[str, int]:
    """The sentence that finds the quantity of each row of the tables of results."""
    found: dict[str, int] = {}
    for place, sheet in enumerate(sheets):
        last = protocol.bounds(place)[1]
        if isinstance(sheet.drawing, ForceDrawing):
            sides = sorted_sides(sheet.drawing)
            found |= {row: protocol.at.get(step, last) for row, (_, step) in sides.items()}
            found |= {row.name: last for row in balance_rows(sheet.drawing, empty=True)}
            continue
        for row, step in steps_of_rows(sheet.drawing):
            is_given = not sheet.drawing.trace.program.steps[step].args
            found.setdefault(row, 0 if is_given else protocol.at.get(step, last))
    for at, some in rates(sheets, protocol).items():
        found |= {str(one["row"]): at for one in some}
    return found


def steps_of_rows(drawing: Drawing) -> Iterator[tuple[str, int]]:
    """The rows of a sheet's tables, each with the step that holds or draws its quantity."""
    for number, step, _ in drawing.steps(drawing.plane):
        vector = plan_vector(step)
        if vector is not None:
            yield vector.symbol, number
    targets: Mapping[tuple[str, str], int] = drawing.trace.program.targets
    for (what, name), number in targets.items():
        if what == drawing.rate.target:
            yield f"{drawing.rate.letter}{name}", number
        elif what == drawing.sliding.target:
            yield f"{SLIDES[drawing.kind]} {name}", number
