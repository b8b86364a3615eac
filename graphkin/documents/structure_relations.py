"""What a calculation begins with: the mobility, and the groups in the order of their solution."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.relation import Relation
from graphkin.drawing.symbol_markup import escape
from graphkin.scene.findings import natural
from graphkin.scene.model import Driver
from graphkin.structure.decomposition import decompose
from graphkin.structure.driver_count import count
from graphkin.structure.groups import (
    ROMAN,
    CamFollower,
    Crank,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    OnTwoPins,
    Spun,
    Stretched,
    Tie,
)
from graphkin.structure.pairs import Sliding
from graphkin.text import Words


def of_structure(drawing: Drawing) -> Iterator[Relation]:
    """Gruebler's count, and each group with its links."""
    words, counted = drawing.words, count(drawing.scene)
    singles = words("calculation.counted_singles", pairs=counted.singles) if counted.singles else ""
    pairs = words("calculation.counted", links=counted.moving, pairs=counted.pairs) + singles
    yield Relation(f"*M* = {counted.words} ({pairs})")
    unseen = drawing.scene.unseen
    *groups, last = [group_words(words, group, unseen) for group in decompose(drawing.scene)]
    first, *more = [*(f"{group};" for group in groups), last]
    yield Relation(first, more=tuple(more))


def group_words(words: Words, group: Group, unseen: frozenset[str] = frozenset()) -> str:
    """A group with its links, by kind, class and order; unseen keepers go without saying."""
    seen = sorted({*group.links} - unseen, key=natural)
    noun = "one_link" if len(seen) == 1 else "many_links"
    numbers = words("list_mark").join(map(escape, seen))
    links = words(f"calculation.{noun}", links=numbers)
    match group:
        case Crank() | Driven() | Spun():
            return words("calculation.group_driven", links=links)
        case OnTwoPins():
            return words("calculation.group_pins", links=links, rail=escape(group.rail))
        case Dyad():
            return words("calculation.group_dyad", links=links, type=group.type)
        case CamFollower():
            return words("calculation.group_cam", links=links, type=group.dyad.type)
        case Stretched():
            one, two = "calculation.group_stretched_one", "calculation.group_stretched_two"
            key = one if len(group.cylinders) == 1 else two
            return words(key, links=links, type=group.dyad.type)
        case Higher() if isinstance(group.last, Tie):
            rank, order = group.order
            rank_words = ROMAN[min(rank, len(ROMAN) - 1)]
            return words("calculation.group_higher", links=links, rank=rank_words, order=order)
        case Higher():
            key = "closed" if isinstance(group.last, Driver) else "unslipping"
            return words(f"calculation.group_{key}", links=links)
        case Tie() if isinstance(group.first, Sliding):
            return words("calculation.group_led", links=links)
        case Tie():
            return words("calculation.group_idle", links=links)
        case Geared() if group.is_belted:
            return words("calculation.group_belt", links=links)
    return words("calculation.group_geared", links=links)
