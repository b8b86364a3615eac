"""Velocities and accelerations of higher groups: two trial plans, and the share between them.

The misclosure is linear in the trial rate (method of two plans, false position).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msgspec.structs import replace

from graphkin.construction.core.bases import bases, ending
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import (
    ClosesGroup,
    SaidInParts,
    Sentence,
    construction,
    constructions,
    in_one,
    together,
)
from graphkin.construction.core.naming import drawn_between, driver_index, scale_of, way_of
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep, Part, Plane, Program, Target
from graphkin.construction.core.quantities import OnPaper
from graphkin.construction.core.relation import Relation, answer, drawn_length, figure, within
from graphkin.construction.core.vocabulary import (
    action,
    difference,
    distance,
    part_along,
    product,
    sum_of,
)
from graphkin.construction.group_images import GroupImages
from graphkin.construction.guides.guides import known_guide
from graphkin.construction.higher_class import coupled_train
from graphkin.construction.higher_class.divided_point import (
    SHARE,
    BarMisclosure,
    DividedPoint,
    DrivenMisclosure,
    GuideMisclosure,
    Misclosure,
    crossings,
    lacks,
    lacks_across,
)
from graphkin.construction.higher_class.higher import Each, inverse, slide_of
from graphkin.construction.higher_class.trial_plan import (
    TrialPlan,
    components,
    in_order,
    settle,
    trial_lengths,
)
from graphkin.construction.plan import ACCELERATION, VELOCITY, Plan, omega_of
from graphkin.construction.velocity.image_of_link import image_under
from graphkin.drawing.symbol_markup import TAGS as MARKED
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import dot
from graphkin.scene.model import FRAME, Driver
from graphkin.structure.groups import CoupledTrain, Higher, Tie
from graphkin.structure.pairs import Pin, Sliding, partner

TAGS = tuple(MARKED)
"""The tags of the points of the two plans, behind their names."""


@action("far")
def far(p: Point, *others: Point) -> Real:
    """The mean distance of some points from a point."""
    total: Real = 0.0
    for other in others:
        total = total + abs(other - p)
    return total / len(others)


@action("share")
def share(first: Real, second: Real) -> Real:
    """The fraction of the way between two trials at which a linear misclosure is zero."""
    return first / (first - second)


@action("share-on-line")
def share_on_line(first: Point, second: Point, found: Point) -> Real:
    """The same fraction, measured on the line of the two trials of a point."""
    way = second - first
    return dot(way, found - first) / dot(way, way)


class TwoTrials(ClosesGroup, SaidInParts, frozen=True):
    """The fraction of the way between two trial plans at which the misclosure is zero.

    ``gaps`` are the misclosures of the ``plans``. Where a crossing finds a point, the fraction is
    ``measured`` on the line of its trials.
    """

    group: CoupledTrain | Higher
    plans: tuple[TrialPlan, TrialPlan]
    gaps: tuple[Misclosure, Misclosure]
    share: OwnStep
    measured: OwnStep | None

    @property
    def closes(self) -> tuple[str, ...]:
        return self.group.links

    @property
    def rates(self) -> tuple[int, int]:
        """The steps of the trial rates."""
        return self.plans[0].rate, self.plans[1].rate

    @property
    def depth(self) -> int:
        """The number of trial plans around its own."""
        return self.plans[0].depth

    @property
    def symbol(self) -> str:
        """Markup of the fraction, with the tag of the trial plan around it, if any."""
        whole = self.plans[0].whole
        return SHARE if whole is None else symbol(f"λ{whole.tag}")

    def divided(self, program: Program) -> Iterator[DividedPoint]:
        """The points of the right plan that this fraction divides."""
        return (p for p in constructions(program, DividedPoint) if p.share == self.share)

    # --- sentences -------------------------------------------------------------------------------

    def reason(self, drawing: Drawing, role: str) -> str:
        """The reason for a fraction from the gaps, where no crossing gives it."""
        return "why.gaps" if role == "share" and self.measured not in drawing.trace.values else ""

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """The misclosures: between which points the gaps are measured, and their sizes."""
        if role != "share":
            return ""
        first, second = self.gaps
        if isinstance(first, DrivenMisclosure) and isinstance(second, DrivenMisclosure):
            return driver_missed(drawing, first, second)
        return drawing.words("step.share-lines", **self.gaps_in_words(drawing))

    def sentence_parts(self, drawing: Drawing, role: str) -> Iterator[tuple[int, str]]:
        """The gap of each trial by itself, where it is measured on a sheet."""
        if role == "share" and all(gap.is_measured(drawing) for gap in self.gaps):
            fields = self.gaps_in_words(drawing)
            yield self.gaps[0].size, drawing.words("step.share-first", **fields)
            yield self.share, drawing.words("step.share-second", **fields)

    def gaps_in_words(self, drawing: Drawing) -> dict[str, str]:
        """The points and lines between which both gaps are measured, and the gaps' sizes."""
        mm, (first, second) = on_paper(drawing), self.gaps
        one, two = (gap.amount(drawing) for gap in self.gaps)
        side = "alike" if one * two > 0 else "opposite"
        return {
            "one": first.point(drawing),
            "two": second.point(drawing),
            "first": drawing.words.fixed(abs(one) * mm, 2),
            "second": drawing.words.fixed(abs(two) * mm, 2),
            "side": drawing.words(f"step.gap-{side}"),
            "locus": first.line(drawing),
            "other": second.line(drawing),
        }

    # --- relations -------------------------------------------------------------------------------

    def relations(self, drawing: Drawing) -> Iterator[Relation]:
        """The position of the right plan between the trials, from their misclosures."""
        values = drawing.trace.values
        points = [p for p in self.divided(drawing.trace.program) if p.value in values]
        crossed = [p for p in points if self.measured in values and p.is_crossed(values)]
        lead = (crossed or points)[0]
        one, two, name = (drawing.lettered(n) for n in (lead.first, lead.second, lead.value))
        ratio = f"{one}{name}/{one}{two}"
        others = [drawing.lettered(point.value) for point in points if point not in crossed]
        fields = {
            "share": self.symbol,
            "ratio": ratio,
            "list": drawing.words("list_mark").join(others),
        }
        found = float(values[self.share]) if self.gaps[0].amount(drawing) else 0.0
        result = answer(drawing, found)
        if crossed:
            whole = drawn_between(drawing, lead.first, lead.second, drawing.plane)
            part = OnPaper(float(values[self.share]) * whole)
            figures = f"{drawn_length(drawing, part)}/{drawn_length(drawing, whole)}"
            remark = drawing.words("calculation.divided-alike", **fields) if others else ""
            yield Relation(self.symbol, ratio, figures, result, "", remark)
            return
        names = [symbol(f"m{plan.tag}") for plan in self.plans]
        for name, gap in zip(names, self.gaps, strict=True):
            yield gap.relation(drawing, name)
        first = figure(drawing, self.gaps[0].amount(drawing))
        second = within(drawing, self.gaps[1].amount(drawing))
        yield Relation(
            self.symbol,
            "{0}/({0} − {1})".format(*names),
            f"{first}/({first} − {second})",
            result,
            "",
            drawing.words("calculation.divided", **fields),
        )


