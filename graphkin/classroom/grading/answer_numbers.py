"""Numbers and senses as students write them, in any language: read strictly, or told unreadable."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection
from math import pi

from graphkin.classroom.grading.graded import BLANK, Answer
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.quantities import TURNING


def words_in(text: str) -> frozenset[str]:
    """The words of a text."""
    return frozenset(text.split())


SIGNS = {
    +1: "+ +1 1 ↺ ⟲ ↶ plus piu pos poz positive positiv positivo positiva pozitiv pozitiva",
    -1: "- -1 ↻ ⟳ ↷ minus meno neg negative negativ negativo negativa",
}
"""What says a sense of anything: counter-clockwise and along a guide are positive."""
TURNED = {
    +1: "ccw acw trig trigonometric trigonometrica trigonometrico levogiro levogira sinistrorso"
    " sinistrorsa",
    -1: "cw clockwise orar orara orario oraria ceas ceasornic ceasornicului"
    " ceasului acelor orologio lancette destrogiro destrogira destrorso destrorsa",
}
"""Words for the way something turns, without diacritics."""
SLIDING = {
    +1: "forward forwards along lungo dupa inainte avanti away guide guides ghidaj ghidajului"
    " ghidajul guida",
    -1: "backward backwards back inapoi indietro towards toward",
}
"""Words for the way a block slides: along its guide, or against it."""
ROUND = words_in(
    "anti counter contra contrar contrara contro contrario contraria invers inversa inverso"
    " inversul opus opusa opposto opposta opposite against"
)
"""Words, or beginnings of words, that turn the next one round."""
ANTI = "anti"
"""What stands for each of them."""
FILLING = words_in(
    "a al ale ai de del della delle dell dei di da in nel nella l il la le lo se the of to its it"
    " sens sensul sensului senso sense direction direzione directie directia verso wise s sensu"
    " rotatie rotatia rotatiei rotazione rotation rot turns turning miscare miscarii ace lui"
    " pe per con cu alle all hand hands"
)
"""Words that say nothing of the sense."""
SHORT = {"or": "orar", "ant": "antiorar", "antior": "antiorar", "anticl": "anticlockwise"}
"""What is cut short."""
BESIDE = re.compile(r"^\s*[+\-\N{MINUS SIGN}\N{EN DASH}]|\(\s*[+\-\N{MINUS SIGN}\N{EN DASH}]\s*\)")
"""A sign before words, or in brackets, which must say the same."""
SAID = {
    is_turning: {
        word: sign
        for table in (SIGNS, known)
        for sign, words in table.items()
        for word in words.split()
    }
    for is_turning, known in ((True, TURNED), (False, SLIDING))
}
"""The sign of each known word, of a turning or not."""


def sense_of(text: str, *, turning: bool) -> int | None:
    """The sign of a sense, +1 or -1, by a sign or by words; None where it says none.

    ``turning`` tells what it is the sense of: something that turns, or slides along a guide.
    """
    found = signed(text)
    if found is not None:
        return found
    sign = BESIDE.search(text)
    if sign is not None and any(map(str.isalpha, text)):
        said_too = sense_of(BESIDE.sub(" ", text, count=1), turning=turning)
        return said_too if said_too == signed(sign[0]) else None
    said = SAID[turning]
    words = [part for word in plain_words(text) for part in parts(word, said)]
    if any(word not in said and word != ANTI for word in words):
        return None
    signs = {said[word] for word in words if word != ANTI}
    turned = words.count(ANTI)
    if len(signs) != 1 or turned > 1:
        return None
    return signs.pop() * (-1 if turned else 1)


def signed(text: str) -> int | None:
    """The sense that a mere sign states: +, -, +1, an arrow."""
    bare = re.sub(r"[\s()]", "", text).replace("\N{MINUS SIGN}", "-").replace("–", "-")
    return next((sign for sign, words in SIGNS.items() if bare in words.split()), None)


def plain_words(text: str) -> list[str]:
    """The words of a text without case, diacritics and signs; c.c.w. is one word."""
    spread = unicodedata.normalize("NFD", text.casefold())
    plain = "".join(sign for sign in spread if not unicodedata.combining(sign))
    plain = re.sub(r"\b([a-z])\.\s?(?=[a-z]\b)", r"\1", plain)
    return re.findall(r"[^\W_]+|[^\w\s.,;:()'’/-]+", plain)


def parts(word: str, said: Collection[str]) -> list[str]:
    """A word taken apart: what turns it round, then itself; nothing where it only fills."""
    word = SHORT.get(word, word)
    if word in ROUND:
        return [ANTI]
    if word in said:
        return [word]
    if word in FILLING:
        return []
    for start in ROUND:
        rest = word.removeprefix(start)
        if rest != word and rest in said:
            return [ANTI, rest]
    return [word]


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
GROUPED = re.compile(r"[1-9][0-9]{0,2}[.,][0-9]{3}")
"""Digits whose point or comma may part thousands."""
LARGEST_ANSWER = 1e12
"""No answer is that large in any unit of a field; a larger one is a mistake in typing."""
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
    if not value < LARGEST_ANSWER:
        return Answer(text, problem="large")
    sign = found["sign"]
    value = value if sign in ("", "+") else -value
    in_groups = GROUPED.fullmatch(found["digits"]) and not found["power"]
    grouped = 1000 * value if in_groups else None
    return Answer(text, value, signed=bool(sign), grouped=grouped)


def beyond_number(text: str) -> str:
    """What stands after the number with which a text begins; all of it where none does."""
    found = NUMBER.match(text.strip())
    return text.strip()[found.end() :].strip() if found else text.strip()


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


def shown_cell(text: str) -> str:
    """A cell in a message: short, and without signs that steer a terminal."""
    clean = "".join(sign if sign.isprintable() else "?" for sign in text)
    return clean if len(clean) <= 30 else clean[:29] + "…"
