"""The words of centres and poles: what is odd about one, and many of them said in one sentence."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.program import Step
from graphkin.construction.core.sentence import Sentence, together
from graphkin.drawing.symbol_markup import symbol
from graphkin.scene.model import FRAME

CENTRES = ("instant-centre", "acceleration-pole", "relative-centre", "inflection-pole")


SAID = ("relative-centre", "inflection-pole")
"""Actions whose sentence hangs on how the plan finds their point."""
STILL = ("instant-centre", "acceleration-pole")
"""Centres and poles that may be a point of the link from which the hand would draw a ray."""


OWN_WORDS = ("kennedy-line", "kennedy-endless", "pin-centre", "guide-centre")
"""Steps of relative centres whose words do not hang on how the centre is found."""


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
    value = drawing.trace.values[drawing.number_of(step)]
    if drawing.is_everywhere(value):
        return "everywhere"
    if drawing.place(value) is None:
        return "far"
    lost = step.by_hand is not None and step.by_hand not in drawing.trace.values
    return "still" if lost and step.action and step.action.key in STILL else ""


def same_centre(drawing: Drawing, step: Step) -> Step | None:
    """The instantaneous centre on this sheet that the centre of a link and the frame is, too."""
    if step.action is None or step.action.key != "relative-centre":
        return None
    pair, own = [step.says.get(key, "") for key in ("j", "k")], drawing.number_of(step)
    link = pair[1] if pair[0] == FRAME else pair[0]
    number = drawing.trace.program.targets.get(("centre", link), own)
    if FRAME not in pair or number == own or number not in drawing.trace.values:
        return None
    return drawing.trace.program.steps[number]


def at_rest(drawing: Drawing, step: Step, fields: dict[str, str]) -> str:
    """What is said of a centre where the normals do not cross: a point at rest, or the tips' line.

    The point is told as ``rest``.
    """
    values, (o, _, _, *images) = drawing.trace.values, step.args
    least = NOISE * (drawing.largest or 1.0)
    for name, image in zip((step.says["p"], step.says["q"]), images, strict=True):
        if abs(values[image] - values[o]) <= least:
            fields["rest"] = symbol(name)
            return "still"
    return "tips"


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
    same = same_centre(drawing, step)
    name = f"{symbol(step.name)} = {symbol(same.name)}" if same else symbol(step.name)
    return f"{name} ({drawing.words('list_mark').join(lines)})"
