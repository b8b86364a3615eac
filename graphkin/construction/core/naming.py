"""The names of steps, links and lines in sentences and relations.

The segments of a plan by their letters, and the rule for what is too short to be drawn.
"""

from __future__ import annotations

from cmath import phase
from math import degrees
from typing import Any

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import FallsOnImage, construction
from graphkin.construction.core.program import Drive, Plane, Step, plan_vector
from graphkin.construction.core.quantities import (
    OnPaper,
    in_millimetres,
    in_mm,
    number_of,
    quantity_text,
)
from graphkin.construction.core.vocabulary import join
from graphkin.drawing.scale import digits
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.scene.model import FRAME, At, Driver, GuideOrTrack, Link, Scene
from graphkin.scene.quantity import Quantity, shortest
from graphkin.text import IMPERIAL, NOTHING, Words

NAUGHT = 1e-6
"""A vector drawn shorter than this, in mm, counts as zero."""


def has_plan(drawing: Drawing) -> bool:
    """Whether the plan of a sheet has anything in it; paths and fixed centres need no plan."""
    return any(True for _ in drawing.steps(drawing.plane))


def name_of_sheet(drawing: Drawing) -> str:
    """The name of a sheet: its plan, or the mechanism where it has no plan."""
    return drawing.kind if has_plan(drawing) else "mechanism"


def way_of(drawing: Drawing, name: str) -> str:
    """The name of a guide by its block, of a straight track by its wheel or its bar."""
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
    """The arrow between two points of a plan, or between points that coincide with them.

    The order of the points does not matter.
    """
    found = drawing.joins.get((tail, tip)) or drawing.joins.get((tip, tail))
    if found:
        return found
    ends = {fallen(drawing, tail), fallen(drawing, tip)}
    joins = drawing.joins.items()
    return next((step for pair, step in joins if {fallen(drawing, n) for n in pair} == ends), None)


def fallen(drawing: Drawing, number: int) -> int:
    """The image with which another coincides, on a translating link; else that image itself."""
    kind = construction(drawing.trace.program.steps[number])
    return kind.falls_on if isinstance(kind, FallsOnImage) else number


def vector_of(drawing: Drawing, tail: int, tip: int, default: str = "") -> str:
    """The vector between two points of a plan, as markup."""
    arrow = arrow_of(drawing, tail, tip)
    found = plan_vector(arrow) if arrow else None
    return drawing.symbol(found.symbol) if found else default


def scale_of(drawing: Drawing, plane: Plane) -> float:
    """The scale factor of a plan, per metre of paper."""
    if plane is Plane.FORCES:
        return drawing.scales.kF
    return drawing.scales.kv if plane is Plane.VELOCITIES else drawing.scales.ka


def length_scale(drawing: Drawing) -> str:
    """kL in lengths of results per millimetre of paper, with six digits where it is not round."""
    scale = drawing.scales.kL / 1000
    exact = drawing.scales.metre == 1
    return drawing.words.decimal(digits(scale) if exact else f"{scale:.6g}")


def scale_unit(words: Words) -> str:
    """The unit of a stated kL: per millimetre of paper, but per inch or foot in these units."""
    if words.length in IMPERIAL:
        return words.spelled(f"{words.length}/{words.length}")
    return words.unit("m/mm")


def own_scale(drawing: Drawing, blank: str = "") -> str:
    """kL per inch or foot of paper with its unit, in these units; otherwise empty.

    ``blank`` replaces the number.
    """
    words = drawing.words
    if words.length not in IMPERIAL:
        return ""
    number = blank or words.decimal(digits(drawing.scales.kL * drawing.scales.metre))
    return f"{number} {scale_unit(words)}"


def stated_scale(drawing: Drawing, blank: str = "") -> str:
    """kL with its unit: per millimetre of paper, in inches and feet also per inch or foot of paper.

    ``blank`` replaces the numbers.
    """
    drawn = f"{blank or length_scale(drawing)} {drawing.words.unit('m/mm')}"
    own = own_scale(drawing, blank)
    return f"{own} = {drawn}" if own else drawn


