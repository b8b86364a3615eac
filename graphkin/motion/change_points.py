"""The motion beyond a change point: it takes the closure that its velocity predicts.

Neither the nearest position nor the same side would be correct.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

import numpy as np
from msgspec.structs import replace

from graphkin.construction.core.program import Target
from graphkin.construction.core.quantities import KINDS
from graphkin.motion.course import Branches, Course
from graphkin.motion.ends import Event
from graphkin.scene.link_points import is_under
from graphkin.scene.model import Branch, Closure, Side
from graphkin.text.errors import GraphkinError

MOST_CLOSURES = 8
"""The most closures of a higher-class group that are tried beyond a change point."""
AHEAD = 0.25
"""Grid steps on each side of a change point between which the motion is predicted."""


def beyond(course: Course, event: Event, way: int) -> Course:
    """The course past a change point: the closures whose positions the velocity predicts.

    Each closure that depends on a touching step is tried both ways, a numbered one by its numbers.
    """
    step = AHEAD * abs(course.sweep.grid_step)
    before, after = event.at - way * step, event.at + way * step
    targets = followed(course)
    predicted = predict(course, before, after)
    best, least = course, np.inf
    for branches in choices(course, event):
        other = replace(course, branches=branches, here=after)
        try:
            found = other.columns(np.array([after]), targets)
        except GraphkinError:  # an idle link that does not fit this closure
            continue
        miss = max(abs(complex(found[t][0]) - predicted[t]) for t in targets)
        if miss < least:
            best, least = other, miss
    return best


def followed(course: Course) -> list[Target]:
    """The position targets of points of links.

    Contact points are left out: a moment later they are other points of the links, and they have no
    velocity of their own.
    """
    targets = course.program.targets
    own = [(what, of) for what, of in targets if what == "position" and not is_under(of)]
    return [(what, of) for what, of in own if ("velocity", of) in targets]


def predict(course: Course, before: float, after: float) -> Mapping[Target, complex]:
    """The predicted position of every point, from its position, velocity and acceleration by u."""
    way = (after - before) * course.sweep.per_unit
    targets = course.program.targets
    names = [of for _, of in followed(course)]
    wanted = [(what, of) for what in KINDS for of in names if (what, of) in targets]
    found = course.columns(np.array([before]), wanted, geometric=True)
    return {
        ("position", of): sum(
            complex(found[what, of][0]) * factor
            for what, factor in zip(KINDS, (1.0, way, way * way / 2), strict=True)
            if (what, of) in found
        )
        for of in names
    }


def choices(course: Course, event: Event) -> list[Branches]:
    """Every set of closures that differs only where loci touch at a change point."""
    touched = set(event.steps)
    options: dict[str, list[Branch]] = {}
    for name, branch in course.branches.items():
        others = others_of(branch)
        if not touched.isdisjoint(course.picks(name, others[0])):
            options[name] = [branch, *others]
    return [
        {**course.branches, **dict(zip(options, picked, strict=True))}
        for picked in product(*options.values())
    ]


def others_of(branch: Branch) -> list[Branch]:
    """The other closures of a group: the other side or way, or all other numbers."""
    if isinstance(branch, Side):
        return [replace(branch, side=-branch.side)]
    if isinstance(branch, Closure):
        numbers = range(1, MOST_CLOSURES + 1)
        return [Closure(number) for number in numbers if number != branch.number]
    return [replace(branch, way=-branch.way)]
