"""By how much a wheel has turned since the start, as a sentence says, is reckoned before."""

from __future__ import annotations

import re
from functools import cache
from math import pi

import pytest
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.solution import Verdict
from graphkin.documents.relations import relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.chosen import FOLDER, SCENES, shared, spoken_by
from tests.documents.sheet_tools import mechanism_named
from tests.scene_files import scene_text

SAID = {
    "en": r"link (\S+) has turned by (\S+)° since",
    "ro": r"elementul (\S+) s-a rotit cu (\S+)° de",
    "it": r"il membro (\S+) è ruotato di (\S+)° dall",
}
PROVED = Verdict(True, 0.0, "", 0.0, 0.0, 0.0)
TOKEN = re.compile(r"\d+(?:[.,]\d+)?|π|[−+·/()]")
FEWEST = 25
"""So many of the example scenes have such a sentence."""
WHEELS = [name for name in SCENES if "wheel" in (FOLDER / f"{name}.toml").read_text("utf-8")]
WHICH = sorted({*WHEELS, *shared(SCENES, 4)})
"""Every scene with a wheel, and some of the others."""


def drawn(mechanism: Mechanism, language: str = "en") -> list[Drawing]:
    return list(drawings_of(mechanism, PROVED, words(language)))


@cache
def drawn_scene(name: str) -> list[Drawing]:
    return drawn(mechanism_named(name))


def in_language(drawings: list[Drawing], language: str) -> list[Drawing]:
    return [replace(drawing, words=words(language)) for drawing in drawings]


def said_in(drawings: list[Drawing], language: str = "en") -> dict[str, str]:
    """The links that a sentence says to have turned, and by how much."""
    told = " ".join(sentence.markup for sentence in sentences(drawings[0]))
    return dict(re.findall(SAID[language], told))


def turns_in(drawings: list[Drawing]) -> dict[str, Relation]:
    """The relations of the section by their symbols, in their order."""
    (section,) = [found for name, found in relations(drawings) if name == "turned"]
    by_left = {relation.left: relation for relation in section}
    assert len(by_left) == len(section), "each is told once"
    return by_left


def worked_out(figures: str) -> float:
    """What a pocket calculator makes of figures: signs, products and quotients, parentheses."""
    assert not TOKEN.sub("", figures).strip(), figures
    left = TOKEN.findall(figures)

    def total() -> float:
        value = -product() if taken("−") else product()
        while left and left[0] in "+−":
            value += product() if left.pop(0) == "+" else -product()
        return value

    def product() -> float:
        value = factor()
        while left and left[0] in "·/":
            value = value * factor() if left.pop(0) == "·" else value / factor()
        return value

    def factor() -> float:
        if taken("("):
            value = total()
            assert taken(")"), figures
            return value
        token = left.pop(0)
        return pi if token == "π" else float(token.replace(",", "."))

    def taken(token: str) -> bool:
        return bool(left) and left[0] == token and left.pop(0) == token

    value = total()
    assert not left, figures
    return value


def test_the_figures_give_the_angle_by_which_a_sentence_says_that_a_wheel_has_turned():
    seen = 0
    for name in WHICH:
        for language in {"en", *spoken_by(name)} & SAID.keys():
            drawings = in_language(drawn_scene(name), language)
            said = said_in(drawings, language)
            found = turns_in(drawings)
            assert bool(found) is bool(said), name
            for link, angle in said.items():
                relation = found[f"Δ*φ*_{{{link}}}"]
                assert (relation.result, relation.unit) == (angle, "°"), (name, link)
                printed = worked_out(relation.result)
                assert worked_out(relation.figures) == pytest.approx(printed, abs=0.0500001), name
        seen += bool(said)
    assert seen >= FEWEST


@pytest.mark.parametrize("name", WHICH)
def test_each_angle_and_way_that_is_put_in_is_told_before(name):
    """And has there the value that is put in."""
    told: dict[str, str] = {}
    for left, relation in turns_in(drawn_scene(name)).items():
        for symbol in re.findall(r"Δ\*φ\*_\{[^}]*\}|\*s\*_\{[^}]*\}", relation.symbols):
            assert symbol in told, (name, left)
            near = re.findall(r"\d+(?:\.\d+)?", relation.figures)
            value = abs(worked_out(told[symbol]))
            assert any(abs(float(each) - value) <= max(5e-4 * value, 0.05) for each in near)
        told[left] = relation.result


def test_the_sun_turns_twice_as_far_as_the_arm_less_the_planet():
    drawings = drawn(mechanism_named("gears-sun-and-planet"))
    found = turns_in(drawings)
    o, c, b = (drawings[0].standing.spot(each) for each in "OCB")
    arm, rod = (worked_out(found[f"Δ*φ*_{{{link}}}"].result) for link in "12")
    for angle, bar in ((arm, c - o), (rod, b - c)):
        turned = complex(bar) / abs(bar)
        assert turned == pytest.approx(pow(1j, angle / 90), abs=1e-4)
    sun = found["Δ*φ*_{4}"]
    assert sun.symbols == "Δ*φ*_{1} − (Δ*φ*_{2} − Δ*φ*_{1})·*r*_{2}/*r*_{4}"
    assert worked_out(sun.result) == pytest.approx(2 * arm - rod, abs=0.05)


@pytest.mark.parametrize(("start", "told"), [("", "123"), (", 2 = 40", "12")], ids=["one", "two"])
def test_nothing_is_told_of_a_wheel_that_counts_another_from_a_start_of_its_own(start, told):
    """Its relation would take an angle that is told as another."""
    text = scene_text("construction/wheels-that-speed-up")
    assert text.count("start = { 3 = 40") == 1
    text = text.replace("start = { 3 = 40", f"start = {{ 3 = 40{start}")
    drawings = drawn(Mechanism(read_text(text, "train", None, {})))
    assert {*said_in(drawings)} == {"2", "3"}
    assert [*turns_in(drawings)] == [f"Δ*φ*_{{{link}}}" for link in told]
