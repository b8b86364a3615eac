"""A small markup for formulas and labels, laid out into runs at absolute places.

- ``*v*`` is italic, ``_{BA}`` or ``_2`` a subscript, ``^{ν}`` or ``^2`` a superscript.
- An adjacent subscript and superscript start at the same place.
- An exponent follows an index of more than two characters.
- An index after a prime is placed below the prime.
- A backslash takes the next character literally.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

from graphkin.text import paths
from graphkin.text.errors import Message, PageError, message

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
    """The font's metrics, read once."""
    import json
    from pathlib import Path

    text = Path(FOLDER, "metrics.json").read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found


@lru_cache(maxsize=1)
def capital() -> float:
    """The height of capitals in em (0.729)."""
    return float(table()["capHeight"] / table()["unitsPerEm"])


def size_for(height: float) -> float:
    """The font size in mm whose capitals are ``height`` mm high."""
    return height / capital()


@lru_cache(maxsize=2)
def measures(italic: bool) -> dict[str, Measure]:
    """Advance, lowest and highest ink of each character of a face, in em, y up."""
    em = table()["unitsPerEm"]
    signs = table()["italic" if italic else "upright"].items()
    return {chr(int(code)): (a / em, low / em, high / em) for code, (a, low, high) in signs}


def missing(text: str, italic: bool) -> PageError:
    """The error that names the characters of a text that the font does not have."""
    signs = sorted(set(text) - measures(italic).keys())
    names = ", ".join(f"“{sign}” (U+{ord(sign):04X})" for sign in signs)
    return PageError.at(
        message("text “{text}”", text=text),
        message("{names} not in the sheet's font", names=names),
        message("Latin, Greek, mathematics"),
    )


def advance(text: str, italic: bool) -> float:
    """The advance width of a text in em. Raises PageError for characters not in the font."""
    face = measures(italic)
    try:
        return sum(face[sign][0] for sign in text)
    except KeyError:
        raise missing(text, italic) from None


def ink(text: str, italic: bool) -> tuple[float, float] | None:
    """The lowest and the highest ink of a text in em, y up; None if it is blank."""
    face = measures(italic)
    found = [face[sign] for sign in text if sign not in BLANKS]
    if not found:
        return None
    return min(low for _, low, _ in found), max(high for _, _, high in found)


def known(text: str) -> str:
    """Replace characters that the font has under another code: ⟂ by ⊥, thin blanks."""
    return text if text.isascii() and text.isprintable() else text.translate(ALIKE)


def font_file(italic: bool) -> Path:
    """The TrueType file of a face."""
    from pathlib import Path

    return Path(FOLDER, f"{FILES[italic]}.ttf")


@lru_cache(maxsize=2)
def font_face(italic: bool) -> str:
    """The @font-face rule that embeds a whole face in a style sheet."""
    from base64 import b64encode
    from pathlib import Path

    data = b64encode(Path(FOLDER, f"{FILES[italic]}.woff2").read_bytes()).decode("ascii")
    style = "italic" if italic else "normal"
    return (
        f'@font-face{{font-family:"{FAMILY}";font-style:{style};font-weight:400;'
        f'src:url(data:font/woff2;base64,{data}) format("woff2")}}'
    )


# --- the markup, laid out into runs at absolute places --------------------------------------------


SUB, SUP, SMALL = 0.24, -0.48, 0.70  # em: shifts (y down) and size of scripts
OVERHANG = {"f": 0.14}
"""Overhang in em of slanted letters over an upright character or exponent after them."""
CLEAR = 0.1
"""Least distance in mm between characters of adjacent lines."""
PRIMES = "′″‴"
"""Characters after a letter below which its index is placed."""
STACKED = 2
"""Length of the longest index above which an exponent may be placed."""
TOKEN = r"(?s)[_^](?:\{|\\.|.|$)|\\.|[^\\*_^}]+|."
UNITS = (
    r"(?:mm|cm|m|in|ft|lbf|lb|s|rad|deg|rev/min|rot/min|мм|см|м|с|рад|об/мин)\b"
    r"|\((?:(?:mm|cm|m|in|ft)/s|(?:мм|см|м)/с)"
)
NUMBERED = (
    *("link", "links", "wheel", "wheels", "gear", "gears", "guide", "guides"),
    *("plate", "rack", "track", "cam"),
    *("elementul", "elementului", "elementele", "elementelor", "roata", "roții", "roțile"),
    *("ghidajul", "ghidajului", "cremaliera", "cama"),
    *("membro", "membri", "ruota", "ruote", "dentata", "guida", "piastra", "dentiera", "camma"),
    *("Glied", "Glieder", "Rad", "Räder", "Zahnrad", "Führung", "Gleitstein", "Kurvenscheibe"),
    *("membre", "membres", "roue", "roues", "dentée", "coulisseau", "came", "plaque"),
    *("eslabón", "eslabones", "rueda", "ruedas", "guía", "deslizadera", "leva", "placa"),
    *("звено", "звена", "звене", "звенья", "звеньев", "колесо", "колеса", "колесу", "колесом"),
    *("направляющая", "направляющей", "ползун", "ползуна", "кулачок", "кулачка"),
)
"""Words, in all languages, that stay in one line with the number or single letter after them."""
AFTER_WORD = "".join(rf"(?<!\b{word} )" for word in NUMBERED)
GAP = (
    rf"(?<![=⊥∥÷]) (?![=.])(?!(?:(?<=[\d}}] )|(?<=\d\) )|(?<= \. ))(?:{UNITS}))"
    rf"(?:{AFTER_WORD}|(?!\d|[^\W_]\b))"
)
"""Blanks at which a line may end.

A line does not end at these places:

- before a unit or =, and after ⊥, ∥ or ÷;
- between the dots of a blank to fill in;
- between a link, a wheel or a guide and its number.
"""
EQUAL = "(?<= =) "
"""Blanks after =, at which a line ends only where there is no other place."""
WORDS = "[^ ]+(?: [^ ]+)* ?"


