"""The words of single steps: which sentence an action takes, and what fills its gaps."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Mapping
from math import degrees

from graphkin.paper.centre_words import CENTRES, OWN_WORDS, SAID, far_end, oddity
from graphkin.paper.data import angle_symbol
from graphkin.paper.drawing import Drawing
from graphkin.paper.naming import (
    NAUGHT,
    amount,
    drawn_between,
    is_driven,
    names_in,
    rate_symbol,
    vector_of,
    way_of,
)
from graphkin.paper.pairs import heading
from graphkin.paper.symbolic import bar, symbol
from graphkin.steps.program import Part, Plane, Step

LINES = (
    "square-to",
    "parallel-to",
    "compass",
    "ray",
    "lay-off",
    "along-bar",
    "shifted",
    "guide-back",
    "radius-along",
    "velocity-normal",
    "centripetal",
    "lay-off-coriolis",
    "lay-back-coriolis",
    "line-through",
    "kennedy-line",
    "inflection-square",
)
"""Actions that are said within the sentence of the point that they help to find."""
FOLLOWING = (
    "square-to",
    "parallel-to",
    "shifted",
    "radius-along",
    "lay-off-coriolis",
)
"""Those of them that begin where another one ended."""
WHOLE = (
    "acceleration-pole",
    "beside",
    "arm",
    "pin-centre",
    "guide-centre",
    "contact-on-track",
    "contact-of-wheels",
    "rack-at",
    "set-back",
)
"""Actions whose own sentence says all that the hand does."""
SWINGS = ("swing", "swing-through")
"""Actions that lay a lever through a pin."""
LAID_OFF = ("turned-velocity", "driven-slide", "centripetal", "driven-tangential")
"""Actions that lay off a vector from a point of a plan."""


def point_sentence(drawing: Drawing, number: int, step: Step) -> str:
    """Through what lines a point is found, and how they find it."""
    by_hand = step.by_hand is not None and step.by_hand in drawing.trace.values
    last = drawing.trace.program.steps[step.by_hand] if by_hand and step.by_hand else step
    assert step.action is not None
    if step.action.key in WHOLE:
        return phrase(drawing, step, step.name, step)
    parts = [clause for arg in last.args for clause in clauses(drawing, arg, last.plane)]
    parts.append(phrase(drawing, last, step.name, step))
    return "; ".join(parts)


def clauses(drawing: Drawing, number: int, plane: Plane) -> Iterator[str]:
    """The clause of a line or an arc of a drawing, after that of the vector laid off before it."""
    step = drawing.trace.program.steps[number]
    if step.action is None or step.action.key not in LINES or step.name:
        return
    if step.plane is not plane or is_lever(drawing, number):
        return
    if step.action.key in FOLLOWING:
        for arg in step.args:
            yield from clauses(drawing, arg, plane)
    yield phrase(drawing, step, step.name, step)


def is_lever(drawing: Drawing, number: int) -> bool:
    """True for the line of a lever that a sentence of its own has laid through a pin."""
    steps = drawing.trace.program.steps
    actions = (steps[arg].action for arg in steps[number].args)
    return any(action is not None and action.key in SWINGS for action in actions)


def phrase(drawing: Drawing, step: Step, name: str, words_of: Step) -> str:
    """The words of one step with the symbols of its names."""
    says = {**words_of.says, **step.says}
    fields = fields_of(drawing, step, says)
    key = key_of(drawing, step, words_of, fields)
    return drawing.words(f"step.{key}", **{"name": symbol(name), **fields})


# --- which sentence ------------------------------------------------------------------------------


def key_of(drawing: Drawing, step: Step, words_of: Step, fields: dict[str, str]) -> str:
    """The key of the sentence of a step."""
    assert step.action is not None
    key = step.action.key
    whole = words_of.action.key if words_of.action else ""
    if step.plane is Plane.MECHANISM and step.part in (Part.CENTRE, Part.POLE):
        return centre_key(drawing, step, words_of, fields)
    if whole in CENTRES:
        return centre_key(drawing, step, words_of, fields)
    if step.plane is Plane.MECHANISM:
        return mechanism_key(drawing, step, key)
    return plan_key(drawing, step, key)


def centre_key(drawing: Drawing, step: Step, words_of: Step, fields: dict[str, str]) -> str:
    """The key of the sentence of a centre, a pole, or a line to one."""
    assert step.action is not None and words_of.action is not None
    key, whole = step.action.key, words_of.action.key
    if key in OWN_WORDS:
        return key + far_end(drawing, step, fields)
    if whole in CENTRES and (odd := oddity(drawing, words_of)):
        return f"{whole}-{odd}"
    if key == "acceleration-pole" and step.by_hand is None:
        return f"{key}-pivot"
    if key in SAID and "how" in step.says:
        return f"{key}-{step.says['how']}"
    if whole == "instant-centre":
        return whole if words_of.by_hand else f"{whole}-pivot"
    return key


def mechanism_key(drawing: Drawing, step: Step, key: str) -> str:
    """The key of the sentence of a step that draws the mechanism."""
    scene, steps = drawing.scene, drawing.trace.program.steps
    if key in ("ray", "along-bar") and "g" in step.says:
        ways = sum(len(link.slides) + len(link.rolls) for link in scene.links.values())
        return "guide" if ways == 1 and scene.links[step.says["g"]].slides else "guide-named"
    if key == "beside" and not scene.links[step.says["g"]].slides:
        return "beside-turned"
    if key == "mark-off" and is_lever(drawing, step.args[0]):
        return "mark-off-lever"
    if key == "set-at" and is_tried(steps[step.args[1]]):
        return "set-at-found"
    return f"{key}.say" if key == "arcs-meet" else key


def is_tried(step: Step) -> bool:
    """True for a value that the closing of a group has found."""
    return step.action is not None and step.action.key == "part"


def plan_key(drawing: Drawing, step: Step, key: str) -> str:
    """The key of the sentence of a step that draws a plan."""
    number = drawing.number_of(step)
    if key == "square-to" and step.plane is Plane.ACCELERATIONS:
        return "square-to-end"
    if key == "along-bar":
        return "common-normal"
    if key == "parallel-to" and not step.says["s"]:
        before = drawing.trace.program.steps[step.args[0]].action
        back = before is not None and before.key == "lay-back-coriolis"
        return "parallel-to-tail" if back else "parallel-to-end"
    if key == "similar-point" and in_line(drawing, step):
        return "similar-in-line"
    if key == "centripetal" and not step.name:
        return "lay-off"
    if key == "lay-off" and step.name:
        return "lay-off-named"
    if key in LAID_OFF and drawn_between(drawing, step.args[0], number, step.plane) < NAUGHT:
        at_end = not step.says["s"] or key == "driven-tangential"
        return "falls-end" if at_end else "falls"
    if key == "driven-slide" and not step.says["s"]:
        return "driven-slide-end"
    if key in ("turned-velocity", "centripetal"):
        as_long = drawing.scales.from_driver and is_driven(drawing, step.args[3])
        return key if as_long else f"{key}-scaled"
    return key


def in_line(drawing: Drawing, step: Step) -> bool:
    """True when a plate point lies on the line of the two points that it follows from."""
    ratio = drawing.trace.values[step.args[2]]
    return bool(abs(ratio.imag) <= 1e-9 * abs(ratio))


# --- what fills its gaps -------------------------------------------------------------------------


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
            return {"angle": angle_symbol(drawing.scene, driver)}
        case "compass":
            return {"bar": fields["bar"] + derived(drawing, step.args[1])}
        case "arcs-meet":
            side = round(step.extra[0] if step.extra else values[step.args[2]])
            return {"side": words(f"step.arcs-meet.side{side:+d}", **fields)}
        case "arc-cuts-line":
            sense = step.extra[0] if step.extra else values[step.args[2]]
            return {"side": words(f"page.{heading(values[step.args[0]].along * sense)}")}
        case "guide-back":
            return {"q": symbol(drawing.scene.links[says["g"]].points[0])}
        case "set-at" | "set-back":
            return {"what": coordinate(drawing, step)}
        case "beside":
            way = drawing.standing.spot(step.name) - drawing.standing.spot(says["p"])
            return {"angle": words.fixed(degrees(phase(way)), 1)}
        case "inflection-point":
            away = abs(values[drawing.number_of(step)] - values[step.args[0]])
            drawn = words.fixed(1000 * away / drawing.scales.kL, 1)
            names = {"a": symbol(f"a_{says['p']}"), "omega": symbol(f"ω_{says['k']}")}
            return {"drawn": drawn, **names}
        case "inflection-pole":
            return {"omega": symbol(f"ω_{says['k']}")}
        case "velocity-normal":
            return {"v": symbol(f"v_{says['p']}")}
        case "acceleration-pole":
            return {"figure": symbol(drawing.pole) + symbol(says["a"]) + symbol(says["b"])}
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
        found["drawn"] = drawing.words.fixed(drawn, 2)
    match key:
        case "square-to" if "i" in says:
            found["vector"] = symbol(f"a_{says['i']}^τ")
        case "parallel-to" | "driven-slide":
            found["vector"] = sliding_vector(drawing, step, number)
        case "turned-velocity":
            default = symbol(f"v_{says['q']}")
            found["vector"] = vector_of(drawing, step.args[0], number, default)
            found["omega"] = rate_symbol(drawing, step.args[3])
        case "centripetal":
            i = says.get("i", says["q"])
            found["vector"] = symbol(f"a_{i}" + ("" if step.name else "^ν"))
        case "driven-tangential":
            found["vector"] = symbol(f"a_{says.get('i', says['q'])}^τ")
            found["epsilon"] = rate_symbol(drawing, step.args[3], "ε")
        case "lay-off":
            found["vector"] = symbol(f"a_{says['i']}^ν")
        case "lay-off-coriolis" | "lay-back-coriolis":
            found["vector"] = symbol(f"a_{says['i']}^c")
        case "along-bar":
            found["bar"] = bar(says["p"], says["q"])
        case "similar-point":
            found |= figures(drawing, step, fields)
    return found


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
    before = drawing.trace.program.steps[step.args[0]].says
    default = symbol(f"a_{before['i']}^r") if "i" in before else ""
    return next((name for name in found if name), default)


def coordinate(drawing: Drawing, step: Step) -> str:
    """The coordinate at which a driven link stands along its guide or track."""
    number = step.args[1]
    size = amount(drawing, float(drawing.trace.values[number]))
    drivers = drawing.scene.drivers
    given = drawing.trace.program.steps[number]
    if given.given is None or given.name != "s":
        return size
    return f"{angle_symbol(drawing.scene, drivers[int(given.says['d'])])} = {size}"


def derived(drawing: Drawing, number: int) -> str:
    """The length of a bar that the scene does not state but that follows from its plate."""
    if drawing.trace.program.steps[number].given is not None:
        return ""
    return f" = {amount(drawing, float(drawing.trace.values[number]))}"
