"""Sentences know the names whose symbols they say, as one finds them by reading their text."""

import re
from itertools import cycle

import pytest

from graphkin.construction.core.program import plan_vector
from graphkin.documents.sentences import unexplained
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.marks import Text
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, Markup, names_in, words
from tests.documents.sheet_tools import drawings
from tests.scene_files import scene_text

SCENES = ("pump", "rapid-return", "cylinders-two", "klein-engine", "stephenson-3", "belts-equal")


def read(markup: str, name: str) -> bool:
    """Whether the symbol of a name stands in a text, not as a part of a longer one."""
    return re.search(re.escape(symbol(name)) + r"(?![\^_])", markup) is not None


@pytest.mark.parametrize(("name", "language"), [*zip(SCENES, cycle(LANGUAGES), strict=False)])
def test_every_vector_that_a_sentence_says_is_among_its_names(name, language):
    for drawing in drawings(name, 7 if name == "pump" else None, language):
        vectors = {v.symbol for step in drawing.trace.program.steps if (v := plan_vector(step))}
        for said in unexplained(drawing):
            found = {each for each in vectors if read(said.markup, each)}
            assert found == vectors & names_in(said.markup), said.markup


def test_what_is_joined_says_what_its_parts_say():
    a, b = symbol("v_A"), symbol("v_B")
    assert names_in(words("en").clauses((a, "and", b))) == {"v_A", "v_B"}
    assert names_in(a + " ⊥ ") == {"v_A"}
    assert names_in(str(a)) == names_in(f"{a}") == frozenset()
    said = words("en").clauses
    assert said((a, b)) == f"{a}; {b}" and isinstance(said(()), Markup)


def test_a_sentence_says_those_of_its_fields_that_it_has():
    said = words("en")("why.over", q=symbol("B"), p=symbol("A"), cut=symbol("B‴"), tip=symbol("B″"))
    assert names_in(said) == {"A", "B", "B‴"}


def test_a_corner_written_without_its_index_keeps_its_name():
    assert symbol("B″_BA", "B″") == symbol("B″")
    assert names_in(symbol("B″_BA", "B″")) == {"B″_BA"}


@pytest.mark.parametrize("scene", ["tipping-body-by-cylinder", "lift-with-cylinder"])
def test_no_sign_of_a_point_under_another_is_printed(scene):
    mechanism = Mechanism(read_text(scene_text(f"construction/{scene}"), scene, None, {}))
    verdict = proved(mechanism, mechanism.solve())
    for drawing in drawings_of(mechanism, verdict, words("en")):
        printed = [
            mark.markup for mark in sheet(drawing, "key", "1/2")[0].marks if isinstance(mark, Text)
        ]
        assert printed
        assert not [text for text in printed if "@" in text]
        assert not [said.markup for said in unexplained(drawing) if "@" in said.markup]
