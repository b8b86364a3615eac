"""Reads numbers and senses as students write them, in any language, or reports them unreadable."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Mapping
from math import pi

from graphkin.classroom.grading.graded import BLANK, Answer
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.quantities import CLOCKWISE
from graphkin.scene.quantity import FORCES, LENGTHS
from graphkin.text import UNIT_LETTERS


def words_in(text: str) -> frozenset[str]:
    return frozenset(text.split())


SIGNS = {
    +1: "+ +1 1 ↺ ⟲ ↶ plus piu pos poz positive positiv positivo positiva pozitiv pozitiva"
    " positif positiven positiver"
    " положительно положительное положительныи плюс",
    -1: "- -1 ↻ ⟳ ↷ minus meno neg negative negativ negativo negativa negatif negativen negativer"
    " отрицательно отрицательное отрицательныи минус",
}
"""The ways to write a sense of anything: counter-clockwise and along a guide are positive."""
TURNED = {
    +1: "ccw acw trig trigonometric trigonometrica trigonometrico levogiro levogira sinistrorso"
    " sinistrorsa links linksdrehend linksherum linksdrehung linkslauf trigonometrique"
    " trigo direct directe",
    -1: "cw clockwise orar orara orario oraria ceas ceasornic ceasornicului"
    " ceasului acelor orologio lancette destrogiro destrogira destrorso destrorsa uhrzeigersinn"
    " uhrzeiger uzs uz rechts rechtsdrehend rechtsherum rechtsdrehung rechtslauf horaire horario"
    " horaria aiguilles agujas manecillas dextrogiro dextrogira indirect indirecte retrograde"
    " часовои часов час чс",
}
"""Words for a sense of rotation, without diacritics."""
SLIDING = {
    +1: "forward forwards along lungo dupa inainte avanti away guide guides ghidaj ghidajului"
    " ghidajul guida vorwarts langs fuhrung avant long adelante largo guia вперед вдоль"
    " направляющеи",
    -1: "backward backwards back inapoi indietro towards toward ruckwarts arriere atras назад",
}
"""Words for a sense of sliding: along the guide, or against it."""
ROUND = words_in(
    "anti counter contra contrar contrara contro contrario contraria invers inversa inverso"
    " inversul opus opusa opposto opposta opposite against"
    " gegen entgegen inverse contraire против пр"
)
"""Words or prefixes that reverse the word after them."""
ANTI = "anti"
"""The token that replaces each word of ``ROUND``."""
FILLING = words_in(
    "a al ale ai de del della delle dell dei di da in nel nella l il la le lo se the of to its it"
    " sens sensul sensului senso sense direction direzione directie directia verso wise s sensu"
    " rotatie rotatia rotatiei rotazione rotation rot turns turning miscare miscarii ace lui"
    " pe per con cu alle all hand hands im den dem der die du en sentido hacia lo"
    " dans des les el las d une montre reloj math mathematisch mathematischen mathematischer"
    " mathematically matematic drehend herum drehung drehsinn sinn d mit"
    " по стрелке стрелки стр хода ходу направление"
)
"""Words that carry no sense."""
SHORT = {
    "or": "orar",
    "ant": "antiorar",
    "antior": "antiorar",
    "hor": "horaire",
    "antihor": "antihoraire",
    "clock": "clockwise",
    "anticl": "anticlockwise",
    "guzs": "gegenuzs",
}
"""Abbreviations and the words they stand for."""
BESIDE = re.compile(r"^\s*[+\-\N{MINUS SIGN}\N{EN DASH}]|\(\s*[+\-\N{MINUS SIGN}\N{EN DASH}]\s*\)")
"""A sign before words, or in brackets. It must agree with the words."""
SAID = {
    is_turning: {
        word: sign
        for table in (SIGNS, known)
        for sign, words in table.items()
        for word in words.split()
    }
    for is_turning, known in ((True, TURNED), (False, SLIDING))
}
"""The sign of each known word, for rotation (True) and for sliding (False)."""


def sense_of(text: str, *, turning: bool) -> int | None:
    """The sign of a sense, +1 or -1, written as a sign or in words; None where there is none.

    ``turning`` says whether the quantity turns or slides along a guide.
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
    """The sense that a bare sign states: +, -, +1 or an arrow; None for other text."""
    bare = re.sub(r"[\s()]", "", text).replace("\N{MINUS SIGN}", "-").replace("–", "-")
    return next((sign for sign, words in SIGNS.items() if bare in words.split()), None)


