"""The relations of the calculation in the order of the work, read off the steps.

What was laid off, what was crossed, and what follows by length.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from graphkin.construction.core.amounts import OnPaper
from graphkin.construction.core.component import components_on
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.construction.core.naming import drawn_between, drawn_in, scale_of, segment_of
from graphkin.construction.core.plan_vector import plan_vector
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.construction.core.relation import FINE, Relation, answer, figure, length_of, within
from graphkin.construction.drivers.driver_relations import of_driver, of_scales
from graphkin.construction.guides.sliding_relations import of_slides
from graphkin.construction.higher_class.misclosure import Misclosure, driver_of, misses
from graphkin.construction.higher_class.trial_lengths import of_trial_lengths
from graphkin.construction.rate_relations import of_sum, of_turning
from graphkin.construction.registry import COMPONENTS
from graphkin.construction.rolling.contact_velocities import of_contacts
from graphkin.construction.vector_equations import is_laid_off, of_equations
from graphkin.drawing.scale import digits
from graphkin.drawing.symbol_markup import TAGS, bar, symbol
from graphkin.numbers.plane import Ratio, Vector

Section = tuple[str, list[Relation]]
GAPS = tuple(symbol(f"m{tag}") for tag in TAGS)
"""What two trial plans miss."""
ROOM = ". . . . . . . ."
"""Room to write a coordinate in."""


def relations(drawings: Sequence[Drawing], *, solved: bool = True) -> list[Section]:
    """The sections of the calculation, in the order of the work.

    The data of one that is not solved leave out what it asks.
    """
    first = drawings[0]
    sections: list[Section] = [
        ("data", [data_line(first, solved=solved)]),
        ("driver", [r for d in first.scene.drivers for r in of_driver(first, d)]),
        ("scales", list(of_scales(first))),
    ]
    for drawing in drawings:
        sections += sections_of(drawing)
    used = dict.fromkeys(each.over for _, found in sections for each in found if each.over)
    measured = [r for p, q in used if (r := of_length(first, p, q)) is not None]
    sections.insert(3, ("lengths", measured))
    return sections


def of_length(drawing: Drawing, p: str, q: str) -> Relation | None:
    """A length that is measured on the mechanism; None for one that the data tell."""
    links = (drawing.scene.frame, *drawing.scene.links.values())
    lengths = (each for link in links for how in link.placings for each in how.lengths())
    if {p, q} in ({start, end} for start, end, _ in lengths):
        return None
    mm = drawing.on_paper(length_of(drawing, p, q))
    return Relation(
        bar(p, q),
        "",
        f"{drawing.words.decimal(digits(drawing.scales.kL))}·{drawn(drawing, mm)}",
        answer(drawing, mm * drawing.scales.kL),
        "mm",
        drawing.words("calculation.measured"),
    )


def sections_of(drawing: Drawing) -> list[Section]:
    """The sections of one sheet."""
    plan = list(of_plan(drawing))
    turning = [relation for relation in of_turning(drawing) if relation not in plan]
    if drawing.kind == "velocity":
        return [
            ("velocities", plan),
            ("turning", turning),
            ("slides", list(of_slides(drawing))),
            ("centres", list(of_centres(drawing))),
        ]
    return [
        *of_components(drawing),
        ("accelerations", plan),
        ("spinning", turning),
        ("slides", list(of_slides(drawing))),
        ("poles", list(of_centres(drawing))),
    ]


def of_plan(drawing: Drawing) -> list[Relation]:
    """What a plan is drawn from, and what is read off it, each before it is used, and once."""
    found: list[Relation] = []
    if drawing.kind == "acceleration":
        for driver in drawing.scene.drivers:
            found += of_sum(drawing, driver)
    for rate, relation in of_equations(drawing):
        found += before_use(drawing, rate)
        found.append(relation)
    found += [*of_trials(drawing), *read_off(drawing), *of_contacts(drawing)]
    return list(dict.fromkeys(found))


def before_use(drawing: Drawing, rate: str) -> Iterator[Relation]:
    """How a rate is found by which a vector is computed, and what is read off for it."""
    for relation in of_turning(drawing):
        if relation.left == rate:
            if "*λ*" in relation.symbols:
                yield from of_trials(drawing)
            yield from before_use(drawing, relation.symbols)
            yield from (r for r in read_off(drawing) if relation.symbols.startswith(f"{r.left}/"))
            yield relation


def data_line(drawing: Drawing, *, solved: bool) -> Relation:
    """The data, as one relation that may be broken after each piece."""
    *pieces, last = given(drawing, solved=solved)
    first, *more = [f"{piece};" for piece in pieces] + [last]
    return Relation(first, more=tuple(more))


def read_off(drawing: Drawing) -> Iterator[Relation]:
    """Each vector that is read off the plan: scale factor times drawn length."""
    scale = scale_of(drawing, drawing.plane)
    k = f"*k*_{drawing.vector.letter}"
    unit = drawing.vector.caret_unit
    for _, step, value in drawing.steps(drawing.plane):
        vector = plan_vector(step)
        if vector is None or not isinstance(value, Vector) or is_laid_off(drawing, step):
            continue
        size = drawing.settled(abs(value.tip - value.tail))
        name = vector.symbol
        segment = segment_of(drawing, step)
        if not segment:
            segment = drawing.words("calculation.segment", name=symbol(name))
        length = drawn(drawing, drawn_in(drawing, drawing.plane, size))
        figures = f"{figure(drawing, scale / 1000)}·{length}"
        yield Relation(symbol(name), f"{k}·{segment}", figures, answer(drawing, size), unit)


def of_trials(drawing: Drawing) -> Iterator[Relation]:
    """What two trial plans lay off, and where between them the right one lies: what they miss
    grows in proportion."""
    yield from of_trial_lengths(drawing)
    for number, step, value in drawing.steps(Plane.NUMBERS):
        if step.action is None or step.action.key != "share" or step.part is not Part(drawing.kind):
            continue
        users = [user for user in drawing.children.get(number, ()) if is_point(drawing, user)]
        steps = drawing.trace.program.steps
        measured = step.by_hand in drawing.trace.values
        crossed = [user for user in users if measured and steps[user].by_hand in drawing.results]
        one, two = (symbol(steps[arg].name) for arg in steps[(crossed or users)[0]].args[:2])
        ratio = f"{one}{symbol(steps[(crossed or users)[0]].name)}/{one}{two}"
        others = [symbol(steps[user].name) for user in users if user not in crossed]
        fields = {"ratio": ratio, "list": drawing.words("list_mark").join(others)}
        result = answer(drawing, float(value))
        if crossed:
            figures = on_line(drawing, steps[crossed[0]])
            remark = drawing.words("calculation.divided-alike", **fields) if others else ""
            yield Relation("*λ*", ratio, figures, result, "", remark)
            continue
        gaps = misses(drawing, step)
        yield from of_gaps(drawing, step, gaps)
        first, second = figure(drawing, gaps[0].size), within(drawing, gaps[1].size)
        yield Relation(
            "*λ*",
            "{0}/({0} − {1})".format(*GAPS),
            f"{first}/({first} − {second})",
            result,
            "",
            drawing.words("calculation.divided", **fields),
        )


def on_line(drawing: Drawing, crossed: Step) -> str:
    """How far along the line of its trials a point was found, over how long that is, in mm."""
    one, two = crossed.args[:2]
    whole = drawn_between(drawing, one, two, drawing.plane)
    share = float(drawing.trace.values[crossed.args[2]])
    return f"{drawn(drawing, OnPaper(share * whole))}/{drawn(drawing, whole)}"


def is_point(drawing: Drawing, number: int) -> bool:
    """True for a step that finds a point of this sheet's plan."""
    return drawing.trace.program.steps[number].plane is drawing.plane


