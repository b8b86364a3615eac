"""What is handed out: the sheets of a mechanism, each one proved right before it is drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice
from typing import TYPE_CHECKING, Any

from graphkin.errors import Problem, SceneError, WitnessError
from graphkin.mechanism import Mechanism
from graphkin.paper.areas import HEIGHT, WIDTH
from graphkin.paper.drawing import Drawing
from graphkin.paper.scale import (
    Extent,
    Scales,
    extent_of,
    fitting_scale,
    kept_scale,
    preferred,
)
from graphkin.steps.program import PLACES, Target
from graphkin.steps.solution import FAIR, Curve, Solution, Verdict
from graphkin.steps.trying import Closer
from graphkin.text import LANGUAGES, Words, words

if TYPE_CHECKING:
    from graphkin.motion.cycle import Cycle
    from graphkin.paper.marks import Page

WANTED = {
    "velocity": ("velocity", "omega", "centre", "slide speed"),
    "acceleration": ("acceleration", "epsilon", "pole", "inflection", "slide acceleration"),
}
"""The sheet on which each quantity is asked."""
STEPS = 720
"""Positions of a turn from which a curve is drawn."""
SIZES = (0.2, 1.2)
"""How large plans are drawn beside the mechanism where no crank says it: at least, at most."""
NARROW = 45.0
"""Least width of a plan in mm, so that its caption has room above it."""
LADDER = 5
"""Preferred scales that are tried then, upwards from the least."""
LARGE = (120.0, 80.0)
"""Sizes in mm above which a mechanism or a plan is read no better."""
SMALL = 20.0
"""A longest vector in mm below which a plan is not drawn at the scale of its crank."""
LITTLE = 45.0
"""Breadth of a mechanism in mm below which its crank does not say how its plans are drawn."""
LARGER = (1.5, 5.0)
"""How many times larger it is then drawn: at least, at most."""
AWAY = 20.0
"""Breadths of the mechanism beyond which a centrode is not followed."""


@dataclass(frozen=True)
class Sheet:
    """The pages of one document: velocity, acceleration or calculation."""

    kind: str
    pages: tuple[Page, ...]


def hand_out(mechanism: Mechanism, view: str = "key", language: str | None = None) -> list[Sheet]:
    """The sheets that a scene asks for, in a language (the scene's own if None).

    Raises WitnessError when the independent route disagrees, PageError when a page does not fit.
    """
    from graphkin.paper.calculation import calculation
    from graphkin.paper.sheet import sheet

    spoken = language_of(mechanism, language)
    if mechanism.scene.sheet.sheets != len(WANTED):
        raise SceneError(
            Problem("sheet.sheets", "one sheet for both plans is not drawn yet", "2, or left out")
        )
    verdict = proved(mechanism, mechanism.solve())
    drawings = drawings_of(mechanism, verdict, spoken)
    total = len(drawings)
    sheets = [
        Sheet(drawing.kind, (sheet(drawing, view, f"{i}/{total}"),))
        for i, drawing in enumerate(drawings, 1)
    ]
    return [*sheets, Sheet("calculation", calculation(drawings, view))]


def language_of(mechanism: Mechanism, language: str | None) -> Words:
    """The words of a language. Raises SceneError for one that is not there."""
    code = language or mechanism.scene.sheet.language
    if code not in LANGUAGES:
        raise SceneError(
            Problem("sheet.language", f'"{code}" is not a language', " or ".join(LANGUAGES))
        )
    return words(code)


def proved(mechanism: Mechanism, solution: Solution) -> Verdict:
    """The witness's verdict. Raises WitnessError when it does not agree, or cannot be trusted."""
    if solution.margin < FAIR:
        raise WitnessError(
            Problem(
                "position",
                f"the flattest crossing has a sine of {solution.margin:.1e}",
                f"at least {FAIR:g}",
                "the position is nearly singular: choose another driver angle",
            )
        )
    verdict = mechanism.witness(solution)
    if not verdict.agrees:
        raise WitnessError(
            Problem(
                verdict.quantity,
                f"construction and vector loops differ by {verdict.largest_difference:.1e}",
                f"at most {verdict.limit:.1e}",
                "; ".join(verdict.branches) or "no sheet is handed out",
            )
        )
    return verdict


def drawings_of(mechanism: Mechanism, verdict: Verdict, spoken: Words) -> list[Drawing]:
    """The material of each sheet, all at the same scale."""
    curves = curves_of(mechanism)
    chosen = scales(mechanism, curves)
    drawings = [
        drawing(mechanism, kind, found, chosen, verdict, spoken, curves)
        for kind in WANTED
        if (found := targets_of(mechanism, kind))
    ]
    drawings[1:] = [replace(later, again=True) for later in drawings[1:]]
    if not drawings:
        raise SceneError(
            Problem("ask", "asks for nothing that is drawn", "velocities, accelerations, centres …")
        )
    return drawings


def targets_of(mechanism: Mechanism, kind: str) -> tuple[Target, ...]:
    """What is asked on one sheet, with the whole mechanism; nothing when nothing is asked."""
    ask = mechanism.scene.ask
    asked = [target for target in mechanism.asked() if target[0] in WANTED[kind]]
    if kind == "velocity":
        asked += [("centre", link) for link in ask.centrodes if mechanism.gives(("centre", link))]
    if not asked and not (kind == "velocity" and (ask.curves or ask.centrodes)):
        return ()
    positions = [
        target for target in mechanism.program.targets if target[0] in ("position", *PLACES)
    ]
    return (*positions, *asked)


def scales(mechanism: Mechanism, curves: tuple[Curve, ...] | None = None) -> Scales:
    """The one set of scale factors at which every sheet's drawings fit their fields."""
    curves = curves_of(mechanism) if curves is None else curves
    stated = mechanism.scene.sheet.scale
    wanted = float(stated.number(mechanism.scene.values)) if stated is not None else 0.0
    crank, own = the_crank(mechanism), None
    if crank:
        trials = trials_of(mechanism, curves, 1 / crank)
        kL = fitting_scale(extents(trials), WIDTH, HEIGHT)
        kL = kept_scale(wanted, kL) if wanted else kL
        own = Scales(kL, 1 / crank)
        if wanted or min(1000 * trial.reach / kL for trial in trials) >= LITTLE:
            larger = enlarged(mechanism, curves, kL, crank) if are_small(trials, kL) else None
            return larger or own
    natural = natural_seconds(mechanism)
    smallest = trials_of(mechanism, curves, natural * SIZES[0])
    least = fitting_scale(extents(smallest), WIDTH, HEIGHT)
    lengths = [kept_scale(wanted, least)] if wanted else list(islice(preferred(least), LADDER))
    tried = [pair for kL in lengths for pair in pairs_of(mechanism, curves, kL, natural)]
    _, kL, kv = max(tried, default=(0.0, least, next(preferred(least / natural / SIZES[0]))))
    return own if own and own.kL <= kL else Scales(kL, kL / kv, from_driver=False)


def are_small(trials: list[Drawing], kL: float) -> bool:
    """True when the longest vector of a plan that is not nought is too short beside a scale."""
    vectors = [abs(trial.at_scale(trial.plane, trial.largest)) for trial in trials]
    return any(0 < 1000 * vector / kL < SMALL for vector in vectors)


def enlarged(
    mechanism: Mechanism, curves: tuple[Curve, ...], kL: float, crank: float
) -> Scales | None:
    """The least preferred kv at which plans fit beside a kL, larger than the crank draws them.

    None where no larger ones fit.
    """
    for kv in preferred(kL * crank / LARGER[1]):
        if kv > kL * crank / LARGER[0]:
            return None
        trials = trials_of(mechanism, curves, kL / kv)
        if fitting_scale(extents(trials), WIDTH, HEIGHT) <= kL * (1 + 1e-12):
            return Scales(kL, kL / kv, from_driver=False)
    return None


def pairs_of(
    mechanism: Mechanism, curves: tuple[Curve, ...], kL: float, natural: float
) -> Iterator[tuple[float, float, float]]:
    """The preferred kv that fit beside a kL, each with how well both drawings can be read."""
    for kv in preferred(kL / natural / SIZES[1]):
        seconds = kL / kv
        if seconds < SIZES[0] * natural / 2:
            return
        trials = trials_of(mechanism, curves, seconds)
        if 1000 * max(trial.mechanism_extent().width for trial in trials) > kL * (WIDTH - NARROW):
            continue
        if fitting_scale(extents(trials), WIDTH, HEIGHT) <= kL * (1 + 1e-12):
            size = min(1000 * trial.reach / kL for trial in trials)
            vectors = [abs(trial.at_scale(trial.plane, trial.largest)) for trial in trials]
            yield min(size, LARGE[0]) * min(1000 * min(vectors) / kL, LARGE[1]), kL, kv


def extents(trials: list[Drawing]) -> list[tuple[Extent, Extent]]:
    """The room for mechanism and plan on each sheet, at the mechanism's full size."""
    return [(trial.mechanism_extent(), trial.plan_extent()) for trial in trials]


def trials_of(mechanism: Mechanism, curves: tuple[Curve, ...], seconds: float) -> list[Drawing]:
    """The material of each sheet, a velocity drawn at full size as its way in some time."""
    asked = {kind: targets_of(mechanism, kind) for kind in WANTED}
    if not any(asked.values()):
        asked = dict.fromkeys(WANTED, mechanism.program.answers)
    nobody = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    return [
        drawing(mechanism, kind, found, Scales(1.0, seconds), nobody, words("en"), curves)
        for kind, found in asked.items()
        if found
    ]


def the_crank(mechanism: Mechanism) -> float:
    """Speed in rad/s of the one crank that drives alone; 0 where there is none or it stands."""
    drivers = mechanism.scene.drivers
    if len(drivers) != 1 or drivers[0].kind != "turn":
        return 0.0
    return abs(float(drivers[0].speed.si(mechanism.scene.values)))


def natural_seconds(mechanism: Mechanism) -> float:
    """kL/kv that draws the plans about as large as the mechanism, where no crank says it."""
    points = mechanism.solve().points.values()
    places = extent_of([complex(point.position) for point in points if point.position is not None])
    size = max(places.width, places.height)
    fastest = max((abs(point.velocity or 0) for point in points), default=0.0)
    hardest = max((abs(point.acceleration or 0) for point in points), default=0.0)
    slowest = max(fastest / size, (hardest / size) ** 0.5)
    return 1 / slowest if slowest else 1.0


def drawing(
    mechanism: Mechanism,
    kind: str,
    targets: tuple[Target, ...],
    scales: Scales,
    verdict: Verdict,
    spoken: Words,
    curves: tuple[Curve, ...] = (),
) -> Drawing:
    """The material of one sheet: everything a hand draws for it."""
    trace = mechanism.trace(targets, by_hand=True, seconds=scales.seconds)
    on_this = curves if kind == "velocity" else ()
    return Drawing(kind, mechanism.scene, trace, scales, verdict, spoken, curves=on_this)


def curves_of(mechanism: Mechanism) -> tuple[Curve, ...]:
    """The centrodes and paths that are asked, over a turn or the whole range of the driver."""
    ask = mechanism.scene.ask
    if not ask.centrodes and not ask.curves:
        return loci_of(mechanism)
    from graphkin.motion.cycle import cycle

    whole = followed(cycle(mechanism, steps=STEPS))
    curves = [curve for link in ask.centrodes for curve in centrodes_of(mechanism, whole, link)]
    for point in ask.curves:
        path = whole.solution.points[point].position
        curves.append(Curve("trajectory", point, runs_of(whole, path)))
    return (*loci_of(mechanism), *curves)


def loci_of(mechanism: Mechanism) -> tuple[Curve, ...]:
    """The locus by which each group of higher class is closed, where a point shows the fit."""
    steps = mechanism.program.steps
    closing = [n for n, step in enumerate(steps) if step.action and is_closer(step.action.value)]
    if not closing:
        return ()
    trace = mechanism.trace([t for t in mechanism.program.targets if t[0] == "position"])
    curves = []
    for number in closing:
        step = steps[number]
        assert step.action is not None and isinstance(step.action.value, Closer)
        _, *signs, _ = trace.values[number]
        found = step.action.value.locus([trace.values[arg] for arg in step.args], signs)
        if found is not None:
            curves.append(Curve("locus", step.says["l"], unbroken(found)))
    return tuple(curves)


def is_closer(value: object) -> bool:
    """Whether an action closes a group of higher class."""
    return isinstance(value, Closer)


def unbroken(points: Any) -> tuple[tuple[complex, ...], ...]:
    """The runs of points without a NaN between them."""
    runs: list[list[complex]] = [[]]
    for point in points:
        if point == point:  # noqa: PLR0124
            runs[-1].append(complex(point))
        elif runs[-1]:
            runs.append([])
    return tuple(tuple(run) for run in runs if len(run) > 1)


def followed(whole: Cycle) -> Cycle:
    """A whole turn, or the range in which the scene stands, its ends in finer steps.

    Near a dead point a mechanism goes a long way while its driver hardly moves.
    """
    if whole.path.whole:
        return whole
    import numpy as np

    low, high = whole.ranges[0]
    turns = np.linspace(0, np.pi, STEPS + 1)[1:-1]
    return whole.along((low + high) / 2 - (high - low) / 2 * np.cos(turns))


def centrodes_of(mechanism: Mechanism, whole: Cycle, link: str) -> Iterator[Curve]:
    """The fixed and the moving centrode of a link, the moving one where the link stands now."""
    from graphkin.motion.centrodes import base, centrodes

    found, ends = centrodes(whole, link), base(mechanism.scene.links[link])
    if found is None or ends is None:
        return
    trace = mechanism.trace([("centre", link), *(("position", point) for point in ends)])
    origin, end = (trace.value("position", point) for point in ends)
    centre = trace.value("centre", link)
    now = complex(centre.start + centre.shift / centre.size) if centre.size else None
    placed = found.placed(origin, (end - origin) / abs(end - origin))
    yield Curve("fixed-centrode", link, runs_of(whole, found.fixed), now)
    yield Curve("moving-centrode", link, runs_of(whole, placed), now)


def runs_of(whole: Cycle, path: Any) -> tuple[tuple[complex, ...], ...]:
    """A curve in runs, broken where a centre is far away; after a whole turn it closes."""
    import numpy as np

    ends = [p.position for p in whole.solution.points.values() if p.position is not None]
    breadth = max(float(np.ptp(part)) for p in ends for part in (np.real(p), np.imag(p))) or 1.0
    middle = np.mean([np.mean(p) for p in ends])
    closes = whole.path.whole and whole.path.returns
    points = np.append(path, path[:1]) if closes else np.asarray(path)
    near = np.abs(points - middle) <= AWAY * breadth
    runs = np.split(np.arange(len(points)), np.flatnonzero(np.diff(near)) + 1)
    return tuple(
        tuple(complex(points[i]) for i in run) for run in runs if len(run) > 1 and near[run[0]]
    )
