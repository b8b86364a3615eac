"""The table of a cycle: a row for each position of the driver, SI units, comma separated."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from graphkin.construction.core.quantities import (
    OF_POINTS,
    OF_SLIDES,
    RATES,
    MotionQuantity,
    motion_value,
)
from graphkin.numbers.arrays import np
from graphkin.numbers.plane import Ratio

if TYPE_CHECKING:
    from graphkin.motion.cycle import Cycle

Column = tuple[str, Any]


def cycle_table(cycle: Cycle) -> str:
    """The whole table as CSV: heads with their units, '.' decimals, full precision.

    A cell is empty where there is no value, an instantaneous centre at infinity, and where no digit
    of the value is sure.
    """
    columns = list(columns_of(cycle))
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([head for head, _ in columns])
    for row in range(len(cycle.at)):
        writer.writerow([cell(values[row]) for _, values in columns])
    return out.getvalue()


def cell(value: Any) -> str:
    """A number in its shortest exact form, never minus nought; empty where there is none."""
    import math

    if getattr(value, "dtype", None) == "int64":
        return str(value)
    return repr(float(value) + 0.0) if math.isfinite(value) else ""


def columns_of(cycle: Cycle) -> Iterator[Column]:
    """Every column with its head, in the order of the scene."""
    sweep = cycle.sweep
    yield f"{sweep.symbol} [{sweep.unit}]", cycle.at
    if sweep.what == "turn":
        yield f"{sweep.symbol} [rad]", np.radians(cycle.at)
    yield "piece", cycle.piece
    yield from of_points(cycle)
    yield from of_links(cycle)
    yield from of_slides(cycle)
    yield from of_cams(cycle)
    for pin, margin in cycle.margins.items():
        yield f"margin_{pin}", margin
    if not cycle.witnessed.refused:
        yield "witness", cycle.witnessed.difference


def of_points(cycle: Cycle) -> Iterator[Column]:
    """Position, velocity and acceleration of every moving point, by components."""
    for name, motion in cycle.sure.points.items():
        if name in cycle.scene.fixed_points:
            continue
        yield from own(motion, OF_POINTS, name)


def own(motion: Any, quantities: Iterable[MotionQuantity], name: str) -> Iterator[Column]:
    """Some quantities of a motion, those that are not numbers by components."""
    for quantity in quantities:
        value, tail = motion_value(motion, quantity), f"_{name} [{quantity.caret_unit}]"
        if value is None:
            continue
        if quantity.sort == "number":
            yield quantity.letter + tail, value
        else:
            yield f"{quantity.letter}x{tail}", value.real
            yield f"{quantity.letter}y{tail}", value.imag


def of_links(cycle: Cycle) -> Iterator[Column]:
    """Angular velocity and acceleration and the instantaneous centre of every link."""
    for name, motion in cycle.sure.links.items():
        for rate in RATES:
            value = motion_value(motion, rate)
            if value is not None:
                yield f"{rate.target}_{name} [{rate.caret_unit}]", value
        centre = motion.instant_centre
        if isinstance(centre, Ratio):
            with np.errstate(all="ignore"):
                place = centre.start + centre.shift / centre.size
            yield f"Ix_{name} [m]", place.real
            yield f"Iy_{name} [m]", place.imag


def of_cams(cycle: Cycle) -> Iterator[Column]:
    """The pressure angle and the radius of curvature of every cam."""
    for follower, profile in cycle.profiles.items():
        yield f"pressure_{follower} [deg]", profile.pressure
        yield f"radius_{follower} [m]", profile.radius


def of_slides(cycle: Cycle) -> Iterator[Column]:
    """The motion of every block along its guide."""
    for name, motion in cycle.sure.slides.items():
        yield from own(motion, OF_SLIDES, f"slide_{name}")
