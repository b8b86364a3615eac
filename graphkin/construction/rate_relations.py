"""The relations of rates: of links by bars, by sums and by gears; of blocks along their guides.

Before them come those of the driver, of the motion of its pin, and of the scale factors.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import chain

from msgspec.structs import replace

from graphkin.construction.core.component import component_ending_at
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import expression, has_own_relation, is_derived
from graphkin.construction.core.kind import GivesRate, construction, constructions
from graphkin.construction.core.link_poses import Disc
from graphkin.construction.core.naming import (
    angle_symbol,
    driver_index,
    driver_of_rate,
    length_scale,
    own_scale,
    rate_symbol,
    scale_unit,
    sense,
    speed_symbol,
    turning_with,
    vector_of,
)
from graphkin.construction.core.program import Plane
from graphkin.construction.core.quantities import RATES, number_of, unit_words
from graphkin.construction.core.relation import (
    FINE,
    ROOM,
    Relation,
    answer,
    figure,
    length_of,
    rounded_figure,
    squared,
)
from graphkin.construction.links.rolled_turn import willis
from graphkin.construction.plan import SummedRate, TurningOfLink
from graphkin.construction.result_tables import slide_sense, slides_asked
from graphkin.construction.velocity.relative_motion import TurnedVelocity
from graphkin.drawing.symbol_markup import bar, escape, of_wheel, symbol
from graphkin.scene.model import FRAME, Angled, Belt, Driver
from graphkin.scene.quantity import Quantity
from graphkin.scene.simplify import simplified, text_of


def of_turning(drawing: Drawing) -> Iterator[Relation]:
    """Angular velocities or accelerations: relative motion over length, with the sense.

    A link that turns with another one comes after that one.
    """
    found = [replace(relation, turns=True) for relation in of_links(drawing)]
    names = names_of(found)
    waiting: list[Relation] = []
    for relation in found:
        names.discard(relation.left)
        if relation.takes in names:
            waiting.append(relation)
            continue
        yield relation
        yield from (other for other in waiting if other.takes == relation.left)
    for relation in of_gears(drawing):
        again = drawing.words("calculation.willis") if relation.left in names_of(found) else ""
        remark = drawing.words.clauses(filter(None, (relation.remark, again)))
        yield replace(relation, remark=remark)


def finds_rates(drawing: Drawing) -> bool:
    """Whether some angular rate has a relation; False where all are given."""
    return any(chain(of_links(drawing), of_gears(drawing)))


def names_of(found: Sequence[Relation]) -> set[str]:
    return {relation.left for relation in found}


def of_links(drawing: Drawing) -> Iterator[Relation]:
    """The rate of each link by the step that gives it, in the order of the links."""
    program, rate = drawing.trace.program, drawing.rate
    key, letter = rate.target, rate.letter
    for link in drawing.scene.links:
        number = program.targets.get((key, link), -1)
        value, named = drawing.turning(link), turning_with(drawing, link)
        if value is None or number not in drawing.trace.values:
            continue
        if named != link and (key, named) in program.targets:
            continue
        step = program.steps[number]
        name = drawing.symbol(f"{letter}_{link}")
        tail = (answer(drawing, abs(value)), rate.caret_unit, sense(drawing.words, value))
        if step.action is not None and turning_with(drawing, step.name) != link:
            other = rate_symbol(drawing, number, letter)
            yield Relation(name, other, "", *tail, takes=other, reason="why.together")
        elif isinstance(kind := construction(step), TurningOfLink):
            yield kind.relation(drawing, tail)
        elif isinstance(kind, GivesRate) and (found := kind.rate_relation(drawing, link, tail)):
            yield found


def of_sum(drawing: Drawing, driver: Driver) -> Iterator[Relation]:
    """The rate of a crank on a moving link: the rate of that link plus its own."""
    program, known = drawing.trace.program, set(drawing.trace.values)
    number = drawing.scene.drivers.index(driver)
    for found in constructions(program, SummedRate):
        wanted = program.targets.get((drawing.rate.target, found.link)) == found.rate
        if found.driver == number and wanted and {found.other, found.own} <= known:
            yield found.relation(drawing)


# --- gears ---------------------------------------------------------------------------------------


def of_gears(drawing: Drawing) -> Iterator[Relation]:
    """Willis' relation for wheels in contact: rates relative to the arm by the radii.

    The first sheet also derives the radii of gears, from module and number of teeth, before use.
    """
    given_teeth: set[str] = set()
    links = (drawing.scene.frame, *drawing.scene.links.values())
    for touch in drawing.standing.touches:
        if touch.other is None:
            continue
        centres = {touch.disc.wheel.centre, touch.other.wheel.centre}
        arms = [link.name for link in links if centres <= set(link.points)]
        names = (touch.disc.link, *arms[:1], touch.other.link)
        rates = [rate for name in names if (rate := rate_at(drawing, name)) is not None]
        if len(rates) == 3 and names[0] != FRAME:
            for disc in (touch.disc, touch.other):
                if drawing.kind == "velocity" and disc.wheel.teeth and disc.sign not in given_teeth:
                    given_teeth.add(disc.sign)
                    yield by_teeth(drawing, disc)
            yield by_radii(drawing, names, rates, (touch.disc, touch.other), touch.belt)


def by_teeth(drawing: Drawing, disc: Disc) -> Relation:
    """The radius of a gear: half its module times its number of teeth."""
    assert disc.wheel.teeth is not None
    module, teeth = drawing.length(disc.module), float(disc.wheel.teeth.si(drawing.scene.values))
    figures = f"{figure(drawing, module)}·{figure(drawing, teeth)}/2"
    radius = answer(drawing, drawing.length(disc.radius))
    count = f"*m*·{of_wheel('z', disc.sign)}/2"
    return Relation(radius_of(disc), count, figures, radius, drawing.scene.units["length"])


def by_radius(drawing: Drawing, disc: Disc, radii: int) -> Relation:
    """A length of ``radii`` radii of a wheel: from its given radius, or from module and teeth."""
    symbols, figures = f"{radii}·{radius_of(disc)}", f"{radii}·{figure(drawing, disc.radius)}"
    if radii == 1:
        symbols, figures = radius_of(disc), ""
    if disc.wheel.teeth is not None:
        half, teeth = "/2" if radii == 1 else "", float(disc.wheel.teeth.si(drawing.scene.values))
        symbols += f" = *m*·{of_wheel('z', disc.sign)}{half}"
        figures = f"{figure(drawing, disc.module)}·{figure(drawing, teeth)}{half}"
    return Relation("", symbols, figures, answer(drawing, radii * disc.radius), "m")


def rate_at(drawing: Drawing, link: str) -> float | None:
    """The rate of a link on this sheet; zero for the frame."""
    return 0.0 if link == FRAME else drawing.turning(link)


def by_radii(
    drawing: Drawing,
    names: Sequence[str],
    rates: Sequence[float],
    discs: tuple[Disc, Disc],
    belt: Belt | None,
) -> Relation:
    """The rate of a wheel from the rates of the arm and of the wheel in contact."""
    wheel, arm, track = (drawing.symbol(f"{drawing.rate.letter}_{name}") for name in names)
    _, carried, rolled = rates
    alike = any(disc.wheel.inside for disc in discs)
    if belt is not None:
        alike = not belt.crossed
    factor = 1 if alike else -1
    radii = f"{radius_of(discs[1])}/{radius_of(discs[0])}"
    numbers = f"{figure(drawing, discs[1].radius)}/{figure(drawing, discs[0].radius)}"
    ratio = discs[1].radius / discs[0].radius
    whole = carried + factor * (rolled - carried) * ratio
    fixed = names[1] == FRAME
    symbols = willis("" if fixed else arm, "0" if names[2] == FRAME else track, radii, alike=alike)
    put = [figure(drawing, rate, FINE) for rate in (carried, rolled)]
    figures = willis("" if fixed else put[0], put[1], numbers, alike=alike)
    result = drawing.words.significant(whole, 4)
    remark = sense(drawing.words, whole)
    unit = drawing.rate.caret_unit
    reason = "why.radii" if fixed else "why.willis"
    takes = track if fixed and names[2] != FRAME else ""
    return Relation(
        wheel, symbols, figures, result, unit, remark, turns=True, reason=reason, takes=takes
    )


def radius_of(disc: Disc) -> str:
    return of_wheel("r", disc.sign)


# --- blocks on their guides ----------------------------------------------------------------------


def of_slides(drawing: Drawing) -> Iterator[Relation]:
    """The requested motion of each block: the vector of the plan along its guide, and its sense."""
    what, unit = drawing.sliding.target, drawing.sliding.caret_unit
    for block, name, value in slides_asked(drawing):
        size = drawing.settled(abs(value))
        remark = slide_sense(drawing, block, value) if size else ""
        vector = along_guide(drawing, drawing.trace.program.targets[what, block])
        yield Relation(name, vector, "", answer(drawing, size), unit, remark)


def along_guide(drawing: Drawing, number: int) -> str:
    """The vector of the plan that is the motion of a block along its guide, as markup."""
    program = drawing.trace.program
    _, tail, tip = program.steps[number].args
    laid = component_ending_at(program, tail)
    if laid is not None and laid.component.follows:
        return drawing.symbol(f"a_{laid.component.index}^r")  # it may be drawn from the other end
    return vector_of(drawing, tail, tip)


# --- the driver, the motion of its pin, and the scale factors -------------------------------------


OMEGA = 6
"""Significant digits of the driver's angular velocity, on which all later numbers depend."""
IN_RADIANS = tuple(rate.unit for rate in RATES)
"""Units of angular rates in radians, which need no conversion."""
COSINES = "√({0}^2 + {1}^2 − 2·{0}·{1}·cos {2})"
"""The third side of a triangle from two sides and their angle, in symbols or in figures."""
KV, KA = "(m/s)/mm", "(m/s^2)/mm"
"""Units of the plans' scale factors."""


