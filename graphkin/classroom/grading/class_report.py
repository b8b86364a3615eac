"""The report on a class for the lecturer: points, difficulty, causes and evidence in one file."""

from __future__ import annotations

from base64 import b64encode
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Sequence
from fractions import Fraction
from statistics import mean, median
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from graphkin.classroom.grading.answer_numbers import beyond_number, rounding, shown_cell
from graphkin.classroom.grading.answers import Answers, Unread
from graphkin.classroom.grading.feedback import cause_sentence, points_words
from graphkin.classroom.grading.feedback import unread as unread_words
from graphkin.classroom.grading.graded import (
    SURE,
    Decision,
    EarnedCause,
    EarnedMark,
    Graded,
    Result,
    Status,
    Suspicion,
)
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.roster.students import Counted, Student, Taker, counted
from graphkin.drawing.richtext import pieces, plain
from graphkin.text import LANGUAGES, Words
from graphkin.writers.plot_style import INK, figure_file, look, new_figure
from graphkin.writers.templates import from_template

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FILLS = {
    Status.RIGHT: ("class.right", "#2b8a5b", ""),
    Status.FOLLOWS: ("class.follows", "#9bc8ae", ""),
    Status.CAUSE: ("class.cause", "#e0b04c", "//"),
    Status.WRONG: ("class.wrong", "#c8501e", ""),
    Status.UNREADABLE: ("class.unreadable", "#8a4fa3", "xx"),
    Status.BLANK: ("class.blank", "#dfe5ea", ""),
}
"""The words, colour and hatching of each status; distinguishable in grey too."""
WIDTH = 7.2
BARS = 10
"""The number of classes of points, in percent."""
FEW, EVERYBODY = 6, 0.8
"""The fewest students of whom a cause may be everybody's, and the share that shares it."""
MOST = 12
"""The most causes shown."""
ACROSS = 92
"""The most characters in a line of a cause's sentence above its bar."""
BAR, LINE, APART, INCH = 0.5, 0.55, 0.4, 0.27
"""The heights of a bar, of a line of text and of the gap below a bar; inches per unit of height."""


def pictures(
    graded: Sequence[Graded], words: Words, kind: str, own: Sequence[Graded] | None = None
) -> dict[str, bytes]:
    """Each picture by its name, as SVG or PNG; the same marks give the same bytes.

    ``own`` are the students among whom causes are counted; by default all who are present.
    """
    present = [each for each in graded if each.present]
    found: dict[str, bytes] = {}
    with look():
        if present:
            found["difficulty"] = figure_file(difficulty(present, words), kind)
            found["distribution"] = figure_file(distribution(present, words), kind)
        among = present if own is None else own
        if cause_counts(among):
            found["causes"] = figure_file(frequent(among, words), kind)
    return found


def figure(height: float) -> tuple[Figure, Any]:
    """A figure with one set of axes."""
    drawn = new_figure(WIDTH, height)
    return drawn, drawn.add_subplot()


def difficulty(graded: Sequence[Graded], words: Words) -> Figure:
    """Draw the share of answers to each field that are right, followed, caused, wrong or blank."""
    found: dict[str, list[EarnedMark]] = {}
    for each in graded:
        for mark in worth(each):
            found.setdefault(mark.item.field, []).append(mark)
    columns = list(found.values())
    drawn, ax = figure(1.1 + 0.26 * len(columns))
    left = [0.0] * len(columns)
    for status, (key, colour, hatch) in FILLS.items():
        parts = [100 * sum(shown(m) is status for m in column) / len(column) for column in columns]
        if any(parts):
            ax.barh(
                range(len(columns)),
                parts,
                left=left,
                height=0.72,
                color=colour,
                hatch=hatch,
                edgecolor="white",
                linewidth=0.6,
                label=words(key),
            )
        left = [a + b for a, b in zip(left, parts, strict=True)]
    ax.set_yticks(range(len(columns)), [called(column[0].item, words) for column in columns])
    ax.invert_yaxis()
    ax.set_xlim(0, 100)
    ax.set_xlabel(words("class.share_axis"))
    ax.grid(axis="y", visible=False)
    drawn.legend(loc="outside upper center", ncols=3)
    return drawn


def shown(mark: EarnedMark) -> Status:
    """The status of an answer in a picture: wrong where a named mistake earns it nothing."""
    lost = mark.status is Status.CAUSE and not mark.earned and mark.points
    return Status.WRONG if lost else mark.status


