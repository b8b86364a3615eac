"""A feedback page for each student, as HTML and on paper, in the language of the lab."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import isnan

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import beyond_number, shown_cell
from graphkin.classroom.grading.graded import (
    HANDWRITTEN,
    THOUSANDS,
    WITHHELD,
    Decision,
    DrawingRemark,
    EarnedCause,
    EarnedMark,
    Graded,
    Status,
)
from graphkin.classroom.lab.lab_model import Rubric
from graphkin.classroom.printing.personal import printable_name
from graphkin.construction.core.given_data import set_parameters
from graphkin.construction.core.quantities import CLOCKWISE, TIME_RATIO, TURNING
from graphkin.drawing.field import A4_AREA, A4_PAGE, text_page
from graphkin.drawing.frame import on_page, page_frame
from graphkin.drawing.marks import LineMark, Mark, Page, Text
from graphkin.drawing.richtext import advance, extent, flowed, plain, words_of
from graphkin.drawing.symbol_markup import escape
from graphkin.scene.model import Scene
from graphkin.text import Words
from graphkin.text.errors import PageError
from graphkin.writers.templates import from_template

COLUMNS = ("quantity", "yours", "expected", "allowed", "off", "earned")
HEADS = {
    "quantity": "feedback.quantity",
    "yours": "feedback.yours",
    "expected": "feedback.expected",
    "allowed": "feedback.allowed",
    "off": "feedback.off",
    "earned": "feedback.earned",
}
SENSES = {
    (True, True): "feedback.anticlockwise",
    (True, False): "feedback.clockwise",
    (False, True): "feedback.forward",
    (False, False): "feedback.backward",
}
"""The words for a sense: turning or sliding, positive or negative."""
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
    HANDWRITTEN: "unread.handwritten",
    WITHHELD: "unread.withheld",
}
"""The sentence for each reason why a cell cannot be read."""
WITHHELD = "…"
"""The text in place of an expected value that is kept back."""
NEGLIGIBLE = 0.01
"""The part of the tolerance below which an answer's error is shown as zero."""
MANIFOLD = 2.0
"""The least factor at which an answer is compared with the expected value, not the tolerance."""
BARELY = 1.05
"""The most tolerances by which an answer is only just outside."""
SCORE, MOST = 20, 1e99
POWERS = {"²": "^2"}


Block = tuple[float, list[Mark]]
"""The height of a part that stays together, in mm, and its marks measured from its top."""


class DrawingBack(Struct, frozen=True):
    """A drawing made on the task page, in green and red: markup for a page, and parts for paper."""

    markup: str
    blocks: tuple[Block, ...]


class FeedbackRow(Struct, frozen=True):
    """One field or cause: its cells in the order of ``COLUMNS``, the reason, and the status."""

    cells: tuple[str, ...]
    why: str
    status: Status


def rows(graded: Graded, words: Words) -> list[FeedbackRow]:
    """A row for each field that earns points, and one for each cause that costs points.

    Where nothing was handed in, only fields with a decision have a row.
    """
    marks = (mark for mark in graded.marks if graded.present or mark.decision is not None)
    fields = [row_of(graded, mark, words) for mark in marks if mark.points]
    return [*fields, *(cause_row(each, words) for each in graded.causes if each.cost)]


def cause_row(cause: EarnedCause, words: Words) -> FeedbackRow:
    """The row of a cause: what it was, and what it costs."""
    cost = f"−{points_words(cause.cost, words)}"
    cells = (words("feedback.mistake"), "", "", "", "", cost)
    return FeedbackRow(cells, cause_sentence(cause, words), Status.CAUSE)


def cause_sentence(cause: EarnedCause, words: Words) -> str:
    """What a student did, as markup; a lab's own cause in a language that the lab writes.

    Two causes where the answers do not tell which of them it was.
    """
    if not cause.said:
        said = words(f"cause.{cause.name}")
        other = words(f"cause.{cause.either}") if cause.either else ""
        return words("feedback.either", cause=said, other=other) if other else said
    return escape(printable(cause.said.get(words.language, next(iter(cause.said.values())))))


def shows_sentence(cause: EarnedCause, words: Words) -> str:
    """Where a cause shows on the drawing, and what to say where either of two may be meant."""
    shows = words("shows.own" if cause.said else f"shows.{cause.name}")
    if not cause.either:
        return shows
    return words("feedback.either", cause=shows, other=words(f"shows.{cause.either}"))


