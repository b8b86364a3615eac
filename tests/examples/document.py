"""Reading the Markdown pages: fenced blocks by heading, and parts put into a whole scene."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from graphkin.manual.pages import anchor_of
from graphkin.manual.pages import divided as divided_by_headings

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
README = ROOT / "README.md"
CONTRIBUTING = ROOT / "CONTRIBUTING.md"
VERSION = "graphkin ="
FENCE = re.compile(r"^```(\w+) ?(.*?)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
ROW = re.compile(r"^\| (\d+) \| (.+) \| `(.+)` \|$", re.MULTILINE)
CODE = re.compile(r"`([^`]+)`")
LINK = re.compile(r"\]\((?!https?:)([^)#\s]*)(?:#([^)\s]+))?\)")


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, the word after it, its line and its text."""

    language: str
    name: str
    line: int
    text: str


@dataclass(frozen=True)
class Mistake:
    """A row of the table of mistakes: its number, the part written, the message."""

    number: int
    part: str
    message: str


def blocks_in(text: str) -> list[Block]:
    """The fenced blocks of a text."""
    return [
        Block(found[1], found[2], line_of(text, found), found[3]) for found in FENCE.finditer(text)
    ]


def anchors(page: Path) -> set[str]:
    """What a link to a heading of a page may end with."""
    return {anchor_of(title) for _, title, _ in divided_by_headings(page.read_text("utf-8"))}


def links(page: Path) -> Iterator[tuple[Path, str]]:
    """Each link of a page to a file of the project, and the heading that it names there, if any."""
    for to, heading in LINK.findall(page.read_text(encoding="utf-8")):
        yield page.parent / to if to else page, heading


def line_of(text: str, found: re.Match[str]) -> int:
    """The line on which a block begins, counted from one."""
    return text.count("\n", 0, found.start()) + 1


def mistakes(page: Path) -> list[Mistake]:
    """The rows of the table of mistakes; each piece of code in the second column is a line."""
    rows = ROW.findall(page.read_text(encoding="utf-8"))
    return [
        Mistake(int(number), "\n".join(CODE.findall(part)), said) for number, part, said in rows
    ]


def with_part(whole: str, part: str) -> str:
    """A scene with a part of it in place of what has the same headings."""
    top, sections = divided(whole)
    new_top, new_sections = divided(part)
    keys = {key_of(line) for line in new_top.splitlines()} - {""}
    kept = "".join(f"{line}\n" for line in top.splitlines() if key_of(line) not in keys)
    for name, text in sections.items():
        kept += new_sections.pop(name, text)
    lines = kept.splitlines()
    head = [line for line in new_top.splitlines() if line.strip()]
    return "\n".join([*lines[:1], *head, *lines[1:], *new_sections.values()]) + "\n"


def divided(text: str) -> tuple[str, dict[str, str]]:
    """The lines before the first heading, and each section by the name in its brackets."""
    top, *rest = re.split(r"^(?=\[)", text, flags=re.MULTILINE)
    sections: dict[str, str] = {}
    for section in rest:
        name = section.partition("]")[0].strip("[")
        sections[name] = sections.get(name, "") + section.rstrip() + "\n\n"
    return top, sections


def key_of(line: str) -> str:
    """The key of a line such as ``time = 2``; empty for a comment or an empty line."""
    key, equals, _ = line.partition("=")
    return key.strip() if equals and not line.startswith("#") else ""