def called(item: Item, words: Words) -> str:
    """A field's symbol and unit; for a sense, the word for it."""
    unit = words("table.sense") if item.what == "sense" else words.spelled(item.unit)
    return f"{mathtext(item.symbol)}, {unit}"


def mathtext(markup: str) -> str:
    """Markup as matplotlib's mathtext."""
    parts = []
    for piece in pieces(markup):
        text = "".join(f"\\{sign}" if sign in "_$%#&{}^" else sign for sign in piece.text)
        text = f"\\mathit{{{text}}}" if piece.italic else f"\\mathrm{{{text}}}"
        parts.append({0: text, 1: f"^{{{text}}}", -1: f"_{{{text}}}"}[piece.level])
    return f"${''.join(parts)}$"


def worth(graded: Graded) -> list[EarnedMark]:
    """The marks of the fields that earn points."""
    return [mark for mark in graded.marks if mark.points]


def distribution(graded: Sequence[Graded], words: Words) -> Figure:
    """Draw how many students reached how many points, in percent."""
    shares = [float(100 * each.share) for each in graded if each.share is not None]
    drawn, ax = figure(2.6)
    edges = [i * 100 / BARS for i in range(BARS + 1)]
    ax.hist(shares, bins=edges, color="#1f5fa8", edgecolor="white", linewidth=0.8)
    ax.set_xlim(0, 100)
    ax.set_xticks(edges)
    ax.yaxis.get_major_locator().set_params(integer=True)
    ax.set_xlabel(words("class.percent_axis"))
    ax.set_ylabel(words(f"class.{counted_in(graded)}"))
    ax.grid(axis="x", visible=False)
    return drawn


def cause_counts(graded: Sequence[Graded]) -> list[tuple[EarnedCause, int, int]]:
    """Each cause with the answers and the students it explains, the most frequent first."""
    answers: Counter[tuple[str, str]] = Counter()
    students: Counter[tuple[str, str]] = Counter()
    known: dict[tuple[str, str], EarnedCause] = {}
    for each in graded:
        explained = sum(mark.status is Status.CAUSE for mark in worth(each))
        for cause in each.causes:
            name = cause.name, cause.either
            answers[name] += explained
            students[name] += 1
            known.setdefault(name, cause)
    order = sorted(students, key=lambda name: (-students[name], -answers[name], name))
    return [(known[name], answers[name], students[name]) for name in order]


def frequent(graded: Sequence[Graded], words: Words) -> Figure:
    """Draw how many students made each mistake."""
    counts = cause_counts(graded)[:MOST]
    texts = [wrap(plain(cause_sentence(cause, words)), ACROSS) for cause, _, _ in counts]
    places, height = stacked([len(lines) for lines in texts])
    drawn, ax = figure(0.7 + INCH * height)
    ax.barh(places, [c[2] for c in counts], height=BAR, color="#e0b04c")
    for y, lines, (_, _, students) in zip(places, texts, counts, strict=True):
        ax.annotate(
            "\n".join(lines),
            (0, y - 0.6 * BAR),
            xytext=(3, 0),
            textcoords="offset points",
            fontsize=7.5,
            va="bottom",
            color=INK,
        )
        ax.text(students, y, f" {students}", va="center", fontsize=8)
    ax.set_yticks([])
    ax.spines["left"].set_visible(False)
    ax.set_ylim(height, 0)
    ax.set_xlim(0, max(c[2] for c in counts) * 1.08)
    ax.xaxis.get_major_locator().set_params(integer=True)
    ax.set_xlabel(words(f"class.{counted_in(graded)}"))
    ax.grid(axis="y", visible=False)
    return drawn


def stacked(lines: Sequence[int]) -> tuple[list[float], float]:
    """The middle of each bar below its lines of text, from the top, and the total height."""
    places: list[float] = []
    y = 0.0
    for count in lines:
        y += count * LINE + BAR
        places.append(y - BAR / 2 + 0.1)
        y += APART
    return places, y


# --- the HTML report ----------------------------------------------------------------------------


NAMED = 5
"""The most students named where many have the same data."""


