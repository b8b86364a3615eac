"""Every shipped scene has its title in every language, and each has room on the pages."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import pytest
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.sheet import LETTERS, title_line
from graphkin.drawing.field import SheetPaper, paper_of
from graphkin.drawing.frame import TitleBlock, cells_of, page_frame, title_block_marks
from graphkin.drawing.marks import Mark, Text, reach
from graphkin.drawing.symbol_markup import escape
from graphkin.scene.model import Scene
from graphkin.scene.read_scene import read_scene
from graphkin.scene.scene_files import SCENE, shelf
from graphkin.text import LANGUAGES, words
from tests.chosen import FOLDER
from tests.documents.sheet_tools import drawings

PAPERS = (("A3", "ISO"), ("A4", "ISO"), ("A3", "GOST"), ("ANSI B", "ISO"))
"""A paper for each shape of the title block and of the title above the data."""
WHOLE = ("positions", "velocity_plans", "acceleration_plans", "force_plans", "differentiation")
"""Kinds of sheets of a whole motion, whose titles are longest."""
APART = 0.35
"""The least distance of a title from its label and from the edges of its cell, in mm."""
FILES = (*sorted(shelf().glob(f"*/{SCENE}")), *sorted(FOLDER.glob("*.toml")))


@cache
def shipped_scenes() -> tuple[Scene, ...]:
    """The scenes of the shipped labs and the example scenes."""
    return tuple(read_scene(path) for path in FILES)


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_a_shipped_scene_has_its_title_and_notes_in_every_language(path):
    scene = read_scene(path)
    assert scene.titles.keys() == {*LANGUAGES}
    assert scene.titles["en"] == scene.title
    assert not scene.notes or scene.notes.keys() == {*LANGUAGES}
    for said in (*scene.titles.values(), *scene.notes.values()):
        assert said == said.strip() and not said.endswith(".")
    for title in scene.titles.values():
        assert title[0].isupper()


def within(marks: list[Mark], left: float, top: float, right: float, low: float) -> bool:
    """Whether marks are in a rectangle."""
    boxes = [reach(mark) for mark in marks]
    return all(left <= a and top <= b and c <= right and d <= low for a, b, c, d in boxes)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("paper", "frame"), PAPERS)
def test_a_title_fits_its_cell_below_the_label_in_every_language(paper, frame, language):
    own, label = paper_of(paper, frame).frame, words(language)("block.title")
    for scene in shipped_scenes():
        block = TitleBlock(title=scene.titles[language], frame=own, labels={"title": label})
        ((left, top, right, low),) = (rect for name, rect, _ in cells_of(block) if name == "title")
        marks = [mark for mark in title_block_marks(block, 0, 0) if isinstance(mark, Text)]
        said = [mark for mark in marks if mark.name == "title"]
        heads = [reach(mark)[3] for mark in marks if mark.markup == label and not mark.name]
        assert within(said, left, max([top, *heads]) + APART, right, low - APART), scene.name
        assert min(mark.height for mark in said) >= LETTERS, scene.name
        for first, second in pairwise(said):
            assert reach(second)[1] - reach(first)[3] > 0, scene.name


def titled(scene: Scene, language: str, paper: str, frame: str) -> Drawing:
    """A drawing with the titles of a scene on a paper."""
    drawing = drawings("pump", 7)[0]
    sheet = replace(drawing.scene.sheet, paper=paper, frame=frame)
    own = replace(drawing.scene, titles=scene.titles, sheet=sheet)
    return replace(drawing, scene=own, words=words(language))


def faults(paper: SheetPaper, marks: list[Mark], low: float) -> list[Mark]:
    """The lines of a title that leave its room, are too small, or touch the data or the bar."""
    said = [mark for mark in marks if isinstance(mark, Text) and mark.name == "title"]
    others = [reach(mark) for mark in marks if mark not in said]
    found = []
    for mark in said:
        left, top, right, bottom = reach(mark)
        touching = any(left < c and a < right and top < d and b < bottom for a, b, c, d in others)
        wide = right - left > paper.title + 0.1
        if touching or wide or top < paper.area[1] or bottom > low or mark.height < LETTERS:
            found.append(mark)
    return found


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("paper", "frame"), PAPERS)
def test_a_title_above_the_data_has_room_in_every_language(paper, frame, language):
    for scene in shipped_scenes():
        drawing = titled(scene, language, paper, frame)
        said = drawing.words
        whole = max((said(f"sheet.{kind}") for kind in WHOLE), key=len)
        for remark, named in (("", ""), (said("page.continued"), ""), ("", whole)):
            marks, _, y = title_line(drawing, remark, named)
            wrong = faults(drawing.paper, marks, y - LETTERS)
            assert not wrong, (scene.name, remark, named, wrong)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_title_heads_a_calculation_in_every_language(language):
    name = words(language)("sheet.document_calculation", view=words(language)("sheet.key"))
    for scene in shipped_scenes():
        page_frame((escape(scene.titles[language]), name))
