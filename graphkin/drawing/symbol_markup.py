"""Names of points, vectors and lines as the markup of their symbols on paper."""

from __future__ import annotations

import re
from functools import lru_cache

from graphkin.text.markup import Markup

NAME = (
    r"^(?P<times>\d*)(?P<letter>[^\W\d_¹²]+)(?P<index>\d*(?:,\w+?)?)(?P<prime>[′″‴⁗]?)"
    r"(?:_(?P<sub>[^\W¹²](?:[\w,]*[^\W¹²])?))?(?P<tag>[¹²]*)(?:\^(?P<sup>\w))?$"
)
SPECIAL = "\\*_^{}"
"""The control characters of the markup."""
FOURTH = "⁗"
TAGS = {"¹": "I", "²": "II"}
"""The tags of two auxiliary plans as written: as indices, so that they do not read as powers."""
WITHIN = ({"¹": "a", "²": "b"}, TAGS)
"""The tags of plans within one of these, then within one of those: Ia, IbII."""


def escape(text: str) -> str:
    """Escape plain text for use in markup."""
    return "".join("\\" + sign if sign in SPECIAL else sign for sign in text)


def tag_words(tag: str) -> str:
    """The tag of an auxiliary plan as written, after those of the plans around it."""
    written = (WITHIN[k % 2][sign] for k, sign in enumerate(tag[1:]))
    return "".join((TAGS.get(tag[:1], ""), *written))


@lru_cache(maxsize=1024)
def symbol(name: str, short: str = "") -> Markup:
    """The symbol of a name, or of its unique ``short`` form."""
    said = Markup(written(short or name))
    said.names = frozenset((name,)) if name else frozenset()
    return said


def written(name: str) -> str:
    """Markup of a name: O1 with its index, b⁗, a_BA^ν with two scripts, b¹ with its plan.

    Empty for an empty name.
    """
    found = re.match(NAME, name)
    if not name or name.isdigit():
        return name
    if not found:
        return f"*{escape(name)}*"
    times, letter, index, prime = found.group("times", "letter", "index", "prime")
    sub, sup, tag = found.group("sub", "sup", "tag")
    apart = "," if index and sub and sub[0].isdigit() else ""
    scripts = f"{index}{apart}{sub or ''}".removeprefix(",")
    scripts = ",".join(filter(None, (scripts, tag_words(tag))))
    low = f"_{{{escape(scripts)}}}" if scripts else ""
    high = f"^{{{sup}}}" if sup else "^{IV}" if prime == FOURTH else ""
    return f"{times}*{letter}*{'' if prime == FOURTH else prime}{low}{high}"


def without_index(name: str) -> str:
    """A name without the part that NAME writes as an index: B‴ of B‴_BA."""
    return name.partition("_")[0]


def of_wheel(letter: str, sign: str) -> Markup:
    """Markup of a wheel's radius or number of teeth, by the wheel's label: r₂′."""
    return Markup(f"*{letter}*_{{{escape(sign)}}}")


def bar(p: str, q: str) -> Markup:
    """Markup of the bar between two points: O₁A."""
    return symbol(p) + symbol(q)
