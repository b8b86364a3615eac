"""Whether what a scene states of its scale factors leaves a drawing that can be seen."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.drawing.scale import Scales, digits, preferred
from graphkin.text.errors import PageError, Problem

LEAST = 5.0
"""Length in mm below which a mechanism, or the longest vector of a plan, is no drawing."""


def refuse_dots(scales: Scales, trials: Sequence[Drawing], stated: Sequence[str]) -> None:
    """Raise PageError where a stated scale factor draws a mechanism or a plan as a mere dot.

    ``trials`` are the sheets at full size, ``stated`` the keys that the scene writes. A plan of
    which all is nought is no fault.
    """
    across = min(1000 * trial.reach / scales.kL for trial in trials)
    if across < LEAST and "scale" in stated:
        most = scales.kL * across / LEAST
        found = f"at 1:{digits(scales.kL)} the mechanism is drawn {across:.2g} mm across"
        raise dot("scale", found, f"a smaller scale, {digits(not_above(most))} or less")
    if across < LEAST and "enlarge" in stated:
        times = digits(scales.of_bar("velocity"))
        found = f"at {times} times the mechanism is drawn {across:.2g} mm across"
        raise dot("enlarge", found, "a smaller enlarge")
    for trial in trials:
        longest = 1000 * abs(trial.at_scale(trial.plane, trial.largest)) / scales.kL
        if longest >= LEAST or not trial.settled(trial.largest):
            continue
        found = f"the longest {trial.kind} is drawn {longest:.2g} mm long"
        if trial.kind == "acceleration" and "ka" in stated:
            ka = scales.ka / 1000
            most = not_above(ka * longest / LEAST)
            raise dot(
                "ka", f"at {digits(ka)} (m/s²)/mm {found}", f"a smaller ka, {digits(most)} or less"
            )
        own = scales.of_bar(trial.kind)
        if "enlarge" in stated and own < 1:
            raise dot("enlarge", f"at {digits(own)} times {found}", "a larger enlarge")


def dot(key: str, found: str, what: str) -> PageError:
    """What is wrong with a scale factor that is too coarse, and what to write."""
    hint = f"write {what}, or leave it out"
    return PageError(Problem(f"sheet.{key}", found, f"{LEAST:g} mm or more", hint))


def not_above(number: float) -> float:
    """The largest preferred number 1, 2, 5 times a power of ten that is not above another."""
    return 1 / next(preferred(1 / number))