def row_of(
    graded: Graded, mark: EarnedMark, words: Words, *, for_marker: bool = False
) -> FeedbackRow:
    """The row of one field; one ``for_marker`` keeps no expected value back."""
    open_yet = is_open(graded, mark) and not for_marker
    cells = (
        quantity(mark, words),
        answer_words(mark, words),
        WITHHELD if open_yet else value_words(mark, words, mark.expected),
        "" if open_yet else allowed_words(mark, words),
        "" if open_yet else off_words(mark, words),
        words(
            "feedback.of_points",
            earned=points_words(mark.earned, words) if not mark.waits else "?",
            points=points_words(mark.points, words),
        ),
    )
    reason = why(graded, mark, words, is_kept_back=open_yet)
    if mark.answer.written:
        text = escape(safe(mark.answer.text)) or "–"
        reason = words.clauses((words("feedback.read_as", text=text), reason))
    if mark.answer.typed:
        reason = words.clauses((words("feedback.typed"), reason))
    if mark.decision is not None:
        reason = words.clauses((reason, decision_words(mark.decision, words)))
    if mark.item.field in graded.remarks:
        reason = words.clauses((reason, remark_words(graded.remarks[mark.item.field], words)))
    return FeedbackRow(cells, reason, mark.status)


def is_open(graded: Graded, mark: EarnedMark) -> bool:
    """Whether the expected value is kept back.

    It is kept back where the answer waits, or where it would give away the key of one that does.
    """
    if mark.status is Status.RIGHT:
        return False
    mine = (mark.item.quantity, mark.item.of)
    return any((m.item.quantity, m.item.of) == mine for m in graded.marks if m.waits)


def answer_words(mark: EarnedMark, words: Words) -> str:
    """An answer as it was written; a sense in the words of the page."""
    if mark.item.what == "sense" and mark.answer.value:
        return value_words(mark, words, mark.answer.value)
    return escape(safe(mark.answer.written or mark.answer.text))


def safe(text: str) -> str:
    """An answer as it was written, in printable characters."""
    return printable(shown_cell(text.strip()))


def printable(text: str) -> str:
    """The text, with ? for each character that the lettering lacks."""
    return "".join(sign if known_sign(sign) else "?" for sign in text)


def known_sign(sign: str) -> bool:
    """Whether the lettering has a character."""
    try:
        advance(sign, False)
    except PageError:
        return False
    return True


def quantity(mark: EarnedMark, words: Words) -> str:
    """The symbol of a field with its unit; for a sense, with the word for it."""
    item = mark.item
    if item.what == "sense":
        return f"{item.symbol}, {words('table.sense')}"
    return ", ".join(filter(None, (item.symbol, unit_markup(words.spelled(item.unit)))))


def unit_markup(unit: str) -> str:
    return "".join(POWERS.get(sign, sign) for sign in unit)


def value_words(mark: EarnedMark, words: Words, value: float) -> str:
    """A value of a field as the page writes it."""
    item = mark.item
    if item.what == "sense":
        turning = item.quantity in CLOCKWISE
        return words(SENSES[turning, value > 0]) if value else "0"
    if isnan(value):
        return "–"
    return words.significant(item.size(value) / item.one)


def allowed_words(mark: EarnedMark, words: Words) -> str:
    """The tolerance of a field; empty for a sense."""
    return "" if mark.item.what == "sense" else words.significant(mark.tolerance / mark.item.one, 2)


def off_words(mark: EarnedMark, words: Words) -> str:
    """The error of an answer in the field's unit; empty for a sense or without an answer."""
    if mark.item.what == "sense" or mark.off is None or isnan(mark.off):
        return ""
    if abs(mark.off) < NEGLIGIBLE * mark.tolerance:
        return "0"
    sign = "+" if mark.off > 0 else ""
    return sign + words.significant(mark.off / mark.item.one, 2)


