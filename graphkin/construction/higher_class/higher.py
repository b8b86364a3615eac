"""Groups of class III and higher: one link is tried until a locus shows that it fits.

Once the position of that link is known, the others follow as dyads.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from graphkin.construction.core.bases import Base, bases, ending
from graphkin.construction.core.branches import closure_of, has_two_ways
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Given, Part, Plane, Step
from graphkin.construction.core.vocabulary import action, coordinate, difference, product
from graphkin.construction.group_images import led_by
from graphkin.construction.guides.guides import (
    axis,
    axis_with_guide,
    path_of,
    standing_guide,
    turned_back,
)
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.construction.higher_class.closure_solver import Trying
from graphkin.construction.higher_class.trial import Unknown
from graphkin.construction.links.link_shapes import bar_length, local_place
from graphkin.construction.links.plate_points import plate_points, turn_about
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line, cross, dot
from graphkin.scene.model import FRAME, Driver
from graphkin.structure.groups import Dyad, Group, Higher, KeptParallel, Stretched, Tie, TriedLink
from graphkin.structure.pairs import Pin, Sliding, partner

Each = Callable[[Pen, Group, tuple[Base, ...]], None]
"""The compiler's function that draws one group, for one of the three plans."""


def part_of(closing: tuple[Any, ...] | float, place: int) -> Any:
    """One of the values that close a group; NaN where nothing closes it."""
    return closing if isinstance(closing, float) else closing[place]


@action("part", margin=lambda closing, place: part_of(closing, -1))
def part(closing: tuple[Any, ...] | float, place: int) -> Any:
    """One of the values that close a group: the trial value, or a dyad's sign."""
    return part_of(closing, place)


@action("excess")
def excess(p: Point, q: Point, length: Real) -> Real:
    """The distance between two points, less the length of a bar."""
    return abs(q - p) - length


@action("from-to")
def from_to(p: Point, q: Point) -> Point:
    return q - p


@action("on-line")
def on_line(line: Line, point: Point) -> Point:
    """A point in the axes of a line: distance along it, and distance to its left."""
    return (point - line.point) * line.along.conjugate() / abs(line.along)


@action("beside-line")
def beside_line(line: Line, point: Point) -> Real:
    """The distance of a point to the left of a line."""
    return cross(line.along, point - line.point) / abs(line.along)


@action("sine-between")
def sine_between(axis: Point, other: Point) -> Real:
    """Sine of the angle between two directions; zero where they agree or are opposed."""
    return cross(other, axis)


@action("cosine-between")
def cosine_between(axis: Point, other: Point) -> Real:
    """Cosine of the angle between two directions: positive where they agree."""
    return dot(other, axis)


@action("inverse")
def inverse(seconds: Real) -> Real:
    """The rate of one radian in a time."""
    return 1 / seconds


@action("reach")
def reach(line: Line, *rest: Any) -> Real:
    """The distance along a line, from its own point, that the bars of a group allow.

    ``rest`` holds the lengths, then the known points, then the number of lengths.
    """
    return 1.01 * spanned(line.point, *rest)


@action("span")
def span(*rest: Any) -> Real:
    """The total reach of bars and known points; ``rest`` is as in ``reach``."""
    return spanned(rest[rest[-1]], *rest)


def spanned(start: Point, *rest: Any) -> Real:
    """The sum of lengths and of the distances of points from one point."""
    *values, count = rest
    total: Real = 0.0
    for number, value in enumerate(values):
        total = total + abs(value if number < count else value - start)
    return total


def position(pen: Pen, group: Higher, each: Each) -> None:
    """Draw the position: the tried link where the locus fits, then dyad by dyad."""
    trying, inputs = trial_of(pen, group, each)
    number, dyads = closure_of(pen.scene, group), choosing_dyads(group)
    counted, traced = counted_by(pen, group), tuple(traced_points(pen, group))
    unknowns = len(group.nested)
    with pen.on(Part.POSITION, Plane.NUMBERS):
        closing = pen.draw(trying.action(number), *inputs)
        values = [pen.draw(part, closing, extra=(k,)) for k in range(unknowns + len(dyads))]
    tried, sides = tuple(values[:unknowns]), tuple(values[unknowns:])
    pen.chosen |= {dyad.links: side for dyad, side in zip(dyads, sides, strict=True)}
    pen.make(ClosedGroup(group, number, counted, traced, closing, tried, sides))
    build(pen, group, each, iter(tried))


