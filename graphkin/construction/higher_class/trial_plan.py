"""One of two trial plans: tagged points, thin grey marks, and one sentence.

A line through coincident points, or a figure of zero size, is not drawn.

The right plan of a group: its points on the lines through their two trials, and its arrows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from msgspec import Struct, field

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import AuxiliaryPlan, Sentence, auxiliary_plan, construction
from graphkin.construction.core.naming import (
    NAUGHT,
    drawn_between,
    drawn_in,
    driver_of_rate,
    has_no_length,
    nearest_side,
    sense,
    turning_with,
)
from graphkin.construction.core.pen import Pen, about, arrow_between, letter, relative_arrow
from graphkin.construction.core.program import Part, Plane, PlanVector, Step, Target, foot_of
from graphkin.construction.core.quantities import in_mm
from graphkin.construction.core.relation import Relation, answer, figure, length_of
from graphkin.construction.core.vocabulary import Action, action
from graphkin.construction.drivers.driven_slide import DrivenSlide
from graphkin.construction.group_images import slid
from graphkin.construction.higher_class.divided_point import (
    CrossedLine,
    DividedPoint,
    DividedRate,
    between,
)
from graphkin.construction.plan import VELOCITY, Plan
from graphkin.construction.step_marks import point_parts, point_sentence
from graphkin.construction.velocity.image_of_link import CrossedImage, ImageOfLink, TranslatedImage
from graphkin.construction.velocity.turned_vectors import (
    LaidOffAboutPivot,
    LaidOffByRate,
    TurnedAcceleration,
)
from graphkin.drawing.style import OWN_LINES
from graphkin.drawing.symbol_markup import TAGS, bar, symbol, tag_words
from graphkin.numbers.arithmetic import Point
from graphkin.numbers.plane import Line as Carrier
from graphkin.numbers.plane import Vector
from graphkin.scene.link_points import ends_of, is_under, under
from graphkin.structure.groups import CoupledTrain, Higher, Tie
from graphkin.structure.pairs import Pin

SECOND = tuple(TAGS)[1]
"""The tag of the second of two trial plans."""


class TrialPlan(Struct, AuxiliaryPlan, frozen=True, eq=False):
    """The plan for one ``rate`` of the tried ``link``; ``first`` is the plan that it repeats.

    The trial plan of a group within a group belongs to a trial plan of the outer group, its
    ``whole``. ``within`` has the first of those that belong to it, by the links of their groups.
    """

    tag: str
    link: str
    rate: int
    first: TrialPlan | None = None
    whole: TrialPlan | None = None
    within: dict[tuple[str, ...], TrialPlan] = field(default_factory=dict)

    @property
    def repeats(self) -> bool:
        """Whether the plan repeats the lines of an earlier one."""
        return self.first is not None

    @property
    def depth(self) -> int:
        """The number of trial plans around this one."""
        return 0 if self.whole is None else 1 + self.whole.depth

    @property
    def is_second(self) -> bool:
        """Whether it is the second of its pair."""
        return self.tag.endswith(SECOND)

    def reason(self, name: str) -> str:
        """The reason for a first or second trial."""
        again = "why.trial_again" if self.is_second else "why.trial"
        return again if name == f"trial{self.tag}" else ""

    def turned_by(self, rate: int) -> str:
        """The tried link, for the plan's own rate; else empty."""
        return self.link if rate == self.rate else ""

    def points(self, drawing: Drawing) -> list[int]:
        """The steps that find its points, in order."""
        steps = drawing.trace.program.steps
        return sorted(n for n, plan in drawing.auxiliary.items() if plan is self and steps[n].name)

    # --- coincident points -----------------------------------------------------------------------

    def falls_on(self, drawing: Drawing, number: int) -> str:
        """The point on which a point and all that it is drawn from coincide; else empty.

        A translated image has its own sentence for this.
        """
        steps = drawing.trace.program.steps
        step = steps[number]
        if isinstance(step.of, TranslatedImage):
            return ""
        before = list(drawn_from(drawing, number))
        apart = (drawn_between(drawing, other, number, step.plane) for other in before)
        if not before or any(size >= NAUGHT for size in apart):
            return ""
        known = [other for other in before if drawing.auxiliary.get(other) is not self]
        if known:
            return steps[known[0]].name
        return self.falls_on(drawing, before[0]) or steps[before[0]].name

    def is_idle(self, drawing: Drawing, number: int) -> bool:
        """Whether a line finds only points that coincide with its start."""
        users = drawing.children.get(number, ())
        return bool(users) and all(self.falls_on(drawing, user) for user in users)

    # --- marks -----------------------------------------------------------------------------------

    def marks(self, canvas: Canvas, number: int) -> None:
        """Draw a line as far as needed, or a leg and the point at its end."""
        drawing = canvas.drawing
        step = drawing.trace.program.steps[number]
        if isinstance(step.of, CrossedLine | DividedPoint):
            step.of.marks_aside(canvas, step.role)
            return
        if isinstance(drawing.trace.values[number], Carrier):
            if not self.is_idle(drawing, number):
                canvas.line(OWN_LINES)
            return
        start = leg_start(drawing, step)
        if start is not None:
            canvas.leg(step.name, OWN_LINES, canvas.value(start), canvas.value(number))
        canvas.image_aside()

    # --- sentences -------------------------------------------------------------------------------

    def sentences(self, drawing: Drawing, number: int) -> Iterator[Sentence]:
        """The sentence for the points of the plan, at the last point.

        Points found by trials within have their own sentences, and the points that follow from
        those share one more.
        """
        step = drawing.trace.program.steps[number]
        if isinstance(step.of, DividedPoint):
            yield Sentence(number, step.name, point_words(drawing, number))
            return
        for named in self.runs(drawing):
            if number == named[-1]:
                full = self.first is None
                clauses = (self.in_full if full else self.shortened)(drawing, named)
                markup = self.introduced(
                    drawing, drawing.words.clauses(clauses), first=self.begins(drawing, named)
                )
                yield Sentence(number, f"trial{self.tag}", markup, tuple(named))

    def runs(self, drawing: Drawing) -> list[list[int]]:
        """Its points in runs: before the trials within it, and following from them."""
        steps = drawing.trace.program.steps
        parts = groupby(self.points(drawing), lambda n: isinstance(steps[n].of, DividedPoint))
        return [[*run] for is_divided, run in parts if not is_divided]

    def begins(self, drawing: Drawing, named: Sequence[int]) -> bool:
        """Whether some points include the first of the plan."""
        return self.points(drawing)[0] in named

    def parts_of_sentence(
        self, drawing: Drawing, named: Sequence[int]
    ) -> Iterator[tuple[int, int, str]]:
        """The points line by line: the point's step, the step that ends a part, and the words."""
        for covered, run in groupby(named, lambda number: self.falls_on(drawing, number)):
            if covered:
                fallen = [*run]
                yield fallen[-1], fallen[-1], falling(drawing, fallen, covered)
                continue
            for number in run:
                again = turned_again(drawing, number) if self.repeats else ""
                parts = [(number, again)] if again else point_parts(drawing, number)
                yield from ((number, step, markup) for step, markup in parts)

    def introduced(self, drawing: Drawing, how: str, *, first: bool) -> str:
        """A part of the plan, introduced by its name; the ``first`` part also by its assumption."""
        key = f"step.trial{'' if self.whole is None else '-in'}-{2 if self.is_second else 1}"
        fields = {"plan": symbol(tag_words(self.whole.tag))} if self.whole is not None else {}
        if not first:
            return drawing.words(f"{key}-on", how=how, **fields)
        what, size = self.assumed(drawing, self.points(drawing))
        if self.is_second and has_many_digits(float(drawing.trace.values[self.rate])):
            key += "-near"
        return drawing.words(key, what=what, amount=size, how=how, **fields)

    def in_full(self, drawing: Drawing, named: Sequence[int]) -> Iterator[str]:
        """Its points one by one; coincident points together."""
        for covered, run in groupby(named, lambda number: self.falls_on(drawing, number)):
            if covered:
                yield falling(drawing, [*run], covered)
            else:
                yield from (point_words(drawing, number) for number in run)

    def shortened(self, drawing: Drawing, named: Sequence[int]) -> Iterator[str]:
        """Its points briefly; in full where lengths or lines differ from the first plan's."""
        assert self.first is not None
        steps = drawing.trace.program.steps
        first = {steps[n].letter: n for n in self.first.points(drawing)}

        def is_new(number: int) -> bool:
            before = first.get(steps[number].letter)
            begins = begun_by(steps[number]) is not None
            return begins or before is None or bool(self.falls_on(drawing, before))

        for new, run in groupby(named, is_new):
            if new and self.whole is not None:
                yield from self.in_full(drawing, [*run])
            elif new:
                for number in run:
                    yield turned_again(drawing, number) or point_words(drawing, number)
            else:
                yield of_many(drawing, "normals-again", list(run))

    def assumed(self, drawing: Drawing, named: Sequence[int]) -> tuple[str, str]:
        """The assumed rate, and its amount with its unit."""
        steps, values = drawing.trace.program.steps, drawing.trace.values
        for number in named:
            step = steps[number]
            rate, kind = begun_by(step), construction(step)
            if rate is not None:
                size = float(values[rate])
                if isinstance(kind, DrivenSlide):
                    sliding = amount(drawing, abs(size), drawing.sliding.caret_unit)
                    if size:
                        way = nearest_side(values[number] - values[step.args[0]])
                        sliding += f" {drawing.words(f'page.to_{way}')}"
                    return drawing.symbol(f"{drawing.sliding.letter}_{kind.point}"), sliding
                turning = amount(drawing, abs(size), drawing.rate.caret_unit)
                turning += f" {sense(drawing.words, size)}" if size else ""
                assert isinstance(kind, LaidOffAboutPivot)
                return drawing.symbol(f"{drawing.rate.letter}_{kind.link}"), turning
        return "", ""

    # --- relations -------------------------------------------------------------------------------

    def slid(self, drawing: Drawing, vector: DrivenSlide, rate: float) -> Relation:
        """The assumed rate of a slider along its guide."""
        name = drawing.symbol(f"{drawing.sliding.letter}_{vector.point}{self.tag}")
        drawn = in_mm(drawing.words, drawn_in(drawing, drawing.plane, rate))
        remark = drawing.words("calculation.chosen_drawn", drawn=drawn)
        return Relation(name, "", "", figure(drawing, rate), drawing.sliding.caret_unit, remark)

    def turned(
        self, drawing: Drawing, vector: LaidOffAboutPivot, link: str, rate: float
    ) -> Relation:
        """A pin's vector from an assumed rotation, perpendicular to its bar: rate times bar."""
        p, q = vector.p, vector.q
        length, part = length_of(drawing, p, q), "" if drawing.kind == "velocity" else "^τ"
        drawn = in_mm(drawing.words, drawn_in(drawing, drawing.plane, rate * length))
        return Relation(
            drawing.symbol(f"{drawing.vector.letter}_{vector.index}{self.tag}{part}"),
            f"{drawing.symbol(f'{drawing.rate.letter}_{link}{self.tag}')}·{bar(p, q)}",
            f"{figure(drawing, rate)}·{figure(drawing, length)}",
            answer(drawing, rate * length),
            drawing.vector.caret_unit,
            drawing.words("calculation.square_drawn", bar=bar(p, q), drawn=drawn),
            over=((p, q),),
        )


