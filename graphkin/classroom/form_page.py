"""The form of a lab on a page: what a student fills in, saved as the file that is marked.

Nothing is sent anywhere and nothing of the key is in it; a browser keeps what was written, and a
button saves it as the CSV file that ``graphkin grade`` reads. The markup holds neither scripts nor
styles of its own: a page puts ``style()`` and ``script()`` where its policy lets them be.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from html import escape
from itertools import groupby

from graphkin.classroom.grading.answer_numbers import LONGEST, MISTYPED, NUMBER, UNITS
from graphkin.classroom.lab.items import items as fields_of
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.printing.answer_form import advice, why
from graphkin.construction.core.quantities import BY_TARGET, RATES, SHEETS
from graphkin.mechanism import Mechanism
from graphkin.text import Words
from graphkin.web.offline_page import part
from graphkin.web.scripts import FORM, together
from graphkin.writers.html_markup import marked_up


@dataclass(frozen=True, slots=True)
class Identity:
    """Whose a form is: the id as the class list has it, and the name that is shown beside it.

    Without an id the student writes it in. ``stem`` begins the name of the saved file; ``memory``
    tells this form from others that the same browser keeps, copies elsewhere by their addresses.
    """

    stem: str
    memory: str
    id: str = ""
    name: str = ""


KINDS = {"segment": "answers.measured", "value": "answers.computed", "place": "answers.placed"}
"""What is said beside the symbol of each kind of field."""
TURNING, ALONG = ("ccw", "cw"), ("forward", "backward")
"""How a file says the senses of a turning link and of a block, the positive one first."""
SAID = (
    "answers.saved",
    "answers.empty",
    "answers.unread",
    "answers.no_number",
    "answers.no_unit",
    "answers.too_large",
    "answers.no_sense",
    "answers.no_id",
    "answers.opened",
    "answers.other",
    "answers.no_file",
    "answers.strange",
    "answers.replace",
    "answers.sure",
    "answers.cleared",
    "answers.kept",
    "answers.lost",
)
"""The sentences that the script says."""
LARGEST = 200
"""Characters that a field takes; what is longer than a number is told, not cut."""


def form_fragment(
    items: Sequence[Item],
    points: Mapping[str, Fraction],
    compute: Collection[str],
    words: Words,
    identity: Identity,
    pivot: str = "",
) -> str:
    """The form as markup: a labelled field for every item, those in ``compute`` to be reckoned.

    ``points`` are shown where the rubric gives any; ``pivot`` is the first fixed one, from which
    places are measured.
    """
    told = escape(json.dumps(settings(items, words, identity), ensure_ascii=False))
    lines = [
        f'<form class="answers" aria-labelledby="answers-title" autocomplete="off" novalidate'
        f' data-form="{told}">',
        f'<h2 id="answers-title">{escape(words("form.title"))}</h2>',
        *(f"<p>{marked_up(line)}</p>" for line in advice(items, words, pivot)),
        f"<noscript><p>{escape(words('answers.no_script'))}</p></noscript>",
        *owner(words, identity),
    ]
    for sheet in SHEETS:
        own = [item for item in items if sheet_of(item) == sheet]
        lines += group(words(f"sheet.{sheet}"), own, points, compute, words) if own else []
    return "\n".join([*lines, *buttons(words), "</form>"])


def settings(items: Sequence[Item], words: Words, identity: Identity) -> dict[str, object]:
    """What the script has to know: whose form it is, how numbers are read, what it says."""
    return {
        "id": identity.id,
        "stem": identity.stem,
        "memory": identity.memory,
        "separator": ";" if words("decimal_mark") == "," else ",",
        "number": NUMBER.pattern.replace("(?P<", "(?<"),
        "mistyped": MISTYPED.pattern,
        "longest": LONGEST,
        "units": {unit: UNITS.get(unit, {unit: 1}) for unit in sorted({i.unit for i in items})},
        "sense": words("table.sense"),
        "words": {key.partition(".")[2]: words.sentences[key] for key in SAID},
    }


def owner(words: Words, identity: Identity) -> Iterator[str]:
    """Whose the answers are, or the field for the id where the page is nobody's own."""
    if identity.id:
        shown = " – ".join(part for part in (identity.name, identity.id) if part)
        yield f'<p class="owner">{escape(shown)}</p>'
        return
    yield '<div class="answer"><label for="answers-id">' + escape(words("answers.id")) + "</label>"
    yield f'<input id="answers-id" type="text" maxlength="{LARGEST}" spellcheck="false"'
    yield ' autocapitalize="off" aria-describedby="answers-id-wrong" required>'
    yield '<p class="wrong" id="answers-id-wrong" aria-live="polite"></p></div>'


