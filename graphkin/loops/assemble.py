"""Assembly of a mechanism without given positions.

Group after group takes the closure that the scene states. For each group, Newton's method searches
for all closures from many starts, with the links before the group held fixed. The sides, ways and
closure numbers in the scene select one of them; if they do not, the scene is refused as ambiguous.

True mobility: the freedom that the constraints leave at a position, independent of any count.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np
from msgspec.structs import replace

from graphkin.loops.cam_laws import by_law
from graphkin.loops.closing_groups import (
    Group,
    Joint,
    Mask,
    counted_in_order,
    moved_by,
    speaks_of,
    stages,
)
from graphkin.loops.equations import Equations, equations, part_of, undriven
from graphkin.loops.loop_motion import (
    Motion,
    Pose,
    PositionBounds,
    pose_of,
    setting_of,
    spot,
    unknowns_of,
)
from graphkin.loops.newton import (
    AT_REST,
    CLOSED,
    LoopSolution,
    Start,
    as_meant,
    closed_from,
    counted_freely,
    largest,
    moving_step,
    newton,
    scaled,
    settle,
    start_values,
)
from graphkin.loops.rigid_bodies import Complexes, Guide, Reals
from graphkin.numbers.arithmetic import Point
from graphkin.scene.model import FRAME, Closure, Scene, Side, Way
from graphkin.text.errors import (
    GraphkinError,
    Message,
    Problem,
    Sought,
    StructureError,
    WitnessError,
    joined,
    message,
    verbatim,
)

STARTS = {1: 12, 2: 48}
"""Random starts in the search for closures, by the number of links in the group."""
MOST_STARTS = 256
"""Random starts of one round for larger groups."""
A_TURN, MOST_IN_ALL = 24, 8192
"""Starts for each turn that a wheel can make on its track, and the most starts in all.

