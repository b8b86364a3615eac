"""The construction of all sheets as one sequence of sentences, each with its reason.

It also holds what each mark depends on.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from itertools import groupby

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.centres.instant_centre import VelocityNormal
from graphkin.construction.core.component import component_of, is_hidden
from graphkin.construction.core.crossings import Crossing, crossings
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import (
    AuxiliaryPlan,
    GivesRate,
    Sentence,
    auxiliary_plan,
    construction,
)
from graphkin.construction.core.naming import segment_of
from graphkin.construction.core.program import Part, Plane, Program, Step, is_set_on, plan_vector
from graphkin.construction.core.quantities import FORCE
from graphkin.construction.higher_class.divided_point import DividedPoint
from graphkin.construction.higher_class.two_trials import divided_alone
from graphkin.construction.links.idle_links import IDLE
from graphkin.construction.normal_component import NormalComponent
from graphkin.construction.rate_relations import of_turning
from graphkin.construction.rolling.contact_points import PointOfContact
from graphkin.construction.step_marks import point_parts
from graphkin.construction.velocity.relative_motion import PerpendicularThrough
from graphkin.documents.detail import scale_words
from graphkin.documents.sentences import (
    OWN,
    SET_ON,
    TURNING,
    crossings_on,
    set_on_mechanism,
    unexplained,
    with_indices,
)
from graphkin.documents.step_pages import accompanied, ground_of, naming_stages, stage_of, stages
from graphkin.drawing.marks import CircleMark, Mark, Text, style_class
from graphkin.drawing.style import DRAWN
from graphkin.numbers.plane import Line
from graphkin.text import EQUALS, names_in
from graphkin.web.screen_sheets import ScreenSheet

AGAIN = {
    "why.height": "why.height_again",
    "why.normal": "why.normal_again",
    "why.tangential": "why.tangential_again",
}
"""The shorter reason for the second and each further step of a kind."""
LAST, LAST_OF_MANY = "why.meet", "why.meet_many"
"""The reason that comes last, once for all points."""
VECTORS_APART = "vectors"
"""The name of a sentence that draws vectors between images found by the sentence before."""
BY_NAME = {
    VECTORS_APART: "why.vectors",
    "again": "why.again",
    SET_ON: "why.set_on",
    IDLE: "why.idle",
    "moving-centrode": "why.centrodes",
    "trajectory": "why.path",
}
"""The reason of a sentence that belongs to no step, by the sentence's name."""
NO_STEP = -1
"""The step number of a reason that belongs to no single step."""


def reasons(drawing: Drawing, numbers: Iterable[int]) -> list[tuple[str, int]]:
    """The reasons for some steps as markup, each with its step, in order and without repeats."""
    parts = [part for part in OWN[drawing.kind] if not (drawing.again and part is Part.POSITION)]
    found: dict[str, int] = {}
    given: set[str] = set()
    met: dict[str, int] = {}
    for number in sorted(numbers):
        step = drawing.trace.program.steps[number]
        key, known = reason(drawing, step), fields(drawing, step)
        if isinstance(kind := construction(step), PerpendicularThrough):
            known["s"] = drawing.lettered(kind.start)
        if step.part not in parts or not key or is_nothing(drawing, number):
            continue
        if component_of(drawing.trace.program, number) is None and is_hidden(drawing, number):
            continue
        if not all(known[gap] for gap in drawing.words.gaps(key)):
            continue
        if key == LAST:
            met[known["name"]] = number
            continue
        text = drawing.words(AGAIN.get(key, key) if key in given else key, **known)
        given.add(key)
        found.setdefault(text, number)
    if met:
        names, (first, *more) = drawing.words("list_mark").join(met), met.values()
        text = drawing.words(LAST_OF_MANY if more else LAST, name=names)
        found[text] = NO_STEP if more else first
    return list(found.items())


