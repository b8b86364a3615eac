"""Why a step cannot be drawn, by how much its loci miss, and where the mechanism would close.

The exact decision whether two loci meet, independent of the construction of their meeting.

Floating-point numbers and the numbers of a scene are rational. Whether a circle meets a circle or a
line is the sign of a polynomial in them: of (r1 + r2)² - d² and d² - (r1 - r2)². The product of
these is four times the square of r1·r2 less the square of d² - r1² - r2². In rounded numbers, one
in four pairs of circles that touch or nearly touch is misjudged; in fractions, none is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import isqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.crossings import LOCI, Determined
from graphkin.construction.core.kind import ClosesGroup, PlacesLink, construction
from graphkin.construction.core.program import Part, Program, Step
from graphkin.construction.core.run import StepFailed, Trace, Values, evaluate
from graphkin.construction.higher_class.closure_solver import (
    BITS,
    ClosingError,
    MergingError,
    closer_of,
    sign_table,
)
from graphkin.diagnosis.ranges import MOST, closes_where, closings, where_it_closes
from graphkin.numbers.arithmetic import FLOAT, np
from graphkin.numbers.exact import RATIONAL, Exact, IrrationalError
from graphkin.numbers.kinds import ball_kind
from graphkin.numbers.plane import Circle, Line
from graphkin.scene.model import Driver, Scene
from graphkin.scene.quantity import shortest
from graphkin.structure.driver_count import driver_name
from graphkin.text.errors import (
    NO_WORDS,
    ClosureError,
    Message,
    Problem,
    Sought,
    Written,
    both,
    either,
    joined,
    message,
)

Locus = Line | Circle
Loci = tuple[Locus, Locus]

EPS = 2.0**-52
ROUNDING = 16 * EPS
"""Share of their size within which the crossing of two loci in floats is undecided."""
BALL_BITS = (128, 512, 2048)
"""Bits of the balls that decide, in turn, whether loci meet."""


# --- the decision --------------------------------------------------------------------------------


def meet(first: Locus, second: Locus) -> int:
    """Whether two circles, or a line and a circle, cross (1), touch (0), or miss each other (-1).

    The result is exact for the given numbers, floats included.
    """
    power, _, _, _ = powers(first, second)
    return (power > 0) - (power < 0)


def clearance(first: Locus, second: Locus) -> float:
    """The gap between two loci (m): zero where they touch, negative where they cross.

    It is computed without cancellation, so that its sign is correct and its digits are, to 1e-15.
    """
    power, other, near, far = powers(first, second)
    if power == 0:
        return 0.0
    return -float(power / other / (near + far))


def powers(first: Locus, second: Locus) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """The deciding power, a nonzero factor of it, and two lengths that are equal at a contact.

    The power is positive where the loci cross. Divided by the factor, it is the difference of the
    squares of the two lengths: the reach of the radii and the distance.
    """
    if isinstance(first, Circle) and isinstance(second, Circle):
        a, b = (Exact.of(each.radius).square() for each in (first, second))
        d = (Exact.of(second.centre) - Exact.of(first.centre)).square()
        half = d - a - b
        r, t = length(a), length(b)
        near = r + t if half > 0 else abs(a - b) / (r + t)
        return 4 * a * b - half**2, abs(half) + 2 * r * t, near, length(d)
    line, circle = (first, second) if isinstance(first, Line) else (second, first)
    assert isinstance(line, Line) and isinstance(circle, Circle)
    along, gap = Exact.of(line.along), Exact.of(circle.centre) - Exact.of(line.point)
    area = (along.conjugate() * gap).imag
    a, square = Exact.of(circle.radius).square(), along.square()
    return a * square - area**2, square, length(a), length(area**2 / square)


def length(square: Fraction) -> Fraction:
    """The square root of a fraction, to at least 64 binary digits."""
    if not square:
        return square
    power = (square.denominator.bit_length() - square.numerator.bit_length()) // 2 + 64
    return Fraction(isqrt(int(square * Fraction(4) ** power))) / Fraction(2) ** power


# --- the loci of a step, as the scene states them ------------------------------------------------


class Meeting(Struct, frozen=True):
    """The gap between two loci (m), negative where they cross.

    ``exactly`` means that it holds for the rational numbers in the scene. ``proved`` means that
    balls prove it for what follows from them. Otherwise it is the gap of the loci in floats.
    ``rounded`` is that gap, and ``size`` the largest length of the loci.
    """

    missed: float
    size: float
    exactly: bool
    proved: bool
    rounded: float

    @property
    def slack(self) -> float:
        """The distance by which rounding may have moved the loci (m)."""
        return 0.0 if self.proved else ROUNDING * self.size

    @property
    def apart(self) -> bool:
        """Whether they miss each other."""
        return self.missed > self.slack

    @property
    def lost(self) -> bool:
        """Whether they cross although, beyond their own rounding, floats miss each other."""
        return self.proved and self.missed < 0 and self.rounded > ROUNDING * self.size

    @property
    def barely(self) -> bool:
        """Whether, as the scene states them, they cross by less than rounding or not at all."""
        return self.exactly and self.missed > -EPS * self.size


def meeting(scene: Scene, program: Program, number: int, loci: Loci) -> Meeting:
    """The gap of the loci of a step, by the scene's own numbers.

    Rational numbers are decided as fractions, others in balls of increasing precision.
    """
    stated = stated_loci(program, number, scene.values)
    found = clearance(rounded(loci[0]), rounded(loci[1]))
    if stated is not None:
        return Meeting(clearance(*stated), size_of(loci), True, True, found)
    proved = proved_clearance(scene, program, number)
    missed = found if proved is None else proved
    return Meeting(missed, size_of(loci), False, proved is not None, found)


def loci_of(args: Sequence[Any]) -> Loci | None:
    """The two loci, not both straight, among the inputs of a step."""
    match args:
        case [Circle() | Line() as first, Circle() as second, *_]:
            return first, second
    return None


def rounded(locus: Locus) -> Locus:
    """A locus of any kind of number in floats."""
    if isinstance(locus, Circle):
        return Circle(complex(locus.centre), float(locus.radius))
    return Line(complex(locus.point), complex(locus.along))


def size_of(loci: Loci) -> float:
    """The largest radius of two loci (m)."""
    return max(float(each.radius) for each in loci if isinstance(each, Circle))


def stated_loci(program: Program, number: int, values: Mapping[str, Any]) -> Loci | None:
    """The two loci that a step crosses, exactly as stated in the scene; None where it does not.

    They are stated where they depend on frame points, on cranks at whole quarter turns, and on
    nothing constructed before.
    """
    found: dict[int, Any] = {}
    step = program.steps[number]
    try:
        for earlier in program.behind(step.args):
            found[earlier] = exact_value(program, earlier, found, values)
    except (IrrationalError, ZeroDivisionError, OverflowError):
        return None
    return loci_of([found[arg] for arg in step.args])


def proved_clearance(scene: Scene, program: Program, number: int) -> float | None:
    """The gap of the loci of a step (m), with a sign that balls prove.

    None where they do not, as at a contact, and after a group of higher class.
    """
    step = program.steps[number]
    needed = program.behind(step.args)
    if any(closer_of(program.steps[n]) is not None for n in needed):
        return None
    for bits in BALL_BITS:
        kind = ball_kind(bits)
        with kind.working():
            values, found = scene.values_in(kind), dict[int, Any]()
            try:
                for earlier in needed:
                    args = program.steps[earlier], earlier, found, values, kind
                    found[earlier] = evaluate(*args, {})
            except StepFailed:
                continue
            loci = loci_of([found[arg] for arg in step.args])
            assert loci is not None
            gap = gap_of(*loci)
            if gap > 0 or gap < 0:
                return float(gap)
    return None


def gap_of(first: Locus, second: Locus) -> Any:
    """The gap of two loci of balls, negative where they cross."""
    if isinstance(first, Circle) and isinstance(second, Circle):
        apart = abs(second.centre - first.centre)
        within = abs(first.radius - second.radius) - apart
        return (apart - first.radius - second.radius).max(within)
    line, circle = (first, second) if isinstance(first, Line) else (second, first)
    assert isinstance(line, Line) and isinstance(circle, Circle)
    area = (line.along.conjugate() * (circle.centre - line.point)).imag
    return abs(area) / abs(line.along) - circle.radius


def exact_value(
    program: Program, number: int, found: Mapping[int, Any], values: Mapping[str, Any]
) -> Any:
    """The value of a step in rational numbers. Raises IrrationalError for a crossing."""
    step = program.steps[number]
    if step.given is not None:
        return step.given.value(values, RATIONAL)
    assert step.action is not None
    if step.action.margin is not None or closer_of(step) is not None:
        raise IrrationalError(f"the crossing {step.name}")
    return step.action.value(*(found[arg] for arg in step.args), *step.extra)


def in_line(scene: Scene, program: Program, number: int, *, nearly: bool = False) -> Message:
    """Words for bars and guides in line, parallel or square at a failed or flat crossing.

    They are nearly so where the crossing is only flat.
    """
    step = program.steps[number]
    kind = step.of
    if isinstance(kind, Determined) and (words := kind.in_line(program.steps, nearly=nearly)):
        return words
    if links := closed_by(step):
        bars = arms(scene, links)
        if bars:
            return message(
                "the lines {bars} nearly meet in one point"
                if nearly
                else "the lines {bars} meet in one point",
                bars=both((", ".join(bars[:-1]), bars[-1])),
            )
        return message(
            "two closures of links {links} nearly meet"
            if nearly
            else "two closures of links {links} meet",
            links=", ".join(links),
        )
    return parallel(program, step, nearly=nearly)


def closed_by(step: Step) -> tuple[str, ...]:
    """The links of the higher-class group that a step helps to close."""
    kind = construction(step)
    return kind.closes if isinstance(kind, ClosesGroup) else ()


def arms(scene: Scene, links: Sequence[str]) -> list[str]:
    """The three bars that hold the middle link of a class III group; empty for other groups.

    Where the three lines meet in one point, that link can move while the driver is at rest.
    """
    for middle in links:
        points = set(scene.links[middle].points)
        bars = [scene.links[name].points for name in links if name != middle]
        if len(bars) == 3 and all(len(bar) == 2 and len(points & {*bar}) == 1 for bar in bars):
            return ["".join(bar) for bar in bars]
    return []


def parallel(program: Program, step: Step, *, nearly: bool = False) -> Message:
    """Words for the lines that are parallel, or perpendicular, when a crossing fails.

    Perpendiculars to two bars are parallel when the bars are.
    """
    lines = [program.steps[arg] for arg in step.args]
    unnamed = message(
        "its two lines are nearly parallel" if nearly else "its two lines are parallel"
    )
    if len(lines) != 2 or any(line.action is None for line in lines):
        return unnamed
    (first, square), (second, other) = (line_words(line) for line in lines)
    if not first or not second:
        return unnamed
    if square == other:
        return message(
            "{one} and {other} are nearly parallel" if nearly else "{one} and {other} are parallel",
            one=first,
            other=second,
        )
    return message(
        "{one} and {other} are nearly perpendicular to each other"
        if nearly
        else "{one} and {other} are perpendicular to each other",
        one=first,
        other=second,
    )


def line_words(line: Step) -> tuple[str, bool]:
    """The bar or guide that a plan's line refers to, and whether the line is normal to it."""
    kind = construction(line)
    runs = kind.runs if kind is not None else None
    return (runs.what, runs.square) if runs is not None else ("", False)


