"""Sheets on every paper: its size, its frame, nothing outside it, scales that fill its fields."""

from __future__ import annotations

import io
import re
from itertools import product
from pathlib import Path
from xml.etree import ElementTree

import pypdf
import pytest

from graphkin.classroom.printing.personal import owner
from graphkin.classroom.roster.students import Student, Taker
from graphkin.construction.core.layout import lay_out
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet_documents import drawings_of, hand_out, language_of, proved
from graphkin.drawing.field import A3, CODE, paper_of
from graphkin.drawing.frame import STUDENT, TitleBlock, cells_of, title_block_marks
from graphkin.drawing.marks import LineMark, Polyline, Text, reach
from graphkin.mechanism import Mechanism, load
from graphkin.scene.house import FRAMES, PAPERS, house_of
from graphkin.scene.read_scene import read_scene, read_text
from graphkin.text import LANGUAGES, words
from graphkin.text.errors import HouseError, SceneError
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import write_svg
from tests.chosen import by_turns

VIEWS = ("key", "task", "steps", "overlay", "positions", "diagrams")
OTHERS = [name for name in PAPERS if name != "A3"]
OUTSIDE = ("field", "size", "border", "centring-mark", "crop", "corner", "frame")


def on(paper: str, name: str = "pump", more: str = "") -> Mechanism:
    """A scene of a school that has only one paper."""
    house = house_of(f'graphkin = 1\n[pages]\npaper = "{paper}"\nlanguage = "en"\n{more}', ".")
    return Mechanism(read_scene(load(name).scene.source, house=house))


def pages_on(paper: str, view: str, name: str = "pump", more: str = ""):
    """The drawn pages of a view."""
    parts = hand_out(on(paper, name, more), view)
    return [page for part in parts if part.kind != "calculation" for page in part.pages]


@pytest.mark.parametrize("view", ["key", "task"])
def test_calculations_of_a_school_with_ansi_papers_are_on_letter(view: str) -> None:
    for paper, size in (("ANSI B", (215.9, 279.4)), ("A2", (210.0, 297.0))):
        (part,) = (each for each in hand_out(on(paper), view) if each.kind == "calculation")
        for page in part.pages:
            assert (page.width, page.height) == size
            boxes = [reach(mark) for mark in page.marks]
            sides = min(box[0] for box in boxes), size[0] - max(box[2] for box in boxes)
            assert sides[0] - 10 == pytest.approx(sides[1], abs=0.1)  # the filing margin
            assert max(box[3] for box in boxes) < size[1] - 9


@pytest.mark.parametrize(
    ("paper", "view"), sorted({*product(["A4"], VIEWS), *by_turns(OTHERS, VIEWS)})
)
def test_every_view_is_drawn_on_papers_within_its_frame(paper: str, view: str) -> None:
    """Every view on the smallest, and on each other paper one of them."""
    size, own = PAPERS[paper], paper_of(paper, "ISO").leaf
    left, top, right, low = own.area
    for page in pages_on(paper, view):
        page.check()
        assert (page.width, page.height) == size
        for mark in page.marks:
            if mark.name in OUTSIDE or mark.cls.split()[0] in OUTSIDE:
                continue
            x1, y1, x2, y2 = reach(mark)
            assert left <= x1 + 0.01 and x2 <= right + 0.01, mark
            assert top <= y1 + 0.01 and y2 <= low + 0.01, mark


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_leaf_holds_its_texts_in_every_language(language: str) -> None:
    left, top, right, low = paper_of("A4", "ISO").leaf.area
    for part in hand_out(on("A4"), "task", language)[:2]:
        for page in part.pages:
            for mark in page.marks:
                if isinstance(mark, Text) and mark.cls.split()[0] not in OUTSIDE:
                    x1, y1, x2, y2 = reach(mark)
                    assert left <= x1 and x2 <= right and top <= y1 and y2 <= low, mark.markup


@pytest.mark.parametrize("name", ["pump", "slotted-lever"])
def test_the_tables_of_a_task_on_a4_are_beside_its_code(name: str) -> None:
    """No sheet to draw on is continued for its tables alone, and rows to fill in are 7 mm high."""
    for part in hand_out(on("A4", name), "task", "fr")[:2]:
        assert len(part.pages) == 2
        heads = [m for m in part.pages[1].marks if isinstance(m, Polyline) and m.cls == "shade"]
        assert len(heads) >= 2
        corner = part.pages[1].width - 12 - CODE, paper_of("A4", "ISO").blocks[0][1] - 1 - CODE
        lines = [m for m in part.pages[1].marks if isinstance(m, LineMark) and m.cls == "panel"]
        assert not any(reach(m)[2] > corner[0] and reach(m)[3] > corner[1] for m in lines[1:])


