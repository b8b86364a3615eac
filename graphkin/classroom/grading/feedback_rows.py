"""What a student is told of each field, as markup: the answer, what was expected, how far, why."""

from __future__ import annotations

from fractions import Fraction
from math import isnan

from msgspec import Struct

from graphkin.classroom.grading.answer_numbers import beyond_number, shown_cell
from graphkin.classroom.grading.graded import (
    THOUSANDS,
    WITHHELD,
    Decision,
    EarnedMark,
    Graded,
    Status,
)
from graphkin.classroom.lab.slip_names import NAMES
from graphkin.construction.core.quantities import TURNING
from graphkin.drawing.glyphs import advance
from graphkin.drawing.symbol_markup import escape
from graphkin.text import Words
from graphkin.text.errors import PageError

COLUMNS = ("quantity", "yours", "expected", "allowed", "off", "earned")
HEADS = {
    "quantity": "feedback.quantity",
    "yours": "feedback.yours",
    "expected": "feedback.expected",
    "allowed": "feedback.allowed",
    "off": "feedback.off",
    "earned": "feedback.earned",
}
SLIPS = {name: f"feedback.slip_{name}" for name in NAMES}
"""The sentence of each slip."""
SENSES = {
    (True, True): "feedback.anticlockwise",
    (True, False): "feedback.clockwise",
    (False, True): "feedback.forward",
    (False, False): "feedback.backward",
}
"""The words for a sense: of a turning or along a guide, positive or not."""
PLAIN = {
    Status.RIGHT: "feedback.right",
    Status.BLANK: "feedback.blank",
}
UNREAD = {
    "open": "unread.open",
    "number": "unread.number",
    "unit": "unread.unit",
    "large": "unread.large",
    "turning": "unread.turning",
    "sliding": "unread.sliding",
    THOUSANDS: "unread.thousands",
    WITHHELD: "unread.withheld",
}
"""The sentence for each reason why a cell cannot be read."""
REVERSED = "sense_reversed"
UNTOLD = "…"
"""What stands for an expected value that is kept back."""
NEGLIGIBLE = 0.01
"""Part of what is allowed below which an answer is off by nothing."""
MANIFOLD = 2.0
"""From so many times on an answer is told beside the expected value, not beside its tolerance."""
BARELY = 1.05
"""Up to so many tolerances an answer is just over."""
SCORE, MOST = 20, 1e99
POWERS = {"²": "^2"}


class FeedbackRow(Struct, frozen=True):
    """One field: its cells in the order of COLUMNS, why, and what was found."""

    cells: tuple[str, ...]
    why: str
    status: Status


def rows(graded: Graded, words: Words) -> list[FeedbackRow]:
    """What a student is told, a row for each field that earns points; of who handed in nothing
    only what the lecturer decided.
    """
    told = (mark for mark in graded.marks if graded.present or mark.decision is not None)
    return [row_of(graded, mark, words) for mark in told if mark.points]


def row_of(graded: Graded, mark: EarnedMark, words: Words) -> FeedbackRow:
    """What a student is told of one field."""
    open_yet = is_open(graded, mark)
    cells = (
        quantity(mark, words),
        answer_words(mark, words),
        UNTOLD if open_yet else value_words(mark, words, mark.expected),
        "" if open_yet else allowed_words(mark, words),
        "" if open_yet else off_words(mark, words),
        words(
            "feedback.of_points",
            earned=points_words(mark.earned, words) if not mark.waits else "?",
            points=points_words(mark.points, words),
        ),
    )
    told = why(graded, mark, words)
    if mark.decision is not None:
        told = f"{told}; {decision_words(mark.decision, words)}"
    return FeedbackRow(cells, told, mark.status)


def is_open(graded: Graded, mark: EarnedMark) -> bool:
    """Whether the key of a field is kept back: it waits, or would tell that of one that does."""
    if mark.status is Status.RIGHT:
        return False
    mine = (mark.item.quantity, mark.item.of)
    return any((m.item.quantity, m.item.of) == mine for m in graded.marks if m.waits)


def answer_words(mark: EarnedMark, words: Words) -> str:
    """An answer as it was written; a sense in the words of the page."""
    if mark.item.what == "sense" and mark.answer.value:
        return value_words(mark, words, mark.answer.value)
    return escape(safe(mark.answer.text))


def safe(text: str) -> str:
    """An answer as it was written, as far as a page can show it."""
    return printable(shown_cell(text.strip()))


def printable(text: str) -> str:
    """A text with only signs that the lettering has."""
    return "".join(sign if known_sign(sign) else "?" for sign in text)


def known_sign(sign: str) -> bool:
    """Whether the lettering has a sign."""
    try:
        advance(sign, False)
    except PageError:
        return False
    return True


def quantity(mark: EarnedMark, words: Words) -> str:
    """The symbol of a field, with what is told of it."""
    item = mark.item
    if item.what == "sense":
        return f"{item.symbol}, {words('table.sense')}"
    return f"{item.symbol}, {unit_markup(item.unit)}"


def unit_markup(unit: str) -> str:
    """A unit as markup."""
    return "".join(POWERS.get(sign, sign) for sign in unit)


