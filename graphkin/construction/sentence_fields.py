"""What fills the gaps of a sentence about a step: symbols, lengths, angles and figures."""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping
from math import degrees

from graphkin.construction.core.amounts import in_degrees
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import angle_symbol
from graphkin.construction.core.given_pairs import heading
from graphkin.construction.core.line_words import axis_of
from graphkin.construction.core.naming import (
    beyond,
    drawn_amount,
    names_in,
    way_of,
)
from graphkin.construction.core.program import Plane, Step
from graphkin.construction.higher_class.closing_words import found_place
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.scene.model import FRAME, Driver


def fields_of(drawing: Drawing, step: Step, says: Mapping[str, str]) -> dict[str, str]:
    """The symbols that a sentence needs: its names, its bar, its vector, its similar figures."""
    fields = names_in(says)
    if "p" in says and "q" in says:
        fields["bar"] = bar(says["p"], says["q"])
    if "g" in says:
        fields["guide"] = way_of(drawing, says["g"])
    if step.plane is Plane.MECHANISM:
        return fields | on_mechanism(drawing, step, fields, says)
    return fields


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


def figures(drawing: Drawing, step: Step, fields: Mapping[str, str]) -> dict[str, str]:
    """The two similar figures of a plate point."""
    names = [drawing.trace.program.steps[arg].name for arg in step.args]
    images = symbol(names[0]) + symbol(names[1])
    image = images + symbol(step.name)
    return {"images": images, "image": image, "figure": fields["bar"] + fields["r"]}


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
