"""The pencil beside the numbers: what 95 of 100 drawings are off at most, in the same measures."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from msgspec.structs import replace

from graphkin.accuracy.compared_answers import ComparedTargets, Reference, reference_of
from graphkin.accuracy.compared_positions import Ground, approach
from graphkin.accuracy.flattening import Flattening, roots_of, units_of
from graphkin.accuracy.methods import MethodRow
from graphkin.accuracy.pencil import Forecast, Pencil, forecast, original
from graphkin.drawing.scale import Scales
from graphkin.mechanism import Mechanism
from graphkin.motion.course import Reals
from graphkin.text.errors import GraphkinError

PENCILS = (0.5, 0.25, 0.1)
"""Millimetres within which 95 of 100 marks lie."""
FINE = 0.25
"""The pencil that is shown where a crossing grows flat."""
NEAREST = 1e-3
"""The distance of the last of them, in parts of that of the first."""


def pencil_rows(mechanism: Mechanism, reference: Reference, scales: Scales) -> Iterator[MethodRow]:
    """Three pencils on the scene's own position, at the scales of its sheets."""
    note = "95 of 100 drawings of the scene's own position are off by less; a person's hour"
    for point in PENCILS:
        name, key = f"pencil, {point:g} mm", f"{point:g} mm"
        try:
            exact = original(mechanism, scales, reference.answers.every)
            worst = worst_of(forecast(exact, Pencil(point)), reference.answers)
        except GraphkinError as error:
            note = f"cannot be drawn: {error.problems[0]}"
            yield MethodRow("pencil", name, key, (None, None, None), None, note=note)
            continue
        errors = worst / reference.scales
        first, second, third = (float(each) for each in errors)
        yield MethodRow("pencil", name, key, (first, second, third), None, note=note)


def worst_of(found: Forecast, answers: ComparedTargets) -> Reals:
    """The largest expected error of each quantity, in SI (3,); nought where nothing is drawn."""
    known = found.index
    return np.array(
        [
            max((known[target].error for target in some if target in known), default=0.0)
            for some in answers.targets
        ]
    )


def pencilled(
    ground: Ground,
    answers: ComparedTargets,
    scales: Scales,
    flattening: Flattening,
    drawn: int,
) -> tuple[Reals, Reals]:
    """Measures (G,) and errors (G, 3) of a fine pencil at ``drawn`` places to a dead point.

    A measure is what the flattening is shown against, or the driver's position over a range.

    The plans are drawn as large as at the first position: as velocities grow so does kv. An error
    is inf from where more than one in twenty drawings do not close.
    """
    way = approach(ground, drawn, 1, NEAREST)
    reference = reference_of(way.places, answers)
    units, course = units_of(reference.sizes), way.places.course
    first = reference.sizes[0, 1]
    measure = reference.sines if flattening.falls else roots_of(way, reference)
    measure = reference.places.at if way.goal is None else measure
    measures, errors = [], []
    for row, at in enumerate(reference.places.at):
        growth = float(reference.sizes[row, 1] / first) if first else 1.0
        paper = replace(scales, seconds=scales.seconds / growth)
        here = Mechanism(course.standing(float(at)))
        try:
            exact = original(here, paper, reference.answers.every)
            worst = worst_of(forecast(exact, Pencil(FINE)), reference.answers)
        except GraphkinError:
            continue
        measures.append(measure[row])
        errors.append(worst / units[row])
    return np.array(measures), np.array(errors).reshape(-1, 3)
