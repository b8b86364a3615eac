"""What is laid off in two trial plans by the rate that each tries, with its drawn length."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.amounts import in_mm
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import drawn_in, index_of
from graphkin.construction.core.program import Step
from graphkin.construction.core.relation import Relation, answer, figure, length_of
from graphkin.construction.higher_class.misclosure import tried_link
from graphkin.construction.higher_class.trial_words import RATE_AT
from graphkin.construction.step_sentences import has_no_length
from graphkin.drawing.symbol_markup import bar, symbol


def of_trial_lengths(drawing: Drawing) -> Iterator[Relation]:
    """Each vector that a tried rate gives, in the order of drawing; none where nought is tried."""
    for number, step, _ in drawing.steps(drawing.plane):
        key = step.action.key if step.action else ""
        if number not in drawing.tags or key not in RATE_AT or has_no_length(drawing, number):
            continue
        tag, rate = drawing.tags[number], step.args[RATE_AT[key]]
        size = abs(float(drawing.trace.values[rate]))
        if key == "driven-slide":
            yield slid(drawing, step, tag, size)
        else:
            yield turned(drawing, step, tag, tried_link(drawing, rate) or step.says["k"], size)


def turned(drawing: Drawing, step: Step, tag: str, link: str, rate: float) -> Relation:
    """What a tried turning gives a pin, square to its bar: rate times bar."""
    p, q, index = step.says["p"], step.says["q"], index_of(drawing, step.says)
    length, part = length_of(drawing, p, q), "" if drawing.kind == "velocity" else "^τ"
    drawn = in_mm(drawing.words, drawn_in(drawing, drawing.plane, rate * length))
    return Relation(
        symbol(f"{drawing.vector.letter}_{index}{tag}{part}"),
        f"{symbol(f'{drawing.rate.letter}_{link}{tag}')}·{bar(p, q)}",
        f"{figure(drawing, rate)}·{figure(drawing, length)}",
        answer(drawing, rate * length),
        drawing.vector.caret_unit,
        drawing.words("calculation.square_drawn", bar=bar(p, q), drawn=drawn),
        over=(p, q),
    )


def slid(drawing: Drawing, step: Step, tag: str, rate: float) -> Relation:
    """What is tried of a slider along its guide, chosen as it is."""
    name = symbol(f"{drawing.sliding.letter}_{step.says['q']}{tag}")
    drawn = in_mm(drawing.words, drawn_in(drawing, drawing.plane, rate))
    remark = drawing.words("calculation.chosen_drawn", drawn=drawn)
    return Relation(name, "", "", figure(drawing, rate), drawing.sliding.caret_unit, remark)
