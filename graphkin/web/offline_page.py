"""An offline page: everything in one file, with a policy that lets a browser run nothing else."""

from __future__ import annotations

import json
import re
from base64 import b64encode
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from hashlib import sha256
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from graphkin.drawing.field import Rect
from graphkin.drawing.marks import Mark, Text
from graphkin.drawing.richtext import font_face
from graphkin.drawing.style import BRIEF, Ink, in_variables
from graphkin.web.protocol import Timed
from graphkin.writers.svg import LETTERING, element, number, parted_text, shared_rules
from graphkin.writers.templates import from_template

if TYPE_CHECKING:
    from markupsafe import Markup

WEB = Path(__file__).resolve().parent / "assets"
ENDS = re.compile(r"</(?:script|style)|<!--", re.IGNORECASE)
"""Text that would end a script or a style sheet too early."""
OWN = "font-src data:; img-src data: blob:; base-uri 'none'; form-action 'none'"
"""The policy for fonts, images and forms: only what the page itself holds."""


def offline_page(
    title: str, language: str, body: Markup, styles: Sequence[str], scripts: Sequence[str] = ()
) -> str:
    """A complete HTML page; its scripts run after the body, in their order.

    The policy names each script and style sheet by its hash. Nothing else runs, nothing is fetched,
    and attributes with code or styles have no effect. Raises ValueError for a script or a style
    sheet that would end early.
    """
    for text in (*styles, *scripts):
        if ENDS.search(text):
            raise ValueError(f"{ENDS.search(text)} would end a script or a style sheet")
    policy = f"default-src 'none'; style-src {hashes(styles)}; script-src {hashes(scripts)}; {OWN}"
    page = from_template(
        "web/templates/offline.html",
        title=title,
        language=language,
        policy=policy,
        styles=styles,
        body=body,
        scripts=scripts,
    )
    return f"{page}\n"


def hashes(texts: Sequence[str]) -> str:
    """The texts as a policy names them; 'none' without any."""
    return " ".join(map(named, texts)) or "'none'"


@lru_cache(maxsize=64)
def named(text: str) -> str:
    """The hash of a text, as a policy names it."""
    return f"'sha256-{b64encode(sha256(text.encode('utf-8')).digest()).decode('ascii')}'"


def data_block(name: str, value: Any) -> str:
    """Data that a script reads by its id; no text in it can end the block or begin a comment."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    text = text.replace("</", "<\\/").replace("<!", "\\u003c!")
    return f'<script type="application/json" id="{escape(name)}">{text}</script>'


@lru_cache(maxsize=32)
def part(name: str) -> str:
    """A file that a browser reads: a script or a style sheet."""
    return (WEB / name).read_text(encoding="utf-8")


# --- the scripts of pages: modules of the folder, each program bundled into one file --------------


BUNDLES = WEB / "bundles"
"""The bundles, which ``python -m tests.scripts`` makes from the modules beside them."""
STEP_PAGE, BOARD_PAGE, PLAYER, FORM = "step", "board", "player", "form"
"""The programs: a step page, the board of a task page, a cycle's page, a form for answers."""
MOVING, MOVING_CLOSED = "moving", "moving_closed"
"""What places the marks that follow a driver; the second closes groups of class III anew."""


@lru_cache(maxsize=8)
def bundled(program: str) -> str:
    """The script of a program; its names are hidden from the rest of the page."""
    return (BUNDLES / f"{program}.js").read_text(encoding="utf-8").strip()


# --- a field of a sheet as a picture in a page, in inks that follow the light and dark themes -----


WIDTH = re.compile(r"stroke-width:([\d.]+)")
THINNEST = 0.24
"""Least width of lines in mm, for screens coarser than paper."""
BAR = 20
"""Length of the bar of a field's scale, in mm of paper, until a script sets another."""


def field_picture(marks: Sequence[tuple[str, Timed]], rect: Rect, named_by: str) -> str:
    """The marks of a field, each under its id, as SVG in millimetres of the page.

    ``named_by`` is the id of the words that describe the picture.
    """
    left, top, right, bottom = rect
    box = " ".join(map(number, (left, top, right - left, bottom - top)))
    drawn = "\n".join(placed(name, timed) for name, timed in marks)
    return f'<svg viewBox="{box}" role="img" aria-labelledby="{named_by}">\n{drawn}\n</svg>'


def bar_rules(fields: str, rects: Sequence[Rect]) -> Iterator[str]:
    """The style rules for the scale bars of fields side by side: width and height of each."""
    for place, (left, top, right, bottom) in enumerate(rects, 1):
        box = f"--bar:{BAR};--wide:{number(right - left)};--high:{number(bottom - top)}"
        yield f"{fields}>:nth-child({place}){{{box}}}"


def placed(name: str, timed: Timed) -> str:
    """A mark with its id, the sentence that draws it, and the step that it shows.

    A mark without an id belongs to a picture within the picture.
    """
    own = f' id="{name}"' if name else " data-aside"
    of = f' data-of="{timed.step}"' if timed.step is not None else ""
    plain = replace(timed, mark=replace(timed.mark, step=None))
    written = drawn_mark(plain).replace(" ", f'{own} data-at="{timed.at}"{of} ', 1)
    return f'<g class="lettering">{written}</g>' if isinstance(timed.mark, Text) else written


def drawn_mark(timed: Timed) -> str:
    """A mark; in a label that several letters share, each letter appears with its own sentence."""
    if not timed.letters or not isinstance(timed.mark, Text):
        return element(timed.mark)
    parts = zip(timed.mark.letters, timed.letters, strict=True)
    return parted_text(timed.mark, [(letter.joined, f'data-from="{at}"') for letter, at in parts])


def ink_sheet(marks: Iterable[Mark], ink: Ink) -> str:
    """The style sheet of some marks, with fonts. A shaft keeps its width while it moves."""
    marks = [replace(mark, cls=mark.cls.removesuffix(f" {BRIEF}")) for mark in marks]
    return "\n".join(
        (font_face(False), font_face(True), LETTERING, *map(themed, shared_rules(marks, ink)))
    )


def themed(rule: str) -> str:
    """A style rule in inks that follow the light and dark themes, with scalable line widths."""
    return WIDTH.sub(
        lambda found: f"stroke-width:calc({max(float(found[1]), THINNEST):g}px*var(--w))",
        in_variables(rule),
    )
