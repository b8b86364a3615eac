"""Browser markup from templates, which are next to the modules that fill them."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from graphkin.drawing.richtext import TextPiece, pieces
from graphkin.text.tables import CellTable

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup


@lru_cache(maxsize=1024)
def marked_up(markup: str) -> str:
    """A sheet's markup as browser markup; cached because symbols recur."""
    return "".join(map(tagged, pieces(markup)))


def tagged(piece: TextPiece) -> str:
    """A piece of text in the tags of its face and level."""
    text = escape(piece.text)
    text = f"<i>{text}</i>" if piece.italic else text
    tag = {-1: "sub", 1: "sup"}.get(piece.level)
    return f"<{tag}>{text}</{tag}>" if tag else text


# --- browser markup from templates ----------------------------------------------------------------


HOUSE = Path(__file__).resolve().parents[1]


def from_template(name: str, /, **values: object) -> Markup:
    """A template by its path in the package, filled in; values that are no markup are escaped."""
    from markupsafe import Markup

    return Markup(environment().get_template(name).render(values))


def tables_html(tables: Iterable[CellTable]) -> Markup:
    """Tables as HTML, those without rows left out."""
    return from_template("writers/tables.html", tables=[each for each in tables if each.rows])


@lru_cache(maxsize=1)
def environment() -> Environment:
    """The template environment; ``markup`` converts a sheet's markup into tags."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from markupsafe import Markup

    def safe(value: object) -> Markup:  # quotes as html.escape writes them, as scripts' data do
        return value if isinstance(value, Markup) else Markup(escape(str(value)))

    found = Environment(
        loader=FileSystemLoader(HOUSE),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=safe,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    found.filters["markup"] = lambda markup: Markup(marked_up(markup))
    return found
