"""Every page there is: every student of the labs in every language, every scene in every view.

Nothing stands on anything, nothing leaves the frame, and every vector has its name.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import pytest
import shapely

from graphkin.construction.core.layout import Layout, lay_out
from graphkin.construction.result_tables import SLID, TURNS, VECTORS
from graphkin.documents.overlay import overlay
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawn as pages_of
from graphkin.drawing.columns import SMALL
from graphkin.drawing.marks import Page, Text, reach
from graphkin.drawing.richtext import extent
from graphkin.drawing.style import BRIEF, NOW, SHAFT, STYLES, style_of
from graphkin.scene.scene_files import names
from graphkin.text import LANGUAGES, words
from tests.chosen import CHOSEN, STUDENTS
from tests.documents.sheet_tools import (
    VARIANTS,
    Drawn,
    collisions,
    drawings,
    drawn,
    fields_of,
    half_width,
    is_vector,
    kinds_of,
    labels_of,
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
TRANSLATED = [(lab, n, language) for lab, n in VARIANTS for language in OTHERS]
TRANSLATED += [(name, None, OTHERS[i % len(OTHERS)]) for i, name in enumerate(CHOSEN)]
TRANSLATED += [(lab, n, "en") for lab in names() if lab not in SHIPPED for n in STUDENTS[:2]]
VIEWED = [(lab, n) for lab in names() for n in (1, 20)]
VIEWED += [(name, None) for name in CHOSEN]


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
        page = sheet(drawing, "key", "1/2", layout)
        found = Drawn(drawing, layout, page, fields_of(drawing, page))
        assert not faults(page), faults(page)
        assert not crossed(page), crossed(page)
        assert not off_fields(found), off_fields(found)
        assert not unnamed(found)


def unnamed(page: Drawn) -> list[str]:
    """Vectors without a label, a note or an enlarged detail that names them."""
    found = set()
    notes = " ".join(m.markup for m in page.page.marks if isinstance(m, Text) and m.name == "note")
    for field in ("mechanism", "plan"):
        for label in page.labels(field):
            found |= {*label.names(), label.text.name}
    vectors = [mark for field in ("mechanism", "plan") for mark in page.vectors(field)]
    return [
        mark.name
        for mark in vectors
        if mark.name not in found and not (length_of(mark) < TINY and notes)
    ]


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_heading_of_a_table_fits_its_column(language):
    say = words(language)
    columns = {
        VECTORS: ("symbol", "segment", "millimetres", "acceleration"),
        TURNS: ("symbol", "epsilon", "sense"),
        SLID: ("symbol", "acceleration", "sense"),
    }
    for widths, keys in columns.items():
        for width, key in zip(widths, keys, strict=True):
            assert extent(say(f"table.{key}"), SMALL)[0] <= width - 1, key


def crossed(page: Page) -> list[str]:
    """Words of a page, outside of its drawings, that a line of its frame or its tables crosses."""
    lines = [m for m in page.marks if m.cls.split()[0] in ("frame", "panel", "title")]
    edges = [outline(m) for m in lines if not isinstance(m, Text)]
    words_ = [m for m in page.marks if isinstance(m, Text) and m.cls in ("caption", "table")]
    return [told(text) for text in words_ for edge in edges if edge.intersects(box_of(text))]


def box_of(text: Text) -> shapely.Polygon:
    """The box around the letters of a text."""
    return shapely.box(*reach(text))


@pytest.mark.parametrize("which", VIEWED, ids=named)
def test_in_every_view_nothing_stands_on_anything(which):
    for drawing, layout in zip(drawings(*which), layouts(*which), strict=True):
        last = pages_of(drawing, "steps", "1/2")[-1]
        assert not faults(last), faults(last)
        assert not crossed(last), crossed(last)
        for page in (overlay(drawing, "1/2", layout), sheet(drawing, "task", "1/2", layout)):
            on, off = collisions(page.marks), outside(page.marks)
            off = [mark for mark in off if " crop " not in mark and " corner " not in mark]
            assert not on and not off, on + off


@pytest.mark.parametrize("which", VIEWED[:: len(VIEWED) // 12], ids=named)
def test_the_overlay_names_what_the_key_names(which):
    for drawing, layout in zip(drawings(*which), layouts(*which), strict=True):
        over = overlay(drawing, "1/2", layout)
        vectors = {m.name for m in over.marks if is_vector(m) and length_of(m) >= TINY}
        assert vectors <= {label.text.name for label in labels_of(over.marks)} | {
            name for label in labels_of(over.marks) for name in label.names()
        }


def test_every_mark_is_as_wide_as_its_class_declares():
    """Line group 0.5 of ISO 128, and thinner for what only helps; each class is declared."""
    widths = {0.13, 0.18, 0.25, 0.35, 0.4, 0.5, 0.7}
    assert {style.width for style in STYLES.values()} - {0} <= widths
    for name in CHOSEN:
        for kind in kinds_of(name):
            for mark in drawn(name, None, kind).page.marks:
                first = mark.cls.split()[0]
                assert first in STYLES, mark.cls
                width = STYLES[first].width
                assert 2 * half_width(mark) == (SHAFT if BRIEF in mark.cls.split() else width)
                assert NOW not in mark.cls.split()


def test_lines_that_help_are_thinner_than_what_they_help_to_find():
    order = ("trial", "construction", "relative-velocity", "velocity", "link")
    for one, other in pairwise(order):
        assert style_of(one).width < style_of(other).width