def of_driver(drawing: Drawing, driver: Driver, *, accelerated: bool) -> Iterator[Relation]:
    """Position and speed from the parameters, angular velocity, and motion of the driven pin."""
    words, scene = drawing.words, drawing.scene
    index = f"_{{{driver_index(driver)}}}"
    rate = drawing.in_signs("*ε*") if driver.kind == "turn" else "*a*"
    for letter, quantity in (
        (angle_symbol(scene, driver), driver.position),
        (speed_symbol(driver), driver.speed),
        (f"{rate}{index}", driver.acceleration),
    ):
        if has_own_relation(scene, quantity):
            amount = number_of(scene, words, quantity)
            symbols, law = expression(scene, words, quantity, values=False), quantity
            if is_derived(quantity):  # figures are put in only after the derivative is taken
                law = short(quantity)
                derived = expression(scene, words, law, values=False)
                symbols += f" = {derived}" if law.uses() else ""
            figures = expression(scene, words, law, values=True)
            yield Relation(
                letter,
                symbols,
                figures if figures != amount else "",
                amount,
                unit_words(words, quantity.unit),
                turns=quantity.unit in IN_RADIANS,
            )
    if driver.kind != "turn":
        return
    omega = float(driver.speed.si(scene.values))
    if driver.speed.unit == "rev/min":
        turns = words.decimal(driver.speed.written(scene.values).lstrip("-"))
        yield Relation(
            f"*ω*{index}",
            f"π·*n*{index}/30",
            f"π·{turns}/30",
            figure(drawing, abs(omega), OMEGA),
            "rad/s",
            sense(words, omega),
            turns=True,
        )
    elif driver.speed.unit == "deg/s":
        yield in_radians(drawing, f"*ω*{index}", driver.speed, "rad/s")
    if driver.acceleration.unit == "deg/s²" and not driver.acceleration.is_zero():
        yield in_radians(drawing, drawing.in_signs(f"*ε*{index}"), driver.acceleration, "rad/s^2")
    if driver.against == FRAME:
        for p, q in driven_bars(drawing, driver):
            yield from of_pin(drawing, driver, p, q, accelerated=accelerated)
    if drawing.kind == "velocity":
        yield from of_sum(drawing, driver)