def of_sentence(drawing: Drawing, sentence: Sentence) -> Iterator[tuple[str, int]]:
    """The reasons of a sentence without a step, of a reading, and of an auxiliary plan's start."""
    steps, words = drawing.trace.program.steps, drawing.words
    plan = auxiliary_plan(drawing, sentence.step)
    if sentence.name == TURNING:
        kind = construction(steps[sentence.step])
        read = kind.rate_reason(drawing) if isinstance(kind, GivesRate) else "why.rate"
        keys = dict.fromkeys(reason or read for reason in sentence.reasons or ("",))
        yield from ((words(key), NO_STEP) for key in keys)
    elif sentence.name in BY_NAME:
        yield words(BY_NAME[sentence.name]), NO_STEP
    elif plan and (key := plan.reason(sentence.name)):
        yield words(key), NO_STEP


def is_nothing(drawing: Drawing, number: int) -> bool:
    """Whether a step of an auxiliary plan adds nothing.

    A point adds nothing if it falls on the point it is drawn from; a line, if it finds only such
    points.
    """
    plan, step = auxiliary_plan(drawing, number), drawing.trace.program.steps[number]
    if plan is None:
        return False
    if isinstance(drawing.trace.values[number], Line):
        return plan.is_idle(drawing, number)
    return bool(step.name and plan.falls_on(drawing, number))


def reason(drawing: Drawing, step: Step) -> str:
    """The key of a step's reason; empty where the step needs none."""
    kind = construction(step)
    return kind.reason(drawing, step.role) if kind is not None else ""


def fields(drawing: Drawing, step: Step) -> dict[str, str]:
    """The letters of a step as markup; a letter that the step lacks is empty."""
    known = dict.fromkeys(("p", "q", "r", "g", "k", "i", "bar"), "")
    kind = construction(step)
    if kind is not None:
        known |= kind.symbols()
        if isinstance(kind, NormalComponent):
            known |= kind.corner_symbols(drawing, *kind.lettered)
    return known | {"name": drawing.symbol(step.name) if step.name else ""}


MOST = 3
"""Largest number of strokes in one sentence of the page, if the sentence can be split."""


class SentencePart(Struct, frozen=True):
    """A part of a sentence: the step that it ends with, and the step of the point to be found.

    ``name`` and ``link`` belong to its sentence; ``reason`` is one of the sentence's reasons.
    """

    step: int
    point: int
    markup: str
    name: str = ""
    link: str = ""
    reason: str = ""

    @property
    def sentence(self) -> Sentence:
        """The part as a sentence of its own."""
        return Sentence(self.step, self.name, self.markup, (), self.link, (self.reason,))


class PartedSentence(Struct, frozen=True):
    """A sentence of a sheet and its parts; a sentence that cannot be split has one part."""

    said: Sentence
    parts: tuple[SentencePart, ...]
    plan: AuxiliaryPlan | None = None

    def sentences(self, drawing: Drawing, strokes: Sequence[int]) -> Iterator[tuple[Sentence, int]]:
        """The sentences of the page, each with the number of parts that it joins.

        ``strokes`` counts the strokes of each part. The sheet's own sentence is kept where all
        parts together draw no more than one sentence may.
        """
        if sum(strokes) <= MOST and self.said.name != TURNING:
            yield self.said, len(self.parts)
            return
        for place, some in enumerate(grouped(self.parts, strokes)):
            markup: str = drawing.words.clauses(part.markup for part in some)
            name = some[-1].name
            if self.plan is not None:
                begins = place == 0 and self.plan.begins(drawing, self.said.all_steps)
                markup = self.plan.introduced(drawing, markup, first=begins)
                name = name if place == 0 else ""
            steps = tuple(part.step for part in some) if len(some) > 1 else ()
            reasons = tuple(part.reason for part in some)
            yield Sentence(some[-1].step, name, markup, steps, some[-1].link, reasons), len(some)


def grouped(parts: Sequence[SentencePart], strokes: Sequence[int]) -> Iterator[list[SentencePart]]:
    """The parts grouped into sentences: one point each, with at most MOST strokes."""
    for _, run in groupby(zip(parts, strokes, strict=True), lambda each: each[0].point):
        some, drawn = list[SentencePart](), 0
        for part, count in run:
            if some and drawn + count > MOST:
                yield some
                some, drawn = [], 0
            some, drawn = [*some, part], drawn + count
        yield some


def parted_sentences(drawing: Drawing) -> list[PartedSentence]:
    return [parted_sentence(drawing, said) for said in unexplained(drawing)]


