"""Pages that grow and overlays: every mark at its place on the key, each at its own sentence."""

import itertools
import re
from collections import Counter
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.solution import Verdict
from graphkin.construction.guides.slide_symbols import frame_guides
from graphkin.construction.rolling.wheel_symbols import straight_tracks
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of, hand_out
from graphkin.documents.step_visibility import grown
from graphkin.drawing.areas import AREA, BELOW
from graphkin.drawing.marks import CircleMark, LineMark, Text, reach
from graphkin.drawing.richtext import extent, plain
from graphkin.drawing.style import NOW, TINTS, style_of
from graphkin.mechanism import Mechanism, load
from graphkin.scene.model import FRAME, Ask
from graphkin.text import words as words_of
from tests.chosen import CHOSEN, FOLDER
from tests.documents.centre_scenes import four_bar
from tests.mechanisms import mechanism_of

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
SOME = ["pump", *(str(SCENES / f"{name}.toml") for name in ("rapid-return", "gears-planet"))]
SOME += [str(SCENES / f"{name}.toml") for name in ("oscillating-slide", "centrodes-cardan")]
SOME += [str(SCENES / f"{name}.toml") for name in ("stephenson-2-ternary", "rod-and-wheel")]

UNDRAWN = {"close", "share", "c", "ν none", "ν by number"}
"""The names of sentences that may draw nothing: of numbers, of trials without a locus."""
ALL = ["pump", *(str(FOLDER / f"{name}.toml") for name in CHOSEN)]


@cache
def pages(name, view):
    settings = {"n": 7} if name == "pump" else {}
    found = hand_out(load(name, **settings), view=view, language="en")
    return {sheet.kind: sheet.pages for sheet in found if sheet.kind != "calculation"}


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
    left, top, right, bottom = AREA
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


def named(name):
    return str(SCENES / f"{name}.toml")


@pytest.mark.parametrize("name", SOME)
def test_the_last_page_shows_all_that_the_key_draws(name):
    for kind, steps in pages(name, "steps").items():
        (key,) = pages(name, "key")[kind]
        assert in_fields(steps[-1]) == in_fields(key)


@pytest.mark.parametrize("name", SOME)
def test_pole_and_fixed_points_stand_from_the_start(name):
    """As on the task sheet, letters too; nothing of a drawing's detail does."""
    for kind, (first, *_) in pages(name, "steps").items():
        (task,) = pages(name, "task")[kind]
        pole = {mark for mark in task.marks if isinstance(mark, CircleMark) and "pole" in mark.cls}
        assert pole and pole <= set(first.marks)
        letters = {mark.name for mark in task.marks if mark.cls.split()[0] == "label"}
        letters |= {mark.name for mark in task.marks if mark.cls == "pin"}
        found = {word for mark in first.marks for word in mark.name.split(" ")}
        assert letters and letters <= found
        assert not [mark for mark in first.marks if mark.cls == "detail"]


@pytest.mark.parametrize("name", SOME)
def test_nothing_that_stands_goes_away_or_moves(name):
    for steps in pages(name, "steps").values():
        for before, after in itertools.pairwise(steps):
            assert drawn(before) <= drawn(after)


@pytest.mark.parametrize("name", ALL)
def test_guides_and_tracks_stand_no_earlier_than_what_they_are_drawn_about(name):
    """Their lines alone do; where along them a block or a wheel stands is not given away."""
    mechanism = load(name, **({"n": 7} if name == "pump" else {}))
    verdict = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    first, *_ = drawings_of(mechanism, verdict, words_of("en"))
    field, links = lay_out(first).mechanism, first.scene.links
    ground = [([links[b].points[0] for b in own], m) for own, m in frame_guides(first, field)]
    tracks = straight_tracks(first, field)
    ground += [([touch.disc.wheel.centre], m) for touch, m in tracks if touch.rolling.on == FRAME]
    (key,), (task,) = pages(name, "key")["velocity"], pages(name, "task")["velocity"]
    for page in pages(name, "steps")["velocity"]:
        pins = {mark.name for mark in page.marks if mark.cls.split()[0] == "pin"}
        seen = {without_now(mark) for mark in page.marks}
        for points, marks in ground:
            assert {*marks} <= {*key.marks}
            assert {*points} <= pins or not ({*marks} - {*task.marks}) & seen