def trial_lengths(drawing: Drawing) -> Iterator[Relation]:
    """Each vector that an assumed rate gives, in the order of drawing; none where it is zero.

    A driver's vector along a guide is the same in both trials, and is given for the first alone.
    """
    laid_off: set[int] = set()
    for number, step, _ in drawing.steps(drawing.plane):
        plan, kind, rate = auxiliary_plan(drawing, number), construction(step), begun_by(step)
        if not isinstance(plan, TrialPlan) or rate is None or has_no_length(drawing, number):
            continue
        size = abs(float(drawing.trace.values[rate]))
        if isinstance(kind, DrivenSlide) and driver_of_rate(drawing, rate) is None:
            yield plan.slid(drawing, kind, size)
        elif isinstance(kind, DrivenSlide):
            if rate not in laid_off:
                yield kind.laid_by_driver(drawing, size)
            laid_off.add(rate)
        elif isinstance(kind, LaidOffAboutPivot):
            link = turning_with(drawing, plan.turned_by(rate) or kind.link)
            yield plan.turned(drawing, kind, link, size)


def begun_by(step: Step) -> int | None:
    """The rate with which a trial begins, if a step lays off its vector; None for other steps."""
    kind = construction(step)
    return kind.tried_rate(step.role) if isinstance(kind, LaidOffByRate) else None


