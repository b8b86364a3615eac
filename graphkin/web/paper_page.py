"""The web page of sheets of paper, one below the other: a whole motion, and the task of forces."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from graphkin.construction.core.quantities import FORCE
from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import Page
from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism
from graphkin.web.offline_page import ink_sheet, offline_page, part
from graphkin.writers.svg import element, number

LOOK = """main{display:grid;gap:1rem;max-width:100rem;margin:0 auto;padding:1rem}
h1,h2{font-size:1rem}
nav{display:flex;flex-wrap:wrap;gap:.2rem 1.2rem}
a{color:var(--focus)}
section{min-width:0}
section>div{overflow-x:auto}
svg{display:block;width:100%;min-width:56rem;height:auto;background:var(--paper)}
@media print{nav{display:none}section{break-after:page}svg{min-width:0}}"""
"""The sheets one below the other."""


def force_task(mechanism: Mechanism, language: str | None = None, ink: Ink = "colour") -> str:
    """The page of the task of a scene that asks for forces. Raises as hand_out does."""
    sheets = (each for each in hand_out(mechanism, "task", language) if each.kind == FORCE)
    return paper_page([page for each in sheets for page in each.pages], ink)


def motion_page(
    mechanism: Mechanism, view: str, language: str | None = None, ink: Ink = "colour"
) -> str:
    """The page of a whole motion: its positions, or its diagrams. Raises as hand_out does."""
    sheets = hand_out(mechanism, view, language)
    return paper_page([page for each in sheets for page in each.pages], ink)


def paper_page(pages: Sequence[Page], ink: Ink) -> str:
    """Sheets as pictures, each with its title above, and links to them if there are several."""
    from markupsafe import Markup

    links = "".join(
        f'<a href="#sheet-{place}">{place}. {escape(page.title)}</a>'
        for place, page in enumerate(pages, 1)
    )
    head = f"<nav>{links}</nav>\n" if len(pages) > 1 else ""
    body = "".join(picture(page, place) for place, page in enumerate(pages, 1))
    marks = [mark for page in pages for mark in page.marks]
    looks = (ink_sheet(marks, ink), part("page.css"), LOOK)
    whole = Markup(f"<main>\n{head}{body}</main>")
    return offline_page(pages[0].title, pages[0].lang, whole, looks)


def picture(page: Page, place: int) -> str:
    """A sheet as a picture, with its title above."""
    box = f"0 0 {number(page.width)} {number(page.height)}"
    title = escape(page.title)
    drawn = "\n".join(map(element, page.marks))
    svg = f'<svg viewBox="{box}" role="img" aria-label="{title}">\n{drawn}\n</svg>'
    head = f"<h{1 + (place > 1)}>{title}</h{1 + (place > 1)}>"
    scrolled = f'<div tabindex="0">\n{svg}\n</div>'
    return f'<section id="sheet-{place}">\n{head}\n{scrolled}\n</section>\n'