@pytest.mark.parametrize("name", ALL)
def test_each_page_says_its_sentence_and_draws_it(name):
    mechanism = load(name, **({"n": 7} if name == "pump" else {}))
    verdict = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    for drawing in drawings_of(mechanism, verdict, words_of("en")):
        steps = pages(name, "steps")[drawing.kind]
        names = [said.name for said in sentences(drawing)]
        for number, (page, of) in enumerate(zip(steps, names, strict=True), 1):
            (step,) = (mark.markup for mark in page.marks if mark.name == "step")
            assert step == f"Step {number} of {len(steps)}"
            words = " ".join(mark.markup for mark in page.marks if mark.name == "sentence")
            assert words
            assert new_on(page) or of in UNDRAWN, (of, words)


def test_an_arrow_stands_as_soon_as_its_ends_do():
    for kind, steps in pages("pump", "steps").items():
        letter = "b" if kind == "velocity" else "b′"
        for page in steps:
            names = {mark.name for mark in page.marks if mark.step is not None}
            assert (letter in names) == (("ob" if kind == "velocity" else "o′b′") in names)


def test_an_inflection_circle_comes_with_the_sentence_that_finds_its_pole():
    mechanism = mechanism_of(four_bar("inflection = [2]"))
    *_, steps = (sheet.pages for sheet in hand_out(mechanism, view="steps", language="en"))
    told = [" ".join(m.markup for m in page.marks if m.name == "sentence") for page in steps]
    (number,) = (i for i, words in enumerate(told) if "*W*_{2}" in words)
    assert "inflection 2" in new_on(steps[number])
    assert "inflection 2" not in {mark.name for mark in steps[number - 1].marks}


def test_the_notes_at_the_foot_come_with_the_key_numbers_and_vectors_that_they_tell_of():
    key = Text(0, 0, "1)", "label", 1.8, name="moving-centrode 2")
    note = Text(10, 20, "1) moving centrode; *a*_{B}^{ν} = 0; more", "caption", name="note")
    telling = {"*a*_{B}^{ν}": 4}
    found = [list(grown([(3, key), (5, note)], stage, telling)) for stage in range(2, 6)]
    notes = [[mark for mark in marks if mark.name == "note"] for marks in found]
    first, second = "1) moving centrode", "*a*_{B}^{ν} = 0"
    assert [[mark.markup for mark in marks] for marks in notes[:3]] == [
        [],
        [first],
        [f"{first};", second],
    ]
    assert without_now(notes[3][0]) == note
    assert notes[2][0].x == 10
    end = 10 + extent(f"{first}; {second}", 2.5)[0]
    assert notes[2][1].x + extent(second, 2.5)[0] == pytest.approx(end)


@pytest.mark.parametrize(
    ("name", "one"),
    [
        ("stephenson-2-ternary", "*b*″_{B}"),
        ("oldham", "*e*_{MM3}"),
        ("oscillating-slide", "*a*″"),
        ("engine", "*a*″"),
    ],
)
def test_the_letters_of_triangles_are_the_same_in_words_and_on_the_drawing(name, one):
    """Of the triangles that are told in full; b″ alone, or b″_BA beside another one."""
    steps = pages(named(name), "steps")["acceleration"]
    (key,) = pages(named(name), "key")["acceleration"]
    letters = {m.markup for m in key.marks if m.cls == "label construction"}
    assert one in letters
    assert any(one in m.markup for page in steps for m in page.marks if m.name == "sentence")
    for page in steps:
        words = " ".join(m.markup for m in page.marks if m.name in ("sentence", "crossing"))
        corners = re.findall(r"\*[a-z]\*[″‴](?:_\{[^}]*\})?", words)
        corners += re.findall(r"\*[ef]\*(?:_\{[^}]*\})?(?=;)", words)
        assert set(corners) <= letters


@pytest.mark.parametrize("name", ["stephenson-2-ternary", "rapid-return", "rod-and-wheel"])
def test_no_sentence_that_is_done_begins_in_its_middle(name):
    """The last pages have no room for all that are done."""
    first = set()
    for language in ("en", "it", "ro"):
        sheets = hand_out(load(named(name)), view="steps", language=language)
        for page in (page for sheet in sheets[:2] for page in sheet.pages[1:]):
            left = min(mark.x for mark in page.marks if mark.name == "sentence")
            small = [m for m in page.marks if m.cls == "caption" and m.height == 2.5 and not m.name]
            rows = [m.markup for m in small if left + 4 < m.x < left + 8 and m.markup != "…"]
            first.add(rows[0])
    assert len(first) > 1
    assert all(re.fullmatch(r"\d+\.", markup) for markup in first), first


def test_what_is_new_stands_out():
    assert style_of(f"construction {NOW}").width > style_of("construction").width
    assert style_of(f"velocity {NOW}").colour == style_of("velocity").colour


def is_lettering(mark):
    """True for the letter of a point or a vector, and for its leader."""
    return mark.cls.split()[0] in ("label", "leader") and bool(mark.name)


