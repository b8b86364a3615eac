"""The form of a lab on a page: what a student fills in, saved as the file that is marked.

Nothing is sent anywhere and nothing of the key is in it; a browser keeps what was written, and a
button saves it as the CSV file that ``graphkin grade`` reads. The markup holds neither scripts nor
styles of its own: a page puts these where its policy lets them be.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from itertools import groupby

from msgspec import Struct

from graphkin.classroom.grading.answer_numbers import (
    BLANKS,
    LARGEST_ANSWER,
    LONGEST,
    MISTYPED,
    NUMBER,
    UNITS,
)
from graphkin.classroom.lab.items import items as fields_of
from graphkin.classroom.lab.items import motion_of
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.printing.answer_form import advice, why
from graphkin.construction.core.quantities import BY_TARGET, RATES, SHEETS
from graphkin.mechanism import Mechanism
from graphkin.text import Words
from graphkin.web.offline_page import FORM, part, together
from graphkin.web.step_page import Form
from graphkin.writers.templates import from_template


class Identity(Struct, frozen=True):
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
) -> Form:
    """The form, its rules and its script: a labelled field for every item, those in ``compute`` to
    be reckoned.

    ``points`` are shown where the rubric gives any; ``pivot`` is the first fixed one, from which
    places are measured.
    """
    sheets = []
    for sheet in SHEETS:
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
    return Form(body, part("form.css"), together(FORM))


def settings(items: Sequence[Item], words: Words, identity: Identity) -> dict[str, object]:
    """What the script has to know: whose form it is, how numbers are read, what it says."""
    return {
        "id": identity.id,
        "stem": identity.stem,
        "memory": identity.memory,
        "separator": ";" if words("decimal_mark") == "," else ",",
        "number": NUMBER.pattern.replace("(?P<", "(?<"),
        "mistyped": MISTYPED.pattern,
        "blanks": BLANKS,
        "longest": LONGEST,
        "largest": LARGEST_ANSWER,
        "units": {unit: UNITS.get(unit, {unit: 1}) for unit in sorted({i.unit for i in items})},
        "sense": words("table.sense"),
        "words": {key.partition(".")[2]: words.sentences[key] for key in SAID},
    }


def kind_of(item: Item) -> tuple[str, str]:
    """What stands together on the form: what is asked of one thing."""
    return item.quantity, item.of


class FormField(Struct, frozen=True):
    """One field: its item, what is said of it, its points, and the senses to choose from."""

    item: Item
    said: str
    hint: str
    worth: str
    senses: tuple[tuple[str, str], ...]


def field(item: Item, worth: Fraction | None, computed: bool, words: Words) -> FormField:
    """How an item is asked for."""
    asks_sense, turning = item.what == "sense", BY_TARGET.get(item.quantity) in RATES
    keys = ("anticlockwise", "clockwise") if turning else ("forward", "backward")
    return FormField(
        item,
        words("table.sense") if asks_sense else words(KINDS[item.what]),
        why(item, words) if computed else "",
        f"{words('form.points')}: {words.decimal(f'{float(worth):.4g}')}" if worth else "",
        tuple(zip(TURNING if turning else ALONG, keys, strict=True)) if asks_sense else (),
    )


def lab_form(mechanism: Mechanism, lab: Lab, words: Words, identity: Identity) -> Form:
    """The form of a lab's own scene, with whatever data it is set; nobody's own in particular."""
    fields, points = fields_of(mechanism, lab), lab.rubric.points
    return form_fragment(fields, points, (), words, identity, first_pivot(mechanism))


def first_pivot(mechanism: Mechanism) -> str:
    """The fixed point from which places are measured; empty where there is none."""
    return next(iter(mechanism.scene.frame.points), "")