def beside_dead_point(scene: Scene, program: Program, number: int) -> Message:
    """Words for what is nearly in line at a flat crossing, and the driver positions to change."""
    drivers = zip(scene.drivers, program.drives, strict=False)
    needed = set(program.behind((number,)))
    causes = [driver for driver, drive in drivers if drive.position in needed]
    places = either(
        message(
            "{driver} from {ranges}",
            driver=driver_name(driver),
            ranges=driver_position(scene, driver),
        )
        for driver in causes[:MOST]
    )
    words = in_line(scene, program, number, nearly=True)
    if not places:
        return words
    return message("{words}: move {places} to another position", words=words, places=places)


def driver_position(scene: Scene, driver: Driver) -> str:
    """A driver's position in the scene, with its unit."""
    number = float(driver.position.number(scene.values))
    unit = driver.position.unit
    return f"{number:.10g}°" if unit == "deg" else f"{number:.10g} {unit}"


# --- why a step cannot be drawn, by how much it misses, and for which positions it could be -------


TOUCH = 1e-9
"""Gap, relative to the size of the loci, below which loci that miss count as touching."""
FLAT = 1e-6
"""Sine of a crossing that rounding can make of loci that only touch."""
BLIND = 2.0**-26
"""Sine of a crossing, the root of eps, below which no digit of a velocity is correct."""
MOVING = (Part.POSITION, Part.VELOCITY, Part.ACCELERATION)
DEAD = message(
    "at this dead point, or so near to one that doubles cannot tell (solve --digits "
    "can), the driver's speed determines no other: change the driver's position"
)

