"""Tries a lab on a thousand variants: how many are fair, what spoils the others, the spread."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import isnan

from msgspec import Struct

from graphkin.classroom.grading.neighbours import Neighbours, compared, pencil_faults, unsure_fields
from graphkin.classroom.lab.fairness import Fairness, Fault, judged
from graphkin.classroom.lab.items import asked_fields, items
from graphkin.classroom.lab.lab_model import (
    Fair,
    Lab,
    Range,
    Settings,
    ValueList,
    exact_text,
    outside,
    settings,
    sheets,
)
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants.assign import Assigned, assigned, held_against
from graphkin.construction.registry import LIMITED
from graphkin.drawing.richtext import plain
from graphkin.drawing.scale import ratio
from graphkin.numbers.arithmetic import np
from graphkin.text import Words, words
from graphkin.text.errors import Problem, SceneError, message
from graphkin.text.tables import CellTable, Row, labelled, listed, table

TRIED = 1000
"""The number of variants tried."""
CLASS = 60
"""The number of students in the class whose variants are compared with one another."""
PENCILLED = 300
"""The most fair variants on which the accuracy of a pencil is tried, where a lab limits it."""
SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)
"""The quantiles that describe a spread."""


class LabTrial(Struct, frozen=True):
    """The variants on which a lab was tried, their data, and how fair they are.

    ``names`` are numbers of students, or ids. ``unasked`` are fields of the rubric that no sheet
    draws; ``unmarked`` are fields that are asked and earn nothing.

    ``compared`` are the students of one class whose variants can be drawn, with the data that the
    class would get. ``neighbours`` compares these variants; ``unsure`` are the fields of each that
    hardly any drawing determines. ``coarse`` maps names to faults, for
    those of the first ``pencilled`` fair variants that a pencil draws less accurately than the lab
    allows. ``symbols`` are the markup of fields with their units.
    """

    lab: Lab
    names: tuple[str, ...]
    many: tuple[Settings, ...]
    fairness: Fairness
    unasked: tuple[str, ...] = ()
    unmarked: tuple[str, ...] = ()
    compared: tuple[Assigned, ...] = ()
    neighbours: Neighbours | None = None
    unsure: tuple[tuple[str, ...], ...] = ()
    pencilled: int = 0
    coarse: Mapping[str, Fault] = {}
    symbols: Mapping[str, str] = {}

    @property
    def unfair(self) -> int:
        """How many variants break a limit that needs no keys."""
        return int((~self.fairness.fair).sum())

    @property
    def spoiled_share(self) -> float:
        """The share of variants that break a limit, including the pencil's."""
        fair = 1 - self.unfair / len(self.many)
        return 1 - fair * (1 - len(self.coarse) / self.pencilled) if self.pencilled else 1 - fair

    @property
    def by_keys(self) -> list[tuple[str, Fault]]:
        """The students of the class who break a limit that needs keys, after repeated draws."""
        return [
            (each.student.id, fault)
            for each in self.compared
            for fault in each.faults
            if fault.limit in ("apart", "pencil")
        ]

    def faults(self) -> list[tuple[str, Sequence[Fault]]]:
        """Each variant with the limits that it breaks, including those that need keys."""
        key_faults = [(name, fault) for name, fault in self.by_keys if name not in self.coarse]
        every = [(name, self.fairness.faults(i)) for i, name in enumerate(self.names)]
        return [*every, *((name, (fault,)) for name, fault in (*self.coarse.items(), *key_faults))]

    @property
    def spoilt(self) -> bool:
        """Whether students would get unfair data.

        A formula must be fair to all; ranges are unfair where every draw is. In both cases, no
        field may be missing on the sheets, and no limit that needs keys may be broken.
        """
        by_formula = not self.lab.rule.is_drawn
        unfair = bool(self.unfair or self.coarse) if by_formula else self.unfair == len(self.many)
        return bool(self.unasked or self.by_keys) or unfair

    @property
    def different(self) -> int:
        """How many of the variants differ."""
        return len({tuple(sorted(given.items())) for given in self.many})


def tried(lab: Lab, count: int = TRIED) -> LabTrial:
    """A lab tried on the numbers from 1 that its scene allows, or on as many drawn variants.

    Raises SceneError where the formula gives no allowed data for number 1.
    """
    students = students_of(lab, count)
    every_sheet = [each for student in students for each in sheets(lab.rule, student)]
    names = tuple(each.id for each in every_sheet)
    many = tuple(settings(lab, each) for each in every_sheet)
    fairness = judged(lab, many)
    form = items(lab.mechanism, lab)
    drawn = {*fairness.lengths, *fairness.rays, *fairness.on_page}
    unasked = [item.field for item in form if item.what == "segment" and item.field not in drawn]
    unmarked = [name for name in asked_fields(lab.mechanism) if name not in lab.rubric.points]
    sound = bool(fairness.fits.any())
    every = assigned(lab, students[:CLASS])
    pencilled, coarse = drawn_coarsely(lab, names, many, fairness)
    drawn_at_all = [each for each in every if each.flattest is not None]
    standards = held_against(lab, drawn_at_all)
    return LabTrial(
        lab,
        names,
        many,
        fairness,
        tuple(unasked if sound else ()),
        tuple(unmarked),
        tuple(drawn_at_all),
        compared(standards),
        tuple(map(unsure_fields, standards)),
        pencilled,
        coarse,
        {item.field: f"{item.symbol}, {item.unit.replace('²', '^2')}" for item in form},
    )


