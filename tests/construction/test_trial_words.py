"""What sheets say and show of trials: lengths and places in full, each point where it is named."""

from __future__ import annotations

import re
from functools import cache
from math import degrees, hypot
from pathlib import Path

import numpy as np
import pytest

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import drawn_between
from graphkin.construction.core.sentence import Sentence
from graphkin.construction.higher_class.trial_plan import begun_by
from graphkin.construction.higher_class.two_trials import TAGS
from graphkin.documents.flattest import crossings_on
from graphkin.documents.relations import relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, hand_out, proved
from graphkin.documents.step_numbers import stages
from graphkin.drawing.marks import CircleMark, LineMark, Page
from graphkin.drawing.symbol_markup import TAGS as TAG_WORDS
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism, load
from graphkin.motion.motion_curves import curves_of
from graphkin.text import words

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
HIGHER = (
    "rapid-return",
    "rod-and-wheel",
    "stephenson-2-binary",
    "stephenson-2-ternary",
    "stephenson-3-crank",
)
"""The example scenes with a group of class III or more."""
RATE = re.compile(r"in the sense of \*[ωε]\*_\{(\d)\}(?: = \*[ωε]\*_\{(\d)\})?")


@cache
def mechanism(name: str) -> Mechanism:
    """An example scene, read once."""
    return load(SCENES / f"{name}.toml")


@cache
def drawn(name: str) -> tuple[tuple[Drawing, tuple[Sentence, ...], Page], ...]:
    """Both sheets of an example scene: what they are drawn from, their words, and the key."""
    some = mechanism(name)
    drawings = drawings_of(some, proved(some, some.solve()), words("en"))
    return tuple((d, tuple(sentences(d)), sheet(d, "key", "1")) for d in drawings)


@pytest.fixture(params=HIGHER)
def higher(request) -> str:
    return request.param


def said_as(said: tuple[Sentence, ...], name: str) -> str:
    """The sentence of a name."""
    return next(one.markup for one in said if one.name == name)


def points_of(drawing: Drawing, tag: str) -> list[int]:
    """The steps that find the points of a trial plan."""
    steps = drawing.trace.program.steps
    plans = drawing.auxiliary.items()
    return [number for number, own in plans if own.tag == tag and steps[number].name]


def test_every_length_that_a_trial_tries_is_told(higher):
    """By ω or ε of the trial it is another in each of them: a hand cannot take it from the other.

    One that is nought is none: its point falls on the one before, or on the end before it.
    """
    for drawing, said, _ in drawn(higher):
        for tag in TAGS:
            told, count = said_as(said, f"trial{tag}"), 0
            for number in points_of(drawing, tag):
                step = drawing.trace.program.steps[number]
                if begun_by(step) is not None:
                    size = drawn_between(drawing, step.args[0], number, step.plane)
                    amount = f"{drawing.words.fixed(size, 2)} mm"
                    assert (amount in told) is (size > 0), (step.name, amount)
                    count += 1
            assert count, higher


def test_the_calculation_tells_what_a_trial_lays_off_and_how_long_it_is_drawn(higher):
    """The same length as the sentence on the sheet says, from the amount that it stands for."""
    sections = dict(relations([drawing for drawing, _, _ in drawn(higher)]))
    for drawing, _, _ in drawn(higher):
        plan = "velocities" if drawing.kind == "velocity" else "accelerations"
        told = [each for each in sections[plan] if "drawn" in each.remark and each.unit]
        laid_off = []
        for number in (n for tag in TAGS for n in sorted(points_of(drawing, tag))):
            step = drawing.trace.program.steps[number]
            if begun_by(step) is not None:
                size = drawn_between(drawing, step.args[0], number, step.plane)
                laid_off += [(TAG_WORDS[drawing.auxiliary[number].tag], size)] if size else []
        tried = [each for each in told if each.left.endswith(("I}", "I}^{τ}"))]
        assert len(tried) == len(laid_off) > 0, higher
        scale = (drawing.scales.kv if drawing.kind == "velocity" else drawing.scales.ka) / 1000
        for each, (tag, size) in zip(tried, laid_off, strict=True):
            assert each.left.partition("}")[0].endswith(f",{tag}"), each
            assert f"drawn {size:.2f} mm" in each.remark, each
            assert float(each.result) == pytest.approx(scale * size, rel=2e-3), each
            assert each.remark.startswith("⊥ ") is bool(each.symbols), each
            assert (f",{tag}}}·" in each.symbols) is bool(each.symbols), each


def test_the_words_of_a_trial_name_each_of_its_points(higher):
    for drawing, said, _ in drawn(higher):
        for tag in TAGS:
            for number in points_of(drawing, tag):
                name = symbol(drawing.trace.program.steps[number].name)
                assert name in said_as(said, f"trial{tag}")


def test_a_point_of_a_trial_is_drawn_with_the_sentence_that_names_it(higher):
    for drawing, said, _ in drawn(higher):
        staged = stages(drawing, said)
        for tag in TAGS:
            (stage,) = (at for at, one in enumerate(said) if one.name == f"trial{tag}")
            assert {staged[number] for number in points_of(drawing, tag)} == {stage}


