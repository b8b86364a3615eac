"""Solutions as plain records, and how a trace becomes one: each quantity under its owner.

Reactions in pairs and balancing forces are read off the plan of forces, in SI units; moments are
counter-clockwise positive.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from math import inf, nan
from typing import Any

from msgspec import Struct, field
from msgspec.structs import asdict, replace

from graphkin.construction.core.program import PairForce, Part, Program
from graphkin.construction.core.quantities import (
    QUANTITIES,
    LinkMotion,
    PointMotion,
    SlideMotion,
    Whose,
)
from graphkin.construction.core.run import StepFailed, Trace, Values, run
from graphkin.numbers.arithmetic import FLOAT, Real, least, np
from graphkin.numbers.plane import Ratio, cross
from graphkin.structure.pairs import is_in_scene
from graphkin.text.errors import StructureError, message

FAIR = 1e-4
"""Sine of the flattest crossing at which an answer is still fair and a sheet is handed out."""
UNKNOWN = complex(nan, nan)
"""The value of a vector without any reliable digit; for a number NaN."""


class Solution(Struct, frozen=True):
    """The motion of a mechanism in one position, or of a batch of variants as arrays.

    ``margin`` is the smallest sine of crossing among the executed steps. ``centres`` are the
    centres of two links, under names such as 2-4.
    """

    points: Mapping[str, PointMotion]
    links: Mapping[str, LinkMotion]
    slides: Mapping[str, SlideMotion] = field(default_factory=dict)
    margin: Real = 1.0
    centres: Mapping[str, Ratio] = field(default_factory=dict)


class Curve(Struct, frozen=True):
    """A curve on the mechanism over its motion, in metres, in unbroken runs.

    ``kind`` is fixed-centrode or moving-centrode of link ``of``, or trajectory of point ``of``.
    ``now`` is its point at the scene's own position, where the centrodes touch.
    """

    kind: str
    of: str
    runs: tuple[tuple[complex, ...], ...]
    now: complex | None = None

    @property
    def name(self) -> str:
        """The name of its marks."""
        return f"{self.kind} {self.of}"


class Verdict(Struct, frozen=True):
    """The difference between the independent route and the construction.

    ``largest_difference`` is the largest absolute difference over the largest magnitude of that
    quantity in the scene. ``quantity`` names that quantity. ``limit`` bounds the true error of
    every quantity in the same way. If a quantity differs by more than rounding explains, all three
    fields refer to it.

    ``residual`` (m) is the closure error before the first iteration. ``moved`` (m) is the distance
    that Newton's method then covered. ``branches`` lists the branch conditions that do not hold.
    ``guessed`` lists the links that no position determines, which the residual check assembled by
    itself.

    ``digits`` is the number of reliable digits of every position, velocity and acceleration.
    ``unsure`` names the quantities without a reliable digit, which the verdict ignores.
    """

    agrees: bool
    largest_difference: float
    quantity: str
    limit: float
    residual: float
    moved: float
    branches: tuple[str, ...] = ()
    guessed: tuple[str, ...] = ()
    digits: Mapping[str, int] = field(default_factory=dict)
    unsure: tuple[str, ...] = ()

    @property
    def differs(self) -> bool:
        """Whether the results differ by more than the limit, or nothing limits them."""
        return not self.largest_difference <= self.limit < inf

    def not_as_stated(self, branches: Mapping[str, object]) -> str:
        """The stated branches that do not hold, as the scene writes them."""
        return ", ".join(f'{name} = "{branches[name]}"' for name in self.branches)


UNPROVED = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
"""The verdict on a drawing that is only measured."""


TOUCHING = 8
"""Sine of a crossing, in units of sqrt(eps), at which two loci count as touching in a batch."""
ALL = -1
"""The key under which a merged trace has the product of its sines, next to the smallest sine."""


def gathered(trace: Trace, links: Iterable[str] | None = None) -> Solution:
    """The solution in a trace, links in the given order; what was not executed is None."""
    turning = motions(trace, "links")
    pairs = {name: turning.pop(name)["instant_centre"] for name in [*turning] if "-" in name}
    return Solution(
        points={name: PointMotion(**own) for name, own in motions(trace, "points").items()},
        links={n: LinkMotion(**turning[n]) for n in links or turning if n in turning},
        slides={name: SlideMotion(**own) for name, own in motions(trace, "slides").items()},
        margin=smallest_margin(trace),
        centres=pairs,
    )


def motions(trace: Trace, whose: Whose) -> dict[str, dict[str, Any]]:
    """The known quantities of each point, link or block that has any.

    A quantity may have two targets, such as a centre that a circle needs too. The first known one
    counts.
    """
    ways = {each.target: each.attribute for each in reversed(QUANTITIES) if each.whose == whose}
    names = dict.fromkeys(of for target, of in trace.program.targets if target in ways)
    found = {
        name: {
            attribute: value
            for target, attribute in ways.items()
            if (value := trace.value(target, name)) is not None
        }
        for name in names
        if is_in_scene(name)
    }
    return {name: own for name, own in found.items() if own}


def with_least_margin(trace: Trace) -> Trace:
    """The same trace with the smallest of its margins alone, and the product of its sines."""
    crossings = counted(trace)
    if not crossings:
        return replace(trace, margins={})
    margins = {next(iter(crossings)): smallest_margin(trace), ALL: product_of_sines(trace)}
    return replace(trace, margins=margins)


def without_touching(trace: Trace) -> Trace:
    """A batch with NaN for variants in which two loci touch: no digit of a rate is correct there.

    The limit is a sine of 8·sqrt(eps), 1.2e-7 for doubles. A sine that should be zero comes out
    that large, and by the 1-2-3 law a velocity has lost all but two digits.
    """
    margin = smallest_margin(trace)
    if not isinstance(margin, np.ndarray):
        return trace
    touching = margin < TOUCHING * np.finfo(margin.dtype).eps ** 0.5
    if not touching.any():
        return trace
    values = {number: without(value, touching) for number, value in trace.values.items()}
    return replace(trace, values=values)


def without(value: Any, some: Any) -> Any:
    """A value with NaN for some of its variants; a value shared by all variants stays."""
    if isinstance(value, Ratio):
        return Ratio(*(without(part, some) for part in value))
    return np.where(some, np.nan, value) if isinstance(value, np.ndarray) else value


def smallest_margin(trace: Trace) -> Real:
    """The smallest sine of crossing in the construction; 1 where nothing crosses.

    NaN where a variant of a batch cannot be drawn. The flat triangles of plates do not count: their
    points follow by similarity.
    """
    smallest: Real = 1.0
    for margin in counted(trace).values():
        smallest = least(smallest, margin)
    return smallest


def product_of_sines(trace: Trace) -> Real:
    """The product of the sines of all crossings of the mechanism, each of which multiplies errors.

    NaN where a variant of a batch cannot be drawn.
    """
    product: Real = trace.margins.get(ALL, 1.0)
    for number, margin in counted(trace).items():
        if ALL not in trace.margins and trace.program.steps[number].part is Part.POSITION:
            product = product * margin
    return product


def counted(trace: Trace) -> dict[int, Real]:
    """The margins of crossings that place or move something, by their steps."""
    steps = trace.program.steps
    return {
        number: margin
        for number, margin in trace.margins.items()
        if number != ALL and not steps[number].hand and steps[number].part is not Part.SHAPE
    }


def rows_of(solution: Solution, rows: Any) -> Solution:
    """Some rows of a solution of arrays; values shared by all variants stay."""

    def cut(record: Any) -> Any:
        found = asdict(record)
        return replace(record, **{name: row_of(v, rows) for name, v in found.items()})

    parts = ("points", "links", "slides")
    motions = {p: {n: cut(each) for n, each in getattr(solution, p).items()} for p in parts}
    centres = {name: row_of(ratio, rows) for name, ratio in solution.centres.items()}
    return Solution(**motions, margin=row_of(solution.margin, rows), centres=centres)


def row_of(value: Any, rows: Any) -> Any:
    """Some rows of an array, or of each part of a ratio; any other value stays."""
    if isinstance(value, Ratio):
        return Ratio(*(row_of(part, rows) for part in value))
    return value[rows] if hasattr(value, "shape") and value.shape else value


# --- reactions and balancing forces, read off the plan of forces ----------------------------------


class PairReaction(Struct, frozen=True):
    """The force on a link in a pin or guide, and its moment about the pin or the block's point.

    ``name`` is the pin's point, or the block or wheel with the link on which it slides or rolls,
    such as 5-0.
    ``block`` is that block or wheel, None for a pin. ``at`` is a point on the line of the force;
    None where a guide carries a couple alone.
    """

    name: str
    link: str
    force: complex
    moment: float
    at: complex | None
    block: str | None = None


class Balance(Struct, frozen=True):
    """The force (N) or the moment (N·m) of a driver on its link that keeps the given motion.

    ``link`` is the driver's name: the driven link, or 1-2 where several drivers move link 1.
    """

    link: str
    force: complex | None = None
    moment: float | None = None


class ForceSolution(Struct, frozen=True):
    """Every reaction, and the balance of each driver.

    In a pin of several links each entry is the force on one link from all others there.
    """

    reactions: tuple[PairReaction, ...]
    balance: tuple[Balance, ...]


def reactions_of(program: Program, values: Values, motion: Trace) -> ForceSolution:
    """The reactions and balances of a plan of forces with the values of its scene.

    ``motion`` is a trace of the same values; its steps are not run again. Raises StructureError
    where two lines of a polygon do not cross.
    """
    own = [n for each in program.reactions for n in each.steps]
    own += [each.step for each in program.balances]
    try:
        trace = run(program, program.behind(own), values, FLOAT, begun=motion)
    except StepFailed:
        found = message("a polygon of forces does not close")
        expected = message("a position away from the dead point")
        raise StructureError.at("loads", found, expected) from None
    balance = []
    for each in program.balances:
        value = each.sense * trace.values[each.step]
        balance.append(
            Balance(each.driver, moment=float(value))
            if each.turns
            else Balance(each.driver, force=complex(value))
        )
    return ForceSolution(tuple(listed_reactions(trace)), tuple(reversed(balance)))


def listed_reactions(trace: Trace) -> Iterator[PairReaction]:
    """The reactions by pair and link, with the place of those of guides and contacts."""
    values = trace.values
    sums: dict[tuple[str, str], tuple[PairForce, complex, float]] = {}
    for each in trace.program.reactions:
        force = complex(values[each.force])
        turned = 0.0
        if each.about is not None:
            turned = float(cross(values[each.place] - values[each.about], force))
            turned += 0.0 if each.couple is None else float(values[each.couple])
        for link, sign in zip(each.links, (1, -1), strict=True):
            _, before, moment = sums.get((each.name, link), (each, 0j, 0.0))
            sums[each.name, link] = each, before + sign * force, moment + sign * turned
    for (name, link), (each, force, moment) in sums.items():
        place = complex(values[each.place])
        if each.about is not None and not force:
            yield PairReaction(name, link, force, moment, None, each.block)
            continue
        yield PairReaction(name, link, force, moment, place, each.block)


def by_name(found: ForceSolution, name: str) -> Mapping[str, tuple[PairReaction, ...]]:
    """The reactions that a name asks for: a pin, or all guides and contacts of a link."""
    some: dict[str, tuple[PairReaction, ...]] = {}
    for each in found.reactions:
        if name == (each.block or each.name):
            some[each.name] = (*some.get(each.name, ()), each)
    return some
