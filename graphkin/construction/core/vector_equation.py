"""Vector equations as the school writes them: what is known of each vector stands below it.

Two lines stand under a vector whose size and direction are known, one under a vector of which only
the direction is; equations for one vector are chained.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct


class Term(Struct, frozen=True):
    """A vector under its ``symbol``: of its size and direction, how many are ``known``, and how."""

    symbol: str
    known: int = 0
    note: str = ""


class VectorEquation(Struct, frozen=True):
    """A vector that is one or more ``sums`` of others; without any, what is known of it alone."""

    whole: Term
    sums: tuple[tuple[Term, ...], ...] = ()

    @property
    def markup(self) -> str:
        """It in one line, without what is known."""
        sums = (" + ".join(term.symbol for term in terms) for terms in self.sums)
        return " = ".join((self.whole.symbol, *sums))


def chained(equations: Sequence[VectorEquation]) -> list[VectorEquation]:
    """Those for one vector as one, where the first of them stands."""
    found: dict[str, VectorEquation] = {}
    for each in equations:
        before = found.get(each.whole.symbol)
        if before is None:
            found[each.whole.symbol] = each
            continue
        whole = max(before.whole, each.whole, key=lambda term: term.known)
        found[each.whole.symbol] = VectorEquation(whole, before.sums + each.sums)
    return list(found.values())