def drawn_from(drawing: Drawing, number: int) -> Iterator[int]:
    """The steps of the plan's named points from which a step is drawn."""
    steps = drawing.trace.program.steps
    for arg in steps[number].args:
        if steps[arg].plane is drawing.plane:
            yield from [arg] if steps[arg].name else drawn_from(drawing, arg)


def turned_again(drawing: Drawing, number: int) -> str:
    """How a point of the second plan is found whose centripetal component is that of the first.

    Empty for any other point.
    """
    kind = construction(drawing.trace.program.steps[number])
    if not isinstance(kind, TurnedAcceleration) or kind.is_steady:
        return ""
    if has_no_length(drawing, kind.end) or has_no_length(drawing, number):
        return ""
    fields, normal = (kind.fields(drawing, role) for role in ("image", "end"))
    return drawing.words("step.driven-again", normal=normal["vector"], **fields)


def point_words(drawing: Drawing, number: int) -> str:
    """How a point of a trial plan is found."""
    return point_sentence(drawing, drawing.trace.program.steps[number])


def falling(drawing: Drawing, numbers: Sequence[int], covered: str) -> str:
    """The words for points of a trial plan that coincide with the point ``covered``."""
    key = "falls" if len(numbers) == 1 else "fall-together"
    return of_many(drawing, key, numbers, s=drawing.symbol(covered))


