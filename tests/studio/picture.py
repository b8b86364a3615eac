"""The picture of the studio in the README: ``python -m tests.studio.picture [FILE]``."""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from graphkin.studio.server import serve
from tests.browser.opening import ARGS
from tests.studio.pump import desk_in, running

PICTURE = Path(__file__).resolve().parents[2] / "examples" / "studio.png"
SIZE = {"width": 1440, "height": 900}


def draw(path: Path) -> None:
    """Write the picture: the pump in English, its slider moved."""
    desk = desk_in(Path(tempfile.mkdtemp()))
    desk.language = "en"
    with running(serve(desk)) as served, sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=ARGS)
        page = browser.new_page(viewport=SIZE)
        page.goto(f"{served.address}?lab=pump")
        page.wait_for_selector("body[data-settled=true]")
        page.fill("#value-n", "12")
        page.press("#value-n", "Enter")
        page.wait_for_selector("#slider-n[aria-valuetext='12']")
        page.wait_for_timeout(500)
        page.screenshot(path=path)
        browser.close()


if __name__ == "__main__":
    draw(Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURE)
