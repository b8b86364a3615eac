"""Three linkages that everyone has: as scenes of ours, and with the peer library pylinkage.

The same lengths, the same crank angles from 0 to 360 degrees, the same work: position, velocity and
acceleration of every moving pin.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

HEAD = """
graphkin = 1
title = "Bench"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[parameters]
phi = { value = 40 }
[[drivers]]
turn = 1
angle = "phi"
speed = 10
"""

SCENES = {
    "four-bar": HEAD
    + """
[frame]
O1 = [0, 0]
O2 = [100, 0]
[links.1]
O1-A = 40
[links.2]
A-B = 90
[links.3]
O2-B = 70
[branches]
B = "left of A-O2"
""",
    "slider-crank": HEAD
    + """
[frame]
O = [0, 0]
[links.1]
O-A = 60
[links.2]
A-B = 200
[links.3]
B = [0, 0]
slides = { on = 0, through = [0, 20], angle = 0 }
[branches]
3 = "forward"
""",
    "six-bar": HEAD
    + """
[frame]
O1 = [0, 0]
O2 = [150, -20]
O3 = [340, 20]
[links.1]
O1-A = 50
[links.2]
A-B = 150
[links.3]
O2-B = 90
O2-C = 100
B-O2-C = -70
[links.4]
C-D = 120
[links.5]
O3-D = 80
[branches]
B = "left of A-O2"
D = "left of C-O3"
""",
}
OMEGA = 10.0
PINS = {"four-bar": "AB", "slider-crank": "AB", "six-bar": "ABCD"}


def peer(name: str, size: int) -> tuple[Callable[[], Any], tuple[int, ...]]:
    """A full turn by pylinkage's compiled path, and where each moving pin is in what it returns."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import FixedDyad, RRPDyad, RRRDyad
    from pylinkage.simulation import Linkage

    step = math.tau / size

    def crank(radius: float) -> Any:
        return Crank(
            anchor=origin, radius=radius, angular_velocity=step, initial_angle=-step, name="A"
        )

    origin = Ground(0.0, 0.0, name="O1")
    if name == "slider-crank":
        a = crank(0.06)
        guide = Ground(0.0, 0.02, name="G"), Ground(1.0, 0.02, name="H")
        b = RRPDyad(a.output, *guide, distance=0.2, x=0.25, y=0.02, name="B")
        parts, pins = [origin, *guide, a, b], (3, 4)
    elif name == "four-bar":
        a, right = crank(0.04), Ground(0.1, 0.0, name="O2")
        b = RRRDyad(a.output, right, distance1=0.09, distance2=0.07, x=0.07, y=0.06, name="B")
        parts, pins = [origin, right, a, b], (2, 3)
    else:
        a = crank(0.05)
        middle, right = Ground(0.15, -0.02, name="O2"), Ground(0.34, 0.02, name="O3")
        b = RRRDyad(a.output, middle, distance1=0.15, distance2=0.09, x=0.13, y=0.07, name="B")
        c = FixedDyad(middle, b, distance=0.1, angle=-math.radians(70), name="C")
        d = RRRDyad(c, right, distance1=0.12, distance2=0.08, x=0.33, y=0.1, name="D")
        parts, pins = [origin, middle, right, a, b, c, d], (3, 4, 5, 6)
    linkage = Linkage(parts)
    linkage.set_input_velocity(a, OMEGA, 0.0)
    return lambda: linkage.step_fast_with_kinematics(size), pins
