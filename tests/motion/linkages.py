"""Small linkages with numbers of one's own, in metres, degrees and rad/s."""

from __future__ import annotations

from math import acos, degrees

from graphkin.mechanism import Mechanism
from tests.mechanisms import mechanism_of

FOUR_BAR = """
[frame]
O1 = [0, 0]
O2 = [{frame}, 0]
[links.1]
O1-A = {crank}
[links.2]
A-B = {coupler}
[links.3]
O2-B = {rocker}
[[drivers]]
turn = 1
angle = {angle}
speed = {speed}
[branches]
B = "{side} of A-O2"
"""
SLIDER_CRANK = """
[frame]
O = [0, 0]
[links.1]
O-A = {crank}
[links.2]
A-B = {rod}
[links.3]
B = [0, 0]
slides = {{ on = 0, through = [0, {offset}], angle = 0 }}
[[drivers]]
turn = 1
angle = {angle}
speed = {speed}
[branches]
3 = "{way}"
"""
FIVE_BAR = """
[frame]
O1 = [0, 0]
O2 = [4, 0]
[links.1]
O1-A = 1
[links.2]
A-C = 3
[links.3]
C-B = 3
[links.4]
O2-B = 1.2
[[drivers]]
turn = 1
angle = {first}
speed = {speed}
acceleration = {push}
[[drivers]]
turn = 4
angle = {second}
speed = {other}
[branches]
C = "left of A-B"
"""


def four_bar(
    crank: float,
    coupler: float,
    rocker: float,
    frame: float,
    *,
    angle: float = 30,
    side: str = "left",
    speed: float = 1,
) -> Mechanism:
    """A four-bar O1 A B O2 with O2 on the x axis."""
    return mechanism_of(
        FOUR_BAR.format(
            crank=crank,
            coupler=coupler,
            rocker=rocker,
            frame=frame,
            angle=angle,
            side=side,
            speed=speed,
        )
    )


def slider_crank(
    crank: float,
    rod: float,
    offset: float = 0,
    *,
    angle: float = 30,
    way: str = "forward",
    speed: float = 1,
) -> Mechanism:
    """A slider-crank O A B whose guide lies along x at a height above the pivot."""
    return mechanism_of(
        SLIDER_CRANK.format(crank=crank, rod=rod, offset=offset, angle=angle, way=way, speed=speed)
    )


def five_bar(
    *, first: float = 60, second: float = 40, speed: float = 2, other: float = -1, push: float = 0
) -> Mechanism:
    """A five-bar with two driven cranks."""
    return mechanism_of(
        FIVE_BAR.format(first=first, second=second, speed=speed, other=other, push=push)
    )


def cosine_rule(near: float, far: float, opposite: float) -> float:
    """The angle (degrees) between two sides of a triangle, opposite the third."""
    return degrees(acos((near**2 + far**2 - opposite**2) / (2 * near * far)))
