"""Mistakes are told in the language of the page: whatever `check` says has words in each."""

from __future__ import annotations

import ast
import pickle
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from string import Formatter

import pytest

from graphkin.text.errors import joined, message, verbatim
from graphkin.text.problems import spoken, translations
from tests.scene.test_problems import CASES, SAID
from tests.studio.pump import PUMP, desk_in, ordered, seen

ROOT = Path(__file__).resolve().parents[2] / "graphkin"
ENGLISH = re.compile(
    r"\b(?:the|is|of|and|not|which|with|than|has|have|that|these|does|one|another|give|write|take)\b"
)
CODE = re.compile(r'"[^"]*"|\{[^{}]*\}|\[[^]]*\]')
FOREIGN = ("it", "ro")


@cache
def templates() -> set[str]:
    """The template of every message that the package makes."""
    found: set[str] = set()
    for path in sorted(ROOT.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "message":
                found.update(literals(node.args[0]))
    return {each for each in found if words_in(each)}


def literals(node: ast.expr) -> Iterator[str]:
    """The texts of which one is a template; anything but a literal is an error."""
    if isinstance(node, ast.IfExp):
        yield from (*literals(node.body), *literals(node.orelse))
    else:
        assert isinstance(node, ast.Constant) and isinstance(node.value, str), ast.unparse(node)
        yield node.value


def words_in(template: str) -> bool:
    """Whether a template has letters of its own beside its fields."""
    return any(re.search("[A-Za-z]", text) for text, *_ in Formatter().parse(template))


def fields_of(template: str) -> set[tuple[str, str | None, str | None]]:
    """The fields of a template, with their formats."""
    return {(name, spec, kind) for _, name, spec, kind in Formatter().parse(template) if name}


@pytest.mark.parametrize("language", FOREIGN)
def test_every_template_has_a_translation_with_the_same_fields_and_there_are_no_others(language):
    made, own = templates(), translations(language)
    assert len(made) > 900
    assert not made - own.keys()
    assert not own.keys() - made
    for english, said in own.items():
        assert fields_of(said) == fields_of(english), english


@pytest.mark.parametrize("language", FOREIGN)
@pytest.mark.parametrize("name", ["driver", "link", "circle", "the"])
def test_what_the_user_wrote_stays_as_it_is_written(language, name):
    """Names that are words of the messages are not translated."""
    wrong = PUMP.replace("turn = 1", f'turn = "{name}"').replace("A-C = 20", f'A-C = "{name} of"')
    told = [each["found"] for each in seen(wrong, language=language)["problems"]]
    said = translations(language)
    assert said["{split} is not an expression"].format(split=f'"{name} of"') in told
    assert said["link {name} is not in [links]"].format(name=name) in told


def test_a_message_is_said_in_a_language_with_its_own_fields():
    inner = joined(", ", ("link", "circle"))
    said = message("link {name} is not in [links]", name="driver")
    whole = message("{names} are placed from one another, in a circle", names=inner)
    assert spoken(said, "ro") == "elementul driver nu este în [links]"
    assert spoken(said, "it") == "il membro driver non è in [links]"
    assert spoken(said, "en") == said == "link driver is not in [links]"
    assert spoken(whole, "ro").startswith("link, circle ")
    assert spoken("links.position", "ro") == "links.position"
    assert pickle.loads(pickle.dumps(said)).fields == {"name": "driver"}


def test_an_italian_preposition_is_joined_with_the_article_of_a_message_only():
    owner = message("{name} is no point of {where}", name="A", where=message("the mechanism"))
    quoted = message("{name} is no point of {where}", name="A", where=verbatim("il mio"))
    assert "del meccanismo" in spoken(owner, "it")
    assert spoken(quoted, "it").endswith("di il mio")


def translated(said: str, language: str) -> str:
    """An English sentence without fields, or with numbers as fields, in a language."""
    exponent = message("an exponent from -{largest_power} to {largest_power}", largest_power=64)
    range_ = message("a number between 1e-{farthest} and 1e{farthest}", farthest=60)
    known = {str(each): each for each in (exponent, range_)}
    return spoken(known.get(said, message(said)), language)


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
    assert found["expected"] == (said if language == "en" else translated(said, language))
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


def left_in(text: str) -> list[str]:
    """The English words of a text."""
    return ENGLISH.findall(CODE.sub("", text))


@pytest.mark.parametrize("language", FOREIGN)
def test_no_english_is_left_of_the_mistakes_of_scenes(language):
    """Of all mistakes of `tests/scene`: what is said of each, expected, and a hint."""
    told = 0
    for old, new, *_ in (*CASES, *SAID):
        for each in seen(PUMP.replace(old, new), language=language)["problems"]:
            for part in ("found", "expected", "hint"):
                assert not left_in(each[part]), each
            told += 1
    assert told > 100


@pytest.mark.parametrize(
    ("language", "words"),
    [("ro", "elementul 9 nu este în [links]"), ("it", "il membro 9 non è in [links]")],
)
def test_the_page_hears_its_own_language(tmp_path, language, words):
    wrong = PUMP.replace("turn = 1", "turn = 9")
    answer = desk_in(tmp_path).look(ordered(text=wrong, language=language, number=1))
    assert words in [each["found"] for each in answer["problems"]]