def parted_sentence(drawing: Drawing, said: Sentence) -> PartedSentence:
    """A sentence of a sheet with its parts."""
    one = SentencePart(said.step, said.step, said.markup, said.name, said.link)
    if said.name == TURNING:
        return PartedSentence(said, tuple(readings(drawing)) or (one,))
    plan = auxiliary_plan(drawing, said.step)
    divided = isinstance(construction(drawing.trace.program.steps[said.step]), DividedPoint)
    if plan is not None and not divided:
        found = plan.parts_of_sentence(drawing, said.all_steps)
        parts = tuple(SentencePart(s, p, text, said.name) for p, s, text in found)
        return PartedSentence(said, parts, plan)
    parts = tuple(
        SentencePart(step, number, markup, said.name)
        for number in said.all_steps
        for step, markup in parts_of_sentence(drawing, number)
    )
    whole = len(parts) < 2 or not all(part.markup for part in parts)
    return PartedSentence(said, (one,) if whole else parts)


def parts_of_sentence(drawing: Drawing, number: int) -> Iterator[tuple[int, str]]:
    """The text of a step, part by part, each with the step that the part ends with."""
    program = drawing.trace.program
    component, kind = component_of(program, number), construction(program.steps[number])
    if component is not None:
        yield from component.parts_of_sentence(drawing)
    elif isinstance(kind, DividedPoint) and not kind.is_crossed(drawing.trace.values):
        yield number, divided_alone(drawing, kind)
    elif kind is not None:
        yield from point_parts(drawing, number)


def readings(drawing: Drawing) -> Iterator[SentencePart]:
    """The final readings: the vectors set on the mechanism, then the rate of each link."""
    if markup := set_on_mechanism(drawing, ""):
        yield SentencePart(-1, -1, markup, SET_ON)
    rate, steps = drawing.rate, dict[str, int]()
    for (what, link), number in drawing.trace.program.targets.items():
        if what == rate.target:
            steps[drawing.symbol(f"{rate.letter}_{link}")] = number
    how: str = drawing.words(f"step.read-{rate.target}")
    for relation in of_turning(drawing):
        if (step := steps.get(relation.left)) is not None:
            solved = " ".join(relation.parts(solved=True))
            markup = f"{how}{drawing.words('colon')}{solved}" if how else solved
            yield SentencePart(step, step, markup, TURNING, reason=relation.reason)
            how = ""


# --- the construction of all sheets as one sequence of sentences ----------------------------------


STOPS = (
    Part.POSITION,
    Part.VELOCITY,
    Part.CENTRE,
    Part.NORMAL,
    Part.ACCELERATION,
    Part.POLE,
    Part.FORCE,
    Part.RESULT,
)
"""The parts of the work whose beginnings a reader can jump to."""
SAME = 1e-6
"""Distance in mm within which two places count as one."""


class ProtocolSentence(Struct, frozen=True):
    """A sentence of the sequence: its sheet, its markup, its reasons, the crossings of its lines.

    ``of`` are the steps of the reasons; ``letters`` are the names of the crossings as their labels
    have them. ``ends`` are the parts of the work that the sentence completes on its sheet.
    ``aside`` says what is drawn next to the drawing for the scene's position alone. ``rates`` are
    the links whose rates it reads off. ``open`` is the sentence with gaps for the lengths of
    vectors, where scales are kept and rates are not; ``fallen`` is the one for lengths of zero.
    Both are empty for a sentence that always holds.
    """

    sheet: int
    markup: str
    why: tuple[str, ...]
    of: tuple[int, ...]
    crossings: tuple[Crossing, ...]
    letters: tuple[str, ...]
    ends: tuple[Part, ...]
    aside: str = ""
    rates: tuple[str, ...] = ()
    open: str = ""
    fallen: str = ""


class Timed(Struct, frozen=True):
    """A mark, the sentence that draws it (from 1; 0 if given from the start), and its step.

    ``letters`` are the sentences of the letters that share a label.
    """

    mark: Mark
    at: int
    step: int | None
    letters: tuple[int, ...] = ()


