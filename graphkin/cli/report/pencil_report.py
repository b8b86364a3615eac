"""The text and JSON of solve --pencil: the crossings, and the predicted errors of drawings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees, isfinite
from typing import Any

from graphkin.accuracy.pencil import Expected, Forecast
from graphkin.cli.report.solution_record import real
from graphkin.construction.core.component import TriangleComponent
from graphkin.construction.core.crossings import (
    Crossing,
    crossings,
    flattest,
    is_found_by_closing,
    letter_of,
)
from graphkin.construction.core.kind import construction
from graphkin.construction.core.program import Part, Program, Step, plan_vector
from graphkin.text.tables import at_the_point, listed, table

UNSURE = 0.1
"""The relative error above which not even the first digit read off is sure."""
NOUGHT = 1e-6
"""The length, in mm, below which a drawn answer is zero and has no error in percent."""
NONE = "–"
"""The sign for an empty cell."""
DRAWN_IN = {
    Part.POSITION: "mechanism",
    Part.VELOCITY: "velocity plan",
    Part.ACCELERATION: "acceleration plan",
    Part.CENTRE: "centre",
    Part.POLE: "acceleration pole",
    Part.FORCE: "force plan",
}
"""The drawing of a crossing, if its construction does not name one."""


def pencil_record(found: Forecast) -> dict[str, Any]:
    """The effect of a pencil on the requested quantities, in SI units; infinite errors are null."""
    crossed = crossings(found.original.trace)
    worst = flattest(crossed)
    return {
        "point": found.pencil.point,
        "line": found.pencil.degrees,
        "answers": answers_record(found),
        "crossings": [crossing_record(found, each) for each in crossed],
        "worst": None if worst is None else crossing_record(found, worst),
        "warnings": list(warnings(found)),
    }


def answers_record(found: Forecast) -> dict[str, dict[str, Any]]:
    """The predicted error of each answer, under its quantity and its point or link."""
    record: dict[str, dict[str, Any]] = {}
    for each in found.expected:
        quantity, of = each.answer.target
        record.setdefault(quantity, {})[of] = {
            "predicted": real(each.error),
            "unit": each.answer.unit,
            "relative": real(relative(each)),
            "millimetres": real(each.millimetres),
            "mostly": mostly(found, each),
        }
    return record


def crossing_record(found: Forecast, crossing: Crossing) -> dict[str, Any]:
    """A crossing: letter, drawing, lines, angle, and the error that 1 mm becomes."""
    return {
        "point": crossing.name,
        "in": drawing_of(found, crossing),
        "lines": lines_words(found.original.program, crossing.number),
        "angle": degrees(crossing.angle),
        "factor": real(crossing.factor),
    }


def pencil_lines(found: Forecast) -> Iterator[str]:
    """The errors of the requested quantities, the crossings, and the worst crossing in words."""
    pencil = found.pencil
    if not found.expected:
        yield "pencil   nothing that is asked is read off a drawing"
        return
    yield (
        f"pencil   in 95 of 100, marks lie within {pencil.point:g} mm, lines within"
        f" {pencil.degrees:g}°; so in 95 of 100 drawings answers are off by at most"
    )
    yield from errors_table(found)
    crossed = crossings(found.original.trace)
    if crossed:
        yield ""
        yield from crossings_table(found, crossed)
    worst = flattest(crossed)
    if worst is not None:
        yield ""
        yield worst_words(found, worst)


def errors_table(found: Forecast) -> list[str]:
    """Each answer with its error in its own unit, in percent, and in mm of the plan."""
    every = found.expected
    shares = [relative(each) for each in every]
    return table(
        ("answer", "", "size", "error", "unit", "%", "mm drawn", "mostly from"),
        list(
            zip(
                (each.answer.target[0] for each in every),
                (each.answer.target[1] for each in every),
                (
                    None if share is None else each.answer.size
                    for each, share in zip(every, shares, strict=True)
                ),
                rough([each.error for each in every], endless="may not close"),
                (each.answer.unit for each in every),
                rough([None if share is None else 100 * share for share in shares]),
                rough([each.millimetres for each in every]),
                (mostly(found, each) for each in every),
                strict=True,
            )
        ),
    )


def crossings_table(found: Forecast, crossed: tuple[Crossing, ...]) -> list[str]:
    """Each crossing with its angle and the error that 1 mm becomes there."""
    program = found.original.program
    return table(
        ("crossing", "in", "of", "angle, °", "1 mm becomes, mm"),
        list(
            zip(
                (crossing.name or NONE for crossing in crossed),
                (drawing_of(found, crossing) for crossing in crossed),
                (lines_words(program, crossing.number) or NONE for crossing in crossed),
                at_the_point([f"{degrees(crossing.angle):.1f}" for crossing in crossed]),
                at_the_point([f"{crossing.factor:.1f}" for crossing in crossed]),
                strict=True,
            )
        ),
    )


def drawing_of(found: Forecast, crossing: Crossing) -> str:
    """The drawing of a crossing."""
    kind = construction(found.original.program.steps[crossing.number])
    return kind.drawn_in if isinstance(kind, TriangleComponent) else DRAWN_IN[crossing.part]


def rough(values: Sequence[float | None], endless: str = NONE) -> list[str]:
    """Numbers with the two digits that an estimate is worth, aligned at the decimal point."""
    known = [None if value is None else two_digits(value) or endless for value in values]
    texts = at_the_point([text or NONE for text in known])
    width = max(map(len, texts), default=0)
    return [text.rjust(width) for text in texts]


def two_digits(value: float) -> str:
    """A number with two significant digits; empty for an infinite one."""
    if not isfinite(value):
        return ""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:#.2g}".rstrip(".")


def worst_words(found: Forecast, worst: Crossing) -> str:
    """The flattest crossing in a sentence."""
    lines = lines_words(found.original.program, worst.number)
    where = f"{worst.name or 'a point'} ({drawing_of(found, worst)})"
    who = f"{lines} cross" if lines else "the lines cross"
    return (
        f"worst    {where}: {who} at {degrees(worst.angle):.1f}°, "
        f"a 1 mm drawing error grows to as much as {worst.factor:.1f} mm"
    )


def warnings(found: Forecast) -> Iterator[str]:
    """Why the lab should not be drawn by hand with this pencil: answers that are too uncertain."""
    unsure = [each for each in found.expected if (relative(each) or 0.0) > UNSURE]
    if unsure:
        names = listed(answer_words(each) for each in unsure)
        yield (
            f"should not be drawn by hand with a {found.pencil.point:g} mm pencil: not even the"
            f" first digit is sure of {names}"
        )


def answer_words(each: Expected) -> str:
    """An answer and its error in percent."""
    quantity, of = each.answer.target
    share = relative(each)
    known = share is not None and isfinite(share)
    return f"{quantity} of {of} ({100 * (share or 0.0):.0f} %)" if known else f"{quantity} of {of}"


def relative(each: Expected) -> float | None:
    """The relative error of an answer; None for a place, and for an answer that is zero."""
    size = each.answer.size
    least = NOUGHT * (each.answer.millimetre or each.error)
    return None if size is None or size <= least else each.relative


def mostly(found: Forecast, each: Expected) -> str:
    """The main source of an error: the mark by its letter, or the line or arc."""
    return "" if each.heaviest is None else step_words(found.original.program, each.heaviest)


def step_words(program: Program, number: int) -> str:
    """A step as the drawing names it."""
    step = program.steps[number]
    own = step.name or line_words(program, step) or arrow_end(program, number)
    return own or letter_of(program, number)


def arrow_end(program: Program, number: int) -> str:
    """The end of an arrow that has no letter; empty if no such arrow ends there."""
    arrows = (step for step in program.steps if step.arrow and step.args[1:2] == (number,))
    component = next((v for step in arrows if (v := plan_vector(step)) and v.sign), None)
    return "" if component is None else f"the end of {component.symbol}"


def line_words(program: Program, step: Step) -> str:
    """A line or an arc by what it is perpendicular or parallel to; empty for other steps."""
    kind = construction(step)
    return kind.line_name(program.steps, step.role) if kind is not None else ""


def lines_words(program: Program, number: int) -> str:
    """The two lines or arcs of a crossing; empty if they have no name."""
    if is_found_by_closing(program.steps[number]):
        return "the locus and what was cut"
    both = [line_words(program, program.steps[arg]) for arg in program.steps[number].args[:2]]
    return " and ".join(both) if len(both) == 2 and all(both) else ""
