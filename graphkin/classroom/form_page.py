"""The answer form of a lab for a web page: a student fills it in and saves the file to grade.

The form sends nothing anywhere and contains nothing of the key. The browser keeps what was typed,
and a button saves it as the CSV file that ``graphkin grade`` reads. The markup contains no scripts
and no styles: the page adds both where its security policy allows them.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from itertools import groupby

from msgspec import Struct

from graphkin.classroom.grading.answer_numbers import (
    BLANKS,
    LARGEST_ANSWER,
    LETTERS,
    LONGEST,
    MISTYPED,
    NUMBER,
    RAISED,
    RUSSIAN,
    UNITS,
)
from graphkin.classroom.lab.items import items as fields_of
from graphkin.classroom.lab.items import motion_of
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.printing.answer_form import advice, why
from graphkin.construction.core.quantities import CLOCKWISE, FORCE, SHEETS
from graphkin.mechanism import Mechanism
from graphkin.text import Words
from graphkin.web.offline_page import FORM, bundled, part
from graphkin.web.step_page import Form
from graphkin.writers.templates import from_template


class Identity(Struct, frozen=True):
    """The student a form belongs to: the id from the class list, and the name shown with the id.

    Without an id, the student types one in. ``stem`` begins the name of the saved file. ``memory``
    identifies this form among those that the same browser stores; their addresses distinguish
    copies of one form.
    """

    stem: str
    memory: str
    id: str = ""
    name: str = ""


KINDS = {"segment": "answers.measured", "value": "answers.computed", "place": "answers.placed"}
"""The key of the sentence next to the symbol, for each kind of field."""
TURNING, ALONG = ("ccw", "cw"), ("forward", "backward")
"""The senses of a turning link and of a block as the file writes them, the positive one first."""
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
"""The keys of the sentences that the script shows."""
LARGEST = 200
"""The number of characters a field accepts. A longer number gets a message and is not cut."""


def form_fragment(
    items: Sequence[Item],
    points: Mapping[str, Fraction],
    compute: Collection[str],
    words: Words,
    identity: Identity,
    pivot: str = "",
    *,
    says_right: bool = False,
) -> Form:
    """The form, its styles and its script: a labelled field for every item.

    Fields in ``compute`` are marked as computed. ``points`` are shown where the rubric gives any.
    ``pivot`` is the first fixed point, from which places are measured. With ``says_right`` the
    board of its page tells when a point is right.
    """
    sheets = []
    for sheet in (*SHEETS, FORCE):
        alike = groupby((item for item in items if motion_of(item).kind == sheet), kind_of)
        groups = [
            [field(item, points.get(item.field), item.field in compute, words) for item in own]
            for _, own in alike
        ]
        sheets += [(words(f"sheet.{sheet}"), groups)] if groups else []
    body = from_template(
        "classroom/templates/form.html",
        settings=json.dumps(settings(items, words, identity), ensure_ascii=False),
        advice=advice(items, words, pivot),
        identity=identity,
        largest=LARGEST,
        sheets=sheets,
        words=words,
    )
    return Form(body, part("form.css"), bundled(FORM), says_right)


def settings(items: Sequence[Item], words: Words, identity: Identity) -> dict[str, object]:
    """The settings of the script: the form's owner, how it reads numbers, and its sentences."""
    return {
        "id": identity.id,
        "stem": identity.stem,
        "memory": identity.memory,
        "separator": ";" if words("decimal_mark") == "," else ",",
        "number": in_javascript(NUMBER.pattern),
        "mistyped": MISTYPED.pattern,
        "raised": {chr(sign): chr(plain) for sign, plain in RAISED.items()},
        "russian": RUSSIAN,
        "letters": LETTERS,
        "blanks": BLANKS,
        "longest": LONGEST,
        "largest": LARGEST_ANSWER,
        "units": {unit: UNITS.get(unit, {unit: 1}) for unit in sorted({i.unit for i in items})},
        "sense": words("table.sense"),
        "words": {key.partition(".")[2]: words.sentences[key] for key in SAID},
    }


def kind_of(item: Item) -> tuple[str, str]:
    """The key by which fields are grouped on the form: the quantity, and its point or link."""
    return item.quantity, item.of


class FormField(Struct, frozen=True):
    """One field of the form: its item, label, hint, points, and the senses to choose from."""

    item: Item
    said: str
    hint: str
    worth: str
    senses: tuple[tuple[str, str], ...]


def field(item: Item, worth: Fraction | None, computed: bool, words: Words) -> FormField:
    """The field that asks for an item."""
    asks_sense, turning = item.what == "sense", item.quantity in CLOCKWISE
    keys = ("anticlockwise", "clockwise") if turning else ("forward", "backward")
    return FormField(
        item,
        words("table.sense") if asks_sense else words(KINDS[item.what]),
        why(item, words) if computed else "",
        f"{words('form.points')}: {words.decimal(f'{float(worth):.4g}')}" if worth else "",
        tuple(zip(TURNING if turning else ALONG, keys, strict=True)) if asks_sense else (),
    )


def lab_form(mechanism: Mechanism, lab: Lab, words: Words, identity: Identity) -> Form:
    """The form of a lab for its scene with the current data, not assigned to any student."""
    fields, points = fields_of(mechanism, lab), lab.rubric.points
    pivot, says_right = first_pivot(mechanism), lab.rubric.says_right
    return form_fragment(fields, points, (), words, identity, pivot, says_right=says_right)


def first_pivot(mechanism: Mechanism) -> str:
    """The fixed point from which places are measured; empty if the scene has none."""
    return next(iter(mechanism.scene.frame.points), "")


def in_javascript(pattern: str) -> str:
    """A regular expression with the named groups, and references to them, of JavaScript."""
    return re.sub(r"\(\?P=(\w+)\)", r"\\k<\1>", pattern.replace("(?P<", "(?<"))
