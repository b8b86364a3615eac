"""One cause, one deduction: students who share nothing with the marking, each with one mistake.

``python -m tests.bench.causes`` measures all of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import pi

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.grading.causes import Variants
from graphkin.classroom.grading.class_marking import Book, graded_class
from graphkin.classroom.grading.class_report import cause_counts, result_lines
from graphkin.classroom.grading.feedback import notes, points_words, rows
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.grading_files import cause_text
from graphkin.classroom.grading.readings import FormFields
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.text import words
from graphkin.text.errors import RosterError, SceneError
from tests.bench.causes import a_class, is_named
from tests.chosen import EVERY
from tests.classroom.grading import hand, mistaken
from tests.classroom.grading.mistaken import CAUSES
from tests.classroom.grading.students import (
    LABS,
    book_of,
    given,
    key_answers,
    lab_of,
    marker_of,
    taker,
)

SLICE = (
    ("offset-slider-crank", "the crank's diameter for its radius"),
    ("offset-slider-crank", "the ruler from 10 mm"),
    ("slotted-lever", "the angle clockwise"),
    ("slotted-lever", "no normal components"),
    ("pump", "rev/min for rad/s"),
    ("pump", "another number"),
)
FEW = 8


@pytest.mark.parametrize(("lab", "name"), SLICE)
def test_one_mistake_is_named_and_paid_once(lab, name):
    found = a_class(lab, CAUSES[name], 1, count=FEW)
    marks = [float(100 * graded.share) for graded, _ in found]
    assert sum(is_named(*each) for each in found) >= FEW - 1
    assert np.mean(marks) >= 75
    for graded, _ in found:
        assert graded.cost <= graded.points / 4


@pytest.mark.parametrize("lab", LABS)
def test_no_two_causes_share_a_name_and_a_way(lab):
    """Else a pair that is tried for one student stands for another pair of a fellow student."""
    made = FormFields(Variants([marker_of(lab, 7).standard])).causes
    assert len({(cause.name, cause.way) for cause in made}) == len(made)


def test_nobody_honest_has_a_mistake_named():
    for lab in ("offset-slider-crank", "pump"):
        assert not any(graded.causes for graded, _ in a_class(lab, [()], 2, count=20))


def test_what_a_coarse_pencil_explains_is_no_mistake():
    """At 86° the protractor's other scale reads 94°, as a crank set badly by hand may lie."""
    lab, book, rng = "pump", book_of("pump"), np.random.default_rng(7)
    takers = [taker(28 + i % 3, f"s{i:03d}") for i in range(150 if EVERY else 21)]
    book.prepare(takers)
    answers = {}
    for who in takers:
        paper = book.marker_of(who).standard.paper
        sheet = (paper.mechanism, paper.velocities, paper.accelerations)
        data = hand.data(lab, int(who.settings["n"]))
        row = mistaken.handed_in(lab, data, sheet, rng, mistaken.SLOPPY)
        answers[who.student.id] = {
            item.field: read_answer(row[item.field], item) for item in book.form
        }
    named = [e.name for g in graded_class(book, takers, answers).graded for e in g.causes]
    assert named == []


@pytest.mark.parametrize("second", [("ruler 1:2",), ("diameter",), ("clockwise",)])
def test_another_students_number_is_named_beside_a_second_mistake(second):
    found = a_class("offset-slider-crank", [("another number", *second)], 3, count=2)
    assert found and all(is_named(*each) for each in found)
    assert all(e.whose for g, _ in found for e in g.causes if e.name == "data_of_another")


