"""How doubles and balls compare with the certified answers and with the bound of a double."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec import Struct

from graphkin.accuracy.comparison import Found, Reference, rows_of
from graphkin.accuracy.methods import (
    batch_work,
    columns_of,
    found_singly,
    in_floats,
    radii_in,
    start_before,
)
from graphkin.loops.closing_groups import counted_in_order
from graphkin.loops.equations import equations
from graphkin.loops.newton import closed_from
from graphkin.motion.course import Reals
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.kinds import ball_kind

DOUBLE = 53
"""The bits of a ball with the precision of a double."""


class Agreement(Struct, frozen=True):
    """How doubles, and balls of as many bits, compare with the certified answers.

    ``bound`` is the largest bound of a double's error over the largest of its quantity. ``single``
    and ``batch`` are the largest errors over their bounds. Of ``answers`` balls, ``bounded`` have a
    finite radius and ``contained`` of these contain the true value; ``tightness`` is their largest
    radius over its bound.
    """

    bound: float
    single: float
    batch: float
    tightness: float
    contained: int
    bounded: int
    answers: int


def agreement(reference: Reference) -> Agreement:
    """Compare doubles one by one, doubles in a batch, and balls with the reference."""
    places, targets = reference.places, reference.answers.every
    count = len(places.at)
    columns = batch_work(
        places.course.program, targets, places.repeated(count), "float64", "steps"
    )()
    balls = found_singly(reference, ball_kind(DOUBLE))
    bounds = bounds_of(reference)
    single = in_parts(reference.missed(found_singly(reference, FLOAT)), bounds)
    batch = in_parts(reference.missed(rows_of(columns, count)), bounds)
    radii = in_parts(radii_in(balls, reference), bounds)
    return Agreement(
        float(in_parts(bounds, reference.scales).max()),
        float(single.max()),
        float(batch.max()),
        float(radii[np.isfinite(radii)].max(initial=0.0)),
        *contained(balls, reference),
        len(targets) * count,
    )


def in_parts(errors: Reals, of: Reals) -> Reals:
    """Errors divided by other numbers; 0/0 is 0, as for the velocities of points at rest."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(errors == 0, 0.0, errors / of))


def bounds_of(reference: Reference) -> Reals:
    """The largest bound of each quantity at each position, (P, 3), from the loop equations."""
    places = reference.places
    scene, values = places.course.scene, in_floats(places.repeated(len(places.at)))
    start = start_before(reference, scene, values)
    bounds = closed_from(counted_in_order(equations(scene, values)), start, singular=True).rounding
    every = columns_of(bounds, reference)
    rows = [np.stack([every[t] for t in some if t in every]) for some in reference.answers.targets]
    return np.stack([row.max(axis=0) for row in rows], axis=1)


def contained(balls: Sequence[Found], reference: Reference) -> tuple[int, int]:
    """The number of balls that contain the reference's ball, and of those with a finite radius."""
    pairs = [
        (ball, sure[target])
        for found, sure in zip(balls, reference.found, strict=True)
        for target, ball in found.items()
        if bool(ball.is_finite())
    ]
    return sum(bool(ball.contains(sure)) for ball, sure in pairs), len(pairs)
