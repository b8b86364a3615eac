"""Continuation sheets: nothing is lost, nothing is told twice, and sheets are numbered through."""

import re
from functools import cache

import numpy as np
import pytest

from graphkin.construction.result_tables import turning_rows, vector_rows
from graphkin.documents.listing import on_sheets
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import Moved, data
from graphkin.documents.sheet_documents import drawings_of, drawn_sheets, hand_out, proved, rest
from graphkin.drawing.field import A4_SIZE, paper_of
from graphkin.drawing.labels import LETTERS, strong_lines
from graphkin.drawing.marks import LineMark, Text, reach, style_class
from graphkin.drawing.richtext import plain
from graphkin.drawing.shapes import struck
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.writers.files import rendered
from tests.bench.chain import scene
from tests.chosen import EVERY, SPOKEN
from tests.chosen import FOLDER as SCENES
from tests.documents.sheet_tools import collisions, drawings, outside
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


TEXTS = {"chain of 6": scene(6), "train of 6": train(6)}
LANGUAGES = {"chain of 6": "en", "train of 6": "it"}


@cache
def material(name: str):
    """The drawings of a large scene."""
    return drawings_from(TEXTS[name], LANGUAGES[name])


@cache
def handed(name: str, view: str):
    """Its sheets in a view."""
    return drawn_sheets(material(name), view)


def drawings_from(text: str, language: str):
    """The drawings of a scene given as text."""
    mechanism = Mechanism(read_text(text, "large"))
    return drawings_of(mechanism, proved(mechanism, mechanism.solve()), words(language))


def said(pages) -> str:
    """All texts of pages, without markup and spaces."""
    marks = [mark for page in pages for mark in page.marks if isinstance(mark, Text)]
    return "".join("".join(plain(mark.markup).split()) for mark in marks)


@pytest.mark.parametrize("name", TEXTS)
def test_every_sentence_and_every_datum_is_told_once(name):
    documents = handed(name, "key")
    assert any(len(document.pages) > 1 for document in documents)
    for drawing, document in zip(material(name), documents, strict=True):
        told = said(document.pages)
        for sentence in sentences(drawing):
            assert "".join(plain(sentence.markup).split()) in told
        for datum in data(drawing):
            parts = (datum.name, datum.value) if datum.value else (datum.words,)
            assert all("".join(plain(part).split()) in told for part in parts)


@pytest.mark.parametrize("view", ["key", "task"])
@pytest.mark.parametrize("name", TEXTS)
def test_sheets_are_numbered_through_and_nothing_stands_on_anything(name, view):
    documents = handed(name, view)
    pages = [page for document in documents for page in document.pages]
    for number, page in enumerate(pages, 1):
        assert f"{number}/{len(pages)}" in [m.markup for m in page.marks if isinstance(m, Text)]
    for document in documents:
        for page in document.pages[1:]:
            assert not collisions(page.marks) and not outside(page.marks)


def test_the_first_sheet_keeps_its_name():
    pages = handed("chain of 6", "key")[1].pages
    files = rendered("large-acceleration-key", "acceleration", pages, ("svg", "pdf"))
    stem = "large-acceleration-key"
    assert list(files) == [f"{stem}.svg", f"{stem}-2.svg", f"{stem}.pdf"]


def test_a_walker_of_37_links_of_which_all_is_sought_goes_on_over_several_sheets():
    """Its sentences stand once each, in order; a name has a place or is noted at the foot."""
    drawing, *_ = drawings_from(scene_text("documents/walker"), "en")
    assert len(drawing.scene.links) == 37
    (velocity,) = drawn_sheets([drawing], "key")
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
    for name in [*drawing.scene.links, *drawing.scene.points]:
        assert name in lettered or re.search(rf"\b{name}\b", notes), name


@cache
def long_chain(language):
    """The drawings of a chain of 60 dyads of which the last point is sought."""
    ask = '[ask]\nvelocity = ["B60"]\nacceleration = ["B60"]\nepsilon = ["rocker60"]\n'
    return drawings_from(scene(60) + ask, language)


@pytest.mark.parametrize("language", SPOKEN)
@pytest.mark.parametrize("view", ["key", "task"])
def test_tables_and_data_that_fill_more_than_a_sheet_go_on_over_several(view, language):
    """Every row and datum stands there once, beside nothing else, in large letters."""
    for drawing in long_chain(language):
        sheets = rest(drawing, view, {Moved.DATA, Moved.TABLES})
        assert len(sheets) > (drawing.kind == "acceleration")
        for marks in sheets:
            assert not collisions(marks) and not outside(marks)
            assert all(reach(m)[3] < 251 for m in marks if isinstance(m, Text))
        texts = [mark for marks in sheets for mark in marks if isinstance(mark, Text)]
        told = [m.name for m in texts if m.cls == "table" and m.markup.startswith("*") and m.name]
        rows = [f(drawing, empty=view == "task") for f in (vector_rows, turning_rows)]
        wanted = [row for some in rows for row in some]
        firsts = [m.markup for m in texts if m.cls == "table" and m.name in {*told}]
        assert {row.name for row in wanted} == {*told}
        assert all(firsts.count(row.cells[0]) == 1 for row in wanted)
        kept = "".join("".join(plain(m.markup).split()) for m in texts if m.name == "data")
        for datum in data(drawing):
            assert "".join(plain(datum.value or datum.words).split()) in kept


def test_links_that_have_no_room_on_a_task_go_on_to_its_next_sheet():
    (task,) = drawn_sheets(drawings_for(40), "task")
    first, more = said(task.pages[:1]), said(task.pages[1:])
    assert "Links:onthecontinuationsheet" in first
    for link in ("crank=O0B0", "rod40=B39B40", "rocker40=O39B40"):
        assert link in more and link not in first
    for page in task.pages:
        assert not outside(page.marks)


