"""A .pmks file holds the whole mechanism: what is read from it alone moves as the scene does.

It is read by a reader of its own, by the format that PMKS+ states in its source
(src/app/services/transcoding/string-transcoder.ts of github.com/PMKS-Web/PMKSWeb).
"""

from __future__ import annotations

from itertools import combinations
from math import cos, pi, sin
from string import ascii_lowercase, ascii_uppercase, digits

import numpy as np
import pytest

from graphkin.documents.program_files import pmks_file
from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import PageError

BASE = f"{digits}{ascii_uppercase}{ascii_lowercase}_-"
CENTIMETRE = 0.01
PINNED = ["crank-rocker", "six-bar", "watt-1", "watt-2", "stephenson-1", "toggle-press"]


def number(text: str) -> int:
    """A whole number; a zero before it makes it negative."""
    value = 0
    for sign in text.removeprefix("0"):
        value = 64 * value + BASE.index(sign)
    return -value if text.startswith("0") else value


class Read:
    """A file as PMKS+ reads it: joints by their letter, and the joints of each link."""

    def __init__(self, text: str) -> None:
        *_, last = text
        assert last == f"{digits}{ascii_uppercase}{ascii_lowercase}"[(len(text) - 1) % 62]
        flags, scale, numbers, units, rest = text[:-1].split(".", 4)
        assert len(flags) == 2
        assert number(scale) > 0
        self.clockwise = bool(BASE.index(flags[1]) & 1)
        self.speed = number(numbers.split(",")[0])
        self.units = units
        joints, links, _ = rest.split("..", 2)
        self.at, self.names, self.fixed, self.input, self.angle = {}, {}, set(), set(), {}
        for joint in joints.split("."):
            bits, (own, name, *values) = BASE.index(joint[0]), joint[1:].split(",")
            x, y, angle = (number(value) / 1000 for value in values)
            self.at[own], self.names[name] = np.array([x, y]), own
            if bits & 1:
                self.angle[own] = angle
            if bits & 2:
                self.input.add(own)
            if bits & 4:
                self.fixed.add(own)
        self.links = []
        for link in links.split("."):
            held = link.partition(",")[2].split(",")[6:]
            held = held[: held.index("")]
            assert link[:2] in ("YR", "YP")
            assert link[2:].partition(",")[0] == "".join(held)
            self.links.append(held)

    def moved(self, turn: float) -> dict[str, np.ndarray]:
        """Where the joints stand when the crank has turned on, by Newton's method on distances."""
        pivot = next(iter(self.input))
        crank = next(held for held in self.links if pivot in held)
        turned = np.array([[cos(turn), -sin(turn)], [sin(turn), cos(turn)]])
        known = {name: self.at[name] for name in self.fixed - self.angle.keys()}
        known |= {p: self.at[pivot] + turned @ (self.at[p] - self.at[pivot]) for p in crank}
        free = [name for name in self.at if name not in known and name not in self.angle]
        start = dict(self.at)

        def places(x: np.ndarray) -> dict[str, np.ndarray]:
            return known | {name: x[2 * k : 2 * k + 2] for k, name in enumerate(free)}

        def misfit(x: np.ndarray) -> np.ndarray:
            at, found = places(x), []
            for held in self.links:
                guide = next((name for name in held if name in self.angle), None)
                if guide is None:
                    for one, other in combinations(held, 2):
                        length = np.linalg.norm(start[one] - start[other])
                        found.append(np.linalg.norm(at[one] - at[other]) - length)
                else:
                    pin = next(name for name in held if name != guide)
                    dx, dy = at[pin] - start[guide]
                    found.append(dy * cos(self.angle[guide]) - dx * sin(self.angle[guide]))
            return np.array(found)

        x = np.concatenate([start[name] for name in free])
        for _ in range(60):
            slopes = np.array(
                [(misfit(x + d) - misfit(x - d)) / 2e-6 for d in 1e-6 * np.eye(len(x))]
            )
            x = x - np.linalg.lstsq(slopes.T, misfit(x), rcond=None)[0]
        assert np.abs(misfit(x)).max() < 1e-6
        assert np.linalg.matrix_rank(slopes, tol=1e-3) == len(x)
        return places(x)


def of(name: str) -> Mechanism:
    """A lab, or a scene that comes with it."""
    path = scene_files.examples().get(name)
    return Mechanism(read_text(path.read_text("utf-8"), name)) if path else load(name)


@pytest.mark.parametrize("name", ["pump", "offset-slider-crank", *PINNED])
def test_what_is_read_from_the_file_moves_as_the_scene_does(name):
    mechanism = of(name)
    found = Read(pmks_file(mechanism).decode("ascii"))
    motion = mechanism.solve()
    driver = mechanism.scene.drivers[0]
    omega = motion.links[driver.link].omega
    assert found.speed == round(abs(omega) * 30 / pi)
    assert found.clockwise == (omega < 0)
    assert found.units == "101"
    assert len(found.links) == len(mechanism.scene.links)
    for point, own in found.names.items():
        if own not in found.angle:
            at = complex(*found.at[own]) * CENTIMETRE
            assert abs(at - motion.points[point].position) < 1e-5, point
    turn = 1e-3
    moved = found.moved(turn)
    for point, own in found.names.items():
        if own in moved:
            way = complex(*(moved[own] - found.at[own])) * CENTIMETRE
            meant = motion.points[point].velocity * turn / omega
            size = max(abs(p.velocity / omega) for p in motion.points.values() if p.velocity)
            assert abs(way - meant) < 0.02 * size * turn + 2e-6, (point, way, meant)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("cam-tangent", "only along two joints"),
        ("oldham", "more than one point or guide"),
        ("gears-ring", "no wheels"),
        ("cam-roller", "no wheels, cams"),
        ("five-bar", "one crank"),
        ("platform-3rpr", "PMKS\\+"),
    ],
)
def test_what_pmks_does_not_know_is_refused(name, words):
    with pytest.raises(PageError, match=words):
        pmks_file(of(name))
