"""The marking desk at its first doubtful point, and a marked drawing, as pictures for the manual.

    python -m tests.reading.desk_pictures FOLDER -o graphkin/manual/pictures

FOLDER is what ``python -m tests.bench.reading 3 pump -o FOLDER`` keeps.
"""

from __future__ import annotations

import argparse
import io
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
from PIL import Image

from graphkin.classroom.printing.edition import read_edition
from graphkin.reading.marked_drawing import drawings_of_class
from graphkin.reading.pictures import Photograph
from graphkin.reading.read_run import read_class, read_order
from graphkin.reading.read_sheet import Grid
from graphkin.reading.settled_points import PointDecision, SettledPoints
from graphkin.text import words
from graphkin.text.errors import Refusals
from tests.bench.desk import desk_of
from tests.bench.reading import Taken


def settle(folder: Path, name: str, taken: Taken, steps: set[int]) -> None:
    """Decide what is asked as one who knows what was drawn."""
    settled = SettledPoints(folder)
    for each in taken.points:
        if each.step in steps:
            settled.add(PointDecision(name, each.step, each.verdict, each.at))


def keep(data: bytes, out: Path) -> None:
    """Write a picture of a page in few colours."""
    coloured = Image.open(io.BytesIO(data)).convert("RGB")
    coloured.quantize(255, Image.Quantize.MAXCOVERAGE).save(out, optimize=True)


def main(folder: Path, name: str, out: Path) -> None:
    """Read one photograph of a bench, open the desk on it, then mark it and give it back."""
    from playwright.sync_api import sync_playwright

    path = folder / f"{name}.jpg"
    taken = msgspec.json.decode(path.with_suffix(".truth.json").read_bytes(), type=Taken)
    opened = read_edition(folder / Path(taken.lab).stem)
    with sync_playwright() as driver, TemporaryDirectory() as kept:
        browser = driver.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        read = Path(kept) / "read"
        photograph = Photograph(name, path)
        outcome = read_class(
            opened, [photograph], read, read_order(opened, Grid()), 1, lambda done, of: None
        )
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        with desk_of(read) as (address, _):
            page.goto(address)
            page.wait_for_selector("body[data-ready=yes]")
            page.wait_for_function("document.querySelector('#paper image') !== null")
            keep(page.screenshot(), out / "marking-desk.png")
        asked = {point.step for point in outcome.records[0].points if point.ask}
        settle(read, name, taken, asked)
        (marked,) = drawings_of_class(opened, read, words("en"), ["html"], Refusals()).values()
        (Path(kept) / "marked.html").write_bytes(marked)
        page.set_viewport_size({"width": 900, "height": 960})
        page.goto((Path(kept) / "marked.html").as_uri())
        keep(page.screenshot(), out / "marked-drawing.png")
        browser.close()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("name", nargs="?", default="p001")
    parser.add_argument("-o", type=Path, required=True)
    said = parser.parse_args()
    main(said.folder, said.name, said.o)
