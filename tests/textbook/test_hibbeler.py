"""R. C. Hibbeler, A. Gupta, Engineering Mechanics: Statics and Dynamics, chapter 16.

Figures are not seen: layouts come from the printed vectors and lengths.
"""

from __future__ import annotations

import math

from tests.scene_files import scene_text
from tests.textbook.book import answers, exactly, rounds_to, within
from tests.textbook.closed_forms import degrees, dyad, fixed, less, polar, rod_on_guide, turned

METRES = 'units = { length = "m", angle = "deg", speed = "rad/s" }\n'


def test_hibbeler_16_5_hydraulic_cylinder():
    """Page 666: a cylinder from a point 2 m off the hinge opens a window; its pin is 1 m off.

    At 30° it lengthens at a constant 0.5 m/s. Printed -0.416 rad/s² from ω = 0.620 rad/s. The other
    closure has the window at -30°.
    """
    found = answers(METRES + scene_text("textbook/cylinder-16-5"))
    window, barrel = found.links["window"], found.links["barrel"]
    assert rounds_to(window.omega, "0.62")
    assert within(window.epsilon, -0.416, share=0.003)

    sine, cosine = 0.5, math.cos(math.radians(30))
    omega = math.sqrt(5 - 4 * cosine) * 0.5 / (2 * sine)
    epsilon = (0.5**2 - 2 * cosine * omega**2) / (2 * sine)
    assert exactly(found.points["B"].position, cosine + 1j * sine)
    assert exactly(window.omega, omega)
    assert exactly(window.epsilon, epsilon)
    seen = polar(less(turned(degrees(30, omega, epsilon), 1), fixed(2)))
    assert exactly(barrel.omega, seen.angle[1])
    assert exactly(barrel.epsilon, seen.angle[2])
    assert exactly(seen.radius[1], 0.5)


def test_hibbeler_16_6_link_on_two_guides():
    """Page 673: A goes down at 2 m/s, the link at 45°."""
    found = answers(METRES + scene_text("textbook/link-16-6"))
    assert rounds_to(found.links["2"].omega, "14.1")
    assert rounds_to(found.points["B"].velocity.real, "2.0")

    assert exactly(found.links["2"].omega, 10 * math.sqrt(2))
    assert exactly(found.points["B"].velocity, 2)
    assert exactly(found.points["B"].acceleration, -(2**2) / 0.2 * math.sqrt(2) ** 3)


def test_hibbeler_16_7_cylinder_on_a_belt():
    """Page 674: a cylinder rolls on a belt of 1 m/s, ωr = 3 m/s clockwise; A level with its centre.

    Only the product ωr is in our source; 15 rad/s and 0.2 m are ours. 36.9° over the level.
    """
    found = answers(METRES + scene_text("textbook/belt-16-7"))
    a = found.points["A"]
    assert rounds_to(abs(a.velocity), "5.0")
    assert rounds_to(math.degrees(math.atan2(a.velocity.imag, a.velocity.real)), "36.9")

    assert exactly(found.links["cylinder"].omega, -15)
    assert exactly(found.points["O"].velocity, 4)
    assert exactly(a.velocity, 4 + 3j)
    assert exactly(a.acceleration, 15**2 * 0.2)


def test_hibbeler_16_8_16_17_collar_drives():
    """Pages 675 and 695: the collar goes down at 2 m/s and 1 m/s²; B stands at the origin."""
    found = answers(METRES + scene_text("textbook/collar-16-8"))
    pin, long, short = found.points["B"], found.links["CB"], found.links["AB"]
    assert rounds_to(pin.velocity.real, "2.0")
    assert rounds_to(long.omega, "10.0")
    assert rounds_to(short.omega, "10.0")
    assert rounds_to(long.epsilon, "5.0")
    assert rounds_to(short.epsilon, "-95.0")

    start = (-0.2 + 0.2j, -2j, -1j)
    closed = dyad(start, 0.2 * math.sqrt(2), 0.2, fixed(0.2j), -1)
    assert exactly(pin.position, 0, largest=0.2)
    assert exactly(pin.velocity, 2)
    assert exactly(pin.acceleration, -19 + 20j)
    assert exactly(pin.velocity, closed.pin[1])
    assert exactly(pin.acceleration, closed.pin[2])
    for link, angle, omega, epsilon in ((long, closed.left, 10, 5), (short, closed.right, 10, -95)):
        assert exactly(link.omega, omega)
        assert exactly(link.epsilon, epsilon)
        assert exactly(link.omega, angle[1])
        assert exactly(link.epsilon, angle[2])


