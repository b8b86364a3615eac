"""The names of points as the labels of a drawing write them: an index only where it is needed."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping

from graphkin.drawing.marks import Text
from graphkin.drawing.symbol_markup import symbol
from graphkin.web.screen_sheets import ScreenSheet

PRIMES = "′″‴⁗"
"""What tells the corners of a component's figure from the points of the mechanism."""


def labels_of(sheet: ScreenSheet) -> dict[str, str]:
    """The markup of each label of a sheet by the name of what it stands at."""
    marks = (*sheet.left, *sheet.right)
    return {mark.name: mark.markup for mark in marks if isinstance(mark, Text) and mark.name}


def as_labelled(markup: str, names: Iterable[str], labels: Mapping[str, str]) -> str:
    """Markup that speaks of b″ with the index that the label of b″_BA has, here and there the same.

    ``names`` are those of the steps that it tells of; two that differ by their index alone stay.
    """
    bases = {name: name.partition("_")[0] for name in names if "_" in name and name in labels}
    bases = {name: base for name, base in bases.items() if base[-1] in PRIMES}
    count = Counter(bases.values())
    for name, base in bases.items():
        if count[base] == 1:
            bare = re.escape(symbol(base)) + r"(?![_^])"
            markup = labels[name].join(re.split(bare, markup))
    return markup