def one_in_a_class(own: int, drawn: int, at_scales_of: int, *mistakes: str, turned: bool = False):
    """What becomes of a student who hands in a drawing of another number, in a class of 24."""
    lab, book, who = "offset-slider-crank", book_of("offset-slider-crank"), f"s{own:02d}"
    takers = [taker(n, f"s{n:02d}") for n in range(3, 27)]
    book.prepare(takers)
    paper = book.marker_of(taker(at_scales_of)).standard.paper
    sheet = (paper.mechanism, paper.velocities, paper.accelerations)
    rng = np.random.default_rng([5, own])
    row = mistaken.handed_in(lab, hand.data(lab, drawn), sheet, rng, mistakes=mistakes)
    other = {"+": "-", "-": "+"} if turned else {}
    answers = {i.field: read_answer(other.get(row[i.field], row[i.field]), i) for i in book.form}
    result = graded_class(book, takers, {who: answers}, as_it_is=True)
    (graded,) = [each for each in result.graded if each.taker.student.id == who]
    return graded, result


@pytest.mark.parametrize("own", [5, 8])
def test_mirrored_data_of_a_neighbour_are_named(own):
    """Two causes near the student's own data explain most of such a sheet, but not all of it."""
    graded, _ = one_in_a_class(own, own + 2, own, "protractor")
    named = {cause.name: cause.whose for cause in graded.causes}
    assert named.keys() == {"data_of_another", "other_scale_of_protractor"}
    assert named["data_of_another"] == (f"s{own + 2:02d}",)


def test_whose_data_were_drawn_is_told_beside_reversed_senses():
    """The answers of another with all senses turned: at the other's scales, so all sizes fit."""
    _, result = one_in_a_class(19, 26, 26, turned=True)
    assert [each.students for each in result.wrong_variants] == [("s19", "s26")]


TURNED = """
v_D_mm=86 v_D=8.5 a_D_mm=68 a_D=410 omega_2=13 omega_2_sense=+ omega_3=31 omega_3_sense=+
omega_4=29 omega_4_sense=- epsilon_2=930 epsilon_2_sense=+ epsilon_3=620 epsilon_3_sense=-
epsilon_4=1800 epsilon_4_sense=+ I_3_x_mm=-15 I_3_y_mm=-27 J_3_x_mm=-75 J_3_y_mm=-10
J_4_x_mm=39 J_4_y_mm=-37
"""
"""A sloppy drawing of number 17's pump, turned by a degree and read to whole millimetres."""


def test_a_sheet_turned_by_a_degree_is_not_drawn_from_a_neighbours_data():
    """The crank of number 16 stands two degrees away."""
    book, who, row = book_of("pump"), taker(17), dict(each.split("=") for each in TURNED.split())
    answers = {item.field: read_answer(row[item.field], item) for item in book.form}
    (graded,) = graded_class(book, [who], {who.student.id: answers}, as_it_is=True).graded
    assert not graded.causes


@pytest.mark.parametrize("turned", [False, True])
def test_a_copy_of_anothers_numbers_is_no_mistake_in_the_data(turned):
    """Every number is the other's, to the digit, and perhaps all senses are turned."""
    graded, owner = copied_from(26, 19, turned=turned)
    assert owner.share == 1
    assert not graded.causes and graded.share < Fraction("0.2")


def copied_from(source: int, own: int, *, turned: bool):
    """A student who hands in another's answers, and the other."""
    book, lab = book_of("offset-slider-crank"), "offset-slider-crank"
    takers = [taker(n, f"s{n:02d}") for n in range(3, 27)]
    book.prepare(takers)
    paper = book.marker_of(taker(source)).standard.paper
    sheet = (paper.mechanism, paper.velocities, paper.accelerations)
    row = mistaken.handed_in(lab, hand.data(lab, source), sheet, np.random.default_rng(5))
    other = {"+": "-", "-": "+"} if turned else {}
    answers = {i.field: read_answer(row[i.field], i) for i in book.form}
    copy = {i.field: read_answer(other.get(row[i.field], row[i.field]), i) for i in book.form}
    given = {f"s{own:02d}": copy, f"s{source:02d}": answers}
    found = {g.taker.student.id: g for g in graded_class(book, takers, given, as_it_is=True).graded}
    return found[f"s{own:02d}"], found[f"s{source:02d}"]


