"""The facts below the drawings: tables of results, data, and the quantities asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.quantities import names_asked
from graphkin.construction.result_tables import result_tables, slide_sense
from graphkin.documents.relations import travel_words
from graphkin.documents.sheet import asked_words, members, plan_at
from graphkin.scene.link_points import lettered
from graphkin.text.tables import CellTable
from graphkin.writers.templates import marked_up

SLIDES = {"velocity": "slide", "acceleration": "slide acceleration"}
"""The quantity asked for of a block on each sheet."""


def results(drawing: Drawing, found: Mapping[str, int]) -> Iterator[CellTable]:
    """The tables of a sheet; ``found`` says at which step of the page each row is known."""
    of_motion = drawing.kind in SLIDES
    asked = asked_rows(drawing) if of_motion else frozenset()
    blocks = blocks_asked(drawing) if of_motion else {}
    names = {f"slide {block}": name for name, block in blocks.items()}
    for table in result_tables(drawing, empty=False):
        rows = [names.get(row.name, row.name) for row in table.rows]
        yield replace(
            table,
            caption=drawing.words(f"screen.{table.kind}") if of_motion else "",
            marks=[
                {"data-row": name, "data-found": str(found[name])}
                | ({"data-asked": True} if name in asked else {})
                for name in rows
            ],
        )


def blocks_asked(drawing: Drawing) -> dict[str, str]:
    """The blocks that are asked for, by row names that no other sheet uses."""
    return {f"{SLIDES[drawing.kind]} {block}": block for block in drawing.scene.ask.slides}


def asked_rows(drawing: Drawing) -> frozenset[str]:
    """The names of the rows that the scene asks for."""
    ask, vector, rate = drawing.scene.ask, drawing.vector, drawing.rate
    return frozenset(
        (
            *(f"{vector.letter}_{lettered(point)}" for point in names_asked(ask, vector)),
            *(f"{rate.letter}{link}" for link in names_asked(ask, rate)),
            *blocks_asked(drawing),
        )
    )


def senses(drawing: Drawing) -> dict[str, tuple[str, str]]:
    """The words for both senses along the guide, for each block's row on either sheet."""
    return {
        f"{what} {block}": (
            marked_up(slide_sense(drawing, block, 1.0)),
            marked_up(slide_sense(drawing, block, -1.0)),
        )
        for block in drawing.scene.ask.slides
        for what in SLIDES.values()
    }


def scales_told(drawing: Drawing) -> tuple[str, str]:
    """The scale at which a task is drawn, and that of its plan."""
    words = drawing.words
    scale: str = words("task.to_scale", scale=words.decimal(drawing.scales.words))
    return scale, plan_at(drawing)


def wanted(drawings: Sequence[Drawing]) -> list[str]:
    """The quantities that a task asks for, one by one, and the links by their points."""
    asked = [piece for each in drawings for piece in asked_words(each)]
    return [*asked, *travel_words(drawings[0]), members(drawings[0])]