def of_many(drawing: Drawing, key: str, numbers: Sequence[int], **fields: str) -> str:
    """The words for several points of a trial plan."""
    listed = drawing.words("list_mark").join(drawing.lettered(number) for number in numbers)
    return drawing.words(f"step.{key}", name=listed, list=listed, **fields)


def has_many_digits(size: float) -> bool:
    """Whether a number has more than two significant digits, rounded to six."""
    return len(f"{abs(size):.5e}".split("e")[0].rstrip("0")) > len("1.5")


def amount(drawing: Drawing, size: float, unit: str) -> str:
    """An amount with its unit; zero without a unit."""
    return f"{figure(drawing, size)} {drawing.words.unit(unit)}" if size else "0"


def leg_start(drawing: Drawing, step: Step) -> int | None:
    """The step from which a step lays off a vector of the plan; None where two lines cross."""
    if step.action is None or isinstance(step.of, CrossedImage | ImageOfLink | TranslatedImage):
        return None
    start = step.args[0]
    return start if drawing.trace.program.steps[start].plane is drawing.plane else None


@action("to-corner")
def along_component(start: Point, tip: Point, component: Point) -> Vector:
    """The first leg of a path from one point of a plan to another: a component laid off."""
    return Vector(start, start + component)


@action("from-corner")
def after_component(start: Point, tip: Point, component: Point) -> Vector:
    """The last leg of such a path, from the end of the component laid off."""
    return Vector(start + component, tip)


@action("to-corner")
def along_way(start: Point, tip: Point, foot: Point, corner: Point) -> Vector:
    """The first leg of a path, equal to the vector from a foot to a corner elsewhere."""
    return Vector(start, start + (corner - foot))


@action("from-corner")
def after_way(start: Point, tip: Point, foot: Point, corner: Point) -> Vector:
    """The last leg of such a path."""
    return Vector(start + (corner - foot), tip)