def test_a_crank_turned_the_other_way_is_named_beside_another_mistake():
    """All that shows it is the sense of one ω."""
    found = a_class("offset-slider-crank", [("diameter", "reversed")], 3, count=2)
    assert found and all(is_named(*each) for each in found)


def test_a_sense_without_its_value_earns_nothing():
    """One of two senses is right by chance."""
    marker = marker_of("pump", 7)
    senses = {f: a for f, a in key_answers(marker.standard).items() if f.endswith("_sense")}
    assert marker.mark(taker(), senses).earned == 0


def test_all_senses_reversed_are_worth_no_more_than_blank_ones():
    marker = marker_of("pump", 7)
    key = key_answers(marker.standard)
    senses = [f for f in key if f.endswith("_sense")]
    blank = marker.mark(taker(), {**key, **dict.fromkeys(senses, Answer(""))}).earned
    other = given({f: -marker.standard.key[f] for f in senses})
    found = marker.mark(taker(), {**key, **other})
    assert [cause.name for cause in found.causes] == ["sense_reversed"]
    ((_, answers, students),) = cause_counts([found])
    assert (answers, students) == (len(senses), 1)
    assert found.earned <= blank
    lost = points_words(found.points - found.earned, words("en"))
    told = notes(found, words("en"))[0]
    assert found.cost == 0 and "−" not in told  # as deducted in marks.csv
    assert told.startswith("One mistake: all senses were taken the other way.")
    assert f"earn nothing (points: {lost})" in told


def test_a_named_cause_never_costs_more_than_the_same_values_unexplained():
    for lab, name in SLICE:
        for graded, _ in a_class(lab, CAUSES[name], 1, count=2):
            lost = sum(m.points - m.earned for m in graded.marks if not m.cause)
            assert graded.cost + lost <= graded.points


def test_a_second_cause_never_costs_more_than_the_first_alone():
    """Beside a crank twice as long, the right ε of number 7 happens to be ω²."""
    book, who = book_of("offset-slider-crank"), replace(taker(7), settings={"n": "7", "r": "61"})
    marker = book.marker_of(who)
    sheet = marker.standard.paper
    scales = (sheet.mechanism, sheet.velocities, sheet.accelerations)
    data = hand.data("offset-slider-crank", 7)
    row = mistaken.handed_in(
        "offset-slider-crank",
        data,
        scales,
        np.random.default_rng(11),
        mistakes=("diameter",),
        crank=61,
    )
    told = {item.field: read_answer(row[item.field], item) for item in book.form}
    one = marker.mark(who, told)
    assert [cause.name for cause in one.causes] == ["diameter_for_radius"]
    epsilon = marker.standard.by_field["epsilon_2"].item
    two = marker.mark(who, told | {"epsilon_2": read_answer("41.5", epsilon)})
    assert two.causes[0].name == "diameter_for_radius"
    assert one.earned - two.earned <= two.mark("epsilon_2").points


def test_feedback_begins_with_the_mistake_in_every_language():
    (graded, _), *_ = a_class("offset-slider-crank", [("diameter",)], 1, count=1)
    for language, start in (("en", "One mistake"), ("ro", "O greșeală"), ("it", "Un errore")):
        assert notes(graded, words(language))[0].startswith(start)
    text = notes(graded, words("en"))[0]
    assert "diameter" in text and text.endswith("Everything else follows from it.")


def test_the_points_of_the_table_add_up_to_the_mark():
    for lab, name in SLICE[:3]:
        for graded, _ in a_class(lab, CAUSES[name], 1, count=2):
            told = [row.cells[-1].split(" ")[0] for row in rows(graded, words("en"))]
            assert sum(float(each.replace("−", "-")) for each in told) == float(graded.earned)


