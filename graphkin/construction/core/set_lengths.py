"""How vectors of the plans are set on the mechanism, where these are drawn at another scale."""

from __future__ import annotations

from fractions import Fraction
from math import isclose

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.relation import figure
from graphkin.text.markup import saying


def set_length(drawing: Drawing, vector: str) -> str:
    """A velocity as it is set on the mechanism: one m-th of its segment in the plan."""
    return divided(drawing, vector, drawing.scales.larger)


def twice_set(drawing: Drawing, segment: str) -> str:
    """Twice a segment of the plan as it is set on the mechanism: 2·ab, 2·ab/5, or ab itself."""
    if drawing.scales.larger == 2:
        return segment
    return set_length(drawing, saying(f"2·{segment}", segment))


def why_set(drawing: Drawing) -> str:
    """Why what is set on the mechanism is not as long as in the plan; nothing where it is."""
    m = drawing.scales.larger
    if m == 1:
        return ""
    if m > 1:
        return drawing.words("step.coriolis-shorter", m=figure(drawing, m))
    return drawing.words("step.coriolis-longer", m=inverse(drawing, m))


def laid_times(drawing: Drawing) -> str:
    """What stands before a length of the mechanism that is laid off m′ times in the plan."""
    times = drawing.scales.larger_still
    return "" if times == 1 else f"{figure(drawing, times)}·"


def divided(drawing: Drawing, what: str, times: float) -> str:
    """Markup of a length divided by a number, or multiplied where that is below one."""
    if times == 1:
        return what
    larger = f"{what}/{figure(drawing, times)}", f"{inverse(drawing, times)}·{what}"
    return saying(larger[times < 1], what)


def inverse(drawing: Drawing, times: float) -> str:
    """One by a number as it is told: 4/3 where the decimal of it does not end."""
    part = Fraction(1 / times).limit_denominator(9)
    if part.denominator % 3 == 0 and isclose(part, 1 / times, rel_tol=1e-9):
        return str(part)
    return figure(drawing, 1 / times)


def beside_plan(drawing: Drawing, kind: str) -> str:
    """How long vectors on the mechanism are beside a plan's; nothing where they are alike."""
    times = drawing.scales.times(kind)
    if times == 1:
        return ""
    if times > 1:
        return drawing.words("page.shorter", m=figure(drawing, times))
    return drawing.words("page.longer", m=inverse(drawing, times))