def test_in_words_of_a_trial_no_triangle_is_without_size(higher):
    """Of a plan that is all at its pole nothing is constructed; the other trial is told in full."""
    for drawing, said, _ in drawn(higher):
        steps = drawing.trace.program.steps
        for tag in TAGS:
            for number in points_of(drawing, tag):
                step, told = steps[number], said_as(said, f"trial{tag}")
                ends = [arg for arg in step.args if steps[arg].plane is step.plane]
                figure = "".join(symbol(steps[arg].name) for arg in (*ends, number))
                if step.action is not None and step.action.key == "similar-point":
                    flat = drawn_between(drawing, ends[0], ends[1], step.plane) < 1e-9
                    assert not (flat and figure in told)
    (drawing, said, page), _ = drawn("rod-and-wheel")
    assert said_as(said, "trial¹").endswith("*c*_{I}, *b*_{I}, *b*_{1,I} fall on *o*")
    lines = [mark.step for mark in page.marks if isinstance(mark, LineMark) and mark.step]
    assert {drawing.auxiliary[step].tag for step in lines if step in drawing.auxiliary} == {"²"}
    assert "*b*_{1,I}" not in {symbol(c.name) for c in crossings_on(drawing)}
    assert "*C**T**B*" in said_as(said, "trial²")


def test_the_point_of_another_link_is_explained_where_it_is_used_first():
    (_, said, _), _ = drawn("rod-and-wheel")
    first = next(one.markup for one in said if "*B*_{1}" in one.markup)
    assert "*B*_{1} is the point of link 1 at *B*" in first


def test_a_rate_that_is_laid_off_by_is_the_tried_one_or_said_to_equal_it(higher):
    """On the rapid return link 3 turns as link 2 does, which alone is tried."""
    for drawing, said, _ in drawn(higher):
        for tag in TAGS:
            told = said_as(said, f"trial{tag}")
            tried = re.match(r"[a-z ,()]*with[^=]*\*[ωε]\*_\{(\d)\} = ", told)
            for own, equal in RATE.findall(told):
                assert tried is not None
                assert (equal or own) == tried[1], (drawing.kind, told)
    (_, said, _), _ = drawn("rapid-return")
    assert "*ω*_{3} = *ω*_{2}" in said_as(said, "trial¹")


def test_the_place_that_closes_a_group_is_told_in_figures(higher):
    """The angle of the tried link, or how far from the zero of its guide a point stands."""
    drawing, said, _ = drawn(higher)[0]
    steps, told = drawing.trace.program.steps, 0
    for number, value in drawing.trace.values.items():
        step = steps[number]
        key = step.action.key if step.action else ""
        tried = len(step.args) > 1 and (a := steps[step.args[1]].action) and a.key == "part"
        if tried and key in ("arm", "guide-back", "set-at"):
            markup = next(one.markup for one in said if number in behind(drawing, one))
            if key == "set-at":
                size = abs(float(drawing.trace.values[step.args[1]]))
                figure = f"{drawing.words.fixed(1000 * size / drawing.scales.kL, 2)} mm"
            else:
                way = (
                    value.along
                    if key == "guide-back"
                    else value - drawing.trace.values[step.args[0]]
                )
                figure = f"{drawing.words.fixed(degrees(np.angle(way)), 1)}°"
            assert figure in markup
            told += 1
    assert told == 1


def behind(drawing: Drawing, said: Sentence) -> set[int]:
    """The steps of a sentence and the lines that these are found by."""
    steps = drawing.trace.program.steps
    return {n for own in said.all_steps for n in (own, *steps[own].args)}


def test_the_line_of_two_trials_passes_both(higher):
    """And a little beyond them: q′ of the rapid return lies between its trials, near the second."""
    for drawing, _, page in drawn(higher):
        steps = drawing.trace.program.steps
        spots = {m.step: (m.cx, m.cy) for m in page.marks if isinstance(m, CircleMark)}
        lines = [m for m in page.marks if isinstance(m, LineMark) and m.cls == "trial-line"]
        for line in lines:
            if line.step is not None and line.name != "gap":
                length = hypot(line.x2 - line.x1, line.y2 - line.y1)
                for end in steps[line.step].args[:2]:
                    x, y = spots[end]
                    before = hypot(x - line.x1, y - line.y1)
                    after = hypot(x - line.x2, y - line.y2)
                    assert min(before, after) > 3
                    assert abs(before + after - length) < 1e-6


def test_no_arrow_covers_the_point_of_a_trial(higher):
    """What is put down later covers: only a right point may stand on that of a trial."""
    for _, _, page in drawn(higher):
        circles = [m for m in page.marks if isinstance(m, CircleMark)]
        heads = [i for i, m in enumerate(page.marks) if m.step and "arrowhead" in m.cls]
        own = [(i, m) for i, m in enumerate(page.marks) if m in circles and "trial" in m.cls]
        assert own and heads
        right = [(m.cx, m.cy) for m in circles if "trial" not in m.cls]
        for i, mark in own:
            if all(hypot(mark.cx - x, mark.cy - y) > 1 for x, y in right):
                assert i > max(heads)


def test_two_loci_show_how_a_bar_that_moves_with_both_ends_closes_a_group():
    """Each through its point; where they are a bar apart no lines cross."""
    some = mechanism("stephenson-2-binary")
    trace = some.trace()
    curves = {curve.of: curve for curve in curves_of(some)}
    assert list(curves) == ["B", "D"]
    for of, curve in curves.items():
        (run,) = curve.runs
        assert min(abs(np.array(run) - trace.value("position", of))) < 0.01 * abs(run[0] - run[-1])
        steps = np.diff(run)
        assert ((steps[1:] * steps[:-1].conjugate()).real > 0).all()
    sheets = hand_out(some, view="steps", language="en")
    pages = next(made.pages for made in sheets if made.kind == "velocity")
    first = next(i for i, page in enumerate(pages) if "locus B" in {m.name for m in page.marks})
    marks = pages[first].marks
    assert {"locus B", "locus D"} <= {mark.name for mark in marks}
    assert not [mark for mark in marks if mark.name == "crossing"]
    (said,) = (mark.markup for mark in marks if mark.name == "sentence" and "loci" in mark.markup)
    assert "*B*" in said