def plain_words(text: str) -> list[str]:
    """The words of a text without case, diacritics and punctuation; c.c.w. is one word."""
    spread = unicodedata.normalize("NFD", text.casefold())
    plain = "".join(sign for sign in spread if not unicodedata.combining(sign))
    plain = re.sub(r"\b([^\W\d_])\.\s?(?=[^\W\d_]\b)", r"\1", plain)
    return re.findall(r"[^\W_]+|[^\w\s.,;:()'’/-]+", plain)


def parts(word: str, said: Collection[str]) -> list[str]:
    """The parts of a word: ``ANTI`` where it reverses, then the word; empty for a filling word."""
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


ABOUT = r"(?:[~∼≈≃≅]|cc?a\.|circa)\s?"
SIGN = r"[+\-\u2212]"
NUMBER = re.compile(
    rf"(?:(?P<label>[^\W\d][\w']{{0,15}})\s?[=:~≈]\s?)?(?:{ABOUT})?(?P<sign>{SIGN}?)\s?"
    r"(?P<digits>"
    r"[1-9][0-9]{0,2}(?:(?P<part>[.,' \u00a0\u202f])[0-9]{3})(?:(?P=part)[0-9]{3})*"
    r"(?:(?!(?P=part))[.,][0-9]+(?![0-9.,]))"
    r"|[1-9][0-9]{0,2}(?:(?P<parts>[.,' \u00a0\u202f])[0-9]{3})(?:(?P=parts)[0-9]{3})+(?![0-9.,])"
    r"|[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)"
    rf"(?:(?:[eE]|\s?[*x×·]\s?10\s?(?:\^|\*\*)\s?\(?)(?P<power>{SIGN}?[0-9]{{1,3}})\)?"
    r"|\s?[*x×·]\s?10(?P<raised>[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]{1,3}))?"
)
"""A number in ASCII digits, with a point or a comma, and optionally a power of ten.

Thousands may be apart where the decimal mark, or more than one gap, leaves no doubt. The name of
the quantity, or a mark for "about", may come before the number.
"""
RAISED = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹\u2212", "+-0123456789-")
"""Superscripts, and the minus sign, in ASCII."""
LETTERS = {
    "omega": ("omega", "ω", "w"),
    "epsilon": ("epsilon", "ε", "eps", "alpha", "α"),
    "swing": ("swing", "psi", "ψ"),
}
"""How the names of quantities may begin in a cell; others by the letter that fields begin with."""
BLANKS = ("-", "–", "—", "--", "n/a", "n.a.", "na")
"""Text that means no answer. In a field for a sense, a single - is a sense."""
OPEN = "?"
"""The mark for a number that is not decided yet, as in a drawing still to be made."""
MISTYPED = re.compile(
    r"^[\s()\[\]^*·/-]*[0-9_']|[.,]|^[oOlI]+(?:[0-9\s]|$)|[A-Za-z](?![23](?![0-9]))[0-9]"
)
"""Text after a number that shows a typing mistake rather than a unit: 5o0 is not 5 of a unit.

Of digits after letters, only the powers 2 and 3 belong to units.
"""
GROUPED = re.compile(r"[1-9][0-9]{0,2}[.,][0-9]{3}")
"""Digits whose point or comma may separate thousands."""
LARGEST_ANSWER = 1e12
"""The upper limit of an answer in any unit of a field; a larger one is a typing mistake."""
LONGEST = 60
"""The most characters of an answer; longer text is not a number."""
TURNS_A_MINUTE = [
    "rev/min",
    "r/min",
    "rpm",
    "1/min",
    "min-1",
    "rot/min",
    "giri/min",
    "tr/min",
    "U/min",
]
"""How turns in a minute are written in English, Romanian, Italian, French and German."""
RUSSIAN = {written.casefold(): unit for unit, written in UNIT_LETTERS["ru"].items()} | {
    "сек": "s",
    "нм": "Nm",
}
"""The parts of units in Russian, in small letters."""
UNITS: dict[str, dict[str, float]] = {
    "mm": {"mm": 1, "cm": 10, "m": 1000, "in": 25.4},
    "rad/s": {
        "rad/s": 1,
        "1/s": 1,
        "s-1": 1,
        "rads-1": 1,
        "deg/s": pi / 180,
        "°/s": pi / 180,
        **dict.fromkeys(TURNS_A_MINUTE, pi / 30),
    },
    "°": {"°": 1, "deg": 1, "rad": 180 / pi},
    "rad/s²": {"rad/s2": 1, "1/s2": 1, "s-2": 1, "rads-2": 1, "deg/s2": pi / 180},
}
"""For each field's unit, the factors that convert the units students may write."""
METRIC = {each: float(size) for each, size in LENGTHS.items()}
UNITS |= {length: METRIC for length in LENGTHS if length != "mm"}
UNITS |= {
    f"{length}{per}": {f"{each}{written}": size for each, size in METRIC.items()} | {power: 1.0}
    for length in LENGTHS
    for per, written, power in (("/s", "/s", "ms-1"), ("/s²", "/s2", "ms-2"))
}
WRITTEN_FORCES = {each: float(size) for each, size in FORCES.items()} | {
    "kN": 1000.0,
    **dict.fromkeys(("lb", "lbs"), float(FORCES["lbf"])),
}
"""The units of forces that students may write, in newtons."""
MOMENTS = {
    f"{one}{dash}{other}": size * arm
    for force, size in WRITTEN_FORCES.items()
    for length, arm in METRIC.items()
    for one, other in ((force, length), (length, force))
    for dash in ("", "-")
    if one == force or force not in ("N", "kN")
}
"""The units of moments that students may write, in N·m: ft-lb is lbf·ft, but mN is none."""
UNITS |= dict.fromkeys(FORCES, WRITTEN_FORCES)
UNITS |= {f"{force}·{length}": MOMENTS for force in FORCES for length in LENGTHS}


