"""The drivers as equations: an angle, or a coordinate along a line, less its given value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.loops.rigid_bodies import Body, Complexes, Guide, Numbers, Reals, unit
from graphkin.loops.vector_chains import Turnings
from graphkin.scene.model import Driver, Scene
from graphkin.scene.whole_turns import turned as whole_turned
from graphkin.text.errors import Problem, StructureError


class Drives(Struct, frozen=True, eq=False):
    """The given motions: row d of ``selects`` (D, K + m) picks the driven coordinate.

    A turning driver compares the unit vector e^{i(selected angle)}·``lean`` with ``aim``, a
    sliding one its coordinate with ``aim``; all (N, D). ``whole`` counts full turns, too, from the
    angle ``given`` (radians), ``leaning`` being the angle of ``lean``, not reduced: a wheel's place
    depends on them. Rates are in SI units.
    """

    selects: Reals
    turns: np.ndarray[Any, np.dtype[np.bool_]]
    lean: Complexes
    leaning: Reals
    aim: Complexes
    given: Reals
    whole: bool
    speed: Reals
    acceleration: Reals

    def residual(self, unknowns: Reals) -> Reals:
        """Driven coordinate less given value, angles within half a turn unless whole: (N, D)."""
        coordinate = unknowns @ self.selects.T
        angle = np.angle(np.exp(1j * coordinate) * self.lean * self.aim.conj())
        if self.whole:
            turned = coordinate + self.leaning - self.given - angle
            angle = angle + 2 * np.pi * np.rint(turned / (2 * np.pi))
        return np.where(self.turns, angle, coordinate - self.aim.real)

    def none(self) -> Drives:
        """No driver of them."""
        lean, leaning, aim = self.lean[:, :0], self.leaning[:, :0], self.aim[:, :0]
        given, rates = self.given[:, :0], (self.speed[:, :0], self.acceleration[:, :0])
        left = lean, leaning, aim, given
        return Drives(self.selects[:0], self.turns[:0], *left, self.whole, *rates)


def drives_of(
    scene: Scene,
    bodies: Mapping[str, Body],
    guides: Sequence[Guide],
    turned: Turnings,
    numbers: Numbers,
    *,
    whole: bool,
) -> Drives:
    """The drivers' equations; ``whole`` where full turns count, too."""
    count = len(scene.drivers)
    selects = np.zeros((count, turned.count + len(guides)))
    lean = np.ones((numbers.count, count), dtype=np.complex128)
    aim = np.zeros((numbers.count, count), dtype=np.complex128)
    leaning, given, speed, acceleration = np.zeros((4, numbers.count, count))
    for d, driver in enumerate(scene.drivers):
        if driver.kind == "turn":
            selects[d, turned.of[driver.link]] += 1
            selects[d, turned.of[driver.against]] -= 1
            line = driven_line(driver, bodies)
            leans = turned.lean[driver.link] / turned.lean[driver.against]
            lean[:, d] = line * leans
            turned_by = turned.angle[driver.link] - turned.angle[driver.against]
            leaning[:, d] = np.angle(line) + turned_by
            aim[:, d] = numbers.direction(driver.position)
            given[:, d] = numbers.si(whole_turned(scene, driver))
        else:
            selects[d, turned.count + driven_slide(d, driver, guides)] = 1
            aim[:, d] = numbers.si(driver.position)
        speed[:, d] = numbers.si(driver.speed)
        acceleration[:, d] = numbers.si(driver.acceleration)
    turning = np.array([driver.kind == "turn" for driver in scene.drivers], dtype=np.bool_)
    return Drives(selects[:, 1:], turning, lean, leaning, aim, given, whole, speed, acceleration)


def driven_line(driver: Driver, bodies: Mapping[str, Body]) -> Any:
    """Direction of the line whose angle is driven, in the link's axes."""
    if driver.of is None:
        return 1 + 0j
    start, end = (bodies[driver.link][name] for name in driver.of)
    return unit(end - start)


def driven_slide(number: int, driver: Driver, guides: Sequence[Guide]) -> int:
    """Which slide or track coordinate is driven."""
    for index, guide in enumerate(guides):
        if (guide.block, guide.on, guide.moved_by) == (driver.link, driver.against, driver.kind):
            return index
    raise StructureError(
        Problem(
            f"drivers.{number + 1}",
            f"link {driver.link} does not {driver.kind} on link {driver.against}",
            "a block and the link that carries its guide"
            if driver.kind == "slide"
            else "a wheel and the link that carries its straight track",
        )
    )