def test_a_construction_on_a4_goes_on_below_the_tables() -> None:
    part = hand_out(on("A4"), "key", "ro")[0]
    said = [[m.markup for m in page.marks if isinstance(m, Text)] for page in part.pages]
    numbers = [[line for line in lines if re.fullmatch(r"\d+\.", line)] for lines in said]
    assert words("ro")("page.goes_below") in said[0]
    assert len(said) == 2 and numbers[1]
    assert [*numbers[0], *numbers[1]] == [f"{i}." for i in range(1, 11)]


@pytest.mark.parametrize("paper", PAPERS)
def test_files_have_the_size_of_the_paper(paper: str) -> None:
    page = pages_on(paper, "task")[0]
    width, height = PAPERS[paper]
    root = ElementTree.fromstring(write_svg(page))
    assert (root.get("width"), root.get("height")) == (f"{width:g}mm", f"{height:g}mm")
    assert [float(side) for side in re.split("[ ,]", root.get("viewBox"))] == [0, 0, width, height]
    (found,) = pypdf.PdfReader(io.BytesIO(write_pdf([page]))).pages
    assert [float(side) * 25.4 / 72 for side in found.mediabox[2:]] == pytest.approx(
        [width, height], abs=0.01
    )


@pytest.mark.parametrize("paper", PAPERS)
def test_every_page_to_draw_on_has_a_bar_of_100_mm(paper: str) -> None:
    leaves = paper_of(paper, "ISO").leaves
    for page in pages_on(paper, "task")[:leaves]:
        (bar,) = (m for m in page.marks if m.name == "check-bar" and isinstance(m, LineMark))
        assert bar.x2 - bar.x1 == pytest.approx(100.0)


def test_a_larger_paper_has_a_larger_mechanism_at_a_standard_scale() -> None:
    found = {}
    for paper in ("A4", "A3", "A2", "A1"):
        mechanism = on(paper).measured
        verdict = proved(mechanism, sheet_motion(mechanism))
        first, *_ = drawings_of(mechanism, verdict, language_of(mechanism, "en"))
        found[paper] = first.scales.kL
        field, area = lay_out(first).mechanism.rect, first.paper.fields
        assert area[0] <= field[0] and field[2] <= area[2] and field[3] == area[3]
    assert found["A4"] > found["A3"] > found["A2"] > found["A1"]


def test_a4_has_mechanism_and_plan_on_pages_that_join() -> None:
    """Laid side by side, their frames, fields and lines are level, and the pages are lettered."""
    first, second, *_ = pages_on("A4", "key")
    levels = []
    for page in (first, second):
        frame = next(m for m in page.marks if m.cls == "frame" and isinstance(m, Polyline))
        panel = next(m for m in page.marks if m.cls == "panel" and m.x2 - m.x1 > 150)
        levels.append((reach(frame), panel.y1, {m.y1 for m in page.marks if m.name == "check-bar"}))
    assert levels[0] == levels[1]
    numbers = [next(m.markup for m in p.marks if m.name == "sheet") for p in (first, second)]
    assert [number[:2] for number in numbers] == ["1A", "1B"]
    assert any("link" in m.cls.split() for m in first.marks)
    assert not any("link" in m.cls.split() for m in second.marks)
    assert any("velocity" in m.cls and m.step is not None for m in second.marks)


@pytest.mark.parametrize(
    ("more", "standard"),
    [('frame = "GOST"', "GOST"), ('[signs]\nset = "russian"', "GOST"), ("", "ISO")],
)
def test_the_frame_follows_the_signs_or_the_key(more: str, standard: str) -> None:
    page, *_ = pages_on("A3", "key", more=more)
    words = {m.markup for m in page.marks if isinstance(m, Text)}
    frame = next(m for m in page.marks if m.cls == "frame" and isinstance(m, Polyline))
    assert reach(frame) == paper_of("A3", standard).area
    assert ("Разраб." in words) is (standard == "GOST")
    assert FRAMES == ("ISO", "GOST")


