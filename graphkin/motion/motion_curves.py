"""The curves of the whole motion on sheets: centrodes, paths, loci that close a group."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from graphkin.construction.core.kind import construction
from graphkin.construction.core.solution import Curve
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np

if TYPE_CHECKING:
    from graphkin.motion.cycle import Cycle

STEPS = 720
"""Positions per turn for a curve."""
MOST_STEPS = 4320
"""The most positions of all turns after which the wheels are back."""
ALIKE = 1e-9
"""Distance of two points of a curve, as a share of its size, below which they are one."""
NEAR = 0.35
"""Length of a locus drawn on each side of its fit, as a share of the mechanism."""
AWAY = 20.0
"""Distance from the mechanism, in its breadths, beyond which a centrode is not followed."""


def curves_of(mechanism: Mechanism) -> tuple[Curve, ...]:
    """The requested centrodes and paths, over a turn or the whole range of the driver.

    If wheels differ after a turn, they cover as many turns as bring the wheels back.
    """
    ask = mechanism.scene.ask
    if not ask.centrodes and not ask.curves:
        return loci_of(mechanism)
    from graphkin.motion.cycle import cycle

    wanted = [target for target in mechanism.program.targets if target[0] == "position"]
    wanted += [t for link in ask.centrodes if mechanism.gives(t := ("centre", link))]
    whole = followed(cycle(mechanism, steps=STEPS, targets=wanted))
    curves = [curve for link in ask.centrodes for curve in centrodes_of(mechanism, whole, link)]
    for point in ask.curves:
        path = whole.solution.points[point].position
        curves.append(Curve("trajectory", point, runs_of(whole, path)))
    return (*loci_of(mechanism), *curves)


def loci_of(mechanism: Mechanism) -> tuple[Curve, ...]:
    """The loci that close each higher-class group, near the fit, where points define them.

    By hand, only a few positions are tried there. Branches that close in other ways would only
    clutter the drawing.
    """
    steps = mechanism.program.steps
    closing = [n for n, step in enumerate(steps) if step.closes]
    if not closing:
        return ()
    from graphkin.construction.higher_class.closed_group import ClosedGroup
    from graphkin.construction.higher_class.closure_solver import ClosureSolver

    trace = mechanism.trace([t for t in mechanism.program.targets if t[0] == "position"])
    curves: list[Curve] = []
    spots = (n for (what, _), n in mechanism.program.targets.items() if what == "position")
    places = [trace.values[number] for number in spots]
    far = NEAR * max(abs(p - q) for p in places for q in places)
    for number in closing:
        step = steps[number]
        assert step.action is not None and isinstance(step.action.value, ClosureSolver)
        closer = step.action.value
        round_ = closer.trying.first.turns and not closer.trying.several
        loci = closer.loci([trace.values[arg] for arg in step.args], trace.values[number])
        kind = construction(step)
        assert isinstance(kind, ClosedGroup)
        for point, locus in zip(kind.traced, loci, strict=True):
            fit = trace.value("position", point)
            curves.append(Curve("locus", point, piece(locus, fit, far, closed=round_)))
    return tuple(curves)


def piece(
    points: Any, fit: complex, far: float, *, closed: bool
) -> tuple[tuple[complex, ...], ...]:
    """The run of points through the fit, up to a given length on both sides.

    It ends where a point is NaN; a round that is ``closed`` goes on at its beginning. A locus so
    short that no place of it can be drawn gives none.
    """
    if np.isnan(points).all():
        return ()
    here = int(np.nanargmin(abs(points - fit)))
    if closed:
        places = np.arange(len(points) - 1) + here - len(points) // 2
        points = np.take(points[:-1], places, mode="wrap")
        here = int(np.nanargmin(abs(points - fit)))
    before, after = along(points[here::-1], far), along(points[here:], far)
    run = (*before[::-1], complex(points[here]), *after)
    return (run,) if len(run) > 1 else ()


def along(points: Any, far: float) -> list[complex]:
    """The points after the first, up to a given length along them, or until they turn back."""
    ways = np.diff(points)
    gone = np.cumsum(abs(ways))  # NaN from the first position that cannot be drawn
    short = np.append(0.0, gone[:-1]) < far
    back = (ways[1:] * ways[:-1].conjugate()).real < 0
    ahead = np.append(0, np.cumsum(back)) == 0
    return [complex(point) for point in points[1:][short & ahead & np.isfinite(gone)]]


def followed(whole: Cycle) -> Cycle:
    """The driver's whole circle, or the scene's range with finer steps at its ends.

    Near a dead point a mechanism moves far while its driver hardly moves.
    """
    if whole.path.whole:
        turns = max(whole.path.turns, 1)
        if turns * STEPS <= MOST_STEPS:
            return whole
        rows = turns * (MOST_STEPS // turns)
        return whole.along(np.linspace(0, whole.path.period, rows, endpoint=False))
    low, high = whole.ranges[0]
    angles = np.linspace(0, np.pi, STEPS + 1)[1:-1]
    return whole.along((low + high) / 2 - (high - low) / 2 * np.cos(angles))


def centrodes_of(mechanism: Mechanism, whole: Cycle, link: str) -> Iterator[Curve]:
    """The fixed and the moving centrode of a link, the moving one in its present position."""
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
    """A curve in runs, broken where a centre is far away and closed if the motion recurs."""
    ends = [p.position for p in whole.solution.points.values() if p.position is not None]
    breadth = max(float(np.ptp(part)) for p in ends for part in (np.real(p), np.imag(p))) or 1.0
    middle = np.mean([np.mean(p) for p in ends])
    closes = whole.path.whole and whole.path.returns
    points = np.append(once(path), path[:1]) if closes else np.asarray(path)
    near = np.abs(points - middle) <= AWAY * breadth
    runs = np.split(np.arange(len(points)), np.flatnonzero(np.diff(near)) + 1)
    return tuple(
        tuple(complex(points[i]) for i in run) for run in runs if len(run) > 1 and near[run[0]]
    )


def once(path: Any) -> Any:
    """A closed curve drawn once, even if the motion runs along it several times."""
    size = float(np.abs(path - np.mean(path)).max())
    for count in range(len(path) // 3, 1, -1):
        if len(path) % count == 0:
            rounds = path.reshape(count, -1)
            if np.abs(np.diff(rounds, axis=0, append=rounds[:1])).max() <= ALIKE * size:
                return rounds[0]
    return path
