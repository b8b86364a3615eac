"""Mechanisms of pins alone as rods between pins: places and motion without any construction."""

from __future__ import annotations

import cmath
import math
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROUNDS = 80
"""Steps of Newton's method from a place made at random."""


@dataclass
class Rods:
    """The rods of a scene with one crank (mm), its pins that stand, and on which side of two others
    a third one stands."""

    fixed: dict[str, complex]
    lengths: dict[tuple[str, str], float]
    sides: list[tuple[str, str, str, int]]
    crank: tuple[str, str]
    speed: float

    @property
    def free(self) -> list[str]:
        """The pins that move, but for the tip of the crank."""
        pins = dict.fromkeys(pin for rod in self.lengths for pin in rod)
        return [pin for pin in pins if pin not in self.fixed]

    def ways(self, places: np.ndarray) -> np.ndarray:
        """From end to end of each rod, for rows of places."""
        free = self.free
        ends = (
            [places[:, free.index(p)] if p in free else np.full(len(places), self.fixed[p])]
            for rod in self.lengths
            for p in rod
        )
        columns = [column for (column,) in ends]
        return np.stack(columns[1::2], axis=1) - np.stack(columns[::2], axis=1)

    def slopes(self, ways: np.ndarray) -> np.ndarray:
        """How half the squares of lengths grow with the places: x and y of each pin in turn."""
        free = self.free
        found = np.zeros((len(ways), len(self.lengths), 2 * len(free)))
        for row, rod in enumerate(self.lengths):
            for pin, sign in zip(rod, (-1, 1), strict=True):
                if pin in free:
                    found[:, row, 2 * free.index(pin)] = sign * ways[:, row].real
                    found[:, row, 2 * free.index(pin) + 1] = sign * ways[:, row].imag
        return found

    def closures(self, starts: int, seed: int, size: float) -> list[dict[str, complex]]:
        """The places of all pins that are found from so many random places, each once."""
        rng = np.random.default_rng(seed)
        shape = starts, len(self.free)
        places = size * (rng.uniform(-1, 1, shape) + 1j * rng.uniform(-1, 1, shape))
        squares = np.array([*self.lengths.values()]) ** 2
        for _ in range(ROUNDS):
            ways = self.ways(places)
            missed = (abs(ways) ** 2 - squares) / 2
            step = np.linalg.solve(self.slopes(ways), -missed[..., None])[..., 0]
            step = step[:, ::2] + 1j * step[:, 1::2]
            places = places + step * np.minimum(1, size / 2 / abs(step).max(axis=1))[:, None]
            places = places[np.isfinite(places).all(axis=1)]
        found: list[dict[str, complex]] = []
        lost = abs(abs(self.ways(places)) ** 2 - squares).max(axis=1) > 1e-7 * size**2
        for row in places[~lost]:
            pins = self.fixed | dict(zip(self.free, row.tolist(), strict=True))
            if all(
                s * ((pins[b] - pins[a]).conjugate() * (pins[c] - pins[a])).imag > 0
                for a, b, c, s in self.sides
            ) and all(max(abs(pins[p] - o[p]) for p in pins) > 1e-6 * size for o in found):
                found.append(pins)
        return found

    def motion(self, pins: dict[str, complex]) -> dict[str, tuple[complex, complex]]:
        """Velocity and acceleration of each pin, the crank turning evenly: no rod grows longer."""
        pivot, tip = self.crank
        radius = pins[tip] - pins[pivot]
        known = {tip: (1j * self.speed * radius, -(self.speed**2) * radius)}
        ways = self.ways(np.array([[pins[p] for p in self.free]]))
        matrix = self.slopes(ways)[0]
        rates = [np.zeros(len(self.lengths)), np.zeros(len(self.lengths))]
        for row, (rod, way) in enumerate(zip(self.lengths, ways[0], strict=True)):
            for pin, sign in zip(rod, (-1, 1), strict=True):
                for k, rate in enumerate(known.get(pin, (0j, 0j))):
                    rates[k][row] -= sign * (way.conjugate() * rate).real
        velocity = np.linalg.solve(matrix, rates[0])
        all_v = dict.fromkeys(self.fixed, 0j) | {tip: known[tip][0]}
        all_v |= dict(zip(self.free, velocity[::2] + 1j * velocity[1::2], strict=True))
        grown = np.array([abs(all_v[b] - all_v[a]) ** 2 for a, b in self.lengths])
        second = np.linalg.solve(matrix, rates[1] - grown)
        moved = zip(self.free, second[::2] + 1j * second[1::2], strict=True)
        return {pin: (all_v[pin], complex(rate)) for pin, rate in moved}


def rods_of(path: Path) -> Rods:
    """The rods of a scene of pins whose first link is a crank."""
    scene = tomllib.loads(path.read_text(encoding="utf-8"))
    fixed = {pin: complex(*place) for pin, place in scene["frame"].items()}
    crank, *links = scene["links"].values()
    (bar, length), *_ = crank.items()
    pivot, tip = bar.split("-")
    (driver,) = scene["drivers"]
    angle = driver["angle"]
    if isinstance(angle, str):
        angle = scene["parameters"][angle]["value"]
    fixed[tip] = fixed[pivot] + cmath.rect(length, math.radians(angle))
    lengths = {(a, b): float(x) for link in links for a, b, x in bars(link)}
    sides = []
    for link in links:
        for pin, said in link.items():
            if isinstance(said, str):
                side, _, ends = said.split()
                sides.append((*ends.split("-"), pin, 1 if side == "left" else -1))
    return Rods(fixed, lengths, sides, (pivot, tip), driver["speed"])


def bars(link: dict[str, object]) -> Sequence[tuple[str, str, float]]:
    """The lengths that a link states, with their ends."""
    return [(*key.split("-"), value) for key, value in link.items() if "-" in key]
