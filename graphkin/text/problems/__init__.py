"""Messages in the reader's language: the English template is the key of its translations."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from string import Formatter
from typing import Any

from graphkin.text import ENGLISH, LANGUAGES
from graphkin.text.errors import Message

PREPOSITION = re.compile(r"\b(di|a|da|su|in) $")
STEMS = {"di": "de", "a": "a", "da": "da", "su": "su", "in": "ne"}
ARTICLE = re.compile(r"(?:il|la|i|le|gli)(?= )|l’")
ENDS = {"il": "l", "la": "lla", "i": "i", "le": "lle", "gli": "gli", "l’": "ll’"}
"""Endings that contract Italian prepositions with a following article: ``di il`` is ``del``."""
FORMATTER = Formatter()


@lru_cache(maxsize=8)
def translations(language: str) -> Mapping[str, str]:
    """The templates of a language by their English; those that it lacks stay English.

    Raises KeyError for an unknown language.
    """
    import tomllib

    if language not in LANGUAGES:
        raise KeyError(language)
    if language == ENGLISH:
        return {}
    path = Path(__file__).parent / f"{language}.toml"
    return tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def spoken(said: str, language: str) -> str:
    """A message in a language, the user's own text as it is written; other texts unchanged."""
    if language == ENGLISH or not isinstance(said, Message):
        return str(said)
    sentence = ""
    for text, name, spec, conversion in FORMATTER.parse(in_language(said, language)):
        sentence += text
        if name is not None:
            field = said.fields[name]
            if isinstance(field, Message):
                own = spoken(field, language)
                if language == "it":
                    sentence, own = contracted(sentence, own, beginning(field, language))
                sentence += own
            else:
                shown: Any = FORMATTER.convert_field(field, conversion)
                sentence += format(shown, spec or "")
    return sentence


def in_language(said: Message, language: str) -> str:
    """The template of a message in a language; one without words is the same in each."""
    return translations(language).get(said.template, said.template)


def beginning(said: Message, language: str) -> str:
    """The words of the template with which a message begins, not those of the user."""
    for text, name, _, _ in FORMATTER.parse(in_language(said, language)):
        field = said.fields[name] if name is not None else None
        return text or (beginning(field, language) if isinstance(field, Message) else "")
    return ""


def contracted(before: str, after: str, begins: str) -> tuple[str, str]:
    """An Italian preposition joined with the article of the words that follow it."""
    preposition, article = PREPOSITION.search(before), ARTICLE.match(begins)
    if preposition is None or article is None:
        return before, after
    joint = STEMS[preposition[1]] + ENDS[article[0]]
    return before[: preposition.start()] + joint, after[article.end() :]
