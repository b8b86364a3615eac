"""At which scale factors the sheets of a mechanism are drawn, all of them at the same.

kL is the least preferred one at which mechanism and plan stand side by side. Where one crank
drives, kv = omega·kL draws its bar and its velocity alike; where that leaves a plan small, or no
crank says it, kv is the least round one that fits, or as many times less than the crank says as the
plan is larger. ka = kv²/kL.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice, takewhile

from msgspec.structs import replace

from graphkin.construction.core.component import as_drawn, may_give_way
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import PLACES, Target
from graphkin.construction.core.quantities import SHEETS, is_found_on
from graphkin.construction.core.results import gathered
from graphkin.construction.core.solution import Curve, Solution, Verdict
from graphkin.documents.scale_check import refuse_dots
from graphkin.drawing.areas import HEIGHT, WIDTH
from graphkin.drawing.scale import (
    FINE,
    Extent,
    Scales,
    extent_of,
    fitting_scale,
    kept_scale,
    preferred,
)
from graphkin.mechanism import Mechanism
from graphkin.motion.motion_curves import curves_of
from graphkin.scene.quantity import Quantity
from graphkin.text import Words, words
from graphkin.text.errors import PageError, Problem, SceneError

SIZES = (0.2, 1.2)
"""How large plans are drawn beside the mechanism where no crank says it: at least, at most."""
LADDER = 5
"""Preferred scales that are tried then, upwards from the least."""
LARGE = (120.0, 80.0)
"""Sizes in mm above which a mechanism or a plan is read no better."""
SMALL = 45.0
"""A longest vector in mm below which a plan is not drawn at the scale of its crank."""
LONG = 100.0
"""A longest vector in mm that is long enough."""
LITTLE = 45.0
"""Breadth of a mechanism in mm below which its crank does not say how its plans are drawn."""
LARGER = (1.4, 5.0)
"""How many times larger it is then drawn: at least, at most."""
TIMES = (4.0, 3.0, 2.5, 2.0, 1.5)
"""How many times larger than the crank says where no round kv fits."""
HEADROOM = 6.0
"""How far, in mm, arrows of such plans may reach into the margin above a mechanism."""


def targets_of(mechanism: Mechanism, kind: str) -> tuple[Target, ...]:
    """What is asked on one sheet, with the whole mechanism; nothing when nothing is asked.

    Velocities that the sheet of accelerations takes up are drawn on the first, asked or not.
    """
    ask = mechanism.scene.ask
    asked = [target for target in mechanism.asked() if is_found_on(kind, target)]
    if kind == "velocity":
        later = targets_of(mechanism, "acceleration")
        asked += mechanism.program.also_found(later, ("velocity", "omega"), asked)
    if not asked and not (kind == "velocity" and (ask.curves or ask.centrodes)):
        return ()
    positions = [
        target for target in mechanism.program.targets if target[0] in ("position", *PLACES)
    ]
    return (*positions, *asked)


def shown(mechanism: Mechanism) -> Solution:
    """The motion that the sheets show: where everything stands, and of the rest what is asked."""
    targets = dict.fromkeys(t for kind in SHEETS for t in targets_of(mechanism, kind))
    return gathered(mechanism.trace(targets or None), mechanism.scene.links)


def scales(mechanism: Mechanism, curves: tuple[Curve, ...] | None = None) -> Scales:
    """The one set of scale factors at which every sheet's drawings fit their fields.

    Raises PageError where one that the scene states leaves them no room, or leaves nothing of them.
    """
    curves = curves_of(mechanism) if curves is None else curves
    chosen, sheet = fitting(mechanism, curves), mechanism.scene.sheet
    keys = [key for key in ("scale", "enlarge", "ka") if stated(mechanism, getattr(sheet, key))]
    if keys:
        refuse_dots(chosen, trials_of(mechanism, curves, chosen), keys)
    return chosen


def fitting(mechanism: Mechanism, curves: tuple[Curve, ...]) -> Scales:
    """Scale factors at which all fits, as the scene states them or as large as may be.

    Where triangles that may give way leave no room for a larger mechanism, they do.
    """
    ka = stated(mechanism, mechanism.scene.sheet.ka)
    if ka:
        chosen = scales_with(mechanism, curves, triangles=False)
        return with_ka(mechanism, curves, chosen, 1000 * ka)
    drawn = scales_with(mechanism, curves, triangles=True)
    if not may_give_way(mechanism.program):
        return drawn
    computed = scales_with(mechanism, curves, triangles=False)
    return computed if computed.kL < drawn.kL else drawn


def scales_with(mechanism: Mechanism, curves: tuple[Curve, ...], *, triangles: bool) -> Scales:
    """The scale factors with all triangles drawn, or without those that may give way."""
    wanted = stated(mechanism, mechanism.scene.sheet.scale)
    times = stated(mechanism, mechanism.scene.sheet.enlarge)
    crank, own = the_crank(mechanism), None
    if times and not crank:
        found = "the plans of this mechanism are not drawn by one crank"
        hint = "leave it out: they are then drawn as large as they fit"
        raise SceneError(Problem("sheet.enlarge", found, "one driver, which turns", hint))
    if crank:
        own = Scales(1.0, (times or 1) / crank, triangles=triangles, times=times or 1.0)
        trials = trials_of(mechanism, curves, own)
        kL = fitting_scale(extents(trials), WIDTH, HEIGHT)
        own = replace(own, kL=kept_scale(wanted, kL) if wanted else kL)
        if times:
            return own
        if wanted or min(1000 * trial.reach / own.kL for trial in trials) >= LITTLE:
            return enlarged(mechanism, curves, own, trials) or own
    natural = natural_seconds(mechanism)
    free = Scales(1.0, natural * SIZES[0], from_driver=False, triangles=triangles)
    least = fitting_scale(extents(trials_of(mechanism, curves, free)), WIDTH, HEIGHT)
    lengths = [kept_scale(wanted, least)] if wanted else list(islice(preferred(least), LADDER))
    tried = [pair for kL in lengths for pair in pairs_of(mechanism, curves, kL, natural, free)]
    _, kL, kv = max(tried, default=(0.0, least, next(preferred(least / natural / SIZES[0]))))
    if own and own.kL <= kL:
        return enlarged(mechanism, curves, own, trials) or own
    return finer(mechanism, curves, replace(free, kL=kL, seconds=kL / kv))


def stated(mechanism: Mechanism, quantity: Quantity | None) -> float:
    """A number of [sheet]; 0 where the scene does not write it."""
    return float(quantity.number(mechanism.scene.values)) if quantity is not None else 0.0


def with_ka(mechanism: Mechanism, curves: tuple[Curve, ...], chosen: Scales, ka: float) -> Scales:
    """Scale factors with the ka that a scene states, in m/s² for each metre of paper.

    kL grows until the drawings fit, unless it is stated too. Raises PageError where none does.
    """
    if abs(ka - chosen.ka) <= 1e-9 * ka:
        return chosen
    lengths = [chosen.kL] if mechanism.scene.sheet.scale else islice(preferred(chosen.kL), LADDER)
    for kL in lengths:
        seconds = chosen.seconds if chosen.from_driver else kL / chosen.kv
        found = replace(chosen, kL=kL, seconds=seconds, apart=(kL / ka) ** 0.5)
        if fitting_scale(extents(trials_of(mechanism, curves, found)), WIDTH, HEIGHT) <= kL:
            return found
    raise PageError(
        Problem(
            "sheet.ka",
            f"does not fit: at {ka / 1000:g} (m/s²)/mm the acceleration plan leaves its field",
            f"{chosen.ka / 1000:.4g} or more",
            "write a larger ka, or leave it out",
        )
    )


def finer(mechanism: Mechanism, curves: tuple[Curve, ...], chosen: Scales) -> Scales:
    """The least round kv that fits beside a kL, where the preferred one leaves a plan short."""
    shortest = shortest_plan(trials_of(mechanism, curves, chosen), chosen.kL)
    least = max(shortest / LARGE[1], 1 / LARGER[1])
    for kv in preferred(chosen.kv * least, FINE):
        if kv >= chosen.kv * (1 - 1e-12):
            break
        found = replace(chosen, seconds=chosen.kL / kv)
        trials = trials_of(mechanism, curves, found)
        if fitting_scale(extents(trials), WIDTH, HEIGHT) <= chosen.kL * (1 + 1e-12):
            return found
    return chosen


def lengths_of_longest(trials: list[Drawing], kL: float) -> list[float]:
    """How long the longest vector of each plan is beside a scale, in mm."""
    return [1000 * abs(trial.at_scale(trial.plane, trial.largest)) / kL for trial in trials]


def shortest_plan(trials: list[Drawing], kL: float) -> float:
    """The longest vector, in mm, of the smallest plan that has any."""
    return min((x for x in lengths_of_longest(trials, kL) if x > 0), default=LARGE[1])


def enlarged(
    mechanism: Mechanism, curves: tuple[Curve, ...], own: Scales, trials: list[Drawing]
) -> Scales | None:
    """The largest plans that fit beside a kL where the crank draws one too small; None if none do.

    kv is round, or as many times less than the crank says as plans are enlarged.
    """
    lengths = lengths_of_longest(trials, own.kL)
    if not any(0 < length < SMALL for length in lengths):
        return None
    for seconds, times in larger_plans(own.kL, own.seconds, max(lengths)):
        larger = replace(own, seconds=seconds, times=times, from_driver=times != 1)
        needs = extents(trials_of(mechanism, curves, larger))
        needed = fitting_scale(needs, WIDTH, HEIGHT + HEADROOM)
        if needed <= own.kL * (1 + 1e-12):
            return larger
    return None


def larger_plans(kL: float, seconds: float, longest: float) -> Iterator[tuple[float, float]]:
    """kL/kv of plans larger than a crank draws them, and how many times as large it says they are.

    Those at a round kv come first, of which no crank says anything: once as large. ``longest`` is
    the longest vector in mm.
    """
    own, most = kL / seconds, min(LARGER[1], LONG / longest)
    for kv in takewhile(lambda kv: kv <= own / LARGER[0], preferred(own / most, FINE)):
        yield kL / kv, 1.0
    yield from ((seconds * times, times) for times in TIMES if times <= most)


def pairs_of(
    mechanism: Mechanism, curves: tuple[Curve, ...], kL: float, natural: float, free: Scales
) -> Iterator[tuple[float, float, float]]:
    """The preferred kv that fit beside a kL, each with how well both drawings can be read."""
    for kv in preferred(kL / natural / SIZES[1]):
        seconds = kL / kv
        if seconds < SIZES[0] * natural / 2:
            return
        trials = trials_of(mechanism, curves, replace(free, seconds=seconds))
        if fitting_scale(extents(trials), WIDTH, HEIGHT) <= kL * (1 + 1e-12):
            size = min(1000 * trial.reach / kL for trial in trials)
            shortest = shortest_plan(trials, kL)
            yield min(size, LARGE[0]) * min(shortest, LARGE[1]), kL, kv


def extents(trials: list[Drawing]) -> list[tuple[Extent, Extent]]:
    """The room for mechanism and plan on each sheet, at the mechanism's full size."""
    return [(trial.mechanism_extent(), trial.plan_extent()) for trial in trials]


def trials_of(mechanism: Mechanism, curves: tuple[Curve, ...], scales: Scales) -> list[Drawing]:
    """The material of each sheet at full size, a velocity drawn as its way in some time."""
    asked = {kind: targets_of(mechanism, kind) for kind in SHEETS}
    if not any(asked.values()):
        asked = dict.fromkeys(SHEETS, mechanism.program.answers)
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
    trace = as_drawn(mechanism.trace(targets, by_hand=True, seconds=scales.pace(kind)), scales)
    on_this = curves if kind == "velocity" else ()
    return Drawing(kind, mechanism.scene, trace, scales, verdict, spoken, curves=on_this)
