"""The record of a class's data, as JSON: enough to derive every sheet again years later.

The manifest holds the rule as written, the course, and the lab's name with the hash of its text,
which is copied into the same folder. For each student it holds the id, the opaque code, the exact
parameters as text, and the number of draws. Tests derive the parameters again from the manifest
alone.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping, Sequence
from typing import Any

from graphkin.classroom.lab.lab_model import Lab, LabRule, Range, SeveralValues, ValueList
from graphkin.classroom.lab.rules import exact_text
from graphkin.classroom.variants.assign import Assigned

FORMAT = 1
"""The version of the manifest's format."""
MANIFEST, TABLE, COPY = "manifest.json", "variants.csv", "lab"
"""The files of a class folder, and the folder with the copy of its lab."""
CODE = 10
"""The length of an opaque code: 50 bits, so that two codes of a class agree once in 10⁹ classes."""


def manifest(
    lab: Lab,
    students: Sequence[Assigned],
    hashes: Mapping[str, str],
    roster: str,
    salt: str,
    language: str = "",
) -> dict[str, Any]:
    """The manifest of a class.

    ``hashes`` are those of scene.toml, lab.toml, the table and the roster. ``language`` is the
    language of the class's pages, if it is not the scene's.
    """
    import numpy

    from graphkin import __version__

    return {
        "format": FORMAT,
        "graphkin": __version__,
        "numpy": numpy.__version__,
        "lab": lab.name,
        "course": lab.rule.course,
        "rule": written_rule(lab.rule),
        "roster": roster,
        "sha256": dict(hashes),
        "salt": salt,
        **({"language": language} if language else {}),
        "students": [entry(each, salt) for each in students],
    }


def entry(each: Assigned, salt: str) -> dict[str, Any]:
    """The entry of one student in the manifest."""
    student = each.student
    return {
        "row": student.row,
        "number": student.number,
        "id": student.id,
        **({"owner": student.owner, "part": student.part} if student.owner else {}),
        "name": student.name,
        "group": student.group,
        "code": code(salt, student.id),
        "parameters": {name: exact_text(value) for name, value in each.settings.items()},
        "attempt": each.attempt,
        "status": each.status,
        "flattest_deg": rounded(each.flattest, 2),
        "shortest_mm": rounded(each.shortest, 2),
        "limits": [str(fault) for fault in each.faults],
        "compute": list(each.computed),
    }


def rounded(value: float | None, digits: int) -> float | None:
    """A rounded number, or None."""
    return None if value is None else round(value, digits)


def code(salt: str, student: str) -> str:
    """The opaque code of a student: ten base-32 digits of SHA-256 over salt and id."""
    digest = hashlib.sha256((salt + student).encode("utf-8")).digest()
    return base64.b32encode(digest).decode("ascii")[:CODE]


def written_rule(rule: LabRule) -> dict[str, Any]:
    """A rule as lab.toml writes it, numbers as exact texts."""
    formulas: dict[str, Any] = {
        "set": {name: formula.text for name, formula in rule.settings.items()}
    }
    if rule.positions is not None:
        formulas["positions"] = written_positions(rule.positions)
        if rule.is_drawn:
            formulas["tries"] = rule.tries
    if not rule.draws:
        return formulas
    draws = {name: written_draw(values) for name, values in rule.draws.items()}
    given = rule.settings or rule.positions is not None
    return {**(formulas if given else {}), "draw": draws, "tries": rule.tries}


def written_positions(several: SeveralValues) -> dict[str, Any]:
    """Several values of a parameter as lab.toml writes them, with the range from which they are."""
    if several.range is None:
        return {several.parameter: [each.text for each in several.formulas]}
    return {several.parameter: several.count, "of": written_draw(several.range)}


def written_draw(values: Range | ValueList) -> Any:
    """Drawn values as lab.toml writes them: the ends and step of a range, or a list of ranges."""
    if isinstance(values, ValueList):
        return [written_draw(part) for part in values.parts]
    ends = {"min": values.least, "max": values.most, "step": values.step}
    return {key: exact_text(end) for key, end in ends.items()}


def as_text(raw: Mapping[str, Any]) -> str:
    """A manifest as the text of its file."""
    return json.dumps(raw, indent=1, ensure_ascii=False) + "\n"
