"""Names of points, vectors and lines as the markup of their symbols on paper."""

from __future__ import annotations

import re

from graphkin.paper.richtext import escape

NAME = re.compile(
    r"^(?P<letter>[^\W\d_]+)(?P<index>\d*)(?P<prime>[′″‴⁗]?)(?:_(?P<sub>[\w,]+))?"
    r"(?:\^(?P<sup>\w))?$"
)
FOURTH = "⁗"


def symbol(name: str) -> str:
    """Markup of a name: O1 gets its index, b⁗ its numeral, a_BA^ν its two scripts."""
    found = NAME.match(name)
    if name.isdigit():
        return name
    if not found:
        return f"*{escape(name)}*"
    letter, index, prime, sub, sup = found.group("letter", "index", "prime", "sub", "sup")
    scripts = "".join(part for part in (index, sub) if part)
    low = f"_{{{escape(scripts)}}}" if scripts else ""
    high = f"^{{{sup}}}" if sup else "^{IV}" if prime == FOURTH else ""
    return f"*{letter}*{'' if prime == FOURTH else prime}{low}{high}"


def bar(p: str, q: str) -> str:
    """Markup of the bar between two points: O₁A."""
    return symbol(p) + symbol(q)
