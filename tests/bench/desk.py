"""How long a lecturer takes at the desk: a model, driven through the page itself.

    python -m tests.bench.desk FOLDER [--lab pump]

FOLDER is what ``python -m tests.bench.reading N -o FOLDER`` keeps. Its pictures are read twice, by
hand and by program; a browser then does what a lecturer would, who knows where each point was drawn
and what is true of it. Time is that of Card, Moran and Newell's keystroke-level model (The
Psychology of Human-Computer Interaction, 1983, chapter 8), and what the page takes to show the next
point: nobody sat there.
"""

from __future__ import annotations

import argparse
import shutil
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Thread
from time import perf_counter
from typing import TYPE_CHECKING, Any

import msgspec
from msgspec import Struct

from graphkin.classroom.printing.edition import read_edition
from graphkin.reading.desk_app import DeskSession, desk_application
from graphkin.reading.pictures import Photograph
from graphkin.reading.read_run import read_class, read_order
from graphkin.reading.read_sheet import Grid
from graphkin.studio.server import served
from graphkin.text import words
from tests.bench.reading import Taken

if TYPE_CHECKING:
    from collections.abc import Iterator

KEY, POINT, BUTTON, THINK, LOOK = 0.28, 1.1, 0.1, 1.35, 1.35
"""Seconds: a key by an average typist, to point with a mouse, to press or let go its button, to
think of what to do, and to see how the drawing stands to the key."""
NEAR = 1.0
"""Millimetres from where it was drawn within which a point that was read is left where it is."""
KEYS = {"right": "1", "follows": "2", "wrong": "3", "missing": "4"}
PLACE = """([x, y]) => {
  const paper = document.getElementById("paper");
  const spot = new DOMPoint(x, y).matrixTransform(paper.getScreenCTM());
  return [spot.x, spot.y];
}"""
LIKELY = "() => document.querySelector('#choices [aria-pressed=true]')?.dataset.verdict ?? ''"
CURRENT = """() => [document.getElementById("queue").selectedIndex,
  [...document.querySelectorAll("#points tr")].findIndex(row => row.ariaCurrent === "true")]"""
WAITS = "before => document.getElementById('open').textContent !== before"


class DeskTime(Struct):
    """What a lecturer did: seconds by the model, seconds that the page took, points, pictures."""

    model: float = 0.0
    page: float = 0.0
    points: int = 0
    sheets: int = 0

    def told(self, name: str) -> str:
        """A line of the report: a student has two sheets."""
        every = self.model + self.page
        one = 2 * every / self.sheets
        points = f"{self.points} points of {self.sheets} sheets"
        return f"{name}: {points}, {one:.1f} s a student, {30 * one / 60:.1f} min for a class of 30"


@contextmanager
def desk_of(folder: Path) -> Iterator[tuple[str, DeskSession]]:
    """The desk of a folder of readings, served."""
    session = DeskSession(folder, words("en"))
    found = served(lambda: desk_application(session), 0)
    thread = Thread(target=found.server.run, daemon=True)
    thread.start()
    try:
        yield found.address, session
    finally:
        found.server.close()
        thread.join(5)


def settle(page: Any, session: DeskSession, truths: dict[str, Taken]) -> DeskTime:
    """All that is asked is settled as a lecturer would."""
    spent = DeskTime(sheets=sum(each.refused is None for each in session.drawings.records.values()))
    page.wait_for_selector("body[data-ready=yes]")
    while (current := page.evaluate(CURRENT))[1] >= 0:
        sheet = session.drawings.sheets()[current[0]]
        record = session.drawings.records[sheet["name"]]
        read = record.points[current[1]]
        true = {each.step: each for each in truths[record.name].points}.get(read.step)
        at = None if true is None else true.at
        verdict = "right" if true is None else true.verdict
        at = at or (read.key if true is None else None)
        spent.model += LOOK
        if at is not None and not is_near(read.at, at):
            x, y = page.evaluate(PLACE, at)
            page.mouse.click(x, y)
            spent.model += THINK + POINT + 2 * BUTTON
        spent.model += KEY
        key = "Enter"
        if page.evaluate(LIKELY) != verdict:
            key = KEYS[verdict]
            spent.model += THINK
        before, start = page.locator("#open").text_content(), perf_counter()
        page.keyboard.press(key)
        page.wait_for_function(WAITS, arg=before)
        spent.page += perf_counter() - start
        spent.points += 1
    return spent


def is_near(read: tuple[float, float] | None, true: tuple[float, float]) -> bool:
    """Whether a point was read where it was drawn."""
    return read is not None and abs(complex(*read) - complex(*true)) < NEAR


def main(folder: Path, lab: str) -> None:
    """Read, settle and report."""
    from playwright.sync_api import sync_playwright

    truths, pictures = {}, []
    for path in sorted(folder.glob("p*.truth.json")):
        taken = msgspec.json.decode(path.read_bytes(), type=Taken)
        if Path(taken.lab).stem == lab:
            name = path.name.removesuffix(".truth.json")
            truths[name] = taken
            pictures.append(Photograph(name, folder / f"{name}.jpg"))
    opened = read_edition(folder / lab)
    with sync_playwright() as driver, TemporaryDirectory() as kept:
        browser = driver.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        for name, by_hand in (("with reading", False), ("by hand", True)):
            out = Path(kept) / name
            order = read_order(opened, Grid(), by_hand=by_hand)
            read_class(opened, pictures, out, order, 1, lambda done, of: None)
            with desk_of(out) as (address, session):
                page = browser.new_page(viewport={"width": 1440, "height": 900})
                page.goto(address)
                print(settle(page, session, truths).told(name))
                page.close()
        browser.close()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--lab", default="pump")
    said = parser.parse_args()
    main(said.folder, said.lab)