@action("to-corner")
def before_component(start: Point, tip: Point, component: Point) -> Vector:
    """The first leg of a path whose last leg is a component laid off backwards from its tip."""
    return Vector(start, tip - component)


@action("from-corner")
def last_component(start: Point, tip: Point, component: Point) -> Vector:
    """A component as the last leg of a path between two points of a plan."""
    return Vector(tip - component, tip)


# --- its points ----------------------------------------------------------------------------------


def settle(
    pen: Pen,
    group: CoupledTrain | Higher,
    plan: Plan,
    layers: list[dict[Target, int]],
    divided: int,
    crossed: dict[str, CrossedLine],
    rims: dict[str, int],
) -> None:
    """Draw every point of the right plan, on the line through its two trials."""
    first, second = layers
    settled: dict[tuple[int, int], str] = {}
    for (quantity, of), one in first.items():
        two = second[quantity, of]
        if quantity == plan.rate and own_rate(pen, of):
            with pen.on(Part.RESULT, Plane.NUMBERS):
                value = pen.want(quantity, of, pen.draw(between, one, two, divided, name=of))
            pen.make(DividedRate(first=one, second=two, share=divided, value=value))
        elif quantity != plan.quantity:
            continue
        elif one == two or of in rims:
            pen.want(quantity, of, rims.get(of, one))
        elif pen.has(quantity, of):
            settled[one, two] = of  # of a known link, where the line of a crossing begins
        elif (one, two) in settled:
            pen.want(quantity, of, pen.the(quantity, settled[one, two]))
        else:
            line, name = crossed.get(of), plan.named(of)
            by_hand = line.crossing if line is not None else None
            with plan.drawn(pen):
                value = pen.draw(between, one, two, divided, name=name, by_hand=by_hand)
            pen.want(quantity, of, value)
            roles = {"first": one, "second": two, "share": divided, "value": value}
            pen.make(DividedPoint(**roles, point=of, crossed=line))
            settled[one, two] = of
    closing: tuple[str, ...] = ()
    match group.last:
        case Tie(_, Pin(point=p), Pin(point=q)):
            closing = in_order((p, q), [*settled.values()])
    for point in settled.values():
        if not is_under(point):
            finish(pen, plan, point, closing)
        elif plan is VELOCITY:
            relative_arrows(pen, point)
    if closing:
        plan.arrows(pen, closing[1], closing[0])


def in_order(ends: tuple[str, str], found: list[str]) -> tuple[str, ...]:
    """The ends of the bar that closes a group, the end that is known or found first in front."""
    return tuple(sorted(ends, key=lambda end: found.index(end) if end in found else -1))


def own_rate(pen: Pen, link: str) -> bool:
    """Whether two points cannot give a link's rate: a tried link with one pin."""
    base = pen.bases.get(link)
    return base is not None and base.end is None and link not in pen.leads and pen.turns(link)


def finish(pen: Pen, plan: Plan, point: str, closing: tuple[str, ...]) -> None:
    """Draw the arrows to a point of the right plan, but not that of the ``closing`` bar."""
    moved = [base for base in pen.bases.values() if pen.has(plan.quantity, base.start)]
    starts = {b.start for b in moved if point == b.end}
    starts = starts or {b.start for b in moved if point in b.others}
    pivots: list[str | None] = [*sorted(starts)]
    for pivot in pivots or [None]:
        plan.arrows(pen, point, None if (point, pivot) == closing else pivot)


# --- its arrows ----------------------------------------------------------------------------------


def relative_arrows(pen: Pen, name: str) -> None:
    """Draw the arrows of the right plan for the point of a link under a sliding one (name P@2).

    One is its velocity about the base of its link; the other is the sliding point's velocity
    relative to it. At a fixed pivot, the point is known first: the arrows are its own velocity and
    the base's velocity about it.
    """
    point, link = ends_of(name)
    here, start = pen.the("velocity", name), pen.bases[link].start
    if point in pen.scene.frame.points:
        arrow_between(pen, pen.pole(Plane.VELOCITIES), here, name, "")
        if pen.has("velocity", start):
            relative_arrow(pen, start, name)
        return
    if pen.has("velocity", point):
        arrow_between(pen, here, pen.the("velocity", point), point, letter(name))
    if pen.has("velocity", start):
        fixed = start in pen.scene.frame.points
        about_which = "" if fixed else letter(start)
        arrow_between(pen, pen.the("velocity", start), here, name, about_which)


