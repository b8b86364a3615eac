"""The words of two trial plans: what was tried, what they miss, and how the right plan divides."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.paper.data import driver_index
from graphkin.paper.drawing import TAGS, Drawing
from graphkin.paper.misses import Miss, driver_of, misses, on_paper, ratio
from graphkin.paper.naming import way_of
from graphkin.paper.phrases import point_sentence
from graphkin.paper.relation import figure
from graphkin.paper.sentence import Sentence, in_one, together
from graphkin.paper.symbolic import symbol
from graphkin.paper.tables import sense
from graphkin.steps.program import Step

RATE_AT = {"turned-velocity": 3, "driven-tangential": 3, "driven-slide": 2}
"""Steps that begin a trial, and at which place they take what is tried."""


def trial_sentence(drawing: Drawing, number: int) -> Iterator[Sentence]:
    """One sentence for a whole trial plan, with its last point: the first is told in full."""
    steps, tag = drawing.trace.program.steps, drawing.tags[number]
    named = [n for n, own in drawing.tags.items() if own == tag and steps[n].name]
    if number != max(named):
        return
    named.sort()
    if tag == TAGS[0]:
        told = "; ".join(point_sentence(drawing, n, steps[n]) for n in named)
    else:
        told = drawing.words("list_mark").join(symbol(steps[n].name) for n in named)
    what, size = tried(drawing, named)
    markup = drawing.words(
        f"step.trial-{TAGS.index(tag) + 1}", what=what, amount=size, how=told, list=told
    )
    yield Sentence(number, f"trial{tag}", markup)


def tried(drawing: Drawing, named: list[int]) -> tuple[str, str]:
    """What a trial tries, and its amount with its unit."""
    steps, values = drawing.trace.program.steps, drawing.trace.values
    velocity = drawing.kind == "velocity"
    for number in named:
        step = steps[number]
        key = step.action.key if step.action else ""
        if key in RATE_AT:
            size = float(values[step.args[RATE_AT[key]]])
            if key == "driven-slide":
                letter = "v" if velocity else "a"
                unit = "m/s" if velocity else "m/s^2"
                return symbol(f"{letter}_{step.says['q']}"), quantity(drawing, size, unit)
            letter, unit = ("ω", "rad/s") if velocity else ("ε", "rad/s^2")
            turning = quantity(drawing, abs(size), unit)
            turning += f" {sense(drawing.words, size)}" if size else ""
            return symbol(f"{letter}_{step.says['k']}"), turning
    return "", ""


def quantity(drawing: Drawing, size: float, unit: str) -> str:
    """An amount with its unit; nought without."""
    return f"{figure(drawing, size)} {unit}" if size else "0"


def share_sentence(drawing: Drawing, number: int, step: Step) -> str:
    """What the trials miss: between which points the gaps are measured, and how large they are."""
    first, second = misses(drawing, step)
    if "d" in step.says:
        return driver_sentence(drawing, step, first, second)
    mm = on_paper(drawing)
    sizes = [drawing.words.fixed(abs(gap.size) * mm, 2) for gap in (first, second)]
    fields = {
        "one": first.point,
        "two": second.point,
        "first": sizes[0],
        "second": sizes[1],
        "side": drawing.words(
            f"step.gap-{'alike' if first.size * second.size > 0 else 'opposite'}"
        ),
    }
    lines = {"locus": first.line(drawing), "other": second.line(drawing)}
    return drawing.words("step.share-lines", **lines, **fields)


def driver_sentence(drawing: Drawing, step: Step, first: Miss, second: Miss) -> str:
    """What the trials miss of what a driver gives, in mm of the plan or in its rate."""
    driver, given = driver_of(drawing, step), first.found - first.size
    sizes = {
        "a": first.found,
        "b": second.found,
        "given": given,
        "first": first.size,
        "second": second.size,
    }
    if driver.kind == "turn":
        letter, unit = ("ω", "rad/s") if drawing.kind == "velocity" else ("ε", "rad/s^2")
        fields = {key: figure(drawing, size) for key, size in sizes.items()}
        what = f"*{letter}*_{{{driver_index(driver)}}}"
        return drawing.words("step.share-turn", what=what, unit=unit, **fields)
    mm = on_paper(drawing)
    fields = {key: drawing.words.fixed(size * mm, 2) for key, size in sizes.items()}
    return drawing.words(
        "step.share-slide",
        guide=way_of(drawing, driver.link),
        one=first.point,
        two=second.point,
        **fields,
    )


def with_trials_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The points that divide the lines of two trials said in one sentence."""
    steps, values = drawing.trace.program.steps, drawing.trace.values
    crossed = [said for said in found if is_divided(drawing, said, hand=True)]
    divided = [said for said in found if is_divided(drawing, said, hand=False)]
    if crossed:
        found = [said for said in found if said.name != "share"]
    if not divided:
        return found
    listed = drawing.words("list_mark").join(symbol(steps[s.step].name) for s in divided)
    if not crossed:
        number = divided[0].step
        first, second = misses(drawing, steps[steps[number].args[2]])
        mm = on_paper(drawing)
        fields = ratio(drawing, number, first.size * mm, second.size * mm)
        return together(found, divided, drawing.words("step.divided", list=listed, **fields))
    number = crossed[-1].step
    one, two = (values[arg] for arg in steps[number].args[:2])
    part, mm = float(values[steps[number].args[2]]), abs(two - one) * on_paper(drawing)
    fields = ratio(drawing, number, part * mm, (part - 1) * mm)
    markup = drawing.words("step.divided-alike", list=listed, **fields)
    kept = [said for said in found if said not in divided]
    place = max(i for i, said in enumerate(kept) if is_divided(drawing, said, hand=True)) + 1
    return [*kept[:place], in_one(divided, "divided", markup), *kept[place:]]


def is_divided(drawing: Drawing, said: Sentence, *, hand: bool) -> bool:
    """True for a point of the right plan on the line of its trials, by a crossing or without."""
    if said.step < 0:
        return False
    step = drawing.trace.program.steps[said.step]
    between = step.action is not None and step.action.key == "between"
    return between and (step.by_hand in drawing.trace.values) is hand
