"""Klein's construction: what its circles give, against closed forms; where it is refused."""

from __future__ import annotations

import cmath
import math
from pathlib import Path
from random import Random

import pytest

from graphkin.construction.core.kind import constructions
from graphkin.construction.normal_component import KleinComponent
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_scene, read_text
from tests.scene_files import scene_text
from tests.textbook.book import within

ENGINE = Path(__file__).parents[2] / "examples" / "scenes" / "klein-engine.toml"


def drawn(mechanism: Mechanism) -> tuple[KleinComponent, dict[int, object]]:
    """The construction of a slider-crank, and the value of each of its steps."""
    trace = mechanism.trace([("acceleration", "B")], by_hand=True)
    (kind,) = constructions(trace.program, KleinComponent)
    return kind, trace.values


@pytest.mark.parametrize("seed", range(40))
def test_the_circles_give_the_normal_component_and_the_whole_acceleration(seed):
    """Against the derivatives of l sin β = e − r sin q, with q from the guide on.

    Cranks from a hundredth of the rod on, speeds over six decades, guides in any direction.
    """
    random = Random(seed)
    rod = 10.0 ** random.uniform(-3, 2)
    crank = rod * 10.0 ** random.uniform(-2, -0.2)
    offset = (rod - crank) * random.uniform(-0.6, 0.6)
    guide, angle = random.uniform(-180, 180), random.uniform(-180, 180)
    speed = 10.0 ** random.uniform(-3, 3) * random.choice([-1, 1])
    numbers = {"crank": crank, "rod": rod, "offset": offset, "guide": guide, "angle": angle}
    scene = scene_text("construction/klein", speed=speed, **numbers)
    kind, values = drawn(Mechanism(read_text(scene, "slider-crank", None, {})))

    q = math.radians(angle - guide)
    lean = math.asin((offset - crank * math.sin(q)) / rod)
    omega = -crank * math.cos(q) / (rod * math.cos(lean))  # of the rod, by that of the crank
    along = -cmath.rect(rod, lean)  # from the piston to the crank pin, in the guide's axes
    turn = cmath.rect(1.0, math.radians(guide))
    normal = omega**2 * along * turn * speed**2
    spin = (crank * math.sin(q) + rod * math.sin(lean) * omega**2) / (rod * math.cos(lean))
    whole = -cmath.rect(crank, q) + along * omega**2 - 1j * along * spin
    assert abs(whole.imag) <= 1e-12 * abs(crank)

    read = values[kind.read]
    assert abs(read - normal) <= 1e-9 * (abs(normal) + 1e-3 * crank * speed**2)
    assert values[kind.vector] == pytest.approx(normal, rel=1e-12, abs=1e-15 * crank * speed**2)
    found = -values[kind.whole] * speed**2
    assert abs(found - whole * turn * speed**2) <= 1e-9 * crank * speed**2


def test_the_corner_is_the_velocity_plan_turned_by_a_right_angle():
    """O and the corner are as far apart as v/ω: 15 m/s, with 120 rad/s."""
    mechanism = Mechanism(read_scene(ENGINE))
    trace = mechanism.trace([("acceleration", "P")], by_hand=True)
    (kind,) = constructions(trace.program, KleinComponent)
    assert trace.values[kind.corner] == pytest.approx(0.125j, abs=1e-15)


def test_khurmi_engine():
    """Chapter 15: drawn by Klein's construction, 15.24 m/s, 2880 m/s², 29.66 rad/s, 1913 rad/s²."""
    found = Mechanism(read_scene(ENGINE)).solve()
    piston, rod = found.points["P"], found.links["2"]
    assert within(abs(piston.velocity), 15.24)
    assert within(abs(piston.acceleration), 2880)
    assert within(-rod.omega, 29.66)
    assert within(rod.epsilon, 1913)

    sine = 0.2 * math.sin(math.radians(30)) / 0.7
    cosine = math.sqrt(1 - sine * sine)
    assert rod.omega == pytest.approx(-120 * 0.2 * math.cos(math.radians(30)) / (0.7 * cosine))
