"""Scenes as they are shipped, asked for something else; and what is really run for them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import pytest
from msgspec.structs import replace

from graphkin import load
from graphkin.construction.core import run
from graphkin.construction.core.pen import is_input
from graphkin.construction.core.program import Step
from graphkin.mechanism import Mechanism
from graphkin.scene.model import FRAME, Ask, Scene

ROOT = Path(__file__).resolve().parents[2]
FILES = {path.stem: path for path in sorted((ROOT / "examples" / "scenes").glob("*.toml"))} | {
    path.parent.name: path for path in sorted((ROOT / "sheets").glob("*/scene.toml"))
}


@cache
def shipped(name: str) -> Mechanism:
    """A scene by the name of its file."""
    return load(FILES[name])


def untouched(mechanism: Mechanism) -> Mechanism:
    """The same, of which nothing has been run: what is kept of it is not run again."""
    return Mechanism(mechanism.scene)


@cache
def asking(name: str, ask: Ask) -> Mechanism:
    """The same scene, asked for something else."""
    return Mechanism(replace(shipped(name).scene, ask=ask))


def points(scene: Scene) -> tuple[str, ...]:
    """The points of the links, not those of the frame."""
    every = dict.fromkeys(p for link in scene.links.values() for p in link.points)
    return tuple(point for point in every if point not in scene.frame.points)


def links(name: str, quantity: str) -> tuple[str, ...]:
    """The links of which a quantity can be constructed."""
    return tuple(of for what, of in shipped(name).program.targets if what == quantity)


def velocities(name: str) -> Mechanism:
    """A scene asked for all velocities, and no more."""
    return asking(name, Ask(velocity=points(shipped(name).scene), omega=links(name, "omega")))


def accelerations(name: str) -> Mechanism:
    """A scene asked for all accelerations, and no more."""
    scene = shipped(name).scene
    return asking(name, Ask(acceleration=points(scene), epsilon=links(name, "epsilon")))


def steps(mechanism: Mechanism) -> list[Step]:
    """The steps that what is asked needs."""
    program = mechanism.program
    return [program.steps[number] for number in program.needed(mechanism.asked())]


def keys(mechanism: Mechanism) -> set[str]:
    """The actions among them."""
    return {step.action.key for step in steps(mechanism) if step.action is not None}


def turning_guides(scene: Scene) -> bool:
    """Whether some guide is on a link that turns, as the independent route finds it."""
    solution = shipped(scene.name).solve()
    on = {slide.on for link in scene.links.values() for slide in link.slides} - {FRAME}
    return any(solution.links[name].omega for name in on if name in solution.links)


@contextmanager
def counted(patch: pytest.MonkeyPatch) -> Iterator[list[Step]]:
    """Every step that is run on a scene or on arrays, in the order in which it is.

    The trials inside the one step that closes a group of higher class are not among them.
    """
    ran: list[Step] = []
    alone, together = run.evaluate, run.made_ready

    def evaluated(step, *args, **options):
        ran.append(step)
        return alone(step, *args, **options)

    def readied(program, needed, *args, **options):
        found = [program.steps[number] for number in needed]
        ran.extend(found if not any(map(is_input, found)) else ())
        return together(program, needed, *args, **options)

    with patch.context() as within:
        within.setattr(run, "evaluate", evaluated)
        within.setattr(run, "made_ready", readied)
        yield ran