BY_DIGITS = message("solve --digits finds it where doubles cannot tell")
"""Addition to a hint where numbers with more digits may find what doubles do not."""

AT_DEAD = message(
    "at this dead point the driver's speed determines no other: change the driver's position"
)

PLACES = {
    Part.SHAPE: message("shape"),
    Part.POSITION: message("position"),
    Part.VELOCITY: message("velocity"),
    Part.ACCELERATION: message("acceleration"),
}
"""The parts of the work, as the place of a problem."""
ALONE = message("it closes at this dead point alone: change the lengths")


# --- why a step fails ----------------------------------------------------------------------------


def does_not_close(
    scene: Scene, program: Program, needed: Sequence[int], failed: StepFailed
) -> ClosureError:
    """The error for a step that cannot be drawn: which, by how much, where it would close."""
    step = failed.step
    if isinstance(failed.__cause__, ClosingError):
        return ClosureError(no_such_closure(scene, failed, failed.__cause__))
    if isinstance(failed.__cause__, MergingError):
        return ClosureError(merging(scene, step, failed.__cause__))
    if (anywhere := undetermined(step, failed.args_found)) is not None:
        return ClosureError(anywhere)
    loci = loci_of(failed.args_found)
    early = step.part in (Part.SHAPE, Part.POSITION)
    if not early:
        values = run_before(program, needed, failed.number, scene.values)
        for number, found in doubtful(scene, program, values):
            if found.apart:
                return ClosureError(missed(scene, program, number, found))
    if early and loci is not None:
        found = meeting(scene, program, failed.number, loci)
        return ClosureError(missed(scene, program, failed.number, found))
    reason = why(scene, program, failed)
    hint = where_it_closes(scene) if early else DEAD
    return ClosureError(not_found(program, failed.number, reason, hint))


