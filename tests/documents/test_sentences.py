"""What the sentences, the data and the calculation say is enough to draw by, in every scene."""

from __future__ import annotations

import re
from cmath import phase
from math import degrees

import pytest

from graphkin.construction.centres.instant_centre import set_before
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.sentence import Sentence
from graphkin.construction.core.solution import Verdict
from graphkin.documents.relations import relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import plain
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.chosen import CHOSEN, SCENES
from tests.documents.made_up import HEAD
from tests.documents.sheet_tools import drawings, drawn, kinds_of, named
from tests.scene_files import scene_text

LABS = [(lab, n) for lab in ("pump", "slotted-lever") for n in (7, 20)]
ALL = [*((name, None) for name in CHOSEN), *LABS]
HIGHER = (
    "rapid-return",
    "rod-and-wheel",
    "stephenson-2-binary",
    "stephenson-2-ternary",
    "stephenson-3-crank",
)
NORMAL = re.compile(r"lay off [^;:]*?(\*a\*_\{[^}]*\}\^\{ν\})")
BAR = re.compile(r"[/·]((?:\*[A-Z]\*(?:_\{[^}]*\})?){2})$")
ARTICLES = re.compile(r"\b(?:a|da|di|su|in) (?:la|il|lo|le|gli|i) |\b(?:a|da|di|su) l['’]")
CLASHING = re.compile(r"(?<!\S)(?:a A|a a|e E|e e)")


@pytest.fixture(params=ALL, ids=named)
def both(request) -> tuple[Drawing, ...]:
    return drawings(*request.param)


def written(text: str, kind: int) -> list[Sentence]:
    """The sentences of one sheet of a scene given as text."""
    mechanism = Mechanism(read_text(HEAD + text, "written", None, {}))
    verdict = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
    return sentences(drawings_of(mechanism, verdict, words("en"))[kind])


def all_said(found: tuple[Drawing, ...]) -> list[str]:
    """Every sentence, piece of data and remark of a scene."""
    said = [piece for drawing in found for piece in given(drawing)]
    said += [one.markup for drawing in found for one in sentences(drawing)]
    return said + [r.remark for _, section in relations(found) for r in section]


def test_every_normal_component_that_is_laid_off_has_a_length_or_a_triangle(both):
    for drawing in both:
        told: set[str] = set()
        for said in sentences(drawing):
            for clause in said.markup.split("; "):
                for name in NORMAL.findall(clause):
                    assert re.search(r"\d mm", clause) or name in told, (clause, told)
            if said.name in ("ν1", "ν", "ν none", "ν by number", "ν by chord"):
                told |= set(re.findall(r"\*a\*_\{[^}]*\}\^\{ν\}", said.markup))


def test_the_last_sentence_names_what_is_set_on_the_mechanism(both):
    for drawing in both:
        part = Part.VELOCITY if drawing.kind == "velocity" else Part.ACCELERATION
        early = set_before(drawing)
        arrows = {
            symbol(step.of.symbol)
            for number, step, arrow in drawing.steps(Plane.MECHANISM)
            if step.arrow and step.part is part and abs(arrow.tip - arrow.tail) > 1e-9
            if number not in early
        }
        last = sentences(drawing)[-1].markup
        listed = re.fullmatch(r"set (.*) on the mechanism, each at its point(;.*)?", last)
        assert arrows == (set(listed[1].split(", ")) if listed else set()), last


def test_every_length_of_the_calculation_is_given_or_measured_before(both):
    told = set(re.findall(r"(?:\*[A-Z]\*(?:_\{[^}]*\})?){2}(?= =)", " ".join(given(both[0]))))
    drawn_before = False
    for section, found in relations(both):
        drawn_before |= section == "lengths"
        for relation in found:
            told.add(relation.left)
            bar = BAR.search(relation.symbols)
            if bar and drawn_before:
                turned = "".join(reversed(re.findall(r"\*[A-Z]\*(?:_\{[^}]*\})?", bar[1])))
                assert {bar[1], turned} & told, relation
    assert drawn_before


def test_exact_scale_factors_have_no_noughts_at_their_end():
    for name in ("slider-crank", "pump-collinear", "rapid-return", "gears-ring"):
        n = None if name in SCENES else 7
        for kind in kinds_of(name, n):
            captions = [
                mark.markup
                for mark in drawn(name, n, kind).page.marks
                if isinstance(mark, Text) and re.search(r"\*k\*_[va] = [\d.]+ ", mark.markup)
            ]
            assert captions
            assert not [text for text in captions if re.search(r"\.\d*0 \(", text)]