def short(derivative: Quantity) -> Quantity:
    """The derivative, simplified and written out."""
    tree = simplified(derivative.tree)
    return Quantity(text_of(tree), tree, derivative.unit, derivative.place)


def in_radians(drawing: Drawing, name: str, quantity: Quantity, unit: str) -> Relation:
    """A rate that is given in degrees, converted to radians, with its sense."""
    degrees = drawing.words.decimal(quantity.written(drawing.scene.values).lstrip("-"))
    rate = float(quantity.si(drawing.scene.values))
    size = figure(drawing, abs(rate), OMEGA)
    how = sense(drawing.words, rate)
    return Relation(name, "", f"π·{degrees}/180", size, unit, how, turns=True)


def driven_bars(drawing: Drawing, driver: Driver) -> Iterator[tuple[str, str]]:
    """The bars of a driver's link from its fixed pivot to its pins."""
    frame = drawing.scene.frame.points
    for _, step, _ in drawing.steps(Plane.VELOCITIES):
        kind = construction(step)
        if not isinstance(kind, TurnedVelocity) or kind.p not in frame:
            continue
        if driver_of_rate(drawing, kind.omega) is driver and kind.is_of_driver(drawing, kind.omega):
            yield kind.p, kind.q


def of_pin(
    drawing: Drawing, driver: Driver, p: str, q: str, *, accelerated: bool
) -> Iterator[Relation]:
    """Velocity of a driven pin, its normal acceleration, and its tangential one unless zero."""
    index, words = f"_{{{escape(driver.link)}}}", drawing.words
    omega, epsilon = (
        abs(float(rate.si(drawing.scene.values))) for rate in (driver.speed, driver.acceleration)
    )
    steady = driver.acceleration.is_zero()
    length = length_of(drawing, p, q)
    bar_length, w = figure(drawing, length), figure(drawing, omega, OMEGA)
    line = bar(p, q)
    speed = answer(drawing, omega * length)
    laid = partial(Relation, over=((p, q),))
    square = f"⊥ {line}"
    yield laid(symbol(f"v_{q}"), f"*ω*{index}·{line}", f"{w}·{bar_length}", speed, "m/s", square)
    if accelerated:
        yield laid(
            drawing.symbol(f"a_{q}" if steady else f"a_{q}^ν"),
            f"*ω*{index}^2·{line}",
            f"{squared(w)}·{bar_length}",
            answer(drawing, omega * omega * length),
            "m/s^2",
            words("calculation.towards", p=symbol(p), q=symbol(q)),
        )
    if accelerated and not steady:
        yield laid(
            drawing.symbol(f"a_{q}^τ"),
            drawing.in_signs(f"*ε*{index}·{line}"),
            f"{figure(drawing, epsilon)}·{bar_length}",
            answer(drawing, epsilon * length),
            "m/s^2",
            square,
        )


