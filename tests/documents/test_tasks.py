"""What a task tells and what it leaves to be found, and its kinematic scheme."""

import cmath
import re
from itertools import cycle, pairwise
from math import degrees

import pytest
from msgspec.structs import replace

from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.naming import angle_symbol
from graphkin.construction.core.relation import divided, inverse
from graphkin.documents.calculation import calculation
from graphkin.documents.relations import relations
from graphkin.documents.scheme import elsewhere, full_size, scheme
from graphkin.documents.sheet import BLANK, asked_words, said_above, sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.field import A3
from graphkin.drawing.marks import Arc, LineMark, Text, reach
from graphkin.drawing.richtext import plain
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import load
from graphkin.text import LANGUAGES, words
from tests.documents.full_scenes import NAMED, drawings_from
from tests.documents.sheet_tools import collisions, drawings
from tests.mechanisms import SHIPPED

SCENES = ("watt-1", "crank-slot", "gears-planet", "rapid-return", "stephenson-2-binary")
SOME = (*((lab, 7) for lab in SHIPPED), *((scene, None) for scene in SCENES))


def task(drawing):
    return sheet(drawing, "task", "1/2", lay_out(drawing))[0]


def told(page):
    """The words of a page, in one line."""
    return " ".join(plain(mark.markup) for mark in page.marks if isinstance(mark, Text))


@pytest.mark.parametrize(("name", "language"), [*zip(SOME, cycle(LANGUAGES), strict=False)])
def test_no_sheet_of_a_task_tells_what_its_calculation_asks(name, language):
    both = drawings(*name, language)
    printed = " ".join(told(task(drawing)) for drawing in both)
    for _, found in relations(both, solved=False):
        for each in found:
            if each.result and not each.given:
                answer = f"{plain(each.left)} = {plain(each.result)}"
                assert not re.search(re.escape(answer) + r"(?![\d.,])", printed), answer


@pytest.mark.parametrize(
    ("name", "laws"),
    [
        (("pump", 7), ("(30 + 2·n)°", "(300 + 10·n) rev/min")),
        (("excavator-relative", None), ()),
        (("cam-roller", None), ()),
    ],
    ids=str,
)
def test_a_task_says_of_each_driver_where_it_stands_by_number_or_by_its_law(name, laws):
    """Nobody can begin a drawing without the angle of the crank, and a sheet may lie alone."""
    for drawing in drawings(*name):
        page = told(task(drawing))
        for driver in drawing.scene.drivers:
            assert plain(angle_symbol(drawing.scene, driver)) in page
        assert all(law in page for law in laws)
        assert not laws or plain(drawing.words("page.turning_anticlockwise")) in page


@pytest.mark.parametrize(
    ("name", "cam", "language"),
    [("cam-plate", "1", "ro"), ("cam-carried", "2", "en"), ("cam-lever", "1", "it")],
)
def test_a_task_tells_what_the_centre_of_a_cam_is(name, cam, language):
    """The data give no place of it: the law of the cam does, at the contact."""
    centre = plain(words(language)("page.member_centre", point=symbol("K"), g=cam))
    assert all(centre in told(task(drawing)) for drawing in drawings(name, None, language))


@pytest.mark.parametrize("name", SOME, ids=str)
def test_a_task_has_room_for_a_name_and_no_verdict(name):
    for drawing in drawings(*name):
        marks = task(drawing).marks
        person = words("en")("task.person")
        assert [m for m in marks if isinstance(m, Text) and m.markup == person]
        assert not [m for m in marks if isinstance(m, Text) and m.name in ("witness", "flattest")]


@pytest.mark.parametrize("name", SOME, ids=str)
def test_the_scheme_shows_every_point_in_its_place_and_in_another_position(name):
    for drawing in drawings(*name):
        marks = scheme(drawing)
        letters = {mark.markup for mark in marks if isinstance(mark, Text)}
        assert {symbol(point) for point in drawing.positions} <= letters
        for mark in marks:
            left, top, right, low = reach(mark)
            assert left >= A3.scheme[0] - 0.1 and right <= A3.scheme[2] + 0.1, mark
            assert top >= A3.scheme[1] - 6 and low <= A3.scheme[3] + 0.1, mark
        assert not collisions([mark for mark in marks if mark.name != "scheme"])
        moved = elsewhere(drawing)
        far = max(abs(moved.positions[p] - at) for p, at in drawing.positions.items())
        assert far > 0.02 * drawing.reach


def test_the_scheme_keeps_lengths_and_defines_the_angle_of_the_crank():
    (drawing, *_) = drawings("pump", 7)
    moved = elsewhere(drawing)
    for p, q in (("O1", "A"), ("A", "B"), ("B", "C"), ("C", "D"), ("O2", "B")):
        before = abs(drawing.positions[p] - drawing.positions[q])
        assert abs(moved.positions[p] - moved.positions[q]) == pytest.approx(before)
    turn = (moved.positions["A"] - moved.positions["O1"]) / (
        drawing.positions["A"] - drawing.positions["O1"]
    )
    assert abs(abs(cmath.phase(turn)) - cmath.pi * 35 / 180) < 1e-9
    marks = scheme(drawing)
    assert [mark for mark in marks if isinstance(mark, Arc) and mark.name == "phi"]
    assert [mark for mark in marks if isinstance(mark, Text) and mark.markup == "*φ*"]


