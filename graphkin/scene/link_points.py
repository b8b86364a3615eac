"""The names of points of links under other points: A@3 is the point of link 3 under A."""

from __future__ import annotations

SIGN = "@"
"""The separator between a point and its link."""


def ends_of(name: str) -> tuple[str, str]:
    """The name of a point, and its link; the link is empty for an ordinary point."""
    point, _, link = name.partition(SIGN)
    return point, link


def under(point: str, link: str) -> str:
    """The name, of the same type, of a link's point under another point."""
    return type(point)(f"{point}{SIGN}{link}")


def is_under(name: str) -> bool:
    """Whether a name is that of a link's point under another point."""
    return SIGN in name


def lettered(name: str) -> str:
    """The letters of a point, also as the index of a symbol: A, and A3 for A@3.

    A comma separates the link where the point's name ends in digits or the link is a word.
    """
    point, link = ends_of(name)
    apart = "," if link and not (link.isdigit() and point[-1:].isalpha()) else ""
    return point + apart + link
