"""Step by step: pages on which a sheet grows, each with the sentence that says what to do.

The dependencies of mechanism marks without a step: points, axes, and driver positions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import degrees
from typing import NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.centres.instant_centre import set_before
from graphkin.construction.core.crossings import Crossing, flattest
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence, construction
from graphkin.construction.core.layout import lay_out, lowered
from graphkin.construction.core.program import Part, Plane, Step, is_set_on, plan_vector
from graphkin.construction.guides.slide_symbols import frame_guides
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.construction.links.idle_links import IDLE
from graphkin.construction.links.link_shapes import corners_of, farthest, is_all_wheel, places_of
from graphkin.construction.links.wheel_symbols import TOUCHED, straight_tracks, touching_points
from graphkin.documents.detail import insets, parted
from graphkin.documents.listing import rows_of, written
from graphkin.documents.sentences import (
    SET_ON,
    crossings_on,
    group_closed,
    is_gap,
    names_of_crossing,
    sentences,
)
from graphkin.documents.sheet import (
    boards,
    page_title,
    pages_of,
    panels,
    sheet_heading,
    title_block,
)
from graphkin.documents.signs import mechanism_signs, plan_signs
from graphkin.drawing.field import Field, SheetPaper
from graphkin.drawing.labels import NOTE
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Page, Text, style_class
from graphkin.drawing.richtext import extent, flowed, flowed_pieces, words_of
from graphkin.drawing.style import DRAWN, NOW
from graphkin.scene.link_points import lettered
from graphkin.scene.model import FRAME, Driver, Link

Target = tuple[str, str]
BODY = ("plate", "outline", "link", "number", "label", "leader")
"""The classes of a link's bar or plate, and of its number."""


def ground_of(drawing: Drawing, field: Field) -> Mapping[Mark, tuple[Target, ...]]:
    """The guides and straight tracks of the frame, each with the points around which it is drawn.

    Their lines across the field say nothing of the positions of blocks and wheels.
    """
    found: dict[Mark, tuple[Target, ...]] = {}
    links = drawing.scene.links
    for blocks, marks in frame_guides(drawing, field):
        about = tuple(("position", links[block].points[0]) for block in blocks)
        found |= dict.fromkeys(marks, about)
    for touch, marks in straight_tracks(drawing, field):
        if touch.on == FRAME:
            found |= dict.fromkeys(marks, (("position", touch.disc.wheel.centre),))
    return found


def rests_on(drawing: Drawing, mark: Mark) -> Iterator[Target]:
    """The targets of the program that a mark depends on; none for a given mark."""
    link = drawing.scene.links.get(mark.name)
    if mark.shows is not None:
        drivers = (d for d in drawing.scene.drivers if d.link == mark.shows.link)
        if mark.shows.what != "guide":
            yield from of_driver(drawing, next(drivers))
    elif link is not None:
        yield from of_link(drawing, link, style_class(mark))
    else:
        yield "position", mark.name


def of_link(drawing: Drawing, link: Link, kind: str) -> Iterator[Target]:
    """The targets of a link's mark: points, and its axis where the points do not define it."""
    points = list(link.points)
    turned = len(points) < 2
    carriers = {way.slide.on for way in drawing.standing.guideways}
    if kind == TOUCHED:
        points, turned = touching_points(drawing, link), False
    elif kind == "disc":
        points, turned = [wheel.centre for wheel in link.wheels], False
    elif kind == "slider":
        points, turned = points[:1], False
    elif kind == "block" or (link.name in carriers and corners_of(drawing, link) is None):
        points, turned = points[:1], True
    elif kind in BODY and not any(wheel.teeth for wheel in link.wheels):
        points = body_of(drawing, link)
        level = link.wheels or any(slide.on == FRAME for slide in link.slides)
        turned = len(points) < 2 and not level
    yield from (("position", point) for point in points)
    if turned:
        yield "axis", link.name


def body_of(drawing: Drawing, link: Link) -> list[str]:
    """The points that a link's body needs: ends of a bar, corners of a plate, a wheel's centre."""
    if link.wheels and is_all_wheel(drawing, link.name):
        return [wheel.centre for wheel in link.wheels]
    places = places_of(drawing, link.name)
    if len(places) < 2:
        return list(link.points)
    ends = corners_of(drawing, link) or farthest(places)
    return [point for point in link.points if drawing.positions.get(point) in ends]


