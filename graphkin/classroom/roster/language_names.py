"""The languages that a class list may name for its students, by code or by name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from graphkin.classroom.roster.spreadsheets import folded
from graphkin.classroom.roster.student import Student

HEADS = ("language", "lang", "limba", "limbă", "lingua", "roster language", "roster limba")
"""What the column may be called."""
NAMES = {
    "ro": "ro rou ron rum roman romana romanian romanesc romaneste romeno rumeno",
    "en": "en eng english engleza englez inglese",
    "it": "it ita italian italiana italiano italieneste",
}
"""What each language may be called, without diacritics."""
CODES = {name: code for code, names in NAMES.items() for name in names.split()}


def language_in(text: str) -> str | None:
    """The code of a language by its code or its name; None where it is none of the pages'."""
    return CODES.get(folded(text)) or CODES.get(folded(text.partition("-")[0]))


def named_languages(students: Iterable[Student]) -> Iterator[str]:
    """What a class list says of its students' languages."""
    heads = {folded(head) for head in HEADS}
    return (text for each in students for head, text in each.extra.items() if folded(head) in heads)


def unknown_lines(named: Iterable[str]) -> Iterator[str]:
    """A line for each language that is none of the pages', with how many students it is of."""
    unknown = Counter(text for text in named if text and language_in(text) is None)
    for text, count in unknown.items():
        who = "1 student" if count == 1 else f"{count} students"
        found = f'"{text[:40]}" is no language of the pages'
        yield f"{who}: {found} (ro, en, it); theirs are in that of the class"