@pytest.mark.parametrize("name", ALL)
def test_the_overlay_is_the_key_at_the_places_of_the_task(name):
    """Without the letters that the task has itself, which may stand elsewhere on it."""
    for kind, (over,) in pages(name, "overlay").items():
        (key,), (task,) = pages(name, "key")[kind], pages(name, "task")[kind]
        letters = {(mark.name, mark.cls) for mark in task.marks if is_lettering(mark)}
        assert letters
        kept = {m for m in drawn(key) if not is_lettering(m) or (m.name, m.cls) not in letters}
        assert drawn(over) == kept
        assert not {(m.name, m.cls) for m in over.marks if is_lettering(m)} & letters
        poles = {mark for mark in task.marks if isinstance(mark, CircleMark) and "pole" in mark.cls}
        assert poles and poles <= set(over.marks)
        for of in ("pin", "fixed-pivot"):
            places = {place_of(mark) for mark in task.marks if mark.cls == of}
            assert places <= {place_of(mark) for mark in over.marks if mark.cls == of}
        filled = {mark.cls for mark in over.marks if mark.cls.split()[0] in ("white", "shade")}
        assert not filled
        assert not {mark.cls for mark in over.marks if style_of(mark.cls).fill in TINTS}


@pytest.mark.parametrize(
    ("name", "settings", "said"),
    [
        ("pump", {"n": 9}, "n = 9"),
        ("pump", {"n": 28}, "n = 28"),
        (named("rod-and-wheel"), {"q": 190}, "q = 190 mm"),
    ],
)
def test_the_caption_of_an_overlay_tells_which_variant_it_is(name, settings, said):
    for sheet in hand_out(load(name, **settings), view="overlay", language="en"):
        (caption,) = [mark for mark in sheet.pages[0].marks if mark.name == "title"]
        assert f", {said}, overlay" in plain(caption.markup)


def test_the_crosses_of_an_overlay_lie_on_the_corners_of_the_frame():
    ((over,),) = [pages("pump", "overlay")["velocity"]]
    crosses = [mark for mark in over.marks if isinstance(mark, LineMark) and mark.name == "corner"]
    middles = {((m.x1 + m.x2) / 2, (m.y1 + m.y2) / 2) for m in crosses}
    assert middles == {(20.0, 10.0), (410.0, 10.0), (20.0, 287.0), (410.0, 287.0)}


@pytest.mark.parametrize("name", ALL)
def test_where_sentences_that_are_done_are_left_out_a_page_says_so(name):
    for steps in pages(name, "steps").values():
        for done, page in enumerate(steps):
            texts = [m for m in page.marks if isinstance(m, Text) and m.cls == "caption"]
            told = [m for m in texts if m.height == 2.5 and m.y > BELOW[1] + 12]
            numbers = [int(m.markup[:-1]) for m in told if m.anchor == "end"]
            assert numbers == [*range(done + 1 - len(numbers), done + 1)]
            first = min((m for m in told if m.anchor == "start"), key=lambda m: m.y, default=None)
            assert (len(numbers) < done) is (first is not None and first.markup == "…")
            assert all(m.y <= BELOW[3] for m in told)


def asked_only(ask):
    """A linkage of which one thing alone is asked."""
    scene = load(str(SCENES / "crank-rocker.toml")).scene
    return Mechanism(replace(scene, ask=ask))


@pytest.mark.parametrize("view", ["key", "task", "steps", "overlay"])
@pytest.mark.parametrize(
    "ask",
    [Ask(curves=("P",)), Ask(velocity=("O1",)), Ask(inflection=("2",)), Ask(centres=("3",))],
    ids=str,
)
def test_a_scene_that_asks_for_one_thing_alone_has_all_its_views(ask, view):
    assert all(sheet.pages for sheet in hand_out(asked_only(ask), view, "en"))


def test_a_sheet_without_a_plan_claims_none():
    for view in ("key", "task", "steps", "overlay"):
        first, *_ = hand_out(asked_only(Ask(curves=("P",))), view, "en")
        texts = [m.markup for page in first.pages for m in page.marks if isinstance(m, Text)]
        assert not [text for text in texts if "elocity" in text or "*k*_v" in text]
        assert not [text for text in texts if "nothing is set" in text]
        assert all("Mechanism" in page.title for page in first.pages)
    assert "over the motion *P* describes its path" in sentences_of(asked_only(Ask(curves=("P",))))


def sentences_of(mechanism):
    """The sentences of a scene's first sheet."""
    drawing, *_ = drawings_of(mechanism, Verdict(True, 0.0, "", 0.0, 0.0, 0.0), words_of("en"))
    return [sentence.markup for sentence in sentences(drawing)]