def read_answer(text: str, item: Item) -> Answer:
    """The answer in a cell: blank, a value in the field's unit, or unreadable."""
    stripped = text.strip()
    if not stripped:
        return BLANK
    is_sense = item.what == "sense" and sense_of(stripped, turning=item.quantity in CLOCKWISE)
    if stripped.casefold() in BLANKS and not is_sense:
        return BLANK
    if item.what == "sense":
        return read_sense(text, stripped, item.quantity)
    return read_number(text, stripped, item)


def read_sense(text: str, stripped: str, quantity: str) -> Answer:
    """Read a sense written as a sign or a word, in any of the languages."""
    turning = quantity in CLOCKWISE
    known = sense_of(stripped, turning=turning) if len(stripped) <= LONGEST else None
    if known is None:
        known = sign_of_number(stripped)
    if known is None:
        return Answer(text, problem="turning" if turning else "sliding")
    return Answer(text, float(known), signed=True)


def sign_of_number(text: str) -> int | None:
    """The sign that is written before a number with any unit; None where there is none."""
    found = NUMBER.match(text) if len(text) <= LONGEST else None
    if found is None or not found["sign"] or not float(digits_of(found)):
        return None
    written = plain_unit(text[found.end() :])
    if written and all(factor_of(written, known) is None for known in UNITS.values()):
        return None
    return 1 if found["sign"] == "+" else -1


