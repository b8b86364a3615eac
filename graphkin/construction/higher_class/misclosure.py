"""What two trial plans miss: the gap of each, between which points, and how long on paper."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from graphkin.construction.core.component import component_of, index_before, laid_off
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import scale_of, way_of
from graphkin.construction.core.program import Plane, Step
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.scene.model import Driver


@dataclass(frozen=True, slots=True)
class Misclosure:
    """The gap of a trial: ``size`` from its ``point`` to the line ``locus``, on which it should be.

    ``locus`` is the key of the words for that line, ``fields`` what fills their gaps. Where a
    driver gives what is missed, ``found`` is what the trial has of it, in the plan as ``point``.
    """

    size: float
    point: str = ""
    locus: str = "given"
    fields: Mapping[str, str] = field(default_factory=dict)
    found: float = 0.0

    def line(self, drawing: Drawing) -> str:
        """The line on which the trial's point should be."""
        return drawing.words(f"step.gap-{self.locus}", **self.fields)

    def remark(self, drawing: Drawing) -> str:
        """Between what the gap is measured, in few words; nothing where it is none of a plan."""
        if not self.point:
            return ""
        return drawing.words(f"calculation.gap-{self.locus}", one=self.point, **self.fields)


def misses(drawing: Drawing, share: Step) -> tuple[Misclosure, Misclosure]:
    """The gaps of the two trials."""
    first, second = (miss(drawing, number, share) for number in share.args)
    return first, second


def miss(drawing: Drawing, number: int, share: Step) -> Misclosure:
    """The gap of one trial."""
    steps, values = drawing.trace.program.steps, drawing.trace.values
    step, size = steps[number], float(values[number])
    if "d" in share.says:
        found = float(values[step.args[0]])
        if driver_of(drawing, share).kind == "turn":
            return Misclosure(size, found=found)
        _, start, image = (steps[arg] for arg in steps[step.args[0]].args)
        along = symbol(start.name) + symbol(image.name)
        if not start.name:
            before = steps[step.args[0]].args[1]
            along = symbol(f"a_{index_before(drawing.trace.program, before)}^r")
        return Misclosure(size, along, found=found)
    if "g" in share.says:
        begun, ended = step.args[1:]
        return Misclosure(size, symbol(steps[ended].name), *along_guide(drawing, begun, share))
    return Misclosure(size, symbol(steps[step.args[3]].name), *across_bar(drawing, step))


def driver_of(drawing: Drawing, share: Step) -> Driver:
    """The driver that two trials do not meet."""
    return next(d for d in drawing.scene.drivers if d.link == share.says["d"])


def tried_link(drawing: Drawing, number: int) -> str:
    """The link whose rate a step holds, if two trial plans try it; else nothing."""
    for _, share, _ in drawing.steps(Plane.NUMBERS):
        called = share.action is not None and share.action.key == "share"
        if called and str(number) in share.says["tried"].split():
            return str(share.says["k"])
    return ""


def on_paper(drawing: Drawing) -> float:
    """The millimetres of paper that a unit of the plan takes up."""
    return 1000 / scale_of(drawing, drawing.plane)


def along_guide(drawing: Drawing, start: int, share: Step) -> tuple[str, dict[str, str]]:
    """The line on which the point of a block should lie: parallel to its guide."""
    fields = {"guide": way_of(drawing, share.says["g"])}
    steps, laid = drawing.trace.program.steps, laid_off(drawing.trace.program, start)
    if laid is None:
        return "parallel", {**fields, "s": symbol(steps[start].name)}
    fields |= {"a": laid.component.symbol, "s": symbol(steps[laid.start].name)}
    return "parallel-end", fields


def across_bar(drawing: Drawing, step: Step) -> tuple[str, dict[str, str]]:
    """The line on which a pin should lie: square to its bar, at the end of a normal component."""
    steps = drawing.trace.program.steps
    p, q = (steps[arg].name for arg in step.args[:2])
    fields = {"bar": bar(p, q), "s": symbol(steps[step.args[2]].name), "p": symbol(p)}
    component = component_of(drawing.trace.program, step.args[4])
    if component is None:
        return "square", fields
    return "square-end", {**fields, "a": component.symbol}


def ratio(drawing: Drawing, number: int, first: float, second: float) -> dict[str, str]:
    """How a point divides the line of its two trials, and beyond which of them, if not between.

    ``first`` and ``second`` are the gaps, or the parts of the line, of one sign on one side.
    """
    steps = drawing.trace.program.steps
    one, two = (symbol(steps[arg].name) for arg in steps[number].args[:2])
    point = symbol(steps[number].name)
    parts = f"{one}{point} : {point}{two}"
    sizes = " : ".join(drawing.words.fixed(abs(size), 2) for size in (first, second))
    beyond = ""
    if first * second > 0:
        end = two if abs(first) > abs(second) else one
        beyond = drawing.words("step.divided-beyond", end=end)
    return {"ratio": f"{parts} = {sizes}", "beyond": beyond}
