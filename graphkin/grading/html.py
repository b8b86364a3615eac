"""Feedback as a page for a browser: one file, nothing fetched from elsewhere, names escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from graphkin.grading.rows import COLUMNS, HEADS, Row
from graphkin.paper.richtext import Piece, pieces

STYLE = """
body{font:15px/1.5 "DejaVu Sans",Verdana,sans-serif;color:#26323c;max-width:62rem;margin:2rem auto;
padding:0 1rem}h1{font-size:1.4rem;margin:0 0 .3rem}h2{font-size:1.1rem;margin:2rem 0 .5rem}
table{border-collapse:collapse;width:100%;margin:1rem 0}th,td{padding:.35rem .6rem;
text-align:left;vertical-align:top;border-bottom:1px solid #dfe5ea}th{background:#f2f5f7;
font-weight:600}td.n{text-align:right;white-space:nowrap}tr.why td{border-bottom:1px solid #b9c4cc;
padding-top:0;color:#4a5a6a}tr.top td{border-bottom:0}.right{color:#1d6b41}.wrong{color:#a3271c}
.follows,.slip{color:#8a5a00}.blank,.unreadable{color:#4a5a6a}.total{font-size:1.2rem;
font-weight:600}img{max-width:100%}.small{font-size:.85rem;color:#4a5a6a}
@media print{body{margin:0;font-size:11px}}
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
            f"<title>{escape(title)}</title><style>{STYLE}</style></head><body>",
            *body,
            "</body></html>",
            "",
        )
    )


def marked_up(markup: str) -> str:
    """A markup of the sheets in that of a page."""
    return "".join(map(tagged, pieces(markup)))


def tagged(piece: Piece) -> str:
    """A piece of text in the tags of its face and its level."""
    text = escape(piece.text)
    text = f"<i>{text}</i>" if piece.italic else text
    tag = {-1: "sub", 1: "sup"}.get(piece.level)
    return f"<{tag}>{text}</{tag}>" if tag else text


def cells(texts: Sequence[str], tag: str = "td") -> str:
    """A row of a table, markup already in tags; all but the first to the right."""
    return "".join(
        f"<{tag}{RIGHT if i and tag == 'td' else ''}>{text}</{tag}>" for i, text in enumerate(texts)
    )


def feedback_table(rows: Sequence[Row], heads: dict[str, str]) -> list[str]:
    """The table of what a student is told: below each row why."""
    found = ["<table>", f"<tr>{cells([heads[HEADS[name]] for name in COLUMNS], 'th')}</tr>"]
    for row in rows:
        kind = row.status.value
        found.append(f'<tr class="top">{cells([marked_up(cell) for cell in row.cells])}</tr>')
        why = f'<td class="{kind}" colspan="{len(COLUMNS) - 1}">{marked_up(row.why)}</td>'
        found.append(f'<tr class="why"><td></td>{why}</tr>')
    return [*found, "</table>"]
