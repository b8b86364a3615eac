"""The text of cycle: range, dead points, closures, limits of the followers, verdict on the loop."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from math import isfinite
from typing import TYPE_CHECKING, Any

from graphkin.cli.report.solution_record import heading
from graphkin.construction.core.quantities import (
    BY_TARGET,
    CENTRES,
    OF_POINTS,
    OF_SLIDES,
    RATES,
    MotionQuantity,
    motion_value,
    names_asked,
)
from graphkin.numbers.arithmetic import np
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import Closure
from graphkin.scene.quantity import size_in_si
from graphkin.text import words
from graphkin.text.tables import Cell, csv_text, labelled, listed

if TYPE_CHECKING:
    from graphkin.motion.cycle import Cycle
    from graphkin.motion.ends import Event
    from graphkin.motion.events import Singular
    from graphkin.motion.extremes import Extreme, Extremes, Reached
    from graphkin.motion.follower_limits import Dwell, Follower, Limit
    from graphkin.motion.pieces import Path, Piece
    from graphkin.motion.single_loop import Loop
    from graphkin.motion.sweep import Sweep

Column = tuple[str, Any]


def cycle_table(cycle: Cycle) -> str:
    """The whole table as CSV: heads with units, '.' decimals, full precision."""
    return csv_text(cycle_rows(cycle), "\n")


def cycle_rows(cycle: Cycle, length: str = "m") -> list[Sequence[Cell]]:
    """The head of the whole table, and its rows, in SI units or with another unit of length.

    A cell is None where there is no value, where an instantaneous centre is at infinity, and where
    no digit of the value is sure.
    """
    columns = [with_length(head, values, length) for head, values in columns_of(cycle)]
    rows = ([cell(values[row]) for _, values in columns] for row in range(len(cycle.at)))
    return [[head for head, _ in columns], *rows]


def with_length(head: str, values: Any, length: str) -> Column:
    """A column in SI units with another unit of length, such as v_A [in/s] for v_A [m/s]."""
    name, bracket, unit = head.removesuffix("]").partition(" [")
    own, size = in_length(unit, length)
    return (head, values) if own == unit else (f"{name}{bracket}{own}]", values / size)


def in_length(unit: str, length: str) -> tuple[str, float]:
    """A unit of SI with another unit of length, and its size, as tables write them."""
    plain = unit.replace("^2", "²").replace("^3", "³")
    own = words("en", length=length).unit(plain)
    return (unit, 1.0) if own == plain else (own.translate(PLAIN_UNITS), float(size_in_si(own)[0]))


def cell(value: Any) -> float | None:
    """A number, never minus zero; None if there is none."""
    if getattr(value, "dtype", None) == "int64":
        return int(value)
    return float(value) + 0.0 if isfinite(value) else None


def columns_of(cycle: Cycle) -> Iterator[Column]:
    """Every column with its head, in the order of the scene."""
    sweep = cycle.sweep
    yield f"{sweep.symbol} [{sweep.unit}]", cycle.at
    if sweep.what == "turn":
        yield f"{sweep.symbol} [rad]", np.radians(cycle.at)
    yield "piece", cycle.piece
    yield from of_points(cycle)
    yield from of_links(cycle)
    yield from of_centres(cycle)
    yield from of_slides(cycle)
    yield from of_cams(cycle)
    yield from of_forces(cycle)
    for pin, margin in cycle.margins.items():
        yield f"margin_{pin}", margin
    if not cycle.witnessed.refused:
        yield "witness", cycle.witnessed.difference


def of_forces(cycle: Cycle) -> Iterator[Column]:
    """The asked reactions by components, the balance, and how far the lever is from it."""
    found = cycle.forces
    if found is None:
        return
    for (target, name), value in found.values.items():
        quantity = BY_TARGET[target]
        if quantity.sort == "number":
            yield f"{name} [{quantity.unit}]", value
        else:
            letter, _, index = name.partition("_")
            yield f"{letter}x_{index} [{quantity.unit}]", value.real
            yield f"{letter}y_{index} [{quantity.unit}]", value.imag
    if found.difference is not None:
        yield "force_witness", found.difference


def of_points(cycle: Cycle) -> Iterator[Column]:
    """Position, velocity and acceleration of every moving point, by components."""
    for name, motion in cycle.sure.points.items():
        if name in cycle.scene.fixed_points:
            continue
        yield from own(motion, OF_POINTS, name)


def own(motion: Any, quantities: Iterable[MotionQuantity], name: str) -> Iterator[Column]:
    """Some quantities of a motion; points and vectors by components."""
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
    """Angular velocity, angular acceleration and instantaneous centre of every link."""
    for name, motion in cycle.sure.links.items():
        for rate in RATES:
            value = motion_value(motion, rate)
            if value is not None:
                yield f"{rate.name}_{name} [{rate.caret_unit}]", value
        yield from centre_columns(FIRST_CENTRE, name, motion)


FIRST_CENTRE = CENTRES[0]
"""The centre that the table has for every link; the others are there where [ask] names them."""


def of_centres(cycle: Cycle) -> Iterator[Column]:
    """The other centres that [ask] names."""
    for quantity in CENTRES[1:]:
        for name in names_asked(cycle.scene.ask, quantity):
            motions: Mapping[str, Any] = getattr(cycle.sure, quantity.whose)
            if name in motions:
                yield from centre_columns(quantity, name, motions[name])


def centre_columns(quantity: MotionQuantity, name: str, motion: Any) -> Iterator[Column]:
    """The place of a centre, if it is known."""
    centre = motion_value(motion, quantity)
    if isinstance(centre, Ratio):
        with np.errstate(all="ignore"):
            place = centre.start + centre.shift / centre.size
        yield f"{quantity.name}x_{name} [{quantity.unit}]", place.real
        yield f"{quantity.name}y_{name} [{quantity.unit}]", place.imag


def of_cams(cycle: Cycle) -> Iterator[Column]:
    """The pressure angle and the radius of curvature of every cam."""
    for follower, profile in cycle.profiles.items():
        yield f"pressure_{follower} [deg]", profile.pressure
        yield f"radius_{follower} [m]", profile.radius


def of_slides(cycle: Cycle) -> Iterator[Column]:
    """The motion of every block along its guide."""
    for name, motion in cycle.sure.slides.items():
        yield from own(motion, OF_SLIDES, f"slide_{name}")


# --- the places of a sweep and the pieces of a cycle in words: which closures are stated where ----


NOTHING = 1e-12
"""A length, in the scene's unit, below which it is rounding."""


