"""What fills the gaps of a sentence about a step: symbols, lengths, angles and figures."""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping
from math import degrees

from graphkin.construction.core.amounts import in_degrees, in_mm
from graphkin.construction.core.component import index_before
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import angle_symbol, driver_index
from graphkin.construction.core.given_pairs import heading
from graphkin.construction.core.line_words import axis_of
from graphkin.construction.core.naming import (
    beyond,
    drawn_amount,
    drawn_between,
    index_of,
    names_in,
    rate_symbol,
    vector_of,
    way_of,
)
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.core.zero_vectors import rate_at_rest
from graphkin.construction.higher_class.closing_words import found_place
from graphkin.construction.higher_class.misclosure import tried_link
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.scene.model import FRAME, Driver

LAID_OFF = ("turned-velocity", "driven-slide", "centripetal", "driven-tangential")
"""Actions that lay off a vector from a point of a plan."""
SUMS = {"sum": "+", "difference": "−"}
"""The actions that give a rate from two others, and the sign between them."""
RATES = {"omega": "v_{}", "epsilon": "a_{}^τ"}
"""The vectors from which a plan finds how a link turns."""


def fields_of(drawing: Drawing, step: Step, says: Mapping[str, str]) -> dict[str, str]:
    """The symbols that a sentence needs: its names, its bar, its vector, its similar figures."""
    fields = names_in(says)
    if "p" in says and "q" in says:
        fields["bar"] = bar(says["p"], says["q"])
    if "g" in says:
        fields["guide"] = way_of(drawing, says["g"])
    if step.plane is Plane.MECHANISM:
        return fields | on_mechanism(drawing, step, fields, says)
    return fields | on_plan(drawing, step, fields, says)


def on_mechanism(
    drawing: Drawing, step: Step, fields: Mapping[str, str], says: Mapping[str, str]
) -> dict[str, str]:
    """What fills the gaps of a sentence about the mechanism."""
    assert step.action is not None
    values, words = drawing.trace.values, drawing.words
    match step.action.key:
        case "ray" if "k" in says:
            driver = next(d for d in drawing.scene.drivers if d.link == says["k"])
            return {"angle": angle_of(drawing, driver)} | against(drawing, driver, says["p"])
        case "compass":
            return {"bar": fields["bar"] + derived(drawing, step.args[1])}
        case "arcs-meet":
            side = round(step.extra[0] if step.extra else values[step.args[2]])
            return {"side": words(f"step.arcs-meet.side{side:+d}", **fields)}
        case "arc-cuts-line":
            sense = step.extra[0] if step.extra else values[step.args[2]]
            return {"side": words(f"page.{heading(values[step.args[0]].along * sense)}")}
        case "guide-back":
            angle = words.fixed(degrees(phase(values[drawing.number_of(step)].along)), 1)
            return {"q": symbol(drawing.scene.links[says["g"]].points[0]), "angle": angle}
        case "set-at" | "set-back":
            return {"what": coordinate(drawing, step), **found_place(drawing, step)}
        case "arm":
            way = values[drawing.number_of(step)] - values[step.args[0]]
            return {"angle": words.fixed(degrees(phase(way)), 1)}
        case "step-along":
            return {"start": symbol(beyond(drawing, step))}
        case "similar-point":
            return figures(drawing, step, fields)
    return {}


def on_plan(
    drawing: Drawing, step: Step, fields: Mapping[str, str], says: Mapping[str, str]
) -> dict[str, str]:
    """What fills the gaps of a sentence about a plan."""
    assert step.action is not None
    key, number = step.action.key, drawing.number_of(step)
    found = {}
    if key in LAID_OFF:
        drawn = drawn_between(drawing, step.args[0], number, step.plane)
        found["drawn"] = in_mm(drawing.words, drawn)
        found["rate"] = rate_at_rest(drawing, step)
    match key:
        case "square-to" if "c" in says:
            found["c"] = symbol(says["c"])
        case "square-to" if "i" in says:
            found["vector"] = symbol(f"a_{says['i']}^τ")
        case "parallel-to" | "driven-slide":
            found["vector"] = sliding_vector(drawing, step, number)
        case "turned-velocity":
            default = symbol(f"v_{index_of(drawing, says)}")
            found["vector"] = vector_of(drawing, step.args[0], number, default)
            found["omega"] = rate_of(drawing, step, says, "ω")
        case "centripetal":
            kind = "" if step.name and says["s"] == drawing.pole else "^ν"
            found["vector"] = symbol(f"a_{index_of(drawing, says)}{kind}")
            found["omega"] = rate_symbol(drawing, step.args[3])
        case "driven-tangential":
            found["vector"] = symbol(f"a_{index_of(drawing, says)}^τ")
            found["epsilon"] = rate_of(drawing, step, says, "ε")
        case "similar-point":
            found |= figures(drawing, step, fields)
    return found