Each turn has its own closures.
"""
ROUNDS, ENOUGH = 10, 2
"""The most rounds, and how many in a row without a new closure end the search."""
SHORT = 14
"""Iterations after which most starts that close at all have closed."""
LAST, NEARBY = 40, 1e-3
"""The most steps from nearly closed loops to closed ones, and the longest of these steps."""
SAME = 1e-6
"""Distance (radians, or sizes of slides) below which rounding may make two closures one."""
LEVEL, EITHER = 1e-9, 8
"""The least such distance, and how many error bounds may lie between two ways to one closure."""
ON_LINE = 1e-9
"""Sine below which a pin counts as on the line through two others, and so on either side."""


def other_closure(loops: Equations, motion: Motion, dyad: Group) -> tuple[Reals, Reals]:
    """The slide coordinate (m) of a dyad with one slide, now and in its other closure."""
    (slide,) = dyad.slides
    guide = loops.guides[slide.slide]
    heading = motion.heading[:, motion.index[guide.on]] * guide.along
    way = span(motion, dyad, slide, guide.block)
    current = motion.slide(slide.slide).position
    return current, current - 2 * (way * heading.conj()).real


def span(motion: Motion, dyad: Group, slide: Joint, block: str) -> Complexes:
    """The vector from the pin on the guide's side of the slide to the pin on the block's side."""
    (inner,) = dyad.inner
    left, right = sorted(dyad.outer, key=lambda joint: dyad.links[0] not in joint.links)
    if slide is inner:
        near, far = (left, right) if dyad.links[0] == block else (right, left)
    else:
        holder = dyad.links[0] if slide is left else dyad.links[1]
        swinging = right if slide is left else left
        near, far = (inner, swinging) if holder == block else (swinging, inner)
    return motion.point(near.pin).place - motion.point(far.pin).place


def turned_side(motion: Motion, first: str, second: str, pin: str) -> Reals:
    """The sine that gives the side of a pin: positive to the left of the line first → second."""
    start, end, place = (motion.place(name) for name in (first, second, pin))
    line, arm = end - start, place - start
    return np.asarray((line.conj() * arm).imag / (abs(line) * abs(arm)))


def led_both(loops: Equations, name: str) -> tuple[str, Guide, str, str] | None:
    """The link guided by two pins whose direction a scene states under ``name``.

    Returns that link, the guide of the block written first, and the pins of both blocks. None where
    no two blocks with different pins slide along the link in one direction. The name of a block
    means the link only if that block is one of the two.
    """
    guides = [guide for guide in loops.guides if guide.turns_alike]
    rails = [guide.on for guide in guides if guide.block == name]
    rail = rails[0] if rails else name
    slides = [g for g in guides if rail in (g.block, g.on) and other_of(g, rail) != FRAME]
    slides.sort(key=lambda g: loops.links.index(other_of(g, rail)))
    for one, other in combinations(slides, 2):
        if bool(rails) != (rail in (one.block, other.block)):
            continue
        if np.all(abs(np.imag(np.conj(way_on(one, rail)) * way_on(other, rail))) < LEVEL):
            pins = [pin_of(loops, other_of(g, rail), rail) for g in (one, other)]
            if None not in pins and pins[0] != pins[1]:
                return rail, one, str(pins[0]), str(pins[1])
    return None


def other_of(guide: Guide, link: str) -> str:
    return guide.on if guide.block == link else guide.block


def way_on(guide: Guide, link: str) -> Complexes:
    """The direction of a guide in the axes of one of its two links."""
    return np.asarray(guide.along if guide.on == link else 1 + 0j)


def pin_of(loops: Equations, block: str, rail: str) -> str | None:
    """The first point that a block shares with a link other than the one it slides along."""
    others = [body for name, body in loops.bodies.items() if name not in (block, rail)]
    return next((p for p in loops.bodies[block] if any(p in body for body in others)), None)


def facing(loops: Equations, motion: Motion, name: str) -> Reals | None:
    """How far (m) the pin of the later block is ahead of the other, along the link they guide.

    None where ``name`` belongs to no link guided by two pins.
    """
    found = led_both(loops, name)
    if found is None:
        return None
    rail, guide, start, end = found
    heading = motion.heading[:, motion.index[rail]] * way_on(guide, rail)
    way = motion.point(end).place - motion.point(start).place
    return np.asarray((way * heading.conj()).real)


def facing_alike(part: Equations, current: Reals, rows: Reals, group: Group) -> Mask:
    """The closures of a group in which links guided by two pins face as they do in ``current``."""
    alike = np.ones(len(rows), dtype=np.bool_)
    now, others = places_of(part, current), places_of(part, rows)
    for link in group.links:
        ahead, every = (facing(part, motion, link) for motion in (now, others))
        if ahead is not None and every is not None:
            alike &= ahead * every > 0
    return alike


def places_of(part: Equations, found: Reals) -> Motion:
    """The positions of points in each closure, at rest."""
    many = replace(part, home=np.repeat(part.home, len(found)))
    still = np.zeros_like(found)
    return Motion.of(many, found, still, still)


def closure_numbers(loops: Equations, group: Group, row: Reals, setting: int) -> range:
    """The number that a group's closure with the unknowns ``row`` (K + m,) may have.

    The range holds one number, counted from 1, unless rounding hides whether earlier closures are
    one, two or none. It is empty where no closure matches. Links known before the group are held
    fixed; later links are left out.
    """
    values = setting_of(loops, setting)
    part = part_of(loops, group.known | set(group.links), values)
    current, moving = unknowns_of(part, pose_of(loops, row, setting)), moved_by(part, group)
    every = closures(part, current, group)
    if not len(every):
        return range(0)
    settle(part, current, np.ones_like(moving), ~moving, moving)
    away = np.abs(wrapped(part, every - current)).max(axis=1)
    nearest = int(np.argmin(away))
    if not away[nearest] < SAME:
        return range(0)
    hidden = int(
        (~PositionBounds.of(part, every[: nearest + 1]).regular[:, moving]).any(axis=1).sum()
    )
    return range(nearest + 1 - hidden, nearest + 2 + hidden)


def closures(part: Equations, current: Reals, group: Group) -> Reals:
    """All closures of a group in one scene: (closures, K + m), in order.

    Newton's method searches from many starts with everything but the group held as in ``current``
    (1, K + m). The order is by the angle, from 0 to 360°, of the link written first; the next link
    breaks ties. Wheels that only follow come last. Where wheels count turns, an angle that only
    pins determine is counted within half a turn of its start.
    """
    moving = moved_by(part, group)
    size, turned = len(group.links), turns_of_wheels(part, moving)
    starts = max(STARTS.get(size, MOST_STARTS), min(int(A_TURN * turned), MOST_IN_ALL))
    distinct: list[Reals] = []
    idle = 0
    for number in range(ROUNDS if size > 2 or turned else 1):
        thrown = scattered(part, current, moving, starts, number)
        before = len(distinct)
        rows = closed_of(part, thrown, moving)
        slack = slack_of(part, rows)
        new = np.ones(len(rows), dtype=np.bool_)
        for other in distinct:
            new &= apart(part, rows, other, slack)
        while new.any():
            n = int(np.argmax(new))
            distinct.append(rows[n])
            new &= apart(part, rows, rows[n], slack)
        idle = idle + 1 if len(distinct) == before else 0
        if idle == ENOUGH or (number + 1 >= ENOUGH and not distinct):
            break
    links = [link for link in part.links if link in group.links]
    links.sort(key=group.only_follows)
    distinct.sort(key=lambda row: [angle_of(part, link, row) for link in links])
    return np.array(distinct).reshape(-1, part.unknown_count)


def slack_of(part: Equations, rows: Reals) -> Reals:
    """The largest distance between two ends of the search that are one closure, in sizes: (N,)."""
    with np.errstate(all="ignore"):
        off = largest(PositionBounds.of(part, rows).off / part.columns)
    return np.asarray(np.clip(EITHER * off, LEVEL, SAME))


def apart(part: Equations, rows: Reals, other: Reals, slack: Reals) -> Mask:
    """Where a closed position differs from another one: (N,)."""
    return np.asarray(largest(wrapped(part, rows - other)) > slack)


def closed_of(part: Equations, thrown: Reals, moving: Mask) -> Reals:
    """The closed positions that Newton's method reaches; only slow starts take all iterations.

    Near a dead point the loops nearly close long before they close. A position therefore counts as
    closed only when the steps have shrunk to rounding.
    """
    with np.errstate(all="ignore"):
        found, _ = newton(part, thrown, moving, SHORT)
        near = largest(scaled(part, found)[0]) < CLOSED
        late, _ = newton(part, found[~near], moving)
        found = np.concatenate([found[near], late])
        found = found[largest(scaled(part, found)[0]) < CLOSED]
        found = counted_freely(part, settled_of(part, found, moving), moving)
        return found[as_meant(part, found, moving)]


def settled_of(part: Equations, found: Reals, moving: Mask) -> Reals:
    """Nearly closed positions, iterated until the steps are rounding; others are dropped."""
    slack = slack_of(part, found)
    for _ in range(LAST):
        residual, jacobian = scaled(part, found)
        step = np.zeros_like(found)
        step[:, moving] = moving_step(residual, jacobian, moving)
        moves = EITHER * largest(step) > slack
        if not moves.any():
            break
        shortened = step * np.minimum(1, NEARBY / np.maximum(largest(step), NEARBY))[:, None]
        found = np.where(moves[:, None], found - shortened * part.columns, found)
        slack[moves] = slack_of(part, found[moves])
    return found[~moves] if len(found) else found


def scattered(loops: Equations, current: Reals, moving: Mask, count: int, seed: int = 0) -> Reals:
    """The given position, and ``count`` more with the group's unknowns at random values.

    All of them satisfy the linear equations, which the steps of Newton's method preserve.
    """
    thrown = np.random.default_rng(seed).uniform(-1, 1, (count, current.shape[1]))
    thrown[:, : loops.turning_count] *= np.pi
    for k, start in loops.slips.counted.items():
        thrown[:, k - 1] += start
    thrown[:, loops.turning_count :] *= 2 * reach(loops)
    thrown = np.concatenate([current, np.where(moving, thrown, current)])
    settle(loops, thrown, np.ones_like(moving), ~moving, moving)
    return led(loops, thrown, moving)


def tracks(loops: Equations, moving: Mask) -> list[int]:
    """The numbers of the straight tracks along which a group's wheels move."""
    guides = zip(loops.guides, moving[loops.turning_count :], strict=True)
    return [j for j, (guide, moves) in enumerate(guides) if moves and not guide.turns_alike]


