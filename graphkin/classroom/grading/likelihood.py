"""How likely answers are for a student who read them off the drawing of given data.

The errors of a drawing are correlated as its construction says, and a badly set crank moves every
answer. The coarseness of a student's pencil is unknown: several are taken as equally likely. An
answer that no drawing of these data gives is a mistake, of any size.
"""

from __future__ import annotations

from collections.abc import Callable
from math import exp, log, pi
from typing import Any

from msgspec import Struct

from graphkin.classroom.grading.graded import SURE
from graphkin.numbers.arithmetic import np

HALF = log(2.0)
"""Half of all mistakes lie within this of the right value, in natural logarithms."""
ASTRAY = 10.0
"""Half of all wrong places lie within this many mm of the right one, along either axis."""
MISTAKES = 0.1
"""The share of answers that are mistakes."""
FAR = 5.0
"""The number of deviations from the key at which an answer alone counts as a mistake."""
PENCILS = tuple(0.1 * 2.0**i for i in range(8))
"""The coarseness of pencils, relative to the one that is forgiven."""
SURELY = 1e-24
"""The least variance of an answer, however it is drawn and read."""
LAID_OFF = 5.0
"""The deviation, in degrees, of badly set cranks."""


class Key(Struct, frozen=True):
    """Right answers as sizes, and the errors of drawings of them; places keep their sign.

    ``spread`` is the covariance of the errors of the forgiven pencil and ruler. ``computed`` is the
    deviation of values computed from a reading. ``cranks`` is the change of the answers with each
    crank, per degree.
    """

    sizes: Any
    spread: Any
    computed: Any
    cranks: Any
    places: Any


class Fit(Struct, frozen=True):
    """How likely answers are by a key, as a logarithm.

    ``fits`` marks those that are no mistakes. ``pencil`` is the likeliest coarseness, relative to
    the forgiven pencil.
    """

    likelihood: float
    fits: Any
    pencil: float


def fit(answers: Any, rounding: Any, key: Key, *starts: Any) -> Fit:
    """The likeliest split of answers with rounding errors into drawn ones and mistakes.

    The answer that fits the others least is taken for a mistake as long as this is likelier. The
    search starts from all answers, from those near the key, and from each of ``starts``.
    """
    noise = noise_of(rounding, key)
    off = answers - key.sizes
    astray = log(MISTAKES) + scattered(answers, key)
    near = abs(off) <= FAR * np.sqrt(np.diag(key.spread + noise))
    seen: dict[bytes, tuple[Fit, int | None]] = {}

    def judge(fits: Any) -> tuple[Fit, int | None]:
        pattern = fits.tobytes()  # different starts often meet
        if pattern not in seen:
            seen[pattern] = judged(off, key.spread, noise, astray, fits)
        return seen[pattern]

    found = [cleared(judge, each) for each in (np.ones_like(near), near, *starts)]
    return max(found, key=lambda each: each.likelihood)


def noise_of(rounding: Any, key: Key) -> Any:
    """The covariance of errors other than the pencil's: rounding, computing, badly set cranks."""
    return np.diag(key.computed**2 + rounding**2 / 3) + LAID_OFF**2 * key.cranks.T @ key.cranks


def likelihood_if_drawn(answers: Any, rounding: Any, key: Key, fits: Any) -> float:
    """How likely answers are if exactly those of ``fits`` are drawn, as a logarithm."""
    astray = log(MISTAKES) + scattered(answers, key)
    noise = noise_of(rounding, key)
    return judged(answers - key.sizes, key.spread, noise, astray, fits)[0].likelihood


def cleared(judge: Callable[[Any], tuple[Fit, int | None]], fits: Any) -> Fit:
    """The fit after removing mistakes one by one."""
    best, worst = judge(fits)
    while worst is not None:
        fewer = best.fits.copy()
        fewer[worst] = False
        found, worst = judge(fewer)
        if found.likelihood <= best.likelihood:
            break
        best = found
    return best


def judged(off: Any, spread: Any, noise: Any, astray: Any, fits: Any) -> tuple[Fit, int | None]:
    """The fit if exactly these answers are drawn, and the answer that fits the others least."""
    places = np.flatnonzero(fits)
    lost = float(astray[~fits].sum())
    if not len(places):
        return Fit(lost, fits, PENCILS[0]), None
    own = places[:, None], places
    scale = np.sqrt(np.maximum((spread.diagonal() + noise.diagonal())[places], SURELY))
    square = scale[:, None] * scale
    regular = noise[own] / square
    regular.flat[:: len(places) + 1] += 1e-9
    lower = np.linalg.cholesky(regular)
    inverse = np.linalg.inv(lower)
    wide, axes = np.linalg.eigh(inverse @ (spread[own] / square) @ inverse.T)
    apart = axes.T @ inverse @ (off[places] / scale)
    variances = 1 + np.square(PENCILS)[:, None] * np.maximum(wide, 0.0)
    size = np.log(variances).sum(axis=1) + 2 * np.log(lower.diagonal() * scale).sum()
    each = -0.5 * ((apart**2 / variances).sum(axis=1) + len(places) * log(2 * pi) + size)
    likely = int(each.argmax())
    drawn = each[likely] + log(np.exp(each - each[likely]).sum() / len(PENCILS))
    back = (axes.T @ inverse).T
    pulled = back @ (apart / variances[likely])
    alone = (back**2 / variances[likely]).sum(axis=1)
    worst = int(places[(pulled**2 / alone).argmax()])
    whole = float(drawn) + len(places) * log(1 - MISTAKES) + lost
    return Fit(whole, fits, PENCILS[likely]), worst


def scattered(answers: Any, key: Key) -> Any:
    """The density of mistakes, as a logarithm: half of them lie within a factor of two."""
    sizes = np.maximum(abs(answers), 1e-12 + 1e-6 * abs(key.sizes))
    apart = np.log(sizes / np.maximum(abs(key.sizes), 1e-12)) / HALF
    size = -np.log(pi * HALF * sizes * (1 + apart**2))
    away = (answers - key.sizes) / ASTRAY
    return np.where(key.places, -np.log(pi * ASTRAY * (1 + away**2)), size)


def reported_odds(logarithm: float) -> float:
    """Odds as reported: at most ``SURE``."""
    return min(exp(min(logarithm, log(SURE))), SURE)
