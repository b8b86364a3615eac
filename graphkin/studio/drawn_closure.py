"""In which closure a drawn mechanism stands: the branches that its text lacks."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import tomlkit

from graphkin.construction.core.branches import block_of, choosing, pins_choosing
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.structure.decomposition import decompose
from graphkin.structure.groups import Dyad, Group, Stretched
from graphkin.structure.pairs import Pin
from graphkin.studio.sketch import Places, solved, table_of
from graphkin.text.errors import GraphkinError

TRIED = 64
"""Combinations of closures that are compared with what was drawn."""


def drawn_closed(text: str, places: Places) -> str:
    """The text with the branches that it lacks, as the closure nearest to what was drawn."""
    try:
        scene = read_text(text, "scene", None, {})
        groups = decompose(scene)
    except GraphkinError:
        return text
    document = tomlkit.parse(text)
    allowed = [*choosing(groups), *pins_choosing(groups)]
    kept = {name for name in scene.branches if name in allowed and fits(groups, name, document)}
    branches = table_of(document, "branches")
    for name in [name for name in branches if name not in kept]:
        branches.pop(name)
    wanted = {key: words for key, words in ways(groups) if key not in kept}
    if not wanted:
        return tomlkit.dumps(document)
    if "branches" not in document:
        document["branches"] = tomlkit.table()
    best, nearest = text, float("inf")
    for n, words in enumerate(product(*wanted.values())):
        if n == TRIED:
            break
        for key, each in zip(wanted, words, strict=True):
            document["branches"][key] = each
        tried = tomlkit.dumps(document)
        far = apart(tried, places)
        if far < nearest or best is text:
            best, nearest = tried, far
    return best


def ways(groups: tuple[Group, ...]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Under each name that may state a branch the words that it may say."""
    for group in groups:
        for name in choosing((group,))[:1]:
            dyad = group.dyad if isinstance(group, Stretched) else group
            if isinstance(dyad, Dyad) and dyad.type == "RRR":
                yield name, tuple(f"{side} of {line_of(dyad)}" for side in ("left", "right"))
            elif isinstance(dyad, Dyad) and name == block_of(dyad):
                yield name, ("forward", "backward")
            else:
                yield name, ("closure 1",)


def line_of(dyad: Dyad) -> str:
    """The line between the two known pins of a dyad."""
    ends = (pair.place for pair in dyad.outer if isinstance(pair, Pin))
    return "-".join(ends)


def fits(groups: tuple[Group, ...], name: str, document: tomlkit.TOMLDocument) -> bool:
    """Whether a stated side still names the two known pins of its dyad."""
    words = str(table_of(document, "branches").get(name, ""))
    for group in groups:
        dyad = group.dyad if isinstance(group, Stretched) else group
        if isinstance(dyad, Dyad) and dyad.type == "RRR" and name in choosing((group,)):
            return {*line_of(dyad).split("-")} == {*words.rpartition(" ")[2].split("-")}
    return True


def apart(text: str, places: Places) -> float:
    """How far the points of a mechanism lie from where they were drawn, in all."""
    try:
        found = solved(Mechanism(read_text(text, "scene", None, {})))
    except GraphkinError:
        return float("inf")
    return sum(abs(at - places[name]) for name, at in found.items() if name in places)
