"""Numbers of forces as printed, in N and in mm of a polygon."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import permutations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import FORCES, PAIR_REACTION, OnPaper, in_mm
from graphkin.construction.core.relation import answer
from graphkin.scene.forces import Forces
from graphkin.scene.model import Scene


def newtons(drawing: Drawing, size: float) -> str:
    """A force as printed, in N."""
    return f"{answer(drawing, size)} N"


def drawn_force(drawing: Drawing, size: float) -> OnPaper:
    """The drawn length of a force in a polygon, in mm."""
    return OnPaper(1000 * size / drawing.scales.kF)


def on_lever(drawing: Drawing, speed: float) -> OnPaper:
    """The drawn length of a velocity on the lever, in mm."""
    return OnPaper(1000 * speed / drawing.scales.k_lever)


def force_amount(drawing: Drawing, size: float) -> str:
    """The drawn length of a force in a polygon, as text."""
    return f"{in_mm(drawing.words, drawn_force(drawing, size))} mm"


def signed(terms: Iterable[tuple[bool, str]]) -> str:
    """A sum of terms with their signs; the first positive term comes first, without its sign."""
    said, some = "", [*terms]
    first = next((term for term in some if term[0]), None)
    for positive, term in sorted(some, key=lambda term: term is not first):
        sign = "+" if positive else "−"
        said += f" {sign} {term}" if said else term if positive else f"−{term}"
    return said


def sub(sign: str, link: str) -> str:
    """The index of a force or moment of a link after a sign: i3, or i,rod."""
    return sign + link if link.isdigit() else f"{sign},{link}"


def link_pair(one: str, other: str) -> str:
    """The index of a force of one link on another: 34, or crank,rod."""
    return one + other if len(one) == len(other) == 1 else f"{one},{other}"


def is_asked(scene: Scene, forces: Forces, target: Target) -> bool:
    """Whether a scene asks for a reaction or a balance, by its target in the plan of forces."""
    quantity, name = target
    if quantity == PAIR_REACTION.target:
        return name in reaction_names(scene, forces.reactions)
    return forces.balance and any(quantity == each.target for each in FORCES)


def reaction_names(scene: Scene, asked: Iterable[str]) -> Iterator[str]:
    """The symbols of the reactions in some pins and in all guides of some blocks, in both senses.

    A plan draws one of the two senses.
    """
    for name in asked:
        block = scene.links.get(name)
        owners = [link.name for link in scene.every_link if name in link.points]
        pairs = [*permutations(owners, 2)]
        if block is not None:
            others = [*(e.on for e in block.slides), *(e.on for e in block.rolls)]
            others += [scene.cams[name].on] if name in scene.cams else []
            pairs = [pair for other in others for pair in ((name, other), (other, name))]
        yield from (f"R_{link_pair(*pair)}" for pair in pairs)