def turns_of_wheels(loops: Equations, moving: Mask) -> float:
    """The most turns that the smallest wheel of a group can make within reach."""
    radii = [abs(float(loops.guides[j].offset)) for j in tracks(loops, moving)]
    return 4 * reach(loops) / (2 * np.pi * min(radii)) if radii else 0.0


def led(loops: Equations, unknowns: Reals, moving: Mask) -> Reals:
    """The unknowns moved least, by least squares, to satisfy the linear equations."""
    scale = np.where(moving, loops.columns[0], 0.0)
    step = np.linalg.pinv(loops.linear_rows[0] * scale) @ loops.linear(unknowns).T
    return np.asarray(unknowns - step.T * scale)


def reach(loops: Equations) -> float:
    """A rough bound (m) on the distance of a block from the zero of its guide."""
    far = [abs(complex(guide.through)) + abs(float(guide.offset)) for guide in loops.guides]
    driven = np.where(loops.drives.turns, 0, np.abs(loops.drives.aim))
    ends = np.abs(loops.owners[1]).max(initial=0)
    return float(max([*far, driven.max(initial=0), ends, loops.size[0]]))


def wrapped(loops: Equations, change: Reals) -> Reals:
    """A change of unknowns in their sizes; angles that no wheel counts are within half a turn."""
    turns = change[:, : loops.turning_count]
    angles = np.angle(np.exp(1j * turns))
    for k in loops.slips.counted:
        angles[:, k - 1] = turns[:, k - 1]
    return np.concatenate([angles, change[:, loops.turning_count :]], axis=1) / loops.columns