class TextRun(NamedTuple):
    """A piece of text in one face and size: offsets of its baseline's start and font size in mm."""

    text: str
    x: float
    y: float
    size: float
    italic: bool


class TextPiece(NamedTuple):
    """A piece of marked-up text before it is placed; level −1 is a subscript, 1 a superscript."""

    text: str
    italic: bool
    level: int


def plain(markup: str) -> str:
    """The text of a markup without its control characters."""
    return "".join(piece.text for piece in pieces(markup))


def broken(markup: str, found: Message) -> PageError:
    """The error for a markup that cannot be read."""
    hint = message("write \\* \\_ \\^ \\{{ \\}} for the signs themselves")
    return PageError.at(message("markup “{markup}”", markup=markup), found, hint=hint)


def pieces(markup: str) -> list[TextPiece]:
    """The pieces of a markup, each of one face and one level."""
    found: list[TextPiece] = []
    italic, level = False, 0
    for token in re.findall(TOKEN, markup):
        if token == "*":
            italic = not italic
        elif token == "}" and level:
            level = 0
        elif token[0] in "_^":
            if level:
                raise broken(markup, message("a script within a script"))
            level = -1 if token[0] == "_" else 1
            if token[1:] != "{":
                add(found, TextPiece(literal(markup, token[1:]), italic, level))
                level = 0
        else:
            add(found, TextPiece(literal(markup, token), italic, level))
    if italic or level:
        raise broken(markup, message("an italic or a script that does not end"))
    return found


def literal(markup: str, token: str) -> str:
    """The characters of a token."""
    if token in ("", "*", "_", "^", "\\"):
        raise broken(markup, message("a sign of the markup on its own"))
    return known(token[1:] if token[0] == "\\" else token)


def add(found: list[TextPiece], piece: TextPiece) -> None:
    """Append a piece, joined to the last one if face and level are the same."""
    if found and found[-1][1:] == piece[1:]:
        piece = TextPiece(found.pop().text + piece.text, piece.italic, piece.level)
    found.append(piece)


@lru_cache(maxsize=4096)
def laid(markup: str, height: float) -> tuple[tuple[TextRun, ...], float]:
    """The pieces of a markup placed one after another: the runs and the total width in mm."""
    full = size_for(height)
    shift = {0: 0.0, -1: SUB * full, 1: SUP * full}
    x = 0.0  # start of the next piece on the line
    ends = {-1: 0.0, 1: 0.0}  # end of each script
    start = 0.0  # start of scripts
    index = ""  # the subscript with which they begin
    lean = 0.0  # overhang of a slanted letter over an upright character or exponent after it
    found: list[TextRun] = []
    for text, italic, level in pieces(markup):
        size = full * SMALL if level else full
        if level:
            index = text if level < 0 else index
            after = level > 0 and text.isdigit() and len(index) > STACKED
            begin = max(start + lean, ends[-1 if after else 1]) if level > 0 else ends[-1]
            ends[level] = begin + advance(text, italic) * size
            x = max(x, ends[level])
        else:
            begin = x if italic else x + lean
            x = start = begin + advance(text, italic) * size
            primes = text[len(text.rstrip(PRIMES)) :]
            ends, index = {-1: start - advance(primes, italic) * size, 1: start}, ""
            lean = OVERHANG.get(text[-1], 0.0) * size if italic else 0.0
        found.append(TextRun(text, begin, shift[level], size, italic))
    return tuple(found), x


