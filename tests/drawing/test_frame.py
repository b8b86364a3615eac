import pytest

from graphkin.drawing.areas import A3_AREA, A3_TITLE_BLOCK, A4_AREA
from graphkin.drawing.frame import TitleBlock, check_bar, page_frame, sheet_frame
from graphkin.drawing.marks import LineMark, Page, Polyline, Text, reach
from graphkin.drawing.richtext import plain
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


def test_the_frame_of_a3_is_390_by_277():
    frame = next(m for m in sheet_frame(TitleBlock()) if m.cls == "frame" and hasattr(m, "points"))
    assert reach(frame) == (20, 10, 410, 287) == A3_AREA
    border = next(m for m in sheet_frame(TitleBlock()) if m.cls == "border")
    assert reach(border) == (15, 5, 415, 292)


def test_the_fields_are_eight_by_six_counted_from_the_middle():
    marks = sheet_frame(TitleBlock())
    words = [mark.markup for mark in texts(marks)]
    assert sorted(words) == sorted([*"12345678" * 2, *"ABCDEF" * 2, "A3"])
    ticks = {m.x1 for m in marks if isinstance(m, LineMark) and m.cls == "border" and m.x1 == m.x2}
    assert ticks == {60, 110, 160, 210, 260, 310, 360}


def test_four_centring_marks_of_ten_millimetres_cross_the_frame():
    marks = [m for m in sheet_frame(TitleBlock()) if m.name == "centring-mark"]
    ends = {(m.x1, m.y1, m.x2, m.y2) for m in marks}
    assert ends == {
        (210, 5, 210, 15),
        (210, 292, 210, 282),
        (15, 148.5, 25, 148.5),
        (415, 148.5, 405, 148.5),
    }


def test_the_title_block_is_180_wide_at_the_bottom_right():
    block = next(m for m in sheet_frame(FULL) if isinstance(m, Polyline) and "title-block" in m.cls)
    assert reach(block) == A3_TITLE_BLOCK == (230, 251, 410, 287)


def test_every_value_stands_inside_the_title_block():
    marks = sheet_frame(FULL)
    Page(420, 297, marks).check()
    values = {mark.name: plain(mark.markup) for mark in texts(marks) if mark.cls == "title"}
    assert values["identification"] == "GK-2026-003_b"
    assert values["title"] == FULL.title
    left, top, right, bottom = A3_TITLE_BLOCK
    for mark in texts(marks):
        if mark.cls == "title":
            x1, y1, x2, y2 = reach(mark)
            assert left < x1 < x2 < right
            assert top < y1 < y2 < bottom


def test_no_two_words_of_the_title_block_touch():
    boxes = [reach(mark) for mark in texts(sheet_frame(FULL)) if mark.cls == "title"]
    for i, a in enumerate(boxes):
        for b in boxes[i + 1 :]:
            assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


def test_long_values_take_the_next_smaller_iso_height_and_then_are_refused():
    short = next(m for m in texts(sheet_frame(TitleBlock(title="Schiță"))) if m.name == "title")
    assert short.height == 3.5
    longer = TitleBlock(title="Mecanism patrulater cu culisă și două biele")
    assert {m.height for m in texts(sheet_frame(longer)) if m.name == "title"} == {2.5}
    with pytest.raises(PageError, match="title block, title"):
        sheet_frame(TitleBlock(title="Mecanism patrulater " * 20))
    with pytest.raises(PageError, match="identification"):
        sheet_frame(TitleBlock(identification="X" * 80))


def test_the_check_bar_measures_a_hundred_millimetres():
    marks = check_bar(30, 270, "100 mm")
    line = next(m for m in marks if m.name == "check-bar")
    assert line.x2 - line.x1 == 100
    numbers = [m.markup for m in texts(marks) if m.markup != "100 mm"]
    assert numbers == [str(i) for i in range(0, 101, 10)]
    assert sum(isinstance(m, LineMark) for m in marks) == 102


def test_the_calculation_page_is_a4_with_a_filing_margin():
    marks = page_frame(("Mecanism", "GK-1"), ("graphkin", "3/5"))
    Page(210, 297, marks).check()
    assert reach(marks[0]) == (20, 10, 200, 287)
    assert A4_AREA == (20, 18, 200, 279)
    assert [m.markup for m in texts(marks)] == ["Mecanism", "GK-1", "graphkin", "3/5"]
    with pytest.raises(PageError, match="header"):
        page_frame(("Mecanism " * 30, "x"))


def test_a_long_title_of_a_calculation_page_stands_in_two_lines_within_its_head():
    title = "Mechanism of the exercise seventeen b, second term, with a rocker, a long coupler"
    title += " and an oscillating slide; n = 7"
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
    with pytest.raises(PageError, match="269 letters; expected about 215 letters"):
        page_frame(("Mecanism " * 29 + "Mecanism", "x"))
