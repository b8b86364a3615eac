"""W. G. McLean, E. W. Nelson, Schaum's Engineering Mechanics, chapter 14."""

from __future__ import annotations

from tests.scene_files import scene_text
from tests.textbook.book import answers, exactly, rounds_to


def test_schaum_14_20_14_21_rolling_wheel():
    """Page 279: a wheel of 3 m diameter rolls without slip, 8 rad/s clockwise, 4 rad/s² against it.

    B is the top: v = 2 v_O, a = 2 a_O along the plane and ω²r towards the centre. C is the contact.
    """
    found = answers(scene_text("textbook/wheel-14-20"))
    top, centre, wheel = found.points["B"], found.points["O"], found.links["wheel"]
    assert rounds_to(abs(top.velocity), "24")
    assert rounds_to(abs(top.acceleration), "96.7")
    assert rounds_to(abs(centre.acceleration), "6")

    assert exactly(wheel.omega, -8)
    assert exactly(wheel.epsilon, 4)
    assert exactly(centre.position, 1.5j)
    assert exactly(centre.velocity, 12)
    assert exactly(centre.acceleration, -6)
    assert exactly(top.velocity, 24)
    assert exactly(top.acceleration, -12 - 96j)
    assert rounds_to(abs(top.acceleration), "96.74709")
    contact = found.points["C"]
    assert exactly(contact.velocity, 0, largest=12)
    assert exactly(contact.acceleration, 96j)
