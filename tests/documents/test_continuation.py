"""Continuation sheets: nothing is lost, nothing is told twice, and sheets are numbered through."""

import re
from functools import cache

import pytest

from graphkin.documents.data_heading import data
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of, hand_out, proved
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.writers.files import rendered
from tests.bench.chain import scene
from tests.documents.sheet_tools import collisions, outside
from tests.scene_files import scene_text


def train(wheels: int) -> str:
    """A row of wheels that mesh."""
    head = 'graphkin = 1\ntitle = "Train"\nmodule = 4\n'
    head += 'units = { length = "mm", angle = "deg", speed = "rev/min" }\n[frame]\n'
    pivots = "".join(f"O{i} = [{80 * i}, 0]\n" for i in range(wheels))
    links = ""
    for i in range(wheels):
        links += f'[links.{i + 1}]\nO{i}-A{i} = 30\nwheel = {{ centre = "O{i}", teeth = 20 }}\n'
        if i:
            links += f"rolls = {{ on = {i}, start = {{ {i} = 0, {i + 1} = 0 }} }}\n"
    return head + pivots + links + "[[drivers]]\nturn = 1\nangle = 20\nspeed = 60\n"


TEXTS = {"chain of 4": scene(4), "chain of 8": scene(8), "train of 6": train(6)}
LANGUAGES = {"chain of 4": "ro", "chain of 8": "en", "train of 6": "it"}


@cache
def handed(name: str, view: str):
    return hand_out(Mechanism(read_text(TEXTS[name], "large")), view, LANGUAGES[name])


def said(pages) -> str:
    """All texts of pages, without markup and spaces."""
    marks = [mark for page in pages for mark in page.marks if isinstance(mark, Text)]
    return "".join("".join(plain(mark.markup).split()) for mark in marks)


@pytest.mark.parametrize("name", TEXTS)
def test_every_sentence_and_every_datum_is_told_once(name):
    mechanism, documents = Mechanism(read_text(TEXTS[name], "large")), handed(name, "key")
    verdict = proved(mechanism, mechanism.solve())
    drawings = drawings_of(mechanism, verdict, words(LANGUAGES[name]))
    assert any(len(document.pages) > 1 for document in documents[:-1])
    for drawing, document in zip(drawings, documents, strict=False):
        told = said(document.pages)
        for sentence in sentences(drawing):
            assert "".join(plain(sentence.markup).split()) in told
        for datum in data(drawing):
            parts = (datum.name, datum.value) if datum.value else (datum.words,)
            assert all("".join(plain(part).split()) in told for part in parts)


@pytest.mark.parametrize("view", ["key", "task"])
@pytest.mark.parametrize("name", TEXTS)
def test_sheets_are_numbered_through(name, view):
    documents = handed(name, view)
    pages = [page for document in documents[:-1] for page in document.pages]
    for number, page in enumerate(pages, 1):
        assert f"{number}/{len(pages)}" in [m.markup for m in page.marks if isinstance(m, Text)]


@pytest.mark.parametrize("view", ["key", "task"])
@pytest.mark.parametrize("name", TEXTS)
def test_on_a_continuation_sheet_nothing_stands_on_anything(name, view):
    documents = handed(name, view)
    for document in documents[:-1]:
        for page in document.pages[1:]:
            assert not collisions(page.marks) and not outside(page.marks)


def test_the_first_sheet_keeps_its_name():
    documents = handed("chain of 8", "key")
    pages = documents[1].pages
    files = rendered("large-acceleration-key", "acceleration", pages, ("svg", "pdf"))
    stem = "large-acceleration-key"
    assert list(files) == [f"{stem}.svg", f"{stem}-2.svg", f"{stem}.pdf"]


def test_a_walker_of_37_links_of_which_all_is_sought_goes_on_over_several_sheets():
    """Its sentences stand once each, in order; a name has a place or is noted at the foot."""
    mechanism = Mechanism(read_text(scene_text("documents/walker"), "walker"))
    assert len(mechanism.scene.links) == 37
    spoken = words("en")
    drawing, *_ = drawings_of(mechanism, proved(mechanism, mechanism.solve()), spoken)
    velocity = hand_out(mechanism, "key", "en")[0]
    assert len(velocity.pages) > 2
    numbers = [
        int(mark.markup[:-1])
        for page in velocity.pages
        for mark in page.marks
        if isinstance(mark, Text) and re.fullmatch(r"\d+\.", mark.markup)
    ]
    assert numbers == [*range(1, len(list(sentences(drawing))) + 1)]
    told = said(velocity.pages)
    assert all("".join(plain(each.markup).split()) in told for each in sentences(drawing))
    first = [mark for mark in velocity.pages[0].marks if isinstance(mark, Text)]
    notes = " ".join(plain(mark.markup) for mark in first if mark.name == "note")
    assert "no room for the names of: " in notes
    lettered = {plain(mark.markup) for mark in first if mark.name != "note"}
    for name in [*mechanism.scene.links, *mechanism.scene.points]:
        assert name in lettered or re.search(rf"\b{name}\b", notes), name
