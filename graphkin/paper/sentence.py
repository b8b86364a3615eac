"""A sentence of the construction, and several sentences said in one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence of the construction with the number of the step that it ends with."""

    step: int
    name: str
    markup: str


def together(found: list[Sentence], some: Sequence[Sentence], markup: str) -> list[Sentence]:
    """Several sentences said in one, at the place of the first of them."""
    place = found.index(some[0])
    kept = [said for said in found if said not in some]
    return [*kept[:place], Sentence(some[-1].step, some[-1].name, markup), *kept[place:]]
