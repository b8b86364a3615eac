"""Doubles, batches and balls held together: errors within their bound, balls around the truth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphkin.accuracy.answers import Found, Reference, rows_of
from graphkin.accuracy.methods import batch_work, found_singly, radii_in
from graphkin.arithmetic import FLOAT
from graphkin.kinds import ball_kind
from graphkin.loops.equations import equations
from graphkin.motion.course import Reals

EPS = 2.0**-52
SHARE = 64.0
"""The bound of a double's error is so many units, times L/l and the sine's power."""
DOUBLE = 53
"""Bits of a ball that has as many as a double."""


@dataclass(frozen=True, slots=True)
class Agreement:
    """How doubles and balls of as many bits stand to the certified answers.

    ``single`` and ``batch`` are the largest errors over the bound 64·eps·(L/l)/s³. Of ``answers``
    balls ``bounded`` have a radius, the largest of which is ``tightness`` over that bound, and
    ``contained`` of these hold the truth.
    """

    bound: float
    single: float
    batch: float
    tightness: float
    contained: int
    bounded: int
    answers: int


def agreement(reference: Reference) -> Agreement:
    """Hold doubles one by one, doubles in a batch and balls against the reference."""
    places, targets = reference.places, reference.answers.every
    count = len(places.at)
    columns = batch_work(
        places.course.program, targets, places.repeated(count), "float64", "steps"
    )()
    balls = found_singly(reference, ball_kind(DOUBLE))
    bounds = bounds_of(reference)
    parts = bounds[:, None] * reference.scales
    single = reference.missed(found_singly(reference, FLOAT)) / parts
    batch = reference.missed(rows_of(columns, count)) / parts
    radii = radii_in(balls, reference) / parts
    return Agreement(
        float(bounds.max()),
        float(single.max()),
        float(batch.max()),
        float(radii[np.isfinite(radii)].max(initial=0.0)),
        *contained(balls, reference),
        len(targets) * count,
    )


def bounds_of(reference: Reference) -> Reals:
    """The bound 64·eps·(L/l)/s³ of each position (P,): longest and shortest bar, flattest sine."""
    loops = equations(reference.places.course.scene)
    stretch = float(loops.size[0] / loops.least[0])
    if not np.isfinite(stretch) or stretch < 1:
        stretch = 1.0
    return np.asarray(SHARE * EPS * stretch / reference.sines**3)


def contained(balls: Sequence[Found], reference: Reference) -> tuple[int, int]:
    """How many balls hold the balls of the reference whole, of how many that have a radius."""
    pairs = [
        (ball, sure[target])
        for found, sure in zip(balls, reference.found, strict=True)
        for target, ball in found.items()
        if bool(ball.is_finite())
    ]
    return sum(bool(ball.contains(sure)) for ball, sure in pairs), len(pairs)