class PageProtocol(Struct, frozen=True):
    """The sequence of sentences over all sheets, and the marks of each sheet in order.

    ``at`` is the sentence (from 1; 0 if given) that draws each step with marks. ``sources`` are the
    steps with marks that a step is drawn from. ``sides`` are the two points of the bar that a line
    of a plan is perpendicular or parallel to. ``letters`` is a step's name as markup. ``tints``
    separates the strokes of one sentence by their reasons. ``hangs`` are the crossings that a step
    needs, or that a line is drawn to; ``aside`` are the crossings of centres and poles. ``squares``
    are the pin, pole and image of a line perpendicular to a velocity.
    """

    said: tuple[ProtocolSentence, ...]
    timed: tuple[tuple[Timed, ...], ...]
    at: Mapping[int, int]
    sources: Mapping[int, tuple[int, ...]]
    sides: Mapping[int, tuple[int, int]]
    letters: Mapping[int, str]
    tints: Mapping[int, int]
    hangs: Mapping[int, tuple[int, ...]]
    aside: tuple[int, ...]
    squares: Mapping[int, tuple[int, ...]]

    def bounds(self, sheet: int) -> tuple[int, int]:
        """The first and the last sentence of a sheet."""
        own = [number for number, one in enumerate(self.said, 1) if one.sheet == sheet]
        return own[0], own[-1]

    def stops(self) -> Iterator[tuple[int, int, Part]]:
        """The first and last sentence of each part of the work, in the order of their ends.

        A part begins where the part before it on its sheet ends. The sentences after the last part
        belong to that part.
        """
        ends = [(number, said) for number, said in enumerate(self.said, 1) if said.ends]
        for number, said in ends:
            first, last = self.bounds(said.sheet)
            others = [other for other, one in ends if one.sheet == said.sheet]
            first = max((other for other in others if other < number), default=first - 1) + 1
            end = last if number == others[-1] else number
            yield from ((first, end, part) for part in said.ends)


def telling(sheets: Sequence[ScreenSheet]) -> PageProtocol:
    """The sequence of sentences for some sheets of one mechanism."""
    said: list[ProtocolSentence] = []
    timed: list[tuple[Timed, ...]] = []
    at: dict[int, int] = {}
    names: dict[str, str] = {}
    for place, sheet in enumerate(sheets):
        own, staged, marks = in_parts(sheet)
        before = len(said)
        timed.append(tuple(later(one, before) for one in marks))
        for step, stage in staged.items():
            if not at.get(step):
                at[step] = len(said) + stage + 1 if stage >= 0 else 0
        labels = labels_of(sheet)
        names |= labels
        seen = {one.step for one in marks if one.step is not None}
        said += spoken(place, sheet.drawing, own, staged, labels, seen, reopened(sheet, own))
        details = (scale_words(times) for times in sheet.enlarged)
        words = sheet.drawing.words
        in_details = words.clauses(words("screen.detail", scale=each) for each in details)
        said[-1] = replace(said[-1], aside=in_details)
    shown = sorted({mark.step for marks in timed for mark in marks if mark.step is not None})
    ran = {step for sheet in sheets for step in sheet.drawing.trace.values}
    program = sheets[0].drawing.trace.program
    pairs = {step: pair for step in shown if (pair := sides(program, step, shown))}
    return PageProtocol(
        tuple(said),
        tuple(timed),
        {step: at.get(step, 0) for step in shown},
        {step: sources(program, step, frozenset(shown), ran) for step in shown},
        pairs,
        {
            step: names.get(name, sheets[0].drawing.symbol(name))
            for step in shown
            if (name := letter(program.steps[step]))
        },
        {step: tint for one in said for tint, step in enumerate(one.of) if tint and step in shown},
        hanging(sheets, shown),
        tuple(found.number for found in lines_of(sheets) if found.part in (Part.CENTRE, Part.POLE)),
        {step: args for step in shown if (args := square_to(program.steps[step]))},
    )