def components(pen: Pen, group: CoupledTrain | Higher, tried: range) -> None:
    """Draw the arrows of the components in the right plan, and of the velocities that give them.

    The components laid off are those of the second trial, at the steps ``tried``: they follow from
    velocities and do not depend on the trial value. The path to a point is closed by its tangential
    component, or by its acceleration along a guide.
    """
    right = {
        number: pen.targets[target]
        for layer in pen.tried
        for target, number in layer.items()
        if target in pen.targets
    }
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        for number in tried:
            carried_legs(pen, right, number)
        for pivot, pin, vector in normals_of(pen, group):
            relative_arrow(pen, pin, pivot)
            ends = pen.the("acceleration", pivot), pen.the("acceleration", pin)
            names = about(pen, pin, pivot), letter(pin), letter(pivot)
            legs(pen, "ντ", along_component, after_component, (*ends, vector), names)
        for number in tried:
            sliding_legs(pen, right, number)


def carried_legs(pen: Pen, right: dict[int, int], number: int) -> None:
    """Draw the normal and tangential component of a point on a link of known rotation."""
    turned = pen.steps[number].of
    if not isinstance(turned, TurnedAcceleration) or turned.image != number or number not in right:
        return
    ends = right.get(turned.start, turned.start), right[number]
    names = turned.index, turned.q, turned.p
    legs(pen, "ντ", along_way, after_way, (*ends, turned.start, turned.end), names)


def sliding_legs(pen: Pen, right: dict[int, int], number: int) -> None:
    """Draw the Coriolis component of a sliding point, and its relative acceleration.

    Where the point of the guide under it is the unknown, the path runs backwards from the sliding
    point.
    """
    found = slid(pen.steps[number])
    if found is None:
        return
    laid, component = found
    start, vector = (right.get(arg, arg) for arg in pen.steps[number].args)
    names = component.index, component.point, ""
    if not laid.back:
        ends = start, pen.the("acceleration", component.point)
        legs(pen, "cr", along_component, after_component, (*ends, vector), names)
    else:
        ends = pen.the("acceleration", under(component.point, component.guide)), start
        legs(pen, "rc", before_component, last_component, (*ends, vector), names)


def legs(
    pen: Pen,
    kinds: str,
    first: Action,
    last: Action,
    args: tuple[int, ...],
    names: tuple[str, str, str],
) -> None:
    """Draw the arrows of both legs of a path in the plan, each with the sign of its component.

    ``names`` are the index of the whole vector, the moving point, and the point that it moves
    about.
    """
    index, of, about_which = names
    foot = next(filter(None, (foot_of(sign, index) for sign in kinds)))
    start, end = (pen.steps[number].name for number in args[:2])
    for leg, sign, ends in zip((first, last), kinds, ((start, foot), (foot, end)), strict=True):
        own = foot_of(sign, index)
        back = bool(own) and leg is last
        vector = PlanVector("a", index, of, about_which, sign, own, back, ends)
        if vector.symbol not in pen.arrows:
            pen.vector(leg, *args, of=vector)


def normals_of(pen: Pen, group: CoupledTrain | Higher) -> list[tuple[str, str, int]]:
    """The accelerations towards pivots within a group, each with its pivot and its pin."""
    return [
        (key[1], key[2], vector)
        for key, vector in pen.shared.items()
        if key[0] == "normal"
        and any({key[1], key[2]} <= points_on(pen, link) for link in group.links)
        and all(pen.has("acceleration", point) for point in key[1:])
    ]


def points_on(pen: Pen, link: str) -> set[str]:
    """The points of a link, with its base's end where that is under another link's point."""
    base = pen.bases.get(link)
    return {*pen.scene.link(link).points, *([base.end] if base and base.end else [])}