def why(graded: Graded, mark: EarnedMark, words: Words, *, is_kept_back: bool) -> str:
    """The reason for what a field earned, in one sentence."""
    if mark.status is Status.UNREADABLE:
        rest = escape(safe(beyond_number(mark.answer.text)))
        reason = unread(
            mark.answer.problem, unit_markup(words.spelled(mark.item.unit)), words, rest
        )
        return reason if mark.is_ruled else words("feedback.unreadable", why=reason)
    if mark.rounded and mark.earned:
        few = mark.rounded == "few"
        return words("feedback.digits_few" if few else "feedback.digits_many", share=percent(mark))
    if mark.status is Status.CAUSE:
        return caused_words(graded, mark, words)
    if mark.alone:
        return words("feedback.alone")
    if mark.status is Status.RIGHT and mark.source:
        return words("feedback.right_by", source=source_words(graded, mark))
    if mark.is_together:
        return words("feedback.right_together")
    if mark.status in PLAIN:
        return words(PLAIN[mark.status])
    if mark.torn:
        return words("feedback.torn")
    if mark.item.what == "sense":
        advice = [words("feedback.turning_advice")] if mark.item.quantity in TURNING else []
        parts: list[str] = [words("feedback.wrong_sense")]
        parts += advice
    elif mark.status is Status.FOLLOWS:
        parts = []
    elif is_kept_back:
        parts = [words("feedback.kept_back")]
    else:
        parts = [far(mark, words)]
    if mark.status is Status.FOLLOWS and not mark.source:
        parts.append(words("feedback.follows_drawn", share=percent(mark)))
    elif mark.status is Status.FOLLOWS:
        source = source_words(graded, mark)
        parts.append(words("feedback.follows", source=source, share=percent(mark)))
    return words.clauses(parts)


def source_words(graded: Graded, mark: EarnedMark) -> str:
    """The answer from which another follows; with its unit where both have one symbol."""
    item = graded.mark(mark.source).item
    alike = item.symbol == mark.item.symbol and item.unit
    return f"{item.symbol} ({unit_markup(item.unit)})" if alike else item.symbol


def caused_words(graded: Graded, mark: EarnedMark, words: Words) -> str:
    """Why an answer is right that a cause explains: what the cause makes of the value."""
    if not mark.earned:
        return words("feedback.lost_sense")
    if not mark.by_cause or mark.item.what == "sense":
        return words("feedback.caused")
    one, several = "feedback.caused_value", "feedback.caused_values"
    key = one if len(graded.causes) == 1 else several
    return words(key, value=value_words(mark, words, mark.by_cause))


def unread(problem: str, unit: str, words: Words, rest: str = "") -> str:
    """Why a cell cannot be read, and what is accepted; ``rest`` is the text after its number."""
    return words(UNREAD[problem], unit=unit, rest=rest)


def decision_words(decision: Decision, words: Words) -> str:
    """The lecturer's decision and its reason, with the appeal that it answers or does not yet."""
    reason = escape(printable(decision.reason))
    if decision.is_open:
        return words("feedback.asked", reason=reason)
    keys = ("feedback.decided", "feedback.decided_so")
    if decision.points is None:
        keys = ("feedback.kept", "feedback.kept_so")
    text: str = words(keys[0], reason=reason) if reason else words(keys[1])
    if decision.answers:
        text = words.clauses(
            (words("feedback.you_asked", text=escape(printable(decision.answers))), text)
        )
    if decision.asked:
        text = words.clauses(
            (text, words("feedback.asked", reason=escape(printable(decision.asked))))
        )
    return text


def remark_words(text: str, words: Words) -> str:
    """The lecturer's remark."""
    return words("feedback.remark", text=escape(printable(text)))


def pin_words(pin: DrawingRemark, words: Words) -> str:
    """A remark on a drawing, with the sheet and the number of its pin."""
    text, sheet = escape(printable(pin.text)), words(f"sheet.{pin.kind}")
    return words("feedback.pinned", sheet=sheet, number=pin.number, text=text)


def far(mark: EarnedMark, words: Words) -> str:
    """How far off an answer is: a factor of the expected value, or a number of tolerances."""
    size, right = abs(mark.answer.value or 0.0), abs(mark.expected)
    if mark.item.what != "place" and right:
        if not size:
            return words("feedback.zero")
        if size >= MANIFOLD * right:
            return words("feedback.too_large", times=times(size / right, words))
        if right >= MANIFOLD * size:
            return words("feedback.too_small", times=times(right / size, words))
    off = abs(mark.off or 0.0) / mark.tolerance if mark.tolerance else 0.0
    if off < BARELY:
        return words("feedback.just_over")
    return words("feedback.wrong", times=times(off, words))


def times(number: float, words: Words) -> str:
    """A factor in words; from 20 on, some languages put a word after the number."""
    number = min(number, MOST)
    text = words.significant(number, 2)
    text = text if number >= 10 else words.decimal(f"{number:.1f}".removesuffix(".0"))
    return words("feedback.many", times=text) if round(number) >= SCORE else text


