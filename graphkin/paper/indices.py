"""What an index at a letter means, told once on a page, where the first such letter stands."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from graphkin.paper.drawing import Drawing
from graphkin.paper.richtext import escape
from graphkin.paper.sentence import Sentence
from graphkin.paper.standing import lettered
from graphkin.paper.symbolic import symbol

INDEX = re.compile(r"_\{([^}]*)\}")
"""The index of a symbol in a sentence."""


def with_indices(drawing: Drawing, found: Sequence[Sentence]) -> list[Sentence]:
    """The sentences, after the first of a kind in brackets what its index means."""
    told, kinds = list(found), set[str]()
    for place, sentence in enumerate(found):
        for kind, note in notes(drawing, sentence.markup):
            if kind not in kinds:
                kinds.add(kind)
                markup = f"{told[place].markup} ({note})"
                told[place] = replace(told[place], markup=markup)
    return told


def notes(drawing: Drawing, markup: str) -> Iterator[tuple[str, str]]:
    """What the indices in a sentence mean: that of a link, and that of an image beside the pole."""
    steps, images = drawing.trace.program.steps, drawing.kind
    indices = INDEX.findall(markup)
    for (what, name), number in drawing.trace.program.targets.items():
        if what != images or number not in drawing.trace.values:
            continue
        image = steps[number].name
        point, _, link = name.partition("@")
        own = lettered(name)
        called = [symbol(own), *([symbol(image)] if image.endswith(f"_{link}") else [])]
        written = any(name in markup for name in called)
        if link and (written or any(own in index for index in indices)):
            fields = {"name": symbol(own), "k": escape(link), "p": symbol(lettered(point))}
            yield "link", drawing.words("step.index-link", **fields)
        if image.endswith("_v") and symbol(image) in markup:
            fields = {"name": symbol(image), "p": symbol(name), "pole": symbol(drawing.pole)}
            yield "image", drawing.words("step.index-image", **fields)
