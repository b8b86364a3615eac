"""The construction in words: one numbered sentence for each point that is found, in order."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from graphkin.paper.data import angle_symbol
from graphkin.paper.drawing import Drawing
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
    "velocity-normal",
    "centripetal",
)
WHOLE = ("acceleration-pole", "beside", "arm")
"""Actions whose own sentence says all that the hand does."""


SCALED = ("turned-velocity", "centripetal")
"""Actions that draw a vector as long as its bar, if the scale follows from the driver."""


CENTRES = ("instant-centre", "acceleration-pole")


@dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence of the construction with the number of the step that it ends with."""

    step: int
    name: str
    markup: str


def sentences(drawing: Drawing) -> list[Sentence]:
    """What to draw on a sheet, in the order of drawing."""
    found: list[Sentence] = []
    for number, step, _ in drawing.steps(Plane.MECHANISM, drawing.plane, Plane.NUMBERS):
        if step.action and step.action.key == "normal":
            text = normal_sentence(drawing, step, first=not any(s.name == "ν" for s in found))
            found.append(Sentence(number, "ν", text))
        elif is_found_point(drawing, number, step):
            found.append(Sentence(number, step.name, point_sentence(drawing, number, step)))
    return merged(drawing, found)


def is_found_point(drawing: Drawing, number: int, step: Step) -> bool:
    """True for a step that finds a point, a pole or a centre of this sheet."""
    if step.action is None or not step.name or step.arrow or number in drawing.results:
        return False
    if step.plane is Plane.MECHANISM:
        wanted = Part.CENTRE if drawing.kind == "velocity" else Part.POLE
        return step.part in (Part.POSITION, wanted) and step.name not in drawing.scene.frame.points
    return step.plane is drawing.plane and step.action.key != "pole"


def point_sentence(drawing: Drawing, number: int, step: Step) -> str:
    """Through what lines a point is found, and how they find it."""
    by_hand = step.by_hand is not None and step.by_hand in drawing.trace.values
    last = drawing.trace.program.steps[step.by_hand] if by_hand and step.by_hand else step
    assert step.action is not None
    if step.action.key in WHOLE:
        return phrase(drawing, step, step.name, step)
    parts = [clause for arg in last.args for clause in clauses(drawing, arg)]
    parts.append(phrase(drawing, last, step.name, step))
    return "; ".join(parts)


def clauses(drawing: Drawing, number: int) -> Iterator[str]:
    """The clause of a line or an arc, after that of the vector laid off before it."""
    step = drawing.trace.program.steps[number]
    if step.action is None or step.action.key not in LINES or step.name:
        return
    if step.plane is Plane.NUMBERS:
        return
    if step.action.key in ("square-to", "shifted", "driven-tangential"):
        for arg in step.args:
            yield from clauses(drawing, arg)
    yield phrase(drawing, step, step.name, step)


def phrase(drawing: Drawing, step: Step, name: str, words_of: Step) -> str:
    """The words of one step with the symbols of its names."""
    assert step.action is not None
    fields = fields_of(drawing, step, {**words_of.says, **step.says})
    key = f"step.{step.action.key}"
    if step.action.key == "square-to" and step.plane is Plane.ACCELERATIONS:
        key = "step.square-to-end"
    elif step.action.key == "ray" and "g" in step.says:
        key = "step.guide"
    elif step.action.key == "similar-point" and in_line(drawing, step):
        key = "step.similar-in-line"
    elif step.action.key in SCALED and step.name and not drawing.scales.from_driver:
        key += "-scaled"
    elif words_of.action and words_of.action.key in CENTRES and is_endless(drawing, words_of):
        key = f"step.{words_of.action.key}-far"
    elif step.action.key == "acceleration-pole" and step.by_hand is None:
        key += "-pivot"
    elif step.action.key == "centripetal" and not step.name:
        key = "step.lay-off"
    elif words_of.action and words_of.action.key == "instant-centre":
        key = "step.instant-centre" if words_of.by_hand else "step.instant-centre-pivot"
    elif step.action.key in ("arcs-meet", "arc-cuts-line"):
        fields["side"] = drawing.words(f"{key}.side{step.extra[0]:+d}", **fields)
        key += ".say"
    return drawing.words(key, name=symbol(name), **fields)


def is_endless(drawing: Drawing, step: Step) -> bool:
    """True when a centre or a pole lies at infinity."""
    number = drawing.trace.program.steps.index(step)
    return drawing.place(drawing.trace.values[number]) is None


def in_line(drawing: Drawing, step: Step) -> bool:
    """True when a plate point lies on the line of the two points that it follows from."""
    ratio = drawing.trace.values[step.args[2]]
    return bool(abs(ratio.imag) <= 1e-9 * abs(ratio))


def fields_of(drawing: Drawing, step: Step, says: Mapping[str, str]) -> dict[str, str]:
    """The symbols that a sentence needs: its names, its bar, its vector, its similar figures."""
    assert step.action is not None
    fields = {key: symbol(value) for key, value in says.items()}
    if "p" in says and "q" in says:
        fields["bar"] = bar(says["p"], says["q"])
    names = [drawing.trace.program.steps[arg].name for arg in step.args]
    match step.action.key:
        case "ray" if "k" in says:
            driver = next(d for d in drawing.scene.drivers if d.link == says["k"])
            fields["angle"] = angle_symbol(drawing.scene, driver)
        case "turned-velocity":
            fields["vector"] = symbol(f"v_{says['q']}")
        case "centripetal":
            fields["vector"] = symbol(f"a_{says['q']}" + ("" if step.name else "^ν"))
        case "driven-tangential":
            fields["vector"] = symbol(f"a_{says['q']}^τ")
        case "lay-off":
            fields["vector"] = symbol(f"a_{says['i']}^ν")
        case "velocity-normal":
            fields["v"] = symbol(f"v_{says['p']}")
        case "acceleration-pole":
            fields["figure"] = symbol(drawing.pole) + symbol(says["a"]) + symbol(says["b"])
        case "similar-point":
            fields["images"] = symbol(names[0]) + symbol(names[1])
            fields["image"] = fields["images"] + symbol(step.name)
            fields["figure"] = fields["bar"] + fields["r"]
    return fields


def normal_sentence(drawing: Drawing, step: Step, *, first: bool) -> str:
    """The right triangle of one normal component, in full the first time."""
    says = step.says
    fields = {
        "p": symbol(says["p"]),
        "q": symbol(says["q"]),
        "bar": bar(says["p"], says["q"]),
        "v": symbol("v_" + says["i"]),
        "a": symbol(f"a_{says['i']}^ν"),
        "letter": symbol(says["q"].lower()),
    }
    return drawing.words("step.normal" if first else "step.normal-again", **fields)


def merged(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """Later right triangles said in one sentence, each point else in its own."""
    normals = [sentence for sentence in found if sentence.name == "ν"]
    rest = normals[1:]
    if not rest:
        return found
    tail = drawing.words("step.normals-again", list=", ".join(s.markup for s in rest))
    one = Sentence(rest[-1].step, "ν", tail)
    kept = [s for s in found if s.name != "ν" or s is normals[0]]
    place = kept.index(normals[0]) + 1
    return [*kept[:place], one, *kept[place:]]
