"""Groups of class III and higher: a locus for the position, two trial plans for each other plan.

Once the place of one link is known the others follow as dyads. For velocities and accelerations
two trials suffice, for what they miss grows in proportion (false position, method of two plans).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphkin.plans import acceleration as accelerations
from graphkin.plans import rolling
from graphkin.plans import velocity as velocities
from graphkin.plans.carried import image_under, omega_of
from graphkin.plans.guides import axis, known_guide, path_of, standing_guide
from graphkin.plans.links import Base, bases, closure_of, ending, trial_base
from graphkin.plans.normals import lay_off_normal, normal_component, square
from graphkin.plans.pen import Pen, Says, image, named, second_image
from graphkin.plans.position import plate_points, set_on_guide, turn_about
from graphkin.plans.shape import Shapes
from graphkin.plans.trial import TrialPen
from graphkin.scene.model import FRAME, Driver
from graphkin.steps.closing import (
    Trying,
    beside_line,
    between,
    cosine_between,
    excess,
    far,
    from_to,
    inverse,
    lacks,
    lacks_across,
    less,
    line_through,
    on_line,
    part,
    product,
    reach,
    share,
    sine_between,
)
from graphkin.steps.guides import axis_with_guide, turned_back
from graphkin.steps.program import Part, Plane, Target
from graphkin.steps.vocabulary import coordinate, meet, part_along
from graphkin.structure.graph import Contact, Pin, Sliding
from graphkin.structure.groups import Dyad, Group, Higher, Tie
from graphkin.structure.joints import partner

Each = Callable[[Pen, Shapes, Group, tuple[Base, ...]], None]
"""How one group is put down: the function of the compiler for one of the three plans."""


# --- position ------------------------------------------------------------------------------------


def position(pen: Pen, shapes: Shapes, group: Higher, each: Each) -> None:
    """The mechanism to scale: the tried link where the locus says, then dyad by dyad."""
    trying, inputs = trial_of(pen, group, each)
    number = closure_of(pen.scene, group)
    says: Says = {"k": group.trial.link, "n": str(number), "list": ", ".join(group.links)}
    says |= cut_at(group.last)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        closing = pen.draw(trying.action(number), *inputs, **says)
        tried = pen.draw(part, closing, extra=(0,), **says)
        dyads = [dyad for dyad in group.chain if chooses(dyad)]
        for k, dyad in enumerate(dyads, 1):
            assert isinstance(dyad, Dyad)
            pen.chosen[dyad.links] = pen.draw(part, closing, extra=(k,))
    build(pen, shapes, group, each, tried)


def cut_at(last: Tie | Driver) -> Says:
    """Where a group is cut: a bar or a guide with the pin beside it, or a driver that waits."""
    match last:
        case Tie(_, Pin(point=p), Pin(point=q)):
            return {"p": p, "q": q}
        case Tie(_, Pin(point=p), Sliding(links=(block, _))):
            return {"q": p, "g": block}
        case Driver(link=link):
            return {"d": link}
    raise AssertionError(last)


def chooses(group: Group) -> bool:
    """Whether a group of the chain can close in two ways."""
    return isinstance(group, Dyad) and group.type in ("RRR", "RRP", "RPR", "RRW")


def build(pen: Pen, shapes: Shapes, group: Higher, each: Each, tried: int) -> None:
    """The whole group in the plane, from the tried value."""
    place_trial(pen, shapes, group, tried)
    for member in (*group.chain, *ending(group)):
        each(pen, shapes, member, bases(pen.scene, member))


def place_trial(pen: Pen, shapes: Shapes, group: Higher, tried: int) -> None:
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
    shapes = Shapes(fork)
    tried = fork.input_step()
    dyads = [dyad for dyad in group.chain if isinstance(dyad, Dyad) and chooses(dyad)]
    signs = [fork.input_step() for _ in dyads]
    fork.chosen |= {dyad.links: sign for dyad, sign in zip(dyads, signs, strict=True)}
    turns = isinstance(group.trial.pair, Pin)
    build(fork, shapes, group, each, tried)
    with fork.on(Part.POSITION, Plane.NUMBERS):
        fit = misfit(fork, shapes, group.last)
        written = [name for name in pen.scene.links if name in group.links]
        axes = tuple(axis(fork, shapes, name) for name in written)
        reach = None if turns else reach_of(fork, shapes, group)
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
    )
    return trying, list(fork.inputs.values())


@dataclass(frozen=True, slots=True)
class Misfit:
    """What must vanish, the point whose locus it is read from, and what must be positive."""

    size: int
    locus: int
    facing: int | None = None


def misfit(pen: Pen, shapes: Shapes, last: Tie | Driver) -> Misfit:
    """By how much the last link, or the driver that comes last, does not fit a trial."""
    match last:
        case Tie(link, Pin(point=p), Pin(point=q)):
            ends = pen.the("position", p), pen.the("position", q)
            length = shapes.length(link, p, q)
            return Misfit(pen.draw(excess, *ends, length), pen.draw(from_to, *ends))
        case Tie(link, Pin(point=p), Sliding() as pair):
            line = path_of(pen, shapes, pair, link, p)
            place = pen.the("position", p)
            return Misfit(pen.draw(beside_line, line, place), pen.draw(on_line, line, place))
        case Driver(kind="turn") as driver:
            return turn_misfit(pen, shapes, driver)
        case Driver(kind="slide") as driver:
            guide = standing_guide(pen, shapes, slide_of(pen, driver))
            first = pen.the("position", pen.scene.link(driver.link).points[0])
            found = pen.draw(less, pen.draw(coordinate, guide, first), pen.drive(driver).position)
            return Misfit(found, found)
        case Driver() as driver:
            found = pen.draw(less, pen.the("rolled", driver.link), pen.drive(driver).position)
            return Misfit(found, found)
    raise AssertionError(last)


def turn_misfit(pen: Pen, shapes: Shapes, driver: Driver) -> Misfit:
    """By how much a link is turned otherwise than its driver says."""
    lead = axis(pen, shapes, driver.link)
    if driver.of:
        lead = pen.draw(axis_with_guide, lead, *(shapes.local(driver.link, p) for p in driver.of))
    if driver.against != FRAME:
        lead = pen.draw(turned_back, lead, axis(pen, shapes, driver.against))
    wanted = pen.drive(driver).position
    sine = pen.draw(sine_between, lead, wanted)
    return Misfit(sine, sine, pen.draw(cosine_between, lead, wanted))


def slide_of(pen: Pen, driver: Driver) -> Sliding:
    """The pair that a driver slides."""
    slides = pen.scene.links[driver.link].slides
    return next(Sliding(s, (driver.link, s.on)) for s in slides if s.on == driver.against)


def reach_of(pen: Pen, shapes: Shapes, group: Higher) -> int:
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


# --- velocity and acceleration: two trial plans ---------------------------------------------------


def velocity(pen: Pen, shapes: Shapes, group: Higher, each: Each) -> None:
    """The velocity plan: two trials, the share between them that fits, and every point by it."""
    two_trials(pen, shapes, group, each, VELOCITY)


def acceleration(pen: Pen, shapes: Shapes, group: Higher, each: Each) -> None:
    """The acceleration plan in the same way; normal components and Coriolis are known by then."""
    two_trials(pen, shapes, group, each, ACCELERATION)


@dataclass(frozen=True, slots=True)
class Kind:
    """What differs between the two plans."""

    quantity: str
    rate: str
    part: Part
    plane: Plane
    named: Callable[[str], str]


VELOCITY = Kind("velocity", "omega", Part.VELOCITY, Plane.VELOCITIES, image)
ACCELERATION = Kind("acceleration", "epsilon", Part.ACCELERATION, Plane.ACCELERATIONS, second_image)


def two_trials(pen: Pen, shapes: Shapes, group: Higher, each: Each, kind: Kind) -> None:
    """Two wrong plans give the right one: what is missed is linear in what is tried."""
    layers, misses = [], []
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        values = pen.given("nought"), trial_value(pen, group, kind)
    for tag, value in zip("¹²", values, strict=True):
        with pen.trial(tag) as layer:
            move_trial(pen, shapes, group, kind, value)
            for member in group.chain:
                each(pen, shapes, member, bases(pen.scene, member))
            misses.append(missed(pen, shapes, group, kind))
        layers.append(layer)
    with pen.on(kind.part, Plane.NUMBERS):
        says: Says = {"k": group.trial.link, **cut_at(group.last)}
        divided = pen.draw(share, *misses, **says)
    settle(pen, group, kind, layers, divided)
    for last in ending(group):
        each(pen, shapes, last, bases(pen.scene, last))
    for link in group.links:
        omega_of(pen, link, kind.rate)


def trial_value(pen: Pen, group: Higher, kind: Kind) -> int:
    """The second trial: as fast as the driver turns, or slides by a bar in that time."""
    rate = pen.draw(inverse, pen.seconds())
    if kind is ACCELERATION:
        rate = pen.draw(product, rate, rate)
    if isinstance(group.trial.pair, Pin):
        return rate
    return pen.draw(product, rate, pen.draw(far, *places_of(pen, group)))


def places_of(pen: Pen, group: Higher) -> list[int]:
    """Where the points of a group stand, that of the tried link first."""
    start = pen.bases[group.trial.link].start
    points = dict.fromkeys((start, *(p for n in group.links for p in pen.scene.link(n).points)))
    return [pen.the("position", point) for point in points]


def move_trial(pen: Pen, shapes: Shapes, group: Higher, kind: Kind, value: int) -> None:
    """The tried link in a trial plan."""
    trial, base = group.trial, pen.bases[group.trial.link]
    match trial.pair:
        case Pin(point=pivot):
            pen.want(kind.rate, trial.link, value)
            if base.end is not None:
                if kind is VELOCITY:
                    velocities.turn_tip(pen, trial.link, pivot, base.end)
                else:
                    accelerations.turn_tip(pen, trial.link, pivot, base.end)
        case _ as pair:
            slide = velocities.slide_on if kind is VELOCITY else accelerations.slide_on
            slide(pen, shapes, pair, trial.link, value)
    if kind is VELOCITY:
        velocities.plate_points(pen, shapes, base)
    else:
        accelerations.plate_points(pen, shapes, base)


def missed(pen: Pen, shapes: Shapes, group: Higher, kind: Kind) -> int:
    """What a trial plan misses at the link or driver that comes last."""
    last = group.last
    match last:
        case Tie(link, Pin(point=p), Pin(point=q)):
            ends = [pen.the(what, x) for what in ("position", kind.quantity) for x in (p, q)]
            wanted = pen.given("origin")
            if kind is ACCELERATION:
                wanted = normal_component(pen, p, q)
            with pen.on(kind.part, Plane.NUMBERS):
                return pen.draw(lacks, *ends, wanted)
        case Tie(link, Pin(point=p), Sliding() as pair):
            known = partner(pair, link)
            line = known_guide(pen, shapes, pair)
            if kind is VELOCITY:
                start = image_under(pen, known, p)
            else:
                start = accelerations.guide_corner(pen, pair, link, p)
            with pen.on(kind.part, Plane.NUMBERS):
                return pen.draw(lacks_across, line, start, pen.the(kind.quantity, p))
        case Driver(kind="turn") as driver:
            given = getattr(pen.drive(driver), "speed" if kind is VELOCITY else "acceleration")
            own = omega_of(pen, driver.link, kind.rate)
            if driver.against != FRAME:
                with pen.on(kind.part, Plane.NUMBERS):
                    own = pen.draw(less, own, omega_of(pen, driver.against, kind.rate))
            with pen.on(kind.part, Plane.NUMBERS):
                return pen.draw(less, own, given)
        case Driver() as driver:
            return missed_slide(pen, shapes, driver, kind)
    raise AssertionError(last)


def missed_slide(pen: Pen, shapes: Shapes, driver: Driver, kind: Kind) -> int:
    """What a trial plan misses of a given sliding speed or acceleration."""
    pair = slide_of(pen, driver)
    first = pen.scene.link(driver.link).points[0]
    given = getattr(pen.drive(driver), "speed" if kind is VELOCITY else "acceleration")
    line = known_guide(pen, shapes, pair)
    if kind is VELOCITY:
        start = image_under(pen, driver.against, first)
    else:
        start = accelerations.guide_corner(pen, pair, driver.link, first)
    with pen.on(kind.part, Plane.NUMBERS):
        found = pen.draw(part_along, line, start, pen.the(kind.quantity, first))
        return pen.draw(less, found, given)


def settle(
    pen: Pen, group: Higher, kind: Kind, layers: list[dict[Target, int]], divided: int
) -> None:
    """Every point of the right plan, on the lines through its two trials."""
    first, second = layers
    for (quantity, of), one in first.items():
        two = second[quantity, of]
        if quantity == kind.rate and own_rate(pen, of):
            with pen.on(Part.RESULT, Plane.NUMBERS):
                pen.want(quantity, of, pen.draw(between, one, two, divided, name=of))
        elif quantity == kind.quantity and one == two:
            pen.want(quantity, of, one)
        elif quantity == kind.quantity:
            by_hand = crossing(pen, group, kind, of, one, two)
            says: Says = {"q": of, "a": named(pen, one), "b": named(pen, two)}
            with pen.on(kind.part, kind.plane):
                found = pen.draw(
                    between, one, two, divided, name=kind.named(of), by_hand=by_hand, **says
                )
            pen.want(quantity, of, found)
            if "@" not in of:
                finish(pen, kind, of)


def crossing(pen: Pen, group: Higher, kind: Kind, of: str, one: int, two: int) -> int | None:
    """The hand's way to the pin that closes a group: its line cuts the perpendicular to its bar."""
    match group.last:
        case Tie(_, Pin(point=p), Pin(point=q)) if of in (p, q):
            other = p if of == q else q
        case _:
            return None
    if not pen.has(kind.quantity, other):
        return None
    vector = normal_component(pen, other, of) if kind is ACCELERATION else None
    with pen.on(kind.part, kind.plane), pen.hands_way():
        line = pen.draw(line_through, one, two, a=named(pen, one), b=named(pen, two))
        if vector is None:
            return pen.draw(meet, line, velocities.square(pen, other, of))
        corner = lay_off_normal(pen, other, of, vector)
        return pen.draw(meet, line, square(pen, other, of, corner))


def own_rate(pen: Pen, link: str) -> bool:
    """Whether no two points of a link tell how it turns: the tried link with one pin."""
    base = pen.bases.get(link)
    return base is not None and base.end is None and link not in pen.leads and pen.turns(link)


def finish(pen: Pen, kind: Kind, point: str) -> None:
    """The arrow to a point of the right plan."""
    if kind is VELOCITY:
        starts = {b.start for b in pen.bases.values() if point in (*b.others, b.end)}
        velocities.arrow_to(pen, point, next(iter(sorted(starts)), None))
    else:
        accelerations.arrow_to(pen, point)