def counted_by(pen: Pen, group: Higher) -> str:
    """The first written link whose angle differs between closures.

    Known links fix the angles of links that slide on them, that drivers turn against them, or that
    bars keep parallel to them.
    """
    scene = pen.scene
    joined = [{k.name, slide.on} for k in scene.links.values() for slide in k.slides]
    joined += [{driver.link, driver.against} for driver in scene.drivers if driver.kind == "turn"]
    joined += [{each.link, each.lead} for each in group.members if isinstance(each, KeptParallel)]
    held = {FRAME, *pen.bases} - set(group.links)
    while more := {link for pair in joined if pair & held for link in pair} - held:
        held |= more
    written = [name for name in scene.links if name in group.links]
    return next((name for name in written if name not in held), written[0])


def choosing_dyads(group: Higher) -> list[Dyad]:
    """The dyads of the chain that can close in two ways."""
    dyads = [each.dyad if isinstance(each, Stretched) else each for each in group.members]
    return [d for d in dyads if isinstance(d, Dyad) and (d.type == "RRR" or has_two_ways(d))]


def build(
    pen: Pen,
    group: Higher,
    each: Each,
    tried: Iterator[int],
    closed: Callable[[Higher], None] = lambda group: None,
) -> None:
    """Draw the whole group in the plane, from the trial values of it and of the groups within it.

    ``closed`` is called for each group once its links are placed, from the innermost outwards.
    """
    place_trial(pen, group, next(tried))
    for member in group.chain:
        if isinstance(member, Higher):
            build(pen, member, each, tried, closed)
        else:
            each(pen, member, bases(pen.scene, member))
    for last in ending(group):
        each(pen, last, bases(pen.scene, last))
    if not isinstance(group.last, Tie | Driver):
        led_by(group.last).stand(pen)
    closed(group)


def place_trial(pen: Pen, group: Higher, tried: int) -> None:
    """Place the tried link: turn it about its pin, or set it along its guide or track."""
    trial, (base,) = group.tried, bases(pen.scene, group.tried)
    pen.bases[trial.link] = base
    match trial.pair:
        case Pin(point=pivot):
            with pen.on(Part.POSITION, Plane.MECHANISM):
                turn_about(pen, trial.link, (pivot, base.end), (), tried)
        case pair:
            led_by(pair).set_at(pen, trial.link, tried)
    plate_points(pen, base)


def trial_of(pen: Pen, group: Higher, each: Each) -> tuple[Trying, list[int]]:
    """The program of the trial, and the steps that it takes as known."""
    fork = TrialPen(pen)
    tried = {one.links: fork.input_step() for one in group.nested}
    dyads = choosing_dyads(group)
    signs = [fork.input_step() for _ in dyads]
    fork.chosen |= {dyad.links: sign for dyad, sign in zip(dyads, signs, strict=True)}
    found = dict[tuple[str, ...], Unknown]()

    def closed(one: Higher) -> None:
        with fork.on(Part.POSITION, Plane.NUMBERS):
            found[one.links] = unknown(fork, one, group, tried[one.links])

    build(fork, group, each, iter(tried.values()), closed)
    unknowns = tuple(found[links] for links in tried)
    with fork.on(Part.POSITION, Plane.NUMBERS):
        written = [name for name in pen.scene.links if name in group.links]
        axes = tuple(axis(fork, name) for name in written)
    traced = tuple(fork.the("position", point) for point in traced_points(pen, group))
    kept = (end for one in unknowns for end in one.ends)
    fork.keep_inputs(*kept, *axes, *traced)
    kind: type[Trying] = Trying
    if len(unknowns) > 1:
        from graphkin.construction.higher_class.several_trials import SeveralTrials

        kind = SeveralTrials
    trying = kind(
        fork.program(), pen.scene.values, tuple(fork.inputs), unknowns, tuple(signs), axes, traced
    )
    return trying, list(fork.inputs.values())


