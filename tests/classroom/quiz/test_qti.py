"""Packages for Canvas and for QTI 3.0 mark as grading does, read by rules of their own."""

from __future__ import annotations

import re
from fractions import Fraction
from xml.etree.ElementTree import Element, fromstring

import numpy as np
import pytest

from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.marking import is_right
from graphkin.classroom.grading.standard import sense_is_open
from graphkin.classroom.quiz.moodle_quiz import FILES, Gap, Question, gaps
from graphkin.classroom.quiz.qti_packages import canvas_package, exact, qti3_package
from graphkin.text import words
from tests.classroom.grading.students import LABS, lab_of, marker_of
from tests.classroom.quiz import qti
from tests.running import ran

SAID = words("en")
HOSTILE = "<b>&\"']]> {~#"


def question(name: str, n: int) -> Question:
    found = gaps(marker_of(name, n), lab_of(name).rubric.points, SAID)
    files = (("task.pdf", b"%PDF"), ("task-velocity.svg", b"<svg/>"))
    task = f'<p>n = {n}</p><p><img src="{FILES}/task-velocity.svg" alt="task" /></p>'
    return Question(f"n = {n} {HOSTILE}", "", f"remark {HOSTILE}", files, task, found)


def canvas(name: str, n: int) -> tuple[list[Gap], list[qti.CanvasQuestion]]:
    """The fields that Canvas asks, and its questions, without the first, which is the task."""
    own = question(name, n)
    files = qti.unpacked(canvas_package(name, [own], SAID))
    (quiz,) = (data for path, data in files.items() if re.fullmatch(r"(g\w+)/\1\.xml", path))
    first, *rest = qti.canvas_quiz(quiz)
    assert (first.kind, first.points) == ("text_only_question", 0)
    for source in re.findall(r'src="%24IMS-CC-FILEBASE%24/([^"]+)"', first.text):
        assert source in files
    standard = marker_of(name, n).standard
    senses = (gap.item.field for gap in own.gaps if gap.item.what == "sense")
    is_open = {field for field in senses if sense_is_open(standard, field)}
    return [gap for gap in own.gaps if gap.item.field not in is_open], rest


def item3(name: str, n: int) -> qti.Item3:
    files = qti.unpacked(qti3_package(name, [question(name, n)], SAID))
    (path,) = (path for path in files if re.fullmatch(r"items/g\w+\.xml", path))
    root = fromstring(files[path])
    for image in root.iter("img"):
        assert f"items/{image.get('src')}" in files
    return qti.Item3(root)


@pytest.mark.parametrize("name", LABS)
@pytest.mark.parametrize("n", [1, 7, 19])
def test_the_key_earns_everything_and_nothing_else_does(name: str, n: int) -> None:
    asked, found = canvas(name, n)
    key = marker_of(name, n).standard.key
    assert len(asked) == len(found)
    for gap, each in zip(asked, found, strict=True):
        right = exact(gap.item.size(key[gap.item.field]) / gap.item.one)
        if each.choices:
            (right,) = (take.answer for take in gap.takes if take.share == 1)
            (wrong,) = (take.answer for take in gap.takes if take.share == 0)
            assert each.earns(wrong) == 0
        assert each.earns(right) == float(gap.points) > 0
    item = item3(name, n)
    assert item.asked.keys() == item.correct.keys()
    assert item.score({}) == 0
    points = sum(gap.points for gap in question(name, n).gaps)
    assert item.score(item.correct) == pytest.approx(float(points))


