"""The page of the studio: its frame in the words of a language, and the text it begins with."""

from __future__ import annotations

import json
from functools import lru_cache

from graphkin import __version__
from graphkin.studio.look import spoken_in
from graphkin.studio.session import Opened
from graphkin.text import LANGUAGES, Words
from graphkin.writers.templates import from_template

SPOKEN = "studio."
"""How the keys of the studio's sentences begin: those that stand in the page or are said later."""
PLANS = ("sheet.velocity", "sheet.acceleration")


def page(opened: Opened, words: Words) -> str:
    """The whole page, to begin with a text; the words of all languages go with it."""
    spoken = {language: spoken_in(language) for language in LANGUAGES}
    said = {language: said_in(language) for language in LANGUAGES}
    start = {"language": words.language, "words": said}
    page = from_template(
        "studio/web/page.html",
        said=said[words.language],
        spoken=spoken,
        language=words.language,
        version=__version__,
        name=opened.name,
        mark=opened.mark,
        text=opened.text.removeprefix("\ufeff"),
        rules=opened.rules.removeprefix("\ufeff"),
        rules_mark=opened.rules_mark,
        gone=opened.gone,
        start=json.dumps(start, ensure_ascii=False),
    )
    return f"{page}\n"


@lru_cache(maxsize=8)
def said_in(language: str) -> dict[str, str]:
    """The sentences of the page in one language."""
    words = spoken_in(language)
    own = (key for key in words.sentences if key.startswith(SPOKEN))
    return {key: words.open(key) for key in (*own, *PLANS)}