def reopened(sheet: ScreenSheet, own: Sequence[Sentence]) -> list[tuple[str, str]]:
    """The markup of each sentence with gaps for lengths, and with lengths of zero.

    Both are empty where the sentence does not differ.
    """
    if sheet.drawing.kind == FORCE:
        return [("", "")] * len(own)
    others = [
        in_parts(replace(sheet, drawing=replace(sheet.drawing, lengths=lengths)))[0]
        for lengths in ("open", "none")
    ]
    return [
        (a.markup, b.markup) if a.markup != one.markup else ("", "")
        for one, a, b in zip(own, *others, strict=True)
    ]


def in_parts(sheet: ScreenSheet) -> tuple[list[Sentence], dict[int, int], tuple[Timed, ...]]:
    """The page's sentences for one sheet, the sentence (from 0) of each step, and the marks."""
    drawing = sheet.drawing
    found = parted_sentences(drawing)
    parts = [part.sentence for one in found for part in one.parts]
    staged = stages(drawing, parts)
    marks = timed_marks(sheet, parts, staged)
    drawn = strokes(marks, len(parts))
    said: list[Sentence] = []
    places: list[int] = []
    for one in found:
        first = len(places)
        for sentence, count in one.sentences(drawing, drawn[first : first + len(one.parts)]):
            places += [len(said)] * count
            said.append(sentence)
    own = {step: places[stage] if stage >= 0 else stage for step, stage in staged.items()}
    timed = [replace(one, at=places[one.at - 1] + 1 if one.at else 0) for one in marks]
    said, own, timed = vectors_apart(drawing, said, own, timed)
    telling = naming_stages(drawing, own)
    lettered = (replace(one, letters=named_letters(one.mark, telling)) for one in timed)
    return with_indices(drawing, said), own, tuple(lettered)


def vectors_apart(
    drawing: Drawing, said: Sequence[Sentence], own: Mapping[int, int], marks: Sequence[Timed]
) -> tuple[list[Sentence], dict[int, int], list[Timed]]:
    """The sentences, steps and marks with excess vectors moved to sentences of their own.

    Vectors are moved where they are too many for the sentence that finds their ends or sets them on
    the mechanism; they follow that sentence.
    """
    counts = strokes(marks, len(said))
    shown = {one.step for one in marks}
    found: list[Sentence] = []
    places: list[int] = []
    moved: dict[int, int] = {}
    for stage, sentence in enumerate(said):
        places.append(len(found))
        fresh = sorted(step for step, at in own.items() if at == stage and step in shown)
        setting, name = sentence.name == SET_ON, VECTORS_APART
        if setting:
            arrows, name = [n for n in fresh if is_set_on(drawing.trace.program.steps[n])], SET_ON
        else:
            arrows = [n for n in fresh if vector_found(drawing, n, names_in(sentence.markup))]
        late = arrows[max(len(arrows) - max(counts[stage] - MOST, 0), 0) :]
        if setting and late:
            first_ones = set_on_mechanism(drawing, "", arrows[: -len(late)])
            found.append(replace(sentence, markup=first_ones))
        else:
            found.append(sentence)
        for first in range(0, len(late), MOST):
            some = late[first : first + MOST]
            if setting:
                markup = set_on_mechanism(drawing, "", some)
            else:
                markup = drawing.words.clauses(vector_found(drawing, number) for number in some)
            moved |= dict.fromkeys(some, len(found))
            found.append(Sentence(some[-1], name, markup, tuple(some)))
    later_own = {step: places[at] if at >= 0 else at for step, at in own.items()} | moved
    timed = [
        replace(one, at=(later_own[one.step] if one.step in moved else places[one.at - 1]) + 1)
        if one.at
        else one
        for one in marks
    ]
    return found, later_own, timed


def named_letters(mark: Mark, telling: Mapping[str, int]) -> tuple[int, ...]:
    """The sentences (from 1, 0 if given) that find the letters of a shared label."""
    if not isinstance(mark, Text) or mark.step is None or mark.rotate:
        return ()
    shared = mark.letters if len(mark.letters) > 1 else ()
    return tuple(telling.get(letter.name, -1) + 1 for letter in shared)


def labels_of(sheet: ScreenSheet) -> dict[str, str]:
    """The markup of each label of a sheet, by the name of its object."""
    marks = (*sheet.left, *sheet.right)
    return {mark.name: mark.markup for mark in marks if isinstance(mark, Text) and mark.name}


