"""The report on a class for its lecturer: points, difficulty, slips, evidence; one file."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Container, Iterable, Iterator, Sequence
from fractions import Fraction
from statistics import mean, median

from graphkin.classroom.grading.answer_numbers import beyond_number, shown_cell
from graphkin.classroom.grading.answers import Answers, Unread
from graphkin.classroom.grading.class_pictures import pictures, slip_counts
from graphkin.classroom.grading.feedback_rows import SLIPS, points_words
from graphkin.classroom.grading.feedback_rows import unread as unread_words
from graphkin.classroom.grading.graded import SURE, Decision, Graded, Result, Suspicion
from graphkin.classroom.roster.student import Student
from graphkin.classroom.roster.taker import Taker
from graphkin.text import Words
from graphkin.writers.templates import from_template

NAMED = 5
"""Students that are named of many with the same data."""


def class_report(
    result: Result,
    title: str,
    unread: Sequence[Unread],
    words: Words,
    refused: Sequence[str] = (),
) -> str:
    """The report as a page for a browser, its pictures within; ``refused`` are lines about what is
    not marked.
    """
    own = own_work(result)
    pngs = pictures(result.graded, words, "png", own)
    names = names_of(result)
    students = [each.taker.student for each in result.graded]
    page = from_template(
        "classroom/templates/class.html",
        words=words,
        title=title,
        summary=summary(result.graded, words),
        pictures={name: b64encode(png).decode("ascii") for name, png in pngs.items()},
        slips=[(words(SLIPS[name]), *counts) for name, *counts in slip_counts(own)],
        wrong_variants=list(wrong_variant_lines(result, words)),
        copies=[copies_words(each, names, words) for each in result.copies],
        held=held_line(result, words),
        decisions=list(decision_lines(result, words)),
        requests=list(request_lines(result, words)),
        unread=list(unread_lines(students, unread, words)),
        refused=refused,
        absent=[each.taker.student.called for each in result.graded if not each.is_marked],
        unsure=list(unsure_lines(result, words)),
    )
    return f"{page}\n"


def own_work(result: Result) -> list[Graded]:
    """Who handed in answers that fit no other's data: slips are counted among these."""
    others = {each.students[0] for each in result.wrong_variants}
    return [g for g in result.graded if g.present and g.taker.student.id not in others]


def summary(graded: Sequence[Graded], words: Words) -> str:
    """How many handed in, and how they did."""
    shares = [float(100 * g.share) for g in graded if g.share is not None]
    amounts = {
        name: words.fixed(found(shares), 1) if shares else "–"
        for name, found in (("mean", mean), ("median", median))
    }
    present = sum(each.present for each in graded)
    text = words("class.summary", present=present, all=len(graded), **amounts)
    waiting = sum(bool(each.pending) for each in graded)
    return f"{text}; {words('class.pending', count=waiting)}" if waiting else text


def names_of(result: Result) -> dict[str, str]:
    """What each student is called, by id."""
    return {each.taker.student.id: each.taker.student.called for each in result.graded}


def wrong_variant_lines(result: Result, words: Words) -> Iterator[str]:
    """Each wrong variant, with the points that the row earned and what of them a person decides."""
    graded, names = {each.taker.student.id: each for each in result.graded}, names_of(result)
    for found in result.wrong_variants:
        each = graded[found.students[0]]
        text = wrong_variant_words(found, names, words)
        amounts = (each.earned, each.decided, each.spared)
        earned, points, spared = (points_words(amount, words) for amount in amounts)
        key = "class.held" if each.held else "class.stays"
        key = "class.ruled" if any(not own.is_open for own in each.decisions) else key
        text += f"; {words(key, earned=earned, points=points)}"
        yield f"{text}, {words('class.spared', spared=spared)}" if each.spared else text


def held_line(result: Result, words: Words) -> str:
    """Whose marks are held, and how that is decided; empty where nobody's are."""
    held = [each.taker.student.called for each in result.graded if each.held]
    return words("class.held_row", who=words("list_mark").join(held)) if held else ""


def decision_lines(result: Result, words: Words) -> Iterator[str]:
    """What the lecturer decided: whose, of which field, from and to how many points, why."""
    for graded, each in decisions_of(result, is_open=False):
        amounts = {
            "before": "–" if each.before is None else points_words(each.before, words),
            "after": points_words(each.before or Fraction(), words),
        }
        key = "class.stands_row"
        if each.points is not None:
            key, amounts["after"] = "class.decided_row", points_words(each.points, words)
        field = each.field or words("class.whole")
        yield words(
            key, who=graded.taker.student.called, field=field, reason=each.reason, **amounts
        )


