"""Honest classes and classes in which some copy: who is named, and who is found.

``python -m tests.bench.copies [CLASSES] [LAB …]`` prints, for each kind of class and each lab, how
many honest students are named (none may be), and for each way to copy how many are found.
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


def honest(labs: Sequence[str], classes: int) -> Iterator[str]:
    """For each kind of class, how many innocents are named, and with which odds."""
    for kind in HONEST:
        found = []
        for lab in labs:
            for seed in range(classes):
                result = marked(lab, kind, seed, honest_class(lab, kind, seed))
                odds = [each.odds for each in (*result.wrong_variants, *result.copies)]
                found.append((lab, len(named(result)), max(odds, default=0.0)))
        every = ", ".join(
            f"{lab} {sum(c for name, c, _ in found if name == lab)}"
            f" (odds ≤ {max(o for name, _, o in found if name == lab):.0e})"
            for lab in labs
        )
        yield f"{kind.name:35} {classes} × {SIZE}: named {every}"


def copying(labs: Sequence[str], classes: int) -> Iterator[str]:
    """For each way to copy and each kind of class, how many who copied are found."""
    for each in COPYING:
        for kind in COPIED:
            if each.alike and kind.own:
                continue
            told = []
            for lab in labs:
                there = caught = innocent = 0
                for seed in range(classes):
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
    classes = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    labs = sys.argv[2:] or list(LABS)
    for line in chain(honest(labs, classes), copying(labs, classes)):
        print(line, flush=True)


if __name__ == "__main__":
    main()