def later(one: Timed, before: int) -> Timed:
    """A mark renumbered after the sentences of the previous sheets; given marks keep 0."""
    letters = tuple(at and before + at for at in one.letters)
    return replace(one, at=one.at and before + one.at, letters=letters)


def strokes(marks: Iterable[Timed], count: int) -> list[int]:
    """The number of lines, arcs and vectors in each sentence; the pieces of one line count once."""
    found: list[set[tuple[int, str, str]]] = [set() for _ in range(count)]
    for one in marks:
        look = style_class(one.mark)
        if one.at and one.step is not None and look in DRAWN and not isinstance(one.mark, Text):
            found[one.at - 1].add((one.step, look, one.mark.name))
    return [len(some) for some in found]


def hanging(sheets: Sequence[ScreenSheet], shown: Sequence[int]) -> dict[int, tuple[int, ...]]:
    """The crossings that each step of a plan needs, without the crossings of positions."""
    program = sheets[0].drawing.trace.program
    lines = {found.number for found in lines_of(sheets) if found.part is not Part.POSITION}
    found = {step: lines.intersection(program.behind([step], by_hand=True)) for step in shown}
    for line in lines:
        for step in program.steps[line].args:
            if step in found and not program.steps[step].name:
                found[step] |= {line}
    return {step: tuple(sorted(needed)) for step, needed in found.items() if needed}


def lines_of(sheets: Sequence[ScreenSheet]) -> Iterator[Crossing]:
    """Every crossing of some sheets."""
    for sheet in sheets:
        yield from crossings(sheet.drawing.trace)


def square_to(step: Step) -> tuple[int, ...]:
    """The pin, the pole and the velocity image that fix a line perpendicular to the velocity."""
    kind = construction(step)
    return kind.square_to if isinstance(kind, VelocityNormal) else ()


def spoken(
    place: int,
    drawing: Drawing,
    own: Sequence[Sentence],
    staged: Mapping[int, int],
    labels: Mapping[str, str],
    shown: AbstractSet[int],
    others: Sequence[tuple[str, str]],
) -> Iterator[ProtocolSentence]:
    """The sentences of one sheet, on which the steps ``shown`` have marks."""
    steps = drawing.trace.program.steps
    parts = [{steps[number].part for number in sentence.all_steps} for sentence in own]
    last = {
        part: stage
        for stage, found in enumerate(parts)
        for part in found
        if own[stage].name != SET_ON
    }
    lines = crossings_on(drawing)
    for stage, sentence in enumerate(own):
        fresh = [step for step, at in staged.items() if at == stage]
        why = [*of_sentence(drawing, sentence), *reasons(drawing, fresh)]
        found = [crossing for crossing in lines if staged.get(crossing.number) == stage]
        vectors = [*vectors_found(drawing, sorted(shown & {*fresh}), sentence.markup)]
        markup, in_gaps, fallen = (
            drawing.words.clauses((one, *vectors)) if one else ""
            for one in (sentence.markup, *others[stage])
        )
        yield ProtocolSentence(
            place,
            markup,
            tuple(text for text, _ in why),
            tuple(shown_by(drawing, step, fresh, shown) for _, step in why),
            tuple(found),
            tuple(labels.get(crossing.name, drawing.symbol(crossing.name)) for crossing in found),
            tuple(part for part in STOPS if last.get(part) == stage),
            rates=tuple(rates_read(drawing, sentence)),
            open=in_gaps,
            fallen=fallen,
        )


def shown_by(drawing: Drawing, number: int, fresh: Iterable[int], shown: AbstractSet[int]) -> int:
    """The step whose marks show a step: the step itself, or the arrow that ends in it."""
    if number in shown:
        return number
    steps = drawing.trace.program.steps
    arrows = (n for n in fresh if n in shown and steps[n].arrow and number in steps[n].args)
    return min(arrows, default=number)


def rates_read(drawing: Drawing, sentence: Sentence) -> Iterator[str]:
    """The links whose rates a sentence reads off, without mere keepers of wheels on tracks."""
    if sentence.name == TURNING:
        related = {relation.left for relation in of_turning(drawing)}
        for (what, link), number in drawing.trace.program.targets.items():
            is_read = what == drawing.rate.target and number in sentence.all_steps
            if is_read and drawing.symbol(f"{drawing.rate.letter}_{link}") in related:
                yield link