def keys_of(count: int) -> tuple[list, dict[str, Mapping[str, Answer]]]:
    """A class whose answers are the keys."""
    book = book_of("pump")
    takers = [taker(n, f"s{n:02d}") for n in range(1, count + 1)]
    book.prepare(takers)
    answers = {}
    for each in takers:
        found = key_answers(book.marker(each.settings).standard)
        answers[each.student.id] = {f: replace(a, text=f"{a.value:.4g}") for f, a in found.items()}
    return takers, answers


def test_shifted_rows_are_told_and_nothing_is_marked():
    takers, answers = keys_of(12)
    ids = list(answers)
    shifted = {who: answers[ids[(i + 1) % len(ids)]] for i, who in enumerate(ids)}
    with pytest.raises(RosterError, match="shifted"):
        graded_class(book_of("pump"), takers, shifted)
    assert graded_class(book_of("pump"), takers, answers).graded[0].share == 1


def test_a_column_without_its_decimal_points_is_told():
    takers, answers = keys_of(12)
    items = {item.field: item for item in book_of("pump").form}
    lost = {}
    for who, row in answers.items():
        digits = f"{abs(row['v_D'].value):.3f}".replace(".", "")
        lost[who] = {**row, "v_D": read_answer(digits, items["v_D"])}
    with pytest.raises(RosterError, match="decimal"):
        graded_class(book_of("pump"), takers, lost)


def written(row: Mapping[str, Answer], change) -> dict[str, Answer]:
    """The answers of a student with each number changed, written to four digits."""
    items = {item.field: item for item in book_of("pump").form}
    told = {field: change(field, answer.value) for field, answer in row.items()}
    texts = {f: f"{v:+.0f}" if f.endswith("_sense") else f"{v:.4g}" for f, v in told.items()}
    return {field: read_answer(text, items[field]) for field, text in texts.items()}


def whole_class(change, count: int = 12):
    """A class all of whose answers are changed in one way, marked."""
    takers, answers = keys_of(count)
    return graded_class(
        book_of("pump"), takers, {who: written(row, change) for who, row in answers.items()}
    )


def one_of_a_class(change):
    """The first student of a class, whose answers alone are changed."""
    takers, answers = keys_of(6)
    first = takers[0].student.id
    answers[first] = written(answers[first], change)
    return graded_class(book_of("pump"), takers, answers).graded[0]


def test_each_plan_at_a_scale_of_its_own_is_one_cause():
    """One length of each plan is asked, and both values are right: no law ties the two factors."""
    factors = {"v_D_mm": 0.7, "a_D_mm": 1.3}
    graded = one_of_a_class(lambda f, v: v * factors.get(f, 1.0))
    assert [cause.name for cause in graded.causes] == ["own_scale"]
    assert graded.share == Fraction("0.9")
    assert graded.mark("v_D_mm").by_cause is None  # it is the student's own, which proves nothing


def test_two_causes_that_give_the_same_answers_are_both_named():
    """The sheet is at 1:2: plans twice as large, and plans drawn in full, give the same answers."""
    (graded, _), *_ = a_class("offset-slider-crank", CAUSES["plans of one's own scale"], 1, count=1)
    (cause,) = graded.causes
    assert {cause.name, cause.either} == {"own_scale", "drawn_in_full"}
    text = notes(graded, words("en"))[0]
    assert text.count("either") == 2 and "do not tell which" in text  # the cause, where it shows
    assert "own_scale" in cause_text(cause) and "drawn_in_full" in cause_text(cause)


def test_of_two_causes_that_may_be_meant_the_lower_deduction_is_made():
    lab = lab_of("offset-slider-crank")
    dearer = replace(lab.rubric, causes={**lab.rubric.causes, "drawn_in_full": "serious"})
    book = Book(replace(lab, rubric=dearer), lab.scene.read_text("utf-8"))
    marker = book.marker_of(taker(7))
    found = {"own_scale": "", "drawn_in_full": "own_scale"}
    for name, either in found.items():
        assert marker.share(name, either) == Fraction(str(dearer.cost("own_scale")))
    assert marker.share("drawn_in_full", "") > marker.share("own_scale", "")


