"""One of two trial plans: tagged points, thin grey marks, and one sentence.

A line through coincident points, or a figure of zero size, is not drawn.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from msgspec import Struct, field

from graphkin.construction.acceleration.turned_acceleration import TurnedAcceleration
from graphkin.construction.core.auxiliary_plan import AuxiliaryPlan, auxiliary_plan
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence, construction
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
from graphkin.construction.core.program import Step
from graphkin.construction.core.quantities import in_mm
from graphkin.construction.core.relation import Relation, answer, figure, length_of
from graphkin.construction.drivers.driven_slide import DrivenSlide
from graphkin.construction.higher_class.divided_point import CrossedLine, DividedPoint
from graphkin.construction.step_sentences import point_parts, point_sentence
from graphkin.construction.velocity.image_of_link import CrossedImage, ImageOfLink, TranslatedImage
from graphkin.construction.velocity.turned_velocity import LaidOffAboutPivot, LaidOffByRate
from graphkin.drawing.style import OWN_LINES
from graphkin.drawing.symbol_markup import TAGS, bar, symbol, tag_words
from graphkin.numbers.plane import Line as Carrier
from graphkin.text.markup import AND

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
                    drawing, AND.join(clauses), first=self.begins(drawing, named)
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
        for under, run in groupby(named, lambda number: self.falls_on(drawing, number)):
            if under:
                fallen = [*run]
                yield fallen[-1], fallen[-1], falling(drawing, fallen, under)
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
        for under, run in groupby(named, lambda number: self.falls_on(drawing, number)):
            if under:
                yield falling(drawing, [*run], under)
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


def falling(drawing: Drawing, numbers: Sequence[int], under: str) -> str:
    """The words for points of a trial plan that coincide with the point ``under``."""
    key = "falls" if len(numbers) == 1 else "fall-together"
    return of_many(drawing, key, numbers, s=drawing.symbol(under))


def of_many(drawing: Drawing, key: str, numbers: Sequence[int], **fields: str) -> str:
    """The words for several points of a trial plan."""
    listed = drawing.words("list_mark").join(drawing.lettered(number) for number in numbers)
    return drawing.words(f"step.{key}", name=listed, list=listed, **fields)


def has_many_digits(size: float) -> bool:
    """Whether a number has more than two significant digits, rounded to six."""
    return len(f"{abs(size):.5e}".split("e")[0].rstrip("0")) > len("1.5")


def amount(drawing: Drawing, size: float, unit: str) -> str:
    """An amount with its unit; zero without a unit."""
    return f"{figure(drawing, size)} {unit}" if size else "0"


def leg_start(drawing: Drawing, step: Step) -> int | None:
    """The step from which a step lays off a vector of the plan; None where two lines cross."""
    if step.action is None or isinstance(step.of, CrossedImage | ImageOfLink | TranslatedImage):
        return None
    start = step.args[0]
    return start if drawing.trace.program.steps[start].plane is drawing.plane else None