def vectors_found(drawing: Drawing, fresh: Iterable[int], markup: str) -> Iterator[str]:
    """The names of plan vectors that a sentence draws without mentioning them."""
    said = names_in(markup)
    return (name for number in fresh if (name := vector_found(drawing, number, said)))


def vector_found(drawing: Drawing, number: int, said: AbstractSet[str] = frozenset()) -> str:
    """The equation of segment and vector for a step that draws a vector of the plan.

    Empty for any other step, and for a vector that the sentence has ``said``.
    """
    step = drawing.trace.program.steps[number]
    vector = plan_vector(step)
    if vector is None or step.plane is not drawing.plane or not vector.symbol:
        return ""
    segment = segment_of(drawing, step)
    if not segment or vector.symbol in said:
        return ""
    return EQUALS.join((segment, drawing.symbol(vector.symbol)))


def timed_marks(
    sheet: ScreenSheet, own: Sequence[Sentence], staged: dict[int, int]
) -> tuple[Timed, ...]:
    """The marks of a sheet, each with the sentence of the sheet (from 1) that draws it."""
    found, touched = [], dict(marked_beside(sheet))
    ground = ground_of(sheet.drawing, sheet.layout.mechanism)
    for mark, beside in accompanied((*sheet.left, *sheet.right)):
        step = touched.get(mark)
        if step is None:
            step = step_of(sheet.drawing, mark)
            stage = stage_of(sheet.drawing, beside, staged, own, ground)
        else:
            stage = staged[step]
        found.append(Timed(mark, stage + 1 if stage >= 0 else 0, step))
    return tuple(found)


def marked_beside(sheet: ScreenSheet) -> Iterator[tuple[Mark, int]]:
    """Marks that show a contact point and its letter on the mechanism, each with its step."""
    steps, field = sheet.drawing.trace.program.steps, sheet.layout.mechanism
    for number, at in sheet.drawing.trace.values.items():
        kind = construction(steps[number])
        if not isinstance(kind, PointOfContact):
            continue
        place = complex(*field(at))
        for mark in sheet.left:
            if isinstance(mark, CircleMark) and mark.cls == kind.marked_as:
                if abs(complex(mark.cx, mark.cy) - place) < SAME:
                    yield mark, number
            elif isinstance(mark, Text) and mark.step is None and mark.name == steps[number].name:
                yield mark, number


def step_of(drawing: Drawing, mark: Mark) -> int | None:
    """The step that a mark shows; for a mark without a step, the step of its point or guide."""
    if mark.step is not None:
        return mark.step
    shown = mark.shows
    target = ("position", mark.name) if shown is None else (shown.what, shown.link)
    return drawing.trace.program.targets.get(target)


def sources(
    program: Program, number: int, shown: Collection[int], ran: Collection[int]
) -> tuple[int, ...]:
    """The steps with marks that a step is drawn from, found through the steps without marks."""
    found: set[int] = set()
    seen = {number}
    waiting = [number]
    while waiting:
        step = program.steps[waiting.pop()]
        by_hand = () if step.by_hand is None else (step.by_hand,)
        for source in (*step.args, *by_hand):
            if source in seen or source not in ran:
                continue
            seen.add(source)
            if source in shown:
                found.add(source)
            else:
                waiting.append(source)
    return tuple(sorted(found))


def sides(program: Program, number: int, shown: Collection[int]) -> tuple[int, int] | None:
    """The two points of the mechanism that give a line of a plan its direction."""
    step = program.steps[number]
    if step.plane in (Plane.MECHANISM, Plane.NUMBERS):
        return None
    points = [
        arg
        for arg in step.args
        if arg in shown and program.steps[arg].plane is Plane.MECHANISM and program.steps[arg].name
    ]
    return (points[0], points[1]) if len(points) == 2 else None


def letter(step: Step) -> str:
    """The letter of a step's point on the drawing; empty for an arrow or a number."""
    return "" if step.arrow or step.plane is Plane.NUMBERS else step.name
