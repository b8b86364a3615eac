"""The web page of the sheet of forces: the sheet, then its steps one below the other."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import Page
from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism
from graphkin.web.offline_page import ink_sheet, offline_page, part
from graphkin.writers.svg import element, number

if TYPE_CHECKING:
    from markupsafe import Markup

LOOK = """:root{--green:#1c6b2a;--brown:#8a4500}
@media (prefers-color-scheme:dark){:root{--green:#7fd492;--brown:#f0b27a}}
main{display:grid;gap:1rem;max-width:100rem;margin:0 auto;padding:1rem}
h2{font-size:1rem}
svg{display:block;width:100%;height:auto;background:var(--paper)}"""
"""The inks of forces, which no other page has, and the sheets one below the other."""


def force_page(
    mechanism: Mechanism, view: str = "key", language: str | None = None, ink: Ink = "colour"
) -> str:
    """The page of the forces of a scene that asks for them, in a view: key, steps or task.

    Raises as hand_out does.
    """
    views = ("task",) if view == "task" else ("key", "steps")
    pages = [page for each in views for page in of_forces(mechanism, each, language)]
    marks = [mark for page in pages for mark in page.marks]
    first = pages[0]
    looks = (ink_sheet(marks, ink), part("page.css"), LOOK)
    return offline_page(first.title, first.lang, body_of(pages), looks)


def of_forces(mechanism: Mechanism, view: str, language: str | None) -> tuple[Page, ...]:
    """The pages of the sheet of forces in a view."""
    return next(each.pages for each in hand_out(mechanism, view, language) if each.kind == "force")


def body_of(pages: list[Page]) -> Markup:
    """The pages as pictures with their titles."""
    from markupsafe import Markup

    return Markup(f"<main>\n{''.join(map(picture, pages))}</main>")


def picture(page: Page) -> str:
    """A page as a picture, with its title above."""
    box = f"0 0 {number(page.width)} {number(page.height)}"
    title = escape(page.title)
    drawn = "\n".join(map(element, page.marks))
    svg = f'<svg viewBox="{box}" role="img" aria-label="{title}">\n{drawn}\n</svg>'
    return f"<section>\n<h2>{title}</h2>\n{svg}\n</section>\n"
