"""Pages that grow and overlays: every mark at its place on the key, each at its own sentence."""

import itertools
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from graphkin.handout import hand_out
from graphkin.mechanism import load
from graphkin.paper.marks import Circle, Line
from graphkin.paper.style import NOW, TINTS, style_of

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
SOME = ["pump", *(str(SCENES / f"{name}.toml") for name in ("rapid-return", "gears-planet"))]
SOME += [str(SCENES / f"{name}.toml") for name in ("oscillating-slide", "centrodes-cardan")]


UNDRAWN = ("as on the velocity sheet", "falls on", "at the ratio", "touch in", "turned by 90°")
"""What is said of places that stand already, and of numbers."""


@cache
def pages(name, view):
    settings = {"n": 7} if name == "pump" else {}
    found = hand_out(load(name, **settings), view=view, language="en")
    return {sheet.kind: sheet.pages for sheet in found if sheet.kind != "calculation"}


def without_now(mark):
    return replace(mark, cls=mark.cls.removesuffix(f" {NOW}"))


def drawn(page):
    """What a step drew on a page, at whichever sentence."""
    return {without_now(mark) for mark in page.marks if mark.step is not None}


@pytest.mark.parametrize("name", SOME)
def test_the_last_page_shows_all_that_the_key_draws(name):
    for kind, grown in pages(name, "steps").items():
        (key,) = pages(name, "key")[kind]
        assert drawn(grown[-1]) == drawn(key)


@pytest.mark.parametrize("name", SOME)
def test_nothing_that_stands_goes_away_or_moves(name):
    for grown in pages(name, "steps").values():
        for before, after in itertools.pairwise(grown):
            assert drawn(before) <= drawn(after)


@pytest.mark.parametrize("name", SOME)
def test_each_page_says_its_sentence_and_draws_it(name):
    for grown in pages(name, "steps").values():
        for number, page in enumerate(grown, 1):
            (step,) = (mark.markup for mark in page.marks if mark.name == "step")
            assert step == f"Step {number} of {len(grown)}"
            words = " ".join(mark.markup for mark in page.marks if mark.name == "sentence")
            new = any(NOW in mark.cls.split() for mark in page.marks)
            assert new or any(each in words for each in UNDRAWN), words


@pytest.mark.parametrize(
    ("language", "said"),
    [("en", "1/2 · step 2 of {}"), ("it", "1/2 · passo 2 di {}"), ("ro", "1/2 · pasul 2 din {}")],
)
def test_the_title_block_of_each_page_tells_which_of_how_many_it_is(language, said):
    found = hand_out(load("pump", n=7), view="steps", language=language)
    for i, sheet in enumerate(found, 1):
        total, numbers = len(sheet.pages), []
        for page in sheet.pages:
            numbers.append(" ".join(m.markup for m in page.marks if m.name == "sheet"))
        assert numbers[1] == said.format(total).replace("1/2", f"{i}/2")
        assert len(set(numbers)) == total > 2
        assert numbers[-1].endswith(f" {total} {said.split()[-2]} {total}")


def test_an_arrow_stands_as_soon_as_its_ends_do():
    for kind, grown in pages("pump", "steps").items():
        letter = "b" if kind == "velocity" else "b′"
        for page in grown:
            names = {mark.name for mark in page.marks if mark.step is not None}
            assert (letter in names) == (("ob" if kind == "velocity" else "o′b′") in names)


def test_what_is_new_stands_out():
    assert style_of(f"construction {NOW}").width > style_of("construction").width
    assert style_of(f"velocity {NOW}").colour == style_of("velocity").colour


@pytest.mark.parametrize("name", SOME)
def test_the_overlay_is_the_key_at_the_places_of_the_task(name):
    for kind, (over,) in pages(name, "overlay").items():
        (key,), (task,) = pages(name, "key")[kind], pages(name, "task")[kind]
        assert drawn(over) == drawn(key)
        poles = {mark for mark in task.marks if isinstance(mark, Circle) and "pole" in mark.cls}
        assert poles and poles <= set(over.marks)
        pivots = {mark for mark in task.marks if mark.cls == "fixed-pivot"}
        assert pivots <= set(over.marks)
        filled = {mark.cls for mark in over.marks if mark.cls.split()[0] in ("white", "shade")}
        assert not filled
        assert not {mark.cls for mark in over.marks if style_of(mark.cls).fill in TINTS}


def test_the_crosses_of_an_overlay_lie_on_the_corners_of_the_frame():
    ((over,),) = [pages("pump", "overlay")["velocity"]]
    crosses = [mark for mark in over.marks if isinstance(mark, Line) and mark.name == "corner"]
    middles = {((m.x1 + m.x2) / 2, (m.y1 + m.y2) / 2) for m in crosses}
    assert middles == {(20.0, 10.0), (410.0, 10.0), (20.0, 287.0), (410.0, 287.0)}


def test_a_page_tells_how_flat_the_lines_of_its_sentence_cross():
    """b of the pump's velocity plan: the bars AB and O2B, seen in the solve command too."""
    grown = pages("pump", "steps")["velocity"]
    told = {m.markup for page in grown for m in page.marks if m.name == "crossing"}
    assert "*b*: the lines cross at 77°, 1 mm of pencil becomes up to 1.6 mm" in told
    assert not [m for m in grown[0].marks if m.name == "crossing"]
