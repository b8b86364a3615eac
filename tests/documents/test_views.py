"""Pages that grow and overlays: every mark at its place on the key, each at its own sentence."""

import itertools
import re
from collections import Counter
from functools import cache

import pytest
from msgspec.structs import replace

from graphkin.construction.core.kind import Sentence
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.solution import Verdict
from graphkin.construction.guides.slide_symbols import frame_guides
from graphkin.construction.links.wheel_symbols import straight_tracks
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of, drawn_sheets, hand_out
from graphkin.documents.step_pages import (
    STROKES,
    StepPart,
    noted,
    spans,
    step_lines,
    stroke_of,
    text_block,
    to_do,
)
from graphkin.drawing.field import A3
from graphkin.drawing.marks import CircleMark, Mark, SharedLetter, Text, reach
from graphkin.drawing.richtext import signs
from graphkin.drawing.style import NOW, TINTS, style_of
from graphkin.mechanism import Mechanism, load
from graphkin.scene.model import FRAME, Ask
from graphkin.text import words as words_of
from tests.chosen import FOLDER, HALVES

ALL = ["pump", *HALVES[0]]
SOME = ["pump", "rapid-return", "oscillating-slide"]
SOME += [name for name in ALL if "centrodes" in name or "stephenson" in name]

UNDRAWN = {"closing", "share", "c", "ν none", "ν by number", "short"}
"""The names of sentences that may draw nothing: of numbers, of trials without a locus, of what is
too short to be drawn."""


@cache
def material(name):
    """The drawings of a scene."""
    verdict = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    made = load("pump", n=7) if name == "pump" else load(FOLDER / f"{name}.toml")
    return drawings_of(made, verdict, words_of("en"))


@cache
def pages(name, view):
    """The pages of its sheets in a view; of those step by step, the pages that have a step."""
    found = {sheet.kind: sheet.pages for sheet in drawn_sheets(material(name), view)}
    if view != "steps":
        return found
    return {
        k: [p for p in some if any(m.name == "step" for m in p.marks)] for k, some in found.items()
    }


def without_now(mark):
    return replace(mark, cls=mark.cls.removesuffix(f" {NOW}"))


def drawn(page):
    """What a step drew on a page, at whichever sentence; labels that letters share left out."""
    marks = (mark for mark in page.marks if mark.step is not None)
    return {
        without_now(mark) for mark in marks if not (isinstance(mark, Text) and " " in mark.name)
    }


def in_fields(page):
    """All that stands in the two fields of a page."""
    boxes = [(mark, reach(mark)) for mark in page.marks]
    left, top, right, bottom = A3.fields
    return Counter(
        without_now(mark)
        for mark, box in boxes
        if left <= box[0] and top <= box[1] and box[2] <= right and box[3] <= bottom
    )


def new_on(page):
    """The names of what a page's sentence draws."""
    return {mark.name for mark in page.marks if NOW in mark.cls.split()}


def place_of(mark):
    """Where a pin or the top of its ground stands."""
    return (mark.cx, mark.cy) if isinstance(mark, CircleMark) else mark.points[0]


@pytest.mark.parametrize("name", SOME)
def test_the_last_page_shows_all_that_the_key_draws(name):
    for kind, steps in pages(name, "steps").items():
        key, *_ = pages(name, "key")[kind]
        assert in_fields(steps[-1]) == in_fields(key)


@pytest.mark.parametrize("name", SOME)
def test_nothing_that_stands_goes_away_or_moves(name):
    for steps in pages(name, "steps").values():
        for before, after in itertools.pairwise(steps):
            assert drawn(before) <= drawn(after)


@pytest.mark.parametrize("name", ALL)
def test_guides_and_tracks_stand_no_earlier_than_what_they_are_drawn_about(name):
    """Their lines alone do; where along them a block or a wheel stands is not given away."""
    first, *_ = material(name)
    field, links = lay_out(first).mechanism, first.scene.links
    ground = [([links[b].points[0] for b in own], m) for own, m in frame_guides(first, field)]
    tracks = straight_tracks(first, field)
    ground += [([touch.disc.wheel.centre], m) for touch, m in tracks if touch.rolling.on == FRAME]
    (key, *_), (task, *_) = (pages(name, view)["velocity"] for view in ("key", "task"))
    for page in pages(name, "steps")["velocity"]:
        pins = {mark.name for mark in page.marks if mark.cls.split()[0] == "pin"}
        seen = {without_now(mark) for mark in page.marks}
        for points, marks in ground:
            assert {*marks} <= {*key.marks}
            assert {*points} <= pins or not ({*marks} - {*task.marks}) & seen