def test_a_cause_that_the_answers_tell_from_all_others_has_no_second_name():
    for name in ("the crank's diameter for its radius", "rev/min for rad/s"):
        for graded, _ in a_class("slotted-lever", CAUSES[name], 1, count=FEW):
            assert [cause.either for cause in graded.causes] == [""]


def test_a_number_misread_beside_a_cause_does_not_hide_it():
    """One of two rates in degrees is read a centimetre too long: 284 for 261."""
    marker = marker_of("offset-slider-crank", 14)
    key = key_answers(marker.standard)
    in_degrees = {"omega_2": key["omega_2"].value * 62, "epsilon_2": key["epsilon_2"].value * 57.3}
    graded = marker.mark(taker(14), {**key, **given(in_degrees)})
    assert [cause.name for cause in graded.causes] == ["rate_in_degrees"]
    assert graded.mark("omega_2").earned == 0 < graded.mark("epsilon_2").earned


def test_one_misread_length_beside_a_right_value_is_no_scale_of_ones_own():
    graded = one_of_a_class(lambda f, v: v * 0.7 if f == "v_D_mm" else v)
    assert not graded.causes


@pytest.mark.parametrize("factor", [1.25, 0.5**0.5])
def test_sheets_of_another_scale_are_told_and_nothing_is_marked(factor):
    with pytest.raises(RosterError, match="scale"):
        whole_class(lambda f, v: v * factor if f.endswith("_mm") and f[0] in "va" else v)


def test_the_answers_of_another_lab_are_told_and_nothing_is_marked():
    fields = [item.field for item in book_of("pump").form]
    with pytest.raises(RosterError, match="lab"):
        whole_class(
            count=7, change=lambda f, v: v * (1.3 + fields.index(f) % 5) * (-1) ** fields.index(f)
        )


def test_rows_in_another_order_are_told_and_nothing_is_marked():
    takers, answers = keys_of(24)
    ids = list(answers)
    other = dict(zip(ids, (answers[who] for who in reversed(ids)), strict=True))
    with pytest.raises(RosterError, match="order"):
        graded_class(book_of("pump"), takers, other)


def test_a_class_that_shares_a_mistake_is_marked():
    """Plans drawn 2:1: no mistake of the table."""
    doubled = whole_class(lambda f, v: v * 2 if f.endswith("_mm") and f[0] in "va" else v)
    assert {c.name for each in doubled.graded for c in each.causes} == {"own_scale"}
    said = list(result_lines(doubled, words("en")))[1]
    assert said.startswith("The same cause is named for 12 of 12 students: own_scale.")


@pytest.mark.parametrize(
    ("change", "columns", "mend"),
    [
        (lambda f, v: v * 1000 if f in ("v_D", "a_D") else v, '"v_D", "a_D"', "v_D [mm/s]"),
        (lambda f, v: v / 1000, '"v_D", "a_D"', "correct the columns"),
        (lambda f, v: v / 10 if f in ("v_D_mm", "a_D_mm") else v, '"v_D_mm"', "v_D_mm [cm]"),
        (lambda f, v: v * 100 if f == "a_D" else v, 'column "a_D"', "a_D [cm/s2]"),
        (lambda f, v: v * 180 / pi if f == "omega_3" else v, '"omega_3"', "omega_3 [deg/s]"),
        (lambda f, v: v / 10 if f == "epsilon_4" else v, "1/10", "correct the columns"),
    ],
)
def test_columns_in_another_unit_are_told_and_nothing_is_marked(change, columns, mend):
    with pytest.raises(RosterError, match="another unit") as caught:
        whole_class(change)
    assert columns in str(caught.value)
    assert mend in str(caught.value)


