"""Names of points, vectors and lines as the markup of their symbols on paper."""

from __future__ import annotations

import re
from functools import lru_cache

from graphkin.text import Markup
from graphkin.text.school_signs import USUAL, SchoolSigns

NAME = (
    r"^(?P<times>\d*)(?P<letter>[^\W\d_¹²]+)(?P<index>\d*(?:,\w+?)?)(?P<prime>[′″‴⁗]?)"
    r"(?:_(?P<sub>[^\W¹²](?:[\w,]*[^\W¹²])?))?(?P<tag>[¹²]*)(?:\^(?P<sup>\w))?$"
)
SPECIAL = "\\*_^{}"
"""The special characters of the markup."""
FOURTH = "⁗"
TAGS = {"¹": "I", "²": "II"}
"""The tags of two auxiliary plans as written: as a subscript, so that none reads as a power."""
WITHIN = ({"¹": "a", "²": "b"}, TAGS)
"""The tags of plans within these plans, then within those: Ia, IbII."""


def escape(text: str) -> str:
    """Plain text with the special characters of markup escaped."""
    return "".join("\\" + sign if sign in SPECIAL else sign for sign in text)


def tag_words(tag: str) -> str:
    """The tag of an auxiliary plan as written, after the tags of the plans around it."""
    written = (WITHIN[k % 2][sign] for k, sign in enumerate(tag[1:]))
    return "".join((TAGS.get(tag[:1], ""), *written))


@lru_cache(maxsize=1024)
def symbol(name: str, short: str = "", signs: SchoolSigns = USUAL) -> Markup:
    """The symbol of a name with a school's signs.

    It is written as ``short`` if that is given because it is unambiguous.
    """
    said = Markup(written(short or name, signs))
    said.names = frozenset((name,)) if name else frozenset()
    return said


def written(name: str, signs: SchoolSigns = USUAL) -> str:
    """The markup of a name, "" where there is none.

    O1 gets its index, b⁗ its numeral, a_BA^ν its two scripts, b¹ the numeral of its plan.
    """
    found = re.match(NAME, name)
    if not name or name.isdigit():
        return name
    if not found:
        return f"*{escape(name)}*"
    times, letter, index, prime = found.group("times", "letter", "index", "prime")
    sub, sup, tag = found.group("sub", "sup", "tag")
    if signs is not USUAL:
        if not (index or sub) and letter + prime in signs.poles:
            return written(times + signs.poles[letter + prime] + tag)
        letter, sup = signs.letters.get(letter, letter), signs.components.get(sup, sup)
    apart = "," if index and sub and sub[0].isdigit() else ""
    scripts = f"{index}{apart}{sub or ''}".removeprefix(",")
    scripts = ",".join(filter(None, (scripts, tag_words(tag))))
    low = f"_{{{escape(scripts)}}}" if scripts else ""
    high = f"^{{{sup}}}" if sup else "^{IV}" if prime == FOURTH else ""
    return f"{times}*{letter}*{'' if prime == FOURTH else prime}{low}{high}"


def without_index(name: str) -> str:
    """The part of a name before its subscript: B‴ of B‴_BA."""
    return name.partition("_")[0]


def of_wheel(letter: str, sign: str) -> Markup:
    """The markup of a wheel's radius or number of teeth, by the wheel's label: r₂′."""
    return Markup(f"*{letter}*_{{{escape(sign)}}}")


def bar(p: str, q: str) -> Markup:
    """The markup of the bar between two points: O₁A."""
    return symbol(p) + symbol(q)
