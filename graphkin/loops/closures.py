"""Branch conditions verified: the side of a pin, the other closure of a slide, the closures of a
group of higher class.

The three joints of a dyad with a slide are two pins and the slide. As the dyad moves from one
closure to the other the pins keep their distance while the slide vector s·u changes in length
alone, so that with w the way from the pin on the guide's side to the pin on the block's side,
abs(w + x·u) = abs(w) has the roots x = 0 and x = -2 w·u.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphkin.loops.bodies import Complexes, Reals
from graphkin.loops.equations import Equations, equations
from graphkin.loops.groups import Group, Joint
from graphkin.loops.motion import Motion
from graphkin.loops.solve import CLOSED, in_bars, largest, newton
from graphkin.loops.start import start_values
from graphkin.scene.model import FRAME, Scene

STARTS = 256
"""Random starts from which all closures of a group are looked for."""
SAME = 1e-6
"""Distance, in bars or radians, below which two closures are one."""


def other_closure(loops: Equations, motion: Motion, dyad: Group) -> tuple[Reals, Reals]:
    """Slide coordinate (m) of a dyad with one slide as it stands, and in its other closure."""
    (slide,) = dyad.slides
    guide = loops.guides[slide.slide]
    heading = motion.heading[:, motion.index[guide.on]] * guide.along
    way = span(motion, dyad, slide, guide.block)
    stands = motion.slide(slide.slide).position
    return stands, stands - 2 * (way * heading.conj()).real


def span(motion: Motion, dyad: Group, slide: Joint, block: str) -> Complexes:
    """From the pin on the guide's side of the slide to the pin on the block's side."""
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
    """Sine-like measure of the side of a pin: positive to the left of the way first → second."""
    start, end, place = (motion.point(name).place for name in (first, second, pin))
    line, arm = end - start, place - start
    return np.asarray((line.conj() * arm).imag / (abs(line) * abs(arm)))


def closure_number(scene: Scene, motion: Motion, group: Group) -> int:
    """Which closure of a group stands, one scene: 1, 2, …; 0 when it is not among those found.

    The closures are ordered by the angle, from 0 to 360°, of the group's first-written link, ties
    by the next. They are looked for by Newton's method from many starts, with the links known
    before held in place and those that come after left out.
    """
    part = partial(scene, group)
    loops = equations(part, motion.loops.numbers.values)
    places = {name: motion.points.place[:, i] for name, i in motion.names.items()}
    slides = {
        guide.block: motion.slides[0, :, j]
        for j, guide in enumerate(motion.loops.guides)
        if guide.first
    }
    stands = start_values(loops, {n: places[n] for n in loops.points}, slides)
    moving = moved_by(loops, group)
    with np.errstate(all="ignore"):
        found, _, _ = newton(loops, scattered(loops, stands, moving))
        closed = largest(in_bars(loops, found)[0]) < CLOSED
        away = wrapped(loops, found - stands)
    held = np.abs(np.where(moving, 0, away)).max(axis=1) < SAME
    distinct: list[Reals] = []
    for row in found[closed & held]:
        gaps = [np.abs(wrapped(loops, (row - other)[None])).max() for other in distinct]
        if not gaps or min(gaps) >= SAME:
            distinct.append(row)
    links = [link for link in scene.links if link in group.links]
    distinct.sort(key=lambda row: [angle_of(loops, link, row) for link in links])
    for number, row in enumerate(distinct, 1):
        if np.abs(wrapped(loops, row[None] - stands)).max() < SAME:
            return number
    return 0


def partial(scene: Scene, group: Group) -> Scene:
    """The mechanism up to and with a group."""
    names = group.known | set(group.links)
    return replace(
        scene,
        links={name: link for name, link in scene.links.items() if name in names},
        drivers=tuple(driver for driver in scene.drivers if driver.link in names),
    )


def moved_by(loops: Equations, group: Group) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which unknowns belong to a group."""
    fixed = {loops.turned.of[link] for link in (FRAME, *group.known)}
    turnings = [k not in fixed for k in range(1, loops.turned.count)]
    slides = [not group.known >= {guide.block, guide.on} for guide in loops.guides]
    return np.array([*turnings, *slides], dtype=np.bool_)


def scattered(
    loops: Equations, stands: Reals, moving: np.ndarray[tuple[int], np.dtype[np.bool_]]
) -> Reals:
    """The position as it stands, and many with the group's unknowns thrown anywhere."""
    thrown = np.random.default_rng(1).uniform(-1, 1, (STARTS, stands.shape[1]))
    thrown[:, : loops.turning_count] *= np.pi
    thrown[:, loops.turning_count :] *= 2 * loops.size
    return np.concatenate([stands, np.where(moving, thrown, stands)])


def wrapped(loops: Equations, change: Reals) -> Reals:
    """A change of unknowns in radians and bars, angles within half a turn."""
    angles = np.angle(np.exp(1j * change[:, : loops.turning_count]))
    return np.concatenate([angles, change[:, loops.turning_count :] / loops.size], axis=1)


def angle_of(loops: Equations, link: str, unknowns: Reals) -> float:
    """Angle of a link's x axis, from 0 to 2π, rounded so that equal angles tie."""
    angles = np.concatenate([[0.0], unknowns])
    turned = np.angle(np.exp(1j * angles[loops.turned.of[link]]) * loops.turned.lean[link])
    return round(float(turned % (2 * np.pi)), 6) % round(2 * np.pi, 6)
