"""Problem messages in the language of a page: each English sentence is its own key.

An English sentence with filled gaps is matched with the templates of a language, and translated
with the same fillings. Fillings that are sentences themselves are translated, too.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cached_property, lru_cache
from pathlib import Path

from graphkin.text import LANGUAGES
from graphkin.text.errors import Problem

HERE = Path(__file__).resolve().parent
ENGLISH = "en"
GAP = re.compile(r"\{\d\}")
PARTS = (re.compile(r"; (?![^(]*\))"), re.compile(", "))
"""The separators of sentences, and of list members."""
WEAK = 4
"""The most letters of a template, such as "{1} or {2}", that needs translatable fillings."""
QUOTED = re.compile(r'"[^"]*"|\{.*?\}|\[.*?\]|\w+ = \S+')
WORD = re.compile(r"(?<![\w-])[a-z]{3,}(?![\w-])")
"""An English word, not one of TOML or a name."""
JOINED = re.compile(r"\b(di|a|da|su|in) (il|la|i|le|gli|l’)(?= |(?<=’))")
STEMS = {"di": "de", "a": "a", "da": "da", "su": "su", "in": "ne"}
ENDS = {"il": "l", "la": "lla", "i": "i", "le": "lle", "gli": "gli", "l’": "ll’"}
"""Endings that contract Italian prepositions with a following article: ``di il`` is ``del``."""
DEEPEST = 4
"""The depth to which fillings are translated."""


class Sentences:
    """The problem messages in one language."""

    def __init__(self, language: str) -> None:
        self.language = language

    @cached_property
    def templates(self) -> dict[str, str]:
        """The translations by their English sentences."""
        import tomllib

        text = (HERE / f"{self.language}.toml").read_text(encoding="utf-8")
        return dict(tomllib.loads(text))

    @cached_property
    def gapped(self) -> list[tuple[tuple[str, ...], str]]:
        """The templates with gaps: text between gaps, and the English sentence; longest first."""
        gapped = [(tuple(GAP.split(each)), each) for each in self.templates if GAP.search(each)]
        return sorted(gapped, key=lambda pair: -sum(map(len, pair[0])))

    def __call__(self, said: str) -> str:
        """An English sentence in this language, or unchanged if none fits."""
        found = self.said(said, 0)
        if self.language != "it" or found == said:
            return found
        return JOINED.sub(lambda match: STEMS[match[1]] + ENDS[match[2]], found)

    def said(self, said: str, depth: int) -> str:
        """A sentence or a part of one."""
        found = self.whole(said, depth)
        if found is not None:
            return found
        for sign in PARTS[: 2 if depth else 1]:
            parts = sign.split(said)
            if len(parts) > 1:
                return sign.pattern[:2].join(self.part(part, depth) for part in parts)
        return said

    def part(self, said: str, depth: int) -> str:
        """A part of a sentence, or the filling of a gap; a name is unchanged."""
        return self.said(said, depth + 1) if " " in said and depth < DEEPEST else said

    def whole(self, said: str, depth: int) -> str | None:
        """The sentence whose template fits, or None."""
        if said in self.templates:
            return self.templates[said]
        for between, template in self.gapped:
            if len(said) <= sum(map(len, between)) or not all(each in said for each in between):
                continue
            match = pattern(between).fullmatch(said)
            if match is None:
                continue
            fills = match.groups()
            weak = sum(character.isalpha() for each in between for character in each) <= WEAK
            if weak and not all(self.can_say(fill, depth) for fill in fills):
                continue
            names = GAP.findall(template)
            told = [self.part(fill, depth) for fill in fills]
            return filled(self.templates[template], dict(zip(names, told, strict=True)))
        return None

    def can_say(self, said: str, depth: int) -> bool:
        """Whether a text can be translated, or contains nothing to translate."""
        plain = " " not in said or not WORD.search(QUOTED.sub("", said))
        return plain or (depth < DEEPEST and self.whole(said, depth + 1) is not None)


def filled(template: str, fills: Mapping[str, str]) -> str:
    """A sentence with its gaps filled, each under its own name."""
    return GAP.sub(lambda gap: fills[gap[0]], template)


@lru_cache(maxsize=1024)
def pattern(between: tuple[str, ...]) -> re.Pattern[str]:
    """The pattern of a template: gaps are as short as possible and do not cross sentences."""
    return re.compile("((?:(?!; ).)+?)".join(map(re.escape, between)), re.DOTALL)


@lru_cache(maxsize=8)
def sentences(language: str) -> Sentences:
    """The messages of a language. Raises KeyError for one without any."""
    if language not in LANGUAGES or language == ENGLISH:
        raise KeyError(language)
    return Sentences(language)


def spoken(problem: Problem, language: str) -> Problem:
    """A problem in another language, with its hint as words."""
    if language == ENGLISH:
        return problem
    say = sentences(language)
    return Problem(
        say(problem.place), say(problem.found), say(problem.expected), say(str(problem.hint))
    )