def at_words(sweep: Sweep, at: float, name: bool = True) -> str:
    """A place of the sweep, such as φ = 28.955°."""
    head = f"{sweep.coordinate.letter} = " if name else ""
    if sweep.what == "turn":
        return f"{head}{at:.3f}°".replace("-0.000°", "0.000°")
    if sweep.what == "time":
        return f"{head}{short(at)} s"
    return head + length_words(sweep, at)


def length_words(sweep: Sweep, value: float) -> str:
    """A length in the scene's unit."""
    unit = sweep.original.units["length"]
    size = value / float(size_in_si(unit)[0])
    return f"{short(size if abs(size) > NOTHING else 0.0)} {unit}"


def short(value: float) -> str:
    """A number with at most six digits."""
    return f"{value + 0.0:.6g}"


def pieces_words(cycle: Cycle) -> tuple[str, list[str]]:
    """The label and the lines about the pieces; no lines if there is only one."""
    pieces = cycle.pieces
    if any(piece.low.kind == "number" for piece in pieces):
        return "closures", list(number_words(cycle, pieces))
    if len(pieces) == 1:
        return "pieces", []
    lines = []
    for piece in pieces:
        signs = [f"{name} {branch}" for name, branch in piece.branches.items()]
        span = span_words(cycle, piece.low.at, piece.high.at)
        lines.append(f"{span}: {', '.join(signs) or 'nothing to pick'}")
    return "pieces", lines