def driver_missed(drawing: Drawing, first: DrivenMisclosure, second: DrivenMisclosure) -> str:
    """The errors of the trials in a driver's given motion, in mm of the plan or in its rate."""
    found, sizes = first.has(drawing), {}
    sizes["a"], sizes["b"] = found, second.has(drawing)
    sizes["given"] = found - first.amount(drawing)
    sizes["first"], sizes["second"] = first.amount(drawing), second.amount(drawing)
    driver = first.driver
    if driver.kind == "turn":
        fields = {key: figure(drawing, size) for key, size in sizes.items()}
        fields["unit"] = drawing.words.spelled(drawing.rate.caret_unit)
        what = drawing.in_signs(f"*{drawing.rate.letter}*_{{{driver_index(driver)}}}")
        return drawing.words("step.share-turn", what=what, **fields)
    mm = on_paper(drawing)
    fields = {key: drawing.words.fixed(size * mm, 2) for key, size in sizes.items()}
    return drawing.words(
        "step.share-slide",
        guide=way_of(drawing, driver.link),
        one=first.point(drawing),
        two=second.point(drawing),
        **fields,
    )


def with_trials_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The sentences, with one for all points that divide the lines of the same two trials."""
    steps = drawing.trace.program.steps
    divided: dict[int, dict[Sentence, DividedPoint]] = {}
    for said in found:
        if said.step >= 0 and isinstance(kind := construction(steps[said.step]), DividedPoint):
            divided.setdefault(kind.share, {})[said] = kind
    for share, points in divided.items():
        found = divided_together(drawing, found, share, points)
    return found


def divided_together(
    drawing: Drawing, found: list[Sentence], share: int, points: dict[Sentence, DividedPoint]
) -> list[Sentence]:
    """The sentences, with one for all points of one ``share``."""
    values = drawing.trace.values
    crossed = [said for said, point in points.items() if point.is_crossed(values)]
    divided = [said for said in points if said not in crossed]
    if crossed:
        found = [said for said in found if said.step != share]
    if not divided:
        return found
    listed = drawing.words("list_mark").join(drawing.lettered(s.step) for s in divided)
    if not crossed:
        point = points[divided[0]]
        fields = point.ratio(drawing, *gaps_of(drawing, point))
        return together(found, divided, drawing.words("step.divided", list=listed, **fields))
    point = points[crossed[-1]]
    fields = point.ratio(drawing, *gaps_of(drawing, point))
    markup = drawing.words("step.divided-alike", list=listed, **fields)
    kept = [said for said in found if said not in divided]
    place = max(i for i, said in enumerate(kept) if said in crossed) + 1
    return [*kept[:place], in_one(divided, "divided", markup), *kept[place:]]


def gaps_of(drawing: Drawing, point: DividedPoint) -> tuple[float, float]:
    """The misclosures of the trials, in mm of the plan or as rates.

    Where a crossing finds a point, the parts into which it divides the line of its own trials.
    """
    steps, values, mm = drawing.trace.program.steps, drawing.trace.values, on_paper(drawing)
    if point.is_crossed(values):
        part = float(values[point.share])
        whole = abs(values[point.second] - values[point.first]) * mm
        return part * whole, (part - 1) * whole
    trials = construction(steps[point.share])
    assert isinstance(trials, TwoTrials)
    first, second = (gap.amount(drawing) * mm for gap in trials.gaps)
    return first, second


def divided_alone(drawing: Drawing, point: DividedPoint) -> str:
    """How the line of a point's trials is divided: as the gaps, or as another such line."""
    values = drawing.trace.values
    alike = (
        p for p in constructions(drawing.trace.program, DividedPoint) if p.share == point.share
    )
    lead = next((p for p in alike if p.value in values and p.is_crossed(values)), point)
    gaps = gaps_of(drawing, lead)
    return drawing.words(
        "step.divided-one",
        line="".join(drawing.lettered(end) for end in (point.first, point.second)),
        name=drawing.lettered(point.value),
        ratio=lead.ratio(drawing, *gaps)["ratio"],
        beyond=point.ratio(drawing, *gaps)["beyond"],
    )


