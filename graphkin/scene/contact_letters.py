"""Letters of the points where wheels touch what they roll on: T, or T1, T2 … where several do."""

from __future__ import annotations

import re
from itertools import chain, count

from graphkin.scene.model import Scene

STEMS = ("T", "K", "H")
"""The letters tried in turn; after them come TT, TTT and so on."""


def contact_letters(scene: Scene) -> dict[str, tuple[str, ...]]:
    """The letters of the contacts of each link that rolls, in the order written.

    One contact alone has no number, so that T3, the point of link 3 at the contact T, is no
    other contact. A letter that a point of the scene has, in either size, is left to it.
    """
    total = sum(len(link.rolls) for link in scene.every_link)
    stem = free_stem(scene)
    numbers = iter(range(1, total + 1))
    return {
        link.name: tuple(f"{stem}{next(numbers)}" if total > 1 else stem for _ in link.rolls)
        for link in scene.every_link
        if link.rolls
    }


def free_stem(scene: Scene) -> str:
    """The first letter that no point of the scene has, alone or before a number."""
    names = {point.upper() for link in scene.every_link for point in link.points}
    taken = {re.sub(r"\d+$", "", name) for name in names}
    return next(s for s in chain(STEMS, ("T" * n for n in count(2))) if s not in taken)
