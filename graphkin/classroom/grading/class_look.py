"""Looks at a class as a whole before it is marked: a mistake of the table is not the students'.

Rows or columns may be shifted or in another order. A column may have lost its decimal points, or be
in another unit. The answers may be those of another lab, or of sheets at other scales.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isclose
from typing import Any

from graphkin.classroom.grading.answer_numbers import UNITS
from graphkin.classroom.grading.graded import Graded, Status
from graphkin.classroom.grading.keys import Keys, distinct, read_of
from graphkin.classroom.grading.probes import plane_of
from graphkin.classroom.grading.standard import Expectation
from graphkin.construction.core.program import Plane
from graphkin.numbers.arithmetic import np
from graphkin.scene.quantity import LENGTHS
from graphkin.text.errors import NO_WORDS, Message, Problem, RosterError, message

FEW = 6
"""The fewest students that tell of a table."""
MOST = 0.6
"""The share of students, or of answers, from which a mistake is the table's."""
OWN = 0.4
"""The share of a column's answers below which it does not fit."""
NEARER = 2.5
"""How many times nearer a student's answers must be to another row's data."""
CENTRED = 0.008
"""How near a power of ten the middle of a column is that lost its points, as a logarithm."""
TENFOLD = 0.1
"""How near a power of ten an answer is that is off by it, as a logarithm."""
POWERS = (-4, -3, -2, -1, 1, 2, 3, 4)
"""The powers of ten by which a column may be off."""
REACH = 5
"""The most rows by which a table is thought to be shifted."""
SAMPLE = 60
"""The most students who are compared with the data of all."""
MIXED = 0.8
"""The share of students from which rows are in another order, or sheets have another scale."""
SCALED, ODD = 0.03, 0.07
"""How far factors of one scale differ, and how far a scale is from the right one, in log."""
DOUBLED = (2.0, 0.5)
"""The factors by which a class draws its plans larger or smaller of its own accord."""
PLANS = {
    Plane.VELOCITIES: message("the velocity plan"),
    Plane.ACCELERATIONS: message("the acceleration plan"),
}
LOST = 0.2
"""The share of right answers below which an unexplained sheet may be that of another lab."""


def look_at_class(graded: Sequence[Graded], expected: Sequence[Expectation]) -> None:
    """Raise RosterError where a mistake of the table, of the lab or of its scales explains most."""
    present = [i for i, each in enumerate(graded) if each.present]
    if len(present) < FEW or not expected[0].tolerance:
        return
    own, mine = distinct(expected)
    keys = Keys.of(own)
    every = np.array([mine[id(each)] for each in expected])
    variants = every[present]
    answers = np.array([read_of(graded[i], keys)[0] for i in present])
    allowed = np.array([[each.tolerance[f].most for f in keys.fields] for each in own])
    if np.isnan(answers).all():
        return
    columns(keys, answers, keys.sizes[variants], allowed[variants])
    in_other_units(keys, answers, keys.sizes[variants])
    tens(graded, present, keys, answers, keys.sizes[variants])
    single_units(keys, answers, keys.sizes[variants], allowed[variants])
    scales(keys, answers, keys.sizes[variants], allowed[variants])
    if len(own) > 1:
        apart = away(answers, keys.sizes[variants], allowed[variants])
        shifted_rows(keys.sizes, allowed, answers, (every, present), apart)
        mixed_rows(keys.sizes, allowed, answers, variants, apart)


def refused(found: Message, hint: Message, where: Message | str = "answers") -> RosterError:
    """The error that says what is wrong with the class, and what to do."""
    return RosterError(Problem(where, found, NO_WORDS, hint))


def shifted_rows(
    sizes: Any, allowed: Any, answers: Any, rows: tuple[Any, Sequence[int]], apart: Any
) -> None:
    """Raise RosterError where most answers fit the data of the row so many places away.

    ``rows`` are the variants of all students, and the places of those with answers.
    """
    every, present = rows
    for by in sorted({*range(-REACH, REACH + 1)} - {0}, key=abs):
        at = np.array(present) + by
        other = every[np.clip(at, 0, len(every) - 1)]
        inside = (at >= 0) & (at < len(every)) & (other != every[present])
        near = away(answers, sizes[other], allowed[other])
        if ((near < apart / NEARER) & inside).mean() >= MOST:
            raise refused(
                message("fit the data of other rows: they are shifted"),
                message("mend the order of the rows, or the column of ids"),
            )