def of_driver(drawing: Drawing, driver: Driver) -> Iterator[Target]:
    """The targets that show the position of a driver."""
    link = drawing.scene.links[driver.link]
    if driver.kind == "turn":
        yield from (("position", point) for point in (driver.of or link.points)[:2])
    elif driver.kind == "slide":
        yield "position", link.points[0]
        yield "guide", link.name
    else:
        yield from (("position", wheel.centre) for wheel in link.wheels)


AT_LAST = ("detail", "note")
"""The names of marks that appear when everything is drawn."""
PINS = ("pin", "hinge", "label", "leader")
"""The classes of a pin, and of its letter."""
DRAWN_WITH = {"fixed-centrode": "moving-centrode"}
"""Names of sentences for kinds of curves that have no sentence of their own."""
BEFORE = -1
"""The stage of the marks before the first sentence."""


def stages(drawing: Drawing, said: Sequence[Sentence]) -> dict[int, int]:
    """The number of the sentence, from 0, that draws each step that was run.

    A sentence draws the steps that its points depend on and that no earlier sentence has drawn. An
    arrow, or any other step that no sentence finds, appears once all its sources are drawn. Given
    steps, the points of the frame and the pole of the plan come before the first sentence.
    """
    program = drawing.trace.program
    found: dict[int, int] = {}
    if drawing.again:
        found |= dict.fromkeys(
            (n for n in drawing.trace.values if program.steps[n].part is Part.POSITION), BEFORE
        )
    for stage, sentence in enumerate(said):
        own = (number for number in sentence.all_steps if number >= 0)
        for number in program.behind(own, by_hand=True):
            found.setdefault(number, stage)
    early = set_before(drawing)
    setting = next((at for at, one in enumerate(said) if one.name == SET_ON), len(said) - 1)
    for number in drawing.trace.values:
        step = program.steps[number]
        if not step.args:
            found[number] = BEFORE
        elif number in early:
            found.setdefault(number, found.get(early[number], setting))
        elif is_set_on(step):
            found[number] = setting
        elif number not in found:
            ends = (*step.args, *of_component(drawing, step))
            found[number] = max((found.get(end, BEFORE) for end in ends), default=BEFORE)
    return found


def of_component(drawing: Drawing, step: Step) -> Iterator[int]:
    """The images between which a tangential component lies, which appears only after them."""
    vector = plan_vector(step)
    if vector is not None and vector.sign == "τ":
        ends = (vector.p, vector.q)
        for (what, name), number in drawing.trace.program.targets.items():
            if what == "acceleration" and lettered(name) in ends:
                yield number


def stage_of(
    drawing: Drawing,
    mark: Mark,
    staged: dict[int, int],
    said: Sequence[Sentence],
    ground: Mapping[Mark, tuple[Target, ...]],
) -> int:
    """The sentence at which a mark of a field appears; BEFORE for marks shown from the start.

    A mark without a step appears with the last of its dependencies. For a ``ground`` mark these are
    the points around which it is drawn.
    """
    if mark.step is not None:
        return staged.get(mark.step, BEFORE)
    if mark.name in AT_LAST:
        return len(said) - 1
    found = stage_of_closing(drawing, mark, said)
    if found is None:
        found = stage_of_curve(drawing, mark, said)
    if found is not None:
        return found
    targets = drawing.trace.program.targets
    rests = ground[mark] if mark in ground else rests_on(drawing, mark)
    numbers = (targets[target] for target in rests if target in targets)
    idle = (stage for stage, one in enumerate(said) if one.name == IDLE and one.link == mark.name)
    return max((*idle, *(settled(drawing, number, staged) for number in numbers)), default=BEFORE)


def settled(drawing: Drawing, number: int, staged: dict[int, int]) -> int:
    """The sentence that fixes a value; a number is fixed as soon as it can be computed."""
    step = drawing.trace.program.steps[number]
    closes = isinstance(step.of, ClosedGroup) and step.role == "closing"
    if number in staged and (closes or step.plane is not Plane.NUMBERS):
        return staged[number]
    return max((settled(drawing, arg, staged) for arg in step.args), default=BEFORE)