@pytest.mark.parametrize("n", [1, 7, 13, 21, 30])
def test_crank_and_lever_of_a_scheme_are_two_links_and_its_angle_is_open(n):
    """The crank pin slides on the lever: with the pivots in line one bar would hide the other."""
    mechanism = load("slotted-lever", n=n)
    found = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))
    places = elsewhere(found[0]).positions
    crank, lever = places["A"] - places["O1"], places["B"] - places["O2"]
    assert 15 <= abs(degrees(cmath.phase(crank / lever))) <= 165
    assert abs(degrees(cmath.phase(crank))) >= 20


@pytest.mark.parametrize("name", ["cam-plate", "hoist-differential"])
def test_symbols_of_the_scheme_are_smaller_than_those_of_the_sheet(name):
    """Else blocks and guides hide the small cam and the wheels of a hoist."""
    (drawing, *_) = drawings(name)
    whole = full_size(drawing, lay_out(drawing).mechanism).marks
    sizes = [
        max(right - left, low - top)
        for marks in (scheme(drawing), whole)
        for left, top, right, low in [reach(first(marks, "slider"))]
    ]
    assert sizes[0] == pytest.approx(0.7 * sizes[1])


def first(marks, cls: str):
    """The first mark of a class."""
    return next(mark for mark in marks if mark.cls.split()[0] == cls)


def test_rows_of_a_task_are_high_enough_for_a_hand():
    (drawing, *_) = drawings("pump", 7)
    ruled: dict[float, list[float]] = {}
    for mark in task(drawing).marks:
        if (
            isinstance(mark, LineMark)
            and mark.cls == "panel"
            and mark.y1 == mark.y2 > A3.tables[1] - 1
        ):
            ruled.setdefault(mark.x1, []).append(mark.y1)
    assert ruled
    for rows in ruled.values():
        steps = sorted(b - a for a, b in pairwise(sorted(rows)))
        assert min(step for step in steps if step > 5.4) >= 7 - 1e-9  # heads are printed


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_link_is_called_on_a_task_as_everywhere_else(language):
    """Upright, its number in line, as in the list of links; points are lettered."""
    text = NAMED.format(crank="A1", rocker="B").replace("rocker", "r1").replace("coupler", "plank")
    for drawing in drawings_from(text, language):
        points, links = asked_words(drawing)
        assert f"{symbol('A1')}, {symbol('B')}" in points
        assert "plank, r1" in links


@pytest.mark.parametrize(
    ("times", "said"), [(0.75, "4/3"), (0.15, "20/3"), (0.5, "2"), (0.4, "2.5"), (0.2, "5")]
)
def test_vectors_longer_than_in_the_plan_are_so_many_times_as_they_can_be_laid_off(times, said):
    (drawing, _) = drawings_from(NAMED.format(crank="A", rocker="B"))
    assert inverse(drawing, times) == said
    assert divided(drawing, "v", times) == f"{said}·v"


def block_texts(page):
    """What is written in the title block of a page, by the name of its cell, without labels."""
    block = [mark for mark in page.marks if isinstance(mark, Text) and mark.cls == "title"]
    return {mark.name: plain(mark.markup) for mark in block if mark.name}


def authored(student=""):
    """The drawings of a lab by an author, and for a student of a class."""
    for drawing in drawings("pump", 7):
        told = replace(drawing.scene.sheet, author="J. Lecturer", student=student)
        yield replace(drawing, scene=replace(drawing.scene, sheet=told))


@pytest.mark.parametrize(("view", "student"), [("task", ""), ("task", "A. S"), ("key", "A. S")])
def test_the_box_of_the_student_is_the_students_whoever_made_the_lab(view, student):
    made = [*authored(student)]
    for drawing in made:
        page = sheet(drawing, view, "1/2")[0]
        found = block_texts(page)
        assert found["creator"] == "J. Lecturer"
        assert found.get("student", "") == student
        said = [plain(mark.markup) for mark in page.marks if isinstance(mark, Text)]
        assert {"Name, group, date", "Created by"} <= {*said}
    for page in calculation(made, view):
        foot = [plain(m.markup) for m in page.marks if isinstance(m, Text) and m.name == "footer"]
        assert foot[0].startswith(student or "Name, group, date: . .")
        assert foot[1].startswith("Created by: J. Lecturer")


def test_the_key_that_is_nobodys_names_its_author_as_the_creator():
    for drawing in authored():
        found = block_texts(sheet(drawing, "key", "1/2")[0])
        assert found["creator"] == "J. Lecturer" and "student" not in found


@pytest.mark.parametrize(("name", "is_stated"), [("gears-planet", True), ("crank-rocker", False)])
def test_the_caption_of_a_task_states_a_factor_that_the_task_gives(name, is_stated):
    drawing = drawings(name, None)[0]
    _, plan = said_above(drawing, drawing.kind, "task")
    assert (BLANK not in plan) is is_stated


@pytest.mark.parametrize("name", ["gears-planet", "gears-ravigneaux", "gears-simpson"])
def test_a_calculation_says_each_numbered_relation_once(name):
    numbered = [
        (each.left, each.symbols, each.result)
        for _, some in relations(drawings(name, None))
        for each in some
        if each.result
    ]
    assert len(numbered) == len({*numbered})
