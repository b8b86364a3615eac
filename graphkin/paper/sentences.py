"""The construction in words: one numbered sentence for each point that is found, in order."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from graphkin.paper.data import angle_symbol, heading
from graphkin.paper.drawing import Drawing
from graphkin.paper.richtext import escape
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
    "kennedy-line",
    "inflection-square",
)
WHOLE = ("acceleration-pole", "beside", "arm", "pin-centre", "guide-centre")
"""Actions whose own sentence says all that the hand does."""


SCALED = ("turned-velocity", "centripetal")
"""Actions that draw a vector as long as its bar, if the scale follows from the driver."""


CENTRES = ("instant-centre", "acceleration-pole", "relative-centre", "inflection-pole")


SAID = ("relative-centre", "inflection-pole")
"""Actions whose sentence hangs on how the plan finds their point."""
STILL = ("instant-centre", "acceleration-pole")
"""Centres and poles that may be a point of the link from which the hand would draw a ray."""


OWN_WORDS = ("kennedy-line", "kennedy-endless", "pin-centre", "guide-centre")
"""Steps of relative centres whose words do not hang on how the centre is found."""


@dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence of the construction with the number of the step that it ends with."""

    step: int
    name: str
    markup: str


def sentences(drawing: Drawing) -> list[Sentence]:
    """What to draw on a sheet, in the order of drawing, and what to read off at the end."""
    found: list[Sentence] = []
    if drawing.again:
        found.append(Sentence(-1, "again", drawing.words("step.again")))
    shown = False
    for number, step, value in drawing.steps(Plane.MECHANISM, drawing.plane, Plane.NUMBERS):
        if step.action and step.action.key == "normal":
            first = not shown and drawing.settled(abs(value)) > 0
            shown = shown or first
            name = "ν1" if first else "ν"
            found.append(Sentence(number, name, normal_sentence(drawing, step, first=first)))
        elif is_found_point(drawing, number, step) and not is_again(drawing, step):
            found.append(Sentence(number, step.name, point_sentence(drawing, number, step)))
    found += [
        Sentence(-1, curve.kind, drawing.words(f"step.{curve.kind}", of=symbol(curve.of)))
        for curve in drawing.curves
        if curve.kind != "fixed-centrode"
    ]
    last = Sentence(-1, "", drawing.words(f"step.read-{drawing.kind}"))
    return [*merged(drawing, found), last]


def is_again(drawing: Drawing, step: Step) -> bool:
    """True for a step that the sheet before has shown: the mechanism itself."""
    return drawing.again and step.part is Part.POSITION


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
    elif step.action.key in OWN_WORDS:
        key += far_end(drawing, step, fields)
    elif step.action.key == "similar-point" and in_line(drawing, step):
        key = "step.similar-in-line"
    elif step.action.key in SCALED and step.name and not drawing.scales.from_driver:
        key += "-scaled"
    elif words_of.action and words_of.action.key in CENTRES and (odd := oddity(drawing, words_of)):
        key = f"step.{words_of.action.key}-{odd}"
    elif step.action.key == "acceleration-pole" and step.by_hand is None:
        key += "-pivot"
    elif step.action.key in SAID and "how" in step.says:
        key += f"-{step.says['how']}"
    elif step.action.key == "centripetal" and not step.name:
        key = "step.lay-off"
    elif words_of.action and words_of.action.key == "instant-centre":
        key = "step.instant-centre" if words_of.by_hand else "step.instant-centre-pivot"
    elif step.action.key == "arcs-meet":
        fields["side"] = drawing.words(f"{key}.side{step.extra[0]:+d}", **fields)
        key += ".say"
    elif step.action.key == "arc-cuts-line":
        way = drawing.trace.values[step.args[0]].along * step.extra[0]
        fields["side"] = drawing.words(f"page.{heading(way)}")
    return drawing.words(key, name=symbol(name), **fields)


def far_end(drawing: Drawing, step: Step, fields: dict[str, str]) -> str:
    """What is added to the key of a line of centres of which one is at infinity, named last."""
    if step.action is None or step.action.key != "kennedy-line":
        return ""
    ends = [drawing.place(drawing.trace.values[arg]) for arg in step.args]
    if ends[0] is None:
        fields["m"], fields["n"] = fields["n"], fields["m"]
    return "-far" if None in ends else ""


def oddity(drawing: Drawing, step: Step) -> str:
    """What is odd about a centre or pole: everywhere, far (at infinity), or still at one point."""
    value = drawing.trace.values[number_of(drawing, step)]
    if drawing.is_everywhere(value):
        return "everywhere"
    if drawing.place(value) is None:
        return "far"
    lost = step.by_hand is not None and step.by_hand not in drawing.trace.values
    return "still" if lost and step.action and step.action.key in STILL else ""


def in_line(drawing: Drawing, step: Step) -> bool:
    """True when a plate point lies on the line of the two points that it follows from."""
    ratio = drawing.trace.values[step.args[2]]
    return bool(abs(ratio.imag) <= 1e-9 * abs(ratio))


