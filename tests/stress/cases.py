"""Small mechanisms with numbers of one's own: how a scene writes them, and what is true of them."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from fractions import Fraction
from math import isfinite
from pathlib import Path
from typing import Any
from unittest.mock import patch

import mpmath
import numpy as np
from click.testing import CliRunner, Result
from msgspec import Struct
from msgspec.structs import replace

from graphkin.cli.main import app
from graphkin.construction.core.solution import Solution
from graphkin.mechanism import Mechanism
from graphkin.motion.curves import plane_paths
from graphkin.numbers.plane import Ratio
from graphkin.scene.read_scene import read_text
from tests.stress.closed import (
    DIGITS,
    Motion,
    Moving,
    bar_on_guide,
    cranked,
    fixed,
    number,
    seen_from,
    turning,
    two_bars,
)

HEAD = """graphkin = 1
title = "hard"
units = { length = "m", angle = "deg", speed = "rad/s" }
"""


class Case(Struct, frozen=True):
    """A mechanism whose every number is the text of an exact decimal.

    ``at`` is the driver's position and the parameter of batches; ``corner`` the place of its frame.
    """

    at: str = "60"
    speed: str = "1"
    push: str = "0"
    corner: tuple[str, str] = ("0", "0")
    ask: str = 'velocity = ["B"]\nacceleration = ["B"]'

    def parts(self) -> str:
        """The scene without head, driver and questions."""
        raise NotImplementedError

    def driver(self) -> str:
        """What drives."""
        return "turn = 1\nangle"

    def truth(self) -> Motion:
        """What is true of it, in many digits; ValueError where it does not close."""
        with mpmath.workdps(DIGITS):
            return self.found(fixed(*map(number, self.corner)))

    def found(self, origin: Moving) -> Motion:
        """The motion in closed form, from the frame's first point."""
        raise NotImplementedError

    def text(self) -> str:
        """The scene as a file."""
        drive = f'[[drivers]]\n{self.driver()} = "at"\nspeed = "{self.speed}"\n'
        drive += f'acceleration = "{self.push}"\n'
        head = HEAD + f'[parameters]\nat = "{self.at}"\n'
        return head + self.parts() + drive + f"[ask]\n{self.ask}\n"

    def mechanism(self) -> Mechanism:
        """The mechanism of the scene."""
        return Mechanism(read_text(self.text(), "hard", None, {}))

    def standing(self, at: float) -> Case:
        """The same at another position of the driver, exactly that of a double."""
        return replace(self, at=str(Fraction(at)))

    def pivot(self, x: str = "0", y: str = "0") -> str:
        """Coordinates counted from the corner, as exact decimals."""
        east, north = (Fraction(a) + Fraction(b) for a, b in zip(self.corner, (x, y), strict=True))
        return f'["{east}", "{north}"]'


class FourBar(Case, frozen=True):
    """Crank O1A, coupler AB, rocker O2B, with O2 to the right of O1."""

    bars: tuple[str, str, str, str] = ("1", "3", "2", "3")
    side: str = "left"

    def parts(self) -> str:
        crank, coupler, rocker, ground = self.bars
        return (
            f"[frame]\nO1 = {self.pivot()}\nO2 = {self.pivot(ground)}\n"
            f'[links.1]\nO1-A = "{crank}"\n[links.2]\nA-B = "{coupler}"\n'
            f'[links.3]\nO2-B = "{rocker}"\n[branches]\nB = "{self.side} of A-O2"\n'
        )

    def found(self, origin: Moving) -> Motion:
        crank, coupler, rocker, ground = map(number, self.bars)
        o2 = Moving(origin.place + ground, mpmath.mpc(0), mpmath.mpc(0))
        a = cranked(origin, crank, number(self.at), number(self.speed), number(self.push))
        b, sine = two_bars(a, o2, coupler, rocker, 1 if self.side == "left" else -1)
        links = {"1": turning(origin, a), "2": turning(a, b), "3": turning(o2, b)}
        return Motion({"A": a, "B": b}, links, float(sine), *span(crank, coupler, rocker, ground))


