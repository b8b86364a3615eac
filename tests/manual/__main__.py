"""Write the parts of the manual that the program makes: ``python -m tests.manual``.

Rewrites the marked parts of the pages, and the pictures of the gallery.
"""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor

from tests.manual.kinds import KINDS
from tests.manual.made import PICTURES, PICTURES_OF_PAGES, made, pages, picture


def main() -> None:
    """Write all parts and pictures, and name what changed."""
    for path in pages():
        text = made(path)
        if text != path.read_text(encoding="utf-8"):
            path.write_text(text, encoding="utf-8")
            print(path)
    PICTURES.mkdir(exist_ok=True)
    names = [name for members in KINDS.values() for name in members]
    with ProcessPoolExecutor(2) as pool:
        for name, svg in zip(names, pool.map(picture, names), strict=True):
            keep(name, svg)
    for name, picture_of in PICTURES_OF_PAGES.items():
        keep(name, picture_of())


def keep(name: str, svg: str) -> None:
    """Write a picture, and name it where it changed."""
    path = PICTURES / f"{name}.svg"
    if not path.exists() or path.read_text(encoding="utf-8") != svg:
        path.write_text(svg, encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main()
