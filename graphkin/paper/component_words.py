"""The words of normal and Coriolis components: their triangles, and what is too short for one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphkin.paper.drawing import Drawing
from graphkin.paper.letters import is_coriolis, letter_on, no_base, no_triangle
from graphkin.paper.naming import NAUGHT, plan_amount, rate_symbol, vector_of
from graphkin.paper.sentence import Sentence, in_one, together
from graphkin.paper.short import is_short
from graphkin.paper.symbolic import bar, symbol
from graphkin.plane import cross
from graphkin.steps.program import Plane, Step


def is_drawn(drawing: Drawing, step: Step, value: Any) -> bool:
    """True for a component that is drawn on the mechanism and is not too short for it."""
    if step.by_hand not in drawing.trace.values or is_short(drawing, abs(value), drawing.plane):
        return False
    assert step.action is not None and step.by_hand is not None
    corner = drawing.trace.program.steps[step.by_hand].args[0]
    return step.action.key == "normal" or not no_base(drawing, corner, 1000 / drawing.scales.kL)


def component_sentence(drawing: Drawing, number: int, step: Step, *, first: bool) -> Sentence:
    """The triangle of a normal or Coriolis component; for the others only from what it comes."""
    assert step.action is not None
    size = abs(drawing.trace.values[number])
    if drawing.settled(size) and is_short(drawing, size, drawing.plane):
        return Sentence(number, "short", left_out(drawing, step, size))
    if step.action.key == "normal":
        if not drawing.settled(size):
            fields = {"a": symbol(f"a_{step.says['i']}^ν"), "v": symbol("v_" + step.says["v"])}
            return Sentence(number, "ν none", drawing.words("step.normal-none", **fields))
        if drawing.scales.apart:
            return Sentence(number, "ν by number", computed_normal(drawing, number, step))
        markup = normal_sentence(drawing, step, first=first)
        return Sentence(number, "ν1" if first else "ν", markup)
    return Sentence(number, "c", coriolis_sentence(drawing, number, step, first=first))


def left_out(drawing: Drawing, step: Step, size: float) -> str:
    """A component that is too short to be drawn: what it is, and how long it would be."""
    says = step.says
    drawn = plan_amount(drawing, drawing.plane, size)
    if step.action is not None and step.action.key == "normal":
        whole = f"{symbol('v_' + says['v'])}^2/{bar(says['p'], says['q'])}"
        return f"{symbol('a_' + says['i'] + '^ν')} = {whole} ({drawn})"
    whole = f"2{rate_symbol(drawing, step.args[0])}·{symbol('v_' + says['i'])}"
    return f"{symbol('a_' + says['i'] + '^c')} = {whole} ({drawn})"


def normal_sentence(drawing: Drawing, step: Step, *, first: bool) -> str:
    """The right triangle of one normal component, in full the first time."""
    says = step.says
    fields = {
        "p": symbol(says["p"]),
        "q": symbol(says["q"]),
        "bar": bar(says["p"], says["q"]),
        "v": symbol("v_" + says["v"]),
        "a": symbol(f"a_{says['i']}^ν"),
    }
    if not first:
        return drawing.words("step.normal-again", **fields)
    steps = drawing.trace.program.steps
    assert step.by_hand is not None
    end = steps[steps[step.by_hand].args[1]]
    cut = steps[end.args[0]]
    tip = steps[steps[cut.args[0]].args[0]]
    corners = {"tip": tip, "cut": cut, "end": end}
    letters = {key: corner_letter(drawing, corner) for key, corner in corners.items()}
    return drawing.words("step.normal", **fields, **letters)


def corner_letter(drawing: Drawing, step: Step) -> str:
    """The letter of a triangle's corner as the sheet has it."""
    return symbol(letter_on(drawing, step, 1000 / drawing.scales.kL))


def computed_normal(drawing: Drawing, number: int, step: Step) -> str:
    """A normal component by number, where ka is stated apart and the right triangle fails."""
    says, size = step.says, abs(drawing.trace.values[number])
    return drawing.words(
        "step.normal-computed",
        p=symbol(says["p"]),
        q=symbol(says["q"]),
        bar=bar(says["p"], says["q"]),
        v=symbol("v_" + says["v"]),
        a=symbol(f"a_{says['i']}^ν"),
        drawn=plan_amount(drawing, Plane.ACCELERATIONS, size),
    )


