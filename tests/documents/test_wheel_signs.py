"""Each wheel of a link has its own sign: 2, 2′, 2″, as gear books call compound wheels."""

from __future__ import annotations

import re

import pytest

from graphkin.construction.core.given_data import wheels
from graphkin.construction.core.kind import constructions
from graphkin.construction.core.layout import lay_out
from graphkin.construction.rolling.contact_points import ContactOfWheels
from graphkin.construction.rolling.wheel_images import RateByRadii
from graphkin.documents.relations import relations
from graphkin.documents.sheet import left_board
from graphkin.text import LANGUAGES, words
from tests.chosen import by_turns
from tests.documents.sheet_tools import drawings, mechanism_named

COMPOUND = ("belts-dynamo", "gears-ferguson", "hoist-differential")
RADIUS = re.compile(r"\*r\*_\{[^}]*\}")


def test_the_second_wheel_of_a_link_has_a_prime_the_third_two():
    link = mechanism_named("gears-ferguson").scene.links["2"]
    assert [link.wheel_sign(wheel) for wheel in link.wheels] == ["2", "2′", "2″"]


@pytest.mark.parametrize(("name", "language"), by_turns(COMPOUND, LANGUAGES))
def test_every_radius_of_the_calculations_is_that_of_one_wheel_of_the_data(name, language):
    scene = mechanism_named(name).scene
    given = [each for said in wheels(scene, words(language)) for each in RADIUS.findall(said)]
    assert len(given) == sum(len(link.wheels) for link in scene.every_link)
    assert len(set(given)) == len(given)
    found = relations(drawings(name, language=language), solved=True)
    used = {
        symbol
        for _, several in found
        for relation in several
        for symbol in RADIUS.findall(relation.symbols)
    }
    assert used <= set(given)


def test_a_train_of_belts_goes_in_over_one_wheel_and_out_over_the_other():
    """Khurmi's engine, line shaft and dynamo: ω₃ = ω₂·d₂′/d₃ = 26.18·900/150."""
    found = relations(drawings("belts-dynamo"), solved=True)
    told = {r.symbols: r.figures for _, several in found for r in several}
    assert "*ω*_{1}·*r*_{1}/*r*_{2}" in told
    assert told["*ω*_{2}·*r*_{2′}/*r*_{3}"].endswith("0.45/0.075")
    program = drawings("belts-dynamo")[-1].trace.program
    signs = {each.signs for each in constructions(program, RateByRadii)}
    assert signs <= {("1", "2"), ("2′", "3")}


@pytest.mark.parametrize("name", COMPOUND)
def test_each_further_wheel_has_its_sign_on_the_mechanism(name):
    drawing = drawings(name)[0]
    board = left_board(drawing, lay_out(drawing), "key")
    said = [label.markup for label in board.labels]
    for link in drawing.scene.links.values():
        for wheel in link.wheels[1:]:
            assert said.count(link.wheel_sign(wheel)) == 1


def test_wheels_touch_by_their_signs():
    drawing = drawings("gears-ferguson")[0]
    kinds = [*constructions(drawing.trace.program, ContactOfWheels)]
    assert [kind.signs for kind in kinds] == [("2", "0"), ("2′", "3"), ("2″", "4")]
    told = [kind.point_sentence(drawing, "point") for kind in kinds]
    assert "wheels 3 and 2′ touch" in told[1] and "*r*_{2′}" in told[1]
