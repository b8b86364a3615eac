"""Looks at a class as a whole before it is marked: a mistake of the table is not the students'."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from graphkin.classroom.grading.graded import Graded
from graphkin.classroom.grading.keys import Keys, distinct, read_of
from graphkin.classroom.grading.standard import Expectation
from graphkin.numbers.arithmetic import np
from graphkin.text.errors import NO_WORDS, Problem, RosterError, message

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
REACH = 5
"""The most rows by which a table is thought to be shifted."""


def look_at_class(graded: Sequence[Graded], expected: Sequence[Expectation]) -> None:
    """Raise RosterError where rows or columns are shifted, or a column lost its decimal points."""
    present = [i for i, each in enumerate(graded) if each.present]
    if len(present) < FEW or not expected[0].tolerance:
        return
    own, mine = distinct(expected)
    keys = Keys.of(own)
    variants = np.array([mine[id(expected[i])] for i in present])
    answers = np.array([read_of(graded[i], keys)[0] for i in present])
    allowed = np.array([[each.tolerance[f].most for f in keys.fields] for each in own])
    read = ~np.isnan(answers)
    if not read.any():
        return
    columns(keys, answers, keys.sizes[variants], allowed[variants])
    tens(graded, present, keys, answers, keys.sizes[variants])
    if len(own) < 2:
        return
    apart = away(answers, keys.sizes[variants], allowed[variants])
    every = np.array([mine[id(each)] for each in expected])
    for by in sorted({*range(-REACH, REACH + 1)} - {0}, key=abs):
        at = np.array(present) + by
        rows = every[np.clip(at, 0, len(every) - 1)]
        inside = (at >= 0) & (at < len(every)) & (rows != variants)
        near = away(answers, keys.sizes[rows], allowed[rows])
        if ((near < apart / NEARER) & inside).mean() >= MOST:
            hint = message("mend the order of the rows, or the column of ids")
            raise RosterError(
                Problem(
                    "answers",
                    message("fit the data of other rows: they are shifted"),
                    NO_WORDS,
                    hint,
                )
            )


def away(answers: Any, sizes: Any, allowed: Any) -> Any:
    """The median distance of each student's answers from some sizes, in what is allowed."""
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
            hint = message("mend the heads of the columns")
            found = message("hold the answers of the column beside: the columns are shifted")
            raise RosterError(Problem("answers", found, NO_WORDS, hint))


def tens(
    graded: Sequence[Graded], present: Sequence[int], keys: Keys, answers: Any, sizes: Any
) -> None:
    """Raise RosterError where the answers of a column lack their decimal points."""
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
        told = ~np.isnan(answers[:, place])
        if not lost.any() or abs(np.median((powers - near)[lost, place])) > CENTRED:
            continue
        varied = len(set(near[lost, place])) > 1 or not any("." in t or "," in t for t in texts)
        most = told.sum() >= FEW and lost.sum() > MOST * told.sum() and varied
        if most and not others_whole(graded, present, keys, field):
            hint = message("export the column as text, or with a decimal point")
            found = message("the answers lack their decimal points")
            raise RosterError(Problem(f'column "{field}"', found, NO_WORDS, hint))


def others_whole(graded: Sequence[Graded], present: Sequence[int], keys: Keys, field: str) -> bool:
    """Whether another unit explains it: all columns with the unit of a field are so many whole."""
    item = keys.standards[0].item
    alike = [f for f in keys.fields if item[f].unit == item[field].unit and f != field]
    texts = [graded[i].mark(f).answer.text.strip() for i in present for f in alike]
    return bool(texts) and all(text.isdigit() for text in texts if text)
