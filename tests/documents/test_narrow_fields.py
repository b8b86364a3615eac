"""Beside a mechanism that takes the whole breadth the plan keeps its caption and its notes."""

from itertools import product

import numpy as np
import pytest

from graphkin.construction.core.layout import lay_out, refuse_wide
from graphkin.documents.sheet import HEADING, caption, headlines, sheet, sheet_heading, title_line
from graphkin.documents.sheet import NAME as DATA
from graphkin.documents.sheet_documents import overlay
from graphkin.drawing.field import A3
from graphkin.drawing.marks import Text, reach
from graphkin.drawing.richtext import are_clear
from graphkin.text import LANGUAGES
from graphkin.text.errors import PageError
from tests.documents.full_scenes import FLAT, TOGGLE, drawings_from
from tests.documents.sheet_tools import collisions, drawings, outside

NARROW = {"flat": FLAT, "toggle": TOGGLE}
EVERY = [*product(NARROW, LANGUAGES, ("key", "task"))]


@pytest.mark.parametrize(("name", "language", "view"), EVERY, ids=str)
def test_captions_and_notes_of_narrow_fields_stay_in_them(name, language, view):
    for drawing in drawings_from(NARROW[name], language):
        layout = lay_out(drawing)
        left, right = layout.mechanism.rect, layout.plan.rect
        for marks, rect in zip(headlines(drawing, layout, view), (left, right), strict=True):
            assert max(reach(mark)[2] for mark in marks) <= rect[2] - 1
        page = sheet(drawing, view, "1/2", layout)[0]
        page.check()
        assert not collisions(page.marks)
        assert not outside(page.marks)
        notes = [m for m in page.marks if isinstance(m, Text) and m.name == "note"]
        for note in notes:
            rect = left if note.x < right[0] else right
            assert reach(note)[2] <= rect[2] - 1, note.markup


@pytest.mark.parametrize("height", [1.8, 2.5, 3.5])
def test_a_caption_ends_in_its_field_and_is_broken_only_where_it_must_be(height):
    """In fields of any breadth, with at least a millimetre and at most five to either edge."""
    said = "Mechanism, scale 1:5  (k_L = 0.005 m/mm; v_B = 0.5 m/s)"
    for width in np.arange(20 * height, 40 * height, 0.7):
        marks = caption(said, (10, 20, 10 + width, 90), height)
        assert " ".join(mark.markup for mark in marks).split() == said.split()
        assert all(11 <= reach(m)[0] <= 15 and reach(m)[2] <= 9 + width for m in marks)
        alone = caption(said, (10, 20, 500, 90), height)
        assert len(alone) == 1
        assert len(marks) > 1 or reach(alone[0])[2] <= 9 + width
        assert len(marks) == 1 or reach(alone[0])[2] > 5 + width


@pytest.mark.parametrize("view", ["key", "task"])
def test_captions_of_both_fields_stand_level_and_above_all_that_is_drawn(view):
    """Guides and loci begin 3 mm below the field's upper edge; both captions have one height."""
    names = ("hart", "shaper", "toggle-press")
    for name, language in product(names, LANGUAGES):
        for drawing in drawings(name, None, language):
            layout = lay_out(drawing)
            first, second = headlines(drawing, layout, view)
            marks = [*first, *second]
            if second:
                assert first[0].y == second[0].y
            assert len({mark.height for mark in marks}) == 1
            assert max(reach(mark)[3] for mark in marks) < layout.mechanism.rect[1] + 2.5


def test_captions_stand_clear_of_data_of_many_lines():
    """Data of more lines than three lower the captions into what the drawings leave free."""
    lines = set()
    names = (("cam-plate-lever", "ro"), ("hoist-differential", "en"), ("gears-three-planets", "it"))
    for name, language in names:
        for drawing in drawings(name, None, language):
            marks = [
                mark for mark in sheet(drawing, "key", "1/2")[0].marks if isinstance(mark, Text)
            ]
            said = {mark.y for mark in marks if mark.name == DATA and mark.cls == "caption"}
            captions = [mark for mark in marks if mark.name == HEADING]
            lines.add(len(said))
            low = max(said, default=0.0)  # data may be on the continuation sheet
            assert min(mark.y - mark.height for mark in captions) - low > 1.4
    assert max(lines) >= 3


@pytest.mark.parametrize(
    ("name", "language"),
    [("crank-slot", "ro"), ("eight-link-2", "it"), ("five-bar", "en"), ("eight-link-2", "ro")],
)
def test_captions_of_both_sheets_have_one_height(name, language):
    both = [
        headlines(drawing, lay_out(drawing), "key") for drawing in drawings(name, None, language)
    ]
    assert len({mark.height for fields in both for marks in fields for mark in marks}) == 1


def test_titles_of_both_sheets_have_one_height_and_stand_level():
    for name in ("plates-coupled", "platform-3rpr"):
        titles = [title_line(drawing) for drawing in drawings(name)]
        assert len({data for _, _, data in titles}) == 1
        assert {marks[0].height for marks, _, _ in titles} == {3.5}


def test_data_of_three_lines_keep_the_height_of_letters_where_signs_would_touch():
    """The square in ω²·kL stands below an index: lines of the acceleration sheet end earlier."""
    for drawing in drawings("plates-ring"):
        said = [mark for mark in sheet_heading(drawing)[0] if mark.name == DATA]
        assert [mark.height for mark in said] == [2.5] * 3
        assert are_clear([mark.markup for mark in said], 2.5, said[1].y - said[0].y)


def test_drawings_wider_than_the_sheet_are_refused():
    with pytest.raises(PageError, match="does not fit"):
        refuse_wide(A3, A3.room, 1.0)


@pytest.mark.parametrize("length", [240, 900])
def test_a_long_title_of_an_overlay_is_smaller_or_refused_as_on_the_key(length):
    drawing, _ = drawings_from(FLAT, title="letters " * (length // 8))
    if length == 240:
        overlay(drawing, "1/2")[0].check()
    else:
        with pytest.raises(PageError, match=r"title block, title: .* does not fit .* shorten"):
            overlay(drawing, "1/2")[0]
