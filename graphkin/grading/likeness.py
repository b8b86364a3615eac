"""How likely answers are that somebody read off the drawing of given data.

The errors of a drawing go together as its construction says: a crank laid off too far moves every
answer. Nobody's pencil is known, so the one that suits the answers best is taken, down to the
digits that are written; what no drawing of these data makes is a mistake, of any size.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log, pi
from typing import Any

from graphkin.grading.diagnosis import ASTRAY, HALF

MISTAKES = 0.1
"""The share of answers that are mistakes."""
FAR = 5.0
"""An answer so many deviations from the key is one."""
FINEST = 0.1
"""No drawing is finer than this part of the forgiven pencil; what agrees to the digits is."""


@dataclass(frozen=True)
class Key:
    """Right answers as sizes, places with their sign, and the covariance of their errors."""

    sizes: Any
    spread: Any
    places: Any


@dataclass(frozen=True)
class Fit:
    """How likely answers are by a key, as a logarithm, and which of them are no mistakes."""

    likelihood: float
    fits: Any


def fit(answers: Any, rounding: Any, key: Key) -> Fit:
    """The likeliest reading of some answers, each rounded by so much: which of them are mistakes.

    The answer that is least like the others is taken for a mistake as long as that is likelier.
    """
    import numpy as np

    spread = key.spread + np.diag(rounding**2 / 3)
    off = answers - key.sizes
    astray = log(MISTAKES) + scattered(answers, key)
    fits = abs(off) <= FAR * np.sqrt(np.diag(spread))
    best, worst = judged(off, spread, astray, fits)
    while worst is not None:
        fewer = fits.copy()
        fewer[worst] = False
        found, next_worst = judged(off, spread, astray, fewer)
        if found <= best:
            break
        best, worst, fits = found, next_worst, fewer
    return Fit(best, fits)


def judged(off: Any, spread: Any, astray: Any, fits: Any) -> tuple[float, int | None]:
    """The likelihood where just these answers are drawn, and which of them is least like them."""
    import numpy as np

    places = np.flatnonzero(fits)
    lost = float(astray[~fits].sum())
    if not len(places):
        return lost, None
    own = spread[np.ix_(places, places)]
    scale = np.sqrt(np.diag(own))
    inverse = np.linalg.inv(own / np.outer(scale, scale) + 1e-9 * np.eye(len(places)))
    apart = off[places] / scale
    pulled = inverse @ apart
    count = len(places)
    pencil = max(float(apart @ pulled) / count, FINEST**2)
    size = -np.linalg.slogdet(inverse)[1] + 2 * np.log(scale).sum()
    square = float(apart @ pulled) / pencil
    drawn = -0.5 * (square + count * log(2 * pi * pencil) + size) + count * log(1 - MISTAKES)
    return float(drawn) + lost, int(places[(pulled**2 / np.diag(inverse)).argmax()])


def scattered(answers: Any, key: Key) -> Any:
    """How densely mistakes lie, as a logarithm: half of them within a factor of two."""
    import numpy as np

    sizes = np.maximum(abs(answers), 1e-12 + 1e-6 * abs(key.sizes))
    apart = np.log(sizes / np.maximum(abs(key.sizes), 1e-12)) / HALF
    size = -np.log(pi * HALF * sizes * (1 + apart**2))
    away = (answers - key.sizes) / ASTRAY
    return np.where(key.places, -np.log(pi * ASTRAY * (1 + away**2)), size)