def test_a_sentence_longer_than_a_column_is_parted():
    (drawing,) = drawings_for(120)
    columns = ((30.0, 60.0, 200.0, 100.0), (210.0, 60.0, 400.0, 100.0))
    longest = max(sentences(drawing), key=lambda each: len(each.markup))
    told = [mark for marks in on_sheets(drawing, columns, 0) for mark in marks]
    lines = [mark.markup for mark in told if mark.anchor != "end"]
    flown = " ".join(lines)
    assert longest.markup in flown
    numbers = [mark.markup for mark in told if mark.anchor == "end"]
    assert numbers == [f"{n}." for n in range(1, len(sentences(drawing)) + 1)]
    assert max(mark.y for mark in told) <= 100.0


def drawings_for(dyads: int):
    """The drawing of the velocities of a chain, of which the last is asked."""
    return drawings_from(scene(dyads) + f'[ask]\nvelocity = ["B{dyads}"]\n', "en")


@cache
def rings(language: str):
    return hand_out(load(str(SCENES / "plates-ring.toml")), "key", language)


@pytest.mark.parametrize("name", ["gears-ravigneaux", "hoist-differential", "link-motion"])
def test_what_fills_no_large_sheet_goes_on_on_a4(name):
    """A continuation is one A4 page where that is enough; its text stays in the frame of A4."""
    left, _, right, low = paper_of("A4", "ISO").leaf.area
    some = hand_out(load(str(SCENES / f"{name}.toml")))
    pages = [page for sheet in some for page in sheet.pages[1:]]
    later = [page for page in pages if any(mark.name == "sheet" for mark in page.marks)]
    assert later
    for page in later:
        assert (page.width, page.height) == A4_SIZE
        for mark in page.marks:
            if isinstance(mark, Text) and mark.cls == "caption":
                x1, _, x2, y2 = reach(mark)
                assert left <= x1 and x2 <= right and y2 <= low


@pytest.mark.parametrize("kind", [0, 1])
def test_points_of_many_trial_plans_have_their_names_where_the_plan_is_drawn_larger(kind):
    """They are not named on the sheet before; other letters stand on both.

    Where only a leader across a strong line would reach a point, the note at the foot has its name.
    """
    first, *_, second = rings("it")[kind].pages
    drawing = drawings("plates-ring")[kind]
    steps = drawing.trace.program.steps
    trials = {symbol(steps[n].name) for n in drawing.auxiliary if steps[n].name}
    named = [
        [
            name
            for mark in page.marks
            if isinstance(mark, Text) and (mark.cls.startswith("label") or mark.name == "note")
            for name in re.split(" [≡≈] |[0-9][)] |; |: |, ", mark.markup)
        ]
        for page in (first, second)
    ]
    assert len(trials) > 20
    assert {named[1].count(name) for name in trials} == {1}
    noted = " ".join(m.markup for m in second.marks if isinstance(m, Text) and m.name == "note")
    assert sum(name in noted for name in trials) <= len(trials) / 5
    assert not trials & {*named[0]}
    own = {symbol(step.name) for _, step, _ in drawing.steps(drawing.plane) if step.name} - trials
    assert own & {*named[0]} & {*named[1]}


def test_no_leader_to_a_minor_point_crosses_a_strong_line_and_other_points_have_their_letters():
    both = drawings("plates-coupled")
    *_, page = drawn_sheets(both, "key")[1].pages
    texts = {m.markup for m in page.marks if isinstance(m, Text) and m.height > LETTERS}
    assert {
        symbol(f"{point}′") for point in ("o", "a", "p1", "p2", "p3", "q1", "q2", "q3")
    } <= texts
    leaders = [m for m in page.marks if isinstance(m, LineMark) and style_class(m) == "leader"]
    minor = [m for m in leaders if "trial" in m.cls or m.name.startswith("n_")]
    ends = np.array([(m.x1, m.y1, m.x2, m.y2) for m in minor])
    assert len(minor) > 5
    assert not struck(ends, strong_lines(page.marks)).any()


@pytest.mark.parametrize("language", ["ro", "it"] if EVERY else ["it"])
def test_a_plan_that_is_drawn_larger_stays_clear_of_all_else(language):
    for document in rings(language)[:2]:
        page = document.pages[-1]
        page.check()
        assert not collisions(page.marks)
        said = " ".join(mark.markup for mark in page.marks if isinstance(mark, Text))
        assert words(language)("page.with_trials") in said


def test_a_colon_stands_apart_in_french_and_close_in_english():
    for language, colon in (("fr", "\N{NARROW NO-BREAK SPACE}: "), ("en", ": ")):
        spoken = words(language)
        documents = drawn_sheets(drawings_from(TEXTS["chain of 6"], language), "key")
        marks = [mark for each in documents for page in each.pages for mark in page.marks]
        (moved, *_) = (
            mark.markup for mark in marks if isinstance(mark, Text) and mark.name == "moved"
        )
        assert moved.endswith(f"{colon}{spoken('page.moved')}")


def test_a_wheel_of_the_frame_with_inner_teeth_is_an_internal_gear():
    assert words("en")("page.ring_teeth", k="0", centre="O").startswith("internal gear")


@pytest.mark.parametrize("name", ["shaper-forces", "plank-rollers"])
def test_tables_make_room_for_a_construction_that_goes_on_below_them(name):
    """The tables beside a long construction are lower where that saves a sheet of a few lines."""
    for part in hand_out(load(name), "key", "en")[:-1]:
        assert len(part.pages) == 1, part.kind