def stage_of_curve(drawing: Drawing, mark: Mark, said: Sequence[Sentence]) -> int | None:
    """The sentence for a curve, one for each curve of its kind; None for other marks."""
    for curve in drawing.curves:
        if mark.name == curve.name:
            if curve.kind == "locus":
                return next(at for at, one in enumerate(said) if curve.of in traced(drawing, one))
            alike = [other.of for other in drawing.curves if other.kind == curve.kind]
            name = DRAWN_WITH.get(curve.kind, curve.kind)
            stages = [stage for stage, sentence in enumerate(said) if sentence.name == name]
            return stages[min(alike.index(curve.of), len(stages) - 1)]
    return None


def stage_of_closing(drawing: Drawing, mark: Mark, said: Sequence[Sentence]) -> int | None:
    """The sentence that closes a group at a pin, for the pin's marks; None for all others."""
    if style_class(mark) not in PINS or mark.name in drawing.scene.links:
        return None
    return next((at for at, one in enumerate(said) if mark.name in traced(drawing, one)), None)


def traced(drawing: Drawing, said: Sentence) -> tuple[str, ...]:
    """The points whose loci a sentence has drawn."""
    kind = construction(drawing.trace.program.steps[said.step]) if said.step >= 0 else None
    return kind.traced if isinstance(kind, ClosedGroup) else ()


# --- the content of a sheet's fields at each sentence, with new marks highlighted -----------------


def appearing(
    drawing: Drawing,
    field: Field,
    marks: Sequence[Mark],
    staged: dict[int, int],
    said: Sequence[Sentence],
) -> Iterator[tuple[int, Mark]]:
    """The marks of a field, each with the sentence at which it appears."""
    ground = ground_of(drawing, field)
    for mark, beside in accompanied(marks):
        yield stage_of(drawing, beside, staged, said, ground), mark


def accompanied(marks: Sequence[Mark]) -> Iterator[tuple[Mark, Mark]]:
    """The marks of a field, each with the mark with which it appears.

    The frame around a link's name appears with the name after it, any other mark by itself.
    """
    for mark, after in zip(marks, (*marks[1:], *marks[-1:]), strict=True):
        yield mark, after if style_class(mark) == "number" and not mark.name else mark


def naming_stages(drawing: Drawing, staged: Mapping[int, int]) -> dict[str, int]:
    """The sentence that finds each letter of the plan, each centre and each vector.

    Vectors are given by their symbols.
    """
    found: dict[str, int] = {}
    for number, step in enumerate(drawing.trace.program.steps):
        if number in staged:
            vector = plan_vector(step)
            name = drawing.symbol(vector.symbol if vector else step.name)
            found.setdefault(name, staged[number])
            if vector and vector.foot:
                found.setdefault(vector.foot, staged[number])
            if step.plane in (drawing.plane, Plane.LEVER) or step.part in (Part.CENTRE, Part.POLE):
                found[step.name] = staged[number]
    return found


def marks_at_stage(
    timed: Sequence[tuple[int, Mark]], stage: int, telling: Mapping[str, int]
) -> Iterator[Mark]:
    """The marks at a sentence; those that the sentence draws are highlighted.

    ``telling`` gives the sentence at which each letter and each vector is found.
    """
    subjects = {mark.step: mark.cx for _, mark in timed if isinstance(mark, CircleMark)}
    subjects |= {
        m.step: m.x1 for _, m in timed if isinstance(m, LineMark) and style_class(m) == "leader"
    }
    texts = [(at, mark) for at, mark in timed if isinstance(mark, Text)]
    explained = {part.name for _, mark in texts if mark.name == NOTE for part in mark.letters}
    keys = {mark.markup: at for at, mark in texts if mark.markup in explained - {""}}
    for appears, mark in timed:
        if isinstance(mark, Text) and len(mark.letters) > 1 and mark.step is not None:
            stages = [telling[letter.name] for letter in mark.letters]
            yield from shared(mark, stage, stages, subjects[mark.step])
        elif isinstance(mark, Text) and mark.name == NOTE and stage < appears:
            yield from noted(mark, stage, {**telling, **keys})
        elif appears <= stage:
            yield mark if appears < stage else replace(mark, cls=f"{mark.cls} {NOW}")