@pytest.mark.parametrize("name", LABS)
def test_a_single_wrong_value_is_right_or_not_as_in_grading(name: str) -> None:
    rng, standard, item = np.random.default_rng(7), marker_of(name, 7).standard, item3(name, 7)
    asked, found = canvas(name, 7)
    responses = dict(zip((g.item.field for g in question(name, 7).gaps), item.correct, strict=True))
    for gap, each in zip(asked, found, strict=True):
        if each.choices:
            continue
        for off in rng.uniform(-2, 2, 8):
            field = gap.item.field
            value = float(standard.key[field] + off * standard.tolerance[field].value)
            good = is_right(standard, field, {field: Answer(repr(value), value)})
            given = exact(value / gap.item.one, 12)
            assert (each.earns(given) > 0) == good, (field, off)
            score = item.score({responses[field]: given})
            assert (score == pytest.approx(float(gap.points))) == good, (field, off)


def test_what_a_cause_leaves_is_earned_in_qti_3() -> None:
    item, own = item3("pump", 7), question("pump", 7)
    shares = set[Fraction]()
    for response, gap in zip(item.correct, own.gaps, strict=True):
        for take in gap.takes:
            if not isinstance(take.answer, str):
                score = item.score({response: exact(take.answer)})
                assert score == pytest.approx(float(gap.points * take.share))
                shares.add(take.share)
    assert len(shares) > 1


def test_several_variants_are_one_package_and_the_same_bytes() -> None:
    every = [question("pump", n) for n in (7, 8)]
    for package in (canvas_package, qti3_package):
        data = package(HOSTILE, every, SAID)
        assert data == package(HOSTILE, every, SAID)
        qti.unpacked(data)


def test_numbers_have_no_exponent() -> None:
    assert [exact(x) for x in (1e-7, -2.5e-5, 3.0, 1e9)] == [
        *("0.0000001", "-0.000025", "3", "1000000000")
    ]


def shape(element: Element) -> tuple[object, ...]:
    """An element without its texts and without the values of names."""
    own = {key: "" if key in ("ident", "title") else value for key, value in element.items()}
    return element.tag, sorted(own.items()), [shape(each) for each in element]


def test_a_question_has_the_shape_that_another_program_writes_for_canvas() -> None:
    """text2qti, whose packages Canvas reads."""
    from text2qti.config import Config
    from text2qti.qti import QTI
    from text2qti.quiz import Quiz

    config = Config()
    config.load()
    own = question("pump", 7)
    number = next(gap for gap in own.gaps if gap.item.what == "segment")
    sense = next(gap for gap in own.gaps if gap.item.what == "sense")
    text = "Quiz title: x\n\n1. a\n=  12.5 +- 0.5\n\n1. b\n*a) ccw\nb) cw\n"
    theirs = fromstring(QTI(Quiz(text, config=config, source_name="x")).assessment)
    asked, _ = canvas("pump", 7)
    files = qti.unpacked(canvas_package("pump", [own], SAID))
    quiz = next(data for path, data in files.items() if re.fullmatch(r"(g\w+)/\1\.xml", path))
    mine = list(fromstring(quiz).iter(f"{qti.ONE}item"))[1:]
    first, second = theirs.iter(f"{qti.ONE}item")
    assert shape(mine[asked.index(number)]) == shape(first)
    other = shape(mine[asked.index(sense)])
    html = str(other).replace("text/plain", "text/html")
    assert html == str(shape(second))


def test_the_command_writes_a_package_for_each_platform(tmp_path) -> None:
    assert ran("new", "lab", "crank-lab", "-o", tmp_path).exit_code == 0
    lab = tmp_path / "crank-lab"
    told = ran("quiz", lab, "-o", tmp_path, "--count", 1, "--format", "canvas,qti3", "--jobs", 1)
    assert told.exit_code == 0, told.output
    names = {path.name for path in tmp_path.glob("crank-lab-*")}
    assert names == {"crank-lab-canvas.zip", "crank-lab-qti3.zip"}
    for name in names:
        files = qti.unpacked((tmp_path / name).read_bytes())
        assert any(path.endswith("task.pdf") for path in files)
    refused = ran("quiz", lab, "-o", tmp_path, "--format", "blackboard")
    assert refused.exit_code == 2 and "blackboard" in refused.output
