"""Honest classes and classes in which some copy: who is named, and who is found.

``python -m tests.bench.copies [CLASSES | FIRST-LAST] [LAB …]`` prints, for each kind of class and
each lab, how many honest students are named (none may be), and for each way to copy how many are
found; of so many classes of each, or of those with some seeds.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from itertools import chain

from tests.classroom.grading.classes import (
    COPYING,
    HONEST,
    LABS,
    SIZE,
    copied_class,
    honest_class,
    is_found,
    marked,
    named,
)

COPIED = (HONEST[1], HONEST[2], HONEST[3], HONEST[7])
"""The kinds of classes in which some copy."""


def honest(labs: Sequence[str], seeds: Sequence[int]) -> Iterator[str]:
    """For each kind of class, how many innocents are named, and with which odds; and the largest
    share of classes in which somebody is that 95 % of such trials leave possible, if nobody was.
    """
    tried = guilty = 0
    for kind in HONEST:
        found = []
        for lab in labs:
            for seed in seeds:
                result = marked(lab, kind, seed, honest_class(lab, kind, seed))
                odds = [each.odds for each in (*result.wrong_variants, *result.copies)]
                found.append((lab, len(named(result)), max(odds, default=0.0)))
        tried += len(found)
        guilty += sum(count > 0 for _, count, _ in found)
        every = ", ".join(
            f"{lab} {sum(c for name, c, _ in found if name == lab)}"
            f" (odds ≤ {max(o for name, _, o in found if name == lab):.0e})"
            for lab in labs
        )
        yield f"{kind.name:35} {len(seeds)} × {SIZE}: named {every}"
    bound = "" if guilty else f"; 95 %: of at most {100 * (1 - 0.05 ** (1 / tried)):.2g} %"
    yield f"somebody is named in {guilty} of {tried} classes{bound}"


def copying(labs: Sequence[str], seeds: Sequence[int]) -> Iterator[str]:
    """For each way to copy and each kind of class, how many who copied are found."""
    for each in COPYING:
        for kind in COPIED:
            if each.alike and kind.own:
                continue
            told = []
            for lab in labs:
                there = caught = innocent = 0
                for seed in seeds:
                    answers, pairs = copied_class(lab, kind, seed, each)
                    result = marked(lab, kind, seed, answers)
                    there += len(pairs)
                    caught += sum(is_found(result, pair) for pair in pairs)
                    guilty = {who for pair in pairs for who in pair}
                    innocent += sum(not guilty.issuperset(group) for group in named(result))
                told.append(f"{lab} {caught}/{there}" + f" (+{innocent} innocent)" * (innocent > 0))
            yield f"{each.name:45} {kind.name:25} {', '.join(told)}"


def main() -> None:
    """Print both tables."""
    first, _, last = (sys.argv[1] if len(sys.argv) > 1 else "1").rpartition("-")
    seeds = range(int(first), int(last) + 1) if first else range(int(last))
    labs = sys.argv[2:] or list(LABS)
    for line in chain(honest(labs, seeds), copying(labs, seeds)):
        print(line, flush=True)


if __name__ == "__main__":
    main()
