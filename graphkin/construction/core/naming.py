"""What steps are called in sentences and relations: their vectors, guides and drawn lengths."""

from __future__ import annotations

from typing import Any

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Drive, Plane, Step
from graphkin.construction.core.quantities import OnPaper, in_mm
from graphkin.drawing.scale import digits
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.scene.model import FRAME, Driver, Scene
from graphkin.text import Words

NAUGHT = 1e-6
"""A vector drawn shorter than this, in mm, is none."""


def has_plan(drawing: Drawing) -> bool:
    """Whether anything is drawn in the plan of a sheet: paths and fixed centres need none."""
    return any(True for _ in drawing.steps(drawing.plane))


def called(drawing: Drawing) -> str:
    """What a sheet is called by: its plan, or the mechanism alone where it has none."""
    return drawing.kind if has_plan(drawing) else "mechanism"


def way_of(drawing: Drawing, name: str) -> str:
    """A guide by its block, a straight track by its wheel; on a fixed wheel by its bar."""
    scene = drawing.scene
    if name in scene.keepers:
        name = scene.keepers[name][0]
    if name == FRAME:
        on = next(track for name, track in scene.touching if name == FRAME)
        return drawing.words("page.track_of_bar", g=escape(on))
    link = scene.links.get(name)
    key = "page.guide_of" if link is None or link.slides else "page.track_of"
    return drawing.words(key, g=escape(name))


def arrow_of(drawing: Drawing, tail: int, tip: int) -> Step | None:
    """The arrow between two points of a plan, or others on which they fall, whichever its sense."""
    found = drawing.joins.get((tail, tip)) or drawing.joins.get((tip, tail))
    if found:
        return found
    ends = {fallen(drawing, tail), fallen(drawing, tip)}
    joins = drawing.joins.items()
    return next((step for pair, step in joins if {fallen(drawing, n) for n in pair} == ends), None)


def fallen(drawing: Drawing, number: int) -> int:
    """The image on which that of a point of a link that only shifts falls, or the image itself."""
    kind = construction(drawing.trace.program.steps[number])
    under = kind.falls_on if kind else None
    return number if under is None else under


def vector_of(drawing: Drawing, tail: int, tip: int, default: str = "") -> str:
    """Markup of the vector between two points of a plan."""
    arrow = arrow_of(drawing, tail, tip)
    found = plan_vector(arrow) if arrow else None
    return symbol(found.symbol) if found else default


def scale_of(drawing: Drawing, plane: Plane) -> float:
    """What a metre of paper stands for in a plan."""
    return drawing.scales.kv if plane is Plane.VELOCITIES else drawing.scales.ka


def length_scale(drawing: Drawing) -> str:
    """kL in metres for each millimetre of paper, as lengths and both other scales are told."""
    return drawing.words.decimal(digits(drawing.scales.kL / 1000))


def drawn_in(drawing: Drawing, plane: Plane, size: float) -> OnPaper:
    """How long a vector of a given size is drawn in a plan."""
    return OnPaper(float(1000 * size / scale_of(drawing, plane)))


def drawn_between(drawing: Drawing, tail: int, tip: int, plane: Plane) -> OnPaper:
    """How long a vector of a plan is drawn."""
    values = drawing.trace.values
    return drawn_in(drawing, plane, abs(values[tip] - values[tail]))


def has_no_length(drawing: Drawing, number: int) -> bool:
    """True for a vector that is laid off from a point of a plan and is nought."""
    start = drawing.trace.program.steps[number].args[0]
    values = drawing.trace.values
    return not drawing.settled(abs(values[number] - values[start]))


def rate_symbol(drawing: Drawing, number: int, letter: str = "ω") -> str:
    """Markup of an angular velocity or acceleration by the step that holds it."""
    step = drawing.trace.program.steps[number]
    if step.name in drawing.scene.links:
        return symbol(f"{letter}_{step.name}")
    if isinstance(step.of, Drive):
        return symbol(f"{letter}_{drawing.scene.drivers[step.of.driver].link}")
    return f"*{letter}*"


def is_driven(drawing: Drawing, number: int) -> bool:
    """True for a rate that the scene gives."""
    return isinstance(drawing.trace.program.steps[number].of, Drive)


def driver_of_rate(drawing: Drawing, number: int) -> Driver | None:
    """The driver whose given rate a step holds; None for a rate that is found or tried."""
    rate = drawing.trace.program.steps[number].of
    return drawing.scene.drivers[rate.driver] if isinstance(rate, Drive) else None


def drawn_amount(drawing: Drawing, metres: float) -> str:
    """How long a length of the mechanism is drawn."""
    return f"{in_mm(drawing.words, drawing.on_paper(metres))} mm"


def plan_amount(drawing: Drawing, plane: Plane, size: float) -> str:
    """How a vector of a given size is drawn in a plan."""
    return f"{in_mm(drawing.words, drawn_in(drawing, plane, size))} mm"


def sense(words: Words, value: Any) -> str:
    """The word for the sense of an angular value; nothing for nought."""
    if value == 0:
        return ""
    return words("page.anticlockwise" if value > 0 else "page.clockwise")


def driver_index(driver: Driver) -> str:
    """Markup of a driver's index: its link, and the one it moves against where that moves."""
    index = escape(driver.link)
    return index if driver.against == FRAME else f"{index}/{escape(driver.against)}"


def speed_symbol(driver: Driver) -> str:
    """Symbol of a driver's speed, as among the data."""
    turning = "*n*" if driver.speed.unit.startswith("rev") else "*ω*"
    return f"{turning if driver.kind == 'turn' else '*v*'}_{{{driver_index(driver)}}}"


def angle_symbol(scene: Scene, driver: Driver) -> str:
    """Symbol of a driver's position, with its link's name where several drive or one moves."""
    many = len(scene.drivers) > 1 or driver.against != FRAME
    index = f"_{{{driver_index(driver)}}}" if many else ""
    return ("*φ*" if driver.kind == "turn" else "*s*") + index
