"""Closures beside the place where two of them merge: their count and their numbers, on both sides.

The independent count: the signs of the misfit, a formula of its own, on a fine grid, and beside
the merge those of its least value in decimals of 60 digits.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from graphkin.accuracy.certified import Certifier
from graphkin.construction.higher_class import closure_solver
from graphkin.diagnosis.closures import choices
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import ClosureError
from tests.chosen import EVERY

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
MP = mpmath.mp.clone()
MP.dps = 60
OFFSETS = ("1e-6", "1e-12", "1e-14", "1e-18")
"""Degrees from the merge, to both sides."""
GRID = 20_000
"""Places of a round at which the misfit's sign is looked at."""


def arcs(p: Any, q: Any, from_p: Any, from_q: Any, sign: int, root: Any) -> Any:
    """The point at two distances from two points, to the left of the way between them (sign 1)."""
    way = q - p
    long = abs(way)
    along = (from_p**2 - from_q**2 + long**2) / (2 * long)
    return p + way / long * (along + sign * 1j * root(from_p**2 - along**2))


def stephenson_3(turned: Any, driven: Any, sign: int, root: Any) -> Any:
    """By how much CD is too long, where O1A and the crank O3D stand so (unit vectors)."""
    a, d = 100 * turned, 330 + 90j + 60 * driven
    b = arcs(a, 190, 166, 140, sign, root)
    return abs(arcs(a, b, 150, 110, 1, root) - d) - 220


def stephenson_2(turned: Any, driven: Any, sign: int, root: Any) -> Any:
    """By how much BD is too long, where O1A and the crank O2E stand so."""
    a, e = 69 * turned, 220 + 94 * driven
    b = arcs(0 * turned, a, 67, 93, -1, root)
    c = arcs(a, e, 119, 128, sign, root)
    return abs(arcs(c, e, 112, 74, -1, root) - b) - 93


@dataclass(frozen=True)
class Merge:
    """Two closures of a scene merge near an angle (degrees) of the driver, its trial angle (rad).

    ``arm`` is the length O1A in metres.
    """

    scene: str
    misfit: Callable[..., Any]
    sign: int
    near: str
    trial: float
    arm: float

    def missed(self, trial: Any, angle: Any) -> Any:
        """The misfit in decimals."""
        driven = MP.expj(MP.radians(angle))
        return self.misfit(MP.expj(trial), driven, self.sign, MP.sqrt)

    def vertex(self, angle: Any) -> tuple[Any, Any, Any]:
        """Where the misfit turns back at an angle, its least value, its second derivative."""
        trial, step = MP.mpf(self.trial), MP.mpf("1e-14")
        for _ in range(12):
            low, here, high = (self.missed(trial + k * step, angle) for k in (-1, 0, 1))
            trial -= (high - low) / (high - 2 * here + low) * step / 2
        return trial, self.missed(trial, angle), (high - 2 * here + low) / step**2

    @cached_property
    def at(self) -> Any:
        """The angle of the driver where they merge, in 50 digits and more."""
        first = MP.mpf(self.near)
        second = first + MP.mpf("1e-9")
        for _ in range(7):
            values = [self.vertex(each)[1] for each in (first, second)]
            if values[0] == values[1]:
                break
            ratio = (second - first) / (values[1] - values[0])
            first, second = second, second - values[1] * ratio
        return second

    def trials(self, angle: Any) -> list[Any]:
        """The trial angle of every closure, in order: beside the merge in decimals."""
        grid = np.linspace(0, 2 * np.pi, GRID + 1)
        driven = np.exp(1j * float(MP.radians(angle)))
        found: list[Any] = []
        for sign in (1, -1):
            with np.errstate(invalid="ignore"):
                values = self.misfit(np.exp(1j * grid), driven, sign, np.sqrt)
            at = np.flatnonzero(values[:-1] * values[1:] < 0)
            crossed = [float(grid[k] + grid[k + 1]) / 2 for k in at]
            far = [x for x in crossed if sign != self.sign or abs(x - self.trial) > 0.01]
            found += far
        vertex, least, bend = self.vertex(angle)
        if least * bend < 0:
            half = MP.sqrt(-2 * least / bend)
            pair = [
                MP.findroot(lambda x: self.missed(x, angle), vertex + k * half) for k in (-1, 1)
            ]
            assert pair[0] < vertex < pair[1]
            found += pair
        return sorted(found)

    @property
    def arm_exact(self) -> Any:
        """The length O1A (m) in decimals."""
        return MP.mpf(str(self.arm))

    def mechanism(self, angle: Any, number: int) -> Mechanism:
        """The scene with another angle of its driver and another closure."""
        return Mechanism(read_text(self.text(angle, number), "made", None, {}))

    def text(self, angle: Any, number: int) -> str:
        """The text of that scene."""
        text = (SCENES / f"{self.scene}.toml").read_text(encoding="utf-8")
        before, after = text.split("[[drivers]]")
        after = re.sub(r"angle = \S+", f'angle = "{MP.nstr(angle, 55)}"', after)
        after = re.sub(r'"closure \d"', f'"closure {number}"', after)
        return f"{before}[[drivers]]{after}"


