"""Feedback as a page for a browser: one file, nothing fetched from elsewhere, names escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from graphkin.classroom.grading.feedback_rows import COLUMNS, HEADS, FeedbackRow
from graphkin.text import Words
from graphkin.writers.html_markup import marked_up

STYLE = """
body{font:15px/1.5 "DejaVu Sans",Verdana,sans-serif;color:#26323c;max-width:62rem;margin:2rem auto;
padding:0 1rem}h1{font-size:1.4rem;margin:0 0 .3rem}h2{font-size:1.1rem;margin:2rem 0 .5rem}
table{border-collapse:collapse;width:100%;margin:1rem 0}th,td{padding:.35rem .6rem;
text-align:left;vertical-align:top;border-bottom:1px solid #dfe5ea}th{background:#f2f5f7;
font-weight:600}.n{text-align:right}td.n{white-space:nowrap}td:first-child{white-space:nowrap}
tr.why td{padding-top:0;color:#4a5a6a;
border-bottom:1px solid #b9c4cc}tr.top td{border-bottom:0}.right{color:#1d6b41}.wrong{color:#a3271c}
.follows,.slip{color:#8a5a00}.blank,.unreadable{color:#4a5a6a}.total{font-size:1.2rem;
font-weight:600}img{max-width:100%}.small{font-size:.85rem;color:#4a5a6a}
@media print{body{margin:0;font-size:11px}}
@media(max-width:46rem){.told .heads{display:none}.told,.told tbody,.told tr,.told td{display:block}
.told tr.told-end td,.told tr td{border:0;padding:.1rem .4rem}
.told td:first-child{font-weight:600;padding-top:.5rem}
.told td.n{display:flex;justify-content:space-between;gap:1rem;white-space:normal}
.told td.n::before{content:attr(data-label);color:#4a5a6a}.told tr td:empty{display:none}
.told tr.told-end{border-bottom:1px solid #b9c4cc;padding-bottom:.4rem}}
""".replace("\n", "")
RIGHT = ' class="n"'
"""What sets a cell to the right."""
POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
"""What a browser may load with a page: nothing but what is in it."""


def page(title: str, language: str, body: Iterable[str]) -> str:
    """A whole page."""
    return "\n".join(
        (
            "<!DOCTYPE html>",
            f'<html lang="{escape(language)}"><head><meta charset="utf-8">',
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title><style>{STYLE}</style></head>",
            "<body><main>",
            *body,
            "</main></body></html>",
            "",
        )
    )


def heads(texts: Sequence[str]) -> str:
    """The heads of a table's columns; all but the first to the right, over their numbers."""
    return "".join(
        f'<th scope="col"{RIGHT if i else ""}>{text}</th>' for i, text in enumerate(texts)
    )


def cells(texts: Sequence[str], names: Sequence[str]) -> str:
    """A row of a table, markup already in tags; all but the first to the right, and with the name
    of their column, which a narrow screen puts before them.
    """
    first, *rest = texts
    labels = (f'data-label="{escape(name)}"' for name in names[1:])
    numbers = (f"<td{RIGHT} {label}>{text}</td>" for label, text in zip(labels, rest, strict=True))
    return f"<td>{first}</td>{''.join(numbers)}"


def feedback_table(rows: Sequence[FeedbackRow], words: Words) -> list[str]:
    """The table of what a student is told: below each row why, beside the points what is right."""
    names = [words(HEADS[name]) for name in COLUMNS]
    found = ['<table class="told">', f'<tr class="heads">{heads(names)}</tr>']
    for row in rows:
        kind, why = row.status.value, marked_up(row.why)
        texts = [marked_up(cell) for cell in row.cells]
        if row.why == words("feedback.right"):
            texts[-1] = f'<span class="{kind}">{why}</span> {texts[-1]}'
            found.append(f'<tr class="told-end">{cells(texts, names)}</tr>')
            continue
        found.append(f'<tr class="top">{cells(texts, names)}</tr>')
        reason = f'<td class="{kind}" colspan="{len(COLUMNS) - 1}">{why}</td>'
        found.append(f'<tr class="why told-end"><td></td>{reason}</tr>')
    return [*found, "</table>"]