def digits_of(found: re.Match[str]) -> str:
    """The digits of a number with a decimal point, without gaps between thousands."""
    digits = found["digits"]
    for gap in (found["part"], found["parts"]):
        digits = digits.replace(gap, "") if gap else digits
    return digits.replace(",", ".")


def is_name_of(label: str, item: Item) -> bool:
    """Whether a label before a number may name the quantity of a field."""
    letter = item.name.partition("_")[0]
    return label.casefold().startswith(LETTERS.get(letter, (letter.casefold(),)))


def read_number(text: str, stripped: str, item: Item) -> Answer:
    """Read a number with a decimal point or comma and an optional unit; ? is an open answer."""
    if stripped == OPEN:
        return Answer(text, problem="open")
    found = NUMBER.match(stripped) if len(stripped) <= LONGEST else None
    if found is None or (found["label"] and not is_name_of(found["label"], item)):
        return Answer(text, problem="number")
    unit, rest = item.unit, stripped[found.end() :]
    written = plain_unit(rest)
    known = UNITS.get(unit, {unit: 1.0})
    factor = item.one if not written else factor_of(written, known)
    if factor is None:
        return Answer(text, problem="number" if MISTYPED.search(rest) else "unit")
    power = (found["power"] or found["raised"] or "0").translate(RAISED)
    value = float(f"{digits_of(found)}e{power}") * factor
    if not value < LARGEST_ANSWER:
        return Answer(text, problem="large")
    sign = found["sign"]
    value = value if sign in ("", "+") else -value
    in_groups = GROUPED.fullmatch(found["digits"]) and power == "0"
    grouped = 1000 * value if in_groups else None
    return Answer(text, value, signed=bool(sign), grouped=grouped)


def with_unit(text: str, unit: str) -> str:
    """A cell's text, with the unit of its column after a bare number."""
    return f"{text.strip()} {unit}" if unit and NUMBER.fullmatch(text.strip()) else text


def beyond_number(text: str) -> str:
    """The text after the leading number; all of the text where there is no number."""
    found = NUMBER.match(text.strip())
    return text.strip()[found.end() :].strip() if found else text.strip()


def rounding(answer: Answer) -> float:
    """The relative rounding error of a number: half a unit of its last digit."""
    found = NUMBER.match(answer.text.strip())
    if found is None:
        return 0.0
    digits = digits_of(found)
    size, places = float(digits), len(digits.partition(".")[2])
    return 0.5 * 10.0**-places / size if size else 0.0


def significant(answer: Answer) -> tuple[int, int]:
    """The fewest and the most significant digits that a number may have; zeros for no number.

    Zeros at the end of a whole number may be significant.
    """
    found = NUMBER.match(answer.text.strip())
    digits = digits_of(found) if found is not None else ""
    bare = digits.replace(".", "").lstrip("0")
    return len(bare) if "." in digits else len(bare.rstrip("0")), len(bare)


def plain_unit(text: str) -> str:
    """A unit without spaces, brackets and power signs, Russian ones in Latin letters.

    The stop, comma or semicolon after it is left out.
    """
    latin = re.sub(
        r"[А-Яа-я]+(?:-[А-Яа-я]+)?\.?",
        lambda part: RUSSIAN.get(part[0].rstrip(".").casefold(), part[0]),
        text,
    )
    plain = re.sub(r"[\s()\[\]^*·]", "", latin).translate(RAISED)
    return re.sub(r"(?<=\w)[.,;]$|^;$", "", plain.replace("sec", "s"))


def factor_of(written: str, known: Mapping[str, float]) -> float | None:
    """The factor of a unit in capital letters or small ones; None where it is not known."""
    return next((f for unit, f in known.items() if unit.casefold() == written.casefold()), None)


def shown_cell(text: str) -> str:
    """A cell's text for a message: at most 30 characters, all of them printable."""
    clean = "".join(sign if sign.isprintable() else "?" for sign in text)
    return clean if len(clean) <= 30 else clean[:29] + "…"
