"""What a student gets: the name and the code on every page, the id nowhere in the square."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from time import sleep

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphkin.classroom.form_page import (
    MOST_ROW,
    ROW,
    form,
    row_height,
    rows_within,
)
from graphkin.classroom.grading.standard import standard
from graphkin.classroom.lab.items import items
from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.personal import (
    boxes,
    crosses_of,
    fits,
    modules,
    owner,
    shortened,
    without_crosses,
)
from graphkin.classroom.printing.print_run import PrintOrder, Sheets, StudentSheets
from graphkin.classroom.printing.print_run import make as made
from graphkin.classroom.roster.students import Student, Taker
from graphkin.documents import VIEWS
from graphkin.drawing.field import A3, A4_PAGE, LETTER
from graphkin.drawing.marks import Page, Text
from graphkin.drawing.richtext import measures, plain
from graphkin.text import LANGUAGES, words
from graphkin.writers import pdf
from tests.chosen import SPOKEN
from tests.classroom.printing.conftest import LAB, SCENE, write_class


@pytest.fixture(scope="module")
def edition(tmp_path_factory):
    folder = tmp_path_factory.mktemp("class") / "a"
    names = ['Țăran, Ștefan-Ioan "O\'Neil"', "*Bob*_{x}^2\\"]
    return read_edition(write_class(folder, ["0012", "secret-id"], names=names))


def order(edition, language="ro"):
    return PrintOrder(edition.lab, edition.scene, language, "colour")


def texts(page: Page) -> list[str]:
    return [plain(mark.markup) for mark in page.marks if isinstance(mark, Text)]


def pages(sheets: Sheets, view: str) -> list[Page]:
    return [page for sheet in sheets.of(view) for page in sheet.pages]


@pytest.mark.parametrize("view", VIEWS)
def test_name_group_and_code_stand_on_every_page(edition, view):
    for taker in edition.takers:
        found = pages(Sheets(order(edition), taker), view)
        assert found
        for page in found:
            page.check()
            said = " ".join(texts(page))
            assert taker.code in said
            for word in (*taker.student.name.split(), "331"):
                assert word in said, (view, word)
            assert taker.student.id not in said


def test_files_are_made_by_one_thread_at_a_time(edition, monkeypatch):
    """The fonts of reportlab are shared by all documents of a process."""
    active, most = 0, 0

    def slow(*_args, **_more):
        nonlocal active, most
        active += 1
        most = max(most, active)
        sleep(0.02)
        active -= 1
        return b""

    monkeypatch.setattr(pdf, "write_pdf", slow)
    wanted = [StudentSheets(edition.takers[0], "a", (("overlay", "pdf"),))]
    with ThreadPoolExecutor(3) as threads:
        list(threads.map(lambda _: made(order(edition), wanted), range(6)))
    assert most == 1


def test_the_square_of_every_task_sheet_and_form_holds_the_code_alone(edition, monkeypatch):
    import segno

    seen: list[str] = []
    make_qr = segno.make_qr
    monkeypatch.setattr(segno, "make_qr", lambda text, **k: seen.append(text) or make_qr(text, **k))
    modules.cache_clear()
    sheets = Sheets(order(edition), edition.takers[1])
    for view in ("task", "key"):
        for page in pages(sheets, view):
            assert any(mark.cls == "qr" for mark in page.marks) == (view == "task")
    assert set(seen) == {edition.takers[1].code}


def test_crosses_stand_clear_of_all_print_in_line_with_the_border(edition):
    """In the fields of a task's drawing sheets, and nowhere else: 20 mm apart about the middle of
    the sheet, as the divisions of an ISO 5457 border are 50 mm apart, below all that is drawn.
    """
    sheets = Sheets(order(edition), edition.takers[0])
    *drawings, form = sheets.of("task")
    for sheet in drawings:
        page = sheet.pages[0]
        crosses = np.array(crosses_of(page))
        assert len(crosses) > 100
        assert np.rint((crosses - (210, 148.5)) / 20) * 20 == pytest.approx(crosses - (210, 148.5))
        first = page.marks[: 2 * len(crosses)]
        assert {mark.cls for mark in first} == {"register"}
        middles = [((mark.x1 + mark.x2) / 2, (mark.y1 + mark.y2) / 2) for mark in first]
        assert np.array(middles) == pytest.approx(np.repeat(crosses, 2, axis=0))
        for mark in without_crosses(page).marks:
            for left, top, right, bottom in boxes(mark):
                x, y = np.clip(crosses, (left, top), (right, bottom)).T - crosses.T
                assert (np.maximum(abs(x), abs(y)) > 2.4).all()
    rest = [*form.pages, *pages(sheets, "key"), *pages(sheets, "overlay")]
    assert not any(crosses_of(page) for page in rest)


def test_the_form_has_every_field_once_with_its_points(edition):
    for language in LANGUAGES:
        sheets = Sheets(order(edition, language), edition.takers[0])
        (page,) = sheets.answers()
        said = texts(page)
        fields = [item.field for item in items(sheets.mechanism, edition.lab)]
        assert set(fields) == {"v_B_mm", "v_B", "omega_2", "omega_2_sense"}
        assert [said.count(field) for field in fields] == [1] * 4
        assert said.count("0.5" if language == "en" else "0,5") == 1
        assert not hints(page)


def hints(page: Page) -> list[str]:
    return [plain(m.markup) for m in page.marks if isinstance(m, Text) and m.name == "hint"]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_segment_too_short_to_be_measured_leaves_one_row_with_all_the_points(edition, language):
    """Form, blank calculation and key say alike that the velocity of B is computed."""
    sheets = Sheets(order(edition, language), edition.takers[1])
    (page,) = sheets.answers()
    said = texts(page)
    assert "v_B_mm" not in said
    assert said.count("v_B") == 1
    assert said.count("3") == 1
    why = words(language)("form.compute")
    assert hints(page) == [why]
    for view in ("task", "key"):
        lines = [line for page in pages(sheets, view) for line in texts(page) if why in line]
        assert sum(line.startswith("vB = ") for line in lines) == 1


@pytest.mark.parametrize("language", SPOKEN)
def test_a_centre_stands_on_the_key_as_the_form_asks_for_it(tmp_path, language):
    """In mm on paper from the first fixed pivot, to the right and up, which the form says."""
    scene = SCENE.replace("O = [0, 0]", "O = [35, -20]") + "centres = [2]\n"
    lab = LAB + "I_2_x_mm = 1\nI_2_y_mm = 1\n"
    lifted = scene.replace("[0, 30]", "[35, 10]")
    edition = read_edition(write_class(tmp_path / "a", ["1"], scene=lifted, lab=lab))
    sheets = Sheets(order(edition, language), edition.takers[0])
    found = standard(sheets.mechanism, items(sheets.mechanism, edition.lab), edition.lab.rubric)
    decimal = words(language).fixed
    place = words(language).place(*(decimal(found.key[f"I_2_{axis}_mm"], 2) for axis in "xy"))
    key = [line for page in pages(sheets, "key") for line in texts(page)]
    line = next(line for line in key if line.startswith("I2 = "))
    assert line.startswith(f"I2 = {place} mm (")
    (page,) = sheets.answers()
    assert plain(words(language)("form.places", pivot="*O*")) in texts(page)


@pytest.mark.parametrize("paper", [A4_PAGE, LETTER])
@pytest.mark.parametrize("count", [20, 30, 33, 36, 39, 62, 70, 80])
def test_rows_of_a_form_are_seven_millimetres_high_or_fill_their_page(count, paper):
    height = row_height(count, paper)
    assert ROW <= height <= MOST_ROW
    assert math.ceil(count / rows_within(height, paper)) == math.ceil(
        count / rows_within(ROW, paper)
    )


def test_a_form_ends_with_the_sum_of_its_points(edition):
    sheets = Sheets(order(edition), edition.takers[0])
    fields = items(sheets.mechanism, edition.lab)[:3]
    points = {item.field: Fraction(3, 2) for item in fields[:2]}
    (page,) = form(fields, points, (), words("en"), ("Title", "Answers"), ("Ana", "AAAA"))
    assert {"total", "3"} <= {*texts(page)}
    (page,) = form(fields, {}, (), words("en"), ("Title", "Answers"), ("Ana", "AAAA"))
    assert "total" not in texts(page)


def test_a_long_form_goes_on_on_further_pages(edition):
    sheets = Sheets(order(edition), edition.takers[0])
    fields = items(sheets.mechanism, edition.lab)[:1] * 80
    found = form(fields, {}, (), words("en"), ("Title", "Answers"), ("Ana", "AAAA"))
    assert len(found) == 3
    assert sum(texts(page).count("v_B_mm") for page in found) == 80
    assert texts(found[2]).count("3/3") == 1


@given(st.text(max_size=60))
def test_any_name_can_be_written_and_fits(text):
    whose = owner(Taker(Student(1, text or "id", name=text, group=text), {}, "CODE"))
    assert fits(whose.name, A3)
    assert set(whose.name) <= measures(italic=False).keys()


def test_a_student_who_cannot_be_drawn_keeps_nobody_else_back(edition):
    good = edition.takers[0]
    bad = Taker(Student(1, "9"), {"n": "9999"}, "BAD")
    parts = (("task", "pdf"),)
    found = made(
        order(edition), [StudentSheets(bad, "9", parts), StudentSheets(good, "0012", parts)]
    )
    assert found[0].problems
    assert not found[0].files
    assert not found[1].problems
    assert list(found[1].files["task", "pdf"]) == ["task/0012-task.pdf", "task/0012-form.pdf"]


def test_of_a_name_too_long_as_much_is_kept_as_fits():
    name = "Ștefania-Alexandra " * 20
    kept = shortened(name, A3)
    assert kept.endswith("…") and name.startswith(kept[:-1]) and fits(kept, A3)
    assert not fits(f"{name[: len(kept) + 2].rstrip()}…", A3)
    assert shortened("Ana Pop, 912", A3) == "Ana Pop, 912"


def test_who_has_no_letter_of_the_font_in_the_name_is_called_by_the_id():
    own = ("Łukasz Żółć", "Зоя Иванова")
    printed = {"Ana 王": "Ana ?, 912"} | {name: f"{name}, 912" for name in own}
    for name in ("李 小龍", "", *printed):
        whose = owner(Taker(Student(1, "0104", name=name, group="912"), {}, "CODE"))
        assert whose.name == printed.get(name, "0104, 912")
