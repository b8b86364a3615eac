"""Many mechanisms made at random: which routes differ.

As many as the first argument says, the first seed being the second argument. A third one names
a kind of group, with which then each of them ends.
"""

from __future__ import annotations

import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor

from tests.chance.checking import case, checked
from tests.chance.making import ADDED


def judged(seed: int) -> tuple[str, str]:
    """How the three routes stand on one seed, with where they differ."""
    try:
        made = case(seed)
        if made is None:
            return "none", ""
        found = checked(made)
    except Exception as error:
        return "fails", f"{seed}: {type(error).__name__}: {error}"
    if found.agrees:
        return "agree", ""
    where = f"loops {found.loops:.1e} {found.where_loops}"
    where += f", exact {found.exact:.1e} {found.where_exact}"
    return "differ", f"{seed}: {where} ({', '.join(made.types)})"


def main() -> None:
    """Print every seed at which the routes differ, and how many agree."""
    count, start, kind = (*sys.argv[1:], *("2000", "0", "")[len(sys.argv) - 1 :])
    step, rest = ADDED[kind] if kind else (1, 0)
    first = int(start) + (rest - int(start)) % step
    seeds = range(first, first + int(count) * step, step)
    with ProcessPoolExecutor() as pool:
        rows = list(pool.map(judged, seeds, chunksize=10 if step == 1 else 1))
    for _, words in rows:
        if words:
            print(words)
    print(dict(Counter(verdict for verdict, _ in rows)))


if __name__ == "__main__":
    main()