@lru_cache(maxsize=4096)
def spaced_runs(markup: str, height: float) -> tuple[TextRun, ...]:
    """The runs with at most one blank at an end, so that words stay separate in a search."""
    found: list[TextRun] = []
    for run in laid(markup, height)[0]:
        if run.text[0] == " " and found and not found[-1].text.endswith(" "):
            found[-1] = found[-1]._replace(text=found[-1].text + " ")
        if run.text[0] == " " or "  " in run.text:
            found += split(run)
        else:
            found.append(run)
    return tuple(found)


def split(run: TextRun) -> Iterator[TextRun]:
    """Split a run at double blanks and drop leading ones; the rest keeps its place."""
    for match in re.finditer(WORDS, run.text):
        skipped = advance(run.text[: match.start()], run.italic) * run.size
        yield TextRun(match[0], run.x + skipped, run.y, run.size, run.italic)


@lru_cache(maxsize=4096)
def runs(markup: str, height: float) -> tuple[TextRun, ...]:
    """The runs of a markup for capitals ``height`` mm high, without blanks at their ends."""
    stripped = (run._replace(text=run.text.rstrip(" ")) for run in spaced_runs(markup, height))
    return tuple(run for run in stripped if run.text)


@lru_cache(maxsize=4096)
def extent(markup: str, height: float) -> tuple[float, float, float]:
    """The width, top and bottom of the ink in mm from the baseline's start (y down)."""
    placed, width = laid(markup, height)
    tops, bottoms = [], []
    for run in placed:
        found = ink(run.text, run.italic)
        if found:
            tops.append(run.y - found[1] * run.size)
            bottoms.append(run.y - found[0] * run.size)
    return width, min(tops, default=0.0), max(bottoms, default=0.0)


def are_clear(lines: Sequence[str], height: float, leading: float) -> bool:
    """Whether no character of a line comes near one of the line above, at a given leading in mm."""
    return all(
        extent(above, height)[2] + CLEAR - extent(below, height)[1] <= leading
        or not nearer(above, below, height, leading)
        for above, below in pairwise(lines)
    )


def nearer(above: str, below: str, height: float, leading: float) -> bool:
    """Whether a character of a line is less than CLEAR above one of the line below."""
    reached = extent(below, height)[1] + leading - CLEAR
    low = [box for box in signs(above, height) if box[3] > reached]
    return any(
        left < end and start < right and bottom + CLEAR > leading + top
        for left, right, _, bottom in low
        for start, end, top, _ in signs(below, height)
    )


@lru_cache(maxsize=1024)
def signs(markup: str, height: float) -> tuple[tuple[float, float, float, float], ...]:
    """Left, right, top and bottom of the ink of each character, from the baseline's start."""
    boxes: list[tuple[float, float, float, float]] = []
    for run in laid(markup, height)[0]:
        x = run.x
        for sign in run.text:
            end, found = x + advance(sign, run.italic) * run.size, ink(sign, run.italic)
            if found:
                boxes.append((x, end, run.y - found[1] * run.size, run.y - found[0] * run.size))
            x = end
    return tuple(boxes)


def words_of(markup: str) -> list[str]:
    """Pieces of markup between which a line may end: a number stays with its unit."""
    return re.split(GAP, markup)


def narrow_words(markup: str, width: float, height: float) -> list[str]:
    """The words of a markup; one wider than a width in mm may also be split after =."""
    return [
        part
        for word in words_of(markup)
        for part in (re.split(EQUAL, word) if extent(word, height)[0] > width else [word])
    ]


def flowed(pieces: Sequence[str], mark: str, width: float, height: float) -> list[str]:
    """Pieces of markup joined by a mark into lines no wider than a width in mm."""
    return [line for line, _ in flowed_pieces(pieces, mark, width, height)]


def flowed_pieces(
    pieces: Sequence[str], mark: str, width: float, height: float
) -> list[tuple[str, list[int]]]:
    """The lines of ``flowed``, each with the numbers of its pieces."""
    lines: list[tuple[str, list[int]]] = []
    blank = laid(" ", height)[1]
    reached: float | None = None  # width of the last line, where it is known
    for i, piece in enumerate(pieces):
        text = piece + (mark.rstrip() if i < len(pieces) - 1 else "")
        alone = width_alone(text, height)
        if lines:
            before, held = lines[-1]
            longer = f"{before} {text}"
            if reached is None or alone is None:
                end = extent(longer, height)[0]
            else:
                end = reached + blank + alone
            if end <= width:
                lines[-1], reached = (longer, [*held, i]), end
                continue
        lines.append((text, [i]))
        reached = alone
    return lines


@lru_cache(maxsize=4096)
def width_alone(markup: str, height: float) -> float | None:
    """The width of a piece of markup; None where it is complete only with its neighbours."""
    try:
        return laid(markup, height)[1]
    except PageError:
        return None