def number_words(cycle: Cycle, pieces: Sequence[Piece]) -> Iterator[str]:
    """The numbers of the closures of groups of higher class along their one motion.

    Consecutive pieces with the same numbers share a line; pieces that are too short have none.
    """
    yield "one motion through the whole range; to select it, write in [branches]"
    for numbers, run in groupby(pieces, numbered):
        part = list(run)
        low, high = part[0].low.at, part[-1].high.at
        if at_words(cycle.sweep, low) != at_words(cycle.sweep, high):  # else too short to print
            stated = ", ".join(f'{name} = "closure {number}"' for name, number in numbers)
            yield f"{span_words(cycle, low, high)}: {stated}"


def numbered(piece: Piece) -> tuple[tuple[str, int], ...]:
    """The links whose closures are numbered on a piece, and their numbers."""
    found = piece.branches.items()
    return tuple((name, b.number) for name, b in found if isinstance(b, Closure))


def span_words(cycle: Cycle, low: float, high: float) -> str:
    """A part of the sweep."""
    ends = (at_words(cycle.sweep, end, name=False) for end in (low, high))
    return f"{cycle.sweep.coordinate.letter} from {' to '.join(ends)}"


# --- the text of cycle ----------------------------------------------------------------------------


FLAT = 1e-10
"""The factor of the difference allowed in a row: FLAT over the cube of its flattest sine.

Near singular places an acceleration is known no better, least of all where all accelerations are
zero.
"""
TINY = 1e-99
"""The least sine that divides FLAT, so that a sine of zero does not."""
SAME = 1e-6
"""The distance of two limits, in degrees, m or s, below which they are the same."""
SHOWN = 6
"""The most places left out that are listed."""


def cycle_lines(
    cycle: Cycle,
    found_extremes: Sequence[Sequence[Extremes]] = (),
) -> Iterator[str]:
    """The whole report of a cycle, line by line.

    It names the extremes found in each range.
    """
    from graphkin.motion.follower_limits import followers
    from graphkin.motion.single_loop import loop_of

    scene = cycle.scene
    yield from (heading(scene), "")
    yield from labelled("sweep", list(sweep_words(cycle)))
    yield from labelled("range", range_words(cycle))
    yield from labelled("dead", [singular_words(cycle, s) for s in of_kind(cycle, "dead")])
    yield from labelled("change", [singular_words(cycle, s) for s in of_kind(cycle, "change")])
    yield from labelled(*pieces_words(cycle))
    several = len(cycle.path.ranges) > 1
    for i in range(len(cycle.path.ranges)):
        steady = not any(stops(cycle, i))
        found = [
            line for each in followers(cycle, i) for line in follower_words(cycle, each, steady)
        ]
        yield from labelled(f"in range {i + 1}" if several else "followers", found)
        for label, reached in extremes_blocks(cycle, found_extremes[i : i + 1]):
            yield from labelled(f"{label} {i + 1}" if several else label, reached)
    loop = loop_of(cycle)
    yield from labelled("loop", loop_words(cycle, loop) if loop is not None else [])
    yield from labelled("rows", [rows_words(cycle)])
    yield from labelled("motion", ["from row to row every point goes as its velocity leads it"])
    yield from labelled("witness", [witness_words(cycle)])
    yield from labelled("digits", list(digits_words(cycle)))


def of_kind(cycle: Cycle, kind: str) -> Iterable[Singular]:
    """The dead points, or the change points."""
    return (each for each in cycle.singulars if each.kind == kind)


def sweep_words(cycle: Cycle) -> Iterator[str]:
    """The driver that is moved, and how."""
    sweep = cycle.sweep
    if sweep.what == "time":
        count = len(cycle.scene.drivers)
        yield f"{'every driver' if count > 1 else 'the driver'} moves with the time"
        return
    driver = sweep.driver
    assert driver is not None
    unit = "rad" if sweep.what == "turn" else "m"
    yield (
        f"link {driver.link} {sweep.coordinate.moves}; at each position its speed is "
        f"{short(float(driver.speed.si(cycle.scene.values)))} {unit}/s, its acceleration "
        f"{short(float(driver.acceleration.si(cycle.scene.values)))} {unit}/s²"
    )
    if len(cycle.scene.drivers) > 1:
        yield "the other drivers are at rest where the scene puts them"