def test_hibbeler_16_9_four_bar():
    """Page 676: AB clockwise at 30 rad/s, 60° over the level, BC level, CD upright, D over C.

    Printed 52.0 rad/s from v_C = 5.20 m/s.
    """
    found = answers(METRES + scene_text("textbook/four-bar-16-9"))
    coupler, wheel = found.links["BC"], found.links["DC"]
    assert rounds_to(coupler.omega, "15.0")
    assert rounds_to(wheel.omega, "52.0")

    assert exactly(coupler.omega, 15)
    assert exactly(wheel.omega, 60 * math.sin(math.radians(60)))
    pivot = complex(0.1 + 0.2, 0.2 * math.sin(math.radians(60)) + 0.1)
    closed = dyad(turned(degrees(60, -30), 0.2), 0.2, 0.1, fixed(pivot), -1)
    assert exactly(coupler.epsilon, closed.left[2])
    assert exactly(wheel.epsilon, closed.right[2])


def test_hibbeler_16_11_centre():
    """Page 684: the block D at 3 m/s; the bars, 0.4 m each, square to one another and at 45°.

    The centre of BD lies 0.4 m from B and 0.566 m over D. Printed without senses.
    """
    found = answers(METRES + scene_text("textbook/linkage-16-11"))
    rod, crank = found.links["BD"], found.links["AB"]
    assert rounds_to(abs(rod.omega), "5.3")
    assert rounds_to(abs(crank.omega), "5.3")

    assert exactly(rod.omega, -3 / (0.4 * math.sqrt(2)))
    assert exactly(crank.omega, 3 / (0.4 * math.sqrt(2)))
    centre = rod.instant_centre
    place = centre.start + centre.shift / centre.size
    assert exactly(place, complex(-0.4 * math.sqrt(2), 0.4 * math.sqrt(2)))


def test_hibbeler_16_12_cylinder_between_plates():
    """Page 685: a cylinder of 0.25 m between plates that go 0.4 and 0.25 m/s in opposite senses."""
    found = answers(METRES + scene_text("textbook/plates-16-12"))
    omega, speed = found.links["cylinder"].omega, found.points["C"].velocity
    assert rounds_to(omega, "2.6")
    assert rounds_to(speed.real, "0.075")

    assert exactly(omega, (0.4 + 0.25) / 0.25)
    assert exactly(speed, (0.4 - 0.25) / 2)
    assert exactly(found.points["C"].position, 0.125j)


def test_hibbeler_16_13_rod_on_two_planes():
    """Page 691: a level rod of 10 m, A down a plane of 45° at 2 m/s and 3 m/s², B up another."""
    found = answers(METRES + scene_text("textbook/planes-16-13"))
    rod, b = found.links["2"], found.slides["3"]
    assert rounds_to(rod.omega, "0.283")
    assert rounds_to(rod.epsilon, "0.344")

    half = math.sqrt(0.5)
    assert exactly(rod.omega, 2 * 2 * half / 10)
    assert exactly(b.speed, 2)
    assert exactly(b.acceleration, 3 - rod.omega**2 * 10 / half)
    assert exactly(rod.epsilon, (3 + b.acceleration) * half / 10)


