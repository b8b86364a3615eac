"""Closures are told apart by what differs: a point of the group, else the angle of a link."""

from graphkin.diagnosis.closures import choices
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.scene_files import scene_text


def choices_of(name):
    mechanism = Mechanism(read_text(scene_text(name), "scene", None, {}))
    return choices(mechanism.scene, mechanism.groups, mechanism.program)


def test_a_link_that_lies_both_ways_round_is_told_by_its_angle():
    first, _ = choices_of("structure/pins/bar-and-cylinder")
    assert (first.pin, first.key, first.is_turned) == ("L0", "L0", True)
    one, other = (closure.place for closure in first.closures)
    assert abs(one + other) < 1e-12


def test_closures_with_one_place_of_the_pin_are_told_by_another_point():
    """The lever of a dyad RPR on its block: the known pins stand still, its end does not."""
    (lever, *_) = choices_of("structure/slotted-lever-both-ways")
    places = [closure.place for closure in lever.closures]
    assert not lever.is_turned
    assert abs(places[0] - places[1]) > 0.01
