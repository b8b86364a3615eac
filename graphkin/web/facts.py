"""The facts below the drawings: tables of results, data, and the quantities asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import length_scale
from graphkin.construction.core.quantities import names_asked
from graphkin.construction.result_tables import slide_rows, slide_sense, turning_rows, vector_rows
from graphkin.documents.sheet import asked_words, members, plan_at
from graphkin.scene.link_points import lettered
from graphkin.writers.templates import marked_up

SLIDES = {"velocity": "slide", "acceleration": "slide acceleration"}
"""The quantity asked for of a block on each sheet."""


class ResultTable(Struct, frozen=True):
    """A table of results: rows by the name of their quantity, and the names that are asked for."""

    kind: str
    caption: str
    head: Sequence[str]
    rows: Sequence[tuple[str, tuple[str, ...]]]
    asked: frozenset[str]


def results(drawing: Drawing) -> Iterator[ResultTable]:
    """The tables of a sheet: vectors of the plan, angular values, sliding values."""
    words = drawing.words
    unit, rate = words(f"table.{drawing.kind}"), words(f"table.{drawing.rate.target}")
    first, millimetres, sense = (
        words(f"table.{key}") for key in ("symbol", "millimetres", "sense")
    )
    asked_for = asked_rows(drawing)
    names = {f"slide {block}": name for name, block in blocks_asked(drawing).items()}
    kinds = (
        (
            "vectors",
            "screen.vectors",
            (first, words("table.segment"), millimetres, unit),
            vector_rows,
        ),
        ("turns", "screen.turns", (first, rate, sense), turning_rows),
        ("slides", "screen.slides", (first, unit, sense), slide_rows),
    )
    for kind, key, head, rows in kinds:
        found = [(names.get(row.name, row.name), row.cells) for row in rows(drawing, empty=False)]
        if found:
            yield ResultTable(kind, words(key), head, found, asked_for)


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


def wanted(drawing: Drawing) -> tuple[str, str, list[str]]:
    """The scales of a task, the scale of its plan, and the quantities it asks for, one by one."""
    words, kL = drawing.words, f"{length_scale(drawing)} m/mm"
    scale = words("task.to_scale", scale=words.decimal(drawing.scales.words), kL=kL)
    return scale, plan_at(drawing), [*asked_words(drawing), members(drawing)]