def of_trials(drawing: Drawing) -> Iterator[Relation]:
    """The vectors laid off in two trial plans, and the position of the right plan between them."""
    yield from trial_lengths(drawing)
    for number, step, _ in drawing.steps(Plane.NUMBERS):
        kind = construction(step)
        if isinstance(kind, TwoTrials) and number == kind.share and step.part is Part(drawing.kind):
            yield from kind.relations(drawing)


def on_paper(drawing: Drawing) -> float:
    """The millimetres of paper for a unit of the plan."""
    return 1000 / scale_of(drawing, drawing.plane)


# --- compilation ---------------------------------------------------------------------------------


def two_trials(images: GroupImages, pen: Pen, group: CoupledTrain | Higher, each: Each) -> None:
    """Draw two trial plans, and the right one, as the misclosure is linear in the trial rate.

    Acceleration components that follow from velocities are known by then.
    """
    layers, gaps, begun = list[dict[Target, int]](), list[Misclosure](), []
    plan = images.plan
    first, second = plans_of(pen, group, plan)
    rims = coupled_train.known_rims(pen, group, plan) if isinstance(group, CoupledTrain) else {}
    for trial in (first, second):
        begun.append(len(pen.steps))
        with pen.aside(trial) as layer:
            move_trial(pen, group, images, trial.rate)
            for member in group.chain:
                each(pen, member, bases(pen.scene, member))
            gaps.append(missed(pen, group, images))
        layers.append(layer)
        pen.tried.append(layer)
    tried = range(begun[1], len(pen.steps))
    crossed = crossings(pen, group, images, layers)
    with pen.on(plan.part, Plane.NUMBERS):
        by_hand = None
        for line in crossed.values():
            with pen.hands_way():
                by_hand = pen.draw(share_on_line, line.first, line.second, line.crossing)
        divided = pen.draw(share, *(gap.size for gap in gaps), by_hand=by_hand)
    one, two = (pen.make(replace(gap, settled=by_hand)) for gap in gaps)
    pen.make(TwoTrials(group, (first, second), (one, two), divided, by_hand))
    settle(pen, group, plan, layers, divided, crossed, rims)
    if plan is ACCELERATION and not pen.layers:
        components(pen, group, tried)
    for last in ending(group):
        each(pen, last, bases(pen.scene, last))
    if not pen.layers:
        pen.tried.clear()
        for link in group.links:
            omega_of(pen, link, plan.rate)


