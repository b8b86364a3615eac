"""Questions of examinations: GATE (mechanical engineering) and the question bank mcqhubb."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.scene_files import scene_text
from tests.textbook.book import RPM, WITNESSED, answers, exactly, mechanism, rounds_to, within
from tests.textbook.closed_forms import degrees, dyad, fixed, turned


def test_gate_four_bar_perpendicular():
    """interviewmania 89107: AB and DC square to AD, so that the coupler is in translation."""
    found = answers(scene_text("textbook/gate-four-bar"))
    assert rounds_to(found.links["DC"].omega, "25")

    assert exactly(found.links["DC"].omega, 25)
    assert exactly(found.links["BC"].omega, 0, largest=25)
    assert exactly(found.points["C"].velocity, -0.5)
    assert exactly(found.points["C"].acceleration, -5.625 - 12.5j)
    closed = dyad(turned(degrees(90, 10), 0.05), 0.05, 0.02, fixed(0.04), 1)
    assert exactly(found.links["BC"].epsilon, closed.left[2])
    assert exactly(found.links["DC"].epsilon, closed.right[2])


OLDHAM = scene_text("textbook/oldham")


def test_oldham_mcqhubb_2472():
    """Shafts 20 mm apart, 180 rev/min: the greatest sliding speed is ω times the offset.

    Printed 0.376 m/s, cut off from 0.37699. It comes where the slot is square to AB.
    """
    found = answers(OLDHAM)
    greatest = abs(found.slides["driving"].speed)
    assert within(greatest, 0.376, share=0.003)

    omega = 180 * RPM
    assert exactly(greatest, omega * 0.02)
    assert exactly(found.links["driven"].omega, omega)
    assert exactly(found.links["driven"].epsilon, 0, largest=omega**2)
    assert exactly(found.points["P"].position, 0, largest=0.02)
    assert exactly(found.points["P"].velocity, -1j * omega * 0.02)
    assert exactly(found.slides["driven"].speed, 0, largest=greatest)
    assert rounds_to(greatest, "0.3769911")


@pytest.mark.parametrize("q", [0, 20, 75, 140, 205, 300])
def test_oldham_mcqhubb_2472_over_the_turn(q):
    """P runs on the circle over AB, twice as fast: AP = e cos q, BP = e sin q."""
    found = answers(OLDHAM, q=q)
    angle, omega = math.radians(q), 180 * RPM
    greatest = omega * 0.02
    for name, position in (("driving", -math.cos(angle)), ("driven", math.sin(angle))):
        slide = found.slides[name]
        assert exactly(abs(slide.position), 0.02 * abs(position), largest=0.02)
    assert exactly(abs(found.slides["driving"].speed), greatest * abs(math.sin(angle)), greatest)
    assert exactly(abs(found.slides["driven"].speed), greatest * abs(math.cos(angle)), greatest)
    assert exactly(found.links["driven"].omega, omega)


def test_oldham_mcqhubb_2472_is_the_greatest():
    """No angle of the turn slides faster: all degrees as one batch."""
    speeds = mechanism(OLDHAM).batch(q=np.arange(360)).slides["driving"].speed
    assert abs(np.abs(speeds).max() / (180 * RPM * 0.02) - 1) < WITNESSED
    assert int(np.abs(speeds).argmax()) in (90, 270)
