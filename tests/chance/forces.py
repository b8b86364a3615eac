"""Many mechanisms made at random with masses and loads: polygons and lever against the equations.

As many as the first argument says, the first seed being the second argument. With ``exact`` as the
third, fifty digits are a route, too. With ``every`` groups of any kind are made, whose forces come
from the equations alone where nothing is drawn.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import partial

from graphkin.construction.forces.force_plan import undrawn
from graphkin.mechanism import Mechanism
from graphkin.text.errors import GraphkinError, StructureError
from tests.chance.checking import Case, case, told
from tests.chance.maker import Maker
from tests.chance.making import add
from tests.laws.exact_forces import UnsupportedError, exact_forces, far_from_exact
from tests.laws.force_routes import differences, loaded

HELD = 1e-9
"""The share of the largest force up to which the routes agree."""


DOUBTED = ("redundant", "no finite forces")
"""Refusals that fifty digits may contradict."""
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


def judged(seed: int, how: str = "") -> tuple[str, str]:
    """How the routes stand on one seed, with where they differ."""
    made = case(seed) if how == "every" else dyads(seed)
    if made is None:
        return "none", ""
    mechanism = loaded(made.mechanism, random.Random(seed))
    is_drawn = undrawn(mechanism.scene, mechanism.laid[0]) is None
    if not is_drawn and not how:
        return "not drawn", ""
    worst = 0.0
    try:
        if is_drawn:
            worst = max(differences(mechanism), default=0.0)
        if how:
            worst = max(worst, far_from_exact(mechanism))
    except UnsupportedError:
        verdict = mechanism.forces()[1]
        return ("power alone", "") if verdict.agrees else ("differ", f"{seed}: {verdict}")
    except StructureError as error:
        found = refusal(str(error))
        if how and found in DOUBTED and has_exact(mechanism):
            return "differ", f"{seed}: refused as {found}, though fifty digits have forces"
        return found, ""
    except GraphkinError as error:
        return "refused", f"{seed}: {error}"
    except AssertionError as error:
        return "differ", f"{seed}: the equations of equilibrium {str(error)[:200]}"
    return ("agree", "") if worst < HELD else ("differ", f"{seed}: {worst:.1e}")


def has_exact(mechanism: Mechanism) -> bool:
    """Whether the equations of fifty digits have one solution."""
    try:
        exact_forces(mechanism)
    except (UnsupportedError, ZeroDivisionError):
        return False
    return True


def refusal(words: str) -> str:
    """Why equilibrium does not give the forces."""
    kinds = ("redundant", "belt", "cam of", "no finite forces")
    return next((kind for kind in kinds if kind in words), words)


def main() -> None:
    """Print every seed at which the routes differ, and how many agree."""
    count, start, how = (*sys.argv[1:], *("2000", "0", "")[len(sys.argv) - 1 :])
    seeds = range(int(start), int(start) + int(count))
    with ProcessPoolExecutor() as pool:
        rows = list(pool.map(partial(judged, how=how), seeds, chunksize=10))
    for verdict, words in rows:
        if words:
            print(verdict, words)
    print(dict(Counter(verdict for verdict, _ in rows)))


if __name__ == "__main__":
    main()
