"""Groups of class III and higher: one link is tried all round, and a locus says where it fits.

Once the place of one link is known the others follow as dyads.
"""

from __future__ import annotations

from collections.abc import Callable

from msgspec import Struct

from graphkin.construction.core.bases import Base, bases, ending, trial_base
from graphkin.construction.core.branches import closure_of, has_two_ways
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import coordinate
from graphkin.construction.guides.guide_actions import axis_with_guide, turned_back
from graphkin.construction.guides.guides import axis, known_guide, path_of, standing_guide
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.construction.higher_class.closure_solver import Trying
from graphkin.construction.higher_class.trial_actions import (
    beside_line,
    cosine_between,
    excess,
    from_to,
    inverse,
    less,
    on_line,
    part,
    product,
    reach,
    sine_between,
)
from graphkin.construction.higher_class.trial_pen import TrialPen
from graphkin.construction.links.driven_crank import turn_about
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.links.plate_points import plate_points
from graphkin.construction.links.position import set_on_guide
from graphkin.construction.rolling import rolling
from graphkin.scene.model import FRAME, Driver
from graphkin.structure.groups import Dyad, Group, Higher, Stretched, Tie, TriedLink
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Contact, Pin, Sliding

Each = Callable[[Pen, LinkShapes, Group, tuple[Base, ...]], None]
"""How one group is put down: the function of the compiler for one of the three plans."""


def position(pen: Pen, shapes: LinkShapes, group: Higher, each: Each) -> None:
    """The mechanism to scale: the tried link where the locus says, then dyad by dyad."""
    trying, inputs = trial_of(pen, group, each)
    number, dyads = closure_of(pen.scene, group), choosing_dyads(group)
    counted, traced = counted_by(pen, group), tuple(traced_points(pen, group.last))
    with pen.on(Part.POSITION, Plane.NUMBERS):
        closing = pen.draw(trying.action(number), *inputs)
        tried, *sides = (pen.draw(part, closing, extra=(k,)) for k in range(len(dyads) + 1))
    pen.chosen |= {dyad.links: side for dyad, side in zip(dyads, sides, strict=True)}
    pen.make(ClosedGroup(group, number, counted, traced, closing, tried, tuple(sides)))
    build(pen, shapes, group, each, tried)


def counted_by(pen: Pen, group: Higher) -> str:
    """The first written link whose angle differs between closures: known links do not hold it.

    Slides hold the angle of one link to another, and so do drivers that turn them.
    """
    scene = pen.scene
    joined = [{k.name, slide.on} for k in scene.links.values() for slide in k.slides]
    joined += [{driver.link, driver.against} for driver in scene.drivers if driver.kind == "turn"]
    held = {FRAME, *pen.bases} - set(group.links)
    while more := {link for pair in joined if pair & held for link in pair} - held:
        held |= more
    written = [name for name in scene.links if name in group.links]
    return next((name for name in written if name not in held), written[0])


def choosing_dyads(group: Higher) -> list[Dyad]:
    """The dyads of the chain that can close in two ways."""
    dyads = [each.dyad if isinstance(each, Stretched) else each for each in group.chain]
    return [d for d in dyads if isinstance(d, Dyad) and (d.type == "RRR" or has_two_ways(d))]


def build(pen: Pen, shapes: LinkShapes, group: Higher, each: Each, tried: int) -> None:
    """The whole group in the plane, from the tried value."""
    place_trial(pen, shapes, group, tried)
    for member in (*group.chain, *ending(group)):
        each(pen, shapes, member, bases(pen.scene, member))


def place_trial(pen: Pen, shapes: LinkShapes, group: Higher, tried: int) -> None:
    """The tried link: turned about its pin, or set along its guide or track."""
    trial, base = group.trial, trial_base(pen.scene, group.trial)
    pen.bases[trial.link] = base
    match trial.pair:
        case Pin(point=pivot):
            with pen.on(Part.POSITION, Plane.MECHANISM):
                turn_about(pen, shapes, trial.link, (pivot, base.end), (), tried)
        case Sliding() as pair:
            pen.leads[trial.link] = partner(pair, trial.link)
            set_on_guide(pen, shapes, pair, trial.link, tried)
        case pair:
            assert isinstance(pair, Contact)
            rolling.set_on_track(pen, shapes, pair, base.start, tried)
    plate_points(pen, shapes, base)


def trial_of(pen: Pen, group: Higher, each: Each) -> tuple[Trying, list[int]]:
    """The program of the trial, and the steps of what it takes as known."""
    fork = TrialPen(pen)
    shapes = LinkShapes(fork)
    tried = fork.input_step()
    dyads = choosing_dyads(group)
    signs = [fork.input_step() for _ in dyads]
    fork.chosen |= {dyad.links: sign for dyad, sign in zip(dyads, signs, strict=True)}
    pair = group.trial.pair
    turns = isinstance(pair, Pin)
    build(fork, shapes, group, each, tried)
    with fork.on(Part.POSITION, Plane.NUMBERS):
        fit = misfit(fork, shapes, group)
        written = [name for name in pen.scene.links if name in group.links]
        axes = tuple(axis(fork, shapes, name) for name in written)
        reach = None if turns else reach_of(fork, shapes, group)
        rim = rolling.radius_of(fork, pair) if isinstance(pair, Contact) else None
    traced = tuple(fork.the("position", point) for point in traced_points(pen, group.last))
    fork.keep_inputs(fit.size, fit.locus, fit.facing, *axes, reach, rim, *traced)
    trying = Trying(
        fork.program(),
        pen.scene.values,
        tuple(fork.inputs),
        tried,
        turns,
        tuple(signs),
        fit.size,
        fit.locus,
        fit.facing,
        axes,
        reach,
        rim,
        traced,
    )
    return trying, list(fork.inputs.values())