def sheet_of(item: Item) -> str:
    """The sheet off which an item is read; for an arrow the one that its letter names."""
    if item.quantity in BY_TARGET:
        return BY_TARGET[item.quantity].kind
    return "velocity" if item.of.startswith("v") else "acceleration"


def group(
    title: str,
    items: Sequence[Item],
    points: Mapping[str, Fraction],
    compute: Collection[str],
    words: Words,
) -> Iterator[str]:
    """The fields of one sheet."""
    yield f"<fieldset><legend>{escape(title)}</legend>"
    for _, alike in groupby(items, lambda item: (item.quantity, item.of)):
        yield '<div class="answers-of">'
        for item in alike:
            yield from field(item, points.get(item.field), item.field in compute, words)
        yield "</div>"
    yield "</fieldset>"


def field(item: Item, worth: Fraction | None, computed: bool, words: Words) -> Iterator[str]:
    """One field: its label, where it is written, its unit, its points, and room for a message."""
    name = f"answer-{escape(item.field)}"
    said = words("table.sense") if item.what == "sense" else words(KINDS[item.what])
    symbol = f'<span class="symbol">{marked_up(item.symbol)}</span>'
    what = ", ".join(filter(None, (symbol, escape(said), escape(item.unit))))
    hint = why(item, words) if computed else ""
    more = f"{words('form.points')}: {words.decimal(f'{float(worth):.4g}')}" if worth else ""
    about = f'id="{name}" name="{escape(item.field)}" aria-describedby="{name}-more {name}-wrong"'
    yield f'<div class="answer"><label for="{name}">{what}</label>'
    if item.what == "sense":
        yield f"<select {about}>{''.join(senses(item, words))}</select>"
    else:
        yield f'<input {about} type="text" inputmode="decimal" maxlength="{LARGEST}"'
        yield f' spellcheck="false" autocapitalize="off" data-unit="{escape(item.unit)}">'
    shown = "; ".join(escape(text) for text in (item.field, hint, more) if text)
    yield f'<p class="more" id="{name}-more">{shown}</p>'
    yield f'<p class="wrong" id="{name}-wrong" aria-live="polite"></p></div>'


def senses(item: Item, words: Words) -> Iterator[str]:
    """The senses of a field to choose from, and none."""
    turning = BY_TARGET.get(item.quantity) in RATES
    keys = ("anticlockwise", "clockwise") if turning else ("forward", "backward")
    yield f'<option value="">{escape(words("answers.none"))}</option>'
    for value, key in zip(TURNING if turning else ALONG, keys, strict=True):
        yield f'<option value="{value}">{escape(words(f"feedback.{key}"))}</option>'


def buttons(words: Words) -> Iterator[str]:
    """What saves, opens and clears; hidden until the script is there."""
    yield '<div class="buttons" hidden>'
    yield f'<button type="button" class="save">{escape(words("answers.save"))}</button>'
    yield f'<button type="button" class="open">{escape(words("answers.open"))}</button>'
    yield f'<button type="button" class="clear">{escape(words("answers.clear"))}</button>'
    yield '<input class="file" type="file" accept=".csv,text/csv" hidden></div>'
    yield '<p class="status" role="status"></p>'
    yield f'<p class="more">{escape(words("answers.nothing_sent"))}</p>'


def lab_form(mechanism: Mechanism, lab: Lab, words: Words, identity: Identity) -> str:
    """The form of a lab's own scene, with whatever data it is set; nobody's own in particular."""
    fields, points = fields_of(mechanism, lab), lab.rubric.points
    return form_fragment(fields, points, (), words, identity, first_pivot(mechanism))


def first_pivot(mechanism: Mechanism) -> str:
    """The fixed point from which places are measured; empty where there is none."""
    return next(iter(mechanism.scene.frame.points), "")


def style() -> str:
    """The rules of the form, for a <style> of its page."""
    return part("form.css")


def script() -> str:
    """What reads, keeps, saves and opens answers, for a <script> after the form."""
    return together(FORM)
