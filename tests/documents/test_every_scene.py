"""The pages of every example scene and of the labs: what is drawn is told, in both languages."""

from __future__ import annotations

import re

import pytest

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.plan_vector import sign_of
from graphkin.construction.core.program import Part, Plane, Step
from graphkin.documents.sentences import sentences
from graphkin.drawing.richtext import plain
from graphkin.drawing.style import style_of
from graphkin.drawing.symbol_markup import symbol
from graphkin.text import LANGUAGES
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import (
    calculations,
    drawings,
    drawn,
    is_label,
    kind_of,
    named,
    relation_lines,
)
from tests.mechanisms import SHIPPED

WHICH = [(lab, 7) for lab in SHIPPED] + [(name, None) for name in CHOSEN]
WHICH = [(*which, LANGUAGES[i % 3]) for i, which in enumerate(WHICH)]
LEFT_OPEN = re.compile(r"[{}]|None|nan\b|  | [,;)]|\( |[;,]$|^[;,]|= *[;,]|∥ *[;,]|⊥ *[;,]")
"""What a sentence looks like in which something is missing."""
BREAKS = re.compile(r" {2}(?=\S)")
"""The wider gaps that stand between the parts of a vector equation."""


@pytest.fixture(params=WHICH, ids=named)
def sheets(request) -> tuple[Drawing, ...]:
    return drawings(*request.param)


def is_told_here(drawing: Drawing, number: int, step: Step) -> bool:
    """Whether a step finds a named point of this sheet."""
    if step.arrow or not step.name or step.given is not None or number in drawing.results:
        return False
    if step.plane is Plane.MECHANISM:
        first = step.part is Part.POSITION and not drawing.again
        return first and step.name not in drawing.scene.frame.points
    return step.plane is drawing.plane


def test_every_point_that_is_found_is_told(sheets):
    for drawing in sheets:
        text = " | ".join(sentence.markup for sentence in sentences(drawing))
        missing = [
            step.name
            for number, step, _ in drawing.steps(Plane.MECHANISM, drawing.plane)
            if is_told_here(drawing, number, step) and symbol(step.name) not in text
        ]
        assert not missing, (drawing.kind, missing)


def test_every_line_and_component_of_a_plan_is_told(sheets):
    for drawing in sheets:
        text = " | ".join(sentence.markup for sentence in sentences(drawing))
        symbols = {
            step.of.symbol
            for _, step, _ in drawing.steps(drawing.plane)
            if sign_of(step) in ("ν", "c")
        }
        missing = [name for name in symbols if symbol(name) not in text]
        assert not missing, (drawing.kind, missing)


def test_no_sentence_has_a_gap(sheets):
    for drawing in sheets:
        for sentence in sentences(drawing):
            text = plain(sentence.markup)
            assert text and not LEFT_OPEN.search(text), text


@pytest.mark.parametrize("which", WHICH, ids=named)
def test_no_relation_has_a_gap(which):
    name, n, language = which
    for _, line in relation_lines(calculations(name, n, "key", language)):
        text = BREAKS.sub(" ", plain(line)).rstrip(";,")
        assert not LEFT_OPEN.search(text), text


SLOTTED = ("crank-slot", "oscillating-slide", "oldham", "rapid-return-slider")
TRIED = ("rapid-return", "rod-and-wheel", "stephenson-2-binary", "stephenson-3-crank")


@pytest.mark.parametrize("name", SLOTTED)
def test_a_coriolis_component_is_as_long_on_the_mechanism_as_in_the_plan(name):
    """The triangles are drawn at the scale of the plan, for ka = kv²/kL, and give its direction."""
    page = drawn(name, None, "acceleration")
    plan, mechanism = (
        {mark.name: mark for mark in page.vectors(field) if kind_of(mark) == "coriolis"}
        for field in ("plan", "mechanism")
    )
    assert mechanism
    for key in plan.keys() & mechanism.keys():
        one, two = (
            complex(mark.x2 - mark.x1, mark.y2 - mark.y1) for mark in (plan[key], mechanism[key])
        )
        assert abs(one - two) <= 1e-6 * abs(one), key


@pytest.mark.parametrize("name", TRIED)
def test_every_point_of_the_right_plan_stands_on_the_line_of_its_trials_in_one_ratio(name):
    for drawing in drawings(name):
        values, steps = drawing.trace.values, drawing.trace.program.steps
        shares = set()
        for _, step, value in drawing.steps(drawing.plane):
            if step.action.key == "between":
                first, second = (values[arg] for arg in step.args[:2])
                assert {steps[arg].name[-1] for arg in step.args[:2]} == set("¹²")
                if abs(second - first) > 1e-9:
                    shares.add(round(((value - first) / (second - first)).real, 6))
        assert len(shares) == 1, shares
        assert {plan.tag for plan in drawing.auxiliary.values()} == set("¹²")


def test_a_trial_is_drawn_thin_and_grey_and_no_vector_belongs_to_it():
    page = drawn("rapid-return", None, "acceleration")
    tags = page.drawing.auxiliary
    marks = [mark for mark in page.marks["plan"] if mark.step in tags and not is_label(mark)]
    assert marks
    assert {kind_of(mark) for mark in marks} == {"trial", "point"}
    assert style_of("trial").width < style_of("acceleration").width / 2
