"""The languages of students in a class list, by code or by name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphkin.classroom.roster.spreadsheets import folded
from graphkin.classroom.roster.student import Student

HEADS = ("language", "lang", "limba", "limbă", "lingua", "roster language", "roster limba")
"""The names of a column of languages."""
NAMES = {
    "de": "de ger deu german deutsch germana tedesco tedesca",
    "es": "es spa spanish espanol spaniola spagnolo spagnola",
    "fr": "fr fre fra french francais franceza francese",
    "ru": "ru rus russian русскии русский rusa russo russa",
    "ro": "ro rou ron rum roman romana romanian romanesc romaneste romeno rumeno",
    "en": "en eng english engleza englez inglese",
    "it": "it ita italian italiana italiano italieneste",
}
"""The names of each language, without diacritics."""
FEW = 3
"""The number of students named when many have the same unknown language."""
CODES = {name: code for code, names in NAMES.items() for name in names.split()}


def language_in(text: str) -> str | None:
    """The code of a language given by code or name; None if the pages do not have that language."""
    return CODES.get(folded(text)) or CODES.get(folded(text.partition("-")[0]))


def named_languages(roster: str, students: Iterable[Student]) -> Iterator[tuple[str, str]]:
    """The languages in a class list, each as (cell and student, text of the cell)."""
    heads = {folded(head) for head in HEADS}
    for each in students:
        for head, text in each.extra.items():
            if folded(head) in heads:
                cell = f'{roster}, row {each.row}, column "{head}"'
                yield f"{cell}, {each.called}", text


def unknown_lines(named: Iterable[tuple[str, str]]) -> Iterator[str]:
    """A line for each language that the pages do not have, with the first students who have it."""
    unknown: dict[str, list[str]] = {}
    for who, text in named:
        if text and language_in(text) is None:
            unknown.setdefault(text, []).append(who)
    for text, every in unknown.items():
        more = f" and {len(every) - FEW} more" if len(every) > FEW else ""
        found = f'"{text[:40]}" is no language of the pages'
        whose = f"{'; '.join(every[:FEW])}{more}"
        known = ", ".join(sorted(NAMES))
        yield f"{whose}: {found} ({known}); theirs are in that of the class"
