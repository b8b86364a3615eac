"""What the symbols on a page mean, for whoever sees them for the first time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.construction.core.plan_vector import PlanVector, plan_vector
from graphkin.construction.core.program import Part, Step
from graphkin.drawing.style import BY_SIGN
from graphkin.drawing.symbol_markup import symbol
from graphkin.text import Words
from graphkin.web.screen_sheets import ScreenSheet

Arrow = tuple[Step, PlanVector]
PLANS = {
    "velocity": ("*k*_v", "*ω*", "legend.omega"),
    "acceleration": ("*k*_a", "*ε*", "legend.epsilon"),
}
"""The scale of each plan, and what a link's turning is called on its sheet."""
FOUND = {Part.CENTRE: ("*I*", "legend.centre"), Part.POLE: ("*J*", "legend.pole")}
"""The letters of what is found on the mechanism."""


def meanings(words: Words, sheets: Sequence[ScreenSheet]) -> Iterator[tuple[str, str]]:
    """Each symbol and what it means, as markup."""
    yield "*k*_L", words("legend.kL")
    for sheet in sheets:
        drawing = sheet.drawing
        scale, rate, turning = PLANS[drawing.kind]
        unit = words(f"table.{drawing.kind}")
        yield scale, words("legend.scale", plan=words(f"sheet.{drawing.kind}"), unit=unit)
        yield symbol(drawing.pole), words("legend.at_rest")
        steps = [step for _, step, _ in drawing.steps(drawing.plane)]
        arrows = [(step, vector) for step in steps if (vector := plan_vector(step))]
        yield from images(words, arrows, sheet)
        yield from components(words, arrows)
        yield rate, words(turning)
        parts = {drawing.trace.program.steps[number].part for number in drawing.trace.values}
        own = parts & {Part.CENTRE if drawing.kind == "velocity" else Part.POLE}
        yield from ((term, words(key)) for part, (term, key) in FOUND.items() if part in own)


def images(words: Words, arrows: Sequence[Arrow], sheet: ScreenSheet) -> Iterator[tuple[str, str]]:
    """The segments that are the vector of a point, and of one point relative to another."""
    steps = sheet.drawing.trace.program.steps
    whole = [(step, vector) for step, vector in arrows if not vector.sign]
    for key, has_pivot in (("legend.image", False), ("legend.relative", True)):
        for step, found in [each for each in whole if bool(each[1].p) is has_pivot][:1]:
            names = {"q": found.q, "p": found.p, "symbol": found.symbol}
            fields = {key: symbol(name or "o") for key, name in names.items()}
            yield "".join(symbol(steps[arg].name) for arg in step.args), words(key, **fields)


def components(words: Words, arrows: Sequence[Arrow]) -> Iterator[tuple[str, str]]:
    """The components of accelerations by their signs, in the order in which they are drawn."""
    kinds = dict.fromkeys(vector.sign for _, vector in arrows if vector.sign)
    yield from (
        (symbol(f"a^{kind}"), words(BY_SIGN[kind].legend)) for kind in kinds if kind in BY_SIGN
    )
