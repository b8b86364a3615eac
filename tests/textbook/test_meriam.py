"""J. L. Meriam, L. G. Kraige, Engineering Mechanics: Dynamics, chapter 5, sample problems."""

from __future__ import annotations

import math

from tests.scene_files import scene_text
from tests.textbook.book import FT, IN, RPM, answers, exactly, rounds_to
from tests.textbook.closed_forms import (
    added,
    degrees,
    dyad,
    fixed,
    less,
    polar,
    rod_on_guide,
    turned,
)


def test_meriam_5_6_plate_on_two_guides():
    """Page 341: corner A of a plate goes up at a constant 0.3 m/s, B on the level; edge at 30°.

    The edge turns clockwise as drawn here; its turning is printed without a sense. The companion's
    program has arccos where the book has the secant, so that its own numbers are wrong.
    """
    found = answers(scene_text("textbook/plate-5-6"))
    b, edge = found.points["B"], found.links["2"]
    assert rounds_to(b.velocity.real, "-0.1732")
    assert rounds_to(b.acceleration.real, "-0.693")
    assert rounds_to(abs(edge.omega), "1.732")
    assert rounds_to(abs(edge.epsilon), "1.732")

    secant = 1 / math.cos(math.radians(30))
    assert exactly(b.velocity, -0.3 * math.tan(math.radians(30)))
    assert exactly(b.acceleration, -(0.3**2) / 0.2 * secant**3)
    assert exactly(edge.omega, -0.3 / 0.2 * secant)
    assert exactly(edge.epsilon, -((0.3 / 0.2) ** 2) * secant**2 * math.tan(math.radians(30)))


def test_meriam_5_7_5_11_rolling_wheel():
    """Pages 351 and 364: r = 0.3 m, v_O = 3 m/s to the right, A at 0.2 m, 30° over the level.

    A began on the right; the wheel has rolled back until OA stands at 150°, with C in contact.
    """
    found = answers(scene_text("textbook/wheel-5-7"))
    a, c = found.points["A"], found.points["C"]
    assert rounds_to(abs(a.velocity), "4.36")
    assert rounds_to(a.velocity.real, "4")
    assert rounds_to(a.velocity.imag, "1.732")
    assert rounds_to(abs(a.position - c.position), "0.436")

    assert exactly(found.links["wheel"].omega, -3 / 0.3)
    assert exactly(c.position, -0.3 * math.radians(150))
    assert exactly(a.velocity, 4 + 1j * math.sqrt(3))
    assert exactly(c.velocity, 0, largest=3)
    assert exactly(c.acceleration, 1j * 3**2 / 0.3)
    assert exactly(abs(a.velocity), math.sqrt(0.19) * 10)


def test_meriam_5_8_5_14_four_bar():
    """Pages 352 and 375: CB level, OA upright, CB at 2 rad/s: -6/7 and -3/7 rad/s."""
    found = answers(scene_text("textbook/four-bar-5-8"))
    coupler, crank = found.links["AB"], found.links["OA"]
    assert rounds_to(coupler.omega, "-0.857")
    assert rounds_to(crank.omega, "-0.429")
    assert rounds_to(coupler.epsilon, "-0.1050")
    assert rounds_to(crank.epsilon, "-4.34")

    assert exactly(coupler.omega, -6 / 7)
    assert exactly(crank.omega, -3 / 7)
    slow = (100 * (3 / 7) ** 2 - 50 * (6 / 7) ** 2) / 175
    assert exactly(coupler.epsilon, slow)
    assert exactly(crank.epsilon, -(300 + 175 * (6 / 7) ** 2 - 50 * slow) / 100)
    pin = added(fixed(0.25 + 0.05j), turned(degrees(180, 2), 0.075))
    closed = dyad(pin, math.hypot(0.175, 0.05), 0.1, fixed(0), -1)
    assert exactly(coupler.epsilon, closed.left[2])
    assert exactly(crank.epsilon, closed.right[2])


def test_meriam_5_9_5_15_slider_crank():
    """Pages 353 and 376: v_G is read off the diagram, yet right to its digits.

    ω_AB is the one that 5/15 takes from 5/9. Our source keeps no more printed values.
    """
    found = answers(scene_text("textbook/engine-5-9"))
    rod, a, g = found.links["rod"], found.points["A"], found.points["G"]
    assert rounds_to(abs(g.velocity) / FT, "64.1")
    assert rounds_to(rod.omega, "29.5")

    pin = turned(degrees(60, -1500 * RPM), 5 * IN)
    closed = rod_on_guide(pin, 14 * IN)
    _, velocity, acceleration = added(pin, turned(closed.angle, 4 * IN))
    assert exactly(g.velocity, velocity)
    assert exactly(g.acceleration, acceleration)
    assert exactly(rod.omega, closed.angle[1])
    assert exactly(rod.epsilon, closed.angle[2])
    assert exactly(a.velocity, closed.slide[1])
    assert exactly(a.acceleration, closed.slide[2])
    assert rounds_to(abs(g.velocity) / FT, "64.13372")
    assert rounds_to(rod.omega, "29.49625")
    assert rounds_to(a.velocity.real / FT, "67.32477")
    assert rounds_to(a.acceleration.real / FT, "-3312.002")
    assert rounds_to(rod.epsilon, "7742.071")


