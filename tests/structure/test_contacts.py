"""Rolling pairs: which wheels touch, what keeps them together, and what they take."""

from __future__ import annotations

import pytest

from graphkin.structure.pairs import contacts
from graphkin.structure.turning import turns
from graphkin.text.errors import StructureError
from tests.mechanisms import scene_of
from tests.scene_files import scene_text

DRIVEN = "[[drivers]]\nturn = {link}\nangle = 40\nspeed = 1\n"


def made(text: str, link: str = "1"):
    """The scene of a text with one driver."""
    return scene_of(text + DRIVEN.format(link=link))


def rack(below: float = 2, angle: float = 0, side: str = "left") -> str:
    """A pinion of radius 2 about O over a rack that slides, its teeth at an angle to its way."""
    return f"""[frame]
O = [0, 0]
[links.1]
O-A = 1
wheel = {{ centre = "O", radius = 2 }}
rolls = {{ on = 2, through = "R", angle = {angle}, side = "{side}" }}
[links.2]
R = [0, 0]
slides = {{ on = 0, through = [0, {-below}], angle = 0 }}
"""


def train(small: float = 2) -> str:
    """A stepped planet between a ring of the frame and a sun, its axle on an arm of length 4."""
    return f"""[frame]
O = [0, 0]
wheel = {{ centre = "O", radius = 6, inside = true }}
[links.1]
O-P = 4
[links.2]
P = [0, 0]
wheels = [{{ centre = "P", radius = 1 }}, {{ centre = "P", radius = {small} }}]
rolls = [{{ on = 0 }}, {{ on = "sun" }}]
[links.sun]
O = [0, 0]
wheel = {{ centre = "O", radius = 3 }}
"""


def plates(radius: float = 2, gap: float = 4, way: float = 0) -> str:
    """A roller between two plates that slide, the second one along ``way``."""
    return f"""[frame]
O = [0, 0]
[links.1]
A = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[links.2]
B = [0, 0]
slides = {{ on = 0, through = [0, {gap}], angle = {way} }}
[links.w]
C = [0, 0]
wheel = {{ centre = "C", radius = {radius} }}
rolls = [
  {{ on = 1, through = "A", angle = 0 }},
  {{ on = 2, through = "B", angle = 0, side = "right" }},
]
"""


ALONE = scene_text("structure/alone")


def refusal(text: str) -> str:
    """The words in which a scene is refused."""
    with pytest.raises(StructureError) as caught:
        contacts(made(text))
    return str(caught.value)


def test_a_wheel_alone_on_its_track_takes_two_freedoms():
    (contact,) = contacts(made(ALONE))
    assert (contact.links, contact.track, contact.arm) == (("1", "0"), None, None)
    assert contact.taken == 2


@pytest.mark.parametrize(("angle", "side"), [(0, "left"), (180, "right")])
def test_a_rack_is_kept_at_its_pinion_by_its_guide(angle, side):
    """The frame owns the pinion's axle, and against it the rack moves only along the track."""
    (contact,) = contacts(made(rack(angle=angle, side=side)))
    assert (contact.links, contact.arm, contact.taken) == (("1", "2"), "0", 1)
    assert contact.wheel.centre == "O"


def test_a_rack_that_moves_across_its_teeth_is_not_kept():
    (contact,) = contacts(made(rack(angle=30)))
    assert (contact.arm, contact.taken) == (None, 2)


def test_an_axle_on_a_carriage_keeps_its_wheel_on_the_rail():
    """The carriage slides along the rail: with its wheel it is a single freedom, not none."""
    carriage = """[links.2]
C = [0, 0]
D = [0, 3]
slides = { on = 0, through = [0, 2], angle = 0 }
"""
    (contact,) = contacts(made(ALONE + carriage))
    assert (contact.arm, contact.taken) == ("2", 1)


def test_the_height_of_a_carriage_counts_its_offset_and_its_own_axes():
    """The axle lies 1 to the left of the carriage's first point, that 4 right of a guide at 5."""
    carriage = """[links.2]
D = [0, 0]
C = [3, 1]
slides = { on = 0, through = [0, 5], angle = 0, offset = -4 }
"""
    (contact,) = contacts(made(ALONE + carriage))
    assert contact.arm == "2"
    assert "keeps its centre C 3 m to the left of it" in refusal(
        ALONE + carriage.replace("-4", "-3")
    )


def test_a_roller_between_two_plates_is_kept_by_the_first_for_the_second():
    first, second = contacts(made(plates()))
    assert (first.links, first.arm, first.taken) == (("w", "1"), None, 2)
    assert (second.links, second.arm, second.taken) == (("w", "2"), "1", 1)


def upside_down(text: str) -> str:
    """The roller written on its upper plate first."""
    before, mark, after = text.partition("rolls = [")
    lower, upper, rest = after.split("\n", 3)[1:]
    return before + mark + "\n".join(["", upper, lower, rest])


