"""F. P. Beer, E. R. Johnston and others, Vector Mechanics for Engineers: Dynamics, chapter 15."""

from __future__ import annotations

import math

from tests.scene_files import scene_text
from tests.textbook.book import FT, IN, RPM, answers, exactly, rounds_to, within
from tests.textbook.closed_forms import degrees, rod_on_guide, turned


def test_beer_15_7_15_15_engine():
    """Samples 15.3 and 15.7, in later editions 15.7 and 15.15: 3 in, 8 in, 2000 rev/min clockwise.

    Computed in print from rounded values, a_B from ω = 209.4 rad/s: 0.04 % under the exact one.
    """
    found = answers(scene_text("textbook/engine"))
    rod, b, d = found.links["rod"], found.points["B"], found.points["D"]
    way = d.position - b.position
    beta = math.degrees(math.atan2(-way.imag, way.real))
    assert rounds_to(beta, "13.95")
    assert rounds_to(rod.omega, "62.0")
    assert rounds_to(d.velocity.real / FT, "43.6")
    assert within(abs(b.acceleration) / FT, 10962, share=0.0005)

    closed = rod_on_guide(turned(degrees(40, -2000 * RPM), 3 * IN), 8 * IN)
    assert exactly(math.radians(beta), -closed.angle[0])
    assert exactly(rod.omega, closed.angle[1])
    assert exactly(rod.epsilon, closed.angle[2])
    assert exactly(d.velocity, closed.slide[1])
    assert exactly(d.acceleration, closed.slide[2])
    assert rounds_to(beta, "13.94825")
    assert rounds_to(rod.omega, "61.99292")
    assert rounds_to(d.velocity.real / FT, "43.61835")
    assert rounds_to(abs(b.acceleration) / FT, "10966.23")
    assert rounds_to(rod.epsilon, "9940.163")
    assert rounds_to(d.acceleration.real / FT, "-9289.8")