def mixed_rows(sizes: Any, allowed: Any, answers: Any, variants: Any, apart: Any) -> None:
    """Raise RosterError where nearly everybody's answers fit the data of one other student each."""
    if len(set(variants.tolist())) < MIXED * len(variants):
        return
    some = range(0, len(variants), -(-len(variants) // SAMPLE))
    found = []
    for i in some:
        near = away(answers[i], sizes, allowed)
        best = int(near.argmin())
        if best != variants[i] and near[best] < min(1.0, apart[i] / NEARER):
            found.append(best)
    if len(found) >= MIXED * len(some) and len(set(found)) == len(found):
        raise refused(
            message("fit the data of other students: the rows are in another order"),
            message("mend the order of the rows, or the column of ids"),
        )


def scales(keys: Keys, answers: Any, sizes: Any, allowed: Any) -> None:
    """Raise RosterError where the lengths of a plan are off by one factor, but not its values."""
    with np.errstate(all="ignore"):
        logs = np.log(abs(answers / sizes))
    logs = np.where(np.isfinite(logs), logs, np.nan)
    for plan, called in PLANS.items():
        own = [keys.standards[0].item[field] for field in keys.fields]
        lengths = [i for i, e in enumerate(own) if e.what == "segment" and plane_of(e) is plan]
        values = [i for i, e in enumerate(own) if e.what == "value" and keys.beside[i] in lengths]
        if not values or (abs(answers - sizes) <= allowed)[:, values].mean() < MOST:
            continue
        known_logs = logs[:, lengths][~np.isnan(logs[:, lengths]).all(axis=1)]
        if len(known_logs) < FEW:
            continue
        each = np.nanmedian(known_logs, axis=1)
        factor = float(np.median(each))
        alike = (abs(each - factor) < SCALED).mean() >= MIXED
        by_class = min(abs(factor - np.log(ratio)) for ratio in DOUBLED) < SCALED
        if alike and abs(factor) > ODD and not by_class:
            raise refused(
                message(
                    "lengths of {plan} are {factor} times those of the sheets: another scale",
                    plan=called,
                    factor=f"{np.exp(factor):.3g}",
                ),
                message("mark with the lab, the course and the year whose sheets were handed out"),
            )


def look_for_another_lab(graded: Sequence[Graded]) -> None:
    """Raise RosterError where the answers of most students are wrong, and nothing explains them.

    Causes must have been looked for, and the data of others.
    """
    present = [each for each in graded if each.present]
    lost = 0
    for each in present:
        read = [m for m in each.marks if m.answer.is_read and m.item.what != "sense"]
        right = sum(mark.status is Status.RIGHT for mark in read)
        lost += len(read) > FEW and not each.causes and right < LOST * len(read)
    if len(present) >= FEW and lost >= MOST * len(present):
        raise refused(
            message("fit neither the students' data nor any known mistake: the lab is another"),
            message("mark with the lab, the course and the year whose sheets were handed out"),
        )


def away(answers: Any, sizes: Any, allowed: Any) -> Any:
    """The median distance of each student's answers from some sizes, in what is allowed.

    A single student may be compared with many rows of sizes.
    """
    with np.errstate(all="ignore"):
        far = np.where(np.isnan(answers), np.nan, abs(answers - sizes) / allowed)
    return np.nanmedian(np.where(np.isfinite(far), far, 1e9), axis=1)


def columns(keys: Keys, answers: Any, sizes: Any, allowed: Any) -> None:
    """Raise RosterError where most columns hold the answers of the next or last one."""
    right = (abs(answers - sizes) <= allowed).mean(axis=0)
    for by in (1, -1):
        other = np.roll(sizes, by, axis=1), np.roll(allowed, by, axis=1)
        near = (abs(answers - other[0]) <= other[1]).mean(axis=0)
        if ((near > MOST) & (right < OWN)).mean() > MOST:
            found = message("hold the answers of the column beside: the columns are shifted")
            raise refused(found, message("mend the heads of the columns"))


def in_other_units(keys: Keys, answers: Any, sizes: Any) -> None:
    """Raise RosterError where all columns of one unit are off by the same power of ten.

    These are the lengths in a plan, the strokes, or speeds and accelerations together. Most of
    their answers are off, and the middle one of each column: a few students have other slips.
    A single column counts only where nearly all of its answers are off.
    """
    groups: dict[tuple[str, bool], list[int]] = {}
    for place, field in enumerate(keys.fields):
        item = keys.standards[0].item[field]
        length, per, _ = item.unit.partition("/")
        if item.what in ("segment", "value") and length in LENGTHS:
            groups.setdefault((item.what, bool(per)), []).append(place)
    with np.errstate(all="ignore"):
        powers = np.log10(answers / abs(sizes))
        powers = np.where(np.isfinite(powers), powers, np.nan)
    problems = []
    for places in groups.values():
        group = powers[:, places]
        given = int((~np.isnan(group)).sum())
        middle = float(np.nanmedian(group)) if given >= FEW else 0.0
        power = round(middle)
        if not power or abs(middle - power) > CENTRED:
            continue
        share = MOST if places[1:] else MIXED
        middles = [np.nanmedian(each) for each in group.T if not np.isnan(each).all()]
        every = all(abs(each - power) < TENFOLD for each in middles)
        if every and (abs(group - power) < TENFOLD).sum() >= share * given:
            problems.append(of_unit(keys, places, 10.0**power))
    if problems:
        raise RosterError(problems)


def single_units(keys: Keys, answers: Any, sizes: Any, allowed: Any) -> None:
    """Raise RosterError where a few columns are off by a factor of another unit, and most right."""
    right = (abs(answers - sizes) <= allowed).sum(axis=0)
    given = (~np.isnan(answers)).sum(axis=0)
    with np.errstate(all="ignore"):
        powers = np.log10(answers / abs(sizes))
    problems = []
    for place, field in enumerate(keys.fields):
        item = keys.standards[0].item[field]
        if item.what == "place" or given[place] < FEW:
            continue
        column = powers[:, place]
        units = {item.one / size for size in UNITS.get(item.unit, {}).values()}
        for factor in sorted(units | {10.0**power for power in POWERS}):
            off = float(np.log10(factor))
            centred = abs(np.nanmedian(column) - off) <= CENTRED
            if centred and abs(off) > TENFOLD and is_off(column, off):
                problems.append(of_unit(keys, [place], factor))
    others = len(keys.fields) - len(problems)
    if problems and (right > MOST * given).sum() >= MOST * others:
        raise RosterError(problems)


def is_off(powers: Any, off: float) -> bool:
    """Whether nearly all answers of a column are off by one power of ten, or by a part of one."""
    near = (abs(powers - off) < TENFOLD).sum()
    return bool(near >= MIXED * max(1, np.isfinite(powers).sum()))


def of_unit(keys: Keys, places: Sequence[int], factor: float) -> Problem:
    """What is wrong with columns off by a factor, and what to do."""
    items = [keys.standards[0].item[keys.fields[place]] for place in places]
    size = f"{round(max(factor, 1 / factor), 2):g}"
    found = message(
        "the answers are {factor} times the values of the data: another unit",
        factor=size if factor > 1 else f"1/{size}",
    )
    first = items[0]
    sizes = UNITS.get(first.unit, {})
    unit = next((u for u, size in sizes.items() if isclose(size * factor, first.one)), "")
    hint = message("correct the columns, or mark them with --as-it-is")
    if unit:
        hint = message(
            'write the unit in the heads, such as "{head}", or mark with --as-it-is',
            head=f"{first.field} [{unit}]",
        )
    names = ", ".join(f'"{item.field}"' for item in items)
    where = message("columns {columns}", columns=names) if items[1:] else f"column {names}"
    return Problem(where, found, NO_WORDS, hint)


def tens(
    graded: Sequence[Graded], present: Sequence[int], keys: Keys, answers: Any, sizes: Any
) -> None:
    """Raise RosterError where the answers of a column lack their decimal points.

    They keep their last digits. Zeros at the end tell of a power of ten.
    """
    with np.errstate(all="ignore"):
        powers = np.log10(answers / abs(sizes))
        powers = np.where(np.isfinite(powers), powers, np.nan)
    near = np.round(powers)
    for place, field in enumerate(keys.fields):
        if keys.places[place]:
            continue
        texts = [graded[i].mark(field).answer.text for i in present]
        whole = np.array([text.strip().isdigit() for text in texts])
        lost = whole & (abs(powers[:, place] - near[:, place]) < 0.03) & (near[:, place] >= 1)
        given = ~np.isnan(answers[:, place])
        if not lost.any() or abs(np.median((powers - near)[lost, place])) > CENTRED:
            continue
        varied = len(set(near[lost, place])) > 1 or not any("." in t or "," in t for t in texts)
        most = given.sum() >= FEW and lost.sum() > MOST * given.sum() and varied
        zeros = np.mean([text.strip().endswith("0") for text in np.array(texts)[lost]])
        unit = others_whole(graded, present, keys, field) or in_smaller_unit(keys, near, field)
        if most and not unit and zeros < MIXED:
            hint = message("export the column as text, or with a decimal point")
            found = message("the answers lack their decimal points")
            raise refused(found, hint, f'column "{field}"')


def others_whole(graded: Sequence[Graded], present: Sequence[int], keys: Keys, field: str) -> bool:
    """Whether another unit explains it: all columns with the unit of a field are so many whole."""
    item = keys.standards[0].item
    alike = [f for f in keys.fields if item[f].unit == item[field].unit and f != field]
    texts = [graded[i].mark(f).answer.text.strip() for i in present for f in alike]
    return bool(texts) and all(text.isdigit() for text in texts if text)


def in_smaller_unit(keys: Keys, near: Any, field: str) -> bool:
    """Whether another unit explains it: all speeds and accelerations are in mm, or all in cm.

    ``near`` are the powers of ten by which answers are too large.
    """
    item = keys.standards[0].item
    if not item[field].unit.startswith("m/"):
        return False
    metric = [k for k, f in enumerate(keys.fields) if item[f].unit.startswith("m/")]
    powers = {float(np.nanmedian(near[:, k])) for k in metric if not np.isnan(near[:, k]).all()}
    return len(metric) > 1 and len(powers) == 1 and powers <= {2.0, 3.0}
