"""The words and marks of a printed sheet, read from its SVG file alone."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path
from xml.etree import ElementTree

SIGNS = r"[′″‴]*(?:_\{[^}]*\})?(?:\^\{IV\})?"
NAME = rf"[A-Za-z]{SIGNS}"
"""The name of a point as it is printed."""
LINK = r"\w+"
"""What a link is called: a number or a word."""
WHEEL, RADIUS = rf"{LINK}[′″‴]*", r"r_\{[^}]*\}"
"""What a wheel is called, one of several of a link by its strokes, and the symbol of its radius."""
FOOT = 201.0
"""Where the drawings of an A3 sheet end, in mm from its upper edge."""
NUMBER = r"−?\d+(?:\.\d+)?"
MARKED, ENLARGED = {"pin", "point", "pole", "centre"}, {"inset", "detail", "scheme"}
"""The kinds of circles that mark a point, and those of them that stand in a lens."""


ENGLISH = Path(__file__).parents[2] / "graphkin" / "text" / "en.toml"
PAGE = tomllib.loads(ENGLISH.read_text(encoding="utf-8"))["page"]
"""The sentences of English pages; only where headings begin is taken from them."""


def opening(key: str) -> str:
    """The words with which a heading of an English page begins, up to its first value."""
    return re.split(r" ?[{(]", PAGE[key])[0]


MECHANISM, DATA, LINKS = opening("mechanism_heading"), f"{opening('data')}: ", opening("members")
CHECKED = opening("verified").partition(" vector")[0]
CONSTRUCTION = opening("construction").partition(",")[0]
PARTS = (CONSTRUCTION, MECHANISM, CHECKED)
"""How lines begin that end the data of a continuation sheet."""
ENDS = (*PARTS, DATA, *map(opening, ("flattest", "goes_on", "goes_below")))
"""How lines begin that end a sentence."""


@dataclass
class Printed:
    """The words and marks of one sheet."""

    lines: list[str]
    marks: dict[str, complex]
    cells: list[str]
    """The table of the data: each name, and below it its value."""

    @property
    def sentences(self) -> list[str]:
        """The numbered sentences of the construction, each in one line."""
        found: list[str] = []
        open_at = -1
        for line in self.lines:
            if re.fullmatch(r"\d+\.", line):
                found.append("")
                open_at = int(line[:-1])
            elif line.startswith(ENDS):
                open_at = -1
            elif open_at > 0:
                found[-1] = f"{found[-1]} {line}".strip()
        return found

    @property
    def data(self) -> str:
        """The given data, in one line: the table's, and what stands beside it."""
        stop = next(n for n, line in enumerate(self.lines) if line.startswith(MECHANISM))
        pairs = zip(self.cells[::2], self.cells[1::2], strict=True)
        listed = [f"{name} {'' if value[0] == '(' else '= '}{value}" for name, value in pairs]
        said, moved = self.lines[:stop], self.lines[stop:]
        at = next((n for n, line in enumerate(moved) if line.startswith(DATA)), None)
        if at is not None:
            rest = moved[at:]
            said = rest[: next((n for n, x in enumerate(rest) if x.startswith(PARTS)), len(rest))]
        return "; ".join([*listed, " ".join(said).removeprefix(DATA).strip()])

    @property
    def scale(self) -> float:
        """The millimetres of the mechanism that one of paper stands for."""
        line = next(line for line in self.lines if line.startswith(MECHANISM))
        drawn, real = re.findall(r"[\d.]+", line)[:2]
        return float(real) / float(drawn)

    @property
    def links(self) -> dict[str, str]:
        """What the links are by their numbers, as a task lists them."""
        at = next((n for n, line in enumerate(self.lines) if line.startswith(LINKS)), None)
        if at is None:
            return {}
        rest = takewhile(lambda line: not line.startswith(ENDS), self.lines[at:])
        listed = rf"({LINK}) = ((?:[a-z]+ )?(?:[A-Z]{SIGNS})+)(?=[ ,]|$)"
        return dict(re.findall(listed, " ".join(rest)))


def printed_sheets(path: Path) -> Printed:
    """The words of a sheet and of its continuation sheets, and the marks of the first."""
    first = printed(path)
    for more in sorted(path.parent.glob(f"{path.stem}-[0-9].svg")):
        first.lines += printed(more).lines
    return first


def printed(path: Path) -> Printed:
    """The words and marks of an SVG file: indices as ``_{…}``, exponents as ``^{…}``."""
    lines: list[str] = []
    cells: list[str] = []
    marks = {}
    for item in ElementTree.parse(path).iter():
        kind = set((item.get("class") or "").split())
        name = item.get("data-name")
        if item.tag.endswith("}text") and kind == {"caption"}:
            lines.append(marked_up(item))
        elif item.tag.endswith("}text") and kind == {"table"} and name == "data":
            cells.append(marked_up(item))
        elif item.tag.endswith("}circle") and name and kind & MARKED and not kind & ENLARGED:
            x, y = float(item.get("cx", 0)), float(item.get("cy", 0))
            if y < FOOT:  # below stands the scheme, which is not to scale
                marks[name] = complex(x, -y)
    return Printed(lines, marks, cells)


def marked_up(item: ElementTree.Element) -> str:
    """The words of one text, what stands below or above its line in braces."""
    spans = list(item) or [item]
    size = max(float(span.get("font-size", 0)) for span in spans)
    line = next(float(s.get("y", 0)) for s in spans if float(s.get("font-size", 0)) == size)
    words = ""
    for span in spans:
        text, below = span.text or "", float(span.get("y", 0)) - line
        if abs(below) < 0.05:
            words += text
        else:
            bare = text.rstrip(" ")
            words += ("_{" if below > 0 else "^{") + bare + "}" + text[len(bare) :]
    return words.replace("\xa0", " ")


def canonical(name: str) -> str:
    """The name of a mark: O_{1} is O1, a′_{3} is a′_3, b_{BA}^{IV} is b⁗_BA."""
    match = re.fullmatch(r"([A-Za-z])([′″‴]*)_?\{?([^}^]*)\}?(\^\{IV\})?", name)
    assert match, name
    letter, primes, index, fourth = match.groups()
    whole = letter.isupper() and not (primes or fourth)
    index = index if whole or not index else f"_{index}"
    return letter + ("⁗" if fourth else primes) + index


def bare(name: str) -> str:
    """A name without the signs that set its parts apart: t1′_2 and t′_12 are one."""
    letter, rest = name[0], name[1:].replace("_", "").replace(",", "")
    primes = "".join(sign for sign in rest if sign in "′″‴⁗")
    index = "".join(sign for sign in rest if sign not in "′″‴⁗")
    index = re.sub("II$", "²", index) if index.endswith("II") else re.sub("I$", "¹", index)
    return letter + primes + index


def number(text: str) -> float:
    return float(text.replace("−", "-"))
