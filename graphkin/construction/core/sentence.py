"""A sentence of the construction, and several sentences said in one."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct


class Sentence(Struct, frozen=True):
    """A sentence of the construction with the number of the step that it ends with.

    ``steps`` are all the steps that it speaks of, where it stands for several sentences;
    ``corners`` are the names of the corners of triangles that it says.
    """

    step: int
    name: str
    markup: str
    steps: tuple[int, ...] = ()
    corners: tuple[str, ...] = ()

    @property
    def all_steps(self) -> tuple[int, ...]:
        """The steps that it speaks of; none where it speaks of no single one."""
        return self.steps or ((self.step,) if self.step >= 0 else ())


class Wording(Struct, frozen=True):
    """What a component says of itself: the kind of the sentence, its markup, the corners in it."""

    kind: str
    markup: str
    corners: tuple[str, ...] = ()


def in_one(some: Sequence[Sentence], name: str, markup: str) -> Sentence:
    """Several sentences said in one."""
    steps = tuple(n for said in some for n in said.all_steps)
    corners = tuple(name for said in some for name in said.corners)
    return Sentence(some[-1].step, name, markup, steps, corners)


def together(found: list[Sentence], some: Sequence[Sentence], markup: str) -> list[Sentence]:
    """Several sentences said in one, at the place of the first of them."""
    place = found.index(some[0])
    kept = [said for said in found if said not in some]
    return [*kept[:place], in_one(some, some[-1].name, markup), *kept[place:]]
