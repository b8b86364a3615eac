"""Mistakes are told in the language of the page: whatever `check` says has words in each."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from graphkin.scene import file_limits
from graphkin.scene.model import LEADING, LINK_KEYS
from graphkin.text.errors import Mend, Problem
from graphkin.text.problems import GAP, sentences, spoken
from tests.studio.pump import PUMP, desk_in, ordered, seen

ROOT = Path(__file__).resolve().parents[2] / "graphkin"
KEPT = Path(__file__).resolve().parents[1] / "golden" / "kept"
ROOMS = (
    "scene",
    "structure",
    "loops",
    "construction",
    "diagnosis",
    "studio",
    "documents",
    "drawing",
)
ENGLISH = re.compile(
    r"\b(?:the|is|of|and|not|which|with|than|has|have|that|these|does|one|another|give|write|take)\b"
)
CODE = re.compile(r'"[^"]*"|\{[^{}]*\}|\[[^]]*\]')
CONSTANT = {"LEADING": LEADING, "LINK_KEYS": LINK_KEYS}
FOREIGN = ("it", "ro")


@cache
def literals() -> frozenset[str]:
    """The texts of all problems that are written out where they are made, gaps as X1, X2."""
    found: set[str] = set()
    for room in ROOMS:
        for path in sorted((ROOT / room).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call) and ast.unparse(node.func).endswith(
                    ("Problem", "findings.add")
                ):
                    said = [
                        k.value for k in node.keywords if k.arg in ("found", "expected", "hint")
                    ]
                    found.update(filter(None, map(text_of, [*node.args[1:], *said])))
    return frozenset(found)


def text_of(node: ast.expr) -> str | None:
    """A text that is written out; None for what is computed, or has a choice within it."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if not isinstance(node, ast.JoinedStr):
        return None
    gaps = [part for part in node.values if isinstance(part, ast.FormattedValue)]
    if any(isinstance(gap.value, ast.IfExp | ast.Call) for gap in gaps):
        return None
    numbered = iter(range(1, len(gaps) + 1))
    return "".join(
        str(part.value)
        if isinstance(part, ast.Constant)
        else CONSTANT.get(ast.unparse(part.value)) or f"X{next(numbered)}"
        for part in node.values
    )


@pytest.mark.parametrize("language", FOREIGN)
def test_whatever_is_written_out_has_words(language):
    say = sentences(language)
    found = {text for text in literals() if re.search(r"[a-z]{3}", CODE.sub("", text))}
    assert len(found) > 250
    assert not [text for text in found if say.whole(text, 0) is None and say(text) == text]


NO_VALUE = {
    "10**1000000000": "an exponent from -64 to 64",
    "1/(n - 7)": "a divisor that is not 0",
    "sqrt(0 - n)": "0 or more under the root",
    "(0 - n)**0.5": "a whole exponent, or a base of 0 or more",
    "tan(90)": "an angle that is no odd multiple of 90°",
    "9**64*9**64*9**64*9**64*9**64": "a number between 1e-60 and 1e60",
}
"""What has no value, and what is expected instead."""


@pytest.mark.parametrize("language", ("en", *FOREIGN))
@pytest.mark.parametrize("text", NO_VALUE)
def test_an_expression_without_a_value_is_told_with_what_may_stand_there(text, language):
    (found,) = seen(PUMP.replace("A-B = 40", f'A-B = "{text}"'), language=language)["problems"]
    said = NO_VALUE[text]
    assert found["place"] == "links.3.A-B"
    assert found["expected"] == (said if language == "en" else sentences(language)(said))
    assert language == "en" or not ENGLISH.findall(CODE.sub("", found["found"]))
    assert language == "en" or found["expected"] != said


WRONG = [
    "forty",
    "40\nA-B = 41",
    "40 mm",
    "40,5",
    ".5",
    "012",
    '"40',
    "[40",
    "{ a = 1",
    "True",
    "2*n",
]


