"""The pictures of the class report: how hard each field was, frequent slips, points of all."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from graphkin.classroom.grading.feedback_rows import SLIPS
from graphkin.classroom.grading.graded import EarnedMark, Graded, Status
from graphkin.classroom.lab.lab_model import Item
from graphkin.drawing.richtext import pieces, plain
from graphkin.text import Words
from graphkin.writers.plot_style import INK, figure_file, look, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FILLS = {
    Status.RIGHT: ("class.right", "#2b8a5b", ""),
    Status.FOLLOWS: ("class.follows", "#9bc8ae", ""),
    Status.SLIP: ("class.slip", "#e0b04c", "//"),
    Status.WRONG: ("class.wrong", "#c8501e", ""),
    Status.UNREADABLE: ("class.unreadable", "#8a4fa3", "xx"),
    Status.BLANK: ("class.blank", "#dfe5ea", ""),
}
"""Words, colour and hatching of each status; told apart in grey too."""
WIDTH = 7.2
BARS = 10
"""Classes of points, in percent."""
MOST = 12
"""Slips that are shown."""
ACROSS = 92
"""Signs of a line of a slip's sentence above its bar."""
BAR, LINE, APART, INCH = 0.5, 0.55, 0.4, 0.27
"""Heights of a bar, a line of text and the gap below a bar, and what one of height is in inches."""


def pictures(
    graded: Sequence[Graded], words: Words, kind: str, own: Sequence[Graded] | None = None
) -> dict[str, bytes]:
    """Each picture by its name, as svg or png; the same bytes for the same marks.

    ``own`` are those among whom slips are counted, all who are there by default.
    """
    present = [each for each in graded if each.present]
    found: dict[str, bytes] = {}
    with look():
        if present:
            found["difficulty"] = figure_file(difficulty(present, words), kind)
            found["distribution"] = figure_file(distribution(present, words), kind)
        slipped = present if own is None else own
        if slip_counts(slipped):
            found["slips"] = figure_file(frequent(slipped, words), kind)
    return found


def figure(height: float) -> tuple[Figure, Any]:
    """A figure with one field."""
    drawn = new_figure(WIDTH, height)
    return drawn, drawn.add_subplot()


def difficulty(graded: Sequence[Graded], words: Words) -> Figure:
    """For each field how many answers were right, followed, slipped, wrong, or missing."""
    found: dict[str, list[EarnedMark]] = {}
    for each in graded:
        for mark in worth(each):
            found.setdefault(mark.item.field, []).append(mark)
    columns = list(found.values())
    drawn, ax = figure(1.1 + 0.26 * len(columns))
    left = [0.0] * len(columns)
    for status, (key, colour, hatch) in FILLS.items():
        parts = [100 * sum(m.status is status for m in column) / len(column) for column in columns]
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


def called(item: Item, words: Words) -> str:
    """A field by its symbol, with the unit in which it is asked; a sense by the word for it."""
    unit = words("table.sense") if item.what == "sense" else item.unit
    return f"{mathtext(item.symbol)}, {unit}"


def mathtext(markup: str) -> str:
    """A markup as matplotlib sets it."""
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
    """How many students reached how many points, in percent."""
    shares = [float(100 * each.share) for each in graded if each.share is not None]
    drawn, ax = figure(2.6)
    edges = [i * 100 / BARS for i in range(BARS + 1)]
    ax.hist(shares, bins=edges, color="#1f5fa8", edgecolor="white", linewidth=0.8)
    ax.set_xlim(0, 100)
    ax.set_xticks(edges)
    ax.yaxis.get_major_locator().set_params(integer=True)
    ax.set_xlabel(words("class.percent_axis"))
    ax.set_ylabel(words("class.count_axis"))
    ax.grid(axis="x", visible=False)
    return drawn


def slip_counts(graded: Sequence[Graded]) -> list[tuple[str, int, int]]:
    """Each slip with the answers and the students that it explains, the commonest first."""
    answers: Counter[str] = Counter()
    students: Counter[str] = Counter()
    for each in graded:
        names = [mark.slip for mark in each.marks if mark.slip and mark.points]
        answers.update(names)
        students.update(set(names))
    order = sorted(students, key=lambda name: (-students[name], -answers[name], name))
    return [(name, answers[name], students[name]) for name in order]


def frequent(graded: Sequence[Graded], words: Words) -> Figure:
    """How many students made each slip."""
    counts = slip_counts(graded)[:MOST]
    texts = [wrap(plain(words(SLIPS[name])), ACROSS) for name, _, _ in counts]
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
    ax.set_xlabel(words("class.count_axis"))
    ax.grid(axis="y", visible=False)
    return drawn


def stacked(lines: Sequence[int]) -> tuple[list[float], float]:
    """The middle of each bar below its lines of text, from the top, and the height of all."""
    places: list[float] = []
    y = 0.0
    for count in lines:
        y += count * LINE + BAR
        places.append(y - BAR / 2 + 0.1)
        y += APART
    return places, y
