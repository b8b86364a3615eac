"""What is put into free room at last: it says what the tables say, and stands clear of all else."""

from __future__ import annotations

import re

import pytest
import shapely

from graphkin.documents.signs import round_below
from graphkin.drawing.marks import Arc, LineMark, Text, reach
from graphkin.drawing.symbol_markup import symbol
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import VARIANTS, drawn, kind_of, kinds_of, outline

SHEETS = [
    (name, n, kind)
    for name, n in [*((name, None) for name in CHOSEN), *VARIANTS]
    for kind in kinds_of(name, n)
]


def senses(page):
    """The turning arrows of a sheet's links, each with the text that stands in it."""
    marks = page.marks["mechanism"]
    for i, mark in enumerate(marks):
        if isinstance(mark, Arc) and mark.cls == f"sense {page.drawing.kind}":
            text = next(later for later in marks[i:] if isinstance(later, Text))
            yield mark, text


@pytest.mark.parametrize(("name", "n", "kind"), SHEETS)
def test_each_sense_is_that_of_the_link_that_it_names(name, n, kind):
    page = drawn(name, n, kind)
    letter = page.drawing.rate.letter
    by_text = {symbol(f"{letter}_{link}"): link for link in page.drawing.scene.links}
    for arc, text in senses(page):
        rate = page.drawing.turning(by_text[text.markup])
        assert rate is not None and (arc.end - arc.start) * rate > 0


@pytest.mark.parametrize(("name", "n", "kind"), SHEETS)
def test_a_sense_touches_nothing(name, n, kind):
    page = drawn(name, n, kind)
    marks = page.marks["mechanism"]
    for arc, text in senses(page):
        disc = shapely.Point(arc.cx, arc.cy).buffer(arc.r)
        for mark in marks:
            if isinstance(mark, Text) and mark != text:
                assert not disc.intersects(shapely.box(*reach(mark))), mark
            elif isinstance(mark, LineMark) and kind_of(mark) in ("link", kind):
                assert not disc.intersects(outline(mark)), mark


def test_most_links_of_a_plain_mechanism_show_their_sense():
    assert len(list(senses(drawn("four-bar-crank-rocker", None, "velocity")))) == 2


@pytest.mark.parametrize(("name", "n", "kind"), SHEETS)
def test_the_bar_of_a_plan_is_as_long_as_it_says(name, n, kind):
    page = drawn(name, n, kind)
    marks = [mark for mark in page.marks["plan"] if getattr(mark, "name", "") == "scale"]
    if not marks:
        return
    bar = max((m for m in marks if isinstance(m, LineMark)), key=lambda m: m.x2 - m.x1)
    numbers = [m.markup for m in marks if isinstance(m, Text)]
    says = max(float(each) for each in numbers if re.fullmatch(r"[\d.e+-]+", each))
    metres = page.layout.plan.mm
    assert (bar.x2 - bar.x1) == pytest.approx(says * metres, rel=1e-6)


def test_no_task_shows_a_sense_or_the_scale_of_its_plan():
    for kind in kinds_of("six-bar"):
        page = drawn("six-bar", None, kind, "task")
        assert not list(senses(page))
        assert not any(getattr(mark, "name", "") == "scale" for mark in page.marks["plan"])


@pytest.mark.parametrize(
    ("most", "value"), [(1.0, 1.0), (1.9, 1.0), (2.0, 2.0), (49.0, 20.0), (0.06, 0.05)]
)
def test_the_value_of_a_bar_is_the_largest_round_one(most, value):
    assert round_below(most)[0] == pytest.approx(value)
