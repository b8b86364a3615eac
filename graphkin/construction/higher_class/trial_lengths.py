"""What is laid off in two trial plans by the rate that each tries, with its drawn length."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.amounts import in_mm
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.naming import drawn_in, has_no_length
from graphkin.construction.core.relation import Relation, answer, figure, length_of
from graphkin.construction.drivers.driven_slide import DrivenSlide
from graphkin.construction.higher_class.misclosure import tried_link
from graphkin.construction.velocity.laid_off_by_rate import LaidOffAboutPivot, LaidOffByRate
from graphkin.drawing.symbol_markup import bar, symbol


def of_trial_lengths(drawing: Drawing) -> Iterator[Relation]:
    """Each vector that a tried rate gives, in the order of drawing; none where nought is tried."""
    for number, step, _ in drawing.steps(drawing.plane):
        kind = construction(step)
        if number not in drawing.tags or not isinstance(kind, LaidOffByRate):
            continue
        rate = kind.tried_rate(step.role)
        if rate is None or has_no_length(drawing, number):
            continue
        tag, size = drawing.tags[number], abs(float(drawing.trace.values[rate]))
        if isinstance(kind, DrivenSlide):
            yield slid(drawing, kind, tag, size)
        elif isinstance(kind, LaidOffAboutPivot):
            yield turned(drawing, kind, tag, tried_link(drawing, rate) or kind.link, size)


def turned(
    drawing: Drawing, vector: LaidOffAboutPivot, tag: str, link: str, rate: float
) -> Relation:
    """What a tried turning gives a pin, square to its bar: rate times bar."""
    p, q, index = vector.p, vector.q, vector.index
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


def slid(drawing: Drawing, vector: DrivenSlide, tag: str, rate: float) -> Relation:
    """What is tried of a slider along its guide, chosen as it is."""
    name = symbol(f"{drawing.sliding.letter}_{vector.point}{tag}")
    drawn = in_mm(drawing.words, drawn_in(drawing, drawing.plane, rate))
    remark = drawing.words("calculation.chosen_drawn", drawn=drawn)
    return Relation(name, "", "", figure(drawing, rate), drawing.sliding.caret_unit, remark)
