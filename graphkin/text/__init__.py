"""The sentences of steps, sheets and pages in each language, by key."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property, lru_cache
from math import floor, log10
from typing import Any

from graphkin.text.school_signs import USUAL, SchoolSigns

LANGUAGES = ("de", "en", "es", "fr", "it", "ro", "ru")
ENGLISH = "en"
"""The language of the sentences that another one does not have yet."""
MINUS = "\N{MINUS SIGN}"
IMPERIAL = ("in", "ft")
"""The units of length in which forces are in pounds, and results are printed if none are stated."""
MECHANICAL = {"kg·m²": "{force}·s²·{length}", "kg": "{force}·s²/{length}"}
"""The coherent units of inertia and mass in other units of length than metres."""
METRE = r"(?<![\w*{'’])m(?=/s|/mm|$)"
"""A metre in a unit: m, m/s, (m/s²)/mm, m/mm."""
NEWTON = r"(?<![\w*{{’]){N}(?=/{mm})"
"""A newton in the unit of a scale factor in a sentence, with the letters of the language."""
RATE = r"(?<![\w*{{'’]){m}(?=/{s})"
"""A metre in a unit in a sentence, with the letters of the language."""
UNIT_LETTERS: Mapping[str, Mapping[str, str]] = {
    "ru": {
        "mm": "мм",
        "cm": "см",
        "m": "м",
        "in": "дюйм",
        "ft": "фут",
        "rad": "рад",
        "deg": "град",
        "rev": "об",
        "min": "мин",
        "s": "с",
        "N": "Н",
        "kN": "кН",
        "kg": "кг",
        "lb": "фунт",
        "lbf": "фунт-сила",
    }
}
"""How languages write the parts of units: GOST 8.417-2002 has Cyrillic letters."""
NARROW = "\N{NARROW NO-BREAK SPACE}"
FRENCH = " (?=[;:?!»])|(?<=«) "
"""The blanks of a French sentence that end no line."""
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
EUPHONIC = r"(?<!\S)([ae]) (?=\*?(?i:\1))"
"""The Italian words for "to" and "and" before a word that begins with the same vowel."""


class Sentences(dict[str, str]):
    """The sentences of one language by key; one that it lacks is the English one."""

    def __missing__(self, key: str) -> str:
        said = words(ENGLISH).sentences
        if self is said or not dict.__contains__(said, key):
            raise KeyError(key)
        return said[key]


class Words:
    """The sentences of one language with the signs of a school, and its number format.

    ``length`` is the unit of length in results.
    """

    def __init__(self, language: str, signs: SchoolSigns = USUAL, length: str = "m") -> None:
        self.language = language
        self.signs = signs
        self.length = length

    def in_language(self, language: str) -> Words:
        """The sentences of another language with the same signs."""
        return words(language, self.signs, self.length)

    @cached_property
    def sentences(self) -> Sentences:
        """Every sentence by its key, read from its file on first use."""
        import tomllib
        from pathlib import Path

        text = (Path(__file__).parent / f"{self.language}.toml").read_text(encoding="utf-8")
        found = Sentences(
            (key, spaced(said) if self.language == "fr" else said)
            for key, said in flattened(tomllib.loads(text))
        )
        if self.signs is USUAL and self.length == "m":
            return found
        signed = {key: self.signs.in_sentence(said) for key, said in found.items()}
        rate = RATE.format(m=self.spelled("m"), s=self.spelled("s"))
        length = self.spelled(self.length)
        newton = NEWTON.format(N=self.spelled("N"), mm=self.spelled("mm"))
        return Sentences(
            {
                key: re.sub(newton, self.force, re.sub(rate, length, said))
                for key, said in signed.items()
            }
        )

    @property
    def force(self) -> str:
        """The unit of forces that goes with the unit of lengths."""
        return self.spelled("lbf" if self.length in IMPERIAL else "N")

    def unit(self, unit: str) -> str:
        """A unit of results, whose metres are these lengths: in/s for m/s, lbf·in for N·m."""
        if self.length == "m":
            return self.spelled(unit)
        own = MECHANICAL.get(unit, re.sub(METRE, self.length, unit))
        own = own.format(force="N", length=self.length)
        return self.spelled(re.sub(r"\bN\b", self.force, own))

    def spelled(self, unit: str) -> str:
        """A unit as it is in the letters of the language: мм/с for mm/s in Russian."""
        letters = UNIT_LETTERS.get(self.language)
        if letters is None:
            return unit
        return re.sub("[A-Za-z]+", lambda part: letters.get(part[0], part[0]), unit)

    def __call__(self, key: str, **fields: object) -> Markup:
        """The sentence under a key, with its fields filled in. Raises KeyError if it is missing."""
        said = self.sentences[key].format_map(fields)
        if self.language == "it":
            said = re.sub(EUPHONIC, r"\1d ", said)
        if not any(map(names_in, fields.values())):
            return Markup(said)
        return saying(said, *(fields[name] for name in self.gaps(key)))

    def gaps(self, key: str) -> frozenset[str]:
        """The names of the fields of a sentence."""
        return gaps_of(self.sentences[key])

    def open(self, key: str) -> str:
        """The sentence under a key, with its fields unchanged for a page to fill in."""
        return self(key, **{name: f"{{{name}}}" for name in self.gaps(key)})

    def clauses(self, parts: Iterable[str]) -> Markup:
        """Clauses in one sentence."""
        return self("clause_mark").join(parts)

    def has(self, key: str) -> bool:
        """Whether there is a sentence under a key."""
        return key in self.sentences or key in words(ENGLISH).sentences

    def decimal(self, text: str) -> str:
        """A number with a decimal point, in this language's format, with a true minus sign."""
        return text.replace("-", MINUS).replace(".", self.sentences["decimal_mark"])

    def place(self, x: str, y: str) -> str:
        """Both coordinates of a place, in brackets."""
        return f"({x}{self('place_mark')}{y})"

    def fixed(self, number: float, places: int) -> str:
        """A number with ``places`` decimals; a number that rounds to zero is 0."""
        rounded = round(number, places)
        return self.decimal(f"{rounded:.{places}f}") if rounded else "0"

    def significant(self, number: float, digits: int = 4) -> str:
        """A number rounded to significant digits, with a power of ten if it is far from one."""
        if number == 0:
            return "0"
        rounded = float(f"{number:.{digits - 1}e}")
        power = floor(log10(abs(rounded)))
        if -4 <= power < 6:
            return self.decimal(f"{rounded:.{max(digits - 1 - power, 0)}f}")
        mantissa = rounded / 10**power
        return (
            self.decimal(f"{mantissa:.{digits - 1}f}") + f"·10{str(power).translate(SUPERSCRIPTS)}"
        )