def traced_points(pen: Pen, last: Tie | Driver) -> list[str]:
    """The points whose loci the hand draws: the ends of the last link that do not stand already.

    None where none shows the fit: what guides the last link must stand.
    """
    match last:
        case Tie(_, Pin(point=p), Pin(point=q)):
            return [point for point in (p, q) if not pen.has("position", point)]
        case Tie(link, Pin(point=p), Sliding() as pair) if stands(pen, partner(pair, link)):
            return [p]
    return []


def stands(pen: Pen, link: str) -> bool:
    """Whether a link stands already."""
    return link == FRAME or pen.has("axis", link)


class Misfit(Struct, frozen=True):
    """What must vanish, the point whose locus it is read from, and what must be positive."""

    size: int
    locus: int
    facing: int | None = None


def misfit(pen: Pen, shapes: LinkShapes, group: Higher) -> Misfit:
    """By how much the last link, or the driver that comes last, does not fit a trial.

    What a driver gives is read from how far the tried link moves: at a dead point that link moves
    and the driver's own does not.
    """
    match group.last:
        case Tie(link, Pin(point=p), Pin(point=q)):
            ends = pen.the("position", p), pen.the("position", q)
            length = shapes.length(link, p, q)
            return Misfit(pen.draw(excess, *ends, length), pen.draw(from_to, *ends))
        case Tie(link, Pin(point=p), Sliding() as pair):
            line = path_of(pen, shapes, pair, link, p)
            place = pen.the("position", p)
            return Misfit(pen.draw(beside_line, line, place), pen.draw(on_line, line, place))
        case Driver(kind="turn") as driver:
            return turn_misfit(pen, shapes, driver, group)
        case Driver(kind="slide") as driver:
            guide = standing_guide(pen, shapes, slide_of(pen, driver))
            first = pen.the("position", pen.scene.link(driver.link).points[0])
            found = pen.draw(less, pen.draw(coordinate, guide, first), pen.drive(driver).position)
            return Misfit(found, tried_point(pen, group.trial))
        case Driver() as driver:
            found = pen.draw(less, pen.the("rolled", driver.link), pen.drive(driver).position)
            return Misfit(found, tried_point(pen, group.trial))
    raise AssertionError(group.last)


def tried_point(pen: Pen, trial: TriedLink) -> int:
    """The point of the tried link that its trial moves farthest."""
    base = pen.bases[trial.link]
    far = base.end if isinstance(trial.pair, Pin) else None
    return pen.the("position", far or base.start)


def turn_misfit(pen: Pen, shapes: LinkShapes, driver: Driver, group: Higher) -> Misfit:
    """By how much a link is turned otherwise than its driver says."""
    lead = axis(pen, shapes, driver.link)
    if driver.of:
        lead = pen.draw(axis_with_guide, lead, *(shapes.local(driver.link, p) for p in driver.of))
    if driver.against != FRAME:
        lead = pen.draw(turned_back, lead, axis(pen, shapes, driver.against))
    wanted = pen.drive(driver).position
    sine = pen.draw(sine_between, lead, wanted)
    moved = axis(pen, shapes, group.trial.link)
    if not isinstance(group.trial.pair, Pin):
        size = pen.draw(inverse, reach_of(pen, shapes, group))
        moved = pen.draw(product, tried_point(pen, group.trial), size)
    return Misfit(sine, moved, pen.draw(cosine_between, lead, wanted))


def slide_of(pen: Pen, driver: Driver) -> Sliding:
    """The pair that a driver slides."""
    slides = pen.scene.links[driver.link].slides
    return next(Sliding(s, (driver.link, s.on)) for s in slides if s.on == driver.against)


def reach_of(pen: Pen, shapes: LinkShapes, group: Higher) -> int:
    """How far along its guide the tried link may have to be looked for: what lengths allow."""
    pair = group.trial.pair
    assert not isinstance(pair, Pin)
    line = (
        rolling.track_of(pen, shapes, pair)
        if isinstance(pair, Contact)
        else known_guide(pen, shapes, pair)
    )
    lengths = [
        shapes.length(name, points[0], point)
        for name in group.links
        for points in (pen.scene.link(name).points,)
        for point in points[1:]
    ]
    lengths += [pen.drive(d).position for d in slid_within(pen, group)]
    known = [pen.the("position", p) for p in known_points(pen, group)]
    return pen.draw(reach, line, *lengths, *known, extra=(len(lengths),))


def slid_within(pen: Pen, group: Higher) -> list[Driver]:
    """The drivers that slide a link of a group."""
    return [d for d in pen.scene.drivers if d.kind != "turn" and d.link in group.links]


def known_points(pen: Pen, group: Higher) -> list[str]:
    """The points of a group that known links have too."""
    parent = pen.parent if isinstance(pen, TrialPen) else pen
    points = dict.fromkeys(p for name in group.links for p in pen.scene.link(name).points)
    return [point for point in points if parent.has("position", point)]