def class_report(
    result: Result,
    title: str,
    unread: Sequence[Unread],
    words: Words,
    refused: Sequence[str] = (),
) -> str:
    """The report as an HTML page with its pictures embedded.

    ``refused`` are lines about what is not marked.
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
        counted=words(f"class.{counted_in(own)}"),
        causes=[(cause_sentence(each, words), *counts) for each, *counts in cause_counts(own)],
        wrong_variants=list(wrong_variant_lines(result, words)),
        copies=[copies_words(each, names, words) for each in result.copies],
        everybody=list(everybody_lines(result, words)),
        others=list(another_lines(result, words)),
        computed=list(computed_lines(result, words)),
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
    """The students who handed in answers that fit no other student's data.

    Causes are counted among these.
    """
    others = {each.students[0] for each in result.wrong_variants}
    return [g for g in result.graded if g.present and g.taker.student.id not in others]


def counted_in(graded: Iterable[Graded]) -> Counted:
    """The name of what is counted: students, or their sheets."""
    return counted(each.taker.student for each in graded)


def summary(graded: Sequence[Graded], words: Words) -> str:
    """How many students handed in answers, or how many sheets; their mean and median."""
    shares = [float(100 * g.share) for g in graded if g.share is not None]
    amounts = {
        name: words.fixed(found(shares), 1) if shares else "–"
        for name, found in (("mean", mean), ("median", median))
    }
    present = sum(each.present for each in graded)
    key = "class.summary_sheets" if counted_in(graded) == "sheets" else "class.summary"
    text = words(key, present=present, all=len(graded), **amounts)
    waiting = sum(bool(each.pending) for each in graded)
    return words.clauses((text, words("class.pending", count=waiting))) if waiting else text


def names_of(result: Result) -> dict[str, str]:
    """The name of each student, by id."""
    return {each.taker.student.id: each.taker.student.called for each in result.graded}


def wrong_variant_lines(result: Result, words: Words) -> Iterator[str]:
    """A sentence for each wrong variant, with the points earned and those to decide."""
    graded, names = {each.taker.student.id: each for each in result.graded}, names_of(result)
    for found in result.wrong_variants:
        each = graded[found.students[0]]
        text = wrong_variant_words(found, names, words)
        amounts = (each.earned, each.decided, each.spared)
        earned, points, spared = (points_words(amount, words) for amount in amounts)
        key = "class.held" if each.held else "class.stays"
        key = "class.ruled" if any(not own.is_open for own in each.decisions) else key
        text = words.clauses((text, words(key, earned=earned, points=points)))
        yield f"{text}, {words('class.spared', spared=spared)}" if each.spared else text


def another_lines(result: Result, words: Words) -> Iterator[str]:
    """A sentence for each sheet drawn from other data than the student's own."""
    names = names_of(result)
    for each in result.graded:
        for cause in each.causes:
            if cause.whose:
                other = some([names.get(who, who) for who in cause.whose], words)
                cost = points_words(cause.cost, words)
                yield words(
                    "class.another_row", who=each.taker.student.called, other=other, cost=cost
                )


def everybody_lines(result: Result, words: Words) -> Iterator[str]:
    """A sentence for each cause that nearly the whole class shares: it may not be the students'."""
    present = [each for each in result.graded if each.present]
    counts = Counter(name for each in present for name in {c.name for c in each.causes})
    for name, count in counts.items():
        if len(present) >= FEW and count >= EVERYBODY * len(present):
            yield words(
                "class.everybody_row",
                cause=name,
                count=count,
                all=len(present),
                whom=words(f"class.{counted_in(present)}"),
            )


def computed_lines(result: Result, words: Words) -> Iterator[str]:
    """A sentence for each student whose lengths are exact: they were computed, not drawn."""
    for each in result.graded:
        sizes = [m for m in each.marks if m.item.what in ("segment", "value") and m.answer.is_read]
        exact = [m for m in sizes if m.expected and is_exact(m)]
        if len(sizes) > 2 and len(exact) > 0.7 * len(sizes):
            counts = {"count": len(exact), "all": len(sizes)}
            yield words("class.computed_row", who=each.taker.student.called, **counts)


def is_exact(mark: EarnedMark) -> bool:
    """Whether an answer of four digits or more agrees with the key to the last digit."""
    digits = sum(sign.isdigit() for sign in mark.answer.text.strip("0.,"))
    rounded = rounding(mark.answer) * abs(mark.expected)
    return digits >= 4 and abs(mark.off or 0.0) <= 1.01 * max(rounded, 1e-9)


def held_line(result: Result, words: Words) -> str:
    """Whose marks are held, and how to decide; empty where none are."""
    held = [each.taker.student.called for each in result.graded if each.held]
    return words("class.held_row", who=words("list_mark").join(held)) if held else ""


def decision_lines(result: Result, words: Words) -> Iterator[str]:
    """A sentence for each decision: student, field, points before and after, reason."""
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
            key, who=graded.taker.student.called, field=field, reason=each.reason or "–", **amounts
        )