def shared(mark: Text, stage: int, stages: Sequence[int], subject: float) -> Iterator[Mark]:
    """The letters of a shared label that have appeared, as near to their point as the whole label.

    ``stages`` are the sentences at which the letters appear; ``subject`` is the x of their leader
    or their point.
    """
    every = zip(mark.letters, stages, strict=True)
    seen = [letter for letter, appears in every if appears <= stage]
    if seen:
        markup = seen[0].markup + "".join(letter.joined for letter in seen[1:])
        whole, width = (extent(each, mark.height)[0] for each in (mark.markup, markup))
        aside = min(max(subject - mark.x - width / 2, 0.0), whole - width)
        cls = f"{mark.cls} {NOW}" if stage in stages else mark.cls
        yield replace(mark, x=mark.x + aside, markup=markup, cls=cls)


def noted(mark: Text, stage: int, telling: Mapping[str, int]) -> Iterator[Mark]:
    """The parts of a note line at the foot whose vectors and key numbers have appeared."""
    parts = mark.letters
    is_written = [telling.get(part.name, stage + 1) <= stage for part in parts]
    for i, part in enumerate(parts):
        if is_written[i]:
            before = extent("".join(each.joined for each in parts[: i + 1]), mark.height)[0]
            ended = (
                part.markup + parts[i + 1].joint.rstrip()
                if any(is_written[i + 1 :])
                else part.markup
            )
            aside = before - extent(part.markup, mark.height)[0]
            yield replace(mark, x=mark.x + aside, markup=ended)


# --- step by step: pages on which a sheet grows, each with its sentence ---------------------------


LARGE, CLOSE, DONE = (3.5, 6.2), (2.5, 4.2), (2.5, 4.6)
"""Height and line distance in mm of sentences: large, small, and done.

The small size is for sentences to do that have no room in the large one.
"""


class StepLines(Struct, frozen=True):
    """The place of these lines, in mm: their start, their end, and the first and last baselines.

    ``first`` is the baseline of the first line to do, ``above`` that of the lowest one above the
    title block. ``beside`` is the width of lines next to the title block, ``clear`` that of lines
    clear of the centring mark, which ends at ``marked``.
    """

    left: float
    top: float
    right: float
    first: float
    above: float
    beside: float
    clear: float
    marked: float
    low: float


def step_lines(paper: SheetPaper) -> StepLines:
    """The place of the lines on a paper."""
    left, top, right, low = paper.below
    left, (end, marked), block = left + 2, paper.marked, paper.blocks[0]
    beside = right if paper.is_leaf else block[0]
    return StepLines(
        left,
        top + 4.5,
        right - 4,
        top + 12.5,
        min(block[1] - 4, low),
        beside - left - 5,
        end - left - 7,
        marked,
        low,
    )


MOST = 150
"""Number of words that exceeds any line."""
LEFT_OUT = "…"
"""The sign for done sentences that have no room."""


def growing(drawing: Drawing, number: str) -> tuple[Page, ...]:
    """A page for each sentence of the construction, with its new marks highlighted.

    A sentence that draws nothing, such as a computed one, shares the page of the next that does.
    ``number`` is the number of the sheet; each page adds its step and the number of steps. Every
    mark and letter has the place that it has on the finished sheet.
    """
    head, _, more = sheet_heading(drawing)
    layout = lowered(drawing.paper, lay_out(drawing), more)
    said = sentences(drawing)
    staged = stages(drawing, said)
    (left, detail, _), (right, other, _) = parted(*boards(drawing, layout, "key", said))
    telling = naming_stages(drawing, staged)
    given = 0 if drawing.again else BEFORE
    field = layout.mechanism
    standing = appearing(drawing, field, left, staged, said)
    timed = [(max(stage, given), mark) for stage, mark in standing]
    timed += appearing(drawing, field, right, staged, said)
    detail += insets(drawing, layout.mechanism, [*left, *detail])
    detail += mechanism_signs(drawing, layout.mechanism, [*left, *detail])
    last = [*detail, *other, *plan_signs(drawing, layout.plan, [*right, *other])]
    block, same = (
        title_block(drawing, "steps", number),
        [*head, *panels(drawing.paper, layout)],
    )
    lines = [
        (stage_of_crossing(drawing, each, staged), each)
        for each in crossings_on(drawing)
        if not is_gap(drawing, each)
    ]
    title = page_title(drawing)
    timed, telling, parts = in_strokes(timed, staged, telling, len(said))
    fields = [tuple(marks_at_stage(timed, place, telling)) for place in range(len(parts))]
    at = step_lines(drawing.paper)

    def is_held(first: int, last: int) -> bool:
        return to_do(said, parts[first].stage, parts[last].stage, at).is_held

    return tuple(
        page
        for first, place in spans(fields, is_held)
        for begins, part in [(parts[first].stage, parts[place])]
        for page in pages_of(
            drawing,
            replace(block, sheet=numbered(drawing, number, part, len(said))),
            (
                *same,
                *fields[place],
                *(last if place == len(parts) - 1 else ()),
                *text_block(drawing, said, begins, part, at),
                *crossed(drawing, [line for at, line in lines if begins <= at <= part.stage]),
            ),
            f"{title}, {part.number}/{len(said)}",
        )
    )