def test_the_plate_written_first_keeps_the_roller_whichever_it_is():
    first, second = contacts(made(upside_down(plates())))
    assert (first.links, first.taken) == (("w", "2"), 2)
    assert (second.links, second.arm, second.taken) == (("w", "1"), "2", 1)


@pytest.mark.parametrize("text", [plates(way=20), upside_down(plates(way=20))])
def test_plates_that_part_keep_no_roller(text):
    first, second = contacts(made(text))
    assert (first.taken, second.taken) == (2, 2)


def test_stepped_wheels_are_told_apart_by_what_they_touch():
    """6 - 2 = 4 on the ring, 3 + 1 = 4 on the sun."""
    ring, sun = contacts(made(train()))
    assert (ring.links, ring.wheel.radius.text, ring.track.radius.text) == (("2", "0"), "2", "6")
    assert (sun.links, sun.wheel.radius.text, sun.track.radius.text) == (("2", "sun"), "1", "3")
    assert ring.arm == sun.arm == "1"
    assert ring.taken == sun.taken == 1


def test_a_ring_may_roll_about_a_wheel():
    text = scene_text("structure/ring-about-a-wheel")
    (contact,) = contacts(made(text))
    assert (contact.arm, contact.taken) == ("1", 1)
    inside_out = text.replace("radius = 2", "radius = 9").replace("O-P = 3", "O-P = 4")
    assert refusal(inside_out).endswith("expected a ring that is larger than the wheel within it")


def test_a_wheel_on_a_wheel_without_an_arm_counts_two_freedoms():
    """A bar between the centres is put in, which does not count."""
    scene = made(scene_text("structure/wheel-on-a-wheel"))
    (contact,) = contacts(scene.bare)
    assert (contact.track.centre, contact.arm, contact.taken) == ("O", None, 2)
    (kept,) = contacts(scene)
    assert (kept.arm, kept.taken) == (next(iter(scene.keepers)), 1)


def test_gears_mesh_on_the_axles_of_the_frame_teeth_for_radii():
    text = scene_text("structure/gears-on-the-frame")
    drive = DRIVEN.format(link="1")
    (contact,) = contacts(scene_of("module = 3\n" + text + drive))
    assert (contact.arm, contact.taken) == ("0", 1)
    with pytest.raises(StructureError) as caught:
        contacts(scene_of("module = 4\n" + text + drive))
    assert str(caught.value) == (
        "links.2.rolls: wheels of radius 80 m and 40 m (on link 1) do not touch: the frame keeps "
        "O-Q = 90 m; expected the sum of the radii, O-Q = 120 m"
    )


def test_wheels_that_do_not_touch_are_refused_with_their_numbers():
    assert refusal(train(small=2.1)) == (
        "links.2.rolls: wheels of radius 2.1 m and 6 m (on the frame) do not touch: "
        "link 1 keeps O-P = 4 m; expected the difference of the radii, O-P = 3.9 m"
    )
    assert refusal(rack(below=3)) == (
        "links.1.rolls: the wheel of radius 2 m does not touch its track on link 2: "
        "the frame keeps its centre O 3 m to the left of it; expected 2 m to the left"
    )
    assert refusal(rack(side="right")).endswith('expected 2 m to the right; write side = "left"')
    assert "link 1 keeps its centre C 1.5 m to the right of it" in refusal(plates(radius=2.5))


def test_of_compound_wheels_the_one_that_fits_a_ring_is_named():
    """Radius 50 within 150 at the distance 100; 40 is nearer to touching from outside."""
    text = """
[frame]
O = [0, 0]
wheel = { centre = "O", radius = 150 }
[links.1]
O-P = 100
[links.2]
P-Q = 20
wheels = [{ centre = "P", radius = 40 }, { centre = "P", radius = 50 }]
rolls = { on = 0 }
"""
    assert refusal(text) == (
        "links.2.rolls: wheels of radius 50 m and 150 m (on the frame) do not touch: link 1 keeps "
        "O-P = 100 m; expected the sum of the radii, O-P = 200 m; write inside = true in the "
        "larger wheel, if it is a ring"
    )


# --- what turns ----------------------------------------------------------------------------------


def test_a_link_that_slides_alone_join_to_the_frame_does_not_turn():
    """A plate on the frame and a block across it shift; a lever turns, and so does its block."""
    text = scene_text("structure/sliding-link")
    scene = made(text, '"lever"')
    assert [name for name in scene.links if turns(scene, name)] == ["lever", "ring"]


def test_a_guide_that_a_shifting_block_carries_does_not_turn_either():
    """The yoke slides on a block of the frame: told from the guide's side as from the block's."""
    text = scene_text("structure/shifting-block-with-a-guide")
    scene = made(text)
    assert not any(turns(scene, name) for name in scene.links)


def test_a_bar_on_which_a_shifting_block_slides_does_not_turn():
    """The bar has no guide of its own; the block that slides on it keeps its direction."""
    text = scene_text("structure/shifting-block-on-a-bar")
    scene = made(text)
    assert [name for name in scene.links if turns(scene, name)] == ["3"]
