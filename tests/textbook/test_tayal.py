"""A. K. Tayal, Engineering Mechanics, chapter 21: velocities by formulas and by centres."""

from __future__ import annotations

import math

from tests.scene_files import scene_text
from tests.textbook.book import RPM, answers, exactly, rounds_to, within
from tests.textbook.closed_forms import degrees, dyad, fixed, rod_on_guide, turned


def test_tayal_21_5_21_12_slider_crank():
    """21.12 prints 2.213 m/s, 21.5, by the other method from rounded angles, 2.211 m/s.

    ω_AB is printed 5.468 rad/s, cut off, not rounded. Printed without senses.
    """
    found = answers(scene_text("textbook/slider-crank-21-5"))
    rod, piston = found.links["rod"].omega, found.points["B"].velocity.real
    assert within(abs(rod), 5.468, share=0.0002)
    assert rounds_to(abs(piston), "2.213")
    assert within(abs(piston), 2.211, share=0.001)

    closed = rod_on_guide(turned(degrees(30, 300 * RPM), 0.12), 0.6)
    assert exactly(rod, closed.angle[1])
    assert exactly(piston, closed.slide[1])
    assert rounds_to(rod, "-5.468811")
    assert rounds_to(piston, "-2.213084")


def test_tayal_21_13_four_bar():
    """AB at 30°, BC level, CD at 60° and square to AB, as the printed triangle of the centre says.

    The layout is inferred from that triangle. Printed without senses.
    """
    found = answers(scene_text("textbook/four-bar-21-13"))
    coupler, rocker = found.links["BC"].omega, found.links["CD"].omega
    assert rounds_to(abs(coupler), "7.698")
    assert rounds_to(abs(rocker), "1.9245")

    assert exactly(coupler, -0.2 * 5 / (0.15 * math.cos(math.radians(30))))
    assert exactly(rocker, 0.2 * 5 * math.tan(math.radians(30)) / 0.3)
    place = 0.2 * complex(math.cos(math.pi / 6), 0.5) + 0.15 + 0.3 * complex(0.5, -math.sqrt(0.75))
    closed = dyad(turned(degrees(30, 5), 0.2), 0.15, 0.3, fixed(place), 1)
    assert exactly(coupler, closed.left[1])
    assert exactly(rocker, closed.right[1])
    assert exactly(found.links["BC"].epsilon, closed.left[2])
    assert exactly(found.links["CD"].epsilon, closed.right[2])
    assert exactly(found.points["C"].acceleration, closed.pin[2])
    assert rounds_to(coupler, "-7.698004")
    assert rounds_to(rocker, "1.924501")
