"""A school's conventions: the keys of house.toml, listed once, and the record that they give."""

from __future__ import annotations

import re

from graphkin.scene.findings import Findings, Table, listed, nearest, shown
from graphkin.text.errors import NO_WORDS, message
from graphkin.text.school_signs import NAMES, SCHOOLS, USUAL, SchoolSigns

SET = "set"
"""The key of a set of signs, beside those of single signs."""
SIGN = re.compile(r"[A-Za-zα-ωΑ-Ω]{1,4}(_[A-Za-z0-9α-ω]{1,3})?[′']?")
"""A sign as it is written: letters, perhaps an index after an underscore, perhaps a prime."""


def read_signs(holder: Table, key: str, default: SchoolSigns = USUAL) -> SchoolSigns:
    """The signs under a key: the name of a school's set, or a table of a set and single signs.

    The set of signs is ``default`` where none is named.
    """
    if isinstance(holder.raw.get(key), str):
        holder.known.append(key)
        return school_set(holder.at(key), holder.raw[key], holder.findings, default)
    table = holder.table(key)
    raw = table.take(SET)
    base = default if raw is None else school_set(table.at(SET), raw, table.findings, default)
    own = {name: getattr(base, name) for name in NAMES}
    for name in NAMES:
        sign = table.text(name)
        if sign and not SIGN.fullmatch(sign):
            expected = message("one to four letters, such as {sign}", sign=getattr(USUAL, name))
            table.findings.add(table.at(name), shown(sign), expected)
        elif sign:
            own[name] = sign.replace("'", "′")
    table.finish()
    return SchoolSigns(**own)


def school_set(place: str, raw: object, findings: Findings, default: SchoolSigns) -> SchoolSigns:
    """The set of signs of a school's name."""
    if isinstance(raw, str) and raw in SCHOOLS:
        return SCHOOLS[raw].signs
    hint = nearest(raw, SCHOOLS) if isinstance(raw, str) else NO_WORDS
    findings.add(place, shown(raw), listed(SCHOOLS), hint)
    return default