def of_scales(drawing: Drawing) -> Iterator[Relation]:
    """kL, kv and ka, and the drawn length of the driven bar."""
    words, scales = drawing.words, drawing.scales
    number, stated = length_scale(drawing), scale_unit(words)
    drawn = words.unit("m/mm")
    yield Relation(
        drawing.in_signs("*k*_L"),
        "",
        own_scale(drawing),
        number,
        "m/mm",
        words("calculation.scale", scale=words.decimal(scales.words)),
        blank=(f"{ROOM} {stated}", f"= {ROOM} {drawn}") if stated != drawn else (),
    )
    yield from by_cosines(drawing)
    for name, length in drawn_bars(drawing):
        yield Relation(
            name,
            "",
            f"{figure(drawing, length)}/{number}",
            figure(drawing, drawing.on_paper(rounded_figure(length))),
            "mm",
            words("calculation.drawn"),
        )
    yield from plan_scales(drawing)


def plan_scales(drawing: Drawing) -> Iterator[Relation]:
    """kv and ka, from the driving crank or chosen.

    Where no crank determines them, ka = (m·kv)²/(m′·kL), which keeps kv the mean proportional. The
    plans are m and m′ times as large as the vectors on the mechanism.
    """
    scales, chosen, signed = drawing.scales, drawing.words("calculation.chosen"), drawing.in_signs
    number = length_scale(drawing)
    kv, ka = figure(drawing, scales.kv / 1000), figure(drawing, scales.ka / 1000)
    if not scales.of_crank:
        m, again = (figure(drawing, each) for each in (scales.larger, scales.larger_still))
        by_ka = (signed("*k*_v^2/*k*_L"), f"{squared(kv)}/{number}")
        if (m, again) != ("1", "1"):
            by_ka = (signed(f"({m}·*k*_v)^2/({again}·*k*_L)"), f"({m}·{kv})^2/({again}·{number})")
        yield Relation(signed("*k*_v"), "", "", kv, KV, chosen, given=True)
        yield Relation(signed("*k*_a"), *by_ka, ka, KA)
        return
    turning = float(drawing.scene.drivers[0].speed.si(drawing.scene.values))
    w, index = figure(drawing, abs(turning), OMEGA), f"_{{{escape(drawing.scene.drivers[0].link)}}}"
    for name, power, kind, result, unit in (
        (signed("*k*_v"), "", "velocity", kv, KV),
        (signed("*k*_a"), "^2", "acceleration", ka, KA),
    ):
        if kind == "acceleration" and drawing.scene.sheet.ka is not None:
            yield Relation(name, "", "", result, unit, chosen, given=True)
            continue
        times = scales.of_bar(kind)
        less = f"/{figure(drawing, times)}" if times != 1 else ""
        numbers = f"{squared(w) if power else w}·{number}{less}"
        whole = signed(f"*ω*{index}{power}·*k*_L{less}")
        yield Relation(name, whole, numbers, result, unit)


