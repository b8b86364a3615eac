"""The names of coincident points of links: A@3 is the point of link 3 under A."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from graphkin.scene.model import Scene

SIGN = "@"
"""The character between the name of a point and its link."""


def ends_of(name: str) -> tuple[str, str]:
    """A point and its link, from a name; the link is "" for a point of its own."""
    point, _, link = name.partition(SIGN)
    return point, link


def point_of(scene: Scene, name: str) -> str:
    """The name under which a point's motion is found: A for A@3 if link 3 owns A."""
    point, link = ends_of(name)
    return point if link and point in scene.link(link).points else name


def under(point: str, link: str) -> str:
    """The name of the point of a link under another point; it has the type of ``point``."""
    return type(point)(f"{point}{SIGN}{link}")


def is_under(name: str) -> bool:
    """Whether a name is that of a link's point under another point."""
    return SIGN in name


def lettered(name: str) -> str:
    """The label of a point, also as the index of a symbol: A, and A3 for A@3.

    A comma separates the link where the point's name ends in a digit or the link's name is a word.
    """
    point, link = ends_of(name)
    apart = "," if link and not (link.isdigit() and point[-1:].isalpha()) else ""
    return point + apart + link
