"""The numbers next to the drawings: readings, flat crossings, and the verdict."""

from __future__ import annotations

from cmath import isnan
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import chain
from math import degrees
from typing import Any

from msgspec.structs import replace

from graphkin.construction.core.crossings import Crossing
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import Part
from graphkin.construction.core.quantities import CENTRES, Whose, motion_value, names_asked
from graphkin.construction.core.solution import Solution, Verdict
from graphkin.construction.result_tables import NUMBERS, result_tables, unread
from graphkin.documents.centre_tables import breadth_of, place_of, with_blocks
from graphkin.documents.flattest import crossings_on
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.plane import Ratio
from graphkin.scene.link_points import lettered, point_of
from graphkin.scene.model import Scene
from graphkin.text import Words
from graphkin.text.tables import NOISE, CellTable, Row
from graphkin.writers.templates import from_template, tables_html

FLATTEST = 6
"""Number of crossings shown."""
FLAT, SLANTED = 15.0, 30.0
"""Angles in degrees below which a crossing is unfairly flat, and below which it is poor."""
WHERE = {
    Part.POSITION: "studio.in_mechanism",
    Part.VELOCITY: "sheet.velocity",
    Part.NORMAL: "studio.in_triangle",
    Part.ACCELERATION: "sheet.acceleration",
    Part.CENTRE: "studio.in_centre",
    Part.POLE: "studio.in_pole",
}
"""The words for the place of a crossing."""


def results(drawings: Sequence[Drawing], solution: Solution) -> str:
    """The results as HTML: notes, then vectors, angular values, sliding values and centres.

    The notes say what is asked for but cannot be read off.
    """
    notes = [note for drawing in drawings for note in unread(drawing, drawing.symbol)]
    said = from_template("studio/web/notes.html", notes=notes)
    found = [table for drawing in drawings for table in read_off(drawing, solution)]
    found += places(drawings[0].scene, solution, drawings[0].words)
    return f"{said}{tables_html(found)}"


def read_off(drawing: Drawing, solution: Solution) -> Iterator[CellTable]:
    """The tables of one sheet, with a dash for each value without a reliable digit."""
    words, lost = drawing.words, losses(drawing, solution)
    plan = words(f"sheet.{drawing.kind}")
    captions = {"vectors": plan, "turns": words("studio.turning_of", plan=plan)}
    captions["slides"] = words("studio.sliding_of", plan=plan)
    for table in result_tables(drawing, empty=False):
        heads = NUMBERS[table.kind][0]
        dashes = ("–",) * (len(table.heads) - heads)
        rows = [
            replace(row, cells=(*row.cells[:heads], *dashes)) if lost(row.name) else row
            for row in table.rows
        ]
        yield replace(table, rows=rows, caption=captions[table.kind], kind="")


def losses(drawing: Drawing, solution: Solution) -> Callable[[str], bool]:
    """A test for rows of a sheet's tables without a reliable digit, that is NaN in the solution.

    Vectors that the solution does not hold, such as relative vectors, are reliable if everything in
    the solution is.
    """
    parts = (
        (f"{drawing.vector.letter}_", drawing.vector, solution.points),
        (drawing.rate.letter, drawing.rate, solution.links),
        ("slide ", drawing.sliding, solution.slides),
    )
    known = {
        f"{start}{name}": motion_value(motion, quantity)
        for start, quantity, motions in parts
        for name, motion in motions.items()
    }
    sure = {name: not isnan(value) for name, value in known.items() if value is not None}
    return lambda name: not sure.get(name, all(sure.values()))


def places(scene: Scene, solution: Solution, words: Words) -> Iterator[CellTable]:
    """The places of the centres and poles that are asked for, in the unit of the scene."""
    full, breadth, unit = with_blocks(scene, solution), breadth_of(solution), scene.units["length"]
    asked: list[tuple[str, Ratio | None, Whose]] = []
    for quantity in CENTRES:
        motions: Mapping[str, Any] = getattr(full, quantity.whose)
        for name in names_asked(scene.ask, quantity):
            own = point_of(scene, name) if quantity.whose == "points" else name
            found = motion_value(motions[own], quantity) if own in motions else None
            ratio = solution.centres.get(own, found)
            asked.append((f"{quantity.letter}_{lettered(own)}", ratio, quantity.whose))
    rows = []
    for name, ratio, whose in asked:
        at = place_of(ratio, breadth)
        cells: tuple[str, str] = (words("calculation.at_infinity"), "")
        if at is not None and isnan(at):
            cells = ("–", "–")
        elif at is not None:
            metre, least = scene.unit_length, NOISE * breadth
            x, y = (0.0 if abs(part) < least else part / metre for part in (at.real, at.imag))
            cells = (words.significant(x, 5), words.significant(y, 5))
        elif whose == "points":
            cells = (words("calculation.no_curvature"), "")
        elif ratio is None or ratio.shift == 0:
            cells = (words("calculation.everywhere"), "")
        rows.append(Row((symbol(name), *cells)))
    head = (words("table.symbol"), f"*x*, {unit}", f"*y*, {unit}")
    yield CellTable(head, rows, words("studio.places"))


def margins(drawings: Sequence[Drawing]) -> str:
    """The flattest crossings, with the effect of one millimetre of pencil error."""
    words = drawings[0].words
    found = chain.from_iterable(crossings_on(drawing) for drawing in drawings)
    worst = sorted(found, key=lambda crossing: crossing.angle)[:FLATTEST]
    keys = ("studio.crossing", "studio.drawn_in", "studio.angle", "studio.pencil")
    head = tuple(map(words, keys))
    rows = [margin_row(crossing, words) for crossing in worst]
    looks = [{"class": look} if (look := look_of(crossing)) else {} for crossing in worst]
    return str(tables_html([CellTable(head, rows, words("studio.margins"), marks=looks)]))


def margin_row(crossing: Crossing, words: Words) -> Row:
    """One crossing: its letter, its place, its angle, and the effect of a millimetre."""
    angle = words.fixed(degrees(crossing.angle), 1)
    factor = words.significant(crossing.factor, 2)
    flat = f" ({words('studio.flat')})" if look_of(crossing) == "flat" else ""
    where = words(WHERE.get(crossing.part, "studio.in_mechanism"))
    return Row((symbol(crossing.name, signs=words.signs), where, f"{angle}°{flat}", f"{factor} mm"))


def look_of(crossing: Crossing) -> str:
    """The class of a crossing: flat, slanted, or empty."""
    angle = degrees(crossing.angle)
    return "flat" if angle < FLAT else "slanted" if angle < SLANTED else ""


def verdict_words(verdict: Verdict, scene: Scene, words: Words) -> str:
    """The verdict of the independent route, and the largest difference allowed."""
    difference = words.significant(verdict.largest_difference, 2)
    limit = words.significant(verdict.limit, 2)
    if verdict.agrees:
        said = words("page.verified", difference=difference)
        return f"{said} ({words('studio.limit', limit=limit)})"
    found = {"difference": difference, "limit": limit, "where": verdict.quantity}
    says = [words("studio.disagrees", **found)] if verdict.differs else []
    if verdict.branches:
        stated = verdict.not_as_stated(scene.branches)
        says.append(words("studio.not_as_stated", branches=stated))
    return " ".join(says)