@pytest.mark.parametrize("language", FOREIGN)
@pytest.mark.parametrize("value", WRONG)
def test_what_is_no_toml_is_told_without_english(language, value):
    problems = [*told_of(PUMP.replace("A-B = 40", f"A-B = {value}"), language)]
    assert problems
    assert not [text for text in problems if ENGLISH.findall(CODE.sub("", text))]
    english = {*told_of(PUMP.replace("A-B = 40", f"A-B = {value}"), "en")}
    assert not english & {*problems}


def told_of(text: str, language: str) -> Iterator[str]:
    """What is told of a text's mistakes: found, expected, hint, each by itself."""
    for each in seen(text, language=language)["problems"]:
        yield from filter(None, (each["found"], each["expected"], each["hint"]))


@pytest.mark.parametrize("language", FOREIGN)
def test_whatever_helps_where_there_is_no_toml_has_words(language):
    constants = [each for each in vars(file_limits).values() if isinstance(each, str)]
    helps = [said for _, said in file_limits.ADVICE] + constants
    say = sentences(language)
    told = [each for each in helps if re.fullmatch(r"[a-z][^\n]* [^\n]*[a-z][^\n]*", each)]
    assert len(told) > 15
    assert not [each for each in told if say(each) == each]


def left_in(text: str) -> list[str]:
    """The English words of a text."""
    return ENGLISH.findall(CODE.sub("", text))


@pytest.mark.parametrize("language", FOREIGN)
def test_no_english_is_left_of_the_mistakes_that_are_kept(language):
    """Of some two hundred mistakes, what `check` says of each and what it expected."""
    say, told = sentences(language), 0
    for line in (KEPT / "mistakes.txt").read_text(encoding="utf-8").splitlines():
        match = re.match(r"graphkin: [\w.-]+\.toml: [^:]+: (.+)", line)
        for text in match[1].split("; expected ") if match else ():
            if "not fair to ask" not in text and "enlarge the rounding" not in text:
                parts = [text] if not left_in(say(text)) else text.split("; ", 1)  # and a hint
                assert not [each for each in parts if left_in(say(each))], (text, say(text))
                told += 1
    assert told > 150


def test_both_languages_say_the_same_sentences():
    italian, romanian = (sentences(language).templates for language in FOREIGN)
    assert list(italian) == list(romanian)
    for english, said in (*italian.items(), *romanian.items()):
        assert sorted(GAP.findall(said)) == sorted(GAP.findall(english)), english


def test_names_and_lines_of_toml_stay_as_they_are():
    mend = Mend("leftt of A-B", "left of A-B")
    found = spoken(Problem("links.position", "link left has the point one alone", "", mend), "ro")
    assert found.place == "links.position"
    assert found.hint == "ați vrut left of A-B?"
    say = sentences("it")
    assert say("link wheel has no line") == "il membro wheel non ha una retta"
    assert say('C = "left of A-B" for one group of class III, order 3') == (
        'C = "left of A-B" per un gruppo di classe III, ordine 3'
    )
    assert say("belong both to the frame") == "sono entrambe del telaio"
    assert say("no such words at all") == "no such words at all"


@pytest.mark.parametrize(
    ("language", "words"),
    [("ro", "elementul 9 nu este în [links]"), ("it", "il membro 9 non è in [links]")],
)
def test_the_page_hears_its_own_language(tmp_path, language, words):
    wrong = PUMP.replace("turn = 1", "turn = 9")
    answer = desk_in(tmp_path).look(ordered(text=wrong, language=language, number=1))
    assert words in [each["found"] for each in answer["problems"]]


@pytest.mark.parametrize("language", FOREIGN)
def test_a_sentence_without_words_is_not_said_by_halves(language):
    """Members of a list have words by themselves only where the list stands in a sentence."""
    say, known = sentences(language), "take it out"
    assert say(known) != known
    assert say(f"what nobody says, {known}") == f"what nobody says, {known}"
    assert say(f"what nobody says; {known}") == f"what nobody says; {say(known)}"
