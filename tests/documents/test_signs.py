"""What is put into free room at last: it says what the tables say, and stands clear of all else."""

from __future__ import annotations

import re

import pytest
import shapely

from graphkin.construction.result_tables import turning_links
from graphkin.documents.signs import mechanism_signs, round_below, sign_of
from graphkin.drawing.free_space import Space
from graphkin.drawing.marks import Arc, LineMark, Text, reach
from graphkin.drawing.richtext import plain
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


@pytest.mark.parametrize(("name", "n", "kind"), SHEETS)
def test_the_sense_of_each_link_that_the_table_has_is_on_the_mechanism(name, n, kind):
    """By its own arrow, by its driver's, or in words at the foot of the field."""
    page = drawn(name, n, kind)
    marks = [mark for mark in page.marks["mechanism"] if isinstance(mark, Text)]
    told = {text.markup for _, text in senses(page)}
    told |= {m.markup for m in marks if m.name.startswith("omega") and kind == "velocity"}
    told |= {each.partition(":")[0] for m in marks if m.name == "senses" for each in parts(m)}
    wanted = {name for name, rate in turning_links(page.drawing) if rate}
    assert told >= {symbol(f"{page.drawing.rate.letter}_{link}") for link in wanted}


def parts(mark):
    """What is said of each link in a line."""
    return mark.markup.split("; ")


@pytest.mark.parametrize(
    ("lanes", "told"), [(12.0, {""}), (5.0, {"senses"})], ids=["arrows", "words"]
)
def test_a_sense_that_finds_no_room_is_told_at_the_foot(lanes, told):
    """A field full of lines, so many mm apart: arrows between them, or words in the last lane."""
    page = drawn("four-bar-crank-rocker", None, "velocity")
    left, top, right, low = page.layout.mechanism.rect
    count = int((low - top - 8) / lanes)
    lines = [
        LineMark(left, top + i * lanes, right, top + i * lanes, "link") for i in range(count + 1)
    ]
    texts = [
        mark
        for mark in mechanism_signs(page.drawing, page.layout.mechanism, lines)
        if isinstance(mark, Text)
    ]
    assert {mark.name for mark in texts} == told
    for mark in texts:
        assert not any(shapely.box(*reach(mark)).intersects(outline(line)) for line in lines)
    if told == {"senses"}:
        (said,) = texts
        assert plain(said.markup) == "ω2: clockwise; ω3: counter-clockwise"


def test_a_long_letter_stands_beside_an_arrow_that_is_small():
    """Its box is then not so high as the circle about it; that of a short letter stays one."""
    page = drawn("four-bar-crank-rocker", None, "velocity")
    short, long = (sign_of(page.drawing, name) for name in ("2", "connectingrod"))
    assert short.aside == short
    assert long.aside.half[1] < long.half[1] / 3
    space = Space([], (0, 0, 100, 100))
    arc, _, text = long.aside.put(space, (50, 50), 1.0)
    (wide, high), (start, above, end, below) = long.aside.half, reach(text)
    assert arc.cx - arc.r == pytest.approx(50 - wide)
    assert arc.cx + arc.r < start and end <= 50 + wide + 0.01
    assert 50 - high - 0.5 < above and below < 50 + high + 0.5


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
