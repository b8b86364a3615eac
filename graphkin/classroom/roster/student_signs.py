"""How other tables identify students: by id, sheet code, e-mail address or name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Literal

from msgspec import Struct, field

from graphkin.classroom.roster.spreadsheets import folded

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
