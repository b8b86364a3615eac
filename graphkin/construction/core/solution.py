"""What came out, as plain records: the motion of points, links and slides, and the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, nan

from msgspec import Struct, field

from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Ratio

FAIR = 1e-4
"""Sine of the flattest crossing at which an answer is still fair and a sheet handed out."""
UNKNOWN = complex(nan, nan)
"""What stands for a vector of which no digit is sure; NaN for a number."""


class PointMotion(Struct, frozen=True):
    """Position (m), velocity (m/s) and acceleration (m/s²) of a point; None where not asked."""

    position: Point | None = None
    velocity: Point | None = None
    acceleration: Point | None = None


class LinkMotion(Struct, frozen=True):
    """Angular velocity (rad/s) and acceleration (rad/s²), counter-clockwise positive, and centres.

    A centre is a Ratio, so that it may lie at infinity; None where it was not asked for. The
    inflection circle is the one on the segment from the instantaneous centre to inflection_pole.
    """

    omega: Real | None = None
    epsilon: Real | None = None
    instant_centre: Ratio | None = None
    acceleration_pole: Ratio | None = None
    inflection_pole: Ratio | None = None


class SlideMotion(Struct, frozen=True):
    """Coordinate (m), speed and acceleration of a block along its guide, and Coriolis vector."""

    position: Real | None = None
    speed: Real | None = None
    acceleration: Real | None = None
    coriolis: Point | None = None


class Solution(Struct, frozen=True):
    """The motion of a mechanism in one position, or of a batch of variants as arrays.

    ``margin`` is the smallest sine of crossing among the steps run; ``centres`` are those of two
    links, under names such as 2-4.
    """

    points: Mapping[str, PointMotion]
    links: Mapping[str, LinkMotion]
    slides: Mapping[str, SlideMotion] = field(default_factory=dict)
    margin: Real = 1.0
    centres: Mapping[str, Ratio] = field(default_factory=dict)


class Curve(Struct, frozen=True):
    """A curve on the mechanism over its motion, in metres, in runs without a break.

    ``kind`` is fixed-centrode or moving-centrode, of link ``of``, or trajectory, of point ``of``;
    ``now`` is its point at the scene's own position, where the centrodes touch.
    """

    kind: str
    of: str
    runs: tuple[tuple[complex, ...], ...]
    now: complex | None = None


class Verdict(Struct, frozen=True):
    """How far the independent route lies from the construction.

    ``largest_difference`` is the largest absolute difference over the largest magnitude of that
    quantity in the scene; ``quantity`` names where it was found; ``limit`` bounds the true error of
    every quantity likewise. Where one differs by more than rounding explains, all three are its.
    ``residual`` (m) is the closure error before the first iteration, ``moved`` (m) the way that
    Newton's method then went. ``branches`` lists the branch conditions that do not hold,
    ``guessed`` the links that no position tells, which the witness assembled by itself.
    ``digits`` says how many are sure of every position, velocity and acceleration; ``unsure`` names
    the quantities of which none is, on which the verdict does not bear.
    """

    agrees: bool
    largest_difference: float
    quantity: str
    limit: float
    residual: float
    moved: float
    branches: tuple[str, ...] = ()
    guessed: tuple[str, ...] = ()
    digits: Mapping[str, int] = field(default_factory=dict)
    unsure: tuple[str, ...] = ()

    @property
    def differs(self) -> bool:
        """Whether the numbers are farther apart than the limit, or nothing limits them."""
        return not self.largest_difference <= self.limit < inf

    def not_as_stated(self, branches: Mapping[str, object]) -> str:
        """What does not hold of the branches that a scene states, as it writes them."""
        return ", ".join(f'{name} = "{branches[name]}"' for name in self.branches)
