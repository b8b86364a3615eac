"""Laws of motion in time: their derivatives are exact, against mpmath's numerical ones."""

from __future__ import annotations

import math
from fractions import Fraction

import mpmath
import pytest

from graphkin.scene.quantity import expression
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError

LAWS = {
    "30 + 120*t": lambda t: 30 + 120 * t,
    "10 + 5*t - 3*t**2": lambda t: 10 + 5 * t - 3 * t**2,
    "40*sin(90*t)": lambda t: 40 * mpmath.sin(mpmath.radians(90 * t)),
    "-cos(t**2)/(1 + t)": lambda t: -mpmath.cos(mpmath.radians(t**2)) / (1 + t),
    "sqrt(1 + t**2)*n": lambda t: mpmath.sqrt(1 + t**2) * 7,
    "tan(20*t)": lambda t: mpmath.tan(mpmath.radians(20 * t)),
    "(1 + t)**2.5": lambda t: (1 + t) ** 2.5,
    "(2 + t)**n / 1e3": lambda t: (2 + t) ** 7 / 1000,
    "(t + 1)**-2 + t**1 + t**0": lambda t: (t + 1) ** -2 + t + 1,
    "3 - (2 - t)*(t - pi)": lambda t: 3 - (2 - t) * (t - mpmath.pi),
    "1/(1/(t + 2))": lambda t: t + 2,
    "sin(sin(60*t))": lambda t: mpmath.sin(mpmath.radians(mpmath.sin(mpmath.radians(60 * t)))),
}


@pytest.mark.parametrize("text", LAWS)
@pytest.mark.parametrize("moment", [Fraction(0), Fraction(1, 3), Fraction(13, 10)])
def test_speed_and_acceleration_are_the_derivatives(text: str, moment: Fraction) -> None:
    values = {"n": Fraction(7), "t": moment}
    law = expression(text, "deg")
    speed = law.derivative("t")
    at = mpmath.mpf(moment.numerator) / moment.denominator
    with mpmath.workdps(40):
        first, second = (mpmath.diff(LAWS[text], at, order) for order in (1, 2))
    assert float(law.number(values)) == pytest.approx(float(LAWS[text](at)), rel=1e-12)
    assert float(speed.number(values)) == pytest.approx(float(first), rel=1e-12, abs=1e-15)
    assert float(speed.derivative("t").number(values)) == pytest.approx(
        float(second), rel=1e-12, abs=1e-15
    )


def test_polynomials_stay_exact() -> None:
    speed = expression("10 + 5*t - 3*t**2", "deg").derivative("t")
    assert speed.number({"t": Fraction(1, 3)}) == 3
    assert speed.derivative("t").number({"t": Fraction(1, 3)}) == -6


LAW = """
graphkin = 1
time = "n/14"
units = {{ length = "cm", angle = "deg", speed = "rev/min" }}
[parameters]
n = 7
[frame]
O = [0, 0]
[links.1]
O-A = 30
[links.2]
A = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[drivers]]
{driver}
"""


def test_a_driver_may_follow_a_law() -> None:
    scene = read_text(LAW.format(driver='turn = 1\nangle = "30 + 2*n*t + 9*t**2"'), "law")
    driver = scene.drivers[0]
    assert scene.values == {"n": 7, "t": Fraction(1, 2)}
    assert driver.position.number(scene.values) == Fraction("39.25")
    assert driver.speed.number(scene.values) == 23
    assert driver.acceleration.number(scene.values) == 18
    assert (driver.speed.unit, driver.acceleration.unit) == ("deg/s", "deg/s²")
    assert driver.speed.si(scene.values) == pytest.approx(math.radians(23))


def test_a_slide_may_follow_a_law() -> None:
    driver = read_text(LAW.format(driver='slide = 2\nposition = "4*t**2"'), "law").drivers[0]
    values = {"t": Fraction(1, 2)}
    assert driver.speed.si(values) == 0.04
    assert driver.acceleration.si(values) == 0.08


@pytest.mark.parametrize(
    ("driver", "place", "found"),
    [
        ('turn = 1\nangle = "2**t"', "drivers[0].angle", "an exponent that holds t"),
        ('turn = 1\nangle = "t"\nspeed = 3', "drivers[0].speed", "speed beside a law of time"),
        ('turn = 1\nangle = "t"\nacceleration = 3', "drivers[0].acceleration", "beside a law"),
        ('turn = 1\nangle = 3\nspeed = "t"', "drivers[0].speed", "uses the time t"),
        ('turn = 1\nangle = "sqrt(t - 1/2)"', "drivers[0].angle", "division by zero"),
        ('turn = 1\nangle = "' + "*".join(["sin(t)"] * 55) + '"', "drivers[0].angle", "many parts"),
    ],
)
def test_a_law_that_cannot_be_followed(driver: str, place: str, found: str) -> None:
    with pytest.raises(SceneError) as caught:
        read_text(LAW.format(driver=driver), "law")
    assert [problem.place for problem in caught.value.problems] == [place]
    assert found in str(caught.value)


def test_a_law_needs_a_time() -> None:
    text = LAW.format(driver='turn = 1\nangle = "30*t"').replace('time = "n/14"', "")
    with pytest.raises(SceneError, match="uses the time t, and the scene has no time"):
        read_text(text, "law")


@pytest.mark.parametrize(
    ("law", "first", "at"),
    [
        ("t**0.5", "speed", 0),
        ("t**(1/3)", "speed", 0),
        ("sqrt(t)", "speed", 0),
        ("(1 - t)**0.5", "speed", 1),
        ("1/3 + (2*t)**0.9", "speed", 0),
        ("t**1.5", "acceleration", 0),
        ("(1-cos(360*t))**1.5", "acceleration", 0),
        ("t**(n/4)", "acceleration", 0),
        ("t**-0.5", "law", 0),
    ],
)
def test_a_derivative_that_is_infinite_is_told_with_its_place(
    law: str, first: str, at: int
) -> None:
    """The speed of t^½ at 0 is 1/(2·√0); t^1½ has a speed there, and no acceleration."""
    with pytest.raises(SceneError) as caught:
        text = LAW.format(driver=f'turn = 1\nangle = "{law}"').replace("n/14", str(at))
        read_text(text, "law")
    (problem,) = caught.value.problems
    assert problem.place == "drivers[0].angle"
    what = {"law": law, "speed": f"d({law})/dt", "acceleration": f"d(d({law})/dt)/dt"}[first]
    assert problem.found.startswith(f'"{what}" gives division by zero with ')
    assert f"t = {at}" in problem.found
    assert ("finite at its time" in problem.hint) == (first != "law")


def test_a_power_that_is_smooth_at_zero_is_followed() -> None:
    """t^2½ has the speed 2.5·t^1½ and the acceleration 3.75·√t, both 0 at 0."""
    text = LAW.format(driver='turn = 1\nangle = "t**2.5"').replace("n/14", "0")
    driver = read_text(text, "law").drivers[0]
    values = {"t": Fraction(0), "n": Fraction(7)}
    assert driver.speed.number(values) == driver.acceleration.number(values) == 0
