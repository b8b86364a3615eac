"""The construction in words: one numbered sentence for each point that is found, in order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from graphkin.paper.centre_words import with_centres_together
from graphkin.paper.closing import closing_sentence, idle_sentences
from graphkin.paper.drawing import Drawing
from graphkin.paper.indices import with_indices
from graphkin.paper.letters import is_coriolis, letter_on
from graphkin.paper.naming import (
    NAUGHT,
    amount,
    height_above,
    plan_amount,
    rate_symbol,
    vector_of,
    way_of,
)
from graphkin.paper.phrases import SWINGS, point_sentence
from graphkin.paper.richtext import escape
from graphkin.paper.sentence import Sentence, in_one, together
from graphkin.paper.stages import READ_OFF
from graphkin.paper.symbolic import bar, symbol
from graphkin.paper.trials import share_sentence, trial_sentence, with_trials_together
from graphkin.plane import cross
from graphkin.steps.program import Part, Plane, Step

COMPONENTS = ("normal", "coriolis")
"""Components that a triangle on the mechanism gives: in full the first time."""


def sentences(drawing: Drawing) -> list[Sentence]:
    """What to draw on a sheet, in the order of drawing, and what to read off at the end."""
    found: list[Sentence] = []
    if drawing.again:
        found.append(Sentence(-1, "again", drawing.words("step.again")))
    found += said_of_steps(drawing)
    if not drawing.again:
        steps = drawing.trace.program.steps
        place = sum(said.step >= 0 and steps[said.step].part is Part.POSITION for said in found)
        found[place:place] = idle_sentences(drawing)
    found += [
        Sentence(-1, curve.kind, drawing.words(f"step.{curve.kind}", of=symbol(curve.of)))
        for curve in drawing.curves
        if curve.kind not in ("fixed-centrode", "locus")
    ]
    last = Sentence(-1, "", read_off(drawing))
    found = with_centres_together(drawing, with_trials_together(drawing, found))
    return with_indices(drawing, [*with_normals_together(drawing, found), last])


def read_off(drawing: Drawing) -> str:
    """What is read off at the end; how a link turns only where the sheet says that one does."""
    words, velocity = drawing.words, drawing.kind == "velocity"
    turns = any(drawing.turning(link) is not None for link in drawing.scene.links)
    turning = words(f"step.read-{'omega' if velocity else 'epsilon'}") if turns else ""
    part = Part.VELOCITY if velocity else Part.ACCELERATION
    set_on = [
        symbol(step.says["symbol"])
        for _, step, arrow in drawing.steps(Plane.MECHANISM)
        if step.action and step.action.key in READ_OFF and step.part is part
        if abs(arrow.tip - arrow.tail) * 1000 > NAUGHT * drawing.scales.kL
    ]
    named = words("list_mark").join(dict.fromkeys(set_on))
    if not named:
        return words("step.read-none", turning=turning)
    return words("step.read-off", list=named, turning=turning)


def said_of_steps(drawing: Drawing) -> Iterator[Sentence]:
    """The sentences of the steps of a sheet, in their order."""
    shown: set[str] = set()
    for number, step, value in drawing.steps(Plane.MECHANISM, drawing.plane, Plane.NUMBERS):
        key = step.action.key if step.action else ""
        if key in COMPONENTS:
            first = key not in shown and is_drawn(drawing, step, value)
            shown |= {key} if first else set()
            yield component_sentence(drawing, number, step, first=first)
        elif number in drawing.tags:
            yield from trial_sentence(drawing, number)
        elif key in OWN and is_own(drawing, step):
            if markup := OWN[key](drawing, number, step):
                yield Sentence(number, key, markup)
        elif is_found_point(drawing, number, step) and not is_again(drawing, step):
            divided = key == "between" and step.by_hand not in drawing.trace.values
            markup = "" if divided else point_sentence(drawing, number, step)
            yield Sentence(number, step.name, markup)


def is_again(drawing: Drawing, step: Step) -> bool:
    """True for a step that the sheet before has shown: the mechanism itself."""
    return drawing.again and step.part is Part.POSITION


def is_own(drawing: Drawing, step: Step) -> bool:
    """True for a step that this sheet is about: not what the sheet before has found."""
    found_before = (Part.POSITION, Part.VELOCITY) if drawing.kind == "acceleration" else ()
    return not is_again(drawing, step) and step.part not in found_before


def is_found_point(drawing: Drawing, number: int, step: Step) -> bool:
    """True for a step that finds a point, a pole or a centre of this sheet."""
    if step.action is None or not step.name or step.arrow or number in drawing.results:
        return False
    if step.plane is Plane.MECHANISM:
        wanted = Part.CENTRE if drawing.kind == "velocity" else Part.POLE
        return step.part in (Part.POSITION, wanted) and step.name not in drawing.scene.frame.points
    return step.plane is drawing.plane and step.action.key != "pole"


# --- sentences of their own ----------------------------------------------------------------------


def swing_sentence(drawing: Drawing, number: int, step: Step) -> str:
    """A lever laid through a pin; at an offset as the tangent by Thales' circle."""
    says = step.says
    key = "step.swing" if step.by_hand in drawing.trace.values else "step.swing-through"
    return drawing.words(
        key,
        p=symbol(says["p"]),
        q=symbol(says["q"]),
        k=escape(says["k"]),
        bar=bar(says["p"], says["q"]),
        radius=amount(drawing, height_above(drawing, step)) if len(step.args) > 2 else "",
    )