def request_lines(result: Result, words: Words) -> Iterator[str]:
    """What was asked and is not decided yet."""
    for graded, each in decisions_of(result, is_open=True):
        field = each.field or words("class.whole")
        yield words(
            "class.request_row", who=graded.taker.student.called, field=field, reason=each.reason
        )


def decisions_of(result: Result, *, is_open: bool) -> Iterator[tuple[Graded, Decision]]:
    """The lecturer's decisions, or the requests that are open, with the student of each."""
    for graded in result.graded:
        for each in graded.decisions:
            if each.is_open == is_open:
                yield graded, each


def wrong_variant_words(found: Suspicion, names: dict[str, str], words: Words) -> str:
    """A wrong variant in a sentence."""
    who, *others = found.students
    return words(
        "class.wrong_variant_row",
        who=names[who],
        count=len(found.fields),
        all=found.of,
        other=some([names[each] for each in others], words),
        odds=odds_words(found.odds, words),
    )


def copies_words(found: Suspicion, names: dict[str, str], words: Words) -> str:
    """A copied set in a sentence."""
    return words(
        "class.copies_row",
        who=some([names[each] for each in found.students], words),
        fields=", ".join(found.fields),
        odds=odds_words(found.odds, words),
    )


def some(names: Sequence[str], words: Words) -> str:
    """Some names, and how many more."""
    more = len(names) - NAMED
    rest = words("class.more", count=more) if more > 0 else ""
    return words("list_mark").join(names[:NAMED]) + rest


def odds_words(odds: float, words: Words) -> str:
    """Odds with the one digit that they are worth, and no surer than they can be."""
    if odds >= SURE:
        return words("class.at_least", odds=f"{SURE:.0f}")
    return words.significant(odds, 1)


def unread_lines(
    students: Iterable[Student], unread: Iterable[Unread], words: Words
) -> Iterator[str]:
    """The cells that cannot be read, each in a sentence."""
    names = {student.id: student.called for student in students}
    for cell in unread:
        yield words(
            "unread.row",
            file=cell.file,
            row=cell.row,
            who=names.get(cell.who, cell.who),
            field=cell.field,
            text=shown_cell(cell.text.strip()),
            why=unread_words(cell.problem, cell.unit, words, shown_cell(beyond_number(cell.text))),
        )


def open_cells(result: Result, unread: Iterable[Unread]) -> list[Unread]:
    """The cells that cannot be read whose points nobody has decided."""
    waiting = {
        (graded.taker.student.id, mark.item.field)
        for graded in result.graded
        for mark in graded.marks
        if mark.waits and (graded.pending or not mark.points)
    }
    return [cell for cell in unread if (cell.who, cell.field) in waiting]


def stranger_lines(given: Answers, earning: Container[str], words: Words) -> Iterator[str]:
    """Columns that are no fields, and fields ``earning`` points that have no column."""
    for each in given.strangers:
        near = f"; {words('class.meant', field=each.near)}" if each.near else ""
        yield words("class.stranger", file=each.file, name=each.name) + near
    missing = [name for name in given.missing if name in earning]
    if missing:
        yield words("class.unanswered", fields=", ".join(missing))


def language_lines(takers: Iterable[Taker], words: Words) -> Iterator[str]:
    """Students for whom the class list names a language that is none of the pages'."""
    for taker in takers:
        if taker.language and taker.spoken is None:
            yield words(
                "class.no_language", who=taker.student.called, text=shown_cell(taker.language)
            )


def unsure_lines(result: Result, words: Words) -> Iterator[str]:
    """The fields of each student that hardly a drawing tells."""
    names = names_of(result)
    for who, fields in result.unsure.items():
        yield words("class.unsure_row", who=names[who], fields=", ".join(fields))


def result_lines(result: Result, words: Words) -> Iterator[str]:
    """What a terminal shows: how the class did, and evidence."""
    yield summary(result.graded, words)
    names = names_of(result)
    yield from wrong_variant_lines(result, words)
    for each in result.copies:
        yield copies_words(each, names, words)
    held = held_line(result, words)
    if held:
        yield held
    counts = [len(list(decisions_of(result, is_open=is_open))) for is_open in (False, True)]
    if any(counts):
        yield words("class.decided", count=counts[0], open=counts[1])
