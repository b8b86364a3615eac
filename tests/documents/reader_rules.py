"""What a reader does at which words: forms of sentences, with places for what they name."""

from __future__ import annotations

import re
from collections.abc import Callable

from tests.documents.printed_sheet import LINK, NAME, NUMBER, WHEEL, number
from tests.documents.ruler_and_compass import DefectError

VECTOR = r"[av]_\{[^}]*\}(?:\^\{[^}]*\})?"
TURNING = r"[ωε]_\{[^}]*\}"
# -- the rules ------------------------------------------------------------------------------------

Rule = Callable[..., None]
RULES: list[tuple[re.Pattern[str], Rule]] = []
KINDS = {
    "point": NAME,
    "number": NUMBER,
    "link": LINK,
    "wheel": WHEEL,
    "vector": VECTOR,
    "set": rf"(?:{NUMBER}·)?{VECTOR}(?:/{NUMBER})?",
    "times": rf"(?:{NUMBER}·)?",
    "segment": rf"(?:{NUMBER}·)?{NAME}{NAME}(?:/{NUMBER})?",
    "turning": (
        rf"{TURNING}(?: = (?:[^,;:]*? rad/s(?:\^\{{2\}})?|{VECTOR}/{NAME}{NAME}|{TURNING}))?"
    ),
}


def pattern(words: str) -> re.Pattern[str]:
    """A regular expression from words with ⟨places⟩: names of points unless a kind is told."""

    def place(match: re.Match[str]) -> str:
        name, _, kind = match[1].partition(":")
        return f"(?P<{name}>{KINDS[kind or 'point']})"

    return re.compile(re.sub(r"⟨([\w:]+)⟩", place, words))


def says(*forms: str) -> Callable[[Rule], Rule]:
    """Marks a method as what these words ask a hand to do."""

    def kept(rule: Rule) -> Rule:
        RULES.extend((pattern(form), rule) for form in forms)
        return rule

    return kept


SET = KINDS["set"]


def factored(words: str) -> tuple[float, str]:
    """How many times as long as in its plan what is set is taken, and what it is."""
    match = re.fullmatch(rf"(?:({NUMBER})·)?(.*?)(?:/({NUMBER}))?", words)
    assert match
    return number(match[1] or "1") / number(match[3] or "1"), match[2]


def agrees(size: float, told: str | None) -> None:
    """Raises DefectError where a length is not as long as the page tells besides."""
    if told and abs(size - number(told)) > max(0.1, size / 1000):
        raise DefectError(f"{told} mm is told of what is {size:.2f} mm long")


def times(words: str) -> float:
    """The number before a length that is taken so many times."""
    return number(words.removesuffix("·") or "1")