STROKES = 3
"""Largest number of new lines, arcs and vectors on a page."""


class StepPart(NamedTuple):
    """A page of a sentence: the sentence (from 0), and the letter of the page if it has several."""

    stage: int
    letter: str

    @property
    def number(self) -> str:
        """The number of the sentence and the letter: 3, or 3a."""
        return f"{self.stage + 1}{self.letter}"


def in_strokes(
    timed: Sequence[tuple[int, Mark]],
    staged: Mapping[int, int],
    telling: Mapping[str, int],
    count: int,
) -> tuple[list[tuple[int, Mark]], dict[str, int], list[StepPart]]:
    """The marks and the names by page instead of by sentence, and the pages of all sentences.

    A sentence of more than STROKES lines, arcs and vectors has several pages, in the order of its
    steps. A point or a letter appears with the last stroke of its own step or of earlier ones.
    """
    strokes: list[dict[Stroke, None]] = [{} for _ in range(count)]
    for stage, mark in sorted(timed, key=lambda each: -1 if each[1].step is None else each[1].step):
        if stage >= 0 and (key := stroke_of(mark)):
            strokes[stage][key] = None
    pages = [max(-(-len(some) // STROKES), 1) for some in strokes]
    begins = [sum(pages[:stage]) for stage in range(count)]
    nth = [{key: i // STROKES for i, key in enumerate(some)} for some in strokes]

    def place(stage: int, key: Stroke | None, step: int | None) -> int:
        if stage < 0:
            return stage
        if key is not None and key in nth[stage]:
            return begins[stage] + nth[stage][key]
        ended = [at for own, at in nth[stage].items() if step is None or own[0] <= step]
        return begins[stage] + max(ended, default=0)

    steps = {m.name: m.step for _, m in timed if m.step is not None and m.name}
    parts = [
        StepPart(stage, lettered_as(i) if many > 1 else "")
        for stage, many in enumerate(pages)
        for i in range(many)
    ]
    return (
        [(place(stage, stroke_of(mark), mark.step), mark) for stage, mark in timed],
        {name: place(stage, None, steps.get(name)) for name, stage in telling.items()},
        parts,
    )


def lettered_as(place: int) -> str:
    """The letter of a page from 0: a to z, then aa, ab …"""
    more, last = divmod(place, 26)
    return (lettered_as(more - 1) if more else "") + chr(ord("a") + last)


Stroke = tuple[int, str, str]
"""The step of a line, arc or vector, its class and its name."""


def stroke_of(mark: Mark) -> Stroke | None:
    """The stroke to which a mark belongs; the pieces of one line are one stroke."""
    look = style_class(mark)
    if mark.step is None or isinstance(mark, Text) or look not in DRAWN:
        return None
    return mark.step, look, mark.name


def spans(
    fields: Sequence[Sequence[Mark]], held: Callable[[int, int], bool]
) -> Iterator[tuple[int, int]]:
    """The first and the last sentence of each page, as far as ``held`` allows them together.

    The last sentence draws new marks, or the next one has no room on the page.
    """
    first = 0
    for stage, field in enumerate(fields):
        is_new = any(NOW in mark.cls.split() for mark in field)
        if stage == len(fields) - 1 or is_new or not held(first, stage + 1):
            yield first, stage
            first = stage + 1


def numbered(drawing: Drawing, number: str, part: StepPart, total: int) -> str:
    """The number of a step's page within its sheet, for the title block."""
    return drawing.words("page.sheet_step", sheet=number, number=part.number, all=total)


def crossed(drawing: Drawing, found: Sequence[Crossing]) -> Iterator[Mark]:
    """The flattest crossing of a sentence, and the effect of a millimetre of pencil error there."""
    worst = flattest(tuple(found))
    if worst is None:
        return
    words = drawing.words
    text = words(
        "page.crossing",
        name=names_of_crossing(drawing, worst)[0],
        angle=words.fixed(degrees(worst.angle), 0),
        factor=words.significant(worst.factor, 2),
    )
    yield Text(*ending(drawing.paper), text, "caption", 2.5, "end", name="crossing")


def ending(paper: SheetPaper) -> tuple[float, float]:
    """The end of the line beside the heading."""
    _, top, right, _ = paper.below
    return right - 4, top + 4.5


def stage_of_crossing(drawing: Drawing, crossing: Crossing, staged: Mapping[int, int]) -> int:
    """The sentence that draws a crossing."""
    group = group_closed(drawing, crossing)
    return staged[group.closing if group is not None and group.locus else crossing.number]


class ToDo(NamedTuple):
    """The lines of sentences to do: lines with baselines, letter height, next baseline, and fit."""

    lines: list[tuple[float, str]]
    height: float
    low: float
    is_held: bool


def to_do(said: Sequence[Sentence], first: int, last: int, at: StepLines) -> ToDo:
    """The sentences from ``first`` to ``last``: large above the title block, or else smaller."""
    markups = [
        f"{number}. {each.markup}" if first < last else each.markup
        for number, each in enumerate(said[first : last + 1], first + 1)
    ]
    for (height, leading), lowest in ((LARGE, at.above), (CLOSE, at.low)):
        lines: list[tuple[float, str]] = []
        y = at.first
        for markup in markups:
            for line in wrapped(markup, height, leading, y, at):
                lines.append((y, line))
                y += leading
        if y - leading <= lowest:
            return ToDo(lines, height, y, True)
    return ToDo(lines, height, y, False)


def wrapped(markup: str, height: float, leading: float, y: float, at: StepLines) -> Iterator[str]:
    """The lines of a sentence from a baseline on, narrower next to the title block."""
    words = words_of(markup)
    while words:
        wide = at.beside if y <= at.marked else at.clear
        wide = at.right - at.left if y <= at.above else wide
        line, held = flowed_pieces(words[:MOST], " ", wide, height)[0]
        yield line
        words, y = words[len(held) :], y + leading


def text_block(
    drawing: Drawing, said: Sequence[Sentence], first: int, part: StepPart, at: StepLines
) -> Iterator[Mark]:
    """The sentences to do in large lettering, and below them the last of those that are done."""
    words, stage = drawing.words, part.stage
    key, several = (
        ("page.steps_of", {"first": first + 1}) if first < stage else ("page.step_of", {})
    )
    caption = words(key, number=part.number, all=len(said), **several)
    yield Text(at.left, at.top, caption, "caption", 3.5, name="step")
    lines, height, y, _ = to_do(said, first, stage, at)
    for foot, line in lines:
        yield Text(at.left, foot, line, "caption", height, name="sentence")
    if y - 2.5 < at.marked:
        yield LineMark(at.left, y - 2.5, at.left + at.beside, y - 2.5, "panel")
    done = [
        (f"{number}." if i == 0 else "", line)
        for number, sentence in enumerate(said[:first], 1)
        for i, line in enumerate(flowed(words_of(sentence.markup), " ", at.clear, DONE[0]))
    ]
    room = max(int((at.low - y - 3.5) // DONE[1]) + 1, 0)
    shown = done
    if len(done) > room:  # a line shows that earlier sentences are left out
        shown = done[len(done) - room + 1 :]
        while shown and not shown[0][0]:
            shown = shown[1:]
        shown = [("", LEFT_OUT), *shown][:room]
    yield from written(shown, at.left, rows_of(y + 2.5, DONE[1], len(shown)))