def unknown(pen: TrialPen, group: Higher, whole: Higher, tried: int) -> Unknown:
    """The unknown of a group within a ``whole``: its trial value, its misfit and its range."""
    fit, pair = misfit(pen, group), group.tried.pair
    if isinstance(pair, Pin):
        return Unknown(tried, True, *fit)
    far = reach_of(pen, group) if group is whole else span_of(pen, whole)
    return Unknown(tried, False, *fit, far, led_by(pair).rim(pen))


def traced_points(pen: Pen, group: Higher) -> list[str]:
    """The points whose loci are drawn by hand: the ends of the last link that are not yet placed.

    Empty where no point shows the fit: the guide of the last link must be placed.
    """
    match group.last:
        case Tie(_, Pin(point=p), Pin(point=q)):
            return [point for point in (p, q) if not pen.has("position", point)]
        case Tie(link, Pin(point=p), Sliding() as pair) if is_placed(pen, partner(pair, link)):
            return [p]
    return []


def is_placed(pen: Pen, link: str) -> bool:
    """Whether a link is already placed."""
    return link == FRAME or pen.has("axis", link)


class Misfit(NamedTuple):
    """The quantity that must vanish, the point whose locus shows it, and what must be positive."""

    size: int
    locus: int
    facing: int | None = None


def misfit(pen: Pen, group: Higher) -> Misfit:
    """The misfit of the last link, or of the driver that comes last, at a trial.

    For a driver, the locus is that of the tried link: at a dead point the tried link moves and the
    driver's own link does not.
    """
    match group.last:
        case Tie(link, Pin(point=p), Pin(point=q)):
            ends = pen.the("position", p), pen.the("position", q)
            length = bar_length(pen, link, p, q)
            return Misfit(pen.draw(excess, *ends, length), pen.draw(from_to, *ends))
        case Tie(link, Pin(point=p), Sliding() as pair):
            line = path_of(pen, pair, link, p)
            place = pen.the("position", p)
            return Misfit(pen.draw(beside_line, line, place), pen.draw(on_line, line, place))
        case Driver(kind="turn") as driver:
            return turn_misfit(pen, driver, group)
        case Driver(kind="slide") as driver:
            guide = standing_guide(pen, slide_of(pen, driver))
            first = pen.the("position", pen.scene.link(driver.link).points[0])
            found = pen.draw(
                difference, pen.draw(coordinate, guide, first), pen.drive(driver).position
            )
            return Misfit(found, tried_point(pen, group.tried))
        case Driver() as driver:
            found = pen.draw(difference, pen.the("rolled", driver.link), pen.drive(driver).position)
            return Misfit(found, tried_point(pen, group.tried))
        case wheel if not isinstance(wheel, Tie):
            return Misfit(led_by(wheel).slip(pen), tried_point(pen, group.tried))
    raise AssertionError(group.last)


def tried_point(pen: Pen, trial: TriedLink) -> int:
    """The point of the tried link that its trial moves farthest."""
    base = pen.bases[trial.link]
    far = base.end if isinstance(trial.pair, Pin) else None
    return pen.the("position", far or base.start)


def turn_misfit(pen: Pen, driver: Driver, group: Higher) -> Misfit:
    """The difference between a link's angle and the angle that its driver gives."""
    lead = axis(pen, driver.link)
    if driver.of:
        lead = pen.draw(
            axis_with_guide, lead, *(local_place(pen, driver.link, p) for p in driver.of)
        )
    if driver.against != FRAME:
        lead = pen.draw(turned_back, lead, axis(pen, driver.against))
    wanted = pen.drive(driver).position
    sine = pen.draw(sine_between, lead, wanted)
    moved = axis(pen, group.tried.link)
    if not isinstance(group.tried.pair, Pin):
        size = pen.draw(inverse, reach_of(pen, group))
        moved = pen.draw(product, tried_point(pen, group.tried), size)
    return Misfit(sine, moved, pen.draw(cosine_between, lead, wanted))


