"""Numbers written by hand into the tables of a sheet: cut out, shown at the desk, typed, marked."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from shutil import copytree
from typing import Any

import cv2
import numpy as np
import pytest
from PIL import Image

from graphkin.classroom.lab.items import all_fields, asked_fields
from graphkin.classroom.printing.edition import read_edition
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet_documents import drawings_of, drawn_sheets, proved, with_forces
from graphkin.drawing.marks import Text
from graphkin.mechanism import load
from graphkin.reading.desk_app import DeskSession
from graphkin.reading.handwritten_answers import fields_by_cell
from graphkin.reading.settled_points import records_in
from graphkin.reading.written_cells import blank_cells
from graphkin.studio.session import PageRequestError
from graphkin.text import words
from tests.browser.opening import barred, heard
from tests.chosen import EVERY
from tests.reading.camera import Shot, photograph
from tests.reading.hand import Habits, drawn_sheet, sheets_of, stroke
from tests.reading.hand_letters import Writing, written
from tests.reading.test_desk_drawings import at_desk
from tests.running import ran

WHO = "0042"
SHOT = Shot(size=(3600, 2700))
WARM = [min(255, round(k * part)) for part in (1.0, 0.95, 0.85) for k in range(256)]
NUMBERS = {("v_B", "m/s"): "1.24", ("v_C", "mm"): "43", ("ω2", "rad/s"): "3.1"}
"""What the student writes, by the name of a row and the head of a column."""


@pytest.fixture(scope="module")
def a_class(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("written")
    (folder / "roster.csv").write_text(f"id,number,name\n{WHO},1,Ana Pop\n", encoding="utf-8")
    assert ran("new", "lab", "crank-lab", "-o", folder).exit_code == 0
    ran("variants", folder / "crank-lab", folder / "roster.csv", "-o", folder / "class")
    return folder / "class"


@pytest.fixture(scope="module")
def code(a_class: Path) -> str:
    (taker,) = read_edition(a_class).takers
    return taker.code


def place_of(a_class: Path, code: str, row: str, head: str) -> tuple[float, float]:
    """Where a hand writes: level with the row's symbol, below the middle of the column's head."""
    page = sheets_of(a_class, code).task_pages["velocity"]
    texts = [mark for mark in page.marks if isinstance(mark, Text) and mark.cls == "table"]
    low = next(mark.y for mark in texts if mark.name == row)
    right = min(mark.x for mark in texts if mark.name == row)
    heads = [mark.x for mark in texts if mark.markup == head and mark.x > right]
    return min(heads), low


def photographed(a_class: Path, code: str, numbers: dict[tuple[str, str], str], seed: int) -> bytes:
    """A photograph in warm light of the velocity sheet with numbers in its tables."""
    habits = Habits(point=0.3, line=0.3)
    image = drawn_sheet(a_class, code, "velocity", habits, 13).image.astype(np.float32)
    rng, ink = np.random.default_rng(seed), np.zeros(image.shape, np.float32)
    for (row, head), number in numbers.items():
        x, y = place_of(a_class, code, row, head)
        text = Text(x, y, number.replace(".", ""), "table", 4.0, "middle")
        for path in written(text, Writing(), rng):
            stroke(ink, path, habits, rng)
    drawn = image * (1 - cv2.GaussianBlur(ink, (0, 0), 0.8))
    taken = photograph(np.clip(drawn, 0, 255).astype(np.uint8), SHOT, seed)
    warm = Image.merge("RGB", [Image.open(io.BytesIO(taken.data))] * 3).point(WARM)
    out = io.BytesIO()
    warm.save(out, "JPEG", quality=92)
    return out.getvalue()


@pytest.fixture(scope="module")
def read(a_class: Path, code: str) -> Path:
    """The readings of one sheet with numbers in three cells."""
    photos = a_class.parent / "photos"
    photos.mkdir()
    (photos / "one.jpg").write_bytes(photographed(a_class, code, NUMBERS, 7))
    found = ran("read", a_class, photos, "-o", a_class.parent / "read", "--jobs", 1)
    assert found.exit_code == 0, found.output
    return a_class.parent / "read"


def test_the_written_cells_and_no_others_are_cut_out(read: Path) -> None:
    (record,) = records_in(read)
    assert [(each.name, each.what) for each in record.written] == [
        ("v_B", "value"), ("v_C", "segment"), ("ω2", "value"),
    ]  # fmt: skip
    for number in range(3):
        data = (read / f"one.cell-{number}.jpg").read_bytes()
        assert len(data) < 30_000
        image = Image.open(io.BytesIO(data))
        assert image.mode == "RGB" and max(image.size) < 600
        middle = np.asarray(image.convert("L"))[40:-40, 40:-40]
        assert middle.min() < 0.75 * np.median(middle)  # the ink is inside, clear of the rules
    assert not (read / "one.cell-3.jpg").exists()


TYPED = {"v_B": "1.24", "omega_2": "3.1"}
"""What the lecturer types; the length of v_C is measured on the drawing."""


@pytest.fixture(scope="module")
def report(a_class: Path, read: Path) -> Path:
    """A report on the readings, before anything is typed."""
    folder = a_class.parent / "report"
    found = ran("grade", a_class, read, "-o", folder, "--format", "html", "--lang", "en")
    assert "v_B: “?” is written by hand on the sheet, and is not typed yet" in found.output
    return folder


def handwritten(session: DeskSession) -> dict[str, dict[str, Any]]:
    """The items of the desk with a cut-out, by their fields."""
    items = [session.item(each["name"]) for each in session.everything()["items"]]
    shown = [each for each in items if each["cut_out"]]
    fields = [session.of_marks().item(each["name"]).places[0][1] for each in shown]
    return dict(zip(fields, shown, strict=True))


def test_what_is_typed_at_the_desk_is_marked_and_survives(
    a_class: Path, read: Path, report: Path
) -> None:
    folder = copytree(report, report.with_name("typed"))
    session = DeskSession(folder, words("en"), "Ana")
    waiting = handwritten(session)
    assert list(waiting) == list(TYPED)
    for field, text in TYPED.items():
        item = waiting[field]
        assert session.cut_out(item["name"]).startswith(b"\xff\xd8")
        asked = {"item": item["name"], "known": item["known"], "reading": text}
        assert session.rule(json.dumps(asked).encode())["state"] == "decided"
    asked = {"item": waiting["v_B"]["name"], "known": 9, "reading": "12 apples"}
    with pytest.raises(PageRequestError):
        session.rule(json.dumps(asked).encode())
    for _ in range(2):
        ran("read", a_class, a_class.parent / "photos", "-o", read, "--jobs", 1)
        ran("grade", a_class, read, "-o", folder, "--force", "--format", "html", "--lang", "en")
        data = (folder / "marks.csv").read_text(encoding="utf-8-sig")
        (row,) = csv.DictReader(io.StringIO(data))
        assert row["v_B"] == "0" and row["omega_2"] == "0"  # numbers of no drawing: read, and wrong
        page = (folder / "feedback" / f"{WHO}.html").read_text(encoding="utf-8")
        assert page.count("typed this answer from the photograph of your sheet") == 2
        assert "1.24" in page


def test_a_right_number_earns_its_points(a_class: Path, code: str, tmp_path: Path) -> None:
    """The independent reference: the value that the witness of the marks expects."""
    opened = read_edition(a_class)
    (taker,) = opened.takers
    right = opened.book.marker_of(taker).standard.key["v_B"]
    read, report = tmp_path / "read", tmp_path / "report"
    (tmp_path / "one.jpg").write_bytes(photographed(a_class, code, {("v_B", "m/s"): "12"}, 8))
    ran("read", a_class, tmp_path / "one.jpg", "-o", read, "--jobs", 1)
    marking = "grade", a_class, read, "-o", report, "--force", "--format", "html"
    ran(*marking)
    session = DeskSession(report, words("en"), "Ana")
    (item,) = handwritten(session).values()
    asked = {"item": item["name"], "known": 0, "reading": f"{right:.4g}".replace(".", ",")}
    session.rule(json.dumps(asked).encode())
    ran(*marking)
    data = (report / "marks.csv").read_text(encoding="utf-8-sig")
    (row,) = csv.DictReader(io.StringIO(data))
    assert row["v_B"] == "1"


CARD = "document.getElementById('card-title').textContent"
SHOWN = "(() => { const i = document.getElementById('cut-out'); return i.naturalWidth; })()"


def test_numbers_are_typed_one_after_the_other(report: Path, chromium: Any) -> None:
    """The picture beside the field, the field in hand, Enter for the next, nothing on the mouse."""
    folder = copytree(report, report.with_name("browser"))
    session = DeskSession(folder, words("en"), "Ana")
    with at_desk(session) as address:
        page = chromium.new_page(viewport={"width": 1366, "height": 768}, bypass_csp=True)
        with heard(page, "pageerror") as errors:
            page.goto(address)
            page.wait_for_selector("body[data-ready=yes]")
            page.wait_for_function(f"{SHOWN} > 100")
            first = page.evaluate(CARD)
            page.keyboard.press("Enter")  # nothing typed: the next, and nothing is decided
            page.wait_for_function(f"{CARD} !== {json.dumps(first)}")
            page.keyboard.type("3,1")
            page.keyboard.press("Enter")
            page.wait_for_function("document.getElementById('card').hasAttribute('hidden')")
            assert barred(page) == []
        page.close()
        assert not errors
    states = {each["title"]: each["state"] for each in session.everything()["items"]}
    assert sorted(states.values()) == ["decided", "open"]
    assert next(title for title, state in states.items() if state == "decided").startswith("ω2")


EXAMPLES = Path(__file__).parents[2] / "examples" / "scenes"


@pytest.mark.parametrize(
    "path",
    [
        EXAMPLES / "engine-forces.toml",
        EXAMPLES / "crank-slot.toml",
        EXAMPLES / "crank-fixed-slot.toml",
        EXAMPLES / "eight-link-1.toml",
    ][: 4 if EVERY else 2],
    ids=lambda path: path.stem,
)
def test_every_cell_of_the_tables_is_a_field_and_what_is_asked_has_a_cell(path: Path) -> None:
    mechanism = load(str(path)).measured
    verdict = proved(mechanism, sheet_motion(mechanism))
    drawings = with_forces(mechanism, drawings_of(mechanism, verdict, words("en")))
    cells = {
        (sheet.kind, cell.table, cell.name, cell.what)
        for sheet in drawn_sheets(drawings, "task")
        for page in sheet.pages
        for cell, _ in blank_cells(page)
    }
    every = fields_by_cell(all_fields(mechanism).values())
    asked = fields_by_cell(asked_fields(mechanism).values())
    assert asked
    assert {cell for cell in cells if cell not in every and cell[1] != "sides"} == set()
    assert {cell for cell in asked if cell not in cells} == set()