@pytest.mark.parametrize("others", range(5))
def test_other_slips_of_a_few_do_not_hide_another_unit(others):
    """All are in mm/s; up to four of twelve are in m/s, or have another scale too."""
    takers, answers = keys_of(12)
    slips = [lambda _, v: v, lambda f, v: v * 400 if f[0] in "va" else v]
    given = {
        who: written(row, slips[i % 2] if i < others else all_in_mm)
        for i, (who, row) in enumerate(answers.items())
    }
    with pytest.raises(RosterError, match="another unit") as caught:
        graded_class(book_of("pump"), takers, given)
    assert '"v_D", "a_D"' in str(caught.value)


def all_in_mm(name: str, value: float) -> float:
    """The speeds and accelerations a thousand times as large; lengths and strokes stay."""
    return value * 1000 if name in ("v_D", "a_D") else value


def test_half_a_class_in_another_unit_is_marked():
    """Each of them has the cause."""
    takers, answers = keys_of(12)
    who = {each.student.id for each in takers[:6]}
    given = {
        i: written(row, lambda f, v, i=i: v * 1000 if i in who and f in ("v_D", "a_D") else v)
        for i, row in answers.items()
    }
    result = graded_class(book_of("pump"), takers, given)
    named = {each.taker.student.id for each in result.graded if each.causes}
    assert named == who
    assert {c.name for each in result.graded for c in each.causes} == {"power_of_ten"}


def test_a_class_may_be_marked_as_it_is():
    takers, answers = keys_of(12)
    ids = list(answers)
    shifted = {who: answers[ids[(i + 1) % len(ids)]] for i, who in enumerate(ids)}
    assert len(graded_class(book_of("pump"), takers, shifted, as_it_is=True).graded) == 12


OWN = """
[marking.causes.from_the_vertical]
set = { n = "n/2 - 2" }
cost = 0.12
en = "the angle was measured from the other axis"
ro = "unghiul a fost măsurat de la cealaltă axă"
"""
"""A cause of a lab: the crank of the pump stands at 30° + 2°·n, and turns at (300 + 10·n)/min."""


def lab_with(tmp_path, more: str):
    """The lab of the pump with more in its lab.toml."""
    found = lab_of("pump")
    (tmp_path / "scene.toml").write_text(found.scene.read_text("utf-8"), "utf-8")
    (tmp_path / "lab.toml").write_text(found.text + more, "utf-8")
    return read_lab(tmp_path)


def test_a_lab_names_a_cause_of_its_own(tmp_path):
    lab = lab_with(tmp_path, OWN)
    book = Book(lab, lab.scene.read_text("utf-8"))
    who = taker(17)
    sheet = book.marker_of(who).standard.paper
    scales = (sheet.mechanism, sheet.velocities, sheet.accelerations)
    found = mistaken.handed_in("pump", hand.data("pump", 6.5), scales, np.random.default_rng(4))
    answers = {item.field: read_answer(found[item.field], item) for item in book.form}
    (graded,) = graded_class(book, [who], {who.student.id: answers}).graded
    assert [cause.name for cause in graded.causes] == ["from_the_vertical"]
    assert graded.cost == graded.points * Fraction("0.12")
    assert "the other axis" in notes(graded, words("en"))[0]
    assert "cealaltă axă" in notes(graded, words("ro"))[0]
    assert "the other axis" in notes(graded, words("it"))[0]


def test_every_mistake_in_a_cause_of_a_lab_is_told(tmp_path):
    wrong = """
[marking.causes.odd]
set = { n = "number + 1", m = "3" }
cost = "grave"
"""
    with pytest.raises(SceneError) as caught:
        lab_with(tmp_path, wrong)
    told = {problem.place for problem in caught.value.problems}
    inside = "marking.causes.odd"
    assert told == {inside, f"{inside}.cost", f"{inside}.set.n", f"{inside}.set.m"}
