"""Moodle as its documentation has it: reads its XML and the gaps of embedded answers, and marks."""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Iterator
from html import unescape
from xml.etree import ElementTree

from msgspec import Struct

START = re.compile(r"\{(\d*):(NUMERICAL|NM|MULTICHOICE|MC|SHORTANSWER|SA):")
SHARE = re.compile(r"=|%(-?\d+(?:[.,]\d*)?)%")
NUMBER = r"-?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][-+]?\d+)?"
NUMERIC = re.compile(rf"({NUMBER})(?::({NUMBER}))?")


class Answer(Struct, frozen=True):
    """One answer of a gap: its text, how far a number may be off, its share, what is said."""

    text: str
    allowed: float
    share: float
    feedback: str


class Read(Struct, frozen=True):
    """A gap as it is read."""

    kind: str
    weight: int
    answers: tuple[Answer, ...]

    def share(self, given: str) -> tuple[float, str]:
        """What an answer earns of the gap's points, by the first that fits, and what is said."""
        for each in self.answers:
            if self.kind == "NUMERICAL":
                fits = abs(float(given) - float(each.text)) <= each.allowed
            else:
                fits = given == each.text
            if fits:
                return each.share, each.feedback
        return 0.0, ""


class Asked(Struct, frozen=True):
    """A question: its category, its name, its text with the gaps, its files."""

    category: str
    name: str
    text: str
    gaps: tuple[Read, ...]
    files: dict[str, bytes]


def gaps(text: str) -> Iterator[Read]:
    """The gaps of a text, from left to right; each ends at the first bare }."""
    place = 0
    while found := START.search(text, place):
        pieces, place = split(text, found.end())
        yield Read(found[2], int(found[1] or 1), tuple(answer(piece, found[2]) for piece in pieces))


def split(text: str, start: int) -> tuple[list[str], int]:
    """The answers of a gap, parted by bare ~, and where the gap ends."""
    pieces, piece, place = [], "", start
    while text[place] != "}":
        if text[place] == "~":
            pieces.append(piece)
            piece = ""
        else:
            piece += text[place]
        place += 1
    return [*pieces, piece], place + 1


def answer(piece: str, kind: str) -> Answer:
    """An answer: its share, then itself up to a # that begins no reference, then what is said."""
    found = SHARE.match(piece)
    share = 0.0 if found is None else 1.0 if found[1] is None else float(found[1]) / 100
    rest = piece[found.end() :] if found is not None else piece
    said = re.search(r"(?<!&)#", rest)
    text, feedback = (rest, "") if said is None else (rest[: said.start()], rest[said.end() :])
    if kind != "NUMERICAL":
        return Answer(unescape(text), 0.0, share, unescape(feedback))
    number = NUMERIC.fullmatch(text)
    assert number is not None, f"{text} is no number"
    return Answer(number[1], float(number[2] or 0), share, unescape(feedback))


def imported(data: bytes) -> list[Asked]:
    """The questions of a file in Moodle's XML format, each under the category before it."""
    quiz = ElementTree.fromstring(data)
    assert quiz.tag == "quiz"
    found, category = [], ""
    for each in quiz:
        assert each.tag == "question"
        if each.get("type") == "category":
            category = each.findtext("category/text") or ""
            continue
        assert each.get("type") == "cloze"
        body = each.find("questiontext")
        assert body is not None and body.get("format") == "html"
        files = {}
        for file in body.findall("file"):
            assert (file.get("path"), file.get("encoding")) == ("/", "base64")
            files[file.get("name") or ""] = b64decode(file.text or "", validate=True)
        text = body.findtext("text") or ""
        name = each.findtext("name/text") or ""
        found.append(Asked(category, name, text, tuple(gaps(text)), files))
    return found