def drawn_coarsely(
    lab: Lab, names: Sequence[str], many: Sequence[Settings], fairness: Fairness
) -> tuple[int, dict[str, Fault]]:
    """The number of fair variants tried with a pencil, and those drawn too inaccurately."""
    if lab.fair.pencil is None:
        return 0, {}
    which = [int(i) for i in fairness.fair.nonzero()[0][:PENCILLED]]
    found = pencil_faults(lab, [(many[i], fairness.computed(i)) for i in which])
    pairs = zip(which, found, strict=True)
    return len(which), {names[i]: fault for i, fault in pairs if fault is not None}


def students_of(lab: Lab, count: int) -> list[Student]:
    """At most ``count`` students for whom a rule has variants.

    They have ids, or numbers from 1 up to the last that the scene allows. Raises SceneError where
    the scene does not allow number 1.
    """
    if not lab.rule.counts:
        return [Student(i, f"{i:04d}") for i in range(1, count + 1)]
    found: list[Student] = []
    for number in range(1, count + 1):
        student = Student(number, str(number), number)
        try:
            problems = [
                problem
                for each in sheets(lab.rule, student)
                for problem in outside(lab.mechanism.scene.parameters, settings(lab, each))
            ]
        except SceneError as error:
            problems = list(error.problems)
        if problems and number == 1:
            place = "lab.toml: variants.set"
            raise SceneError(
                Problem(place, message("number 1 gives {found}", found=p.found), p.expected)
                for p in problems
            )
        if problems:
            break
        found.append(student)
    return found


def quantiles(values: Sequence[float]) -> list[float]:
    """The least, the quartiles and the most of the finite values; empty where there are none."""
    finite = np.asarray(values, dtype=float)
    finite = finite[np.isfinite(finite)]
    return [float(q) for q in np.quantile(finite, SHARES)] if len(finite) else []


# --- fairness in words: which limits are broken, by whom, and the spread --------------------------


SHOWN = 6
"""The most names listed for one limit."""
SCALES = 8
"""The most scales listed."""


def trial_lines(outcome: LabTrial) -> Iterator[str]:
    """The whole report on the trial of a lab."""
    lab, fairness = outcome.lab, outcome.fairness
    count = len(outcome.many)
    yield from labelled("rule", [rule_words(lab)])
    alike = f", {outcome.different} of them different" if outcome.different < count else ""
    tried = f"{count} drawn variants" if not lab.rule.counts else f"numbers 1 to {count}"
    yield from labelled("tried", [f"{tried}{alike}"])
    yield from labelled("limits", [limit_words(lab.fair)])
    good = [f"{count - outcome.unfair} of {count} variants"]
    if outcome.pencilled:
        exact = outcome.pencilled - len(outcome.coarse)
        good.append(
            f"a pencil draws {exact} of the first {outcome.pencilled} of these exactly enough"
        )
    yield from labelled("fair", good)
    who = "number" if lab.rule.counts else "id"
    english = words("en")
    yield from labelled("unfair", lines_of(broken_table(outcome, english)))
    if lab.rule.is_drawn:
        yield from labelled("again", [again_words(outcome)])
    computed = [(name, fairness.computed(i)) for i, name in enumerate(outcome.names)]
    yield from labelled("compute", list(fields_by_whom(computed, who)))
    yield from labelled("spread", lines_of(spread_table(spreads_of(outcome), english)))
    yield from labelled("scales", lines_of(scale_table(outcome, english)))
    compared = [each.student.id for each in outcome.compared]
    yield from labelled("apart", apart_lines(outcome.neighbours, compared, who))
    unsure = list(zip(compared, outcome.unsure, strict=True))
    yield from labelled("unsure", unsure_lines(lab, unsure, who))
    yield from labelled("marks", list(mark_lines(outcome)))