def test_the_cells_of_form_one_are_those_of_the_standard() -> None:
    """GOST 2.104-2006, figure of form 1: 185 × 55 mm, 5 mm from the edges of the sheet."""
    own = paper_of("A3", "GOST")
    assert own.title_block == (230.0, 237.0, 415.0, 292.0)
    assert own.area == (20.0, 5.0, 415.0, 292.0)


@pytest.mark.parametrize(("paper", "frame"), [("A3", "ISO"), ("A4", "GOST"), ("ANSI B", "ISO")])
def test_a_student_has_a_name_on_every_frame(paper: str, frame: str) -> None:
    name = "Анна Иванова-Петрова"
    own = paper_of(paper, frame)
    whose = owner(Taker(Student(1, "7", name=name, group="5"), {}, "CODE"), own)
    assert whose.name == f"{name}, 5"
    block = TitleBlock(
        student=whose.name, labels={STUDENT: "Name"}, frame=own.frame, sheet="1/2", scale="1:5"
    )
    said = [m for m in title_block_marks(block, 0, 0) if m.name == STUDENT]
    left, _, right, _ = next(rect for cell, rect, _ in cells_of(block) if cell == STUDENT)
    assert " ".join(line.markup for line in said) == whose.name
    assert all(left < reach(line)[0] < reach(line)[2] < right for line in said)


def test_the_margins_of_ansi_papers_are_those_of_the_standard() -> None:
    """ASME Y14.1: the area of size B is 15.76 × 10.24 in, that of size C 21 × 15.5 in."""
    for paper, wide, high in (("ANSI B", 15.76, 10.24), ("ANSI C", 21.0, 15.5)):
        left, top, right, low = paper_of(paper, "ISO").area
        assert ((right - left) / 25.4, (low - top) / 25.4) == pytest.approx((wide, high))


def test_an_unknown_paper_is_one_error_that_lists_them() -> None:
    with pytest.raises((HouseError, SceneError)) as caught:
        house_of('graphkin = 1\n[pages]\npaper = "Letter"\n', ".")
    (problem,) = caught.value.problems
    assert problem.place == "pages.paper"
    assert all(name in str(problem) for name in PAPERS)
    with pytest.raises(SceneError) as caught:
        read_text(with_sheet('paper = "A5"'), "own")
    (problem,) = caught.value.problems
    assert problem.place == "sheet.paper" and "ANSI C" in str(problem)


def test_a_scene_goes_before_its_house() -> None:
    house = house_of('graphkin = 1\n[pages]\npaper = "A2"\n', ".")
    assert read_text(with_sheet(""), "own", house=house).sheet.paper == "A2"
    assert read_text(with_sheet('paper = "A4"'), "own", house=house).sheet.paper == "A4"


def with_sheet(more: str) -> str:
    """The text of a scene with some keys in [sheet]."""
    written = Path(load("offset-slider-crank").scene.source).read_text(encoding="utf-8")
    if "[sheet]" in written:
        return written.replace("[sheet]", f"[sheet]\n{more}")
    return f"{written}\n[sheet]\n{more}\n"


def test_a3_is_the_usual_paper() -> None:
    assert (A3.fields, A3.title_block) == ((22, 38, 408, 201), (230, 251, 410, 287))
    assert (A3.below, A3.tables, A3.scheme) == (
        (22, 203, 408, 285),
        (230, 202, 408, 250),
        (150, 210, 226, 281),
    )


@pytest.mark.parametrize("frame", FRAMES)
@pytest.mark.parametrize("name", PAPERS)
def test_the_scheme_of_a_task_is_beside_its_table(name, frame):
    paper = paper_of(name, frame)
    left, _, right, low = paper.scheme
    table = paper.empty_tables
    assert left < right and (right <= table[0] or low <= table[1] or paper.is_leaf)


@pytest.mark.parametrize(
    ("language", "name"), by_turns(LANGUAGES, ["pump-forces", "shaper-forces", "engine-forces"])
)
def test_requests_on_a_leaf_keep_off_the_scheme(language: str, name: str) -> None:
    """A heading or a request wider than the room beside the scheme is divided."""
    for part in hand_out(on("A4", name), "task", language)[:-1]:
        paper = paper_of("A4", "ISO")
        every = [m for m in part.pages[0].marks if isinstance(m, Text) and m.cls == "caption"]
        said = [m for m in every if m.y > paper.foot and not m.name]
        assert said
        assert max(reach(mark)[2] for mark in said) < paper.scheme[0]
