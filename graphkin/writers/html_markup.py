"""The markup of the sheets in the tags of a page for a browser."""

from __future__ import annotations

from functools import lru_cache
from html import escape

from graphkin.drawing.richtext import TextPiece, pieces


@lru_cache(maxsize=1024)
def marked_up(markup: str) -> str:
    """A markup of the sheets in that of a page; the symbols of a page come again and again."""
    return "".join(map(tagged, pieces(markup)))


def tagged(piece: TextPiece) -> str:
    """A piece of text in the tags of its face and its level."""
    text = escape(piece.text)
    text = f"<i>{text}</i>" if piece.italic else text
    tag = {-1: "sub", 1: "sup"}.get(piece.level)
    return f"<{tag}>{text}</{tag}>" if tag else text
