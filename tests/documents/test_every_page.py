"""Every page there is: every student of the labs in every language, every scene in every view.

Nothing stands on anything, nothing leaves the frame, and every vector has its name.
"""

from __future__ import annotations

from functools import cache

import pytest
import shapely

from graphkin.construction.core.layout import Layout, lay_out
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import by_itself, overlay
from graphkin.drawing.marks import Page, Text, reach
from graphkin.scene.scene_files import names
from graphkin.text import LANGUAGES
from tests.chosen import HALVES, STUDENTS
from tests.documents.sheet_tools import (
    VARIANTS,
    Drawn,
    collisions,
    drawings,
    fields_of,
    length_of,
    named,
    off_fields,
    outline,
    outside,
    told,
)
from tests.mechanisms import SHIPPED

TINY = 0.5
"""Vectors shorter than this, in mm, are named at the foot of their field."""
OTHERS = [language for language in LANGUAGES if language != "en"]
"""The languages whose pages are not looked at elsewhere."""
TRANSLATED = [(lab, n, OTHERS[i % 2]) for i, (lab, n) in enumerate(VARIANTS)]
TRANSLATED += [(name, None, OTHERS[i % len(OTHERS)]) for i, name in enumerate(HALVES[1])]
TRANSLATED += [(lab, n, "en") for lab in names() if lab not in SHIPPED for n in STUDENTS[:1]]
VIEWED = [*((lab, 20) for lab in names()), *((name, None) for name in HALVES[0])]
"""Tests/golden tells any view of the others that changes."""


def faults(page: Page) -> str:
    """What is wrong with a page, a line each."""
    return "\n".join([*collisions(page.marks), *outside(page.marks)])


@cache
def layouts(name: str, n: int | None) -> tuple[Layout, ...]:
    """The layout of each sheet, which no language changes."""
    return tuple(lay_out(drawing) for drawing in drawings(name, n))


@pytest.mark.parametrize("which", TRANSLATED, ids=named)
def test_in_every_language_nothing_stands_on_anything(which):
    name, n, language = which
    for drawing, layout in zip(drawings(name, n, language), layouts(name, n), strict=True):
        page = sheet(drawing, "key", "1/2", layout)[0]
        found = Drawn(drawing, layout, page, fields_of(drawing, page))
        assert not faults(page), faults(page)
        assert not crossed(page), crossed(page)
        assert not off_fields(found), off_fields(found)
        assert not unnamed(found)


def unnamed(page: Drawn) -> list[str]:
    """Vectors without a label, a note or an enlarged detail that names them.

    A note names several, separated by commas.
    """
    found = set()
    notes = [each for each in map(page.notes, ("mechanism", "plan")) if each]
    for field in ("mechanism", "plan"):
        for label in page.labels(field):
            found |= {*page.called(field, label), label.text.name}
    vectors = [mark for field in ("mechanism", "plan") for mark in page.vectors(field)]
    left = [
        mark.name
        for mark in vectors
        if mark.name not in found and not (length_of(mark) < TINY and notes)
    ]
    noted = sum(each.count(",") + 1 for each in notes)
    return left if len(left) > noted else []


def crossed(page: Page) -> list[str]:
    """Words of a page, outside of its drawings, that a line of its frame or its tables crosses."""
    lines = [m for m in page.marks if m.cls.split()[0] in ("frame", "panel", "title")]
    edges = [outline(m) for m in lines if not isinstance(m, Text)]
    words_ = [m for m in page.marks if isinstance(m, Text) and m.cls in ("caption", "table")]
    boxes = [shapely.box(*reach(text)) for text in words_]
    which, _ = shapely.STRtree(edges).query(boxes, predicate="intersects")
    return [told(words_[i]) for i in which]


@pytest.mark.parametrize("which", VIEWED, ids=named)
def test_in_every_view_nothing_stands_on_anything(which):
    for drawing, layout in zip(drawings(*which), layouts(*which), strict=True):
        last = by_itself(drawing, "steps", "1/2")[-1]
        assert not faults(last), faults(last)
        assert not crossed(last), crossed(last)
        for page in (overlay(drawing, "1/2")[0], sheet(drawing, "task", "1/2", layout)[0]):
            on, off = collisions(page.marks), outside(page.marks)
            off = [mark for mark in off if " crop " not in mark and " corner " not in mark]
            assert not on and not off, on + off
