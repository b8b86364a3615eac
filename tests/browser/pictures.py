"""The pictures of pages in the manual: ``python -m tests.browser.pictures [FOLDER]``."""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

from playwright.sync_api import sync_playwright

from graphkin.classroom.sheet_files import hand_out_page
from graphkin.mechanism import load
from graphkin.studio.server import serve
from tests.browser.opening import ARGS
from tests.studio.pump import desk_in, running

FOLDER = Path(__file__).resolve().parents[2] / "graphkin" / "manual" / "pictures"
SIZE = {"width": 1440, "height": 900}


def draw(folder: Path) -> None:
    """Write the pictures."""
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=ARGS)
        draw_page(browser.new_page(viewport=SIZE), folder / "pump-n7-page.png")
        draw_turn(browser.new_page(viewport=SIZE), folder / "pump-n7-your-turn.png")
        draw_studio(browser.new_page(viewport=SIZE), folder / "studio.png")
        draw_class(browser.new_page(viewport=SIZE), folder / "studio-class.png")
        browser.close()


def pump_page() -> str:
    """The address of the page of student 7's pump in English."""
    file = Path(tempfile.mkdtemp()) / "pump.html"
    text = hand_out_page(load("pump", n=7), "pump", "pump-n7", "key", "en", "colour")
    file.write_text(text, encoding="utf-8")
    return file.as_uri()


def draw_page(page: Any, path: Path) -> None:
    """The page at the step that finds a centre."""
    page.goto(f"{pump_page()}#step=12")
    page.wait_for_timeout(500)
    page.screenshot(path=path)


def draw_turn(page: Any, path: Path) -> None:
    """A student's turn at the image of C: one line is right, the next is not."""
    page.goto(f"{pump_page()}#step=8")
    page.locator("#turn").click()
    for line in ("perp AC a", "BC a"):
        page.keyboard.type(line)
        page.keyboard.press("Enter")
    page.wait_for_timeout(500)
    page.screenshot(path=path)


def draw_studio(page: Any, path: Path) -> None:
    """The studio with the pump in English, its slider moved."""
    session = desk_in(Path(tempfile.mkdtemp()))
    session.language = "en"
    with running(serve(session)) as served:
        page.goto(f"{served.address}?lab=pump")
        page.wait_for_selector("body[data-settled=true]")
        page.fill("#value-n", "12")
        page.press("#value-n", "Enter")
        page.wait_for_selector("#slider-n[aria-valuetext='12']")
        page.wait_for_timeout(500)
        page.screenshot(path=path)


def draw_class(page: Any, path: Path) -> None:
    """The studio with the pump's class in English, one student's sheets drawn."""
    session = desk_in(Path(tempfile.mkdtemp()))
    session.language = "en"
    with running(serve(session)) as served:
        page.goto(f"{served.address}?lab=pump&rules=yes")
        page.click("#lab")
        page.click("#students tbody tr:nth-child(3) button")
        page.wait_for_selector("#student-pages img")
        page.locator("#class").evaluate("part => part.scrollTo(0, 0)")
        page.wait_for_timeout(500)
        page.screenshot(path=path)


if __name__ == "__main__":
    draw(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER)