def drawn_in(drawing: Drawing, plane: Plane, size: float) -> OnPaper:
    """The drawn length of a vector with a given magnitude."""
    return OnPaper(float(1000 * size / scale_of(drawing, plane)))


def drawn_between(drawing: Drawing, tail: int, tip: int, plane: Plane) -> OnPaper:
    """The drawn length of the vector between two points of a plan."""
    values = drawing.trace.values
    return drawn_in(drawing, plane, abs(values[tip] - values[tail]))


def length_gap(arrow: int) -> str:
    """The gap for the drawn length of an arrow, in a sentence that a page completes."""
    return f"\ue000{arrow}\ue001"


def length_drawn(drawing: Drawing, tail: int, tip: int) -> str:
    """The drawn length of a vector in its plan, in mm, without the unit."""
    plane = drawing.trace.program.steps[tip].plane
    if drawing.lengths != "drawn" and (arrow := arrow_of(drawing, tail, tip)):
        return length_gap(next(n for n, step, _ in drawing.steps(plane) if step is arrow))
    return in_mm(drawing.words, drawn_between(drawing, tail, tip, plane))


def has_no_length(drawing: Drawing, number: int) -> bool:
    """Whether a vector laid off from a point of a plan is zero."""
    start = drawing.trace.program.steps[number].args[0]
    values = drawing.trace.values
    return not drawing.settled(abs(values[number] - values[start]))


def rate_symbol(drawing: Drawing, number: int, letter: str = "ω", link: str = "") -> str:
    """The symbol of an angular velocity or acceleration, by its step or its link, as markup."""
    step = drawing.trace.program.steps[number]
    if step.name in drawing.scene.links:
        return drawing.symbol(f"{letter}_{turning_with(drawing, step.name)}")
    if isinstance(step.of, Drive):
        return drawing.symbol(f"{letter}_{drawing.scene.drivers[step.of.driver].link}")
    return (
        drawing.symbol(f"{letter}_{turning_with(drawing, link)}")
        if link
        else drawing.symbol(letter)
    )


def turning_with(drawing: Drawing, link: str) -> str:
    """The link named in place of a hidden one.

    A hidden link turns with the link on whose guide it slides, so that link is named.
    """
    scene = drawing.scene
    if link not in scene.unseen or not scene.links[link].slides:
        return link
    return turning_with(drawing, scene.links[link].slides[0].on)


def is_driven(drawing: Drawing, number: int) -> bool:
    """Whether the scene gives a rate."""
    return isinstance(drawing.trace.program.steps[number].of, Drive)


def driver_of_rate(drawing: Drawing, number: int) -> Driver | None:
    """The driver whose given rate a step holds; None for a rate that is found or tried."""
    rate = drawing.trace.program.steps[number].of
    return drawing.scene.drivers[rate.driver] if isinstance(rate, Drive) else None


def drawn_amount(drawing: Drawing, metres: float) -> str:
    """The drawn length of a length of the mechanism, in mm, as text."""
    return in_millimetres(drawing.words, drawing.on_paper(metres))


def plan_amount(drawing: Drawing, plane: Plane, size: float) -> str:
    """The drawn length of a vector with a given magnitude, in mm, as text."""
    return in_millimetres(drawing.words, drawn_in(drawing, plane, size))


def sense(words: Words, value: Any) -> str:
    """The word for the sense of an angular value; empty for zero."""
    if value == 0:
        return ""
    return words("page.anticlockwise" if value > 0 else "page.clockwise")


def driver_index(driver: Driver) -> str:
    """The index of a driver as markup: its link, and a moving link that it turns against."""
    index = escape(driver.link)
    return index if driver.against == FRAME else f"{index}/{escape(driver.against)}"


def speed_symbol(driver: Driver) -> str:
    """The symbol of a driver's speed, as among the data."""
    turning = "*n*" if driver.speed.unit == "rev/min" else "*ω*"
    return f"{turning if driver.kind == 'turn' else '*v*'}_{{{driver_index(driver)}}}"


