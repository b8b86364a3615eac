"""Velocities and accelerations of higher groups: two trial plans, and the share that fits.

What a trial misses grows in proportion to what was tried (method of two plans, false position).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphkin.construction.acceleration import acceleration as accelerations
from graphkin.construction.core.arrows import acceleration_arrow, velocity_arrows
from graphkin.construction.core.bases import bases, ending
from graphkin.construction.core.pen import Pen, Says, image, named, second_image
from graphkin.construction.core.program import Part, Plane, Target
from graphkin.construction.core.vocabulary import distance, part_along, sum_of
from graphkin.construction.guides.coincident_points import image_under, omega_of
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.guides.sliding import known_end
from graphkin.construction.higher_class.higher import Each, cut_at, slide_of
from graphkin.construction.higher_class.trial_actions import (
    between,
    far,
    inverse,
    lacks,
    lacks_across,
    less,
    product,
    share,
    share_on_line,
)
from graphkin.construction.higher_class.trial_arrows import components, relative_arrows
from graphkin.construction.higher_class.trial_crossing import crossed_point, crossing
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.normal_component.normal_component import normal_component
from graphkin.construction.velocity import velocity as velocities
from graphkin.scene.model import FRAME, Driver
from graphkin.structure.groups import Higher, Tie
from graphkin.structure.joints import partner
from graphkin.structure.pairs import Pin, Sliding


def velocity(pen: Pen, shapes: LinkShapes, group: Higher, each: Each) -> None:
    """The velocity plan: two trials, the share between them that fits, and every point by it."""
    two_trials(pen, shapes, group, each, VELOCITY)


def acceleration(pen: Pen, shapes: LinkShapes, group: Higher, each: Each) -> None:
    """The acceleration plan in the same way; what follows from velocities is known by then."""
    two_trials(pen, shapes, group, each, ACCELERATION)


@dataclass(frozen=True, slots=True)
class TrialQuantity:
    """What differs between the two plans."""

    quantity: str
    rate: str
    part: Part
    plane: Plane
    named: Callable[[str], str]


VELOCITY = TrialQuantity("velocity", "omega", Part.VELOCITY, Plane.VELOCITIES, image)
ACCELERATION = TrialQuantity(
    "acceleration", "epsilon", Part.ACCELERATION, Plane.ACCELERATIONS, second_image
)


def two_trials(
    pen: Pen, shapes: LinkShapes, group: Higher, each: Each, kind: TrialQuantity
) -> None:
    """Two wrong plans give the right one: what is missed is linear in what is tried."""
    layers, misses, begun = [], [], []
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        at_rest = pen.given("nought", name=f"{kind.rate} tried of {group.trial.link}")
        values = at_rest, trial_value(pen, group, kind)
    for tag, value in zip("¹²", values, strict=True):
        begun.append(len(pen.steps))
        with pen.trial(tag) as layer:
            move_trial(pen, shapes, group, kind, value)
            for member in group.chain:
                each(pen, shapes, member, bases(pen.scene, member))
            misses.append(missed(pen, shapes, group, kind))
        layers.append(layer)
    tried = range(begun[1], len(pen.steps))
    crossed = crossings(pen, shapes, group, kind, layers)
    with pen.on(kind.part, Plane.NUMBERS):
        by_hand = None
        for point, found in crossed.items():
            with pen.hands_way():
                by_hand = pen.draw(share_on_line, *trials_of(layers, kind, point), found)
        says: Says = {"k": group.trial.link, "tried": "{} {}".format(*values), **cut_at(group.last)}
        divided = pen.draw(share, *misses, by_hand=by_hand, **says)
    settle(pen, group, kind, layers, divided, crossed)
    if kind is ACCELERATION:
        components(pen, group, layers[1], tried)
    for last in ending(group):
        each(pen, shapes, last, bases(pen.scene, last))
    for link in group.links:
        omega_of(pen, link, kind.rate)


def trial_value(pen: Pen, group: Higher, kind: TrialQuantity) -> int:
    """The second trial: as fast as the driver turns, or slides by a bar in that time.

    An acceleration is as large as the squares of that and of how fast the link has been found to
    turn make it: a trial far too small misses nearly as much as none, and digits are lost. On paper
    a round number takes its place (trial_rates).
    """
    rate = pen.draw(inverse, pen.seconds())
    turns = isinstance(group.trial.pair, Pin)
    bar = None if turns else pen.draw(far, *places_of(pen, group))
    if kind is ACCELERATION:
        with pen.on(kind.part, Plane.NUMBERS):
            own = omega_of(pen, group.trial.link) if bar is None else slid_rate(pen, group, bar)
            squares = (pen.draw(product, each, each) for each in (rate, own))
            rate = pen.draw(sum_of, *squares)
    return rate if bar is None else pen.draw(product, rate, bar)


def slid_rate(pen: Pen, group: Higher, bar: int) -> int:
    """How fast the tried link slides or rolls on what is known, in bars a second."""
    pair, point = group.trial.pair, pen.bases[group.trial.link].start
    assert not isinstance(pair, Pin)
    under = image_under(pen, partner(pair, group.trial.link), point)
    speed = pen.draw(distance, under, pen.the("velocity", point))
    return pen.draw(product, speed, pen.draw(inverse, bar))


def places_of(pen: Pen, group: Higher) -> list[int]:
    """Where the points of a group stand, that of the tried link first."""
    start = pen.bases[group.trial.link].start
    points = dict.fromkeys((start, *(p for n in group.links for p in pen.scene.link(n).points)))
    return [pen.the("position", point) for point in points]


def move_trial(
    pen: Pen, shapes: LinkShapes, group: Higher, kind: TrialQuantity, value: int
) -> None:
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


def missed(pen: Pen, shapes: LinkShapes, group: Higher, kind: TrialQuantity) -> int:
    """What a trial plan misses at the link or driver that comes last."""
    last = group.last
    match last:
        case Tie(link, Pin(point=p), Pin(point=q)):
            p, q = in_order((p, q), [of for what, of in pen.layer or {} if what == kind.quantity])
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
                start = known_end(pen, pair, link, p)
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


def missed_slide(pen: Pen, shapes: LinkShapes, driver: Driver, kind: TrialQuantity) -> int:
    """What a trial plan misses of a given sliding speed or acceleration."""
    pair = slide_of(pen, driver)
    first = pen.scene.link(driver.link).points[0]
    given = getattr(pen.drive(driver), "speed" if kind is VELOCITY else "acceleration")
    line = known_guide(pen, shapes, pair)
    if kind is VELOCITY:
        start = image_under(pen, driver.against, first)
    else:
        start = known_end(pen, pair, driver.link, first)
    with pen.on(kind.part, Plane.NUMBERS):
        found = pen.draw(part_along, line, start, pen.the(kind.quantity, first))
        return pen.draw(less, found, given)


def trials_of(layers: list[dict[Target, int]], kind: TrialQuantity, point: str) -> tuple[int, int]:
    """The images of a point in both trial plans."""
    first, second = (layer[kind.quantity, point] for layer in layers)
    return first, second


def crossings(
    pen: Pen,
    shapes: LinkShapes,
    group: Higher,
    kind: TrialQuantity,
    layers: list[dict[Target, int]],
) -> dict[str, int]:
    """The point that a line known before the trials finds by a crossing, and the step that does."""
    images = [of for what, of in layers[0] if what == kind.quantity]
    tried = {of for of in images if len({*trials_of(layers, kind, of)}) > 1}
    point = crossed_point(pen, group, kind.quantity, tried)
    if point is None:
        return {}
    ends = trials_of(layers, kind, point)
    return {point: crossing(pen, shapes, group, kind.quantity, point, ends)}


def settle(
    pen: Pen,
    group: Higher,
    kind: TrialQuantity,
    layers: list[dict[Target, int]],
    divided: int,
    crossed: dict[str, int],
) -> None:
    """Every point of the right plan, on the lines through its two trials."""
    first, second = layers
    settled: list[str] = []
    for (quantity, of), one in first.items():
        two = second[quantity, of]
        if quantity == kind.rate and own_rate(pen, of):
            with pen.on(Part.RESULT, Plane.NUMBERS):
                pen.want(quantity, of, pen.draw(between, one, two, divided, name=of))
        elif quantity == kind.quantity and one == two:
            pen.want(quantity, of, one)
        elif quantity == kind.quantity:
            says: Says = {"q": of, "a": named(pen, one), "b": named(pen, two)}
            with pen.on(kind.part, kind.plane):
                found = pen.draw(
                    between,
                    one,
                    two,
                    divided,
                    name=kind.named(of),
                    by_hand=crossed.get(of),
                    **says,
                )
            pen.want(quantity, of, found)
            settled.append(of)
    closing: tuple[str, ...] = ()
    match group.last:
        case Tie(_, Pin(point=p), Pin(point=q)):
            closing = in_order((p, q), settled)
    for point in settled:
        if "@" not in point:
            finish(pen, kind, point, closing)
        elif kind is VELOCITY:
            relative_arrows(pen, point)
    if closing and kind is VELOCITY:
        velocity_arrows(pen, closing[1], closing[0])


def in_order(ends: tuple[str, str], found: list[str]) -> tuple[str, ...]:
    """The ends of the bar that closes a group, the one that is known or found first before."""
    return tuple(sorted(ends, key=lambda end: found.index(end) if end in found else -1))


def own_rate(pen: Pen, link: str) -> bool:
    """Whether no two points of a link tell how it turns: the tried link with one pin."""
    base = pen.bases.get(link)
    return base is not None and base.end is None and link not in pen.leads and pen.turns(link)


def finish(pen: Pen, kind: TrialQuantity, point: str, closing: tuple[str, ...]) -> None:
    """The arrows to a point of the right plan; none against the end of a bar that is found last."""
    if kind is VELOCITY:
        starts = {b.start for b in pen.bases.values() if point == b.end}
        starts = starts or {b.start for b in pen.bases.values() if point in b.others}
        pivots: list[str | None] = [*sorted(starts)]
        for pivot in pivots or [None]:
            velocity_arrows(pen, point, None if (point, pivot) == closing else pivot)
    else:
        acceleration_arrow(pen, point)