def range_words(cycle: Cycle) -> list[str]:
    """The ranges of the driver."""
    sweep = cycle.sweep
    if cycle.path.whole:
        words = ["every angle of the driver: it turns fully"]
        return words + list(return_words(cycle.path))
    lines = []
    for pieces in cycle.path.ranges:
        low, high = pieces[0].low, pieces[-1].high
        ends = [at_words(sweep, end.at, name=False) for end in (low, high)]
        line = f"{sweep.coordinate.letter} from {ends[0]} to {ends[1]}"
        line += f" ({short(high.at - low.at)}° in all)" if sweep.what == "turn" else ""
        if sweep.is_length:
            line += beyond_words(low, high)
        lines.append(line)
    if count := cycle.path.searched:
        lines.append(f"it does not close where it is drawn: {count} positions of the driver were")
        lines.append("searched; a range between two of them is not seen")
    return lines + list(circle_words(cycle.path))


def beyond_words(low: Event, high: Event) -> str:
    """Whether the motion continues beyond the ends of a range that are not dead points."""
    open_ends = [(end, w) for end, w in ((low, "below"), (high, "above")) if end.kind == "window"]
    free = [w for end, w in open_ends if end.free]
    more = [w for end, w in open_ends if not end.free]
    words = f"; nothing stops it {' and '.join(free)}" if free else ""
    return words + (f"; it goes on {' and '.join(more)}" if more else "")


def return_words(path: Path) -> Iterator[str]:
    """The position of the mechanism after a turn of the driver, if it is not the initial one."""
    from graphkin.motion.pieces import strangers
    from graphkin.motion.turns_followed import MOST_TURNS

    if path.turns == 1:
        return
    links = strangers(path)
    if dict(path.ranges[0][0].branches) != dict(path.ranges[0][-1].branches) or not links:
        yield "after one turn the mechanism is in another closure"
    else:
        stand = "links {} are" if len(links) > 1 else "link {} is"
        yield f"after one turn {stand.format(listed(links))} in another position than before"
    if path.turns:
        yield f"after {path.turns} turns everything is where it was"
    elif links:
        yield f"everything is not back where it was within {MOST_TURNS} turns: one turn is shown"


def circle_words(path: Path) -> Iterator[str]:
    """How often the ranges of a driver that stops repeat."""
    from graphkin.motion.turns_followed import MOST_TURNS

    if path.turns > 1:
        yield f"they come again after every {path.turns} turns of the driver, as the wheels do"
    elif not path.turns and path.ranges[0][0].course.sweep.whole:
        yield f"wheels are not back in place within {MOST_TURNS} turns: further ranges may follow"


def singular_words(cycle: Cycle, found: Singular) -> str:
    """A dead point or a change point, in a sentence."""
    where = f"{found.lines} at {at_words(cycle.sweep, found.at)}"
    if found.kind == "dead" and cycle.sweep.what == "time":
        return f"{where}: the motion ends, {found.pin} cannot be found beyond"
    if found.kind == "dead":
        return f"{where}: limit position of the driver, {found.pin} cannot be found beyond"
    return f"{where}: change point, passed as the velocity leads"


def stops(cycle: Cycle, number: int) -> tuple[bool, bool]:
    """Whether a dead point ends a range of the driver, below and above."""
    pieces = cycle.path.ranges[number]
    return pieces[0].low.kind != "window", pieces[-1].high.kind != "window"


