"""Blanks of French pages: narrow ones, at which no line ends, before ; : ? ! and inside « »."""

import re

import pytest

from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import load
from graphkin.text import LANGUAGES, words
from graphkin.web.step_page import step_page

BLANK = "\N{NO-BREAK SPACE}"
"""The blank as it is lettered."""
WRONG = re.compile(rf"[^{BLANK}\d][;?!»]|[^{BLANK}\d ]:|«[^{BLANK}]")
"""A sign without its blank; a scale such as 1:2 has none, a ratio has wider ones."""
SCENES = ("cam-lever", "pump-forces", "gears-ring", "plates-coupled", "shaper", "belts-arm")


@pytest.mark.parametrize("view", ["key", "task", "steps"])
@pytest.mark.parametrize("name", SCENES)
def test_every_sign_of_a_french_page_has_its_blank(name: str, view: str) -> None:
    pages = (page for part in hand_out(load(name), view, "fr") for page in part.pages)
    said = [plain(m.markup) for page in pages for m in page.marks if isinstance(m, Text)]
    assert not [each for each in said if WRONG.search(each)]


@pytest.mark.parametrize("language", LANGUAGES)
def test_only_french_has_blanks_before_signs(language: str) -> None:
    said = words(language).sentences.values()
    spaced = [each for each in said if re.search("[\N{NARROW NO-BREAK SPACE}][;:?!»]", each)]
    assert bool(spaced) is (language == "fr")
    assert not [each for each in said if re.search(" [;?!»]|« ", each)]


def test_a_french_page_of_the_screen_has_them_too() -> None:
    page = step_page(load("pump-forces"), "fr")
    body = re.sub(r"(?s)<(script|style|svg).*?</\1>", "", page)
    text = re.sub(r"<[^>]*>|&[#\w]+;", "", body)
    assert not re.search(r"\w ?[;?!](?=\s)", text)
