"""Scenes that ask for centres in every way there is a sentence for."""

from __future__ import annotations

from tests.scene_files import scene_text

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
    "trammel with all its centres": scene_text("documents/trammel"),
    "five-bar with all its centres": scene_text("documents/five-bar"),
    "block on a lever with its centre": scene_text("documents/lever"),
    "gears with their centre": scene_text("documents/gears"),
    "roller with its inflection circle": scene_text("documents/roller"),
    "coupler point with its centre of curvature": four_bar('curvature = ["B"]'),
    "slider-crank with centres of curvature": scene_text("documents/curvatures"),
}
"""Scenes by what is rare in them."""
