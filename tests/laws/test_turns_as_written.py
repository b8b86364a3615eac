"""Turns count as written: the same mechanism in other words gives the same numbers.

Arms in series carry wheels that roll on one another. Which links drivers turn against which, in
what sense, in what order links are written and which link is the frame: none of it changes how far
any point is from any other, by Willis.
"""

from __future__ import annotations

import cmath
import math
import re
from itertools import combinations
from pathlib import Path
from random import Random

import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.scene_files import scene_text

HEAD = 'graphkin = 1\ntitle = "turns"\nunits = { length = "m", angle = "deg", speed = "rad/s" }\n'
DRIVEN = ("base", "a", "b", "c", "sun")
"""The links whose angles are given, against one another."""
RIMS = ("sun", "P", "S"), ("planet", "Q", "T"), ("last", "R", "U")
"""Wheels with their centres, and a point of each at its rim."""
PINNED = [{"base", "a"}, {"a", "b"}, {"a", "sun"}, {"b", "sun"}, {"b", "c"}]
"""The driven links that are pinned to one another."""
SEEDS = range(24)


class Series:
    """Arms a, b, c from O over P and Q to R; a sun about P, a planet about Q on it, one about R."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.radii = {wheel: rng.uniform(0.3, 2) for wheel in ("sun", "planet", "last")}
        both = {"b": ("sun", "planet"), "c": ("planet", "last")}
        self.lengths = {arm: sum(self.radii[n] for n in wheels) for arm, wheels in both.items()}
        self.lengths["a"] = rng.uniform(2, 4)
        self.start = {n: rng.uniform(-400, 400) for n in ("b", "c", "sun", "planet", "last")}
        self.turned = {n: 360.0 * rng.randint(-3, 3) + rng.uniform(-180, 180) for n in DRIVEN}
        self.turned["base"] = 0.0

    def angles(self) -> dict[str, float]:
        """All angles by Willis, degrees."""
        found = dict(self.turned)
        for wheel, on, arm in (("planet", "sun", "b"), ("last", "planet", "c")):
            since = {n: found[n] - self.start[n] for n in (on, arm)}
            rolled = (since[on] - since[arm]) * self.radii[on] / self.radii[wheel]
            found[wheel] = self.start[wheel] + since[arm] - rolled
        return found

    def places(self) -> dict[str, complex]:
        """All points."""
        angle = {n: cmath.exp(1j * math.radians(each)) for n, each in self.angles().items()}
        found = {"O": 0j, "G": 1.0 * angle["base"]}
        for arm, start, end in (("a", "O", "P"), ("b", "P", "Q"), ("c", "Q", "R")):
            found[end] = found[start] + self.lengths[arm] * angle[arm]
        for wheel, centre, rim in RIMS:
            found[rim] = found[centre] + 0.5 * angle[wheel]
        return found

    def written(self) -> str:
        """The scene, written in one of many ways."""
        rng = self.rng
        frame = rng.choice(["base", "a", "b", "c"])
        own = {
            "base": ["O = [0, 0]", "G = [1, 0]"],
            **{
                arm: [f"{start} = [0, 0]", f"{end} = [{self.lengths[arm]!r}, 0]"]
                for arm, start, end in (("a", "O", "P"), ("b", "P", "Q"), ("c", "Q", "R"))
            },
            **{
                wheel: [
                    f"{centre} = [0, 0]",
                    f"{rim} = [0.5, 0]",
                    f'wheel = {{ centre = "{centre}", radius = {self.radii[wheel]!r} }}',
                ]
                for wheel, centre, rim in RIMS
            },
        }
        for wheel, on, arm in (("planet", "sun", "b"), ("last", "planet", "c")):
            least = self.start.get(frame, 0.0) if frame in (arm, on) else 0.0
            start = {n: self.start[n] - least for n in (wheel, on, arm) if n != frame}
            said = ", ".join(f"{n} = {each!r}" for n, each in start.items())
            own[wheel].append(f"rolls = {{ on = {self.name(on, frame)}, start = {{ {said} }} }}")
        links = [name for name in own if name != frame]
        rng.shuffle(links)
        lines = ["[frame]", *own[frame]]
        for name in links:
            lines += [f"[links.{name}]", *own[name]]
        return HEAD + "\n".join([*lines, *self.drivers(frame), ""])

    def drivers(self, frame: str) -> list[str]:
        """Drivers that say each angle against some other, along a tree, in any order and sense."""
        rng, lines, before = self.rng, list[list[str]](), [frame]
        while len(before) < len(DRIVEN):
            beside = {n for pair in PINNED if pair & {*before} for n in pair} - {*before}
            link = rng.choice(sorted(beside))
            ends = link, rng.choice(before)
            before.append(link)
            first, second = ends if ends[1] == frame or rng.random() < 0.5 else ends[::-1]
            angle = self.turned[first] - self.turned[second]
            against = [] if second == frame else [f'against = "{second}"']
            lines.append([f'turn = "{first}"', *against, f"angle = {angle!r}", "speed = 1"])
        rng.shuffle(lines)
        return [line for each in lines for line in ("[[drivers]]", *each)]

    @staticmethod
    def name(link: str, frame: str) -> str:
        """A link as another names it."""
        return "0" if link == frame else f'"{link}"'


@pytest.mark.parametrize("seed", SEEDS)
def test_a_train_stands_as_willis_says_however_its_drivers_are_written(seed):
    train = Series(Random(seed))
    expected = train.places()
    for _ in range(3):
        mechanism = Mechanism(read_text(train.written(), Path("series.toml")))
        found = mechanism.solve()
        for p, q in combinations(expected, 2):
            apart = abs(found.points[q].position - found.points[p].position)
            assert apart == pytest.approx(abs(expected[q] - expected[p]), abs=1e-10)
        assert mechanism.witness(found).agrees


@pytest.mark.parametrize("name", ["driven-against-a-rocker", "series-on-an-arm"])
def test_a_driver_turned_round_leaves_all_as_it_was(name):
    """Of two links one counts by what stands before, and the driver gives the other."""
    text = scene_text(f"loops/{name}")
    driver = re.search(r"turn = (\d+)\nagainst = (\d+)\nangle = (\S+)\nspeed = (\S+)\n", text)
    assert driver is not None
    link, against, angle, speed = driver.groups()
    turned = f"turn = {against}\nagainst = {link}\nangle = -{angle}\nspeed = -{speed}\n"
    one, other = (
        Mechanism(read_text(each, Path(name))) for each in (text, text.replace(driver[0], turned))
    )
    first, second = one.solve(), other.solve()
    for point, state in first.points.items():
        assert second.points[point].position == pytest.approx(state.position, abs=1e-12)
        assert second.points[point].velocity == pytest.approx(state.velocity, abs=1e-12)
    assert one.witness(first).agrees
    assert other.witness(second).agrees
