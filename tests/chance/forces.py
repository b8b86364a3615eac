"""Many mechanisms made at random with masses and loads: polygons and lever against the equations.

As many as the first argument says, the first seed being the second argument.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor

from graphkin.construction.forces.force_plan import undrawn
from graphkin.text.errors import GraphkinError
from tests.chance.checking import Case, told
from tests.chance.maker import Maker
from tests.chance.making import add
from tests.laws.force_routes import differences, loaded

HELD = 1e-9
"""The share of the largest force up to which the routes agree."""


KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")
"""The groups whose forces are drawn."""


def dyads(seed: int) -> Case | None:
    """A crank or a driven slide with one to three dyads; None where none could be made."""
    rng = random.Random(f"forces {seed}")
    maker = Maker(rng, rng.choice((1.0, 1.0, 2.0)), 10 ** rng.uniform(-1, 1))
    first = rng.choice(("crank", "crank", "crank", "driven slide"))
    kinds = [first, *(rng.choice(KINDS) for _ in range(rng.randint(1, 3)))]
    done = tuple(kind for kind in kinds if add(maker, kind))
    return told(seed, maker.standing, done) if len(done) > 1 else None


def judged(seed: int) -> tuple[str, str]:
    """How the routes stand on one seed, with where they differ."""
    made = dyads(seed)
    if made is None:
        return "none", ""
    mechanism = loaded(made.mechanism, random.Random(seed))
    if undrawn(mechanism.scene, mechanism.laid[0]) is not None:
        return "not drawn", ""
    try:
        worst = max(differences(mechanism), default=0.0)
    except GraphkinError as error:
        return "refused", f"{seed}: {error}"
    except AssertionError:
        return "differ", f"{seed}: the equations of equilibrium"
    return ("agree", "") if worst < HELD else ("differ", f"{seed}: {worst:.1e}")


def main() -> None:
    """Print every seed at which the routes differ, and how many agree."""
    count, start = (*sys.argv[1:], *("2000", "0")[len(sys.argv) - 1 :])
    with ProcessPoolExecutor() as pool:
        rows = list(pool.map(judged, range(int(start), int(start) + int(count)), chunksize=10))
    for verdict, words in rows:
        if words:
            print(verdict, words)
    print(dict(Counter(verdict for verdict, _ in rows)))


if __name__ == "__main__":
    main()
