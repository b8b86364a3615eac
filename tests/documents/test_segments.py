"""Segments of the plans: each vector has one, and both its letters stand in the plan."""

import re

import pytest

from graphkin.construction.core.segments import TINY
from graphkin.construction.result_tables import vectors
from graphkin.documents.sheet import sheet
from graphkin.drawing.marks import Text
from graphkin.drawing.symbol_markup import symbol
from tests.chosen import HALVES
from tests.documents.sheet_tools import drawings
from tests.mechanisms import SHIPPED

WHICH = [*((name, None) for name in HALVES[1]), *((lab, 7) for lab in SHIPPED)]
LETTER = re.compile(r"\*\w+\*′?(?:_\{[^}]*\})?(?:\^\{[^}]*\})?")


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_every_vector_has_a_segment_whose_letters_are_drawn(which):
    for drawing in drawings(*which):
        page = sheet(drawing, "key", "1")
        texts = [mark for mark in page.marks if isinstance(mark, Text)]
        drawn = {symbol(name) for text in texts for name in text.name.split()}
        for name, segment, length, _ in vectors(drawing):
            letters = LETTER.findall(segment)
            assert len(letters) == 2, name
            assert "".join(letters) == segment, name
            assert length < TINY or drawn.issuperset(letters), (name, letters)


def test_components_that_are_laid_off_and_those_that_close_the_way_share_their_foot():
    found = {name: segment for name, segment, *_ in vectors(drawings("crank-slot")[1])}
    ends = {name: LETTER.findall(segment) for name, segment in found.items()}
    assert ends["a_C2B^ν"][1] == ends["a_C2B^τ"][0] == symbol("n_C2B")
    assert ends["a_CC2^c"][0] == ends["a_CC2^r"][1] == symbol("k_CC2")
