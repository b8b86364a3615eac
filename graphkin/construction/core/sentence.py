"""A sentence of the construction, and several sentences said in one."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct


class Sentence(Struct, frozen=True):
    """A sentence of the construction with the number of the step that it ends with.

    ``steps`` are all the steps that it speaks of, where it stands for several sentences;
    ``link`` is the idle link that it is of.
    """

    step: int
    name: str
    markup: str
    steps: tuple[int, ...] = ()
    link: str = ""

    @property
    def all_steps(self) -> tuple[int, ...]:
        """The steps that it speaks of; none where it speaks of no single one."""
        return self.steps or ((self.step,) if self.step >= 0 else ())


class Wording(Struct, frozen=True):
    """What a component says of itself: the kind of the sentence, and its markup."""

    kind: str
    markup: str


def in_one(some: Sequence[Sentence], name: str, markup: str) -> Sentence:
    """Several sentences said in one."""
    steps = tuple(n for said in some for n in said.all_steps)
    return Sentence(some[-1].step, name, markup, steps)


def together(found: list[Sentence], some: Sequence[Sentence], markup: str) -> list[Sentence]:
    """Several sentences said in one, at the place of the first of them."""
    place = found.index(some[0])
    kept = [said for said in found if said not in some]
    return [*kept[:place], in_one(some, some[-1].name, markup), *kept[place:]]