def follower_words(cycle: Cycle, found: Follower, steady: bool) -> list[str]:
    """How far one follower moves, where it reverses, and its time ratio.

    ``steady`` says that nothing stops the driver, so that a link without limits keeps turning.
    """
    what = f"block {found.name}" if found.line is None else f"link {found.name}"
    line = "" if found.line is None else f" (line {'-'.join(found.line)})"
    if found.full:
        return [f"{what}{line} turns fully"]
    verb = "goes" if found.line is None else "swings"
    if steady and found.line is not None and not found.limits:
        verb = "turns one way by"
    edge = " within the window" if found.low.edge or found.high.edge else ""
    words = f"{what}{line} {verb} {value_words(cycle, found, found.extent)}{edge}: "
    words += " to ".join(limit_words(cycle, found, end) for end in (found.low, found.high))
    lines = [words]
    ends = [end.at for end in (found.low, found.high)]
    others = [each for each in found.limits if min(abs(each.at - at) for at in ends) > SAME]
    if others:
        also = listed([limit_words(cycle, found, each) for each in others], SHOWN)
        lines.append(f"  it turns round also at {also}")
    lines += [f"  {dwell_words(cycle, found, each)}" for each in found.dwells]
    if found.rising is not None and found.falling is not None:
        strokes = found.rising, found.falling
        up, down = reversed(strokes) if cycle.sweep.runs_backwards else strokes
        high, low = (value_words(cycle, found, end.value) for end in (found.high, found.low))
        times = f"{up:.1f}° of the driver to {high}, {down:.1f}° to {low}"
        lines.append(f"  time ratio of its two strokes {found.time_ratio:.4f}: {times}")
    return lines


def dwell_words(cycle: Cycle, found: Follower, dwell: Dwell) -> str:
    """Where a follower rests."""
    ends = [at_words(cycle.sweep, end, name=False) for end in (dwell.start, dwell.end)]
    where = f"{cycle.sweep.coordinate.letter} from {' to '.join(ends)}"
    return f"it rests at {value_words(cycle, found, dwell.value)} for {where}"


def limit_words(cycle: Cycle, found: Follower, limit: Limit) -> str:
    """One limit with the driver's place."""
    edge = ", an edge of the window" if limit.edge else ""
    return f"{value_words(cycle, found, limit.value)} (at {at_words(cycle.sweep, limit.at)}{edge})"


def value_words(cycle: Cycle, found: Follower, value: float) -> str:
    """An angle or a coordinate of a follower."""
    return length_words(cycle.sweep, value) if found.line is None else f"{value:.3f}°"


def extremes_blocks(
    cycle: Cycle, every: Sequence[Sequence[Extremes]]
) -> Iterator[tuple[str, list[str]]]:
    """The labels and lines of extremes: of what is asked for, and of angles with limits."""
    asked = [each for found in every for each in found if each.limit is None]
    angles = [each for found in every for each in found if each.limit is not None]
    yield "extremes", [extremes_words(cycle, each) for each in asked]
    yield "angles", [f"{extremes_words(cycle, each)}; {limit_verdict(each)}" for each in angles]


def limit_verdict(found: Extremes) -> str:
    """Whether an angle keeps its customary limit."""
    least = found.measure.least_allowed is not None
    if found.keeps_limit:
        return f"never {'below' if least else 'above'} the customary {short(found.limit or 0)}°"
    return f"goes {'below' if least else 'above'} the customary {short(found.limit or 0)}°"


def extremes_words(cycle: Cycle, found: Extremes) -> str:
    """The least and the largest value of one quantity, with the driver's places."""
    measure = found.measure
    if found.is_constant:
        return f"{measure.label} stays at {in_results(cycle, found.least.value, measure.unit)}"
    both = ((found.least, "least"), (found.largest, "largest"))
    words = "; ".join(f"{name} {extreme_words(cycle, e, measure.unit)}" for e, name in both)
    return f"{measure.label}: {words}"


def extreme_words(cycle: Cycle, found: Extreme, unit: str) -> str:
    """A least or largest value and its places."""
    letter = cycle.sweep.coordinate.letter
    where = listed([place_words(cycle, each) for each in found.places], SHOWN)
    if not isfinite(found.value):
        sign = "+" if found.value > 0 else "-"
        points = "points" if len(found.places) > 1 else "point"
        return f"{sign}∞ at the dead {points} {letter} = {where}"
    return f"{in_results(cycle, found.value, unit)} at {letter} = {where}"


