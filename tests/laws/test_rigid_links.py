"""Laws of one rigid link: Galileo, Rivals, Chasles and Mehmke's pole.

Each holds on the shipped mechanisms for every student number and on mechanisms made at random:
cranks at constant and growing speed, turning either way, chains of dyads on both branches, plates
given by lengths, angles and coordinates, points on the line of a bar, guides inclined and offset.
"""

from __future__ import annotations

from cmath import phase
from functools import cache
from itertools import combinations
from math import atan2

import pytest
from hypothesis import given, settings

from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import cross, dot
from graphkin.structure.pairs import Pin, Sliding, pairs
from tests.mechanisms import LAW, SHIPPED, mechanisms, shipped

CLOSE = 1e-10
"""What rounding may leave of a law, as a share of the largest such quantity in the mechanism."""


class Moving:
    """A solved mechanism and the largest length, speed and acceleration in it."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism, self.scene = mechanism, mechanism.scene
        self.solution = mechanism.solve()
        points = self.solution.points.values()
        self.length = max(abs(p.position - q.position) for p, q in combinations(points, 2))
        turning = [abs(link.omega) for link in self.solution.links.values()]
        twisting = [abs(link.epsilon) for link in self.solution.links.values()]
        self.speed = max(turning) * self.length
        self.acceleration = max(max(turning) ** 2, *twisting) * self.length

    def turning(self):
        """Each link that can turn, with the motion of its points."""
        for name, link in self.links().items():
            yield link, [self.solution.points[p] for p in self.scene.link(name).points]

    def links(self):
        """The links that can turn; a block on the frame has no centre and no pole."""
        found = self.solution.links.items()
        return {name: link for name, link in found if link.acceleration_pole is not None}

    def bars(self):
        """Each link that can turn, with each two of its points."""
        for link, points in self.turning():
            for p, q in combinations(points, 2):
                yield link, p, q


@cache
def moving_for(name: str, n: int) -> Moving:
    """A shipped mechanism solved once for all laws."""
    return Moving(shipped(name, n))


def galileo(moving: Moving) -> None:
    """v_Q = v_P + ω × PQ: the image of a link is similar to it, turned by 90°, at the scale ω."""
    for link, p, q in moving.bars():
        turned = 1j * link.omega * (q.position - p.position)
        assert abs(q.velocity - p.velocity - turned) <= CLOSE * moving.speed


def rivals(moving: Moving) -> None:
    """a_Q = a_P + ε × PQ - ω² PQ: an image at the scale sqrt(ε² + ω⁴)."""
    for link, p, q in moving.bars():
        bar = q.position - p.position
        relative = 1j * link.epsilon * bar - link.omega**2 * bar
        assert abs(q.acceleration - p.acceleration - relative) <= CLOSE * moving.acceleration


def chasles(moving: Moving) -> None:
    """Each velocity is square to the line to the instantaneous centre, and ω times its length."""
    for link, points in moving.turning():
        centre = link.instant_centre
        for p in points:
            arm = (p.position - centre.start) * centre.size - centre.shift
            weight = abs(centre.size) + abs(arm) / moving.length
            assert abs(dot(arm, p.velocity)) <= CLOSE * abs(arm) * moving.speed
            left = p.velocity * centre.size - 1j * link.omega * arm
            assert abs(left) <= CLOSE * moving.speed * weight


def mehmke(moving: Moving) -> None:
    """The point of a link at its acceleration pole has no acceleration."""
    for link, points in moving.turning():
        pole = link.acceleration_pole
        for p in points:
            arm = (pole.start - p.position) * pole.size + pole.shift
            weight = abs(pole.size) + abs(arm) / moving.length
            left = p.acceleration * pole.size + (1j * link.epsilon - link.omega**2) * arm
            assert abs(left) <= CLOSE * moving.acceleration * weight


def kennedy(moving: Moving) -> None:
    """The centres of three links lie on one line: two links, the frame, and the pin between."""
    links, points = moving.links(), moving.solution.points
    for pair in pairs(moving.scene):
        if not isinstance(pair, Pin) or not all(name in links for name in pair.links):
            continue
        pin = points[pair.point]
        arms = []
        for name in pair.links:
            centre = links[name].instant_centre
            arms.append((pin.position - centre.start) * centre.size - centre.shift)
        sine = abs(cross(*arms)) / max(abs(arms[0]) * abs(arms[1]), 1e-300)
        assert sine * abs(pin.velocity) <= CLOSE * moving.speed


def kennedy_on_a_guide(moving: Moving) -> None:
    """A block's centre is at infinity across its guide: its rod's lies straight above the pin."""
    links, points = moving.links(), moving.solution.points
    for pair in pairs(moving.scene):
        if not isinstance(pair, Sliding):
            continue
        along = pair.slide.angle.direction(moving.scene.values)
        for name, link in links.items():
            for point in moving.scene.link(name).points:
                if point in moving.scene.link(pair.block).points:
                    pin, centre = points[point], link.instant_centre
                    arm = (pin.position - centre.start) * centre.size - centre.shift
                    sine = abs(dot(along, arm)) / max(abs(arm), 1e-300)
                    assert sine * abs(pin.velocity) <= CLOSE * moving.speed
                    assert abs(cross(along, pin.velocity)) <= CLOSE * moving.speed
                    assert abs(cross(along, pin.acceleration)) <= CLOSE * moving.acceleration


LAWS = (
    galileo,
    rivals,
    chasles,
    mehmke,
    kennedy,
    kennedy_on_a_guide,
)


@settings(LAW, max_examples=100)
@given(mechanisms())
def test_every_law_holds_on_mechanisms_made_at_random(made):
    moving = Moving(made.mechanism())
    for law in LAWS:
        law(moving)


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
def test_for_every_student_number(law, name):
    for n in range(1, 31):
        law(moving_for(name, n))


@LAW
@given(mechanisms(steady=True))
def test_a_crank_at_constant_speed_has_its_centre_and_its_pole_in_its_pivot(made):
    solution = made.mechanism().solve()
    for driver in made.drivers:
        link, pivot = solution.links[driver.link], made.places[driver.pivot]
        assert link.instant_centre.start + link.instant_centre.shift / link.omega == pivot
        assert abs(link.acceleration_pole.shift) == 0
        assert link.acceleration_pole.start == pivot


@LAW
@given(mechanisms(steady=False))
def test_a_crank_that_gathers_speed_leans_its_acceleration_by_atan_of_epsilon_over_omega_squared(
    made,
):
    solution = made.mechanism().solve()
    for driver in made.drivers:
        inwards = made.places[driver.pivot] - made.places[driver.tip]
        lean = phase(solution.points[driver.tip].acceleration / inwards)
        assert lean == pytest.approx(-atan2(driver.acceleration, driver.speed**2), abs=1e-12)