def request_lines(result: Result, words: Words) -> Iterator[str]:
    """A sentence for each request that is not decided yet."""
    for graded, each in decisions_of(result, is_open=True):
        field = each.field or words("class.whole")
        asked = each.reason if each.is_open else each.asked
        yield words("class.request_row", who=graded.taker.student.called, field=field, reason=asked)


def decisions_of(result: Result, *, is_open: bool) -> Iterator[tuple[Graded, Decision]]:
    """The lecturer's decisions, or those with an open request, each with its student."""
    for graded in result.graded:
        for each in graded.decisions:
            if (each.is_open or bool(each.asked)) if is_open else not each.is_open:
                yield graded, each


def wrong_variant_words(found: Suspicion, names: dict[str, str], words: Words) -> str:
    """A sentence about a student whose answers fit the data of others."""
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
    """A sentence about students who handed in the same digits."""
    return words(
        "class.copies_row",
        who=some([names[each] for each in found.students], words),
        fields=", ".join(found.fields),
        odds=odds_words(found.odds, words),
    )


def some(names: Sequence[str], words: Words) -> str:
    """The first ``NAMED`` names, and how many more there are."""
    more = len(names) - NAMED
    rest = words("class.more", count=more) if more > 0 else ""
    return words("list_mark").join(names[:NAMED]) + rest


def odds_words(odds: float, words: Words) -> str:
    """Odds to one significant digit, at most ``SURE``."""
    if odds >= SURE:
        return words("class.at_least", odds=f"{SURE:.0f}")
    return words.significant(odds, 1)


def unread_lines(
    students: Iterable[Student], unread: Iterable[Unread], words: Words
) -> Iterator[str]:
    """A sentence for each cell that cannot be read."""
    names = {student.id: student.called for student in students}
    for cell in unread:
        yield words(
            "unread.row",
            file=cell.file,
            row=cell.row,
            who=names.get(cell.who, cell.who),
            field=cell.field,
            text=shown_cell(cell.text.strip()),
            why=unread_words(
                cell.problem, words.spelled(cell.unit), words, shown_cell(beyond_number(cell.text))
            ),
        )


def open_cells(result: Result, unread: Iterable[Unread]) -> list[Unread]:
    """The cells that cannot be read and whose points are not decided."""
    waiting = {
        (graded.taker.student.id, mark.item.field)
        for graded in result.graded
        for mark in graded.marks
        if mark.waits and (graded.pending or not mark.points)
    }
    return [cell for cell in unread if (cell.who, cell.field) in waiting]


def stranger_lines(given: Answers, earning: Container[str], words: Words) -> Iterator[str]:
    """A sentence for each column that is no field, and for missing fields that earn points."""
    for each in given.strangers:
        near = [words("class.meant", field=each.near)] if each.near else []
        yield words.clauses([words("class.stranger", file=each.file, name=each.name), *near])
    missing = [name for name in given.missing if name in earning]
    if missing:
        yield words("class.unanswered", fields=", ".join(missing))


def language_lines(takers: Iterable[Taker], words: Words) -> Iterator[str]:
    """A sentence for each student whose language in the class list has no pages."""
    for taker in takers:
        if taker.language and taker.spoken is None:
            yield words(
                "class.no_language",
                who=taker.student.called,
                text=shown_cell(taker.language),
                list=", ".join(LANGUAGES),
            )


def unsure_lines(result: Result, words: Words) -> Iterator[str]:
    """A sentence for each student with fields that hardly any drawing determines."""
    names = names_of(result)
    for who, fields in result.unsure.items():
        yield words("class.unsure_row", who=names[who], fields=", ".join(fields))


def result_lines(result: Result, words: Words) -> Iterator[str]:
    """The lines for the terminal: how the class did, and the evidence."""
    yield summary(result.graded, words)
    yield from everybody_lines(result, words)
    names = names_of(result)
    yield from wrong_variant_lines(result, words)
    for each in result.copies:
        yield copies_words(each, names, words)
    yield from another_lines(result, words)
    held = held_line(result, words)
    if held:
        yield held
    counts = [len(list(decisions_of(result, is_open=is_open))) for is_open in (False, True)]
    answers = [mark.answer for each in result.graded for mark in each.marks]
    counts[0] += sum(bool(answer.written) or answer.typed for answer in answers)
    if any(counts):
        yield words("class.decided", count=counts[0], open=counts[1])
