"""The pages of every example scene and of the labs: what is drawn is told, in both languages."""

from __future__ import annotations

import re

import pytest

from graphkin.paper.drawing import Drawing
from graphkin.paper.richtext import plain
from graphkin.paper.sentences import sentences
from graphkin.paper.symbolic import symbol
from graphkin.steps.program import Part, Plane, Step
from graphkin.text import LANGUAGES
from tests.mechanisms import SHIPPED
from tests.paper.sheet_tools import SCENES, calculations, drawings, named, relation_lines

WHICH = [(lab, 7, language) for lab in SHIPPED for language in LANGUAGES]
WHICH += [(name, None, language) for name in SCENES for language in LANGUAGES]
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
            step.says["symbol"]
            for _, step, _ in drawing.steps(drawing.plane)
            if step.arrow and step.says.get("kind") in ("ν", "c")
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
