"""Drawings at the desk: pinned remarks, several markers, and sheets without names."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import copytree
from threading import Thread
from typing import Any

import msgspec
import pytest
from PIL import Image

from graphkin.classroom.printing.edition import read_edition
from graphkin.reading.desk_app import DeskSession, DrawingDesk, desk_application
from graphkin.reading.marked_drawing import BLUE, drawings_of_class, pinned_remarks
from graphkin.reading.settled_points import SETTLED, PointDecision, SettledPoints
from graphkin.studio.server import served
from graphkin.studio.session import PageRequestError
from graphkin.text import words
from graphkin.text.errors import Refusals
from tests.browser.opening import barred, heard
from tests.reading.test_reading import a_class, code, taken  # noqa: F401
from tests.running import ran

STUDENT = (350, 251, 410, 266)
"""The student's cell of the title block, in mm of paper."""


@pytest.fixture
def read(taken: Path, tmp_path: Path) -> Path:  # noqa: F811
    """Readings of its own, without decisions."""
    copytree(taken / "read", tmp_path / "read")
    (tmp_path / "read" / SETTLED).unlink(missing_ok=True)
    return tmp_path / "read"


def desk(read: Path, marker: str = "Ana", *, anonymous: bool = False) -> DrawingDesk:
    return DrawingDesk(read, words("en"), marker, anonymous)


def pin(session: DrawingDesk, note: str, at: tuple[float, float], sheet: str = "hard") -> list:
    said = {"sheet": sheet, "step": None, "verdict": "unread", "at": at, "note": note}
    return session.decide(json.dumps(said).encode())["pins"]


def test_a_remark_is_pinned_to_a_place_and_goes_back(
    a_class: Path,  # noqa: F811
    read: Path,
) -> None:
    session = desk(read)
    pin(session, "draw thinner", (100.0, 50.0))
    assert [each["note"] for each in pin(session, "good", (200.5, 80.0))] == [
        "draw thinner",
        "good",
    ]
    assert [each["note"] for each in pin(session, "", (100.0, 50.0))] == ["good"]
    assert session.undo()["pins"][0]["note"] == "draw thinner"
    opened, refusals = read_edition(a_class), Refusals()
    found = drawings_of_class(opened, read, words("en"), ("html", "pdf"), refusals)
    page = found["0042-drawing.html"].decode()
    assert "1. draw thinner" in page and "2. good" in page
    assert f'cx="200.5" cy="80.0" r="3.4" fill="#fff" stroke="{BLUE}"' in page
    ((told),) = pinned_remarks(read).values()
    assert [(each.number, each.text) for each in told] == [(1, "draw thinner"), (2, "good")]
    with pytest.raises(PageRequestError):
        pin(session, "off the sheet", (500.0, 50.0))
    with pytest.raises(PageRequestError):
        pin(session, "x" * 401, (100.0, 50.0))


def test_a_report_shows_its_drawings_and_pins_reach_the_feedback(
    a_class: Path,  # noqa: F811
    read: Path,
    tmp_path: Path,
) -> None:
    report = tmp_path / "report"
    pin(desk(read), "draw thinner", (100.0, 50.0))
    ran("grade", a_class, read, "-o", report, "--format", "html", "--lang", "en")
    session = DeskSession(report, words("en"), "Ana")
    assert {each["name"] for each in session.everything()["sheets"]} == {"plain", "hard"}
    page = (report / "feedback" / "0042.html").read_text(encoding="utf-8")
    assert "on your drawing (Acceleration plan, 1): draw thinner" in page
    assert not session.everything()["items"]  # its open cells wait for the points of its drawings
    asked = [p for s in session.everything()["sheets"] for p in s["points"] if p["ask"]]
    assert asked
    said = {"sheet": "hard", "step": None, "verdict": "unread", "at": [9, 9], "note": "later"}
    session.decide(json.dumps(said).encode())
    assert session.undo()["name"] == "hard"
    assert [each.note for each in SettledPoints(read).pins("hard")] == ["draw thinner"]


def test_markers_who_disagree_on_a_point_are_asked_again(read: Path) -> None:
    ana, ion = desk(read, "Ana"), desk(read, "Ion")
    point = ana.records["hard"].points[0]

    def decide(session: DrawingDesk, verdict: str, seen: int) -> dict:
        at = None if verdict == "missing" else [200.0, 100.0]
        said = PointDecision("hard", point.step, verdict, at, seen=seen)
        told = session.decide(msgspec.json.encode(said))
        return next(each for each in told["points"] if each["step"] == point.step)

    assert not decide(ana, "wrong", 0)["ask"]
    told = decide(ion, "missing", 0)
    assert told["ask"] and not told["decided"]
    assert told["rivals"] == "wrong (Ana), missing (Ion)"
    told = decide(ana, "missing", 2)
    assert told["decided"] and not told["ask"] and not told["rivals"]


