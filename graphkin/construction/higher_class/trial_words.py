"""The words of two trial plans: what was tried, what they miss, and how the right plan divides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from graphkin.construction.acceleration.turned_acceleration import TurnedAcceleration
from graphkin.construction.core.drawn_scene import TAGS, Drawing
from graphkin.construction.core.given_data import driver_index
from graphkin.construction.core.kind import construction
from graphkin.construction.core.line_words import heading
from graphkin.construction.core.naming import has_no_length, way_of
from graphkin.construction.core.program import Step
from graphkin.construction.core.relation import figure
from graphkin.construction.core.sentence import Sentence, in_one, together
from graphkin.construction.drivers.driven_slide import DrivenSlide
from graphkin.construction.higher_class.coincident_images import fallen_on
from graphkin.construction.higher_class.misclosure import (
    Misclosure,
    driver_of,
    misses,
    on_paper,
    ratio,
)
from graphkin.construction.result_tables import sense
from graphkin.construction.step_sentences import point_sentence
from graphkin.construction.velocity.laid_off_by_rate import LaidOffAboutPivot, LaidOffByRate
from graphkin.drawing.symbol_markup import symbol


def trial_sentence(drawing: Drawing, number: int) -> Iterator[Sentence]:
    """One sentence for a whole trial plan, with its last point."""
    tag = drawing.tags[number]
    named = points_of(drawing, tag)
    if number != named[-1]:
        return
    told = first_told(drawing, named) if tag == TAGS[0] else again_told(drawing, named)
    what, size = tried(drawing, named)
    key = f"step.trial-{TAGS.index(tag) + 1}"
    markup = drawing.words(key, what=what, amount=size, how="; ".join(told))
    yield Sentence(number, f"trial{tag}", markup, tuple(named))


def points_of(drawing: Drawing, tag: str) -> list[int]:
    """The steps that find the points of a trial plan, in their order."""
    steps = drawing.trace.program.steps
    return sorted(n for n, own in drawing.tags.items() if own == tag and steps[n].name)


def first_told(drawing: Drawing, named: Sequence[int]) -> Iterator[str]:
    """The points of the first trial in full; those that fall on what they are drawn from in one."""
    for under, run in groupby(named, lambda number: fallen_on(drawing, number)):
        if under:
            fallen = list(run)
            key = "falls" if len(fallen) == 1 else "fall-together"
            yield of_many(drawing, key, fallen, s=symbol(under))
        else:
            yield from (point_of_trial(drawing, number) for number in run)


def again_told(drawing: Drawing, named: Sequence[int]) -> Iterator[str]:
    """The points of the second trial: in full where other lengths or more lines are drawn."""
    steps = drawing.trace.program.steps
    first = {steps[n].name[:-1]: n for n in points_of(drawing, TAGS[0])}

    def is_new(number: int) -> bool:
        before = first.get(steps[number].name[:-1])
        return (
            begun_by(steps[number]) is not None
            or before is None
            or bool(fallen_on(drawing, before))
        )

    for new, run in groupby(named, is_new):
        if new:
            yield from (turned_again(drawing, number) for number in run)
        else:
            yield of_many(drawing, "normals-again", list(run))


def turned_again(drawing: Drawing, number: int) -> str:
    """How a point of the second trial is found, its normal component being that of the first."""
    kind = construction(drawing.trace.program.steps[number])
    if not isinstance(kind, TurnedAcceleration) or kind.is_steady:
        return point_of_trial(drawing, number)
    if has_no_length(drawing, kind.end) or has_no_length(drawing, number):
        return point_of_trial(drawing, number)
    fields, normal = (kind.fields(drawing, role) for role in ("image", "end"))
    return drawing.words("step.driven-again", normal=normal["vector"], **fields)


def point_of_trial(drawing: Drawing, number: int) -> str:
    """How a point of a trial plan is found."""
    return point_sentence(drawing, number, drawing.trace.program.steps[number])


def of_many(drawing: Drawing, key: str, numbers: Sequence[int], **fields: str) -> str:
    """The words for several points of a trial plan."""
    steps = drawing.trace.program.steps
    listed = drawing.words("list_mark").join(symbol(steps[number].name) for number in numbers)
    return drawing.words(f"step.{key}", name=listed, list=listed, **fields)


def tried(drawing: Drawing, named: list[int]) -> tuple[str, str]:
    """What a trial tries, and its amount with its unit."""
    steps, values = drawing.trace.program.steps, drawing.trace.values
    for number in named:
        step = steps[number]
        rate, kind = begun_by(step), construction(step)
        if rate is not None:
            size = float(values[rate])
            if isinstance(kind, DrivenSlide):
                sliding = quantity(drawing, abs(size), drawing.sliding.caret_unit)
                if size:
                    way = heading(values[number] - values[step.args[0]])
                    sliding += f" {drawing.words(f'page.to_{way}')}"
                return symbol(f"{drawing.sliding.letter}_{kind.point}"), sliding
            turning = quantity(drawing, abs(size), drawing.rate.caret_unit)
            turning += f" {sense(drawing.words, size)}" if size else ""
            assert isinstance(kind, LaidOffAboutPivot)
            return symbol(f"{drawing.rate.letter}_{kind.link}"), turning
    return "", ""


def begun_by(step: Step) -> int | None:
    """The rate by which a step lays off a vector, with which a trial begins; None for others."""
    kind = construction(step)
    return kind.tried_rate(step.role) if isinstance(kind, LaidOffByRate) else None


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


def driver_sentence(drawing: Drawing, step: Step, first: Misclosure, second: Misclosure) -> str:
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
        fields = {key: figure(drawing, size) for key, size in sizes.items()}
        fields["unit"] = drawing.rate.caret_unit
        what = f"*{drawing.rate.letter}*_{{{driver_index(driver)}}}"
        return drawing.words("step.share-turn", what=what, **fields)
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