class SliderCrank(Case, frozen=True):
    """Crank OA, rod AB, and the block B on a line along x at a height above O."""

    bars: tuple[str, str, str] = ("1", "3", "0")
    way: str = "forward"

    def parts(self) -> str:
        crank, rod, height = self.bars
        return (
            f'[frame]\nO = {self.pivot()}\n[links.1]\nO-A = "{crank}"\n[links.2]\nA-B = "{rod}"\n'
            f"[links.3]\nB = [0, 0]\n"
            f"slides = {{ on = 0, through = {self.pivot('0', height)}, angle = 0 }}\n"
            f'[branches]\n3 = "{self.way}"\n'
        )

    def found(self, origin: Moving) -> Motion:
        crank, rod, height = map(number, self.bars)
        a = cranked(origin, crank, number(self.at), number(self.speed), number(self.push))
        way = 1 if self.way == "forward" else -1
        b, sine = bar_on_guide(a, rod, origin.place.imag + height, way)
        links = {"1": turning(origin, a), "2": turning(a, b)}
        return Motion({"A": a, "B": b}, links, float(sine), *span(crank, rod))


class DrivenSlide(Case, frozen=True):
    """The same with the block as driver: O is the other end, A the pin that is sought."""

    at: str = "3"
    bars: tuple[str, str] = ("1", "3")
    side: str = "left"

    def driver(self) -> str:
        return "slide = 3\nposition"

    def parts(self) -> str:
        crank, rod = self.bars
        return (
            f'[frame]\nO = {self.pivot()}\n[links.1]\nO-A = "{crank}"\n[links.2]\nA-B = "{rod}"\n'
            f"[links.3]\nB = [0, 0]\nslides = {{ on = 0, through = {self.pivot()}, angle = 0 }}\n"
            f'[branches]\nA = "{self.side} of O-B"\n'
        )

    def found(self, origin: Moving) -> Motion:
        crank, rod = map(number, self.bars)
        speed, push = number(self.speed), number(self.push)
        b = Moving(origin.place + number(self.at), mpmath.mpc(speed), mpmath.mpc(push))
        a, sine = two_bars(origin, b, crank, rod, 1 if self.side == "left" else -1)
        links = {"1": turning(origin, a), "2": turning(a, b)}
        return Motion({"A": a, "B": b}, links, float(sine), *span(crank, rod))


class Lever(Case, frozen=True):
    """A crank OA whose block A slides on a lever that turns about P, at a distance right of O."""

    bars: tuple[str, str, str] = ("1", "2", "3")
    way: str = "forward"

    def parts(self) -> str:
        crank, ground, lever = self.bars
        return (
            f"[frame]\nO = {self.pivot()}\nP = {self.pivot(ground)}\n"
            f'[links.1]\nO-A = "{crank}"\n[links.2]\nA = [0, 0]\n'
            f'slides = {{ on = 3, along = "P-B" }}\n[links.3]\nP-B = "{lever}"\n'
            f'[branches]\n2 = "{self.way}"\n'
        )

    def found(self, origin: Moving) -> Motion:
        crank, ground, lever = map(number, self.bars)
        p = Moving(origin.place + ground, mpmath.mpc(0), mpmath.mpc(0))
        a = cranked(origin, crank, number(self.at), number(self.speed), number(self.push))
        turn, r, _, _ = seen_from(p, a)
        arm = (a.place - p.place) / r * lever * (1 if self.way == "forward" else -1)
        swing = 1j * turn.epsilon - turn.omega**2
        b = Moving(p.place + arm, 1j * turn.omega * arm, swing * arm)
        links = {"1": turning(origin, a), "3": turn}
        size = max(crank, ground)
        return Motion({"A": a, "B": b}, links, float(min(r / size, 1)), *span(crank, ground, lever))


def span(*lengths: Any) -> tuple[float, float]:
    """The largest and the least of some lengths that are not zero."""
    known = [float(abs(length)) for length in lengths if length]
    return max(known), min(known)


# --- what comes out ------------------------------------------------------------------------------


def assert_within(
    solution: Solution, truth: Motion, row: int | None = None, lost: Collection[str] = ()
) -> None:
    """Every place, velocity, acceleration, ω and ε is finite and within its bound, or lost."""
    bounds = truth.bounds()
    for name, true in truth.points.items():
        point = solution.points[name]
        for what, found, exact, bound in zip(
            ("position", "velocity", "acceleration"),
            (point.position, point.velocity, point.acceleration),
            true,
            bounds,
            strict=True,
        ):
            if f"points.{name}.{what}" not in lost:
                assert_near(f"{what} of {name}", picked(found, row), exact, bound)
    for name, turn in truth.links.items():
        link = solution.links[name]
        for what, found, exact, bound in zip(
            ("omega", "epsilon"), (link.omega, link.epsilon), turn, bounds[1:], strict=True
        ):
            if f"links.{name}.{what}" not in lost:
                assert_near(f"{what} of {name}", picked(found, row), exact, bound / truth.least)


def picked(value: Any, row: int | None) -> Any:
    """One row of an array; what all rows share, or a scalar, as it is."""
    array = np.asarray(value)
    return value if row is None or not array.shape else array[row]