def in_results(cycle: Cycle, value: float, unit: str) -> str:
    """A value in SI, in the unit of results, with that unit."""
    if unit == "°":
        return f"{value:.3f}°"
    own = words("en", length=cycle.scene.unit_of_results).unit(unit)
    size = value if own == unit else value / float(size_in_si(own)[0])
    return f"{short(size)} {own}".rstrip()


def place_words(cycle: Cycle, found: Reached) -> str:
    """Where an extreme is, without the letter of the coordinate."""
    where = at_words(cycle.sweep, found.at, name=False)
    if found.until > found.at:
        return f"{where} to {at_words(cycle.sweep, found.until, name=False)}"
    return f"{where} (edge of the window)" if found.end == "window" else where


def positions_lines(few: Cycle) -> list[str]:
    """The count, the start and the step of equal positions."""
    if not len(few.at):
        return labelled("positions", ["none lies inside the range"])
    from graphkin.motion.equal_positions import step_of

    first, step = step_of(few)
    words = f"{len(few.at)} from {at_words(few.sweep, first)}"
    words += f", each {at_words(few.sweep, step, name=False)} on" if step else ""
    return labelled("positions", [words])


def extremes_rows(
    cycle: Cycle, found_extremes: Sequence[Sequence[Extremes]], length: str = "m"
) -> list[Sequence[Cell]]:
    """The extremes of all ranges under their heads, a row for each place.

    Units are those of ``cycle_rows``.

    ``inf`` is a value that grows without bound towards the dead point of its row. ``to`` ends a
    stretch on which the value stays the same. ``limit`` is the customary limit of an angle.
    """
    sweep = cycle.sweep
    of_place, one = in_length(sweep.unit, length)
    at = f"{sweep.symbol} [{of_place}]"
    rows: list[Sequence[Cell]] = [
        ["range", "quantity", "of", "unit", "extreme", "value", at, f"{at} to", "where", "limit"]
    ]
    for number, every in enumerate(found_extremes, 1):
        for found in every:
            measure = found.measure
            unit, size = in_length(measure.unit.translate(PLAIN_UNITS), length)
            head: list[Cell] = [
                number,
                measure.name,
                measure.of,
                unit,
            ]
            for name, extreme in (("least", found.least), ("largest", found.largest)):
                for place in extreme.places:
                    where = [u / one + 0.0 for u in (place.at, place.until)]
                    end = ENDS[place.end]
                    rows.append([*head, name, extreme.value / size + 0.0, *where, end, found.limit])
    return rows


PLAIN_UNITS = str.maketrans({"²": "^2", "³": "^3", "°": "deg"})
"""How units are written in a table."""
ENDS = {None: "inside", "dead": "dead point", "window": "edge"}
"""Where an extreme is in its range, in the table."""


def loop_words(cycle: Cycle, loop: Loop) -> list[str]:
    """The verdict on a single loop, by its lengths and by the ring or band."""
    sweep = cycle.sweep
    size = {name: length_words(sweep, value) for name, value in loop.lengths.items()}
    pins = "-".join(pin for pin in loop.pins if pin)
    lines = [
        f"{loop.kind.replace('slider-driven', 'slider-crank')} {pins}: "
        + ", ".join(f"{name} {value}" for name, value in size.items())
    ]
    lines += verdict(loop)
    lines.append(reach_words(sweep, loop))
    if loop.more:
        lines.append("the groups that depend on this loop may narrow the range further")
    return lines


def verdict(loop: Loop) -> list[str]:
    """What the lengths of a loop mean, in the field's words."""
    from graphkin.motion.single_loop import class_of

    if loop.kind == "four-bar":
        found = class_of(loop)
        total, turns = FOUR_BARS[found]
        return [f"Grashof: {total}, so it is a {found}: {turns}"]
    if loop.kind == "slider-crank":
        sign = "≤" if loop.turns else ">"
        says = "the crank turns fully" if loop.turns else "the crank cannot turn fully"
        return [f"crank + offset {sign} rod: {says}"]
    r, d, c = (loop.lengths[key] for key in ("crank", "offset", "rod"))
    says = "could turn fully as the driver" if r + d <= c else "could not turn fully as the driver"
    return [f"the block drives between its dead points; the crank {says}"]


