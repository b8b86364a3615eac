"""The cost of accuracy, as text and as a table of comma-separated values."""

from __future__ import annotations

from collections.abc import Iterator
from math import isinf

from graphkin.accuracy.comparison import BITS
from graphkin.accuracy.methods import MethodRow
from graphkin.accuracy.study import Flattening, Study, machine_words
from graphkin.construction.core.timing import Timing
from graphkin.numbers.kinds import GUARD
from graphkin.scene.quantity import LENGTHS
from graphkin.text.tables import csv_text, table

HEADS = (
    "method",
    "family",
    "position_error_over_largest_distance",
    "velocity_error_over_largest_speed",
    "acceleration_error_over_largest_acceleration",
    "error_is_certified_radius",
    "median_seconds_per_position",
    "lower_quartile_seconds",
    "upper_quartile_seconds",
    "rounds",
    "variants_per_run",
    "positions_compared",
    "reference_radius",
    "machine",
    "note",
)


def accuracy_table(study: Study) -> str:
    """A row for each method: errors, certified or not, time with quartiles, and conditions."""
    machine, reference = machine_words(), study.reference
    rows = [
        (
            row.method,
            row.family,
            *("" if error is None else f"{error:.3g}" for error in row.errors),
            "yes" if row.certified else "no",
            *(("",) * 4 if row.time is None else (*timed(row.time), row.time.rounds)),
            row.variants,
            len(reference.places.at),
            f"{reference.radius:.2g}",
            machine,
            row.note,
        )
        for row in study.rows
    ]
    return csv_text([HEADS, *rows], "\n")


def timed(time: Timing) -> list[str]:
    """The median and the quartiles as numbers of four digits."""
    return [f"{each:.4g}" for each in (time.median, time.low, time.high)]


def accuracy_lines(study: Study) -> Iterator[str]:
    """The whole report, line by line, for a terminal."""
    yield from head_lines(study)
    yield ""
    heads = ("method", "position", "velocity", "accel.", "µs each", "quartiles", "at once")
    yield from table(heads, [line_of(row) for row in study.rows])
    yield ""
    notes = dict.fromkeys(f"{row.family}: {row.note}." for row in study.rows if row.note)
    yield from notes
    yield (
        "Arb: radii that the balls themselves prove. mpmath carries "
        f"{GUARD} digits more than are asked."
    )
    yield ""
    yield from flat_lines(study)


def head_lines(study: Study) -> Iterator[str]:
    """What was compared, in which units, against which reference, on which machine."""
    reference = study.reference
    yield f"What accuracy costs: {study.mechanism.scene.title}"
    yield f"positions  {where(study)}"
    length, speed, acceleration = (f"{scale:.4g}" for scale in reference.scales)
    yield (
        "errors     the largest of all points and blocks over all positions, in parts of the "
        "largest"
    )
    yield f"           distance of two points {length} m, speed {speed} m/s, {acceleration} m/s²"
    yield (
        f"reference  Arb balls of {BITS} bits, whose own radius is at most {reference.radius:.1g} "
        "of these"
    )
    yield f"times      medians of a position; on {machine_words()}"


def where(study: Study) -> str:
    """The positions that were compared."""
    reference, sweep = study.reference, study.reference.places.course.sweep
    at = reference.places.at
    unit = study.mechanism.scene.units["length"] if sweep.unit == "m" else sweep.unit
    factor = float(LENGTHS[unit]) if sweep.unit == "m" else 1.0
    what = "the time" if sweep.driver is None else f"driver {sweep.number}"
    return (
        f"{len(at)}, {what} from {min(at) / factor:.6g} to {max(at) / factor:.6g} {unit}, "
        f"crossings at a sine of {min(reference.sines):.3g} and more"
    )


def line_of(row: MethodRow) -> tuple[str, ...]:
    """A row as texts: errors, median in microseconds, quartiles, positions in one run."""
    errors = tuple(shown(error) for error in row.errors)
    if row.time is None:
        return (row.method, *errors, "–", "", "")
    quartiles = f"{micro(row.time.low)} – {micro(row.time.high)}"
    at_once = f"{row.variants}" if row.variants > 1 else ""
    return (row.method, *errors, micro(row.time.median), quartiles, at_once)


def micro(seconds: float) -> str:
    """A time in microseconds with three digits."""
    value = seconds * 1e6
    digits = max(0, 2 - len(str(int(value))) + (value >= 1)) if value < 100 else 0
    return f"{value:.{digits}f}" if value >= 1 else f"{value:.3f}"


def shown(error: float | None) -> str:
    """An error as a power of ten with two digits; – if there is none."""
    if error is None:
        return "–"
    return "fails" if isinf(error) else f"{error:.1e}"


def flat_lines(study: Study) -> Iterator[str]:
    """How errors grow on the way to a dead point."""
    found = study.flattening
    if found is None:
        yield "dead point  the driver reaches none, and there is no range to look at instead"
        return
    yield goal_words(found, study.mechanism.scene.units["length"])
    if found.approach.end == "range":
        return
    for kind in found.errors:
        slopes = found.slopes(kind)
        if any(slope is not None for slope in slopes):
            listed = ", ".join("–" if slope is None else f"{slope:.2f}" for slope in slopes)
            yield f"            {kind}: measured slopes {listed}"


def goal_words(found: Flattening, length: str) -> str:
    """The place to which the driver was moved, and how errors grow there."""
    sweep, goal = found.approach.places.course.sweep, found.approach.goal
    lowest, highest = min(found.sines), max(found.sines)
    if goal is None:
        return (
            "dead point  the driver meets none and no change point: over its whole range the "
            f"flattest crossing has a sine of {lowest:.2g} to {highest:.2g}"
        )
    unit = length if sweep.unit == "m" else sweep.unit
    goal /= float(LENGTHS[unit]) if sweep.unit == "m" else 1.0
    measure = (
        f"the sine s of the flattest crossing, seen down to {lowest:.1g}"
        if found.falls
        else "the root s of the distance to go; no crossing of the drawing grows flat there"
    )
    name = "dead point" if found.approach.end == "dead" else "change point"
    return f"{name}  at {goal:.6g} {unit}: towards it errors grow as 1/s, 1/s², 1/s³ with {measure}"