def assert_near(what: str, found: Any, exact: Any, bound: float) -> None:
    """A number is finite and as near to the true one as its bound says."""
    assert isfinite(abs(found)), f"{what} is {found}"
    with mpmath.workdps(DIGITS):
        error = float(abs(mpmath.mpmathify(found) - exact))
    assert error <= bound, f"{what}: {found}, wrong by {error:.1e}, allowed {bound:.1e}"


def held(case: Case) -> Solution:
    """The solution of one scene, every number within its bound and nothing NaN."""
    solution = case.mechanism().solve()
    assert_within(solution, case.truth())
    for ratio in ratios(solution):
        assert all(isfinite(abs(part)) for part in ratio)
    return solution


def ratios(solution: Solution) -> Iterable[Ratio]:
    """Every centre and pole of a solution."""
    for link in solution.links.values():
        for ratio in (link.instant_centre, link.acceleration_pole, link.inflection_pole):
            if ratio is not None:
                yield ratio


def held_batch(case: Case, positions: Iterable[float]) -> None:
    """A batch over positions of the driver: within its bounds, and NaN only where nothing closes
    or, of a quantity, where a solution of that position alone has no sure digit of it.

    Where the loci touch as nearly as doubles tell, either is right, and the margin says that no
    digit is: it lies below the root of eps.
    """

    def unsure(position: float) -> Collection[str]:
        mechanism = case.standing(position).mechanism()
        return mechanism.witness(mechanism.solve()).unsure

    at = np.array(list(positions), dtype=float)
    found = case.mechanism().batch(at=at)
    for row, here in enumerate(at):
        try:
            truth = case.standing(float(here)).truth()
        except (ValueError, ZeroDivisionError):
            truth = None
        velocity = picked(found.points["B"].velocity, row)
        acceleration = picked(found.points["A"].acceleration, row)
        drawn = isfinite(abs(velocity)) and isfinite(abs(acceleration))
        turns = all(isfinite(picked(link.epsilon, row)) for link in found.links.values())
        if drawn and picked(found.margin, row) < BLIND:
            assert truth is None or truth.sine < TOUCHING
            continue
        if truth is not None and (drawn or truth.sine > TOUCHING):
            assert_within(found, truth, row, () if drawn and turns else unsure(here))
        elif drawn:
            assert picked(found.margin, row) <= TOUCHING, f"drawn at {here}, where nothing closes"


BLIND = 2.0**-26
"""The root of eps."""
TOUCHING = 1e-7
"""Sine of a crossing below which doubles do not tell whether two loci cross or touch."""


# --- the command line ----------------------------------------------------------------------------

SHORT = ("check", "solve", "json", "asked")
DRAWN = (*SHORT, "explain", "sheet")
LONG = (*DRAWN, "cycle")


def commanded(
    case: Case, folder: Path, names: Iterable[str] = SHORT, pictures: bool = False
) -> dict[str, Result]:
    """What the commands say of a scene: status 0, 1 or 2, no traceback, no NaN in it.

    The curves of a cycle, which take most of the time, are drawn only where they are asked.
    """
    path = folder / "hard.toml"
    path.write_text(case.text(), encoding="utf-8")
    out = str(folder / "out")
    written = ("-o", out, "--force", "--format", "svg")
    arguments = {
        "check": ("check", str(path)),
        "solve": ("solve", str(path)),
        "json": ("solve", str(path), "--json"),
        "asked": ("solve", str(path), "--asked"),
        "explain": ("explain", str(path)),
        "sheet": ("sheet", str(path), *written),
        "cycle": ("cycle", str(path), "--steps", "36", *written),
    }
    drawn = plane_paths.picture_files if pictures else lambda *_: {}
    with patch.object(plane_paths, "picture_files", drawn):
        said = {name: CliRunner().invoke(app, arguments[name]) for name in names}
    for name, result in said.items():
        assert result.exit_code in (0, 1, 2), name
        assert result.exception is None or isinstance(result.exception, SystemExit), name
        for word in ("Traceback", "a fault in graphkin"):
            assert word not in result.output, (name, result.output)
        words = result.stdout.lower().replace("/", " ").replace(",", " ").split()
        assert not {"nan", "-nan", "inf", "-inf", "nanj"} & set(words), (name, result.stdout)
        assert (result.exit_code == 0) or result.stderr.strip(), f"{name} fails without a word"
    return said


def statuses(said: dict[str, Result]) -> dict[str, int]:
    """The exit status of each command."""
    return {name: result.exit_code for name, result in said.items()}