def value_words(mark: EarnedMark, words: Words, value: float) -> str:
    """A value of a field as the page writes it."""
    item = mark.item
    if item.what == "sense":
        turning = item.quantity in TURNING
        return words(SENSES[turning, value > 0]) if value else "0"
    if isnan(value):
        return "–"
    return words.significant(item.size(value))


def allowed_words(mark: EarnedMark, words: Words) -> str:
    """How far a value may be off; nothing for a sense."""
    return "" if mark.item.what == "sense" else words.significant(mark.tolerance, 2)


def off_words(mark: EarnedMark, words: Words) -> str:
    """How far an answer is off, in the field's unit; nothing for a sense or without an answer."""
    if mark.item.what == "sense" or mark.off is None or isnan(mark.off):
        return ""
    if abs(mark.off) < NEGLIGIBLE * mark.tolerance:
        return "0"
    sign = "+" if mark.off > 0 else ""
    return sign + words.significant(mark.off, 2)


def why(graded: Graded, mark: EarnedMark, words: Words) -> str:
    """Why a field earned what it did, in a sentence."""
    if mark.status is Status.UNREADABLE:
        rest = escape(safe(beyond_number(mark.answer.text)))
        reason = unread(mark.answer.problem, unit_markup(mark.item.unit), words, rest)
        return reason if mark.is_ruled else words("feedback.unreadable", why=reason)
    if mark.status is Status.RIGHT and mark.source:
        return words("feedback.right_by", source=graded.mark(mark.source).item.symbol)
    if mark.is_together:
        return words("feedback.right_together")
    if mark.status in PLAIN:
        return words(PLAIN[mark.status])
    if mark.torn:
        return words("feedback.torn")
    if mark.item.what == "sense":
        parts = [words("feedback.wrong_sense"), *advice(mark, words)]
    elif mark.status is Status.FOLLOWS:
        parts = []
    elif is_open(graded, mark):
        parts = [words("feedback.kept_back")]
    else:
        parts = [far(mark, words)]
    if mark.status is Status.FOLLOWS and not mark.source:
        parts.append(words("feedback.follows_drawn", share=percent(mark)))
    elif mark.status is Status.FOLLOWS:
        source = graded.mark(mark.source)
        parts.append(words("feedback.follows", source=source.item.symbol, share=percent(mark)))
        if mark.slip and mark.slip == source.slip and mark.source != f"{mark.item.field}_mm":
            parts.append(words("feedback.guess", slip=words(SLIPS[mark.slip])))
    elif mark.slip and mark.slip != REVERSED:
        parts.append(words("feedback.guess", slip=words(SLIPS[mark.slip])))
    if mark.status is Status.SLIP and mark.earned:
        parts.append(share_words(graded, mark, words))
    return "; ".join(parts)


def share_words(graded: Graded, mark: EarnedMark, words: Words) -> str:
    """What a slip leaves of the points: its own share once, then that of what follows from it."""
    if not mark.source:
        return words("feedback.share", share=percent(mark))
    source = graded.mark(mark.source).item.symbol
    return words("feedback.again", source=source, share=percent(mark))


def advice(mark: EarnedMark, words: Words) -> list[str]:
    """How a sense of turning is told from the drawing."""
    turning = mark.slip == REVERSED and mark.item.quantity in TURNING
    return [words("feedback.turning_advice")] if turning else []


def unread(problem: str, unit: str, words: Words, rest: str = "") -> str:
    """Why a cell cannot be read, of which ``rest`` stands after a number, and what could be."""
    return words(UNREAD[problem], unit=unit, rest=rest)


def decision_words(decision: Decision, words: Words) -> str:
    """What the lecturer decided, and why, in a sentence."""
    if decision.is_open:
        key = "feedback.asked"
    else:
        key = "feedback.stands" if decision.points is None else "feedback.decided"
    return words(key, reason=escape(printable(decision.reason)))


def far(mark: EarnedMark, words: Words) -> str:
    """How far off an answer is: how many times too large or small, or beside what is allowed."""
    size, right = abs(mark.answer.value or 0.0), abs(mark.expected)
    if mark.item.what != "place" and right:
        if not size:
            return words("feedback.nought")
        if size >= MANIFOLD * right:
            return words("feedback.too_large", times=times(size / right, words))
        if right >= MANIFOLD * size:
            return words("feedback.too_small", times=times(right / size, words))
    off = abs(mark.off or 0.0) / mark.tolerance if mark.tolerance else 0.0
    if off < BARELY:
        return words("feedback.just_over")
    return words("feedback.wrong", times=times(off, words))


def times(number: float, words: Words) -> str:
    """So many times, as a language says it: from twenty on some put a word after it."""
    number = min(number, MOST)
    text = words.significant(number, 2)
    text = text if number >= 10 else words.decimal(f"{number:.1f}".removesuffix(".0"))
    return words("feedback.many", times=text) if round(number) >= SCORE else text


def percent(mark: EarnedMark) -> str:
    """What was earned, in percent of a field's points."""
    return f"{float(100 * mark.earned / mark.points):.0f}" if mark.points else "0"


def points_words(points: Fraction, words: Words) -> str:
    """Points without needless places, two at most."""
    text = f"{float(points):.2f}".rstrip("0").rstrip(".")
    return words.decimal(text)
