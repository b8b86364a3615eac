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
    letters, names without blanks and accents too.
    """

    ids: tuple[str, ...] = ()
    exact: Mapping[str, str] = field(default_factory=dict)
    bare: Mapping[str, str] = field(default_factory=dict)
    emails: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)

    def who(self, sign: str) -> str | None:
        """The student whose id, code or address something is; None where it is nobody's."""
        known = self.exact.get(sign) or self.emails.get(sign.casefold())
        return known or (self.bare.get(sign.lstrip("0")) if sign.isdecimal() else None)

    def named(self, name: str) -> str | None:
        """The only student of a name, whichever part of it comes first; None for several."""
        return self.names.get(folded(name))


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
    turned = {(turn, who) for who, name in (names or {}).items() for turn in turns(name)}
    return Signs(every, exact, single(bare), single(mails), single(turned))


def single(pairs: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Pairs as a mapping, without what stands for two."""
    found = sorted(pairs)
    counts = Counter(sign for sign, _ in found)
    return {sign: who for sign, who in found if sign and counts[sign] == 1}


def turns(name: str) -> set[str]:
    """A name as it is compared, its words in their order and begun at any of them."""
    words = name.replace(",", " ").split()
    return {folded("".join(words[i:] + words[:i])) for i in range(len(words))}
