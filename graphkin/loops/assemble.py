"""A mechanism assembled from nothing: group after group, each in the closure that the scene states.

No position is given. Each group's closures are found from many starts with the links before it
held; sides, ways and numbers of closures leave one of them, or the scene says too little.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from graphkin.loops.branch_closures import (
    ON_LINE,
    closures,
    facing,
    places_of,
    scattered,
    turned_side,
)
from graphkin.loops.cam_laws import by_law
from graphkin.loops.closing_groups import Group, Mask, counted_in_order, speaks_of, stages
from graphkin.loops.equations import Equations, equations, part_of, undriven
from graphkin.loops.loop_motion import Motion, Pose, pose_of, setting_of, spot, unknowns_of
from graphkin.loops.newton import AT_REST, LoopSolution, closed_from, largest, newton, scaled
from graphkin.loops.newton_start import Start
from graphkin.loops.rigid_bodies import Reals
from graphkin.scene.model import FRAME, Closure, Scene, Side, Way
from graphkin.text.errors import GraphkinError, Problem, Sought, StructureError, WitnessError

TRIES = 64
"""Random starts from which some closed position is looked for."""


def assemble(scene: Scene, values: Mapping[str, Any] | None = None) -> LoopSolution:
    """The whole motion of a scene without a construction and without any position given.

    ``values`` may hold arrays of shape (N,): each setting is assembled for itself, NaN where it
    cannot be. Raises WitnessError where one scene does not close, StructureError where a group
    could close in several ways and the scene does not say which, or where drivers are missing.
    """
    scene = by_law(scene)
    loops = counted_in_order(equations(scene, values))
    return closed_from(loops, starting(scene, loops))


def starting(scene: Scene, loops: Equations) -> Reals:
    """The unknowns (N, K + m) of every setting, assembled from nothing."""
    if loops.numbers.single:
        return assembled(scene, loops)
    rows = np.full((loops.numbers.count, loops.unknown_count), np.nan)
    for n in range(loops.numbers.count):
        values = setting_of(loops, n)
        try:
            rows[n] = assembled(scene, part_of(loops, loops.links, values))[0]
        except GraphkinError:
            continue
    return rows


def completed_start(scene: Scene, loops: Equations, start: Start) -> Reals:
    """Start values with what no position told taken from the loops' own assembly.

    Left at zero where they cannot be assembled.
    """
    if start.told.all():
        return start.unknowns
    try:
        own = starting(scene, loops)
    except GraphkinError:
        return start.unknowns
    own = np.where(np.isfinite(own), own, start.unknowns)
    return np.where(start.told, start.unknowns, own)


def anywhere(loops: Equations) -> Reals:
    """Unknowns (positions, K + m) of closed positions of one scene, wherever its drivers stand.

    Raises WitnessError where none is found from many starts.
    """
    free = undriven(loops)
    everything = np.ones(free.unknown_count, dtype=np.bool_)
    with np.errstate(all="ignore"):
        zero = np.zeros((1, free.unknown_count))
        found, _ = newton(free, scattered(free, zero, everything, TRIES))
        gaps = largest(scaled(free, found)[0])
    if (gaps < AT_REST).any():
        return found[gaps < AT_REST]
    raise WitnessError(
        Problem(
            "loops",
            f"the loops do not close from any of {TRIES} starts",
            "lengths for which the mechanism can be assembled",
        )
    )


def assembled(scene: Scene, loops: Equations) -> Reals:
    """The unknowns (1, K + m) of one scene."""
    pose = Pose({FRAME: 0.0}, {})
    order = stages(scene, loops)
    refuse_undetermined(loops, order)
    for group in order:
        part = part_of(loops, group.known | set(group.links))
        found = closures(part, unknowns_of(part, pose), group)
        row = picked(scene, loops, part, group, found)
        pose = pose_of(part, row)
    return unknowns_of(loops, pose)


def refuse_undetermined(loops: Equations, order: list[Group]) -> None:
    """Every link must belong to a group."""
    placed = {link for group in order for link in group.links}
    left = [link for link in loops.links if link not in placed and link != FRAME]
    if left:
        raise StructureError(
            Problem(
                "drivers",
                f"nothing determines the motion of {words('link', left)}",
                "as many drivers as the mechanism has freedoms",
            )
        )


def picked(scene: Scene, loops: Equations, part: Equations, group: Group, found: Reals) -> Reals:
    """The closure (K + m,) that the scene states, of all those of a group.

    ``part`` are the equations up to and with the group, ``loops`` all of them.
    """
    if not len(found):
        raise WitnessError(
            Problem(
                words("link", group.links),
                "they do not close" if len(group.links) > 1 else "it does not close",
                "lengths and driver positions for which the mechanism can be assembled",
                about=(Sought(tuple(group.links)),),
            )
        )
    holds = np.ones(len(found), dtype=np.bool_)
    motion = places_of(part, found)
    for name, branch in scene.branches.items():
        if isinstance(branch, Way) and (ahead := facing(part, motion, name)) is not None:
            holds &= branch.way * ahead > 0
    facing_so = holds.copy()
    for name, branch in scene.branches.items():
        holds &= stated(name, branch, motion, group, found, loops, facing_so)
    fitting = np.flatnonzero(holds)
    if len(fitting) == 1:
        return np.asarray(found[fitting[0]])
    problem = Problem(
        "branches",
        f"{words('link', group.links)} close in {len(found)} ways, of which {len(fitting)} "
        f"{'fits' if len(fitting) == 1 else 'fit'} what is stated",
        suggestion(group, loops),
        "; ".join(described(part, group, found, motion)),
    )
    raise StructureError(problem) if len(fitting) else WitnessError(problem)


def stated(
    name: str,
    branch: Side | Way | Closure,
    motion: Motion,
    group: Group,
    found: Reals,
    loops: Equations,
    facing_so: Mask,
) -> Mask:
    """Which closures of a group fit one statement of the scene; all where it means another.

    Of those that have links which two pins guide the right way round (``facing_so``).
    """
    part = motion.loops
    everything = np.ones(len(found), dtype=np.bool_)
    if isinstance(branch, Side):
        mine = {point for link in group.links for point in part.bodies[link]}
        before = {point for link in group.known for point in part.bodies.get(link, ())}
        told = {branch.first, branch.second, name} <= set(motion.names)
        if name not in mine - before or not told:
            return everything
        side = turned_side(motion, branch.first, branch.second, name)
        return np.asarray(branch.side * side > -ON_LINE)
    if not speaks_of(name, branch, group, loops):
        return everything
    if isinstance(branch, Closure):
        return np.asarray(np.arange(1, len(found) + 1) == branch.number)
    j = led_by(name, group, loops, part)
    if j is None or not facing_so.any() or facing(part, motion, name) is not None:
        return everything
    slid = found[:, part.turning_count + j]
    end = slid[facing_so].max() if branch.way > 0 else slid[facing_so].min()
    return np.asarray(np.abs(slid - end) <= ON_LINE * part.size)


def led_by(link: str, group: Group, loops: Equations, part: Equations) -> int | None:
    """The guide of ``part`` whose coordinate tells forward from backward: that of the link, or of
    one that a pin of this name joins; or any."""
    inside = [loops.guides[joint.slide] for joint in group.slides]
    own = [
        g
        for g in inside
        if g.block == link or link in {**part.bodies[g.block], **part.bodies[g.on]}
    ]
    led = next((spot(guide) for guide in own or inside), None)
    return next((j for j, guide in enumerate(part.guides) if spot(guide) == led), None)


def suggestion(group: Group, loops: Equations) -> str:
    """Words in [branches] that would pick one closure."""
    first = next(link for link in loops.links if link in group.links)
    if group.slides and len(group.links) <= 2:
        block = loops.guides[group.slides[0].slide].block
        return f'{block} = "forward" or "backward"'
    if group.is_dyad:
        ends = sorted(group.outer, key=lambda joint: group.links[0] not in joint.links)
        left, right = (joint.pin for joint in ends)
        return f'{group.inner[0].pin} = "left of {left}-{right}" or "right of …"'
    return f'{first} = "closure 1", …'


def described(part: Equations, group: Group, found: Reals, motion: Motion) -> list[str]:
    """Each closure by the place of the pins that it moves (m)."""
    mine = {point for link in group.links for point in part.bodies[link]}
    before = {point for link in group.known for point in part.bodies.get(link, ())}
    pins = sorted(mine - before)[:3]
    lines = []
    for n in range(len(found)):
        spots = [motion.points.place[n, motion.names[pin]] for pin in pins]
        where = ", ".join(
            f"{pin} ({z.real:.4g}, {z.imag:.4g}) m" for pin, z in zip(pins, spots, strict=True)
        )
        lines.append(f"closure {n + 1}: {where}" if where else f"closure {n + 1}")
    return lines


def words(noun: str, names: list[str] | tuple[str, ...]) -> str:
    """One or several things by name."""
    return f"{noun}{'s' if len(names) > 1 else ''} {', '.join(names)}"
