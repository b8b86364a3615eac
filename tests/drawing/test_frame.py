import pytest

from graphkin.drawing.field import A4_AREA, paper_of
from graphkin.drawing.frame import TitleBlock, page_frame, sheet_frame
from graphkin.drawing.marks import LineMark, Text, reach
from graphkin.drawing.richtext import extent, plain
from graphkin.text.errors import PageError

FULL = TitleBlock(
    legal_owner="Universitatea Tehnică „Gheorghe Asachi” din Iași",
    title="Mecanism patrulater cu culisă",
    creator="Ștefan Țîrlea",
    approved_by="prof. dr. ing. Ana Măcăleț",
    document_type="Fișă de laborator",
    identification="GK-2026-003_b",
    date_of_issue="2026-01-15",
    sheet="1/2",
    language="ro",
    scale="1:5   *k*_v = 0,05 (m/s)/mm",
    revision="A",
    labels={"title": "Titlu", "creator": "Întocmit", "sheet": "Foaia"},
)


def texts(marks):
    return [mark for mark in marks if isinstance(mark, Text)]


def test_no_two_words_of_the_title_block_touch():
    boxes = [reach(mark) for mark in texts(sheet_frame(FULL)) if mark.cls == "title"]
    for i, a in enumerate(boxes):
        for b in boxes[i + 1 :]:
            assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


def test_a_title_with_descenders_is_clear_of_the_line_below_it():
    for papers in ("A3", "ANSI B"):
        page = paper_of(papers, "ISO")
        block = TitleBlock(title="Pump of gypsy jigs", frame=page.frame)
        marks = sheet_frame(block, page)
        (title,) = (m for m in texts(marks) if m.name == "title")
        ink = title.y + extent(title.markup, title.height)[2]
        lines = [m.y1 for m in marks if isinstance(m, LineMark) and m.y1 == m.y2 and m.y1 > title.y]
        assert min(lines) - ink > 0.4


def test_long_values_take_the_next_smaller_iso_height_and_then_are_refused():
    short = next(m for m in texts(sheet_frame(TitleBlock(title="Schiță"))) if m.name == "title")
    assert short.height == 5
    longer = TitleBlock(title="Mecanism patrulater cu culisă și două biele antrenat de manivelă")
    lines = [m for m in texts(sheet_frame(longer)) if m.name == "title"]
    assert len(lines) == 2
    assert {m.height for m in lines} == {3.5}
    with pytest.raises(PageError, match="title block, title"):
        sheet_frame(TitleBlock(title="Mecanism patrulater " * 20))
    with pytest.raises(PageError, match="identification"):
        sheet_frame(TitleBlock(identification="X" * 80))


def test_a_long_title_of_a_calculation_page_stands_in_two_lines_within_its_head():
    title = "Mechanism of the exercise seventeen b, second term, with a rocker, a long coupler"
    title += " and an oscillating slide beside its guide; n = 7"
    marks = page_frame((title, "Breviar de calcul, rezolvare"), ("", "1/2"))
    lines = [mark for mark in texts(marks) if mark.name == "header"]
    right = [plain(mark.markup) for mark in lines if mark.x > 100]
    assert right == ["Breviar de calcul, rezolvare"]
    left = [mark for mark in lines if mark.x < 100]
    assert len(left) == 2
    assert " ".join(plain(mark.markup) for mark in left) == title
    boxes = [reach(mark) for mark in lines]
    assert all(A4_AREA[0] < box[0] and box[2] < A4_AREA[2] for box in boxes)
    assert all(box[1] > 10 and box[3] < A4_AREA[1] for box in boxes)
    assert reach(left[0])[3] < reach(left[1])[1]


def test_a_title_too_long_for_a_calculation_page_is_told_how_long_it_may_be():
    with pytest.raises(PageError, match="269 letters; expected about 233 letters"):
        page_frame(("Mecanism " * 29 + "Mecanism", "x"))
