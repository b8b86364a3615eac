"""Scenes that ask for centres in every way there is a sentence for."""

from __future__ import annotations

FOUR_BAR = """
[frame]
O1 = [0, 0]
O2 = [{ground}, 0]
[links.1]
O1-A = 80
[links.2]
A-B = {coupler}
[links.3]
O2-B = {rocker}
[[drivers]]
turn = 1
angle = 75
speed = {speed}
[branches]
B = "left of A-O2"
[ask]
{ask}
"""
TRAMMEL = """
[frame]
O = [0, 0]
[links.1]
A = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[links.2]
B-A = 100
[links.3]
B = [0, 0]
slides = { on = 0, through = "O", angle = 90 }
[[drivers]]
slide = 1
position = 60
speed = -200
[branches]
3 = "backward"
[ask]
velocity = ["A"]
centres = "all"
centrodes = [2]
curves = ["B"]
"""
FIVE_BAR = """
[frame]
O1 = [0, 0]
O2 = [160, 0]
[links.1]
O1-A = 70
[links.2]
A-C = 120
[links.3]
B-C = 110
[links.4]
O2-B = 60
[[drivers]]
turn = 1
angle = 110
speed = 10
[[drivers]]
turn = 4
angle = 60
speed = -4
[branches]
C = "left of A-B"
[ask]
velocity = ["C"]
centres = "all"
"""
GEARS = """
[frame]
O1 = [0, 0]
O2 = [150, 0]
[links.1]
O1 = [0, 0]
S = [40, 0]
wheel = { centre = "O1", radius = 90 }
[links.2]
O2 = [0, 0]
Q = [30, 0]
wheel = { centre = "O2", radius = 60 }
rolls = { on = 1 }
[[drivers]]
turn = 1
angle = 20
speed = 10
[ask]
velocity = ["Q"]
centres = ["1-2"]
"""
ROLLER = """
[frame]
T = [0, 0]
[links.1]
P = [0, 0]
wheel = { centre = "P", radius = 50 }
rolls = { on = 0, through = "T", angle = 0 }
[[drivers]]
roll = 1
position = 40
speed = 100
[ask]
velocity = ["P"]
acceleration = ["P"]
inflection = [1]
"""

LEVER = """
[frame]
O = [0, 0]
Q = [0, 150]
[links.1]
Q-A = 65
[links.2]
A = [0, 0]
slides = { on = 3, along = "O-E" }
[links.3]
O-E = 280
[[drivers]]
turn = 1
angle = 20
speed = 9
[branches]
2 = "forward"
[ask]
velocity = ["E"]
centres = [2, "0-2"]
poles = [2]
"""


def four_bar(ask: str, speed: float = 12, shape: tuple[int, int, int] = (150, 130, 120)) -> str:
    """A four-bar; its shape is ground, coupler and rocker."""
    names = ("ground", "coupler", "rocker")
    return FOUR_BAR.format(ask=ask, speed=speed, **dict(zip(names, shape, strict=True)))


ASKING = {
    "four-bar with all its centres": four_bar(
        'velocity = ["B"]\ncentres = "all"\ninflection = [1, 2]\ncentrodes = [2]\ncurves = ["B"]'
    ),
    "four-bar with more of each": four_bar(
        'velocity = ["B"]\ncentres = ["0-2"]\ninflection = [2]\ncentrodes = [2, 3]\n'
        'curves = ["A", "B"]'
    ),
    "parallelogram with all its centres": four_bar(
        'acceleration = ["B"]\ncentres = "all"\ninflection = [2]', 12, (150, 150, 80)
    ),
    "four-bar at rest with all its centres": four_bar(
        'velocity = ["B"]\nacceleration = ["B"]\ncentres = "all"\ninflection = [2]', 0
    ),
    "trammel with all its centres": TRAMMEL,
    "five-bar with all its centres": FIVE_BAR,
    "block on a lever with its centre": LEVER,
    "gears with their centre": GEARS,
    "roller with its inflection circle": ROLLER,
}
"""Scenes by what is rare in them."""