def angle_symbol(scene: Scene, driver: Driver) -> str:
    """The symbol of a driver's position, with its link's name if there are several or one moves."""
    many = len(scene.drivers) > 1 or driver.against != FRAME
    index = f"_{{{driver_index(driver)}}}" if many else ""
    return ("*φ*" if driver.kind == "turn" else "*s*") + index


FINE = 4
"""Decimals of computed angles and coordinates."""


LEVEL_OR_UPRIGHT = {(0, "deg"): "_horizontal", (90, "deg"): "_vertical"}
"""Lines of the frame that have a name, by their angle: how the keys of their sentences end."""


def straight(drawing: Drawing, path: GuideOrTrack, *, on_paper: bool = False) -> str:
    """A line through a point at an angle to the axis of the frame or of a link that turns.

    The point is printed as the scene gives it or, ``on_paper``, as drawn.
    """
    assert path.angle is not None and path.through is not None
    words, link = drawing.words, drawing.scene.link(path.on)
    through = place(drawing, path.on, path.through, on_paper=on_paper)
    fields = {"k": escape(path.on), "through": through}
    if path.on == FRAME:
        own = path.angle.number(drawing.scene.values), path.angle.unit
        angle, way = quantity_text(drawing.scene, words, path.angle), LEVEL_OR_UPRIGHT.get(own, "")
        return words(f"page.line{way}", angle=angle, **fields)
    lean = leaning(drawing, link)
    if lean is not None:
        turn = lean * complex(path.angle.direction(drawing.scene.values))
        return words("page.line_moved", angle=f"{number(drawing, degrees(phase(turn)))}°", **fields)
    if path.angle.is_zero() and not (len(link.points) > 1 or bool(link.slides)):
        return words("page.line_free", **fields)
    turn_to = quantity_text(drawing.scene, words, path.angle)
    return words("page.line_of", angle=turn_to, axis=axis_of(drawing, link), **fields)


def place(
    drawing: Drawing, on: str, through: str | tuple[Quantity, Quantity], *, on_paper: bool = False
) -> str:
    """A point by its name or coordinates; on a link that does not turn, relative to its pin.

    The coordinates are printed as the scene gives them or, ``on_paper``, as drawn.
    """
    if isinstance(through, str):
        return drawing.symbol(through)
    words, link = drawing.words, drawing.scene.link(on)
    lean, away, pin = leaning(drawing, link), metres(drawing, through), ""
    if lean is not None and link.points:
        start = next(p for p in link.placings if isinstance(p, At) and p.point == link.points[0])
        away, pin = (away - metres(drawing, (start.x, start.y))) * lean, start.point
    unit = words.spelled("mm" if on_paper else through[0].written_unit)
    if on_paper:
        x, y = (in_mm(words, drawing.on_paper(part)) for part in (away.real, away.imag))
    elif pin:
        x, y = (number(drawing, drawing.length(part)) for part in (away.real, away.imag))
    else:
        x, y = (number_of(drawing.scene, words, each) for each in through)
    if not pin:
        return f"{drawing.words.place(x, y)} {unit}"
    return words("page.away", place=words.place(x, y), unit=unit, point=symbol(pin))


def metres(drawing: Drawing, pair: tuple[Quantity, Quantity]) -> complex:
    """A point of a link by its coordinates, in metres."""
    return complex(*(float(each.si(drawing.scene.values)) for each in pair))


def leaning(drawing: Drawing, link: Link) -> complex | None:
    """The direction of the axis of a link that a fixed guide keeps from turning."""
    if link.name == FRAME or not link.slides or link.slides[0].on != FRAME:
        return None
    if len(link.points) != 1:
        return None
    return drawing.standing.axis(link.name)