def laid_bars(drawing: Drawing) -> Iterator[tuple[str, str]]:
    """The ends of the bars that are laid off on the mechanism, in the order of drawing."""
    for _, step, _ in drawing.steps(Plane.MECHANISM, Plane.NUMBERS):
        kind = construction(step)
        laid = kind.laid_length(step.role) if kind is not None else None
        if laid is not None and not laid.half:
            yield laid.first, laid.last


def by_cosines(drawing: Drawing) -> Iterator[Relation]:
    """The bars laid off between arms at given angles, by the law of cosines."""
    laid = {frozenset(ends): bar(*ends) for ends in laid_bars(drawing)}
    for link in drawing.scene.every_link:
        for placing in link.placings:
            if isinstance(placing, Angled):
                name = laid.get(frozenset((placing.arm, placing.point)))
                if name:
                    yield opposite(drawing, name, placing)


def opposite(drawing: Drawing, name: str, placing: Angled) -> Relation:
    """The side ``name`` of a triangle, from two sides and the angle between them."""
    p, o, q = placing.arm, placing.vertex, placing.point
    one, other, third = (length_of(drawing, *ends) for ends in ((o, p), (o, q), (p, q)))
    degrees = abs(math.degrees(float(placing.angle.si(drawing.scene.values))))
    corner = f"∠{symbol(p)}{drawing.symbol(o)}{symbol(q)}"
    figures = figure(drawing, one), figure(drawing, other), f"{figure(drawing, degrees)}°"
    return Relation(
        name,
        COSINES.format(bar(o, p), bar(o, q), corner),
        COSINES.format(*figures),
        figure(drawing, third),
        "m",
    )


def drawn_bars(drawing: Drawing) -> Iterator[tuple[str, float]]:
    """The bars that are laid off on the mechanism, grouped by length, in metres."""
    found: dict[float, list[str]] = {}
    for p, q in laid_bars(drawing):
        length = round(length_of(drawing, p, q), 12)
        if bar(p, q) not in found.setdefault(length, []):
            found[length].append(bar(p, q))
    for length, bars in found.items():
        yield drawing.in_signs(" = ".join(f"{name}/*k*_L" for name in bars)), length
