"""What an index at a letter means, told once on a page, where the first such letter stands."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet
from typing import NamedTuple

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence
from graphkin.construction.core.pen import PRIME, image_name
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.scene.link_points import ends_of, lettered
from graphkin.text.markup import names_in


class IndexNote(NamedTuple):
    """What an index means: the kind of note, the names that bear it, and what the note says."""

    kind: str
    names: AbstractSet[str]
    fields: dict[str, str]


def with_indices(drawing: Drawing, found: Sequence[Sentence]) -> list[Sentence]:
    """The sentences, after the first of a kind in brackets what its index means."""
    told, kinds, every = list(found), set[str](), list(explained(drawing))
    for place, sentence in enumerate(found):
        for each in every:
            if each.kind not in kinds and each.names & names_in(sentence.markup):
                kinds.add(each.kind)
                note = drawing.words(f"step.index-{each.kind}", **each.fields)
                told[place] = replace(told[place], markup=told[place].markup + f" ({note})")
    return told


def explained(drawing: Drawing) -> Iterator[IndexNote]:
    """The indices of a link, and of an image beside the pole, that a sheet's letters may bear."""
    steps, images = drawing.trace.program.steps, drawing.kind
    prime = PRIME if images == "acceleration" else ""
    for (what, name), number in drawing.trace.program.targets.items():
        if what != images or number not in drawing.trace.values:
            continue
        image, known = steps[number].name, image_name(name, prime)
        is_own = image == str(known)
        own, (point, link) = lettered(name), ends_of(name)
        if link:
            called = {own, *vectors_of(drawing, own), *([image] if known.link and is_own else [])}
            fields = {"name": symbol(own), "k": escape(link), "p": symbol(lettered(point))}
            yield IndexNote("link", called, fields)
        if known.apart and is_own:
            fields = {"name": symbol(image), "p": symbol(name), "pole": symbol(drawing.pole)}
            yield IndexNote("image", {image}, fields)


def vectors_of(drawing: Drawing, point: str) -> Iterator[str]:
    """The vectors that bear a point's letters as index, and the letters of their feet."""
    for step in drawing.trace.program.steps:
        vector = plan_vector(step)
        if vector is not None and point in (vector.q, vector.p):
            yield from filter(None, (vector.symbol, vector.foot))
