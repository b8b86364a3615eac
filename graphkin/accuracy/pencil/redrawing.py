"""Many drawings at once: the hand's way of every step, each mark with its own errors."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from graphkin.accuracy.pencil.drawn_closing import followed
from graphkin.accuracy.pencil.original import Original
from graphkin.accuracy.pencil.pencil import Pencil
from graphkin.accuracy.pencil.pencil_marks import PencilMark, marked
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.construction.velocity.turning_of_link import TurningOfLink
from graphkin.numbers.plane import cross

Errors = Callable[[int, PencilMark], Any]
"""The errors of a step's mark: a row for each drawing, in standard deviations."""


def redrawn(original: Original, pencil: Pencil, errors: Errors) -> dict[int, Any]:
    """Every value of the drawing as the pencil leaves it, arrays with an element for each drawing.

    What no error reaches stays the one exact value; what cannot be drawn is NaN.
    """
    import numpy as np

    found = dict(original.trace.values)
    with np.errstate(all="ignore"):
        for number in original.order:
            mark = original.marks.get(number)
            row = None if mark is None else errors(number, mark)
            found[number] = step_drawn(original, number, found, row, pencil)
    return found


def step_drawn(
    original: Original, number: int, found: Mapping[int, Any], errors: Any, pencil: Pencil
) -> Any:
    """The value of one step from the values before it, with the errors of its mark."""
    step, mark = original.program.steps[number], original.marks.get(number)
    mm = original.paper.millimetre(step.plane)
    if mark is PencilMark.CLOSING:
        return closed(original, number, found, pencil.mark * mm * errors[:, 0])
    value = unmarked(original, number, found)
    if mark is None:
        return value
    start = found[step.args[0]] if mark is PencilMark.ARROW else value
    return marked(mark, value, start, errors, pencil, mm)


def unmarked(original: Original, number: int, found: Mapping[int, Any]) -> Any:
    """The value of a step from the values before it: given, by hand, read off, or as it follows."""
    step, hand = original.program.steps[number], original.by_hand(number)
    if hand is not None:
        return found[hand]
    if step.given is not None:
        return original.trace.values[number]
    assert step.action is not None
    if isinstance(step.of, TurningOfLink):
        return read_off(original, number, found)
    return step.action.value(*(found[arg] for arg in step.args), *step.extra)


def read_off(original: Original, number: int, found: Mapping[int, Any]) -> Any:
    """A rate as a hand reads it: a length of the plan over the length of the bar, which is known.

    Of an acceleration it reads the tangential component where that is drawn.
    """
    step = original.program.steps[number]
    p, q, start, tip = step.args
    exact = original.trace.values
    bar = found[q] - found[p]
    tail = original.tails.get(number, start)
    return cross(bar, found[tip] - found[tail]) / (abs(bar) * abs(exact[q] - exact[p]))


def closed(original: Original, number: int, found: Mapping[int, Any], shift: Any) -> Any:
    """What closes a group of higher class in each drawing."""
    step = original.program.steps[number]
    known = [found[arg] for arg in step.args]
    exact = original.trace.values[number]
    closer = closer_of(step)
    assert closer is not None
    return followed(closer, exact, known, shift)