def test_hibbeler_16_15_disk():
    """Page 693: ω = 6 rad/s, α = 4 rad/s² counter-clockwise, r = 0.5 m; A the top, B to the right.

    The accelerations do not depend on the sense of ω.
    """
    found = answers(METRES + scene_text("textbook/disk-16-15"))
    a, b = found.points["A"].acceleration, found.points["B"].acceleration
    for mine, printed in ((b.real, "-20.0"), (b.imag, "2.0"), (a.real, "-4.0"), (a.imag, "-18.0")):
        assert rounds_to(mine, printed)

    assert exactly(found.links["disk"].omega, 6)
    assert exactly(found.links["disk"].epsilon, 4)
    assert exactly(a, -4 - 18j)
    assert exactly(b, -20 + 2j)


def test_hibbeler_16_16_spool_on_a_cord():
    """Page 694: a spool runs down an upright cord to its left, 3 rad/s and 4 rad/s² clockwise."""
    found = answers(METRES + scene_text("textbook/spool-16-16"))
    b = found.points["B"].acceleration
    assert rounds_to(abs(b), "9.25")
    assert rounds_to(math.degrees(math.atan2(-b.imag, b.real)), "71.1")

    assert exactly(found.links["spool"].omega, -3)
    assert exactly(found.links["spool"].epsilon, -4)
    assert exactly(found.points["G"].position, 0.5)
    assert exactly(found.points["G"].acceleration, -2j)
    assert exactly(b, 3 - 8.75j)


def test_hibbeler_16_18_engine_speeding_up():
    """Page 696: the crank at 45° with 10 rad/s and 20 rad/s² clockwise, the piston above it.

    Computed in print from coordinates of three digits: a_C is printed 0.5 % too large.
    """
    found = answers(METRES + scene_text("textbook/engine-16-18"))
    rod, piston = found.links["rod"], found.points["C"]
    assert rounds_to(rod.epsilon, "27.7")
    assert within(piston.acceleration.imag, -13.6, share=0.006)

    crank = turned(degrees(135, -10, -20), 0.25)
    closed = rod_on_guide(crank, 0.75, guide=math.pi / 2)
    assert exactly(rod.omega, closed.angle[1])
    assert exactly(rod.epsilon, closed.angle[2])
    assert exactly(piston.velocity, 1j * closed.slide[1])
    assert exactly(piston.acceleration, 1j * closed.slide[2])
    assert rounds_to(rod.omega, "2.425356")
    assert rounds_to(rod.epsilon, "27.67759")
    assert rounds_to(piston.acceleration.imag, "-13.53685")


def test_hibbeler_16_19_collar_on_a_turning_rod():
    """Page 705, in the axes of the rod: Coriolis -12 j, v = 2 i - 0.6 j, a = 1.2 i - 12.4 j."""
    found = answers(METRES + scene_text("textbook/rod-16-19"))
    c, slide = found.points["C"], found.slides["collar"]
    assert rounds_to(slide.coriolis.imag, "-12")
    assert rounds_to(c.velocity.imag, "-0.6")
    assert rounds_to(c.acceleration.real, "1.2")
    assert rounds_to(c.acceleration.imag, "-12.4")

    assert exactly(slide.coriolis, -12j)
    assert exactly(c.velocity, 2 - 0.6j)
    assert exactly(c.acceleration, 1.2 - 12.4j)


def test_hibbeler_16_20_collar_on_a_swinging_rod():
    """Page 706: AB clockwise with 3 rad/s and 4 rad/s²; ω of DE 3 clockwise, α 5 the other way."""
    found = answers(METRES + scene_text("textbook/collar-16-20"))
    rod, slide = found.links["DE"], found.slides["collar"]
    assert rounds_to(rod.omega, "-3")
    assert rounds_to(rod.epsilon, "5.0")
    assert rounds_to(slide.speed, "1.2")
    assert rounds_to(slide.acceleration, "1.6")

    assert exactly(rod.omega, -3)
    assert exactly(rod.epsilon, 5)
    assert exactly(slide.speed, 1.2)
    assert exactly(slide.acceleration, 1.6)
    assert exactly(slide.coriolis, -7.2j)
    assert exactly(found.points["C"].acceleration, -2 - 5.2j)