def to_balls_too(problem: Problem) -> Problem:
    """The problem, rewritten for a position that balls of many bits do not find either."""
    if problem.hint == DEAD:
        return replace(problem, hint=AT_DEAD)
    parts = [*problem.help.fields.values()]
    if parts[1:] == [BY_DIGITS]:
        return replace(problem, hint=parts[0])
    return problem


def missed(scene: Scene, program: Program, number: int, found: Meeting) -> Problem:
    """The problem of two loci that miss each other, or touch without crossing."""
    if found.lost:
        return lost(scene, program, number, found)
    hint, expected, kind = DEAD, LOCI, program.steps[number].of
    if found.apart:
        expected = kind.reaching if isinstance(kind, Determined) else LOCI
        known = closings(scene)
        alone = found.missed < TOUCH * found.size and not any(each.ranges for each in known)
        hint = ALONE if alone else closes_where(scene, known)
    return not_found(program, number, why_not(scene, program, number, found), hint, expected)


def lost(scene: Scene, program: Program, number: int, found: Meeting) -> Problem:
    """The problem of two loci that cross, but at a place that rounding has moved them away from."""
    step = program.steps[number]
    loci = step.of.loci if isinstance(step.of, Determined) else Determined.loci
    depth, moved = -found.missed, found.rounded - found.missed
    return Problem(
        message("position of {name}", name=step.name),
        message(
            "{name} cannot be found in doubles: {loci} cross, by {depth}, but the "
            "crossings before enlarge rounding to {moved}",
            name=step.name,
            loci=loci,
            depth=measured(scene, depth),
            moved=measured(scene, moved),
        ),
        message("crossings that are less flat, one after the other"),
        message("solve --digits finds it"),
        about=(Sought((step.name,)),),
    )


