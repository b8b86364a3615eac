"""Components of accelerations said together: the first in full, the others in one sentence."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.sentence import Sentence, in_one, together


def with_normals_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The other right triangles said in one sentence, after the one that is said in full.

    It names what is left out too; without it the first one does, or a sentence of its own.
    """
    short = [sentence for sentence in found if sentence.name == "short"]
    if short:
        told = drawing.words("step.too-short", list=", ".join(s.markup for s in short))
        before = [said for said in found if said.name in ("ν", "ν1")][-1:]
        if not before:
            found = together(found, short, told)
        else:
            found = [said for said in found if said not in short]
            one = in_one([*before, *short], before[0].name, f"{before[0].markup}; {told}")
            found[found.index(before[0])] = one
    rest = [sentence for sentence in found if sentence.name == "ν"]
    if not rest:
        return found
    kept = [sentence for sentence in found if sentence.name != "ν"]
    tail = drawing.words("step.normals-again", list=", ".join(s.markup for s in rest))
    firsts = [i for i, sentence in enumerate(kept) if sentence.name == "ν1"]
    if not firsts:
        return together(found, rest, tail)
    place = firsts[0] + 1
    return [*kept[:place], in_one(rest, "ν", tail), *kept[place:]]