def percent(mark: EarnedMark) -> str:
    """The earned share of a field's points, in percent."""
    return f"{float(100 * mark.earned / mark.points):.0f}" if mark.points else "0"


def points_words(points: Fraction, words: Words) -> str:
    """Points with at most two decimals, without trailing zeros."""
    text = f"{float(points):.2f}".rstrip("0").rstrip(".")
    return words.decimal(text)


# --- the page as HTML ---------------------------------------------------------------------------


LEFT, RIGHT = A4_AREA[0] + 4, A4_AREA[2] - 4
TOP, BOTTOM = A4_AREA[1] + 10, A4_AREA[3] - 5
WIDTHS = (26.0, 34.5, 34.5, 28.2, 21.0, 27.8)
"""The widths of the columns, in mm; the second and third have room for a sense in words."""
LETTER, SMALL = 2.5, 1.8
LEADING, ROOM = 4.2, 2.6
"""The distance of lines and the space below a field, in mm."""
INDENT = 4.0


def feedback_html(
    graded: Graded,
    title: str,
    rubric: Rubric,
    words: Words,
    scene: Scene | None = None,
    drawing: DrawingBack | None = None,
) -> str:
    """The HTML page of one student; without answers, it gives no expected values.

    ``scene`` says what the parameters mean; without it they appear by name. ``drawing`` is the
    student's drawing in green and red.
    """
    page = from_template(
        "classroom/templates/feedback.html",
        words=words,
        title=title,
        student=graded.taker.student,
        settings=settings_words(graded, words, scene),
        total=total(graded, words) if is_shown(graded) else "",
        notes=notes(graded, words),
        names=[words(HEADS[name]) for name in COLUMNS],
        rows=rows(graded, words),
        right=words("feedback.right"),
        how=how(rubric, words),
        drawing=drawing.markup if drawing else "",
    )
    return f"{page}\n"


def cause_words(graded: Graded, words: Words) -> list[str]:
    """What explains the sheet, what it cost, where it shows, and whether all else follows."""
    causes = graded.causes
    if not causes or not is_shown(graded):
        return []
    said = (cause_sentence(cause, words) for cause in causes)
    sentences = dict(zip(("cause", "other"), said, strict=False))
    costing, free = (
        ("feedback.one_mistake", "feedback.one_mistake_free")
        if len(causes) == 1
        else ("feedback.two_mistakes", "feedback.two_mistakes_free")
    )
    cost = points_words(graded.cost, words)
    opening = words(costing, cost=cost, **sentences) if graded.cost else words(free, **sentences)
    parts: list[str] = [opening]
    parts += [words("feedback.either_way") for cause in causes if cause.either]
    caused = (m for m in graded.marks if m.status is Status.CAUSE and m.item.what == "sense")
    if lost := sum((mark.points for mark in caused if not mark.earned), Fraction()):
        parts.append(words("feedback.senses_lost", points=points_words(lost, words)))
    shows = (shows_sentence(cause, words) for cause in causes)
    parts += [words("feedback.mistake_shows", where=each) for each in shows]
    open_yet = (Status.WRONG, Status.FOLLOWS)
    left = [mark.item for mark in graded.marks if mark.points and mark.status in open_yet]
    if not left and is_followed(graded):
        parts.append(words("feedback.all_follows" if len(causes) == 1 else "feedback.all_follow"))
    elif left:
        fields = ", ".join(dict.fromkeys(item.symbol for item in left))
        parts.append(words("feedback.not_all", fields=fields))
    blank = [m.item.symbol for m in graded.marks if m.points and m.status is Status.BLANK]
    if blank:
        parts.append(words("feedback.left_blank", fields=", ".join(dict.fromkeys(blank))))
    return [" ".join(parts)]


def is_followed(graded: Graded) -> bool:
    """Whether more was wrong than the causes themselves; nothing follows from a time ratio."""
    caused = (mark.item for mark in graded.marks if mark.status is Status.CAUSE)
    found = {(item.quantity, item.of) for item in caused if item.quantity != TIME_RATIO.target}
    return len(found) > len(graded.causes)


def is_shown(graded: Graded) -> bool:
    """Whether a student sees marks: there are some, and they are not held."""
    return graded.is_marked and not graded.held


