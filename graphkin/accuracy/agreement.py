"""Doubles, batches and balls held together: errors within their bound, balls around the truth."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec import Struct

from graphkin.accuracy.compared_answers import Found, Reference, rows_of
from graphkin.accuracy.methods import batch_work, found_singly, radii_in
from graphkin.accuracy.other_routes import columns_of, in_floats, start_before
from graphkin.loops.closing_groups import counted_in_order
from graphkin.loops.equations import equations
from graphkin.loops.newton import closed_from
from graphkin.motion.course import Reals
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.kinds import ball_kind

DOUBLE = 53
"""Bits of a ball that has as many as a double."""


class Agreement(Struct, frozen=True):
    """How doubles and balls of as many bits stand to the certified answers.

    ``bound`` is the largest bound of a double's error over the largest of its quantity, ``single``
    and ``batch`` the largest errors over their bounds. Of ``answers`` balls ``bounded`` have a
    radius, the largest of which is ``tightness`` over its bound, and ``contained`` of these hold
    the truth.
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
    """Errors in parts of other numbers; nothing of nothing, as of the velocities of what rests."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(errors == 0, 0.0, errors / of))


def bounds_of(reference: Reference) -> Reals:
    """The largest bound of each quantity at each position, (P, 3), as the witness has it."""
    places = reference.places
    scene, values = places.course.scene, in_floats(places.repeated(len(places.at)))
    start = start_before(reference, scene, values)
    bounds = closed_from(counted_in_order(equations(scene, values)), start, singular=True).rounding
    every = columns_of(bounds, reference)
    rows = [np.stack([every[t] for t in some if t in every]) for some in reference.answers.targets]
    return np.stack([row.max(axis=0) for row in rows], axis=1)


def contained(balls: Sequence[Found], reference: Reference) -> tuple[int, int]:
    """How many balls hold the balls of the reference whole, of how many that have a radius."""
    pairs = [
        (ball, sure[target])
        for found, sure in zip(balls, reference.found, strict=True)
        for target, ball in found.items()
        if bool(ball.is_finite())
    ]
    return sum(bool(ball.contains(sure)) for ball, sure in pairs), len(pairs)
