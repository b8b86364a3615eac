"""A lab as a quiz marks as grading does, wherever a platform can; read by Moodle's own rules."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from functools import cache
from html import unescape
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from click.testing import CliRunner
from moodle_xml_parser.parser import parse_bytes
from msgspec.structs import replace

from graphkin.classroom.grading.graded import Answer, Status
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.printing.print_run import PrintOrder
from graphkin.classroom.quiz.moodle_quiz import (
    Gap,
    Taken,
    bank,
    cloze,
    gaps,
    questions,
    variants_of,
    weights,
)
from graphkin.cli.main import app
from graphkin.text import words
from tests.chosen import EVERY, SPOKEN
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
        for field, gap in read(name, n).items():
            if field.endswith("_sense"):  # it has both ways, and one is right
                right = given(name, n, field, key[field])
                assert [each.text for each in gap.answers if each.share == 1] == [right]


@pytest.mark.parametrize("name", LABS)
def test_a_single_wrong_value_is_right_or_not_as_in_grading(name):
    marker, rng = marker_of(name, 7), np.random.default_rng(7)
    standard = marker.standard
    for field, gap in read(name).items():
        if gap.kind != "NUMERICAL":
            continue
        for off in rng.uniform(-2, 2, 8 if EVERY else 2):
            value = float(standard.key[field] + off * standard.tolerance[field].value)
            mark = marker.mark(taker(7), {field: Answer(repr(value), value)}).mark(field)
            share, _ = gap.share(repr(value))
            assert (share == 1) == (mark.status is Status.RIGHT), (field, off)


def test_a_rate_near_zero_is_right_with_either_sign_as_in_grading():
    standard, field = replace(marker_of("pump", 7).standard), "omega_3"
    allowed = marker_of("pump", 7).standard.tolerance
    for part in (-0.9, -0.3, 0.0, 0.3, 0.9, 1.1):
        key = {**marker_of("pump", 7).standard.key, field: part * allowed[field].value}
        vars(standard).update(key=key, tolerance=allowed)
        marker = Marker(standard)
        (gap,) = gaps(marker, {field: Fraction(1)}, SAID)
        (back,) = moodle.gaps(cloze(gap, 1))
        for times in (-2.0, -1.35, -1.25, -0.5, 0.5, 1.25, 1.35, 2.0):
            value = times * allowed[field].value
            status = marker.mark(taker(7), {field: Answer(repr(value), value)}).mark(field).status
            assert (back.share(repr(value))[0] == 1) == (status is Status.RIGHT), (part, times)


def test_moodle_itself_read_what_is_kept_here_and_this_reader_reads_the_same():
    """A bank with hostile texts, and what Moodle's own importer (4.0dev, qformat_xml with
    qtype_multianswer and its validation) made of it; no error was found."""
    kept = Path(__file__).with_name("read-by-moodle.xml").read_bytes()
    told = json.loads(Path(__file__).with_name("read-by-moodle.json").read_text(encoding="utf-8"))
    kinds = {"numerical": "NUMERICAL", "multichoice": "MULTICHOICE"}
    found = moodle.imported(kept)
    assert len(found) == len(told["questions"]) == 2
    for mine, other in zip(found, told["questions"], strict=True):
        assert (mine.category, mine.name) == (other["category"], other["name"])
        assert sum(gap.weight for gap in mine.gaps) == other["mark"]
        assert [(gap.kind, gap.weight) for gap in mine.gaps] == [
            (kinds[gap["type"]], gap["mark"]) for gap in other["gaps"]
        ]
        for gap, same in zip(mine.gaps, other["gaps"], strict=True):
            assert [[a.text, a.allowed, a.share, a.feedback] for a in gap.answers] == same[
                "answers"
            ]
    assert [[n, len(data)] for each in found for n, data in each.files.items()] == told["files"]


@pytest.mark.parametrize("name", LABS[:1])
def test_the_reader_of_a_package_reads_the_same(name):
    """moodle-xml-parser, of the registry: gaps, points, answers, shares in whole percent."""
    lab = lab_of(name)
    fair, _ = variants_of(lab, 2)
    order = PrintOrder(lab, lab.scene.read_text(encoding="utf-8"), "en", "colour")
    data = bank(name, questions(order, fair, 1))
    own, others = moodle.imported(data), parse_bytes(data)["cloze"]
    assert [each.name for each in others] == [each.name for each in own]
    for mine, other in zip(own, others, strict=True):
        assert [gap.sub_grade for gap in other.gaps] == [gap.weight for gap in mine.gaps]
        for gap, same in zip(mine.gaps, other.gaps, strict=True):
            assert [each.answer.lstrip("=").partition(":")[0] for each in same.options] == [
                each.text for each in gap.answers
            ]
            assert [each.score for each in same.options] == [
                round(100 * each.share) for each in gap.answers
            ]


def test_shares_are_whole_percent():
    """Of 33.3 % an older Moodle makes an answer that is no number."""
    item = next(iter(marker_of("pump", 7).standard.items))
    takes = [Taken(1.0, 0.1, Fraction(1), ""), Taken(2.0, 0.1, Fraction(1, 3), "")]
    assert cloze(Gap(item, Fraction(1), tuple(takes)), 1) == "{1:NUMERICAL:=1:0.1#~%33%2:0.1#}"


def test_data_too_long_for_a_title_block_make_a_quiz_as_well(tmp_path):
    """Ten drawn parameters: the sheets bear the number of the question, and name all data."""
    shipped = lab_of("slotted-lever")
    scene = shipped.scene.read_text(encoding="utf-8")
    more = {f"unused{i}": f"{{ value = {i}, min = 1, max = 90, step = 1 }}" for i in range(10, 18)}
    lines = "".join(f"{name} = {value}\n" for name, value in more.items())
    text = scene.replace("[parameters]\n", f"[parameters]\n{lines}")
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    drawn = ", ".join(f"{name} = {{ min = 1, max = 90, step = 1 }}" for name in more)
    rules = re.sub(r"(?m)^draw = \{", f"draw = {{ {drawn},", shipped.text)
    (tmp_path / "lab.toml").write_text(rules, encoding="utf-8")
    lab = read_lab(tmp_path)
    fair, _ = variants_of(lab, 2)
    (one, _) = questions(PrintOrder(lab, text, "en", "colour"), fair, 1)
    assert all(f"{name} = " in one.name for name in (*more, "n", "r"))


def test_data_are_written_as_the_sheets_write_them(tmp_path):
    """φ₁ = 130°, not phi = 130: names are plain text, the task is markup."""
    shipped = lab_of("offset-slider-crank")
    scene = shipped.scene.read_text(encoding="utf-8")
    scene = scene.replace('"128 + 6*n/5"', '"phi"')
    phi = "[parameters]\nphi = { value = 130, min = 0, max = 360 }\n"
    scene = scene.replace("[parameters]\n", phi)
    (tmp_path / "scene.toml").write_text(scene, encoding="utf-8")
    rules = re.sub(r"(?m)^set = .*$", 'set = { phi = "130 + number/2", n = 7 }', shipped.text)
    (tmp_path / "lab.toml").write_text(rules, encoding="utf-8")
    lab = read_lab(tmp_path)
    every, _ = variants_of(lab, 1)
    (found,) = questions(PrintOrder(lab, scene, "it", "colour"), every, 1)
    assert found.name == "φ = 130,5°, n = 7"
    for each in (found.text, found.task):
        assert "; <i>φ</i> = 130,5°, <i>n</i> = 7</p>" in each


def test_no_text_ends_a_gap():
    """And points become whole numbers in their proportion."""
    item = next(iter(marker_of("pump", 7).standard.items))
    hostile = 'a~b#c}d{1:NM:=1}\\ "e" & <f> %50% =g'
    taken = (Taken(hostile, 0.0, Fraction(1), hostile),)
    (back,) = moodle.gaps(f"before {cloze(Gap(replace(item, what='sense'), 1, taken), 3)} after")
    assert back.answers == (moodle.Answer(hostile, 0.0, 1.0, hostile),)
    assert weights([Fraction(1, 2), Fraction(2), Fraction(3, 4)]) == ([2, 8, 3], 4)
    assert weights([]) == ([], 1)


@pytest.mark.parametrize("language", SPOKEN)
def test_the_bank_has_a_category_with_a_whole_question_for_each_variant(language):
    lab = lab_of("offset-slider-crank")
    fair, unfair = variants_of(lab, 3)
    order = PrintOrder(lab, lab.scene.read_text(encoding="utf-8"), language, "colour")
    data = bank("a/b", questions(order, fair, 1))
    found = moodle.imported(data)
    assert len(found) == len(fair) == 3 - len(unfair)
    assert [each.category for each in found] == [
        f"$course$/top/a//b/n = {n}, r = {r} mm" for n, r in ((1, 52), (2, 58), (3, 64))
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
    args = [
        "quiz",
        "offset-slider-crank",
        "-o",
        str(tmp_path),
        "--count",
        "2",
        "--lang",
        "en",
        "--jobs",
        "1",
    ]
    found = CliRunner().invoke(app, args)
    assert found.exit_code == 0, found.output
    assert "questions: 2, each with a category of its own" in found.output
    path = tmp_path / "offset-slider-crank-moodle.xml"
    before = path.read_bytes()
    assert len(moodle.imported(before)) == 2
    assert CliRunner().invoke(app, args).exit_code == 2
    assert CliRunner().invoke(app, [*args, "--force"]).exit_code == 0
    assert path.read_bytes() == before


def test_a_class_gives_the_quiz_of_its_lab_in_its_language(tmp_path):
    roster = tmp_path / "class.csv"
    roster.write_text("nr;id\n7;1\n", encoding="utf-8")
    folder = str(tmp_path / "class")
    args = ["variants", "pump", str(roster), "-o", folder, "--lang", "it"]
    assert CliRunner().invoke(app, args).exit_code == 0
    for out, source, more in (("a", folder, ()), ("b", "pump", ("--lang", "it"))):
        args = ["quiz", source, "-o", str(tmp_path / out), "--count", "1", "--jobs", "1"]
        assert CliRunner().invoke(app, [*args, *more]).exit_code == 0
    first, second = ((tmp_path / s / "pump-moodle.xml").read_bytes() for s in "ab")
    assert first == second
