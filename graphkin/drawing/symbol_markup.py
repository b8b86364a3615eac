"""Names of points, vectors and lines as the markup of their symbols on paper."""

from __future__ import annotations

import re
from functools import lru_cache

from graphkin.drawing.richtext import escape

NAME = re.compile(
    r"^(?P<times>\d*)(?P<letter>[^\W\d_¹²]+)(?P<index>\d*(?:,\w+?)?)(?P<prime>[′″‴⁗]?)"
    r"(?:_(?P<sub>[^\W¹²](?:[\w,]*[^\W¹²])?))?(?P<tag>[¹²]?)(?:\^(?P<sup>\w))?$"
)
FOURTH = "⁗"
TAGS = {"¹": "I", "²": "II"}
"""The tags of two trial plans as they are written: below, so that none reads as a power."""


@lru_cache(maxsize=1024)
def symbol(name: str) -> str:
    """Markup of a name: O1 gets its index, b⁗ its numeral, a_BA^ν its two scripts, b¹ the
    numeral of its trial; nothing where there is no name."""
    found = NAME.match(name)
    if not name or name.isdigit():
        return name
    if not found:
        return f"*{escape(name)}*"
    times, letter, index, prime = found.group("times", "letter", "index", "prime")
    sub, sup, tag = found.group("sub", "sup", "tag")
    apart = "," if index and sub and sub[0].isdigit() else ""
    scripts = f"{index}{apart}{sub or ''}".removeprefix(",")
    scripts = ",".join(filter(None, (scripts, TAGS.get(tag))))
    low = f"_{{{escape(scripts)}}}" if scripts else ""
    high = f"^{{{sup}}}" if sup else "^{IV}" if prime == FOURTH else ""
    return f"{times}*{letter}*{'' if prime == FOURTH else prime}{low}{high}"


def bar(p: str, q: str) -> str:
    """Markup of the bar between two points: O₁A."""
    return symbol(p) + symbol(q)
