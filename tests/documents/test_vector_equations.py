"""Vector equations: each says of every vector what is known, and all that is asked follows."""

from itertools import pairwise

import pytest

from graphkin.construction.core.relation import VectorEquation
from graphkin.construction.vector_equations import of_equations
from graphkin.documents.calculation import calculation
from graphkin.drawing.marks import LineMark, Text
from tests.chosen import HALVES
from tests.documents.sheet_tools import drawings
from tests.mechanisms import SHIPPED

WHICH = [*((name, None) for name in HALVES[0]), *((lab, 7) for lab in SHIPPED)]


def equations(drawing) -> list[VectorEquation]:
    """Those of a sheet that sum up vectors."""
    every = (relation.equation for _, relation in of_equations(drawing))
    return [each for each in every if each is not None and each.sums]


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_each_equation_leaves_two_unknowns_or_none(which):
    """Two sizes or directions can be found from one vector equation in the plane, never three."""
    for drawing in drawings(*which):
        for each in equations(drawing):
            for terms in each.sums:
                missing = sum(2 - term.known for term in (each.whole, *terms))
                chained = sum(2 - term.known for term in terms)
                assert missing <= 2 + 2 * (each.whole.known == 0), each.markup
                assert chained <= 1 or len(each.sums) == 1, each.markup


@pytest.mark.parametrize("which", WHICH, ids=str)
def test_what_is_half_known_says_how(which):
    for drawing in drawings(*which):
        for each in equations(drawing):
            terms = (each.whole, *(term for some in each.sums for term in some))
            assert all(term.note for term in terms if term.known == 1), each.markup


def test_lines_stand_below_their_vectors_on_keys_and_nowhere_on_tasks():
    both = drawings("pump", 7)
    key, task = (
        [mark for page in calculation(both, view) for mark in page.marks]
        for view in ("key", "task")
    )
    lines = [mark for mark in key if isinstance(mark, LineMark) and mark.name == "known"]
    texts = [mark for mark in key if isinstance(mark, Text) and mark.cls == "caption equation"]
    for line in lines:
        assert any(abs(text.x - line.x1) < 1e-6 and 0 < line.y1 - text.y < 3 for text in texts)
    doubled = sum(a.x1 == b.x1 and b.y1 - a.y1 < 1 for a, b in pairwise(lines))
    known = [term for d in both for each in equations(d) for some in each.sums for term in some]
    assert doubled == sum(term.known == 2 for term in known)
    assert not [mark for mark in task if mark.name == "known"]
    assert [mark for mark in task if mark.name == "vector"]
