"""Closures beside the place where a dyad of theirs is stretched flat: all, by their own numbers.

The independent count is a polynomial: for a turn of link 5 the conditions of links 2 and 3 are
linear in the cosine and sine of the turn of link 4, and cos² + sin² = 1 leaves one equation, in
which no dyad is drawn and a flat one is no special place. Its roots have 60 digits.
"""

from __future__ import annotations

import re
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from graphkin.accuracy.certified import Certifier
from graphkin.diagnosis.closures import choices
from graphkin.mechanism import Mechanism
from graphkin.numbers.kinds import decimal_kind
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import ClosureError
from tests.chosen import EVERY

SCENE = Path(__file__).resolve().parents[2] / "examples" / "scenes" / "stephenson-2-ternary.toml"
MP = mpmath.mp.clone()
MP.dps = 60
DEGREE = 4
"""Of the polynomial, at most, in the turn of link 5."""
NEAR = ("12.2943568", "53.1639033")
"""Angles of the driver (degrees) near which links 3 and 4 are in line in one closure."""
OFFSETS = ["+1e-4", "-1e-8", "+1e-12"]
"""Degrees from there, to both sides."""

PLACES = (
    [*product(NEAR, OFFSETS), *((near, "0") for near in NEAR)]
    if EVERY
    else [(NEAR[0], OFFSETS[0]), (NEAR[1], OFFSETS[1]), (NEAR[0], OFFSETS[2])]
)


def apex(base: Any, left: Any, right: Any) -> Any:
    """The third point of a triangle on 0 and ``base``, right of the way, by its distances."""
    along = (left**2 - right**2 + base**2) / (2 * MP.mpf(base))
    return along - 1j * MP.sqrt(left**2 - along**2)


B_BODY, E_BODY = apex(69, 67, 93), apex(112, 74, 128)
"""B in link 1 from O1 towards A; E in link 4 from D towards C."""


def condition(end: Any, arm: Any, pin: Any, length: Any) -> tuple[Any, Any, Any]:
    """The factors of cosine and sine in |end + arm·turn - pin|² = length², and what they add to."""
    product = MP.conj(end - pin) * arm
    rest = abs(end - pin) ** 2 + abs(arm) ** 2 - MP.mpf(length) ** 2
    return 2 * product.real, -2 * product.imag, -rest


def conditions(driver: Any, turn: Any) -> tuple[Any, Any, Any]:
    """The determinants for cosine and sine of link 4, and that by which they are divided."""
    end = 220 + 94 * turn
    a, b, c = condition(end, 112 - E_BODY, 69 * driver, 119)
    d, e, f = condition(end, -E_BODY, B_BODY * driver, 93)
    return c * e - b * f, a * f - c * d, a * e - b * d


def squared(driver: Any, turn: Any) -> Any:
    """What vanishes where link 4 can be turned so: a polynomial in the turn of link 5."""
    cosine, sine, divisor = conditions(driver, turn)
    return cosine**2 + sine**2 - divisor**2


@cache
def places(angle: Any) -> list[tuple[Any, Any]]:
    """C and D (m) in every closure at an angle of the driver, in the order of their numbers."""
    driver, count = MP.expj(MP.radians(angle)), 2 * DEGREE + 1
    turns = [MP.expjpi(MP.mpf(2 * k) / count) for k in range(count)]
    values = [squared(driver, turn) for turn in turns]
    factors = [
        sum(value * turn**-power for value, turn in zip(values, turns, strict=True)) / count
        for power in range(-DEGREE, DEGREE + 1)
    ]
    while abs(factors[0]) < MP.mpf("1e-40") * max(map(abs, factors)):
        factors = factors[1:-1]
    found = []
    for root in MP.polyroots(factors, maxsteps=500, extraprec=400, asc=True):
        if abs(abs(root) - 1) < MP.mpf("1e-25"):
            cosine, sine, divisor = conditions(driver, root / abs(root))
            turn, end = (cosine + 1j * sine) / divisor, 220 + 94 * root / abs(root)
            c, d = end + (112 - E_BODY) * turn, end - E_BODY * turn
            found.append((MP.arg(c - 69 * driver) % (2 * MP.pi), (c / 1000, d / 1000)))
    return [pair for _, pair in sorted(found, key=lambda each: each[0])]


def opening(angle: Any) -> Any:
    """Sine of the angle between links 3 and 4, with its sign, where it is least."""
    b = B_BODY * MP.expj(MP.radians(angle)) / 1000
    sines = [((d - b) * MP.conj(c - d)).imag / abs(d - b) / abs(c - d) for c, d in places(angle)]
    return min(sines, key=abs)


@cache
def flat_at(near: str) -> Any:
    """The angle of the driver at which links 3 and 4 are in line, in 50 digits."""
    start = MP.mpf(near)
    return MP.findroot(opening, (start, start + MP.mpf("1e-8")), tol=MP.mpf("1e-90"))


