"""Why a point of a plan falls on the one before it: the rate that would lead away is nought."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import driver_index
from graphkin.construction.core.naming import WELL_KNOWN, rate_symbol
from graphkin.construction.core.program import Step
from graphkin.scene.model import Driver

LETTERS = {"omega": "ω", "v": "v", "epsilon": "ε", "a": "a"}
"""The letters of the given rates of drivers by their names."""
SPEEDS = {"epsilon": "ω", "a": "v"}
"""The letter of the speed of which each acceleration is the rate."""


def falls_key(drawing: Drawing, step: Step) -> str:
    """The key of the sentence of a point that falls on another, with the reason if one is told."""
    if drawing.number_of(step) in drawing.tags or step.action is None:
        return "falls"
    if step.action.key == "driven-slide":
        driver = driver_of(drawing, step)
        if driver is None:
            return "falls"
        return "falls-constant" if is_constant(drawing, step, driver) else "falls-nought"
    return "falls-nought" if step.action.key in ("turned-velocity", "centripetal") else "falls"


def rate_at_rest(drawing: Drawing, step: Step) -> str:
    """The symbol of the speed that is constant, or of the rate that is nought."""
    if step.action is None or step.action.key != "driven-slide":
        return rate_symbol(drawing, step.args[-1])
    driver, name = driver_of(drawing, step), drawing.trace.program.steps[step.args[-1]].name
    if driver is None:
        return ""
    letters = SPEEDS if is_constant(drawing, step, driver) else LETTERS
    return f"*{letters[name]}*_{{{driver_index(driver)}}}"


def driver_of(drawing: Drawing, step: Step) -> Driver | None:
    """The driver whose given rate a step lays off; None for a rate that is found."""
    rate = drawing.trace.program.steps[step.args[-1]]
    if rate.given is None or rate.name not in WELL_KNOWN:
        return None
    return drawing.scene.drivers[int(rate.says["d"])]


def is_constant(drawing: Drawing, step: Step, driver: Driver) -> bool:
    """Whether a step lays off the acceleration of a driver whose speed is constant."""
    name = drawing.trace.program.steps[step.args[-1]].name
    return name in SPEEDS and driver.acceleration.is_zero()