def fields_of(drawing: Drawing, step: Step, says: Mapping[str, str]) -> dict[str, str]:
    """The symbols that a sentence needs: its names, its bar, its vector, its similar figures."""
    assert step.action is not None
    fields = {key: symbol(value) for key, value in says.items()}
    fields |= {key: escape(says[key]) for key in ("j", "k", "g") if key in says}
    if "p" in says and "q" in says:
        fields["bar"] = bar(says["p"], says["q"])
    names = [drawing.trace.program.steps[arg].name for arg in step.args]
    match step.action.key:
        case "ray" if "k" in says:
            driver = next(d for d in drawing.scene.drivers if d.link == says["k"])
            fields["angle"] = angle_symbol(drawing.scene, driver)
        case "compass":
            fields["bar"] += derived(drawing, step.args[1])
        case "square-to" if "i" in says:
            fields["vector"] = symbol(f"a_{says['i']}^τ")
        case "turned-velocity":
            fields["vector"] = symbol(f"v_{says['q']}")
        case "centripetal":
            fields["vector"] = symbol(f"a_{says['q']}" + ("" if step.name else "^ν"))
        case "driven-tangential":
            fields["vector"] = symbol(f"a_{says['q']}^τ")
            fields["drawn"] = drawn_length(drawing, number_of(drawing, step), step.args[0])
        case "lay-off":
            fields["vector"] = symbol(f"a_{says['i']}^ν")
        case "inflection-point":
            away = drawing.trace.values[number_of(drawing, step)]
            away -= drawing.trace.values[step.args[0]]
            drawn = drawing.words.fixed(1000 * abs(away) / drawing.scales.kL, 1)
            fields["drawn"], fields["a"] = drawn, symbol(f"a_{says['p']}")
            fields["omega"] = symbol(f"ω_{says['k']}")
        case "inflection-pole":
            fields["omega"] = symbol(f"ω_{says['k']}")
        case "velocity-normal":
            fields["v"] = symbol(f"v_{says['p']}")
        case "acceleration-pole":
            fields["figure"] = symbol(drawing.pole) + symbol(says["a"]) + symbol(says["b"])
        case "similar-point":
            fields["images"] = symbol(names[0]) + symbol(names[1])
            fields["image"] = fields["images"] + symbol(step.name)
            fields["figure"] = fields["bar"] + fields["r"]
    return fields


def derived(drawing: Drawing, number: int) -> str:
    """The length of a bar that the scene does not state but that follows from its plate."""
    if drawing.trace.program.steps[number].given is not None:
        return ""
    length = drawing.words.significant(drawing.length(drawing.trace.values[number]), 5)
    return f" = {length} {drawing.scene.units['length']}"


def number_of(drawing: Drawing, step: Step) -> int:
    """The number of a step in its program."""
    return drawing.trace.program.steps.index(step)


def drawn_length(drawing: Drawing, tip: int, tail: int) -> str:
    """How long a vector of the acceleration plan is drawn, in mm."""
    size = abs(drawing.trace.values[tip] - drawing.trace.values[tail])
    return drawing.words.fixed(1000 * size / drawing.scales.ka, 2)


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


def with_centres_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The centres that are there at once said in one sentence; so are those by two lines.

    Of the latter the first is said in full, and so is each whose lines do anything unusual.
    """
    steps = drawing.trace.program.steps
    at_once, crossed = [], []
    for said in found:
        step = steps[said.step] if said.step >= 0 else None
        key = step.action.key if step is not None and step.action is not None else ""
        if key in ("pin-centre", "guide-centre"):
            at_once.append(said)
        elif key == "relative-centre" and step is not None and is_plain_crossing(drawing, step):
            crossed.append(said)
    if at_once:
        guided = any(steps[said.step].says.get("g") for said in at_once)
        listed = drawing.words("list_mark").join(said.markup for said in at_once)
        markup = drawing.words(f"step.centres-{'guided' if guided else 'pinned'}", list=listed)
        found = together(found, at_once, markup)
    if len(crossed) > 2:
        listed = drawing.words("list_mark").join(crossing(drawing, said) for said in crossed[1:])
        found = together(found, crossed[1:], drawing.words("step.centres-crossed", list=listed))
    return found


def together(found: list[Sentence], some: list[Sentence], markup: str) -> list[Sentence]:
    """Several sentences said in one, at the place of the first of them."""
    place = found.index(some[0])
    kept = [said for said in found if said not in some]
    return [*kept[:place], Sentence(some[-1].step, some[-1].name, markup), *kept[place:]]


def is_plain_crossing(drawing: Drawing, step: Step) -> bool:
    """True for a centre at a place, where two lines of centres meet."""
    hand = lines_of(drawing, step)
    return len(hand) == 2 and not oddity(drawing, step)


def lines_of(drawing: Drawing, step: Step) -> list[Step]:
    """The lines of centres that meet in a relative centre."""
    steps = drawing.trace.program.steps
    if step.by_hand is None or step.by_hand not in drawing.trace.values:
        return []
    lines = [steps[arg] for arg in steps[step.by_hand].args]
    return [line for line in lines if line.action and line.action.key == "kennedy-line"]


def crossing(drawing: Drawing, said: Sentence) -> str:
    """A centre with the two lines that meet in it, as I₁₃ (I₁₂I₂₃, I₁₄I₃₄)."""
    step = drawing.trace.program.steps[said.step]
    lines = (symbol(line.says["m"]) + symbol(line.says["n"]) for line in lines_of(drawing, step))
    return f"{symbol(step.name)} ({drawing.words('list_mark').join(lines)})"


def merged(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The other right triangles said in one sentence, after the one that is said in full."""
    found = with_centres_together(drawing, found)
    rest = [sentence for sentence in found if sentence.name == "ν"]
    if not rest:
        return found
    kept = [sentence for sentence in found if sentence.name != "ν"]
    tail = drawing.words("step.normals-again", list=", ".join(s.markup for s in rest))
    firsts = [i for i, sentence in enumerate(kept) if sentence.name == "ν1"]
    place = firsts[0] + 1 if firsts else found.index(rest[0])
    return [*kept[:place], Sentence(rest[-1].step, "ν", tail), *kept[place:]]
