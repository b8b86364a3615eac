"""Numbers and senses as students write them: read strictly, or told to be unreadable."""

from __future__ import annotations

import re
from math import isfinite, pi

from graphkin.classroom.grading.graded import BLANK, Answer
from graphkin.classroom.grading.senses import sense_of
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.quantities import TURNING

NUMBER = re.compile(
    r"(?:(?:[~∼≈≃≅]|cc?a\.|circa)\s?)?(?P<sign>[+\-\u2212]?)(?P<digits>[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)"
    r"(?:(?:[eE]|\s?[*x×·]\s?10\s?\^\s?)(?P<power>[+-]?[0-9]{1,3}))?"
)
"""A number in ASCII digits, with a point or a comma, perhaps with a power of ten.

That it is said to be about right changes nothing.
"""
BLANKS = ("-", "–", "—", "--", "n/a", "n.a.", "na")
"""What stands for no answer; a single - is a sense in a field of one."""
OPEN = "?"
"""What stands for a number that is not decided yet, as those of drawings that are still asked."""
MISTYPED = re.compile(
    r"^[\s()\[\]^*·/-]*[0-9_']|[.,]|^[oOlI]+(?:[0-9\s]|$)|[A-Za-z](?![23](?![0-9]))[0-9]"
)
"""What stands after the beginning of a number and is no unit: 5o0 is not 5 of something.

Of digits after letters only the powers 2 and 3 belong to units.
"""
LONGEST = 60
"""Characters of an answer; a longer one is no number."""
UNITS: dict[str, dict[str, float]] = {
    "mm": {"mm": 1, "cm": 10, "m": 1000, "in": 25.4},
    "m": {"m": 1, "cm": 0.01, "mm": 0.001, "in": 0.0254},
    "m/s": {"m/s": 1, "cm/s": 0.01, "mm/s": 0.001, "in/s": 0.0254, "ms-1": 1},
    "m/s²": {"m/s2": 1, "cm/s2": 0.01, "mm/s2": 0.001, "in/s2": 0.0254, "ms-2": 1},
    "rad/s": {
        "rad/s": 1,
        "1/s": 1,
        "s-1": 1,
        "rads-1": 1,
        "deg/s": pi / 180,
        "°/s": pi / 180,
        "rev/min": pi / 30,
        "rot/min": pi / 30,
        "giri/min": pi / 30,
        "rpm": pi / 30,
    },
    "rad/s²": {"rad/s2": 1, "1/s2": 1, "s-2": 1, "rads-2": 1, "deg/s2": pi / 180},
}
"""What units stand for in the unit of the field."""


def read_answer(text: str, item: Item) -> Answer:
    """The answer that a cell states to a field: blank, a value in its unit, or unreadable."""
    stripped = text.strip()
    if not stripped:
        return BLANK
    is_sense = item.what == "sense" and sense_of(stripped, turning=item.quantity in TURNING)
    if stripped.casefold() in BLANKS and not is_sense:
        return BLANK
    if item.what == "sense":
        return read_sense(text, stripped, item.quantity)
    return read_number(text, stripped, item.unit)


def read_sense(text: str, stripped: str, quantity: str) -> Answer:
    """A sense by sign or by word, in any of the languages."""
    turning = quantity in TURNING
    known = sense_of(stripped, turning=turning) if len(stripped) <= LONGEST else None
    if known is None:
        return Answer(text, problem="turning" if turning else "sliding")
    return Answer(text, float(known), signed=True)


def read_number(text: str, stripped: str, unit: str) -> Answer:
    """A number with a decimal point or comma, and its unit where one is written; ? is open."""
    if stripped == OPEN:
        return Answer(text, problem="open")
    found = NUMBER.match(stripped) if len(stripped) <= LONGEST else None
    if found is None:
        return Answer(text, problem="number")
    rest = stripped[found.end() :]
    written = plain_unit(rest)
    known = UNITS.get(unit, {unit: 1.0})
    factor = 1.0 if not written else known.get(written)
    if factor is None:
        return Answer(text, problem="number" if MISTYPED.search(rest) else "unit")
    digits = found["digits"].replace(",", ".")
    value = float(f"{digits}e{found['power'] or 0}") * factor
    if not isfinite(value):
        return Answer(text, problem="large")
    sign = found["sign"]
    return Answer(text, value if sign in ("", "+") else -value, signed=bool(sign))


def rounding(answer: Answer) -> float:
    """How far a number may be rounded, in parts of it: half a unit of its last digit."""
    found = NUMBER.match(answer.text.strip())
    if found is None:
        return 0.0
    digits = found["digits"].replace(",", ".")
    size, places = float(digits), len(digits.partition(".")[2])
    return 0.5 * 10.0**-places / size if size else 0.0


def plain_unit(text: str) -> str:
    """A unit without blanks, brackets and signs of a power."""
    return (
        re.sub(r"[\s()\[\]^*·]", "", text).replace("²", "2").replace("⁻¹", "-1").replace("−", "-")
    )


def shown(text: str) -> str:
    """A cell in a message: short, and without signs that steer a terminal."""
    clean = "".join(sign if sign.isprintable() else "?" for sign in text)
    return clean if len(clean) <= 30 else clean[:29] + "…"