def of_gaps(
    drawing: Drawing, step: Step, gaps: tuple[Misclosure, Misclosure]
) -> Iterator[Relation]:
    """The gaps of two trials, read off the plan; of a driver less than what it gives."""
    turns = "d" in step.says and driver_of(drawing, step).kind == "turn"
    velocity = drawing.kind == "velocity"
    unit = ("rad/s" if turns else "m/s") + ("" if velocity else "^2")
    scale = scale_of(drawing, drawing.plane) / 1000
    for name, gap in zip(GAPS, gaps, strict=True):
        length = gap.found if "d" in step.says else gap.size
        mm = within(drawing, length / scale)
        figures = figure(drawing, length, FINE) if turns else f"{figure(drawing, scale)}·{mm}"
        less = f" − {within(drawing, gap.found - gap.size)}" if "d" in step.says else ""
        size = answer(drawing, gap.size)
        yield Relation(name, "", f"{figures}{less}", size, unit, gap.remark(drawing))


def drawn(drawing: Drawing, millimetres: OnPaper) -> str:
    """A drawn length, to a thousandth of a millimetre or five digits."""
    return figure(drawing, millimetres if millimetres < 10 else round(millimetres, 3))


def of_components(drawing: Drawing) -> list[Section]:
    """The components, in the order of the work within each section."""
    found: dict[str, list[Relation]] = {}
    for kind in COMPONENTS:
        for each in components_on(drawing):
            if isinstance(each, kind):
                section = found.setdefault(each.section(drawing.scales), [])
                section.append(each.relation(drawing))
    return list(found.items())


