"""Many mechanisms made at random, each moved through a whole cycle: which ones jump.

``python -m tests.chance.moving 60 1000`` moves 60 of them from seed 1000 on.
"""

from __future__ import annotations

import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from graphkin.cli.report.cycle_report import agrees
from graphkin.motion.cycle import Cycle, columns_at, cycle
from graphkin.text.errors import GraphkinError, WitnessError
from tests.chance.checking import case

STEPS = 90
ROWS = 12
"""Rows at which positions are differentiated."""
BESIDE = 1e-4
"""Half the step of the differences, in parts of a row's distance from the next.

Differences over twice the step show by how much they err beside a dead point.
"""
CLOSE = 1e-4
"""What a velocity may differ from a difference of positions, in parts of the largest."""
FAST = 100.0
"""Velocities by the driver, in medians of the cycle, beyond which differences say nothing."""


def moved(seed: int) -> Cycle | None:
    """The cycle of a seed's first driver, or of its only one; None where nothing was made.

    Raises GraphkinError where the driver cannot move.
    """
    made = case(seed)
    if made is None:
        return None
    number = 1 if len(made.mechanism.scene.drivers) > 1 else None
    return cycle(made.mechanism, driver=number, steps=STEPS)


def faults(found: Cycle) -> list[str]:
    """What is wrong with a cycle as a motion: each point goes as its velocity says."""
    wrong = list[str]()
    if not agrees(found):
        wrong.append(f"the loops differ by {found.witnessed.largest:.1e}")
    return wrong + led_elsewhere(found)


def led_elsewhere(found: Cycle) -> list[str]:
    """The points whose positions beside some rows do not go as their velocities say."""
    rows = np.unique(np.linspace(0, len(found.at) - 1, ROWS + 2).astype(int)[1:-1])
    at, step = found.at[rows], BESIDE * float(np.ptp(found.at)) / STEPS
    targets = found.path.ranges[0][0].course.program.targets
    free = set(found.scene.cam_centres)
    points = [of for what, of in targets if what == "position" and "@" not in of]
    points = [of for of in points if ("velocity", of) in targets and of not in free]
    every = np.concatenate([at + k * step for k in (-2, -1, 0, 1, 2)])
    wanted = [(what, of) for of in points for what in ("position", "velocity")]
    columns = columns_at(found.sweep, found.path, every, wanted, geometric=True).columns
    place = {of: columns["position", of].reshape(5, -1) for of in points}
    rate = {of: columns["velocity", of].reshape(5, -1)[2] for of in points}
    if not points:
        return []
    size = np.max([np.abs(v) for v in rate.values()], axis=0)
    calm = (size > 0) & (size < FAST * np.nanmedian(size))
    wrong = []
    for of in points:
        with np.errstate(all="ignore"):
            off = np.abs(differences(place[of]) / (step * found.sweep.per_unit) - rate[of]) / size
            off = np.min(off, axis=0)
        over = np.flatnonzero(calm & (off > CLOSE))
        wrong += [f"{of} at {at[k]:.6g} goes {off[k]:.1e} otherwise" for k in over[:1]]
    return wrong


def differences(place: np.ndarray) -> np.ndarray:
    """How far a point goes in a step, by five positions (5, N): about them, behind and ahead.

    Where a velocity jumps, as a cam's law may make it, only those of one side say it.
    """
    two, one, here, next_one, next_two = place
    about = (8 * (next_one - one) - next_two + two) / 12
    behind, ahead = 3 * here - 4 * one + two, 4 * next_one - 3 * here - next_two
    return np.array([about, behind / 2, ahead / 2])


def judged(seed: int) -> tuple[str, str]:
    """The verdict on one seed, with its words."""
    try:
        found = moved(seed)
        if found is None:
            return "none", ""
        wrong = faults(found)
    except WitnessError as error:
        return "wrong", f"{seed}: {error}"
    except GraphkinError as error:
        return "refused", f"{seed}: {error}"
    except Exception as error:
        return "fails", f"{seed}: {type(error).__name__}: {error}"
    return ("wrong", f"{seed}: {'; '.join(wrong)}") if wrong else ("moves", "")


def main() -> None:
    """Print every seed whose motion is wrong or refused, and how many move."""
    count, start = (*sys.argv[1:], *("60", "0")[len(sys.argv) - 1 :])
    verdicts = Counter[str]()
    with ProcessPoolExecutor() as pool:
        for verdict, words in pool.map(judged, range(int(start), int(start) + int(count))):
            verdicts[verdict] += 1
            if words:
                print(verdict, words, flush=True)
    print(dict(verdicts))


if __name__ == "__main__":
    main()
