"""Pictures of everything that is drawn: ``python -m tests.gallery -o DIR``.

Contact sheets of every lab (students 1, 10, 20, 30) and every example scene, two pages of each in
a row: its velocity and its acceleration sheet. In ``DIR/readme`` lie the README's own pictures.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from tests.gallery.pages import LANGUAGES, VIEWS, Subject, pages_of, row_of, subjects
from tests.gallery.pixels import picture, stacked, write_png

README = {
    "pump-n7-acceleration-key": (Subject("pump", n=7), "acceleration"),
}
"""The README's pictures, and which sheet of what they show."""
CONTACT, LARGE = 90, 100
"""Pixels to the inch of paper, on contact sheets and in the README."""
ROWS = 3
"""Rows of a contact sheet."""


def main(words: Sequence[str] | None = None) -> None:
    """Write the pictures that the command line asks for."""
    options = read(words)
    options.o.mkdir(parents=True, exist_ok=True)
    chosen = [subject for subject in subjects() if not options.only or subject.name in options.only]
    make = partial(row_of, view=options.view, language=options.lang, ink=options.ink, dpi=CONTACT)
    with ProcessPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(make, chosen))
        if not options.only:
            list(pool.map(partial(readme_picture, options.o / "readme"), README))
    for number, start in enumerate(range(0, len(rows), ROWS), 1):
        path = options.o / f"contact-{number:02}.png"
        write_png(path, stacked(rows[start : start + ROWS]))
        print(path, *(subject.title for subject in chosen[start : start + ROWS]))


def read(words: Sequence[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser("python -m tests.gallery", description=__doc__)
    parser.add_argument("-o", type=Path, required=True, metavar="DIR", help="folder to write into")
    parser.add_argument("--view", choices=VIEWS, default="key")
    parser.add_argument("--lang", choices=LANGUAGES, default="en")
    parser.add_argument("--ink", choices=("colour", "black"), default="colour")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these labs and scenes alone")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes at once")
    return parser.parse_args(words)


def readme_picture(folder: Path, name: str) -> None:
    """One picture of the README, into a folder."""
    subject, kind = README[name]
    folder.mkdir(parents=True, exist_ok=True)
    (page,) = pages_of(subject, "key", "en")[kind]
    write_png(folder / f"{name}.png", picture(page, "colour", LARGE))


if __name__ == "__main__":
    main()