def rolling_sentence(drawing: Drawing, number: int, step: Step) -> str:
    """The acceleration of a rolling point of contact, which goes to the wheel's centre."""
    says, size = step.says, abs(drawing.trace.values[number])
    return drawing.words(
        "step.rolling-normal",
        a=symbol(f"a_{says['i']}^ν"),
        bar=bar(says["p"], says["q"]),
        p=symbol(says["p"]),
        q=symbol(says["q"]),
        omega=rate_symbol(drawing, step.args[2]),
        drawn=plan_amount(drawing, size, Plane.ACCELERATIONS),
    )


def laid_off_sentence(drawing: Drawing, number: int, step: Step) -> str:
    """A Coriolis component laid off between points that are known: what is left is the guide's.

    Nothing where a line is drawn from its end: the point on that line tells of it.
    """
    steps = drawing.trace.program.steps
    users = [steps[user] for user in drawing.children.get(number, ())]
    left = [user for user in users if user.arrow and user.says.get("kind") == "r"]
    if not left or not all(user.arrow or user.part is Part.RESULT for user in users):
        return ""
    return drawing.words(
        "step.coriolis-laid",
        s=symbol(step.says["s"]),
        c=symbol(f"a_{step.says['i']}^c"),
        r=symbol(left[0].says["symbol"]),
        q=symbol(steps[left[0].args[1]].name),
        guide=way_of(drawing, steps[step.args[1]].says["g"]),
    )


OWN: dict[str, Callable[[Drawing, int, Step], str]] = {
    **dict.fromkeys(SWINGS, swing_sentence),
    "rolling-normal": rolling_sentence,
    "close": closing_sentence,
    "lay-off-coriolis": laid_off_sentence,
    "share": share_sentence,
}
"""Steps that find no point by themselves and have a sentence all the same."""


# --- normal and Coriolis components --------------------------------------------------------------


def is_drawn(drawing: Drawing, step: Step, value: Any) -> bool:
    """True for a component that is drawn on the mechanism and is not nought."""
    return step.by_hand in drawing.trace.values and drawing.settled(abs(value)) > 0


def component_sentence(drawing: Drawing, number: int, step: Step, *, first: bool) -> Sentence:
    """The triangle of a normal or Coriolis component; for the others only from what it comes."""
    assert step.action is not None
    if step.action.key == "normal":
        if drawing.scales.apart:
            return Sentence(number, "ν by number", computed_normal(drawing, number, step))
        if drawing.settled(abs(drawing.trace.values[number])) == 0:
            fields = {"a": symbol(f"a_{step.says['i']}^ν"), "v": symbol("v_" + step.says["v"])}
            return Sentence(number, "ν none", drawing.words("step.normal-none", **fields))
        markup = normal_sentence(drawing, step, first=first)
        return Sentence(number, "ν1" if first else "ν", markup)
    return Sentence(number, "c", coriolis_sentence(drawing, number, step, first=first))


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
        drawn=plan_amount(drawing, size, Plane.ACCELERATIONS),
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
        "drawn": plan_amount(drawing, size, Plane.ACCELERATIONS),
    }
    if drawing.settled(size) == 0:
        return drawing.words("step.coriolis-none", **fields)
    if step.by_hand is None or step.by_hand not in values:
        return drawing.words("step.coriolis-computed", **fields)
    if not first:
        return drawing.words("step.coriolis-again", **fields)
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
    """The other right triangles said in one sentence, after the one that is said in full."""
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
