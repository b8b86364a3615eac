"""By what students are known in other tables: ids, codes of sheets, e-mail addresses, names."""

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
"""What a column of e-mail addresses may be called."""
Match = Literal["", "id", "email"]
"""By which column of a table students are found: by their ids, their addresses, or either."""


class Signs(Struct, frozen=True):
    """What stands for each student in other tables, each with the id.

    ``exact`` are ids and codes of sheets; ``bare`` ids without the zeros at their beginning, which
    spreadsheets take away, where no two are the same so; ``emails`` and ``names`` are in small
    letters, names without blanks and accents too, each with all students of it. ``called`` is the
    name of each student as the class list has it.
    """

    ids: tuple[str, ...] = ()
    exact: Mapping[str, str] = field(default_factory=dict)
    bare: Mapping[str, str] = field(default_factory=dict)
    emails: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    called: Mapping[str, str] = field(default_factory=dict)

    def who(self, sign: str) -> str | None:
        """The student whose id, code or address something is; None where it is nobody's."""
        known = self.exact.get(sign) or self.emails.get(sign.casefold())
        return known or (self.bare.get(sign.lstrip("0")) if sign.isdecimal() else None)

    def named(self, name: str) -> tuple[str, ...]:
        """The students of a name, whichever part of it comes first."""
        return self.names.get(folded(name), ())

    def may_be(self, name: str, who: str) -> bool:
        """Whether a name that is nobody's in the class list shares a word with a student's own."""
        own = self.called.get(who, "").replace(",", " ").split()
        return not own or any(folded(word) in folded(name) for word in own)


def signs(
    ids: Iterable[str],
    codes: Mapping[str, str] | None = None,
    emails: Mapping[str, str] | None = None,
    names: Mapping[str, str] | None = None,
) -> Signs:
    """The signs of a class: its ids; codes, addresses and names by id, as far as there are any."""
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
    """Pairs as a mapping, without what stands for two."""
    found = sorted(pairs)
    counts = Counter(sign for sign, _ in found)
    return {sign: who for sign, who in found if sign and counts[sign] == 1}


def turns(name: str) -> set[str]:
    """A name as it is compared, its words in their order and begun at any of them."""
    words = name.replace(",", " ").split()
    return {folded("".join(words[i:] + words[:i])) for i in range(len(words))}
