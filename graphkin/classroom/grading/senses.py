"""Senses in words: which way something turns or slides, in English, Romanian and Italian.

A sense is a known word, perhaps after one that turns it round (*anti*, *counter*, *invers*,
*contro*), with what only fills the sentence left out: *în sensul acelor de ceasornic* is clockwise,
*invers acelor de ceasornic* is not. Words of a turning mean nothing of a sliding block, nor the
other way round, and left and right mean nothing of either.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection


def words_in(text: str) -> frozenset[str]:
    """The words of a text."""
    return frozenset(text.split())


SIGNS = {
    +1: "+ +1 1 ↺ ⟲ ↶ plus piu pos poz positive positiv positivo positiva pozitiv pozitiva",
    -1: "- -1 ↻ ⟳ ↷ minus meno neg negative negativ negativo negativa",
}
"""What says a sense of anything: counter-clockwise and along a guide are positive."""
TURNING = {
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
    for is_turning, known in ((True, TURNING), (False, SLIDING))
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