@pytest.mark.parametrize("name", ALL)
def test_each_page_says_its_sentence_and_draws_it(name):
    for drawing in material(name):
        steps = pages(name, "steps")[drawing.kind]
        said, done = sentences(drawing), 0
        for page in steps:
            first, last, all_, letter = spanned(page)
            assert (first, all_) == (done + (letter in ("", "a")), len(said))
            words = " ".join(mark.markup for mark in page.marks if mark.name == "sentence")
            assert all(f"{n}. " in words for n in range(first, last + 1)) or first == last
            assert new_on(page) or last == all_, words
            assert {each.name for each in said[first - 1 : last - 1]} <= UNDRAWN, words
            done = last
        assert done == len(said)


@pytest.mark.parametrize("name", ALL)
def test_no_page_but_the_last_has_nothing_new(name):
    """What is computed alone is told with what is drawn next."""
    for steps in pages(name, "steps").values():
        assert all(new_on(page) for page in steps[:-1])


def spanned(page):
    """The first and the last sentence of a page, how many there are, and the page's letter."""
    (step,) = (mark.markup for mark in page.marks if mark.name == "step")
    found = re.fullmatch(r"Steps? (?:(\d+)–)?(\d+)([a-z]*) of (\d+)", step)
    first, last, letter, all_ = found.groups()
    assert (first is None) is step.startswith("Step ")
    return int(first or last), int(last), int(all_), letter


@pytest.mark.parametrize("name", ALL)
def test_a_page_draws_three_strokes_at_most(name):
    """Those of one sentence follow each other in the order in which they are drawn."""
    for steps in pages(name, "steps").values():
        for page in steps:
            new = [mark for mark in page.marks if NOW in mark.cls.split()]
            assert len({stroke_of(mark) for mark in new} - {None}) <= STROKES


def test_however_long_a_sentence_is_nothing_that_is_done_stands_below_the_field():
    drawing, *_ = material("pump")
    done, lowest = Sentence(1, "", "join A with B"), 0.0
    for long in range(1, 2400, 50):
        said = [*[done] * 20, Sentence(2, "", "mm " * long)]
        marks = [*text_block(drawing, said, 20, StepPart(20, ""), step_lines(A3))]
        words = [mark for mark in marks if isinstance(mark, Text)]
        below = [mark.y for mark in words if mark.name not in ("step", "sentence")]
        assert max(below, default=0.0) <= A3.below[3]
        lowest = max(lowest, *(mark.y for mark in words if mark.name == "sentence"))
        assert below or lowest > A3.below[3] - 10
    assert lowest > A3.below[3]


def is_lettering(mark):
    """True for the letter of a point or a vector, and for its leader."""
    return mark.cls.split()[0] in ("label", "leader") and bool(mark.name)


def look_of(mark: Mark) -> str:
    """How a label looks, and the leader from it."""
    return mark.cls.partition(" ")[2]


@pytest.mark.parametrize("name", ALL)
def test_the_overlay_is_the_key_at_the_places_of_the_task(name):
    """Without the letters that the task has itself, which may stand elsewhere on it."""
    for kind, (over,) in pages(name, "overlay").items():
        (key, *_), (task, *_) = (pages(name, view)[kind] for view in ("key", "task"))
        fields = [mark for mark in task.marks if reach(mark)[3] <= A3.fields[3]]  # not the scheme
        letters = {(mark.name, look_of(mark)) for mark in fields if is_lettering(mark)}
        assert letters
        kept = {m for m in drawn(key) if not is_lettering(m) or (m.name, look_of(m)) not in letters}
        assert drawn(over) == kept
        assert not {(m.name, look_of(m)) for m in over.marks if is_lettering(m)} & letters
        poles = {mark for mark in task.marks if isinstance(mark, CircleMark) and "pole" in mark.cls}
        assert poles and poles <= set(over.marks)
        for of in ("pin", "fixed-pivot"):
            places = {place_of(mark) for mark in fields if mark.cls == of}
            assert places <= {place_of(mark) for mark in over.marks if mark.cls == of}
        filled = {mark.cls for mark in over.marks if mark.cls.split()[0] in ("white", "shade")}
        assert not filled
        assert not {mark.cls for mark in over.marks if style_of(mark.cls).fill in TINTS}