def angle_of(loops: Equations, link: str, unknowns: Reals) -> float:
    """The angle of a link's x axis, from 0 to 2π, rounded so that equal angles tie."""
    angles = np.concatenate([[0.0], unknowns])
    turned = np.angle(np.exp(1j * angles[loops.turned.of[link]]) * loops.turned.lean[link])
    return round(float(turned % (2 * np.pi)), 6) % round(2 * np.pi, 6)


# --- assembly without given positions -------------------------------------------------------------


TRIES = 64
"""Random starts in the search for any closed position."""


def assemble(scene: Scene, values: Mapping[str, Any] | None = None) -> LoopSolution:
    """The motion of a scene that has no construction and no given position.

    ``values`` may hold arrays of shape (N,). Each setting is assembled separately and is NaN where
    it cannot be assembled. Raises WitnessError where a single scene does not close. Raises
    StructureError where drivers are missing, or where several closures of a group fit the scene.
    """
    scene = by_law(scene)
    loops = counted_in_order(equations(scene, values))
    return closed_from(loops, starting(scene, loops))


def starting(scene: Scene, loops: Equations) -> Reals:
    """The unknowns (N, K + m) of every setting, assembled without given positions."""
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
    """Start values in which the loops' own assembly fills what no position determines.

    These unknowns stay zero where the loops cannot be assembled.
    """
    if start.determined.all():
        return start.unknowns
    try:
        own = starting(scene, loops)
    except GraphkinError:
        return start.unknowns
    own = np.where(np.isfinite(own), own, start.unknowns)
    return np.where(start.determined, start.unknowns, own)


def anywhere(loops: Equations) -> Reals:
    """Unknowns (positions, K + m) of closed positions of one scene, for any driver positions.

    Raises WitnessError where no start leads to a closed position.
    """
    free = undriven(loops)
    everything = np.ones(free.unknown_count, dtype=np.bool_)
    with np.errstate(all="ignore"):
        zero = np.zeros((1, free.unknown_count))
        found, _ = newton(free, scattered(free, zero, everything, TRIES))
        gaps = largest(scaled(free, found)[0])
    if (gaps < AT_REST).any():
        return found[gaps < AT_REST]
    raise WitnessError.at(
        "loops",
        message("the loops do not close from any of {tries} starts", tries=TRIES),
        message("lengths for which the mechanism can be assembled"),
    )


def assembled(scene: Scene, loops: Equations) -> Reals:
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
    """Raise StructureError if a link belongs to no group."""
    placed = {link for group in order for link in group.links}
    left = [link for link in loops.links if link not in placed and link != FRAME]
    if left:
        raise StructureError.at(
            "drivers",
            message("nothing determines the motion of {left}", left=links_words(left)),
            message("as many drivers as the mechanism has freedoms"),
        )


