"""The languages that a class list may name for its students, by code or by name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from graphkin.roster.model import Student
from graphkin.roster.tables import folded

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


def unknown_languages(students: Iterable[Student]) -> Counter[str]:
    """What a class list says of languages that is none of the pages', and of how many students."""
    heads = {folded(head) for head in HEADS}
    named = (
        text for each in students for head, text in each.extra.items() if folded(head) in heads
    )
    return Counter(text for text in named if text and language_in(text) is None)