def of_centres(drawing: Drawing) -> Iterator[Relation]:
    """Where instantaneous centres and acceleration poles lie: in millimetres on paper from the
    first fixed pivot, as they are measured, and in the axes of the frame."""
    part = Part.CENTRE if drawing.kind == "velocity" else Part.POLE
    for _, step, value in drawing.mechanism_steps():
        if step.part is not part or not isinstance(value, Ratio) or not step.name:
            continue
        point = drawing.place(value)
        blank = blank_place(drawing)
        if point is None:
            everywhere = drawing.is_everywhere(value)
            key, equals = ("everywhere", "=") if everywhere else ("at_infinity", "")
            said = drawing.words(f"calculation.{key}")
            yield Relation(symbol(step.name), result=said, equals=equals, blank=blank)
        else:
            yield replace(of_place(drawing, symbol(step.name), point), blank=blank)


def blank_place(drawing: Drawing) -> tuple[str, str]:
    """Room for a place, and from where it is counted."""
    words, pivots = drawing.words, drawing.scene.frame.points
    pair = f"({ROOM}; {ROOM})"
    if not pivots:
        return f"{pair} {drawing.scene.units['length']}", f"({words('calculation.axes')})"
    return f"{pair} mm", f"({words('calculation.from_pivot', pivot=symbol(pivots[0]))})"


def of_place(drawing: Drawing, name: str, point: complex) -> Relation:
    """A place on paper from the first fixed pivot, and in the axes of the frame."""
    words, unit = drawing.words, drawing.scene.units["length"]
    x, y = (answer(drawing, drawing.length(part)) for part in (point.real, point.imag))
    pivots = drawing.scene.frame.points
    if not pivots:
        return Relation(name, result=f"({x}; {y})", unit=unit, remark=words("calculation.axes"))
    away = point - drawing.standing.spot(pivots[0])
    parts = (drawing.on_paper(part) for part in (away.real, away.imag))
    measured = "({}; {})".format(*(words.fixed(part, 2) for part in parts))
    remark = words("calculation.on_paper", pivot=symbol(pivots[0]), place=f"({x}; {y}) {unit}")
    return Relation(name, result=measured, unit="mm", remark=remark)
