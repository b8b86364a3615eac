"""The names of points of links that lie under others: A@3 is the point of link 3 under A."""

from __future__ import annotations

SIGN = "@"
"""What joins the name of a point and the link that it is of."""


def ends_of(name: str) -> tuple[str, str]:
    """The name of a point, and the link that it is of; nothing for a point of its own."""
    point, _, link = name.partition(SIGN)
    return point, link


def under(point: str, link: str) -> str:
    """The name, of the same kind, of the point of a link under another point."""
    return type(point)(f"{point}{SIGN}{link}")


def is_under(name: str) -> bool:
    """Whether a name is that of a point of a link under another one."""
    return SIGN in name


def lettered(name: str) -> str:
    """The letters of a point, as the index of a symbol too: A, and A3 for A@3.

    A comma keeps the link apart where the point's own name ends in digits or the link has a word.
    """
    point, link = ends_of(name)
    apart = "," if link and not (link.isdigit() and point[-1:].isalpha()) else ""
    return point + apart + link