def plans_of(pen: Pen, group: CoupledTrain | Higher, plan: Plan) -> tuple[TrialPlan, TrialPlan]:
    """The two trial plans of a group; those of a group within a group belong to its trial plans."""
    whole, link = pen.auxiliary, group.tried.link
    assert whole is None or isinstance(whole, TrialPlan)
    tag = whole.tag if whole is not None else ""
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        at_rest = pen.given("zero", name=f"{plan.rate} tried of {link}{tag}")
        value = trial_value(pen, group, plan)
    alike = whole.first.within[group.links] if whole is not None and whole.first else None
    first = TrialPlan(tag + TAGS[0], link, at_rest, alike, whole)
    second = TrialPlan(tag + TAGS[1], link, value, alike or first, whole)
    if whole is not None:
        whole.within[group.links] = first
    return first, second


@action("pace")
def pace(bar: Real, *rest: Any) -> Real:
    """The common pace of all drivers, or 1 where all are at rest.

    ``rest`` holds the given rates, those that turn first, then the number that turn. A sliding rate
    is divided by ``bar``.
    """
    *given, turning = rest
    total: Real = 0.0
    for number, value in enumerate(given):
        total = total + (abs(value) if number < turning else abs(value) / bar)
    return pick(total > 0, total, 1.0)


def trial_value(pen: Pen, group: CoupledTrain | Higher, plan: Plan) -> int:
    """The second trial: the rate at which the drivers turn, or slide by a bar.

    An acceleration is the sum of the squares of that rate and of the link's own rate, plus the
    drivers' accelerations. A trial far too small has nearly the misclosure of a trial at rest, and
    digits are lost. On paper, a round number takes its place (trial_rates).
    """
    drivers = pen.scene.drivers
    one_turns = len(drivers) == 1 and drivers[0].kind == "turn"
    turns = isinstance(group.tried.pair, Pin)
    slide = not turns or any(driver.kind != "turn" for driver in drivers)
    bar = pen.draw(far, *places_of(pen, group)) if slide else None
    seconds = pen.seconds()
    rate = pen.draw(inverse, seconds) if one_turns else pace_of(pen, VELOCITY, bar)
    if plan is ACCELERATION:
        with pen.on(plan.part, Plane.NUMBERS):
            own = omega_of(pen, group.tried.link) if turns else slid_rate(pen, group, bar)
            squares = (pen.draw(product, each, each) for each in (rate, own))
            rate = pen.draw(sum_of, *squares)
        if not all(driver.acceleration.is_zero() for driver in drivers):
            rate = pen.draw(sum_of, rate, pace_of(pen, ACCELERATION, bar))
    return rate if turns or bar is None else pen.draw(product, rate, bar)


def pace_of(pen: Pen, plan: Plan, bar: int | None) -> int:
    """The common pace of all drivers of a scene, by their speeds or by their accelerations."""
    kinds = sorted(pen.scene.drivers, key=lambda driver: driver.kind != "turn")
    turning = sum(driver.kind == "turn" for driver in kinds)
    given = [getattr(pen.drive(driver), plan.given) for driver in kinds]
    bar = pen.given("one") if bar is None else bar
    return pen.draw(pace, bar, *given, extra=(turning,))