SMALLER, EQUAL, LARGER = (
    f"shortest + longest {sign} sum of the other two" for sign in ("<", "=", ">")
)
FOUR_BARS = {
    "change-point parallelogram": (EQUAL, "crank and follower turn alike or against one another"),
    "change-point kite": (EQUAL, "all its links can lie in one line"),
    "change-point four-bar": (EQUAL, "all its links can lie in one line"),
    "triple rocker": (LARGER, "no link turns fully against another"),
    "double crank": (SMALLER, "the frame is the shortest, both links on it turn fully"),
    "crank-rocker": (SMALLER, "the driver is the shortest and turns fully, the other rocks"),
    "rocker-crank": (
        SMALLER,
        "the follower is the shortest and could turn fully, the driver rocks",
    ),
    "double rocker": (
        SMALLER,
        "the coupler is the shortest and turns fully, both links on the frame rock",
    ),
}
"""Grashof's rule for the lengths of each class of four-bar, and the links that turn."""


def reach_words(sweep: Sweep, loop: Loop) -> str:
    """The path of the driven pin compared with what the other links can reach."""
    from graphkin.motion.single_loop import Band, Ring

    pin = loop.pins[1]
    if isinstance(loop.reach, Band):
        area = f"the band of {length_words(sweep, loop.reach.half)} on either side of the guide"
    else:
        inner, outer = loop.reach.inner, loop.reach.outer
        area = f"the ring of radii {length_words(sweep, inner)} and {length_words(sweep, outer)}"
        area += f" about {loop.pins[3]}"
    path = "circle" if isinstance(loop.path, Ring) else "line"
    lies = "lies wholly within" if loop.turns else "leaves"
    return f"the {path} of {pin} {lies} {area}"


def rows_words(cycle: Cycle) -> str:
    """The number of rows, and the positions without a row."""
    turns = cycle.path.turns
    words = f"{len(cycle.at)} rows" + f" through {turns} turns of the driver" * (turns > 1)
    left = cycle.left_out
    if not len(left):
        return words
    places = [at_words(cycle.sweep, float(at), name=False) for at in left]
    which = listed(places) if len(left) <= SHOWN else f"{places[0]} … {places[-1]}"
    return f"{words}; {len(left)} positions left out, they do not close or are singular: {which}"


def witness_words(cycle: Cycle) -> str:
    """The verdict of the independent check on all rows."""
    found = cycle.witnessed
    if found.refused:
        return f"could not judge: {found.refused}"
    if not len(cycle.at):
        return "nothing to judge"
    largest = f"largest difference {found.largest:.1e}"
    count = int(found.agrees.sum())
    if count == len(cycle.at):
        return f"agrees in every row: {largest}"
    if agrees(cycle):
        others = len(cycle.at) - count
        return f"agrees, but for {others} rows beside singular places: {largest}"
    return f"DOES NOT AGREE in {len(cycle.at) - count} rows: {largest}"


def digits_words(cycle: Cycle) -> Iterator[str]:
    """The quantities without a sure digit, and in how many rows."""
    unsure = cycle.witnessed.unsure
    if unsure:
        rows = int(np.logical_or.reduce([*unsure.values()]).sum())
        where = f"in {rows} row{'s' * (rows > 1)}, whose cells are empty"
        yield f"none is sure of {listed(unsure, SHOWN)} {where}"


def agrees(cycle: Cycle) -> bool:
    """Whether the independent check agrees in every row that is not near a singular place.

    Where a crossing is so flat that no digit is sure, it need not have an answer at all.
    """
    found = cycle.witnessed
    allowed = FLAT / np.maximum(cycle.solution.margin, TINY) ** 3
    flat = (found.difference <= allowed) | (allowed >= 1)
    return bool(not found.refused and (found.agrees | flat).all())