def again_words(outcome: LabTrial) -> str:
    """How many students keep unfair data after repeated draws: of a class, or by forecast."""
    rule, kept = outcome.lab.rule, len({name for name, _ in outcome.by_keys})
    left = 100 * outcome.spoiled_share**rule.tries
    tries = f"after {rule.tries} draws at most"
    if kept:
        count = len(outcome.compared)
        return f"{tries}, {count - kept} of a class of {count} have fair data"
    if left < 0.1:
        return f"{tries}, nearly all students have fair data"
    some = f"{float(f'{left:.2g}'):g}"
    return f"{tries}, about {some} of 100 students keep unfair data, the least unfair drawn"


def rule_words(lab: Lab) -> str:
    """The rule in words."""
    rule = lab.rule
    parts = [", ".join(f"{name} = {formula.text}" for name, formula in rule.settings.items())]
    draws = [f"{name} {draw_words(values)}" for name, values in rule.draws.items()]
    if (several := rule.positions) is not None and several.range is None:
        texts = ", ".join(formula.text for formula in several.formulas)
        parts.append(f"{several.parameter} = {texts}, one a sheet")
    elif several is not None and several.range is not None:
        draws.append(f"{several.count} values of {several.parameter} {draw_words(several.range)}")
    if draws:
        parts.append(f"{', '.join(draws)}, drawn for {rule.course}")
    return "; ".join(filter(None, parts))


def data_words(settings: Settings) -> str:
    """The data of a variant, such as ``phi = 44, n = 1/3``."""
    return ", ".join(f"{name} = {exact_text(value)}" for name, value in settings.items())


def draw_words(values: Range | ValueList) -> str:
    """The values that are drawn, in words: from 20 to 60 by 5, or 75."""
    if isinstance(values, ValueList):
        return ", or ".join(map(draw_words, values.parts))
    if len(values) == 1:
        return exact_text(values.least)
    ends = f"from {exact_text(values.least)} to {exact_text(values.most)}"
    return f"{ends} by {exact_text(values.step)}"


def limit_words(fair: Fair) -> str:
    """The limits of fairness in words."""
    low, high = fair.triangle
    more = ""
    if fair.apart is not None:
        more += f", another's right values earn at most {100 * fair.apart:g} %"
    if fair.pencil is not None:
        more += f", a pencil's error at most {100 * fair.pencil:g} % of any value"
    return (
        f"crossings at least {fair.crossing:g}°, segments at least {fair.segment:g} mm, "
        f"{LIMITED}s v/l from {low:g} to {high:g}{more}"
    )


def fields_by_whom(many: Iterable[tuple[str, Sequence[str]]], who: str) -> Iterator[str]:
    """A row for each field that is listed for some student or number, and for whom."""
    found: dict[str, list[str]] = {}
    for name, fields in many:
        for field in fields:
            found.setdefault(field, []).append(name)
    rows = [(field, str(len(names)), f"{who} {some(names)}") for field, names in found.items()]
    yield from table(("field", "times", "whose"), rows) if rows else ["none"]


def unsure_lines(lab: Lab, unsure: Sequence[tuple[str, Sequence[str]]], who: str) -> list[str]:
    """The fields that hardly any drawing can decide, with their students, known before the exam."""
    if not any(fields for _, fields in unsure):
        return ["none"]
    return [
        *fields_by_whom(unsure, who),
        f"a careful drawing is off there by more than {100 * lab.rubric.cap:g} % of the value;"
        " pencil in [fair] limits that",
    ]


def some(names: Sequence[str]) -> str:
    """The first ``SHOWN`` names."""
    return ", ".join(names[:SHOWN]) + (", …" if len(names) > SHOWN else "")


def mark_lines(outcome: LabTrial) -> Iterator[str]:
    """The total of the points, what earns none, and what no sheet draws."""
    points = outcome.lab.rubric.points
    total = exact_text(sum(points.values(), Fraction(0)))
    yield f"{total} points for {len(points)} fields"
    if outcome.unmarked:
        yield f"asked, and earns none: {listed(outcome.unmarked, 12)}"
    if outcome.unasked:
        yield f"earns marks, and is drawn on no sheet: {listed(outcome.unasked, 12)}"


# --- the tables of a trial, for the terminal and the studio ---------------------------------------


UNITS = {
    "crossing": (1, "°"),
    "segment": (1, " mm"),
    "triangle": (1, ""),
    "apart": (100, " %"),
    "pencil": (100, " %"),
}
"""The factor and unit in which the value of a limit is printed."""
Spreads = Mapping[str, tuple[str, Sequence[float]]]
"""The unit and the values of each quantity whose spread is shown, by the key of its words."""


def lines_of(table: CellTable) -> list[str]:
    """A table for a terminal; the line ``none`` if it has no rows."""
    return table.lines(plain) if table.rows else ["none"]


