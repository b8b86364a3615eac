"""The data of a class derived again from its manifest alone, as years later."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from graphkin.classroom.lab.lab_model import Lab, LabRule, Range, ValueList, exact_text, settings
from graphkin.classroom.roster.students import Student
from graphkin.scene.quantity import expression


def read_rule(raw: Mapping[str, Any]) -> LabRule:
    """The rule of a manifest."""
    rule = raw["rule"]
    formulas = {name: expression(text, counting=True) for name, text in rule.get("set", {}).items()}
    if "draw" not in rule:
        return LabRule(settings=formulas)
    draws = {name: read_draw(values) for name, values in rule["draw"].items()}
    return LabRule(raw["course"], draws, rule["tries"], formulas)


def read_draw(raw: Any) -> Range | ValueList:
    """What is drawn: a range, or a list of such."""
    if isinstance(raw, list):
        return ValueList(tuple(read_range(part) for part in raw))
    return read_range(raw)


def read_range(raw: Mapping[str, str]) -> Range:
    """A range from the texts of its ends."""
    return Range(*(Fraction(raw[key]) for key in ("min", "max", "step")))


def rederived(raw: Mapping[str, Any]) -> list[dict[str, str]]:
    """The exact parameters of every student, by the rule alone."""
    lab = Lab(raw["lab"], Path(), Path(), read_rule(raw))
    return [
        {
            name: exact_text(value)
            for name, value in settings(
                lab, Student(each["row"], each["id"], each["number"]), each["attempt"]
            ).items()
        }
        for each in raw["students"]
    ]
