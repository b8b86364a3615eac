"""Students: of a class list, with their data, by language, and by the signs of other tables."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from typing import Literal

from msgspec import Struct, field

from graphkin.classroom.roster.spreadsheets import folded


class Student(Struct, frozen=True):
    """One row of a class list; ``row`` is its line in the file, ``extra`` its other columns.

    ``number`` is the student's number in the group, None if the list has none. ``id`` keeps its
    leading zeros.

    A student with several sheets has an entry for each ``part``, counted from 1. Its id is that of
    the ``owner`` in the class list with the number of the part.
    """

    row: int
    id: str
    number: int | None = None
    name: str = ""
    group: str = ""
    extra: Mapping[str, str] = field(default_factory=dict)
    owner: str = ""
    part: int = 0

    @property
    def whose(self) -> str:
        """The id of the student in the class list."""
        return self.owner or self.id

    @property
    def called(self) -> str:
        """The student's name and id, as notes name a student."""
        return f"{self.name} ({self.id})" if self.name else self.id

    @property
    def title(self) -> str:
        """The name by which pages address the student, after the id of one of several sheets."""
        return self.with_part(self.name or self.id)

    def with_part(self, name: str) -> str:
        """A name after the id of one of several sheets: "101-2 Anna Weber"."""
        return f"{self.id} {name}" if self.part and name != self.id else name


Counted = Literal["students", "sheets"]


def counted(students: Iterable[Student]) -> Counted:
    """The name of what entries count: sheets where a student has several."""
    return "sheets" if any(each.part for each in students) else "students"


HEADS = (
    *("language", "lang", "limba", "limbă", "lingua", "roster language", "roster limba"),
    *("sprache", "langue", "idioma", "lengua", "язык"),
)
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


class Taker(Struct, frozen=True):
    """A student who takes part: the parameters of the student's variant, exact and as written.

    ``compute`` are the fields too small to measure, which the student computes. ``code`` is the
    opaque name on the sheets. ``language`` and ``email`` are those of the class list.
    """

    student: Student
    settings: Mapping[str, str]
    code: str = ""
    compute: tuple[str, ...] = ()
    language: str = ""
    email: str = ""

    @property
    def spoken(self) -> str | None:
        """The code of the student's language; None if the student has the language of the class."""
        return language_in(self.language)


EMAIL = (
    "e-mail",
    "email address",
    "mail",
    "username",
    "sis login id",
    "adresă de e-mail",
    "adresă e-mail",
    "indirizzo e-mail",
    "indirizzo di posta elettronica",
    *("e-mail-adresse", "mailadresse", "adresse e-mail", "adresse mail", "courriel"),
    *("correo", "correo electrónico", "dirección de correo"),
    *("почта", "эл. почта", "электронная почта", "адрес электронной почты"),
)
"""The names of a column of e-mail addresses."""
Match = Literal["", "id", "email"]
"""The column in which a table identifies students: ids, addresses, or either if empty."""


class Signs(Struct, frozen=True):
    """Everything that identifies a student in other tables, mapped to the student's id.

    - ``exact`` holds ids and sheet codes.
    - ``bare`` holds ids without leading zeros, which spreadsheets remove, where they stay unique.
    - ``emails`` holds addresses in lower case.
    - ``names`` holds names in lower case without blanks and accents, each with all students of that
      name.
    - ``called`` holds the name of each student as the class list writes it, by id.
    """

    ids: tuple[str, ...] = ()
    exact: Mapping[str, str] = field(default_factory=dict)
    bare: Mapping[str, str] = field(default_factory=dict)
    emails: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    called: Mapping[str, str] = field(default_factory=dict)

    def who(self, sign: str) -> str | None:
        """The id of the student with this id, code or address; None if there is no such student."""
        known = self.exact.get(sign) or self.emails.get(sign.casefold())
        return known or (self.bare.get(sign.lstrip("0")) if sign.isdecimal() else None)

    def sheets(self, owner: str) -> tuple[str, ...]:
        """The ids of the sheets of a student who has several."""
        return tuple(each for each in self.ids if re.fullmatch(f"{re.escape(owner)}-[0-9]+", each))

    def named(self, name: str) -> tuple[str, ...]:
        """The ids of the students with this name, whichever part of the name comes first."""
        return self.names.get(folded(name), ())

    def may_be(self, name: str, who: str) -> bool:
        """Whether a name shares a word with the name of student ``who``.

        True if the class list has no name for the student.
        """
        own = self.called.get(who, "").replace(",", " ").split()
        return not own or any(folded(word) in folded(name) for word in own)


def signs(
    ids: Iterable[str],
    codes: Mapping[str, str] | None = None,
    emails: Mapping[str, str] | None = None,
    names: Mapping[str, str] | None = None,
) -> Signs:
    """The signs of a class: its ids, and the known codes, addresses and names by id."""
    every = tuple(ids)
    exact = {code: who for who, code in (codes or {}).items() if code}
    exact |= {who: who for who in every}
    bare = [(who.lstrip("0"), who) for who in every if who.isdecimal()]
    mails = [(mail.casefold(), who) for who, mail in (emails or {}).items() if mail]
    called = dict(names or {})
    turned: dict[str, dict[str, None]] = {}
    for who, name in called.items():
        for turn in turns(name):
            turned.setdefault(turn, {})[who] = None
    bearing = {turn: tuple(known) for turn, known in turned.items() if turn}
    return Signs(every, exact, single(bare), single(mails), bearing, called)


def single(pairs: Iterable[tuple[str, str]]) -> dict[str, str]:
    """The pairs as a mapping, without signs that belong to more than one student."""
    found = sorted(pairs)
    counts = Counter(sign for sign, _ in found)
    return {sign: who for sign, who in found if sign and counts[sign] == 1}


def turns(name: str) -> set[str]:
    """All rotations of the words of a name, in the form in which names are compared."""
    words = name.replace(",", " ").split()
    return {folded("".join(words[i:] + words[:i])) for i in range(len(words))}
