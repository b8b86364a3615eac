"""The smallest change of one number of a scene with which a formula is fair to all its numbers."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.lab.fairness import judged
from graphkin.classroom.lab.lab_model import Lab
from graphkin.classroom.lab.lab_trial import LabTrial
from graphkin.scene.model import DRIVEN, JOINED
from graphkin.text.errors import GraphkinError

CHANGES = (1, 2, 3, 5, 8, 12)
"""Changes in percent that are tried, the smallest first, up before down."""
NUMBER = re.compile(r"(?<![\w.\"-])\d+(?:\.\d+)?(?![\w.])")
SECTION = re.compile(r"\s*\[+\s*(\w+)")
CHANGED = ("frame", "links", "drivers")
"""The tables whose numbers are lengths, places and laws of the driver."""
VALUE = re.compile(r"\s*(?:\{\s*value\s*=\s*)?[\d.]+")
"""The value of a parameter as far as it is a plain number."""
FIXED = re.compile(rf"\s*({'|'.join(('on', 'against', *DRIVEN, *JOINED))})\s*=")
"""Keys whose numbers name links, or count teeth."""


class Mending(Struct, frozen=True):
    """A number of a scene in its line, from 1, and column, from 0, what it may become, and by how
    many percent that differs."""

    line: int
    column: int
    text: str
    old: str
    new: str
    percent: float


def mended(lab: Lab, outcome: LabTrial) -> Mending | None:
    """The smallest change that is fair to all numbers that were tried; None where none was found.

    One number is changed by some percent at a time, rounded to three digits.
    """
    text = lab.scene.read_text(encoding="utf-8")
    with TemporaryDirectory() as folder:
        path = Path(folder) / lab.scene.name
        for change in CHANGES:
            for mending, changed in candidates(text, change, lab.rule.settings):
                path.write_text(changed, encoding="utf-8")
                if is_fair(replace(lab, scene=path), outcome):
                    return mending
    return None


def is_fair(lab: Lab, outcome: LabTrial) -> bool:
    """Whether a scene is fair to all of the variants on which a lab was tried."""
    try:
        return bool(judged(lab, outcome.many).fair.all())
    except GraphkinError:
        return False


def candidates(
    text: str, change: float, given: Collection[str] = ()
) -> Iterator[tuple[Mending, str]]:
    """Every scene with one of its numbers larger or smaller by some percent; also of parameters
    that are not ``given`` to each student the value that all have.
    """
    lines, section = text.split("\n"), ""
    for row, line in enumerate(lines):
        if found := SECTION.match(line):
            section = found[1]
        key, equals, value = line.partition("=")
        shared = section == "parameters" and key.strip() not in given
        if not (section in CHANGED or shared) or not equals or FIXED.match(line):
            continue
        stated = value.partition("#")[0]
        if shared:
            found = VALUE.match(stated)
            stated = found[0] if found else ""
        for number in NUMBER.finditer(stated):
            for factor in (1 + change / 100, 1 - change / 100):
                old, new = number[0], f"{float(number[0]) * factor:.3g}"
                if float(new) == float(old):
                    continue
                start = len(key) + 1 + number.start()
                changed = line[:start] + new + line[start + len(old) :]
                percent = 100 * (float(new) / float(old) - 1)
                mending = Mending(row + 1, start, line.partition("#")[0].strip(), old, new, percent)
                yield mending, "\n".join([*lines[:row], changed, *lines[row + 1 :]])