def coriolis_sentence(drawing: Drawing, number: int, step: Step, *, first: bool) -> str:
    """The similar triangles of a Coriolis component, in full the first time."""
    steps, values = drawing.trace.program.steps, drawing.trace.values
    size = abs(values[number])
    fields = {
        "a": symbol(f"a_{step.says['i']}^c"),
        "v": symbol("v_" + step.says["i"]),
        "segment": "".join(symbol(steps[arg].name) for arg in step.args[1:]),
        "omega": rate_symbol(drawing, step.args[0]),
        "drawn": plan_amount(drawing, Plane.ACCELERATIONS, size),
    }
    if drawing.settled(size) == 0:
        return drawing.words("step.coriolis-none", **fields)
    if not is_drawn(drawing, step, values[number]):
        return drawing.words("step.coriolis-computed", **fields)
    if not first:
        return drawing.words("step.coriolis-again", **fields)
    assert step.by_hand is not None
    base, top = (steps[arg] for arg in steps[step.by_hand].args[:2])
    pivot, pin = base.says["p"], base.says["q"]
    fields |= {
        "p": symbol(pivot),
        "q": symbol(pin),
        "bar": bar(pivot, pin),
        "e": corner_letter(drawing, base),
        "f": corner_letter(drawing, top),
    }
    line = leaning_line(drawing, steps[top.args[1]], fields)
    return drawing.words("step.coriolis", line=line, **fields)


def leaning_line(drawing: Drawing, lean: Step, fields: Mapping[str, str]) -> str:
    """The line that cuts f off: to the tip on the lever itself where every base lies on its own."""
    end = drawing.trace.program.steps[lean.args[3]]
    w = vector_of(drawing, end.args[1], end.args[2], symbol(f"v_{lean.says['q']}"))
    drawn = [step for _, step, _ in drawing.mechanism_steps()]
    if not all(is_along(drawing, step) for step in drawn if step.action is lean.action):
        return drawing.words("step.coriolis-line", w=w, **fields)
    alike = [step for step in drawn if step.action is end.action and step.args == end.args]
    mm = 1000 / drawing.scales.kL
    alike = [step for step in alike if is_coriolis(step) or not no_triangle(drawing, step, mm)]
    tips = [corner_letter(drawing, step) for step in alike if not is_coriolis(step)]
    if not tips:
        return drawing.words("step.coriolis-line-tip", w=w, **fields)
    return drawing.words("step.coriolis-line-letter", tip=tips[0], **fields)


def is_along(drawing: Drawing, lean: Step) -> bool:
    """True where twice a relative velocity, set at the pivot, lies on the line of the lever."""
    base, pivot, pin = (drawing.trace.values[arg] for arg in lean.args[:3])
    beside = abs(cross(pin - pivot, base - pivot)) / abs(pin - pivot)
    return bool(1000 * beside < NAUGHT * drawing.scales.kL)


def with_normals_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The other right triangles said in one sentence, after the one that is said in full.

    It names what is left out too; without it the first one does, or a sentence of its own.
    """
    short = [sentence for sentence in found if sentence.name == "short"]
    if short:
        told = drawing.words("step.too-short", list=", ".join(s.markup for s in short))
        before = [said for said in found if said.name in ("ν", "ν1")][-1:]
        if not before:
            found = together(found, short, told)
        else:
            found = [said for said in found if said not in short]
            one = in_one([*before, *short], before[0].name, f"{before[0].markup}; {told}")
            found[found.index(before[0])] = one
    rest = [sentence for sentence in found if sentence.name == "ν"]
    if not rest:
        return found
    kept = [sentence for sentence in found if sentence.name != "ν"]
    tail = drawing.words("step.normals-again", list=", ".join(s.markup for s in rest))
    firsts = [i for i, sentence in enumerate(kept) if sentence.name == "ν1"]
    if not firsts:
        return together(found, rest, tail)
    place = firsts[0] + 1
    return [*kept[:place], in_one(rest, "ν", tail), *kept[place:]]