def mechanism(angle: Any, number: int) -> Mechanism:
    """The scene with another angle of its driver and another closure."""
    text = SCENE.read_text(encoding="utf-8")
    text = re.sub(r"\nangle = 102", f'\nangle = "{MP.nstr(angle, 55)}"', text)
    text = re.sub(r'"closure \d"', f'"closure {number}"', text)
    return Mechanism(read_text(text, "made", None, {}))


@pytest.mark.parametrize(("near", "offset"), PLACES)
def test_every_closure_has_its_number(near, offset):
    angle = flat_at(near) + MP.mpf(offset)
    expected = places(angle)
    assert len(expected) == {"12.2943568": 2, "53.1639033": 4}[near]
    for number, pins in enumerate(expected, 1):
        trace = mechanism(angle, number).trace([("position", "C"), ("position", "D")])
        for point, place in zip("CD", pins, strict=True):
            assert trace.value("position", point) == pytest.approx(complex(place), abs=1e-8)


@pytest.mark.parametrize(("near", "offset"), [(NEAR[0], "+1e-7")])
def test_there_is_no_other_closure_and_check_lists_all(near, offset):
    angle = flat_at(near) + MP.mpf(offset)
    expected = [complex(c) for c, _ in places(angle)]
    with pytest.raises(ClosureError, match=f"close in {len(expected)} ways"):
        mechanism(angle, len(expected) + 1).trace([("position", "C")])
    asked = mechanism(angle, 1)
    (choice,) = choices(asked.scene, asked.groups, asked.program)
    assert [each.place for each in choice.closures] == pytest.approx(expected, abs=1e-9)
    assert not any(each.fails for each in choice.closures)


@pytest.mark.parametrize(("near", "offset"), [*PLACES[1:], (NEAR[1], "-1e-16")])
def test_balls_hold_the_place_of_every_closure(near, offset):
    angle = flat_at(near) + MP.mpf(offset)
    for number, pins in enumerate(places(angle), 1):
        asked = mechanism(angle, number)
        bits = 512 if offset == "0" else 256  # links in line to 55 digits meet to 110
        balls = Certifier.of(asked, [("position", "C"), ("position", "D")]).run(bits)
        assert not balls.blame
        for point, place in zip("CD", pins, strict=True):
            ball = balls.trace.value("position", point)
            assert float(ball.real.rad()) < 1e-50
            middle = [MP.mpf(each.mid().str(55, radius=False)) for each in (ball.real, ball.imag)]
            assert abs(MP.mpc(*middle) - place) < MP.mpf("1e-45")


@pytest.mark.parametrize(("near", "offset"), PLACES[1:])
def test_decimals_hold_to_all_digits(near, offset):
    angle = flat_at(near) + MP.mpf(offset)
    for number, pins in enumerate(places(angle), 1):
        trace = mechanism(angle, number).trace([("position", "D")], kind=decimal_kind(40))
        assert abs(MP.mpmathify(str(trace.value("position", "D").real)) - pins[1].real) < 1e-35


@pytest.mark.parametrize(("near", "offset"), [(NEAR[0], "+1e-8")])
def test_no_more_digits_are_promised_than_there_are(near, offset):
    angle = flat_at(near) + MP.mpf(offset)
    for number, pins in enumerate(places(angle), 1):
        asked = mechanism(angle, number)
        solution = asked.solve()
        share = 10.0 ** -asked.witness(solution).digits["position"]
        for point, place in zip("CD", pins, strict=True):
            off = abs(solution.points[point].position - complex(place))
            assert off <= share * abs(complex(place))


def test_a_dyad_that_is_flat_for_all_that_balls_tell_is_not_proved():
    angle = flat_at(NEAR[0])
    balls = Certifier.of(mechanism(angle, 2), [("position", "D")]).run(64)
    assert balls.blame


@pytest.mark.parametrize("near", NEAR)
def test_a_batch_keeps_its_closures_through_the_flat_place(near):
    text = SCENE.read_text(encoding="utf-8").replace("\nangle = 102", '\nangle = "phi"')
    offsets = np.array([float(each) for each in [*OFFSETS, "0"]])
    angle = float(flat_at(near))
    expected = np.array([complex(c) for c, _ in places(flat_at(near))])
    for number, place in enumerate(expected, 1):
        numbered = re.sub(r'"closure \d"', f'"closure {number}"', text)
        swept = Mechanism(read_text(f"{numbered}\n[parameters]\nphi = 1\n", "made", None, {}))
        found = swept.batch(phi=angle + offsets).points["C"].position
        there = np.isfinite(found)
        assert found[there] == pytest.approx(place, abs=1e-4)
        assert there.all() or abs(offsets[~there]).max() <= 1e-6
