"""The sheet's font: measures of its signs, read from a table, and the files to embed."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

from graphkin.text import paths
from graphkin.text.errors import PageError, Problem

if TYPE_CHECKING:
    from pathlib import Path

FAMILY = "Graphkin Sans"
FOLDER = paths.beside(__file__, "fonts")
"""The folder of the fonts, as text."""
FILES = {False: "GraphkinSans", True: "GraphkinSans-Italic"}
ALIKE = str.maketrans({"⟂": "⊥", "\u2009": "\u00a0", "\u202f": "\u00a0", "\t": " ", "\n": " "})
BLANKS = " \u00a0"

Measure = tuple[float, float, float]


@lru_cache(maxsize=1)
def table() -> dict[str, Any]:
    """Read the font's metrics once."""
    import json
    from pathlib import Path

    text = Path(FOLDER, "metrics.json").read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found


@lru_cache(maxsize=1)
def capital() -> float:
    """Tell the height of capitals in em (0.729)."""
    return float(table()["capHeight"] / table()["unitsPerEm"])


def size_for(height: float) -> float:
    """Tell the font size in mm whose capitals are ``height`` mm high."""
    return height / capital()


@lru_cache(maxsize=2)
def measures(italic: bool) -> dict[str, Measure]:
    """Tell advance, lowest and highest ink of each sign of a face, in em, y up."""
    em = table()["unitsPerEm"]
    signs = table()["italic" if italic else "upright"].items()
    return {chr(int(code)): (a / em, low / em, high / em) for code, (a, low, high) in signs}


def missing(text: str, italic: bool) -> PageError:
    """Name the signs of a text that the font does not have."""
    signs = sorted(set(text) - measures(italic).keys())
    names = ", ".join(f"“{sign}” (U+{ord(sign):04X})" for sign in signs)
    return PageError(
        Problem(f"text “{text}”", f"{names} not in the sheet's font", "Latin, Greek, mathematics")
    )


def advance(text: str, italic: bool) -> float:
    """Tell how far the pen moves over a text, in em; refuse signs that are not in the font."""
    face = measures(italic)
    try:
        return sum(face[sign][0] for sign in text)
    except KeyError:
        raise missing(text, italic) from None


def ink(text: str, italic: bool) -> tuple[float, float] | None:
    """Tell the lowest and the highest ink of a text in em, y up; None if it is blank."""
    face = measures(italic)
    found = [face[sign] for sign in text if sign not in BLANKS]
    if not found:
        return None
    return min(low for _, low, _ in found), max(high for _, _, high in found)


def known(text: str) -> str:
    """Replace signs the font has under another code: ⟂ by ⊥, thin blanks by fixed ones."""
    return text if text.isascii() and text.isprintable() else text.translate(ALIKE)


def font_file(italic: bool) -> Path:
    """Give the TrueType file of a face."""
    from pathlib import Path

    return Path(FOLDER, f"{FILES[italic]}.ttf")


@lru_cache(maxsize=2)
def font_face(italic: bool) -> str:
    """Write the @font-face rule that carries a whole face inside a style sheet."""
    from base64 import b64encode
    from pathlib import Path

    data = b64encode(Path(FOLDER, f"{FILES[italic]}.woff2").read_bytes()).decode("ascii")
    style = "italic" if italic else "normal"
    return (
        f'@font-face{{font-family:"{FAMILY}";font-style:{style};font-weight:400;'
        f'src:url(data:font/woff2;base64,{data}) format("woff2")}}'
    )
