"""The pages of sheets of paper: the whole motion, and forces with their steps."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphkin.documents.sheet_documents import hand_out
from graphkin.mechanism import load
from tests.browser.opening import Opened, barred
from tests.browser.test_form import class_folder
from tests.running import Run

OVER = "document.documentElement.scrollWidth <= innerWidth"


@pytest.mark.parametrize("look", ["light", "dark"])
@pytest.mark.parametrize("view", ["positions", "diagrams"])
def test_the_whole_motion_is_one_page_of_sheets(
    opened: Opened, run: Run, tmp_path: Path, view: str, look: str
):
    """Each sheet is there with its letters, is linked to, and fits a window of any width."""
    run("sheet", "pump", "-o", tmp_path, "--view", view, "--format", "html", "--lang", "en")
    page = opened(tmp_path / f"pump-{view}.html", color_scheme=look)
    sheets = [one for part in hand_out(load("pump"), view, "en") for one in part.pages]
    assert page.locator("h1,h2").all_inner_texts() == [each.title for each in sheets]
    page.locator("nav a").last.click()
    assert page.evaluate("location.hash") == f"#sheet-{len(sheets)}"
    assert page.locator("section").last.evaluate("one => one.getBoundingClientRect().top") < 400
    for size in ({"width": 1366, "height": 768}, {"width": 390, "height": 844}):
        page.set_viewport_size(size)
        assert page.evaluate(OVER)
    assert not barred(page)


def test_a_class_gets_its_positions_as_pages(run: Run, tmp_path: Path):
    folder = class_folder("pump", tmp_path)
    result = run("print", folder, "--view", "positions", "--format", "html", "--jobs", "1")
    assert result.exit_code == 0, result.output
    page = (folder / "print" / "positions" / "0042-positions.html").read_text("utf-8")
    assert page.count("<section") == 3
    assert "Ștefănescu Ana" in page