# --- trial plans ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", HIGHER)
def test_the_gaps_of_the_trials_divide_the_line_as_the_sentence_says(name):
    """Checked on the plan itself: the parts of the line are to each other as the two numbers."""
    for drawing in drawings(name):
        (said,) = [s for s in sentences(drawing) if "divide the line" in s.markup]
        one, two = (
            float(text) for text in re.search(r"= ([\d.]+) : ([\d.]+)", said.markup).groups()
        )
        for number in said.all_steps:
            step = drawing.trace.program.steps[number]
            first, second, _ = (drawing.trace.values[arg] for arg in step.args)
            right, apart = drawing.trace.values[number], abs(second - first)
            if apart:
                parts = abs(right - first), abs(second - right)
                assert abs(parts[0] * two - parts[1] * one) < 0.02 * apart * (one + two)
                assert (sum(parts) > 1.000001 * apart) is ("beyond" in said.markup)


# --- closing and Coriolis ------------------------------------------------------------------------


def test_a_link_that_gives_the_locus_alone_is_drawn_each_time():
    (said,) = [
        one.markup
        for one in written(scene_text("documents/wheel-and-bar"), 0)
        if one.name == "close"
    ]
    assert "move link 3 in steps, draw it each time and mark the locus of *B*" in said


@pytest.mark.parametrize("name", ["slotted-lever", "rod-and-wheel", "rapid-return-slider"])
def test_the_corner_f_lies_on_the_line_to_the_tip(name):
    drawing = drawings(name, None if name in SCENES else 7)[1]
    values = drawing.trace.values
    drawn = [step for _, step, _ in drawing.mechanism_steps() if step.action]
    leans = [step for step in drawn if step.action.key == "coriolis-ray"]
    assert leans
    for lean in leans:
        pivot, tip = values[lean.args[1]], values[lean.args[3]]
        along = values[drawing.number_of(lean)].along
        assert abs(((tip - pivot) / along).imag) < 1e-9 * abs((tip - pivot) / along)


def test_a_driven_lever_whose_velocity_no_right_triangle_shows_has_no_letter_at_its_tip():
    (said,) = [
        plain(one.markup)
        for one in written(scene_text("documents/driven-lever"), 1)
        if one.name == "c"
    ]
    assert "it is cut in f by the line from O to the tip of vA, set at A;" in said


# --- guides --------------------------------------------------------------------------------------


def test_the_positive_sense_of_every_asked_guide_stands_among_the_data(both):
    drawing = both[0]
    told = [piece for piece in given(drawing) if "(positive from " in piece]
    for block in drawing.scene.ask.slides:
        point = symbol(drawing.scene.links[block].points[0])
        assert any(piece.startswith((point, f"pin {point}")) for piece in told), block


@pytest.mark.parametrize("name", ["crank-fixed-slot", "mobility-cam", "gears-rack"])
def test_a_block_moves_to_where_its_guide_is_positive_when_its_speed_is(name):
    (drawing, *_) = drawings(name)
    ways = {"to the right": 0, "upwards": 90, "to the left": 180, "downwards": -90}
    seen = 0
    for block in drawing.scene.ask.slides:
        link = drawing.scene.links[block]
        if link.slides[0].on != "0":
            continue
        piece = next(p for p in given(drawing) if p.startswith(f"{symbol(link.points[0])} slides"))
        said = re.search(
            r"\(positive from .*? (to the right|upwards|to the left|downwards)\)", piece
        )
        velocity = drawing.trace.value("velocity", link.points[0])
        speed = drawing.trace.value("slide speed", block)
        off = degrees(phase(velocity if speed > 0 else -velocity)) - ways[said[1]]
        assert abs((off + 180) % 360 - 180) < 46
        seen += 1
    assert seen


# --- languages -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ALL, ids=named)
def test_italian_joins_its_prepositions_and_parts_its_vowels(name):
    for said in all_said(drawings(*name, "it")):
        assert not ARTICLES.search(said), said
        assert not CLASHING.search(plain(said)), said


def test_italian_parts_equal_vowels_alone():
    spoken = words("it")
    assert spoken("step.compass", bar="AB", p="A") == "arco di raggio AB e centro A"
    assert spoken("step.square-to", s="b", bar="*A**B*") == "per b la perpendicolare ad *A**B*"
    assert spoken("step.square-to", s="b", bar="*O**B*") == "per b la perpendicolare a *O**B*"
    assert spoken("step.kennedy-line", m="*I*", n="*E*") == "congiungere *I* ed *E*"


def test_romanian_has_one_word_for_the_end_of_a_vector():
    assert not [text for text in words("ro").sentences.values() if "extremit" in text]