MERGES = (
    Merge("stephenson-3-crank", stephenson_3, -1, "101.484869075", 1.4241494, 0.1),
    Merge("stephenson-2-binary", stephenson_2, 1, "159.349285606", 0.072589, 0.069),
)


@pytest.mark.parametrize(
    ("merge", "offset"),
    [(MERGES[k // 2], "+-"[k % 2] + OFFSETS[k]) for k in (range(4) if EVERY else (1, 2))],
    ids=lambda part: getattr(part, "scene", part),
)
def test_the_last_closures_have_their_numbers(merge, offset):
    angle = merge.at + MP.mpf(offset)
    trials = merge.trials(angle)
    for number in (len(trials) - 1, len(trials)):
        trace = merge.mechanism(angle, number).trace([("position", "A")])
        expected = merge.arm * np.exp(1j * float(trials[number - 1]))
        assert abs(trace.value("position", "A") - expected) < 1e-3 * merge.arm
    with pytest.raises(ClosureError, match=f"close in {len(trials)} ways"):
        merge.mechanism(angle, len(trials) + 1).trace([("position", "A")])


@pytest.mark.parametrize("merge", MERGES, ids=lambda merge: merge.scene)
@pytest.mark.parametrize("offset", ["+1e-6", "+1e-18"])
def test_balls_hold_each_closure_beside_the_merge(merge, offset):
    angle = merge.at + MP.mpf(offset)
    exact = [
        MP.findroot(lambda x: merge.missed(x, angle), t, tol=1e-80) for t in pair_of(merge, angle)
    ]
    for number, trial in enumerate(exact, 1 + merge.trials(angle).index(pair_of(merge, angle)[0])):
        balls = Certifier.of(merge.mechanism(angle, number), [("position", "A")]).run(192)
        assert not balls.blame
        ball = balls.trace.value("position", "A")
        assert float(ball.real.rad()) < 1e-30
        place = merge.arm_exact * MP.expj(trial)
        assert abs(MP.mpf(ball.real.mid().str(45, radius=False)) - place.real) < MP.mpf("1e-30")
        assert abs(MP.mpf(ball.imag.mid().str(45, radius=False)) - place.imag) < MP.mpf("1e-30")


def pair_of(merge: Merge, angle: Any) -> list[Any]:
    """The trial angles of the two closures that merge."""
    return [each for each in merge.trials(angle) if isinstance(each, MP.mpf)]


@pytest.mark.parametrize("merge", MERGES, ids=lambda merge: merge.scene)
def test_what_balls_do_not_decide_is_refused(merge, monkeypatch):
    monkeypatch.setattr(closure_solver, "BITS", (64,))
    number = len(merge.trials(merge.at - MP.mpf("1e-6")))
    with pytest.raises(ClosureError, match=r"closures \d and \d of links .* merge here"):
        merge.mechanism(merge.at, number).trace([("position", "A")])


@pytest.mark.parametrize("merge", MERGES, ids=lambda merge: merge.scene)
def test_check_lists_as_many_as_there_are(merge):
    for offset in ("-1e-14", "1e-14"):
        angle = merge.at + MP.mpf(offset)
        mechanism = merge.mechanism(angle, 3)
        (choice,) = choices(mechanism.scene, mechanism.groups, mechanism.program)
        places = [merge.arm * np.exp(1j * float(each)) for each in merge.trials(angle)]
        assert [each.place for each in choice.closures] == pytest.approx(places, abs=1e-4)


@pytest.mark.parametrize("merge", MERGES, ids=lambda merge: merge.scene)
def test_a_batch_has_no_number_where_doubles_do_not_tell_which_closure_is_meant(merge):
    text = merge.text(merge.at, len(merge.trials(merge.at + MP.mpf("1e-6"))) - 2)
    text = re.sub(r'angle = "\S+"\nspeed', 'angle = "phi"\nspeed', text)
    mechanism = Mechanism(read_text(f"{text}\n[parameters]\nphi = 1\n", "made", None, {}))
    angle = float(merge.at)
    place = mechanism.batch(phi=np.array([angle - 1, angle, angle + 1e-3])).points["A"].position
    assert np.isfinite(place).tolist() == [True, False, True]
