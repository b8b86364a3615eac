"""The pages of the manual: Markdown files in the order of the index, their sections and keys."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from msgspec import Struct

HERE = Path(__file__).parent
CONVENTIONS = "reference/house"
"""The page of the keys of house.toml, which are no keys of a scene or a lab."""
INDEX = "index"
REFERENCES = ("reference/scene", "reference/lab", "reference/house")
"""The pages that explain keys: those of a scene before those of a lab."""
HEADING = re.compile(r"^(#{1,6}) (.+)$")
FENCE = re.compile(r"^\s*```")
CODE = re.compile(r"`([^`]+)`")
ENTRY = re.compile(r"^[-*] \[(.+?)\]\((.+?)\.md\)", re.MULTILINE)
"""A line of the index that leads to a page."""
ROW = re.compile(r"^\| `")
"""A row of a table about a key."""


class Section(Struct, frozen=True):
    """A heading of a page and the text below it, up to the next heading of any level.

    ``within`` is the title of the nearest higher heading; ``anchor`` ends a link to the section.
    """

    page: str
    level: int
    title: str
    anchor: str
    within: str
    text: str


class Chapter(Struct, frozen=True):
    """A heading of the index, with the names and titles of the pages below it."""

    title: str
    pages: tuple[tuple[str, str], ...]


def text_of(name: str) -> str:
    """The Markdown of a page, by its path below the manual without its ending."""
    return (HERE / f"{name}.md").read_text(encoding="utf-8")


@lru_cache(maxsize=1)
def chapters() -> tuple[Chapter, ...]:
    """The chapters of the manual, as its index lists them."""
    found = (
        Chapter(section.title, tuple((to, title) for title, to in ENTRY.findall(section.text)))
        for section in sections(INDEX)
    )
    return tuple(chapter for chapter in found if chapter.pages)


def names() -> list[str]:
    """The names of all pages in the order of reading, the index first."""
    return [INDEX, *(name for chapter in chapters() for name, _ in chapter.pages)]


@lru_cache(maxsize=128)
def sections(name: str) -> tuple[Section, ...]:
    """The sections of a page in order; lines in code blocks are no headings."""
    found: list[Section] = []
    above: dict[int, str] = {}
    taken: dict[str, int] = {}
    for level, title, text in divided(text_of(name)):
        above = {depth: higher for depth, higher in above.items() if depth < level}
        within = above[max(above)] if above else ""
        anchor = anchor_of(title)
        again = taken[anchor] = taken.get(anchor, -1) + 1
        anchor = f"{anchor}-{again}" if again else anchor
        found.append(Section(name, level, title, anchor, within, text))
        above[level] = title
    return tuple(found)


def divided(text: str) -> Iterator[tuple[int, str, str]]:
    """Level, title and text of each heading of a Markdown text."""
    heading, lines, in_code = None, list[str](), False
    for line in text.splitlines():
        in_code ^= FENCE.match(line) is not None
        found = None if in_code else HEADING.match(line)
        if found is None:
            lines.append(line)
            continue
        if heading is not None:
            yield len(heading[1]), heading[2], "\n".join(lines).strip()
        heading, lines = found, []
    if heading is not None:
        yield len(heading[1]), heading[2], "\n".join(lines).strip()


def anchor_of(title: str) -> str:
    """The end of a link to a heading, as code hosts form it."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


# --- keys -----------------------------------------------------------------------------------------


class KeyEntry(Struct, frozen=True):
    """What the manual says about a key: the section, and its lines or one row of its table."""

    section: Section
    lines: tuple[str, ...]

    @property
    def where(self) -> str:
        """The titles of the section and of the section around it, without marks of code."""
        title, within = self.section.title, self.section.within
        whole = f"{within}, {title}" if self.section.level > 2 and within else title
        return whole.replace("`", "")

    @property
    def address(self) -> str:
        """The address of the section within the web site."""
        return f"{self.section.page}.html#{self.section.anchor}"


@lru_cache(maxsize=1)
def explained() -> dict[str, tuple[KeyEntry, ...]]:
    """The explanations of each key of a scene and of a lab, in the order of the pages.

    A section explains the keys in its title; a row of a table explains the keys in its first cell.
    """
    found: dict[str, list[KeyEntry]] = {}
    for section in (section for name in REFERENCES for section in sections(name)):
        whole = KeyEntry(section, tuple(section.text.splitlines()))
        for key in keys_in(section.title):
            found.setdefault(key, []).append(whole)
        heads: list[str] = []
        for line in section.text.splitlines():
            if ROW.match(line):
                own, *rest = cells(line)
                named = (f"{head}: {cell}" for head, cell in zip(heads[1:], rest, strict=True))
                for key in keys_in(own):
                    found.setdefault(key, []).append(KeyEntry(section, tuple(named)))
            elif line.startswith("| "):
                heads = cells(line)
    return {key: tuple(places) for key, places in found.items()}


def keys_in(text: str) -> list[str]:
    """The keys in a heading or a cell: what is set as code, without brackets."""
    return [key for code in CODE.findall(text) if (key := code.strip("[]"))]


def cells(row: str) -> list[str]:
    """The cells of a row of a table."""
    return [cell.strip() for cell in row.strip().strip("|").split(" | ")]


HEAD_OF_TABLE = re.compile(r"^\s*\[+\s*([^\]]+?)\s*\]+")
WRITTEN = re.compile(r"[\w-]+(?=\s*=)")
ANY_NAME = {"links": "links.NAME", "frame": "frame"}
POINTS = {0: "P", 1: "P-Q", 2: "P-Q-R"}
"""The names under which the reference explains keys made of points, by the dashes in them."""
GENERIC = {"links": POINTS, "frame": POINTS, "branches": {0: "PIN"}}


def address_at(text: str, line: int, column: int) -> str:
    """The address within the web site of what explains the key at a place of a scene or a lab.

    ``line`` and ``column`` count from 0. It is the key at the place, else the key of the line, else
    the table; the index where none of them is explained.
    """
    known = explained()
    lines = text.splitlines()
    here = lines[line] if line < len(lines) else ""
    above = (HEAD_OF_TABLE.match(each) for each in reversed(lines[: line + 1]))
    table = next((head[1].replace(" ", "") for head in above if head), "")
    first = table.partition(".")[0]
    own = next((w[0] for w in WRITTEN.finditer(here) if w.start() <= column <= w.end()), "")
    left = here.partition("=")[0].strip() if "=" in here else ""
    general = GENERIC.get(first, {}).get(left.count("-"), "") if left not in known else ""
    around = {left, ANY_NAME.get(first, first), table} - {""}
    for key in (own, left, general, ANY_NAME.get(first, ""), table, first):
        places = [e for e in known.get(key, ()) if e.section.page != CONVENTIONS]
        near = [e for e in places if not around.isdisjoint(keys_in(e.section.title))]
        if near or (places and (key != own or own == left)):
            return (near or places)[0].address
    return f"{INDEX}.html"
