"""Describes the fairness of variants: which limits are broken, by whom, and the spread."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

from graphkin.classroom.grading.neighbours import Neighbours
from graphkin.classroom.lab.fairness import WORDS, Fairness, Fault
from graphkin.classroom.lab.lab_model import Fair, Lab, LabRule, Range, ValueList
from graphkin.classroom.lab.lab_trial import LabTrial, quantiles
from graphkin.classroom.lab.rules import Settings, exact_text
from graphkin.construction.registry import LIMITED
from graphkin.drawing.scale import ratio
from graphkin.text.plain_table import labelled, listed, table

SHOWN = 6
"""The most names listed for one limit."""
SCALES = 8
"""The most scales listed."""
SPREAD = ("", "least", "quarter", "half", "three quarters", "most")


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
    yield from labelled("unfair", list(broken_lines(outcome.faults(), who)))
    if lab.rule.draws:
        yield from labelled("again", [again_words(lab.rule, outcome.spoiled_share)])
    computed = [(name, fairness.computed(i)) for i, name in enumerate(outcome.names)]
    yield from labelled("compute", list(fields_by_whom(computed, who)))
    drawn = fairness.closes & fairness.fits
    spread = spread_lines(
        fairness.flattest[drawn], fairness.shortest[drawn], fairness.flattest_rays[drawn]
    )
    yield from labelled("spread", spread)
    yield from labelled("scales", scale_lines(fairness, outcome.names, who))
    compared = [each.student.id for each in outcome.compared]
    yield from labelled("apart", apart_lines(outcome.neighbours, compared, who))
    yield from labelled("pencil", pencil_lines(outcome.neighbours))
    yield from labelled("marks", list(mark_lines(outcome)))


def again_words(rule: LabRule, unfair: float) -> str:
    """A forecast of how many students keep unfair data after repeated draws."""
    left = 100 * unfair**rule.tries
    tries = f"after {rule.tries} draws at most"
    if left < 0.1:
        return f"{tries} nearly everybody has fair data"
    some = f"{float(f'{left:.2g}'):g}"
    return f"{tries} some {some} of 100 students keep unfair data, the least unfair drawn"


def rule_words(lab: Lab) -> str:
    """The rule in words."""
    rule = lab.rule
    formulas = ", ".join(f"{name} = {formula.text}" for name, formula in rule.settings.items())
    if not rule.draws:
        return formulas
    draws = ", ".join(f"{name} {draw_words(values)}" for name, values in rule.draws.items())
    return f"{f'{formulas}; ' if formulas else ''}{draws}, drawn for {rule.course}"


def data_words(settings: Settings) -> str:
    """The data of a variant, such as ``phi = 44, n = 1/3``."""
    return ", ".join(f"{name} = {exact_text(value)}" for name, value in settings.items())


def pencil_lines(neighbours: Neighbours | None) -> list[str]:
    """The spread of the error of a careful pencil in the least accurate field of each sheet."""
    if neighbours is None:
        return ["nothing to compare"]
    row = (f"{100 * value:.1f}" for value in quantiles(neighbours.pencil))
    return table(SPREAD, [("error of the least exact field, %", *row)])


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


def scale_lines(fairness: Fairness, names: Sequence[str], who: str) -> list[str]:
    """The scales of the sheets, and how many students have each, the most frequent first."""
    found: dict[tuple[float, float, float], list[str]] = {}
    columns = (fairness.kL, fairness.larger, fairness.larger_still)
    for i in (fairness.closes & fairness.fits).nonzero()[0]:
        own = float(columns[0][i]), float(columns[1][i]), float(columns[2][i])
        found.setdefault(own, []).append(names[i])
    if len(found) == 1:
        (each,) = found
        return [f"all: {' '.join(scale_words(each))}"]
    many = sorted(found.items(), key=lambda each: -len(each[1]))
    rows = [(*scale_words(each), str(len(own)), f"{who} {some(own)}") for each, own in many]
    lines = table(("mechanism", "velocities", "accelerations", "times", "whose"), rows[:SCALES])
    if len(many) > SCALES:
        rest = sum(len(own) for _, own in many[SCALES:])
        lines.append(f"and {rest} variants at {len(many) - SCALES} other scales")
    return lines


def scale_words(scales: tuple[float, float, float]) -> tuple[str, str, str]:
    """The scale of the mechanism, and the enlargements of both plans."""
    kL, m, again = scales
    return ratio(kL), f"m = {m:.4g}", f"m′ = {again:.4g}"


def apart_lines(neighbours: Neighbours | None, names: Sequence[str], who: str) -> list[str]:
    """What right values of one student earn on another's sheet: the spread, and the closest pairs.

    ``names`` are numbers or ids; ``who`` says which.
    """
    if neighbours is None:
        return ["nothing to compare"]
    rows = [
        (words, *(f"{100 * value:.0f}" for value in quantiles(shares.ravel())))
        for words, shares in (
            ("another's key earns, %", neighbours.exact),
            ("another's careful drawing, %", neighbours.drawn),
        )
    ]
    (own, other), *more = neighbours.closest()
    share = f"{100 * neighbours.exact[own, other]:.0f} %"
    closest = f"closest: {who} {names[other]}'s right values earn {share} on the sheet of"
    alike = [f"{names[j]}'s on that of {names[i]}" for i, j in more[:SHOWN]]
    if len(more) > SHOWN:
        alike.append(f"and of {len(more) - SHOWN} more pairs")
    likewise = f"; likewise {', '.join(alike)}" if alike else ""
    return [*table(SPREAD, rows), f"{closest} {names[own]}{likewise}"]


def broken_lines(named: Iterable[tuple[str, Sequence[Fault]]], who: str = "") -> Iterator[str]:
    """A row for each broken limit: where, how often, by whom, and the worst value."""
    found: dict[tuple[str, str], list[tuple[str, Fault]]] = {}
    for name, faults in named:
        for fault in faults:
            where = "" if fault.limit == "apart" else fault.where
            found.setdefault((fault.limit, where), []).append((name, fault))
    rows = []
    for (limit, where), broken in found.items():
        worst = max(broken, key=lambda one: abs(one[1].value - one[1].bound))
        names = [name for name, _ in broken]
        what = f"{limit} {where}".strip() if where else WORDS[limit]
        rows.append((what, str(len(names)), f"{who} {some(names)}".strip(), worst_words(worst)))
    yield from table(("limit", "times", "whose", "worst"), rows) if rows else ["none"]


def worst_words(worst: tuple[str, Fault]) -> str:
    """The value farthest from its bound, with the bound."""
    fault = worst[1]
    if fault.limit in ("apart", "pencil"):
        return f"{100 * fault.value:.0f} % against {100 * fault.bound:g} %"
    unit = {"crossing": "°", "segment": " mm", "triangle": ""}.get(fault.limit)
    return "" if unit is None else f"{fault.value:.3g}{unit} against {fault.bound:g}{unit}"


def fields_by_whom(many: Iterable[tuple[str, Sequence[str]]], who: str) -> Iterator[str]:
    """A row for each field that is listed for some student or number, and for whom."""
    found: dict[str, list[str]] = {}
    for name, fields in many:
        for field in fields:
            found.setdefault(field, []).append(name)
    rows = [(field, str(len(names)), f"{who} {some(names)}") for field, names in found.items()]
    yield from table(("field", "times", "whose"), rows) if rows else ["none"]


def some(names: Sequence[str]) -> str:
    """The first ``SHOWN`` names."""
    return ", ".join(names[:SHOWN]) + (", …" if len(names) > SHOWN else "")


def spread_lines(
    flattest: Sequence[float], shortest: Sequence[float], rays: Sequence[float]
) -> list[str]:
    """How much the difficulty differs from variant to variant.

    Rays to centres and poles have a row of their own, since they cross flatter and spoil nothing
    else.
    """
    rows = [
        (words, *(f"{value:.1f}" for value in found))
        for words, values in (
            ("flattest crossing, °", flattest),
            ("flattest rays to a centre or pole, °", rays),
            ("shortest segment, mm", shortest),
        )
        if (found := quantiles(values))
    ]
    return table(SPREAD, rows) if rows else ["nothing is drawn"]


def mark_lines(outcome: LabTrial) -> Iterator[str]:
    """The total of the points, what earns none, and what no sheet draws."""
    points = outcome.lab.rubric.points
    total = exact_text(sum(points.values(), Fraction(0)))
    yield f"{total} points for {len(points)} fields"
    if outcome.unmarked:
        yield f"asked, and earns none: {listed(outcome.unmarked, 12)}"
    if outcome.unasked:
        yield f"earns marks, and is drawn on no sheet: {listed(outcome.unasked, 12)}"
