"""The images of links in a plan: the line or the triangle on which similarity finds a point."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any

from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.plan_marks import put_point
from graphkin.construction.core.plot import Plot
from graphkin.construction.core.program import Step
from graphkin.construction.higher_class.trial_marks import NEAR, put_trial
from graphkin.construction.step_sentences import in_line
from graphkin.drawing.marks import LineMark


def put_similar(plot: Plot, number: int, step: Step, value: Any) -> None:
    """A point of a link's image, with the sides of the image that nothing else draws."""
    values = plot.drawing.trace.values
    tried = number in plot.drawing.tags
    cls = "trial" if tried else "construction"
    for one, other in undrawn_sides(plot.drawing, number, step):
        if abs(values[other] - values[one]) * plot.field.mm > NEAR:
            ends = plot.field(values[one]), plot.field(values[other])
            plot.board.marks.append(LineMark(*ends[0], *ends[1], cls, step.name, number))
    put = put_trial if tried else put_point
    put(plot, number, step, value)


def undrawn_sides(drawing: Drawing, number: int, step: Step) -> Iterator[tuple[int, int]]:
    """The sides of the image, by the numbers of their ends, along which no arrow of the plan lies.

    None where the hand finds the point by crossing two lines. Three points in line have one side,
    or, where an arrow lies along a part of it, those from each to the next.
    """
    if step.by_hand in drawing.trace.values:
        return
    corners = [*step.args[:2], number]
    sides = [*combinations(corners, 2)]
    bare = [side for side in sides if not is_joined(drawing, *side)]
    if in_line(drawing, step):
        share = drawing.trace.values[step.args[2]].real
        along = dict(zip(corners, (0.0, 1.0, share), strict=True))
        whole = max(sides, key=lambda side: abs(along[side[1]] - along[side[0]]))
        if whole not in bare:
            return
        bare = [whole] if bare == sides else [side for side in bare if side != whole]
    yield from bare


def is_joined(drawing: Drawing, one: int, other: int) -> bool:
    """Whether a plan draws an arrow between two of its points, or points at the same places."""
    values, near = drawing.trace.values, NOISE * drawing.largest
    for (tail, tip), step in drawing.joins.items():
        if drawing.number_of(step) in values and (
            {tail, tip} == {one, other}
            or is_same(values, (tail, tip), (one, other), near)
            or is_same(values, (tip, tail), (one, other), near)
        ):
            return True
    return False


def is_same(
    values: Mapping[int, Any], ends: tuple[int, int], side: tuple[int, int], near: float
) -> bool:
    """Whether two points of a plan lie where two others do, and stand by then."""
    pairs = zip(ends, side, strict=True)
    return max(ends) <= max(side) and all(abs(values[a] - values[b]) <= near for a, b in pairs)