def total(graded: Graded, words: Words) -> str:
    """The sum of the points in words; points that wait are left out of both numbers."""
    earned, points = (points_words(each, words) for each in (graded.earned, graded.decided))
    text = words("feedback.total", earned=earned, points=points)
    if not graded.pending:
        return text
    waiting, every = (points_words(each, words) for each in (graded.pending, graded.points))
    return f"{text}, {words('feedback.waiting', pending=waiting, all=every)}"


def notes(graded: Graded, words: Words) -> list[str]:
    """The notes on the whole form: its causes, a decision, held marks, points that wait."""
    note_texts: list[str] = cause_words(graded, words)
    note_texts += [decision_words(graded.decision, words)] if graded.decision is not None else []
    note_texts += [remark_words(graded.remarks[""], words)] if "" in graded.remarks else []
    note_texts += [pin_words(each, words) for each in graded.pins]
    if not graded.is_marked:
        return [words("feedback.absent"), *note_texts]
    if graded.held:
        return [words("feedback.held"), *note_texts]
    waiting = [mark.item for mark in graded.marks if mark.points and mark.waits]
    if not waiting or not graded.pending:
        return note_texts
    fields = ", ".join(
        f"{item.symbol} ({words('table.sense')})" if item.what == "sense" else item.symbol
        for item in waiting
    )
    pending = points_words(graded.pending, words)
    return [*note_texts, words("feedback.pending", pending=pending, fields=fields)]


def settings_words(graded: Graded, words: Words, scene: Scene | None) -> str:
    """The data of a student's variant as markup, worded as on the sheets."""
    settings = graded.taker.settings
    if scene is None:
        pairs = [f"{escape(name)} = {words.decimal(value)}" for name, value in settings.items()]
        return words.clauses(pairs)
    exact = {name: Fraction(value) for name, value in settings.items()}
    own = replace(scene, values={**scene.values, **exact})
    return words.clauses(set_parameters(own, words, settings))


def how(rubric: Rubric, words: Words) -> str:
    """The explanation of a tolerance."""
    amounts = {"point": rubric.point, "line": rubric.line, "ruler": rubric.ruler}
    return words(
        "feedback.how", **{name: words.decimal(f"{value:g}") for name, value in amounts.items()}
    )


# --- on paper -----------------------------------------------------------------------------------


class Spacing(Struct, frozen=True):
    """Distances of a page, in mm: from a field's cells to its reason, and below the field."""

    line: float
    room: float


SPACINGS = (Spacing(3.4, 2.6), Spacing(3.3, 1.9), Spacing(3.1, 1.7))
"""From wide to narrow. The first that fits one page is used, else the widest."""


def feedback_pages(
    graded: Graded,
    title: str,
    rubric: Rubric,
    words: Words,
    scene: Scene | None = None,
    drawing: DrawingBack | None = None,
) -> tuple[Page, ...]:
    """The pages of one student, one page where possible, and then those of the drawing."""
    page = text_page(scene.sheet.paper) if scene else A4_PAGE
    low = BOTTOM - page.shorter
    settings = settings_words(graded, words, scene)
    tried = (list(paged(blocks(graded, rubric, words, settings, by), low)) for by in SPACINGS)
    bodies = next((found for found in tried if len(found) == 1), None)
    bodies = bodies or list(paged(blocks(graded, rubric, words, settings, SPACINGS[0]), low))
    if drawing and is_shown(graded):
        bodies += paged(iter(drawing.blocks), low)
    name = name_of(graded)
    return tuple(
        on_page(
            page,
            (
                *page_frame(
                    (fitting(escape(safe(title))), words("feedback.title")),
                    (fitting(name), f"{number}/{len(bodies)}"),
                    scene.house.header if scene else (),
                    page,
                ),
                *marks,
            ),
            f"{title} – {graded.taker.student.title}",
            words.language,
        )
        for number, marks in enumerate(bodies, 1)
    )


def name_of(graded: Graded) -> str:
    """A student's name and group, or the id, as markup and as on the sheets."""
    return escape(printable_name(graded.taker.student))


def fitting(markup: str) -> str:
    """The markup of a head or foot, shortened where it is too long."""
    return markup if extent(markup, LETTER)[0] <= 105 else shortened(markup, 105, LETTER)


