"""A. A. Yablonsky, collection of course tasks in theoretical mechanics, K3; solved by Kirsanov."""

from __future__ import annotations

import math

from tests.scene_files import scene_text
from tests.textbook.book import CM, answers, exactly, rounds_to


def test_yablonsky_k3_9_trammel():
    """Variant 9: the rod's centre P has PB = AB sin 30° and PA = AB cos 30°."""
    found = answers(scene_text("textbook/trammel-k3-9"))
    omega = found.links["2"].omega
    b, c = found.points["B"], found.points["C"]
    assert rounds_to(abs(omega), "0.5132")
    assert rounds_to(abs(b.velocity) / CM, "11.547")
    assert rounds_to(abs(c.velocity) / CM, "10.1835")

    assert exactly(omega, 8 * math.sqrt(3) / 27)
    assert exactly(b.velocity, -20j * CM * math.tan(math.radians(30)))
    assert exactly(
        b.acceleration, -1j * (20 * CM) ** 2 * 0.45**2 / (0.45 * math.cos(math.pi / 6)) ** 3
    )
    assert exactly(c.velocity, (20 * CM + 2 * b.velocity) / 3)
    assert exactly(c.acceleration, 2 * b.acceleration / 3)
    assert rounds_to(omega, "0.5132002")
