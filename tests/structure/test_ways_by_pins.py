"""A link that slides and rolls closes two dyads: their pins tell which way each goes."""

from itertools import product

import pytest

from graphkin.diagnosis.closures import choices
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import StructureError
from tests.scene_files import scene_text

TEXT = scene_text("structure/one-link-two-dyads")
STATED = 'P5 = "backward"\nP14 = "forward"\n'
WAYS = ("forward", "backward")


def mechanism_of(stated):
    assert STATED in TEXT
    return Mechanism(read_text(TEXT.replace(STATED, stated), "scene", None, {}))


def places(stated):
    points = mechanism_of(stated).solve().points
    return tuple(points[pin].position for pin in ("P5", "P14"))


@pytest.mark.parametrize("ways", [*product(WAYS, WAYS)], ids="-".join)
def test_each_closure_of_both_dyads_can_be_written(ways):
    mechanism = mechanism_of('P5 = "{}"\nP14 = "{}"\n'.format(*ways))
    verdict = mechanism.witness(mechanism.solve())
    assert verdict.agrees and not verdict.branches
    found = choices(mechanism.scene, mechanism.groups, mechanism.program)
    assert {choice.key: choice.closures[0].words for choice in found} == dict(
        zip(("P5", "P14"), ways, strict=True)
    )


def test_four_closures_are_four_positions():
    found = {places('P5 = "{}"\nP14 = "{}"\n'.format(*ways)) for ways in product(WAYS, WAYS)}
    assert len(found) == 4


def test_the_link_states_both_as_before_and_a_pin_one_of_them():
    assert places('4 = "forward"\n') == places('P5 = "forward"\nP14 = "forward"\n')
    assert places('4 = "forward"\nP14 = "backward"\n') == places(
        'P5 = "forward"\nP14 = "backward"\n'
    )


def test_what_is_missing_is_asked_for_under_the_pins():
    with pytest.raises(StructureError, match=r"(?s)branches\.P5: .*branches\.P14: "):
        mechanism_of("").solve()