def test_an_anonymous_desk_shows_no_name(read: Path) -> None:
    session = desk(read, anonymous=True)
    told = msgspec.json.encode(session.sheets(), enc_hook=str).decode()
    assert not [name for name in ("0042", "hard", "plain", "Ana") if name in told]
    with pytest.raises(PageRequestError):
        session.picture("hard")
    shown, whole = (
        Image.open(io.BytesIO(data))
        for data in (session.picture("1"), desk(read).picture(session.named["1"]))
    )
    box = [side * 6 + inset for side, inset in zip(STUDENT, (6, 6, -6, -6), strict=True)]
    assert shown.crop(box).convert("L").getextrema()[0] > 245
    assert whole.crop(box).convert("L").getextrema()[0] < 200


PLACE = """([x, y]) => {
  const spot = new DOMPoint(x, y).matrixTransform(
    document.getElementById("paper").getScreenCTM());
  return [spot.x, spot.y];
}"""
"""Where on the screen a place of the paper is."""
ASKED = """() => {
  const rows = [...document.querySelectorAll("#points tr")];
  const row = rows.findIndex(one => one.ariaCurrent === "true");
  return [row, document.getElementById("open").textContent];
}"""
"""The row in hand, and how much is left to decide."""
SEEN = "document.getElementById('paper').getBoundingClientRect().toJSON()"


@contextmanager
def at_desk(session: DeskSession) -> Iterator[str]:
    """The address of a desk, served meanwhile."""
    found = served(lambda: desk_application(session))
    thread = Thread(target=found.server.run, daemon=True)
    thread.start()
    try:
        yield found.address
    finally:
        found.server.close()
        thread.join(5)


def test_doubtful_points_are_decided_on_the_drawing(read: Path, chromium: Any) -> None:
    """A click moves the point, Enter takes what its place makes likely, one key takes it back."""
    session = DeskSession(read, words("en"), "Ana")
    with at_desk(session) as address:
        page = chromium.new_page(viewport={"width": 1366, "height": 768}, bypass_csp=True)
        with heard(page, "pageerror") as errors:
            page.goto(address)
            page.wait_for_selector("body[data-ready=yes]")
            assert barred(page) == []
            decided_on_the_drawing(page, session)
            page.set_viewport_size({"width": 420, "height": 800})
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        page.close()
        assert not errors


def decided_on_the_drawing(page: Any, session: DeskSession) -> None:
    """What a marker does with the first doubtful point, and with the whole sheet."""

    def point() -> dict[str, Any]:
        (sheet,) = (each for each in session.drawings.sheets() if each["name"] == "hard")
        return sheet["points"][row]

    row, left = page.evaluate(ASKED)
    seen = page.evaluate(SEEN)
    assert seen["width"] > 0.7 * 1366 and seen["height"] > 0.9 * 768
    place = [point()["own"][0] + 4.0, point()["own"][1]]
    page.mouse.click(*page.evaluate(PLACE, place))
    likely = page.locator("#choices [aria-pressed=true]").get_attribute("data-verdict")
    assert likely == "wrong"  # 4 mm off the student's own place of it
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("Enter")
    page.wait_for_function(f"({ASKED})()[0] !== {row}")
    assert point()["decided"] and point()["verdict"] == "wrong"
    assert point()["at"] == pytest.approx([place[0] - 0.1, place[1]], abs=0.05)
    assert page.evaluate(ASKED)[1] != left
    page.keyboard.press("u")
    page.wait_for_function(f"({ASKED})()[0] === {row}")
    assert not point()["decided"]
    assert page.evaluate(ASKED) == [row, left]
    page.keyboard.press("0")
    assert page.locator("#paper").get_attribute("viewBox") == "0 0 420 297"
    page.mouse.move(*page.evaluate(PLACE, [120.0, 60.0]))
    page.keyboard.press("c")
    page.keyboard.type("draw thinner")
    page.keyboard.press("Enter")
    page.locator("#pins li").wait_for()
    assert page.locator("#pins li").all_inner_texts() == ["draw thinner"]
    assert page.locator("#paper .pin").count() == 1