def slid_rate(pen: Pen, group: CoupledTrain | Higher, bar: int | None) -> int:
    """The rate of the tried link along its guiding line, in bars per second."""
    pair, point = group.tried.pair, pen.bases[group.tried.link].start
    assert bar is not None and not isinstance(pair, Pin)
    under = image_under(pen, partner(pair, group.tried.link), point, VELOCITY)
    speed = pen.draw(distance, under, pen.the("velocity", point))
    return pen.draw(product, speed, pen.draw(inverse, bar))


def places_of(pen: Pen, group: CoupledTrain | Higher) -> list[int]:
    """The positions of the points of a group, the tried link's first."""
    start = pen.bases[group.tried.link].start
    points = dict.fromkeys((start, *(p for n in group.links for p in pen.scene.link(n).points)))
    return [pen.the("position", point) for point in points]


def move_trial(pen: Pen, group: CoupledTrain | Higher, images: GroupImages, value: int) -> None:
    """Draw the motion of the tried link in a trial plan."""
    trial, base, plan = group.tried, pen.bases[group.tried.link], images.plan
    match trial.pair:
        case Pin(point=pivot):
            pen.want(plan.rate, trial.link, value)
            if base.end is not None:
                plan.turn(pen, trial.link, pivot, base.end, steady=False, along=pivot)
        case _ as pair:
            images.slide_on(pen, pair, trial.link, value)
    images.plate_points(pen, base)


def missed(pen: Pen, group: CoupledTrain | Higher, images: GroupImages) -> Misclosure:
    """The misclosure of a trial plan at the link or driver that comes last."""
    last, plan = group.last, images.plan
    if not isinstance(last, Tie | Driver):
        return coupled_train.missed(pen, group, plan)
    match last:
        case Tie(link, Pin(point=p), Pin(point=q)):
            p, q = in_order((p, q), [of for what, of in pen.layers[-1] if what == plan.quantity])
            ends = [pen.the(what, x) for what in ("position", plan.quantity) for x in (p, q)]
            origin, known = pen.given("origin"), images.bar(p, q).component(pen)
            wanted = origin if known is None else known
            with pen.on(plan.part, Plane.NUMBERS):
                size = pen.draw(lacks, *ends, wanted)
            roles = dict(zip(("p", "q", "foot", "tip"), ends, strict=True))
            return BarMisclosure(size=size, wanted=wanted, **roles)
        case Tie(link, Pin(point=p), Sliding() as pair):
            line = known_guide(pen, pair)
            start = images.known_end(pen, pair, link, p)
            tip = pen.the(plan.quantity, p)
            with pen.on(plan.part, Plane.NUMBERS):
                size = pen.draw(lacks_across, line, start, tip)
            return GuideMisclosure(size=size, block=pair.links[0], along=line, start=start, tip=tip)
        case Driver(kind="turn") as driver:
            given = getattr(pen.drive(driver), plan.given)
            own = omega_of(pen, driver.link, plan.rate)
            if driver.against != FRAME:
                with pen.on(plan.part, Plane.NUMBERS):
                    own = pen.draw(difference, own, omega_of(pen, driver.against, plan.rate))
            with pen.on(plan.part, Plane.NUMBERS):
                size = pen.draw(difference, own, given)
            return DrivenMisclosure(size=size, driver=driver, found=own)
        case Driver() as driver:
            return missed_slide(pen, driver, images)
    raise AssertionError(last)


def missed_slide(pen: Pen, driver: Driver, images: GroupImages) -> Misclosure:
    """The misclosure of a trial plan for a given sliding speed or acceleration."""
    pair, plan = slide_of(pen, driver), images.plan
    first = pen.scene.link(driver.link).points[0]
    given = getattr(pen.drive(driver), plan.given)
    line = known_guide(pen, pair)
    start = images.known_end(pen, pair, driver.link, first)
    with pen.on(plan.part, Plane.NUMBERS):
        tip = pen.the(plan.quantity, first)
        found = pen.draw(part_along, line, start, tip)
        size = pen.draw(difference, found, given)
    return DrivenMisclosure(size=size, driver=driver, found=found, start=start, tip=tip)
