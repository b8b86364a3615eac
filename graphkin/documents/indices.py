"""What an index at a letter means, told once on a page, where the first such letter stands."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.link_poses import lettered
from graphkin.construction.core.sentence import Sentence
from graphkin.drawing.symbol_markup import escape, symbol

INDEX = re.compile(r"_\{([^}]*)\}")
"""The index of a symbol in a sentence."""


class IndexNote(NamedTuple):
    """What an index means: the kind of note, the letters that bear it, and what the note says.

    ``inner`` is the letter that bears it within the index of another symbol; "" where none does.
    """

    kind: str
    letters: tuple[str, ...]
    inner: str
    fields: dict[str, str]

    def stands_in(self, markup: str) -> bool:
        """True when a sentence has one of the letters."""
        if any(letter in markup for letter in self.letters):
            return True
        return bool(self.inner) and any(self.inner in index for index in INDEX.findall(markup))


def with_indices(drawing: Drawing, found: Sequence[Sentence]) -> list[Sentence]:
    """The sentences, after the first of a kind in brackets what its index means."""
    told, kinds, every = list(found), set[str](), list(explained(drawing))
    for place, sentence in enumerate(found):
        for each in every:
            if each.kind not in kinds and each.stands_in(sentence.markup):
                kinds.add(each.kind)
                note = drawing.words(f"step.index-{each.kind}", **each.fields)
                markup = f"{told[place].markup} ({note})"
                told[place] = replace(told[place], markup=markup)
    return told


def explained(drawing: Drawing) -> Iterator[IndexNote]:
    """The indices of a link, and of an image beside the pole, that a sheet's letters may bear."""
    steps, images = drawing.trace.program.steps, drawing.kind
    for (what, name), number in drawing.trace.program.targets.items():
        if what != images or number not in drawing.trace.values:
            continue
        image = steps[number].name
        point, _, link = name.partition("@")
        if link:
            own = lettered(name)
            called = (symbol(own), *([symbol(image)] if image.endswith(f"_{link}") else []))
            fields = {"name": symbol(own), "k": escape(link), "p": symbol(lettered(point))}
            yield IndexNote("link", called, own, fields)
        if image.endswith("_v"):
            fields = {"name": symbol(image), "p": symbol(name), "pole": symbol(drawing.pole)}
            yield IndexNote("image", (symbol(image),), "", fields)