def not_found(
    program: Program, number: int, reason: Message, hint: Message, expected: Message = LOCI
) -> Problem:
    """The problem of a step that finds nothing, with the reason."""
    step = program.steps[number]
    words, names = sought(step)
    place = PLACES[step.part]
    if words:
        place = message("{part} of {words}", part=place, words=words)
    kind = construction(step)
    what: str = step.name or message("a value")
    if not step.name and isinstance(kind, PlacesLink) and kind.found_link:
        what = message("the angle of link {link}", link=kind.found_link)
    found = message("{what} cannot be found: {reason}", what=what, reason=reason)
    return Problem(place, found, expected, hint, about=(Sought(names),))


def sought(step: Step) -> tuple[str, tuple[str, ...]]:
    """The object of a step, in words and by name: its letter, else its links or points."""
    if links := closed_by(step):
        return message("links {names}", names=", ".join(links)), links
    kind = construction(step)
    if step.name or kind is None:
        return step.name, (step.name,) if step.name else ()
    if isinstance(kind, PlacesLink) and kind.found_link:
        return message("link {on}", on=kind.found_link), (kind.found_link,)
    points = tuple(filter(None, kind.points))
    return "-".join(points), points


def undetermined(step: Step, args: Sequence[Any]) -> Problem | None:
    """The problem of a step whose loci leave a position or direction open, as far as doubles show.

    None for other steps.
    """
    found = step.of.undetermined(args) if isinstance(step.of, Determined) else None
    return replace(found, hint=joined("; ", (found.help, BY_DIGITS))) if found else None


def no_such_closure(scene: Scene, failed: StepFailed, error: ClosingError) -> Problem:
    """The problem of a higher-class group without the stated closure, or without any."""
    closed = closed_by(failed.step)
    links = ", ".join(closed)
    if not error.ways:
        found = least_miss(scene, failed)
        hint = where_it_closes(scene)
        return Problem("position", found, LOCI, hint, about=(Sought(),))
    elsewhere = NO_WORDS
    known = closings(scene)
    if any(each.ranges for each in known):
        elsewhere = message(
            "with closure {asked} {closes}", asked=error.asked, closes=closes_where(scene, known)
        )
    ways = message("1 way") if error.ways == 1 else message("{ways} ways", ways=error.ways)
    return Problem(
        f"branches.{branch_of(scene, closed)}",
        message(
            "links {links} close in {ways} here, closure {asked} is asked",
            links=links,
            ways=ways,
            asked=error.asked,
        ),
        message('"closure 1"')
        if error.ways == 1
        else message('"closure 1" to "closure {ways}"', ways=error.ways),
        joined("; ", (message("graphkin check lists them"), elsewhere)),
        tuple(Written(f'"closure {n}"') for n in range(1, error.ways + 1)),
    )


def merging(scene: Scene, step: Step, error: MergingError) -> Problem:
    """The problem of a closure number that is undecided because two closures merge."""
    closed = closed_by(step)
    links = ", ".join(closed)
    return Problem(
        f"branches.{branch_of(scene, closed)}",
        message(
            "closures {first} and {second} of links {links} merge here, or so near that balls of "
            "{bits} bits do not tell, so that closure {asked} is not decided",
            first=error.first,
            second=error.first + 1,
            links=links,
            bits=BITS[-1],
            asked=error.asked,
        ),
        message("closure 1 to {last}", last=error.first - 1)
        if error.first > 1
        else message("a position where none merge"),
        message("move the driver"),
    )


def branch_of(scene: Scene, links: Sequence[str]) -> str:
    """The link under which [branches] states the closure of some links."""
    return next((name for name in links if name in scene.branches), links[0])


def least_miss(scene: Scene, failed: StepFailed) -> Message:
    """Words for a higher-class group that does not close, with the smallest gap where known."""
    links = ", ".join(closed_by(failed.step))
    closer = closer_of(failed.step)
    assert closer is not None
    trying = closer.trying
    if trying.first.facing is not None or trying.several:
        return message("links {links} do not close", links=links)
    known = [np.atleast_1d(value) for value in failed.args_found]
    tried = trying.grid(known, 1).ravel()
    here = [np.repeat(array, len(tried)) for array in known]
    least = np.inf
    for signs in sign_table(len(trying.signs)):
        rows = np.broadcast_to(np.array(signs, dtype=float), (len(tried), len(signs)))
        missed = np.abs(trying.misfits(here, tried[:, None], rows)[:, 0])
        least = np.nanmin(missed, initial=least)
    if not np.isfinite(least):
        return message(
            "links {links} do not close, wherever the first of them is tried", links=links
        )
    return message(
        "links {links} do not close: they miss each other by {gap}",
        links=links,
        gap=measured(scene, least),
    )


