"""Every length of the mechanism in a sentence of the construction is in mm of paper.

The reader here has only the printed words and scale; the mechanism it knows from the scene and the
vector loops.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import Part
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.scene.model import Scene
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import drawings, mechanism_named
from tests.mechanisms import SHIPPED
from tests.scene_files import scene_text

ALL = [*((name, None) for name in CHOSEN), *((lab, 7) for lab in SHIPPED)]
LENGTH = re.compile(r"(−?\d+(?:[.,]\d+)?)\)? (mm|cm|m)\b(?!/)")
BAR = re.compile(r"\b([A-Z]\d*)([A-Z]\d*) \($")
RIM = re.compile(r"\br(\w+)(?: = m·z/2)? \($")
DRIVER = re.compile(r"\bs\w* \($")
UNNAMED = {
    "gears-rack": {41.89},
    "rod-and-wheel": {14.46},
    "roller-plates": {45.0, -45.0, 0.0},
}
"""Lengths that bear no symbol, as drawn: the arc 60 mm·40° that a rack has rolled on, at 1:1; a
place that was found; the points (±90; 0) mm of two plates, at 1:2."""


def real(scene: Scene, mechanism: Mechanism, before: str) -> float:
    """The real length, in mm, of what a sentence names just before a length."""
    if bar := BAR.search(before):
        one, two = (mechanism.solve().points[name].position for name in bar.groups())
        return 1000 * abs(two - one)
    if rim := RIM.search(before):
        link = scene.frame if rim[1] == "0" else scene.links[rim[1]]
        return 1000 * float(link.wheels[0].radius.si(scene.values))
    assert DRIVER.search(before), before
    index = re.sub(r".*\bs(\w*) \($", r"\1", before)
    driver = next(d for d in scene.drivers if d.link == (index or d.link))
    return 1000 * float(driver.position.si(scene.values))


def told(drawing: Drawing) -> Iterator[tuple[str, str, str]]:
    """Each length of a sentence on positions or centres: what stands before it, it, its unit."""
    steps = drawing.trace.program.steps
    for said in sentences(drawing):
        parts = {steps[number].part for number in said.all_steps}
        if parts <= {Part.POSITION, Part.CENTRE}:
            text = plain(said.markup)
            for found in LENGTH.finditer(text):
                yield text[: found.start()], found[1], found[2]


def drawn_to(drawing: Drawing) -> float:
    """How many times larger than drawn the mechanism is, by the scale that is printed."""
    drawn, size = drawing.scales.words.split(":")
    return float(size) / float(drawn)


@pytest.mark.parametrize(("name", "n"), ALL)
def test_a_length_of_the_mechanism_is_told_as_it_is_drawn(name, n):
    mechanism = mechanism_named(name, n)
    for drawing in drawings(name, n, LANGUAGES[len(name) % 3]):
        for before, number, unit in told(drawing):
            size = float(number.replace(",", ".").replace("−", "-"))
            assert unit == "mm", before
            if size in UNNAMED.get(name, ()):
                continue
            expected = real(mechanism.scene, mechanism, before) / drawn_to(drawing)
            assert size == pytest.approx(expected, abs=0.0051), before


def test_the_reader_finds_lengths_of_each_kind_at_scales_other_than_one_to_one():
    found = [
        (pattern, drawn_to(drawing))
        for name in CHOSEN
        for drawing in drawings(name)
        for before, _, _ in told(drawing)
        for pattern in (BAR, RIM, DRIVER)
        if pattern.search(before)
    ]
    assert all((pattern, 2.0) in found for pattern in (BAR, RIM, DRIVER))


def test_an_offset_and_a_stroke_in_centimetres_are_told_in_millimetres_of_paper():
    mechanism = Mechanism(read_text(scene_text("documents/in-centimetres"), "lever"))
    drawing = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))[0]
    text = " ".join(plain(said.markup) for said in sentences(drawing))
    assert drawing.scales.words == "1:5"
    assert "lay off s (72.00 mm) from its zero: A" in text
    assert "circle of radius 24.00 mm about Q" in text
    assert not re.search(r"\d cm\b", text)
