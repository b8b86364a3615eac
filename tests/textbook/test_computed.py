"""Mechanisms of published questions without printed answers: recomputed in 40 digits, rounded."""

from __future__ import annotations

import math
from cmath import rect

import pytest

from tests.scene_files import scene_text
from tests.textbook.book import answers, exactly, rounds_to
from tests.textbook.closed_forms import added, degrees, dyad, fixed, turned

FOUR_BAR = """
units = {{ length = "m", angle = "deg", speed = "rad/s" }}
[frame]
A = [0, 0]
D = [6, 0]
[links.2]
A-B = 2
[links.3]
B-C = 7
B-P = 6
C-B-P = 30
[links.4]
D-C = 9
[[drivers]]
turn = 2
angle = 30
speed = 10
[branches]
C = "{side} of B-D"
"""


@pytest.mark.parametrize("side", [1, -1], ids=["open", "crossed"])
def test_four_bar_with_coupler_point(side):
    """Bars 2, 7, 9 on a frame of 6: both branches against the closed form."""
    found = answers(FOUR_BAR.format(side="left" if side > 0 else "right"))
    crank = turned(degrees(30, 10), 2)
    closed = dyad(crank, 7, 9, fixed(6), side)
    theta, omega, epsilon = closed.left
    point = added(crank, turned((theta + math.radians(30), omega, epsilon), 6))
    for name, exact in (("C", closed.pin), ("P", point)):
        motion = found.points[name]
        assert exactly(motion.position, exact[0])
        assert exactly(motion.velocity, exact[1])
        assert exactly(motion.acceleration, exact[2])
    for link, angle in (("3", closed.left), ("4", closed.right)):
        assert exactly(found.links[link].omega, angle[1])
        assert exactly(found.links[link].epsilon, angle[2])


def test_four_bar_open_recomputed():
    found = answers(FOUR_BAR.format(side="left"))
    p, coupler, rocker = found.points["P"], found.links["3"], found.links["4"]
    assert rounds_to(coupler.omega, "-5.99096571859")
    assert rounds_to(rocker.omega, "-3.99173479021")
    assert rounds_to(coupler.epsilon, "26.0800166383")
    assert rounds_to(rocker.epsilon, "53.3305882864")
    assert rounds_to(abs(p.velocity), "40.7789506972")
    assert rounds_to(abs(p.acceleration), "418.555620204")
    assert rounds_to(p.position.real, "-1.16188813449")
    assert rounds_to(p.position.imag, "6.25596017866")


def test_five_bar_with_two_driven_cranks():
    """The lengths are those of the geared five-bar of Constans and Dyer; C hangs down."""
    found = answers(scene_text("textbook/five-bar"))
    c, left, right = found.points["C"], found.links["BC"], found.links["EC"]
    end = added(fixed(0.18), turned(degrees(40, -20, -20), 0.12))
    closed = dyad(turned(degrees(120, 10, 10), 0.12), 0.25, 0.25, end, -1)
    assert exactly(c.position, closed.pin[0])
    assert exactly(c.velocity, closed.pin[1])
    assert exactly(c.acceleration, closed.pin[2])
    for link, angle in ((left, closed.left), (right, closed.right)):
        assert exactly(link.omega, angle[1])
        assert exactly(link.epsilon, angle[2])

    assert exactly(found.points["B"].position, rect(0.12, math.radians(120)))
    assert rounds_to(left.omega, "4.08384491699")
    assert rounds_to(right.omega, "-10.2506684966")
    assert rounds_to(left.epsilon, "-73.5257350016")
    assert rounds_to(right.epsilon, "23.2107520226")
    assert rounds_to(c.velocity.real, "-0.225419159956")
    assert rounds_to(c.velocity.imag, "0.0165005755073")
    assert rounds_to(c.acceleration.real, "-12.2088203988")
    assert rounds_to(c.acceleration.imag, "-18.7683308166")
