"""Extremes as published: peak factors of cam laws, Geneva wheels, quick returns of shapers."""

from __future__ import annotations

from math import pi, radians, sin

import pytest

from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import cycle
from graphkin.motion.extremes import Extremes
from graphkin.motion.follower_limits import followers
from graphkin.motion.transmission import all_extremes
from graphkin.scene.read_scene import read_text
from tests.scene_files import scene_text

LIFT, BETA, PACE = 0.025, radians(120), 20.0
"""Lift (m), angle of the rise and of the return, and speed (rad/s) of the cam."""
LAWS = {
    "harmonic": (pi / 2, pi**2 / 2, 15.5),
    "parabolic": (2.0, 4.0, None),
    "cycloidal": (2.0, 6.283, 39.48),
    "3-4-5": (1.875, 5.777, 60.0),
    "4-5-6-7": (2.1875, 7.513, 52.5),
    "modified trapezoid": (2.0, 4.888, 61.4),
    "modified sine": (1.760, 5.528, 69.5),
}
"""Peak factors of velocity, acceleration and jerk of rises between dwells.

R. L. Norton, Design of Machinery, table 8-3, and Cam Design and Manufacturing Handbook, table 2-1.
"""
GENEVA = {3: (6.46, 31.4), 4: (2.41, 5.41), 5: (1.43, 2.30), 6: (1.00, 1.35), 8: (0.620, 0.700)}
"""Largest ω and ε of a Geneva wheel by its slots, for a crank at 1 rad/s.

R. C. Johnson, Mechanical Design Synthesis; H. H. Mabie and C. F. Reinholtz, Mechanisms and Dynamics
of Machinery, chapter on intermittent motion.
"""


def found_in(text: str) -> dict[str, Extremes]:
    """All extremes of a scene by their labels."""
    ((*found,),) = all_extremes(cycle(Mechanism(read_text(text, "published")), steps=24))
    return {each.measure.label: each for each in found}


@pytest.mark.parametrize("motion", LAWS)
def test_peak_factors_of_cam_laws(motion):
    text = scene_text("motion/knife-cam-after-a-dwell", base=60, motion=motion)
    text = text.replace('motion = "cycloidal"', f'motion = "{motion}"')
    jerked = LAWS[motion][2] is not None
    found = found_in(text + ('jerk = ["B"]\n' if jerked else ""))
    for order, factor in enumerate(LAWS[motion], 1):
        if factor is None:
            continue
        label = f"|{'vaj'[order - 1]}_B|"
        expected = factor * LIFT * (PACE / BETA) ** order
        assert found[label].largest.value == pytest.approx(expected, rel=3e-3), label


@pytest.mark.parametrize("slots", GENEVA)
def test_peaks_of_geneva_wheels(slots):
    crank = 120 * sin(pi / slots)
    found = found_in(scene_text("motion/lever-on-a-crank", crank=crank, apart=120))
    omega, epsilon = GENEVA[slots]
    assert -found["ω_3"].least.value == pytest.approx(omega, rel=3e-3)
    assert found["ε_3"].largest.value == pytest.approx(epsilon, rel=3e-3)
    assert [place.at for place in found["ω_3"].least.places] == pytest.approx([0], abs=1e-6)


@pytest.mark.parametrize(("crank", "apart", "ratio"), [(120, 300, 1.71), (120, 240, 2.0)])
def test_quick_returns_of_shapers(crank, apart, ratio):
    """Khurmi and Gupta, Theory of Machines, examples 5.1 and 5.2 (5.1 rounds on the way)."""
    text = scene_text("motion/lever-on-a-crank", crank=crank, apart=apart)
    moved = cycle(Mechanism(read_text(text, "shaper")), steps=24)
    (lever,) = [each for each in followers(moved) if each.name == "3"]
    assert lever.time_ratio == pytest.approx(ratio, abs=0.005)
    if ratio == 2:
        assert lever.extent == pytest.approx(60)
        assert 2 * 450 * sin(radians(lever.extent / 2)) == pytest.approx(450)