def slide_of(pen: Pen, driver: Driver) -> Sliding:
    """The pair that a driver slides."""
    slides = pen.scene.links[driver.link].slides
    return next(Sliding(s, (driver.link, s.on)) for s in slides if s.on == driver.against)


def reach_of(pen: Pen, group: Higher) -> int:
    """The range along its guide in which the tried link is searched for, from the lengths."""
    pair = group.tried.pair
    assert not isinstance(pair, Pin)
    line = led_by(pair).line(pen)
    lengths = lengths_of(pen, group)
    known = [pen.the("position", p) for p in known_points(pen, group)]
    return pen.draw(reach, line, *lengths, *known, extra=(len(lengths),))


def span_of(pen: Pen, group: Higher) -> int:
    """The range along a moving guide in which a link of a group is searched for."""
    lengths = lengths_of(pen, group)
    known = [pen.the("position", p) for p in known_points(pen, group)]
    return pen.draw(span, *lengths, *known, extra=(len(lengths),))


def lengths_of(pen: Pen, group: Higher) -> list[int]:
    """The lengths of the bars of a group, and the lengths that its drivers set.

    A cam's centre of curvature is not the end of a bar: it follows once the group is placed.
    """
    lengths = [
        bar_length(pen, name, points[0], point)
        for name in group.links
        for points in (pen.scene.link(name).points,)
        for point in points[1:]
        if point not in pen.scene.cam_centres
    ]
    slid = (d for d in pen.scene.drivers if d.kind != "turn" and d.link in group.links)
    return lengths + [pen.drive(driver).position for driver in slid]


def known_points(pen: Pen, group: Higher) -> list[str]:
    """The points of a group that are also on known links."""
    parent = pen.parent if isinstance(pen, TrialPen) else pen
    points = dict.fromkeys(p for name in group.links for p in pen.scene.link(name).points)
    return [point for point in points if parent.has("position", point)]


class TrialPen(Pen):
    """Writes a program of its own; ``inputs`` maps each of its inputs to the parent pen's step."""

    def __init__(self, parent: Pen) -> None:
        super().__init__(parent.scene)
        self.parent = parent
        self.bases |= parent.bases
        self.leads |= parent.leads
        self.inputs: dict[int, int] = {}

    def input_step(self) -> int:
        """A step whose value comes from outside."""
        return self._add(Step(None, (), Part.POSITION, Plane.NUMBERS, given=Given("input", ())))

    def given(
        self, form: str, *quantities: Any, name: str = "", of: int | str | None = None
    ) -> int:
        """A given value of the scene, taken as an input so that it may vary in a batch."""
        number = self.parent.given(form, *quantities, name=name, of=of)
        key = ("given", number)
        if key not in self.shared:
            self.shared[key] = self.input_step()
            self.inputs[self.shared[key]] = number
        return self.shared[key]

    def keep_inputs(self, *results: int | None) -> None:
        """Drop the inputs that neither a step nor a result uses, such as a driver's speed."""
        used = {*results, *(arg for step in self.steps for arg in step.args)}
        self.inputs = {own: known for own, known in self.inputs.items() if own in used}

    def peek(self, number: int) -> Any:
        """Value of a step at the scene's own numbers; None where it depends on a trial value."""
        for step, known in self.inputs.items():
            if step not in self.peeked:
                self.peeked[step] = self.parent.peek(known)
        return super().peek(number)

    def has(self, quantity: str, of: str) -> bool:
        """Whether a quantity has been constructed here or by the parent pen."""
        return super().has(quantity, of) or self.parent.has(quantity, of)

    def the(self, quantity: str, of: str) -> int:
        """The step of a quantity; a step of the parent pen becomes an input."""
        if not super().has(quantity, of):
            number = self.input_step()
            self.inputs[number] = self.parent.the(quantity, of)
            self.targets[quantity, of] = number
        return super().the(quantity, of)
