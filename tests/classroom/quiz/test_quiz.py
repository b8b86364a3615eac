"""A lab as a quiz marks as grading does, wherever a platform can; read by Moodle's own rules."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from html import unescape
from xml.etree import ElementTree

import numpy as np
import pytest
from click.testing import CliRunner
from msgspec.structs import replace

from graphkin.classroom.grading.graded import Answer, Status
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.printing.print_work import PrintOrder
from graphkin.classroom.quiz.gaps import Gap, Taken, gaps
from graphkin.classroom.quiz.moodle_quiz import bank, cloze, questions, variants_of, weights
from graphkin.cli.main import app
from graphkin.text import LANGUAGES, words
from tests.classroom.grading.students import LABS, lab_of, marker_of, taker
from tests.classroom.quiz import moodle

SAID = words("en")


@cache
def read(name: str, n: int = 7) -> dict[str, moodle.Read]:
    """The gaps of a variant, written and read again, by their fields."""
    found = gaps(marker_of(name, n), lab_of(name).rubric.points, SAID)
    heavy, _ = weights(gap.points for gap in found)
    text = "".join(map(cloze, found, heavy))
    return dict(zip((gap.item.field for gap in found), moodle.gaps(text), strict=True))


def senses(name: str, n: int, field: str) -> dict[float, str]:
    """How the gap of a sense calls each."""
    one, other = (each.text for each in read(name, n)[field].answers)
    return {1.0: one, -1.0: other}


def given(name: str, n: int, field: str, value: float) -> str:
    return senses(name, n, field)[value] if field.endswith("_sense") else repr(float(value))


@pytest.mark.parametrize("name", LABS)
def test_the_key_earns_everything(name):
    for n in (1, 7, 19):
        key = marker_of(name, n).standard.key
        worth = sum(gap.weight for gap in read(name, n).values())
        earned = sum(
            gap.weight * gap.share(given(name, n, field, key[field]))[0]
            for field, gap in read(name, n).items()
        )
        assert earned == worth > 0


@pytest.mark.parametrize("name", LABS)
def test_a_single_wrong_value_is_right_or_not_as_in_grading(name):
    marker, rng = marker_of(name, 7), np.random.default_rng(7)
    standard = marker.standard
    for field, gap in read(name).items():
        if gap.kind != "NUMERICAL":
            continue
        for off in rng.uniform(-2, 2, 8):
            value = float(standard.key[field] + off * standard.tolerance[field].value)
            mark = marker.mark(taker(7), {field: Answer(repr(value), value)}).mark(field)
            share, _ = gap.share(repr(value))
            assert (share == 1) == (mark.status is Status.RIGHT), (field, off)


def test_a_slip_earns_its_share_once_and_then_what_follows():
    """Rev/min taken for rad/s: half at the first field, as much as what follows at the others."""
    name = "slotted-lever"
    lab, marker = lab_of(name), marker_of(name, 7)
    (slip,) = [each for each in marker.slips if each.name == "rpm_as_rad" and each.whole]
    told = [f for f in read(name) if f in slip.values and not f.endswith("_sense")]
    shares = [read(name)[field].share(repr(abs(slip.values[field]))) for field in told]
    follow = max(lab.rubric.follow, lab.rubric.slips["rpm_as_rad"])
    assert [share for share, _ in shares] == [
        lab.rubric.slips["rpm_as_rad"],
        *[follow] * (len(told) - 1),
    ]
    assert all("rev/min are taken for rad/s" in said for _, said in shares)


def test_a_sense_has_both_ways_and_one_is_right():
    for field, gap in read("pump").items():
        if field.endswith("_sense"):
            right = given("pump", 7, field, marker_of("pump", 7).standard.key[field])
            assert [each.text for each in gap.answers if each.share == 1] == [right]


def test_points_become_whole_numbers_in_their_proportion():
    assert weights([Fraction(1, 2), Fraction(2), Fraction(3, 4)]) == ([2, 8, 3], 4)
    assert weights([]) == ([], 1)


def test_no_text_ends_a_gap():
    item = next(iter(marker_of("pump", 7).standard.items))
    hostile = 'a~b#c}d{1:NM:=1}\\ "e" & <f> %50% =g'
    gap = Gap(
        replace(item, what="sense"), Fraction(1), (Taken(hostile, 0.0, Fraction(1), hostile),)
    )
    (back,) = moodle.gaps(f"before {cloze(gap, 3)} after")
    assert back.answers == (moodle.Answer(hostile, 0.0, 1.0, hostile),)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_bank_has_a_category_with_a_whole_question_for_each_variant(language):
    lab = lab_of("offset-slider-crank")
    fair, unfair = variants_of(lab, 3)
    order = PrintOrder(lab, lab.scene.read_text(encoding="utf-8"), language, "colour")
    data = bank("a/b", questions(order, fair, 1))
    assert data == bank("a/b", questions(order, fair, 1))
    found = moodle.imported(data)
    assert len(found) == len(fair) == 3 - len(unfair)
    assert [each.category for each in found] == [
        f"$course$/top/a//b/n = {n}, r = {r}" for n, r in ((1, 52), (2, 58), (3, 64))
    ]
    assert len({each.name for each in found}) == len(found)
    said = words(language)
    for each in found:
        assert len(each.gaps) == each.text.count("{") == len(lab.rubric.points)
        assert set(re.findall(r"@@PLUGINFILE@@/([^\"]+)", each.text)) == set(each.files)
        assert each.files["task.pdf"].startswith(b"%PDF")
        pictures = [data for name, data in each.files.items() if name.endswith(".svg")]
        assert len(pictures) == 2
        assert all(ElementTree.fromstring(data).tag.endswith("svg") for data in pictures)
        assert said("quiz.print") in unescape(each.text)
        assert f" {said('feedback.right')}"[1:] == each.gaps[0].answers[0].feedback


def test_ranges_give_as_many_variants_as_are_asked_for_each_once(tmp_path):
    lab = lab_of("offset-slider-crank")
    folder = tmp_path / "drawn"
    folder.mkdir()
    scene = lab.scene.read_text(encoding="utf-8")
    (folder / "scene.toml").write_text(scene, encoding="utf-8")
    rule = 'course = "x"\ndraw = { n = { min = 1, max = 6, step = 1 } }\n'
    text = re.sub(r"(?m)^set = .*$", rule, lab.text)
    (folder / "lab.toml").write_text(text, encoding="utf-8")
    fair, unfair = variants_of(read_lab(folder), 40)
    assert sorted(each.settings["n"] for each in (*fair, *unfair)) == [1, 2, 3, 4, 5, 6]


def test_the_command_writes_the_bank_and_leaves_out_what_is_unfair(tmp_path):
    args = ["quiz", "pump", "-o", str(tmp_path), "--count", "2", "--lang", "en", "--jobs", "1"]
    found = CliRunner().invoke(app, args)
    assert found.exit_code == 0, found.output
    assert "2 questions, a category for each" in found.output
    assert len(moodle.imported((tmp_path / "pump-moodle.xml").read_bytes())) == 2
    assert CliRunner().invoke(app, args).exit_code == 2
    assert CliRunner().invoke(app, [*args, "--force"]).exit_code == 0