@pytest.mark.parametrize("name", ALL)
def test_where_sentences_that_are_done_are_left_out_a_page_says_so(name):
    for steps in pages(name, "steps").values():
        for page in steps:
            done = spanned(page)[0] - 1
            texts = [m for m in page.marks if isinstance(m, Text) and m.cls == "caption"]
            to_do = [m.y for m in texts if m.name == "sentence"]
            told = [m for m in texts if m.y > max(to_do) and m.name != "step"]
            numbers = [int(m.markup[:-1]) for m in told if m.anchor == "end"]
            assert numbers == [*range(done + 1 - len(numbers), done + 1)]
            first = min((m for m in told if m.anchor == "start"), key=lambda m: m.y, default=None)
            is_full = max(to_do) + 7 > A3.below[3]
            assert is_full or (len(numbers) < done) is bool(first and first.markup == "…")
            assert all(m.y <= A3.below[3] for m in told)


def asked_only(ask):
    """A linkage of which one thing alone is asked."""
    scene = load(FOLDER / "crank-rocker.toml").scene
    return Mechanism(replace(scene, ask=ask))


@pytest.mark.parametrize("view", ["key", "task", "steps", "overlay"])
@pytest.mark.parametrize(
    "ask",
    [Ask(curves=("P",)), Ask(velocity=("O1",)), Ask(inflection=("2",)), Ask(centres=("3",))],
    ids=str,
)
def test_a_scene_that_asks_for_one_thing_alone_has_all_its_views(ask, view):
    assert all(sheet.pages for sheet in hand_out(asked_only(ask), view, "en"))


def test_notes_that_stand_already_stand_where_the_whole_line_has_them():
    """Of four notes in a line any of them: to a twentieth of a millimetre, sign by sign."""
    parts = ("v_BA = 0.31 mm", "v_C = 0.2 mm", "v_DC = 0.44 mm", "1) D = E")
    letters = tuple(SharedLetter(f"n{i}", part, "; " if i else "") for i, part in enumerate(parts))
    line = Text(20, 190, "; ".join(parts), "note", 2.5, name="note", letters=letters)
    every = list(signs(line.markup, line.height))
    for stand in itertools.product((True, False), repeat=4):
        told_at = {letter.name: 0 if own else 9 for letter, own in zip(letters, stand, strict=True)}
        found = list(noted(line, 5, told_at))
        assert len(found) == sum(stand)
        last = max((i for i, own in enumerate(stand) if own), default=0)
        for mark, i in zip(found, (i for i, own in enumerate(stand) if own), strict=True):
            assert mark.markup == parts[i] + ("" if i == last else ";")
            before = len("; ".join((*parts[:i], "")).replace(" ", "").replace("_", ""))
            for sign, same in zip(signs(mark.markup, mark.height), every[before:], strict=False):
                assert mark.x + sign[0] == pytest.approx(line.x + same[0], abs=0.05)


def test_sentences_that_draw_nothing_share_a_page_as_far_as_they_have_room():
    """Each stands on one page, and none but the last of a page draws; no page is too full."""
    new, none = (CircleMark(0, 0, 1, f"point {NOW}"),), (CircleMark(0, 0, 1, "point"),)
    assert list(spans([none, none, new, none, new], lambda *_: True)) == [(0, 2), (3, 4)]
    said = [Sentence(n, "", "of what is computed alone " * 14) for n in range(30)]
    found = list(
        spans([none] * 30, lambda first, last: to_do(said, first, last, step_lines(A3)).is_held)
    )
    assert [n for first, last in found for n in range(first, last + 1)] == list(range(30))
    assert len(found) > 1
    assert all(to_do(said, *each, step_lines(A3)).is_held for each in found)


@pytest.mark.parametrize("many", range(1, 6))
def test_sentences_to_do_stay_above_the_title_block_and_beside_it(many):
    """They are large as long as all are above it; none reaches over its frame or the mark."""
    said = [Sentence(n, "", "of what is computed alone " * 14) for n in range(many)]
    marks = [*text_block(material("pump")[0], said, 0, StepPart(many - 1, ""), step_lines(A3))]
    words = [mark for mark in marks if isinstance(mark, Text) and mark.name == "sentence"]
    assert {mark.height for mark in words} == {3.5 if many < 3 else 2.5}
    left, top, *_ = A3.title_block
    for mark in words:
        box = reach(mark)
        assert box[3] < top or box[2] < (left if box[3] < A3.marked[1] + 1 else A3.marked[0])
        assert box[3] < A3.area[3] and box[2] < A3.below[2]