@lru_cache(maxsize=2048)
def gaps_of(sentence: str) -> frozenset[str]:
    """The names of a sentence's fields."""
    from string import Formatter

    return frozenset(name for _, name, _, _ in Formatter().parse(sentence) if name)


@lru_cache(maxsize=8)
def words(language: str, signs: SchoolSigns = USUAL, length: str = "m") -> Words:
    """The sentences of a language by its code. Raises KeyError for an unknown language."""
    if language not in LANGUAGES:
        raise KeyError(language)
    return Words(language, USUAL if signs == USUAL else signs, length)


def spaced(sentence: str) -> str:
    """A French sentence, whose blanks at ; : ? ! and inside « » are narrow and end no line."""
    return re.sub(FRENCH, NARROW, sentence)


def keys() -> list[str]:
    """The keys of all sentences."""
    return list(words(ENGLISH).sentences)


def untranslated(language: str) -> dict[str, str]:
    """The English sentences by key that a language does not have yet."""
    own = words(language).sentences
    return {key: said for key, said in words(ENGLISH).sentences.items() if key not in own}


def flattened(tree: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    """All sentences of a tree of tables, under dotted keys."""
    found: list[tuple[str, str]] = []
    for key, value in tree.items():
        if isinstance(value, Mapping):
            found += flattened(value, f"{prefix}{key}.")
        else:
            found.append((prefix + key, value))
    return found


class Markup(str):
    """Marked-up text with the ``names`` of the points and vectors whose symbols it contains.

    Sentences with fields, ``join`` and ``+`` keep the names of their parts; an f-string does not.
    """

    names: frozenset[str] = frozenset()

    def join(self, parts: Iterable[str], /) -> Markup:
        """Parts joined by this text."""
        every = tuple(parts)
        return saying(super().join(every), *every)

    def __add__(self, other: str) -> Markup:
        """This text followed by another."""
        return saying(super().__add__(other), self, other)


def saying(text: str, *parts: object) -> Markup:
    """Text made of parts, with all names of the parts."""
    said = Markup(text)
    said.names = frozenset[str]().union(*map(names_in, parts))
    return said


def names_in(text: object) -> frozenset[str]:
    """The names whose symbols a text contains; none if it is no markup."""
    return text.names if isinstance(text, Markup) else frozenset()


def as_text(value: object) -> str:
    """Markup as plain text, for encoders of records. Raises TypeError for anything else."""
    if isinstance(value, Markup):
        return str(value)
    raise TypeError(f"{type(value).__name__} is no text")


NOTHING = Markup()
"""The empty separator."""
COMMA = Markup(", ")
"""The separator of a list."""
EQUALS = Markup(" = ")
"""The separator of equal symbols."""