def picked(scene: Scene, loops: Equations, part: Equations, group: Group, found: Reals) -> Reals:
    """The one closure (K + m,) of a group that the scene states.

    ``part`` holds the equations up to and including the group, ``loops`` all equations. Raises
    WitnessError if no closure fits the statements, StructureError if several do.
    """
    if not len(found):
        raise WitnessError.at(
            links_words(group.links),
            message("they do not close") if len(group.links) > 1 else message("it does not close"),
            message("lengths and driver positions for which the mechanism can be assembled"),
            about=(Sought(tuple(group.links)),),
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
        message(
            "{links} close in {count} ways, of which 1 fits what is stated"
            if len(fitting) == 1
            else "{links} close in {count} ways, of which {fitting} fit what is stated",
            links=links_words(group.links),
            count=len(found),
            fitting=len(fitting),
        ),
        suggestion(group, loops),
        joined("; ", described(part, group, found, motion)),
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
    """The closures of a group that fit one branch statement; all if it is about another group.

    ``facing_so`` marks the closures whose links guided by two pins face the stated way. Only these
    compete for the largest or smallest slide coordinate.
    """
    part = motion.loops
    everything = np.ones(len(found), dtype=np.bool_)
    if isinstance(branch, Side):
        mine = {point for link in group.links for point in part.bodies[link]}
        before = {point for link in group.known for point in part.bodies.get(link, ())}
        placed = {branch.first, branch.second, name} <= set(motion.names)
        if name not in mine - before or not placed:
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
    """The guide of ``part`` whose coordinate separates "forward" from "backward", as its number.

    A guide of ``link``, or of links that a pin of this name joins, comes before any other of the
    group.
    """
    inside = [loops.guides[joint.slide] for joint in group.slides]
    own = [
        g
        for g in inside
        if g.block == link or link in {**part.bodies[g.block], **part.bodies[g.on]}
    ]
    led = next((spot(guide) for guide in own or inside), None)
    return next((j for j, guide in enumerate(part.guides) if spot(guide) == led), None)


def suggestion(group: Group, loops: Equations) -> Message:
    """A statement for [branches] that would select one closure."""
    first = next(link for link in loops.links if link in group.links)
    if group.slides and len(group.links) <= 2:
        block = loops.guides[group.slides[0].slide].block
        return message('{block} = "forward" or "backward"', block=block)
    if group.is_dyad:
        ends = sorted(group.outer, key=lambda joint: group.links[0] not in joint.links)
        left, right = (joint.pin for joint in ends)
        return message(
            '{pin} = "left of {left}-{right}" or "right of …"',
            pin=group.inner[0].pin,
            left=left,
            right=right,
        )
    return verbatim(f'{first} = "closure 1", …')


def described(part: Equations, group: Group, found: Reals, motion: Motion) -> list[Message]:
    """A line for each closure with the positions (m) of the pins that the group places."""
    mine = {point for link in group.links for point in part.bodies[link]}
    before = {point for link in group.known for point in part.bodies.get(link, ())}
    pins = sorted(mine - before)[:3]
    lines = []
    for n in range(len(found)):
        spots = [motion.points.place[n, motion.names[pin]] for pin in pins]
        where = ", ".join(
            f"{pin} ({z.real:.4g}, {z.imag:.4g}) m" for pin, z in zip(pins, spots, strict=True)
        )
        lines.append(
            message(
                "closure {number}: {places}" if where else "closure {number}",
                number=n + 1,
                places=where,
            )
        )
    return lines


def links_words(names: Sequence[str]) -> Message:
    if len(names) == 1:
        return message("link {name}", name=names[0])
    return message("links {names}", names=", ".join(names))


SHARE = 1e-8
"""Share of the largest singular value below which a direction is unconstrained."""


FIRM = 1e-4
"""Share of the largest singular value below which a direction may be rounding at a dead point."""


def true_mobility(scene: Scene, positions: Mapping[str, Point] | None = None) -> int:
    """Unknowns of the loop equations less the rank of their Jacobian without the drivers.

    ``positions`` (m) must close the mechanism; the loops assemble what they leave open. Without
    positions, closed positions are searched for, independent of the drivers, and the smallest
    mobility counts. At a change point or another singular position the velocities have more freedom
    than the motion, and so has this number. Raises StructureError as ``equations`` does,
    WitnessError where nothing closes.
    """
    loops = equations(scene)
    unknowns = position_of(scene, loops, positions)
    return loops.unknown_count - rank(undriven_rows(loops, unknowns)[0]) - len(scene.cams)


def undriven_rows(loops: Equations, unknowns: Reals) -> Reals:
    """Jacobian of the loop equations without the drivers, in bars, at positions (M, K + m)."""
    jacobian = loops.jacobian(loops.chains.at(unknowns), driven=False)
    return np.asarray(jacobian * loops.columns[:, None, :] / loops.size[:, None, None])


def firmness(rows: Reals) -> tuple[int, float]:
    """The rank, and the smallest singular value counted in it as a share of the largest."""
    values = np.linalg.svd(rows, compute_uv=False)
    count = rank(rows)
    return count, float(values[count - 1] / values[0]) if count else 0.0


def rank(rows: Reals) -> int:
    """The number of directions that the rows constrain."""
    values = np.linalg.svd(rows, compute_uv=False)
    return int(np.count_nonzero(values > SHARE * values.max(initial=0)))


def position_of(scene: Scene, loops: Equations, positions: Mapping[str, Point] | None) -> Reals:
    """The unknowns (1, K + m) at given positions, or at the least mobile of some closed positions.

    Of several such positions, the one farthest from a singular position is taken.
    """
    if positions is None:
        found = anywhere(loops)
        firm = [firmness(rows) for rows in undriven_rows(loops, found)]
        order = [(share > FIRM, count, share) for count, share in firm]
        best = max(range(len(found)), key=order.__getitem__)
        return found[best : best + 1]
    return completed_start(scene, loops, start_values(loops, positions, {}))