def angle_of(drawing: Drawing, driver: Driver) -> str:
    """The symbol of a driver's angle, with the degrees that a protractor shows."""
    size = in_degrees(drawing.scene, drawing.words, driver.position)
    return angle_symbol(drawing.scene, driver) + (f" = {size}" if size else "")


def against(drawing: Drawing, driver: Driver, pivot: str) -> dict[str, str]:
    """The line of a moving link from which a driver's angle is laid off; nothing of the frame's.

    Where the pivot ends that link's bar it is the bar produced.
    """
    if driver.against == FRAME:
        return {}
    link = drawing.scene.links[driver.against]
    line = axis_of(drawing, link)
    ends = link.points[1:2] == (pivot,) and line == bar(*link.points[:2])
    return {"line": line, "produced": line} if ends else {"line": line}


def rate_of(drawing: Drawing, step: Step, says: Mapping[str, str], letter: str) -> str:
    """The rate by which a vector is laid off; one that a trial plan tries is its link's."""
    rate = drawing.trace.program.steps[step.args[3]]
    if drawing.number_of(step) in drawing.tags and "k" in says:
        own, lead = symbol(f"{letter}_{says['k']}"), tried_link(drawing, step.args[3])
        if lead not in ("", says["k"]):
            return f"{own} = {symbol(f'{letter}_{lead}')}"
        if lead or rate.name not in drawing.scene.links:
            return own
    return rate_symbol(drawing, step.args[3], letter) + found_by(drawing, step)


def found_by(drawing: Drawing, step: Step) -> str:
    """From which vector of this plan a rate is found, where it is taken the first time."""
    rate = drawing.trace.program.steps[step.args[3]]
    key = rate.action.key if rate.action else ""
    form = RATES.get(key, "")
    users = drawing.children[step.args[3]]
    alike = [user for user in users if drawing.trace.program.steps[user].action is step.action]
    if alike[0] != drawing.number_of(step):
        return ""
    if key in SUMS:
        return summed(drawing, step.args[3], SUMS[key])
    if not form:
        return ""
    vector = symbol(form.format(index_of(drawing, rate.says)))
    return f" = {vector}/{bar(rate.says['p'], rate.says['q'])}"


def summed(drawing: Drawing, number: int, sign: str) -> str:
    """The sum of which a rate follows: that of a link and the given one against it."""
    rate, words = drawing.trace.program.steps[number], drawing.words
    letter, unit = drawing.rate.letter, drawing.rate.caret_unit
    for driver in drawing.scene.drivers:
        if rate.name == (driver.link if sign == "+" else driver.against):
            own = f"*{letter}*_{{{driver_index(driver)}}}"
            other = rate_symbol(drawing, rate.args[0], letter)
            value = words.significant(float(drawing.trace.values[number]))
            return f" = {other} {sign} {own} = {value} {unit}"
    return ""


def figures(drawing: Drawing, step: Step, fields: Mapping[str, str]) -> dict[str, str]:
    """The two similar figures of a plate point."""
    names = [drawing.trace.program.steps[arg].name for arg in step.args]
    images = symbol(names[0]) + symbol(names[1])
    image = images + symbol(step.name)
    return {"images": images, "image": image, "figure": fields["bar"] + fields["r"]}


def sliding_vector(drawing: Drawing, step: Step, number: int) -> str:
    """The vector along a guide: from its line's or its own beginning to the point found."""
    tips = [number, *drawing.children.get(number, ())]
    found = (vector_of(drawing, step.args[0], tip) for tip in tips)
    index = index_before(drawing.trace.program, step.args[0])
    default = symbol(f"a_{index}^r") if index else ""
    return next((name for name in found if name), default)


def coordinate(drawing: Drawing, step: Step) -> str:
    """The coordinate at which a link stands on its guide or track, given or as it is drawn."""
    number = step.args[1]
    size = float(drawing.trace.values[number])
    drivers = drawing.scene.drivers
    given = drawing.trace.program.steps[number]
    if given.given is None or given.name != "s":
        return drawn_amount(drawing, size)
    name = angle_symbol(drawing.scene, drivers[int(given.says["d"])])
    return f"{name} ({drawn_amount(drawing, size)})"


def derived(drawing: Drawing, number: int) -> str:
    """The length of a bar that the scene does not state but that follows from its plate."""
    if drawing.trace.program.steps[number].given is not None:
        return ""
    return f" ({drawn_amount(drawing, float(drawing.trace.values[number]))})"
