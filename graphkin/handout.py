"""What is handed out: the sheets of a mechanism, each one proved right before it is drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice
from typing import TYPE_CHECKING

from graphkin.errors import Problem, SceneError, WitnessError
from graphkin.loci import curves_of
from graphkin.mechanism import Mechanism
from graphkin.paper.areas import HEIGHT, WIDTH
from graphkin.paper.coriolis import without_triangles
from graphkin.paper.drawing import Drawing
from graphkin.paper.scale import (
    FINE,
    Extent,
    Scales,
    extent_of,
    fitting_scale,
    kept_scale,
    preferred,
)
from graphkin.steps.gather import gathered
from graphkin.steps.program import PLACES, Target
from graphkin.steps.solution import FAIR, Curve, Solution, Verdict
from graphkin.text import LANGUAGES, Words, words

if TYPE_CHECKING:
    from graphkin.paper.marks import Page

WANTED = {
    "velocity": ("velocity", "omega", "centre", "slide speed"),
    "acceleration": ("acceleration", "epsilon", "pole", "inflection", "slide acceleration"),
}
"""The sheet on which each quantity is asked."""
CALCULATED = ("key", "task")
"""The views that come with calculation pages."""
SIZES = (0.2, 1.2)
"""How large plans are drawn beside the mechanism where no crank says it: at least, at most."""
NARROW = 45.0
"""Least width of a plan in mm, so that its caption has room above it."""
LADDER = 5
"""Preferred scales that are tried then, upwards from the least."""
LARGE = (120.0, 80.0)
"""Sizes in mm above which a mechanism or a plan is read no better."""
SMALL = 40.0
"""A longest vector in mm below which a plan is not drawn at the scale of its crank."""
LONG = 100.0
"""A longest vector in mm that is long enough."""
LITTLE = 45.0
"""Breadth of a mechanism in mm below which its crank does not say how its plans are drawn."""
LARGER = (1.3, 5.0)
"""How many times larger it is then drawn: at least, at most."""
HEADROOM = 6.0
"""How far, in mm, arrows of such plans may reach into the margin above a mechanism."""


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

    spoken = language_of(mechanism, language)
    if mechanism.scene.sheet.sheets != len(WANTED):
        raise SceneError(
            Problem("sheet.sheets", "one sheet for both plans is not drawn yet", "2, or left out")
        )
    verdict = proved(mechanism, shown(mechanism))
    drawings = drawings_of(mechanism, verdict, spoken)
    total = len(drawings)
    sheets = [
        Sheet(drawing.kind, drawn(drawing, view, f"{i}/{total}"))
        for i, drawing in enumerate(drawings, 1)
    ]
    if view not in CALCULATED:
        return sheets
    return [*sheets, Sheet("calculation", calculation(drawings, view))]


def drawn(drawing: Drawing, view: str, number: str) -> tuple[Page, ...]:
    """The pages of one drawing in a view."""
    if view == "steps":
        from graphkin.paper.growing import growing

        return growing(drawing, number)
    if view == "overlay":
        from graphkin.paper.overlay import overlay

        return (overlay(drawing, number),)
    from graphkin.paper.sheet import sheet

    return (sheet(drawing, view, number),)


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


def shown(mechanism: Mechanism) -> Solution:
    """The motion that the sheets show: where everything stands, and of the rest what is asked."""
    targets = dict.fromkeys(t for kind in WANTED for t in targets_of(mechanism, kind))
    return gathered(mechanism.trace(targets or None), mechanism.scene.links)


def scales(mechanism: Mechanism, curves: tuple[Curve, ...] | None = None) -> Scales:
    """The one set of scale factors at which every sheet's drawings fit their fields.

    Where the triangles of Coriolis components leave no room for a larger mechanism, they give way.
    """
    curves = curves_of(mechanism) if curves is None else curves
    drawn = scales_with(mechanism, curves, triangles=True)
    if "coriolis" not in {step.action.key for step in mechanism.program.steps if step.action}:
        return drawn
    computed = scales_with(mechanism, curves, triangles=False)
    return computed if computed.kL < drawn.kL else drawn


def scales_with(mechanism: Mechanism, curves: tuple[Curve, ...], *, triangles: bool) -> Scales:
    """The scale factors with Coriolis components drawn, or computed."""
    stated = mechanism.scene.sheet.scale
    wanted = float(stated.number(mechanism.scene.values)) if stated is not None else 0.0
    crank, own = the_crank(mechanism), None
    if crank:
        own = Scales(1.0, 1 / crank, triangles=triangles)
        trials = trials_of(mechanism, curves, own)
        kL = fitting_scale(extents(trials), WIDTH, HEIGHT)
        own = replace(own, kL=kept_scale(wanted, kL) if wanted else kL)
        if wanted or min(1000 * trial.reach / own.kL for trial in trials) >= LITTLE:
            return enlarged(mechanism, curves, own, trials) or own
    natural = natural_seconds(mechanism)
    free = Scales(1.0, natural * SIZES[0], from_driver=False, triangles=triangles)
    least = fitting_scale(extents(trials_of(mechanism, curves, free)), WIDTH, HEIGHT)
    lengths = [kept_scale(wanted, least)] if wanted else list(islice(preferred(least), LADDER))
    tried = [pair for kL in lengths for pair in pairs_of(mechanism, curves, kL, natural, free)]
    _, kL, kv = max(tried, default=(0.0, least, next(preferred(least / natural / SIZES[0]))))
    return own if own and own.kL <= kL else replace(free, kL=kL, seconds=kL / kv)


def lengths_of_longest(trials: list[Drawing], kL: float) -> list[float]:
    """How long the longest vector of each plan is beside a scale, in mm."""
    return [1000 * abs(trial.at_scale(trial.plane, trial.largest)) / kL for trial in trials]


def enlarged(
    mechanism: Mechanism, curves: tuple[Curve, ...], own: Scales, trials: list[Drawing]
) -> Scales | None:
    """The least round kv at which plans fit beside a kL, larger than the crank draws them.

    None where no larger ones fit, or where they are large enough.
    """
    lengths = lengths_of_longest(trials, own.kL)
    if not any(0 < length < SMALL for length in lengths):
        return None
    for kv in preferred(own.kv / min(LARGER[1], LONG / max(lengths)), FINE):
        if kv > own.kv / LARGER[0]:
            return None
        larger = replace(own, seconds=own.kL / kv, from_driver=False)
        needs = extents(trials_of(mechanism, curves, larger))
        needed = fitting_scale(needs, WIDTH, HEIGHT + HEADROOM)
        if needed <= own.kL * (1 + 1e-12):
            return larger
    return None


def pairs_of(
    mechanism: Mechanism, curves: tuple[Curve, ...], kL: float, natural: float, free: Scales
) -> Iterator[tuple[float, float, float]]:
    """The preferred kv that fit beside a kL, each with how well both drawings can be read."""
    for kv in preferred(kL / natural / SIZES[1]):
        seconds = kL / kv
        if seconds < SIZES[0] * natural / 2:
            return
        trials = trials_of(mechanism, curves, replace(free, seconds=seconds))
        if 1000 * max(trial.mechanism_extent().width for trial in trials) > kL * (WIDTH - NARROW):
            continue
        if fitting_scale(extents(trials), WIDTH, HEIGHT) <= kL * (1 + 1e-12):
            size = min(1000 * trial.reach / kL for trial in trials)
            shortest = min(lengths_of_longest(trials, kL))
            yield min(size, LARGE[0]) * min(shortest, LARGE[1]), kL, kv


def extents(trials: list[Drawing]) -> list[tuple[Extent, Extent]]:
    """The room for mechanism and plan on each sheet, at the mechanism's full size."""
    return [(trial.mechanism_extent(), trial.plan_extent()) for trial in trials]


def trials_of(mechanism: Mechanism, curves: tuple[Curve, ...], scales: Scales) -> list[Drawing]:
    """The material of each sheet at full size, a velocity drawn as its way in some time."""
    asked = {kind: targets_of(mechanism, kind) for kind in WANTED}
    if not any(asked.values()):
        asked = dict.fromkeys(WANTED, mechanism.program.answers)
    nobody = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    return [
        drawing(mechanism, kind, found, replace(scales, kL=1.0), nobody, words("en"), curves)
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
    points = shown(mechanism).points.values()
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
    trace = trace if scales.triangles else without_triangles(trace)
    on_this = curves if kind == "velocity" else ()
    return Drawing(kind, mechanism.scene, trace, scales, verdict, spoken, curves=on_this)