def why(scene: Scene, program: Program, failed: StepFailed) -> Message:
    """Words for the reason of a failed step: loci that miss each other, or parallel lines."""
    if isinstance(failed.__cause__, MergingError):
        first = failed.__cause__.first
        return message(
            "closures {first} and {second} merge here as far as the ball tells",
            first=first,
            second=first + 1,
        )
    kind = failed.step.of
    own = kind.failing() if isinstance(kind, Determined) else NO_WORDS
    return own or in_line(scene, program, failed.number)


def why_not(scene: Scene, program: Program, number: int, found: Meeting) -> Message:
    """Words for two loci that miss each other, or touch without crossing."""
    step = program.steps[number]
    if found.missed >= TOUCH * found.size:
        return miss_words(scene, step, found.missed)
    words = message("{words}, a dead point", words=in_line(scene, program, number))
    if not found.apart:
        return words
    return message("{words}, but {gap}", words=words, gap=miss_words(scene, step, found.missed))


def miss_words(scene: Scene, step: Step, missed: float) -> Message:
    """Words for the gap between the loci of a step."""
    apart = step.of.apart if isinstance(step.of, Determined) else Determined.apart
    return message("{apart} by {gap}", apart=apart, gap=measured(scene, missed))


# --- whether loci meet, decided apart from where they do -----------------------------------------


def run_before(
    program: Program, needed: Sequence[int], number: int, values: Values
) -> dict[int, Any]:
    """The values of the steps before one that failed."""
    found: dict[int, Any] = {}
    for earlier in (n for n in needed if n < number and not program.steps[n].hand):
        found[earlier] = evaluate(program.steps[earlier], earlier, found, values, FLOAT, {})
    return found


def doubtful(
    scene: Scene, program: Program, values: Mapping[int, Any]
) -> Iterator[tuple[int, Meeting]]:
    """The steps whose loci cross as flatly as rounding, with the exact state of these loci."""
    for number in values:
        step = program.steps[number]
        if step.part is not Part.POSITION or step.hand or step.action is None:
            continue
        if step.action.margin is None or (loci := loci_of([values[a] for a in step.args])) is None:
            continue
        if step.action.margin(*loci, 1) < FLAT:
            yield number, meeting(scene, program, number, loci)


def refuse_touching(scene: Scene, trace: Trace) -> None:
    """Raise ClosureError where rounded numbers cross two loci that really touch or miss.

    Loci that the scene states in rational numbers are decided exactly. Where loci touch, or cross
    too flatly for rounding to tell, positions may be drawn but velocities may not.
    """
    program = trace.program
    moving = any(program.steps[number].part is Part.VELOCITY for number in trace.values)
    if moving:
        refuse_blind(scene, trace)
    for number, found in doubtful(scene, program, trace.values):
        if (found.proved and found.apart) or (moving and found.barely):
            raise ClosureError(missed(scene, program, number, found))


def refuse_blind(scene: Scene, trace: Trace) -> None:
    """Raise ClosureError where two loci cross so flatly that their crossing is only rounding.

    The error of a velocity is eps over the square of the sine. Below the root of eps nothing of the
    velocity is known.
    """
    program = trace.program
    for number, margin in trace.margins.items():
        step = program.steps[number]
        if step.hand or step.part not in MOVING or margin >= BLIND:
            continue
        if (anywhere := undetermined(step, [trace.values[arg] for arg in step.args])) is not None:
            raise ClosureError(anywhere)
        words = message(
            "{words} as far as doubles tell, a dead point", words=in_line(scene, program, number)
        )
        raise ClosureError(not_found(program, number, words, DEAD))


def measured(scene: Scene, length: float) -> str:
    """A length (m) in the unit of the scene, with four digits."""
    unit = scene.units["length"]
    return f"{shortest(float(f'{length / scene.unit_length:.4g}'))} {unit}"