def axis_of(drawing: Drawing, link: Link) -> str:
    """The words for the *x* axis of a link: its bar, its guide, or the link itself.

    The block that keeps a wheel on a track is not drawn: its axis is the track.
    """
    scene = drawing.scene
    if link.name in scene.unseen and link.slides:
        _, track = scene.keepers[link.name]
        if track.angle is not None and track.angle.is_zero():
            return axis_of(drawing, scene.link(track.on))
        return drawing.words("page.axis_track", k=escape(track.on))
    own = drawing.words("page.axis_link", k=escape(link.name))
    if len(link.points) > 1:
        coordinates = sum(isinstance(placing, At) for placing in link.placings)
        return own if coordinates > 1 else bar(*link.points[:2])
    if link.slides and link.slides[0].along:
        return bar(*link.slides[0].along)
    blocks = [other for other in scene.links.values() if is_along(other, link)]
    for block in (link, *blocks):
        if block.slides and block.name not in scene.unseen:
            return drawing.words("page.axis_guide", g=escape(block.name))
    return own


def is_along(block: Link, link: Link) -> bool:
    """Whether a block slides along the axis of another link."""
    ways = (slide for slide in block.slides if slide.on == link.name)
    return any(way.angle is not None and way.angle.is_zero() for way in ways)


def number(drawing: Drawing, value: float) -> str:
    """A computed number without trailing zeros; zero has no minus sign."""
    return drawing.words.decimal(shortest(round(value, FINE) + 0.0))


def nearest_side(way: complex) -> str:
    """The side of a point to which a direction leads: right, above, left or below."""
    sides = ("right", "above", "left", "below")
    return sides[round(degrees(phase(way)) / 90) % 4]


TINY = 0.5
"""Vectors shorter than this, in mm, are named at the foot of their field."""
NEAR = 0.3
"""A thin line shorter than this, in mm, between two points of a plan is not drawn."""


def is_short(drawing: Drawing, size: float, plane: Plane) -> bool:
    """Whether a vector of a plan with this magnitude is too short to be drawn."""
    return drawn_in(drawing, plane, abs(size)) < TINY


def laid_off_words(drawing: Drawing, key: str, size: float, **fields: str) -> str:
    """The words for how a computed vector is laid off, and its length, or that it is too short.

    Empty for a vector that is zero.
    """
    if size == 0:
        return ""
    short = "_short" if is_short(drawing, size, drawing.plane) else ""
    drawn = in_mm(drawing.words, drawn_in(drawing, drawing.plane, size))
    return drawing.words(f"calculation.{key}{short}", drawn=drawn, **fields)


def segment_of(drawing: Drawing, step: Step) -> str:
    """The segment of a plan under an arrow, by its letters; empty where an end has no letter."""
    vector = plan_vector(step)
    ends = [letter_at_end(drawing, end, step) for end in vector.ends if end] if vector else []
    if step.action is join:
        ends = [letter_at(drawing, number) for number in step.args]
        if vector and vector.foot:
            ends[0 if vector.back else 1] = vector.foot
    return NOTHING.join(drawing.symbol(end) for end in ends) if all(ends) else ""


def letter_at(drawing: Drawing, number: int) -> str:
    """The letter of a point of a plan.

    The foot of a component too short to be drawn has the letter of the component's start.
    """
    steps = drawing.trace.program.steps
    if steps[number].name or number not in drawing.feet:
        return steps[number].name
    arrow = drawing.feet[number]
    vector = plan_vector(steps[arrow])
    assert vector is not None
    if is_foot_drawn(drawing, arrow):
        return vector.foot
    return letter_at(drawing, steps[arrow].args[1 if vector.back else 0])


def letter_at_end(drawing: Drawing, letter: str, own: Step) -> str:
    """The letter at an end of a segment; for a foot not drawn, the letter of the other end."""
    for number, step, _ in drawing.steps(drawing.plane):
        vector = plan_vector(step)
        if step is own or vector is None or vector.foot != letter or letter not in vector.ends:
            continue
        if not is_foot_drawn(drawing, number):
            return vector.ends[0 if letter == vector.ends[1] else 1]
    return letter


def is_foot_drawn(drawing: Drawing, arrow: int) -> bool:
    """Whether a component is long enough for its foot to be marked in the plan."""
    value = drawing.trace.values[arrow]
    return not is_short(drawing, abs(value.tip - value.tail), drawing.plane)