def apart_lines(neighbours: Neighbours | None, names: Sequence[str], who: str) -> list[str]:
    """The pairs of students of whom one's right values earn most on the other's sheet.

    ``names`` are numbers or ids; ``who`` says which.
    """
    if neighbours is None:
        return ["nothing to compare"]
    (own, other), *more = neighbours.closest()
    share = f"{100 * neighbours.exact[own, other]:.0f} %"
    closest = f"closest: {who} {names[other]}'s right values earn {share} on the sheet of"
    alike = [f"{names[j]}'s on that of {names[i]}" for i, j in more[:SHOWN]]
    if len(more) > SHOWN:
        alike.append(f"and of {len(more) - SHOWN} more pairs")
    likewise = f"; likewise {', '.join(alike)}" if alike else ""
    return [f"{closest} {names[own]}{likewise}"]


def fault_words(fault: Fault, words: Words, named: Callable[[str], str] = str) -> str:
    """A broken limit with its place, value and bound; ``named`` formats the name of the place."""
    what = f"{words(f'studio.limit_{fault.limit}')} {named(fault.where)}".strip()
    if isnan(fault.value):
        return what
    factor, unit = UNITS[fault.limit]
    side = "<" if fault.value < fault.bound else ">"
    value, bound = (words.decimal(f"{factor * each:.3g}") for each in (fault.value, fault.bound))
    return f"{what}: {value}{unit} {side} {bound}{unit}"


def broken_table(outcome: LabTrial, words: Words, named: Callable[[str], str] = str) -> CellTable:
    """Each broken limit with its worst value, its count, and the students concerned."""
    found: dict[tuple[str, str], list[tuple[str, Fault]]] = {}
    for name, faults in outcome.faults():
        for fault in faults:
            where = "" if fault.limit == "apart" else fault.where
            found.setdefault((fault.limit, where), []).append((name, fault))
    rows = []
    for broken in found.values():
        _, worst = max(broken, key=lambda one: abs(one[1].value - one[1].bound))
        said = fault_words(worst, words, named)
        rows.append(Row((said, str(len(broken)), some([name for name, _ in broken]))))
    heads = tuple(map(words, ("studio.limit_broken", "studio.times", "studio.whose")))
    return CellTable(heads, rows, words("studio.unfair"))


def spreads_of(outcome: LabTrial) -> Spreads:
    """What makes the sheets of a trial hard or alike."""
    fairness = outcome.fairness
    drawn = fairness.closes & fairness.fits
    flattest, rays = fairness.flattest[drawn], fairness.flattest_rays[drawn]
    return spreads(flattest, rays, fairness.shortest[drawn], outcome.neighbours)


def spreads(
    flattest: Sequence[float],
    rays: Sequence[float],
    shortest: Sequence[float],
    neighbours: Neighbours | None,
) -> Spreads:
    """What makes the sheets of a class hard, and, where they are compared, alike.

    Rays to centres and poles have a row of their own, since they cross flatter and spoil nothing
    else.
    """
    found: dict[str, tuple[str, Sequence[float]]] = {
        "studio.flattest": ("°", flattest),
        "studio.flattest_rays": ("°", rays),
        "studio.shortest": (" mm", shortest),
    }
    if neighbours is not None:
        found |= {
            "studio.key_earns": (" %", 100 * neighbours.exact.ravel()),
            "studio.drawing_earns": (" %", 100 * neighbours.drawn.ravel()),
            "studio.pencil_error": (" %", 100 * neighbours.pencil),
        }
    return found


def spread_table(found: Spreads, words: Words) -> CellTable:
    """Minimum, median and maximum of quantities that make sheets hard or alike."""
    rows = [
        Row((words(key), *(f"{words.fixed(each, 1)}{unit}" for each in parts[::2])))
        for key, (unit, values) in found.items()
        if (parts := quantiles(values))
    ]
    keys = ("studio.on_sheets", "studio.least", "studio.half", "studio.most")
    return CellTable(tuple(map(words, keys)), rows, words("studio.spread"))


def scale_table(outcome: LabTrial, words: Words) -> CellTable:
    """The scales of the sheets with their students, the most frequent first."""
    fairness = outcome.fairness
    found: dict[tuple[float, ...], list[str]] = {}
    columns = (fairness.kL, fairness.larger, fairness.larger_still)
    for i in (fairness.closes & fairness.fits).nonzero()[0]:
        own = tuple(float(column[i]) for column in columns)
        found.setdefault(own, []).append(outcome.names[i])
    many = sorted(found.items(), key=lambda each: -len(each[1]))
    rows = [
        Row((ratio(kL), f"{m:.4g}", f"{again:.4g}", str(len(names)), some(names)))
        for (kL, m, again), names in many[:SCALES]
    ]
    if len(many) > SCALES:
        rest = sum(len(names) for _, names in many[SCALES:])
        rows.append(Row(("…", "…", "…", str(rest), "…")))
    whose = tuple(map(words, ("studio.times", "studio.whose")))
    return CellTable((words("studio.scale"), "*m*", "*m′*", *whose), rows, words("studio.scales"))