def blocks(
    graded: Graded, rubric: Rubric, words: Words, settings: str, spacing: Spacing
) -> Iterator[Block]:
    """The blocks of the pages, from top to bottom."""
    yield text_block(name_of(graded), 3.5)
    if settings:
        yield text_block(settings, LETTER)
    if is_shown(graded):
        yield text_block(total(graded, words), 3.5)
    for note in notes(graded, words):
        yield text_block(note, LETTER)
    if not is_shown(graded):
        return
    table_rows = rows(graded, words)
    if table_rows:
        yield head_block(words)
    for row in table_rows:
        yield row_block(row, spacing, words("feedback.right"))
    yield text_block(how(rubric, words), SMALL)


def text_block(markup: str, height: float) -> Block:
    """A paragraph, broken into lines between the margins."""
    lines = flowed(list(pieces(markup, RIGHT - LEFT, height)), " ", RIGHT - LEFT, height)
    leading = LEADING * max(height / LETTER, 0.85)
    marks: list[Mark] = [
        Text(LEFT, (i + 1) * leading, line, "caption", height) for i, line in enumerate(lines)
    ]
    return len(lines) * leading + ROOM, marks


def pieces(markup: str, width: float, height: float) -> Iterator[str]:
    """The words of a markup; a word wider than a line is split."""
    for word in words_of(markup):
        if extent(word, height)[0] <= width:
            yield word
            continue
        piece = ""
        for sign in map(escape, plain(word)):
            if piece and extent(piece + sign, height)[0] > width:
                yield piece
                piece = ""
            piece += sign
        yield piece


def head_block(words: Words) -> Block:
    """The heads of the columns, above a line."""
    marks: list[Mark] = columns([words(HEADS[name]) for name in COLUMNS], LEADING)
    marks.append(LineMark(LEFT, LEADING + 1.6, RIGHT, LEADING + 1.6, "border"))
    return LEADING + ROOM + 0.8, marks


def row_block(row: FeedbackRow, spacing: Spacing, right: str) -> Block:
    """A field: its cells, and the reason below them.

    Where the reason is only that the answer is right, it goes before the points.
    """
    marks: list[Mark] = columns(row.cells, LEADING)
    room = RIGHT - LEFT - INDENT
    why: Sequence[str] = ()
    if row.why == right:
        before = RIGHT - 2.5 - extent(row.cells[-1], LETTER)[0]
        marks.append(Text(before, LEADING, right, "caption", SMALL, "end"))
    else:
        why = flowed(list(pieces(row.why, room, SMALL)), " ", room, SMALL)
    y = LEADING
    for line in why:
        y += spacing.line
        marks.append(Text(LEFT + INDENT, y, line, "caption", SMALL))
    below = min(1.6, spacing.room - 0.6)
    marks.append(LineMark(LEFT, y + below, RIGHT, y + below, "panel"))
    return y + spacing.room, marks


def columns(texts: Sequence[str], y: float) -> list[Mark]:
    """Texts in their columns: the first aligned left, the others right."""
    marks: list[Mark] = []
    x = LEFT
    for i, (text, width) in enumerate(zip(texts, WIDTHS, strict=True)):
        if text:
            height = LETTER if extent(text, LETTER)[0] <= width - 1 else SMALL
            fits = extent(text, height)[0] <= width - 1
            shown = text if fits else shortened(text, width - 1, SMALL)
            if i == 0:
                marks.append(Text(x, y, shown, "table", height))
            else:
                marks.append(Text(x + width - 1, y, shown, "table", height, "end"))
        x += width
    return marks


def shortened(markup: str, width: float, height: float) -> str:
    """A plain markup cut to a width in mm, at a letter height."""
    text = plain(markup)
    while text and extent(escape(text) + "…", height)[0] > width:
        text = text[:-1]
    return escape(text) + "…"


def paged(blocks: Iterator[Block], low: float) -> Iterator[list[Mark]]:
    """The marks of each page that ends at ``low`` mm; a block that does not fit starts the next."""
    page: list[Mark] = []
    y = TOP
    for height, marks in blocks:
        if page and y + height > low:
            yield page
            page, y = [], TOP
        page += [lowered(mark, y) for mark in marks]
        y += height
    yield page


def lowered(mark: Mark, by: float) -> Mark:
    """A mark moved down the page, by a distance in mm."""
    if isinstance(mark, Text):
        return replace(mark, y=mark.y + by)
    assert isinstance(mark, LineMark)
    return replace(mark, y1=mark.y1 + by, y2=mark.y2 + by)