def test_meriam_5_10_slotted_arm():
    """Page 354: a collar on a screw 18 in from O goes down at 0.8 ft/s; its pin turns the arm.

    Printed counter-clockwise: the collar stands to the left of O.
    """
    found = answers(scene_text("textbook/slotted-arm-5-10"))
    arm, block = found.links["arm"], found.slides["block"]
    assert rounds_to(arm.omega, "0.400")

    pin = (complex(-18, 18 * math.tan(math.radians(30))) * IN, -0.8j * FT, 0j)
    seen = polar(pin)
    assert exactly(arm.omega, 0.8 * math.cos(math.radians(30)) ** 2 / 1.5)
    assert exactly(arm.omega, seen.angle[1])
    assert exactly(arm.epsilon, seen.angle[2])
    assert exactly(block.position, seen.radius[0])
    assert exactly(block.speed, seen.radius[1])
    assert exactly(block.acceleration, seen.radius[2])


def test_meriam_5_12_instantaneous_centre():
    """Page 364: the centre C of the link lies 14 in over A and 14√2 in from B.

    Counter-clockwise in print, with OB clockwise. D at 6 in from A has CD = 15.23 in.
    """
    found = answers(scene_text("textbook/linkage-5-12"))
    link, a, d = found.links["BA"], found.points["A"], found.points["D"]
    assert rounds_to(link.omega, "4.29")
    assert rounds_to(abs(a.velocity) / FT, "5.00")
    assert rounds_to(abs(d.velocity) / FT, "5.44")

    assert exactly(link.omega, 60 / 14)
    assert exactly(a.velocity, 60 * IN)
    centre = (20 + 20j) * IN
    assert rounds_to(abs(d.position - centre) / IN, "15.23")
    assert exactly(d.velocity, 1j * link.omega * (d.position - centre))
    ratio = link.instant_centre
    assert exactly(ratio.start + ratio.shift / ratio.size, centre)


def test_meriam_5_16_slider_in_a_turning_slot():
    """Page 391: both motions are given; v = 5 i + 24 j, a = -15 i - 20 j in in/s and in/s²."""
    found = answers(scene_text("textbook/slotted-disk-5-16"))
    a, slide = found.points["A"], found.slides["slider"]
    assert rounds_to(abs(a.velocity) / IN, "24.5")
    assert rounds_to(abs(a.acceleration) / IN, "25")

    assert exactly(a.velocity, (5 + 24j) * IN)
    assert exactly(a.acceleration, (-15 - 20j) * IN)
    assert exactly(slide.coriolis, 40j * IN)
    assert exactly(slide.acceleration, 81 * IN)


def test_meriam_5_17_5_18_pin_in_a_turning_slot():
    """Pages 392 and 393: OD clockwise at 2 rad/s, CA level; ω of CA counter-clockwise.

    The book's axes turn with the slot and have k into the page: its ω = 2k and -4, ε = +32 are here
    -2, +4 and -32. The line OD crosses the circle about C at A and farther out at (450, 450).
    """
    found = answers(scene_text("textbook/slot-5-17"))
    link, slide, a = found.links["CA"], found.slides["block"], found.points["A"]
    assert rounds_to(link.omega, "4")
    assert rounds_to(slide.speed * 1000, "-636")
    assert rounds_to(abs(a.velocity) * 1000, "900")
    assert rounds_to(link.epsilon, "-32")
    assert rounds_to(slide.acceleration * 1000, "8910")

    assert exactly(link.omega, 4)
    assert exactly(link.epsilon, -32)
    assert exactly(slide.speed, -0.45 * math.sqrt(2))
    assert exactly(slide.acceleration, 6.3 * math.sqrt(2))
    assert exactly(a.position, 0.225 + 0.225j)
    assert exactly(a.velocity, -0.9j)
    seen = polar(less((a.position, a.velocity, a.acceleration), fixed(0)))
    assert exactly(seen.radius[2], slide.acceleration)
    assert exactly(seen.angle[2], 0, largest=32)
