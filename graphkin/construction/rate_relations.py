"""The relations of rates: of links by bars, by sums and by gears; of blocks along their guides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

from msgspec.structs import replace

from graphkin.construction.core.component import component_ending_at
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import GivesRate, construction, constructions
from graphkin.construction.core.link_poses import Disc
from graphkin.construction.core.naming import rate_symbol, sense, turning_with, vector_of
from graphkin.construction.core.relation import FINE, Relation, answer, figure
from graphkin.construction.links.rolled_turn import willis
from graphkin.construction.plan import SummedRate, TurningOfLink
from graphkin.construction.result_tables import slide_sense, slides_asked
from graphkin.drawing.symbol_markup import of_wheel
from graphkin.scene.model import FRAME, Belt, Driver


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
