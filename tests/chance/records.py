"""A mechanism as it stands: bodies with the places of their points, what joins and drives them.

All places and directions are those in the plane (complex numbers, metres), so that everything
closes from the outset. How the scene is to tell it is decided when it is written.
"""

from __future__ import annotations

import math
from cmath import phase
from dataclasses import dataclass, field

FRAME = "0"
ROUND = 1e-9
"""Radians by which rounding may put half a turn on its other side."""


@dataclass
class Slide:
    """A block on a straight guide of a body: a point and the direction of the guide.

    ``through`` is written as a named point, as coordinates, or with ``end`` as two points.
    """

    block: str
    on: str
    through: complex
    along: complex
    offset: float
    named: str | None = None
    end: str | None = None


@dataclass
class Straight:
    """A wheel on a straight track of a body: start of the way, direction, side and start angle."""

    wheel: str
    on: str
    centre: str
    radius: float
    through: complex
    along: complex
    side: int
    start: float | None
    kept: bool = False
    """Whether other bodies keep the wheel at its distance from the track."""
    keeper: str = ""
    """The name that is asked for what keeps the wheel there, where the program must be told."""


@dataclass
class Gear:
    """A wheel on another whose centres an arm keeps apart; rings have a negative radius.

    So has the wheel from which an open belt comes; a crossed one turns as wheels that touch. The
    arm may be one that the program puts in. ``runs`` says between which wheels a belt runs.

    ``start`` holds the angles (degrees) from which each turning is counted, and ``turned`` how far
    (radians) each body has turned since.
    """

    wheel: str
    on: str
    arm: str
    centres: tuple[str, str]
    radii: tuple[float, float]
    belt: str = ""
    start: dict[str, float] = field(default_factory=dict)
    turned: dict[str, float] = field(default_factory=dict)
    idle: bool = False
    """Whether other contacts make the wheels turn so already."""
    runs: tuple[int, int] | None = None


@dataclass
class Touch:
    """Two profiles that touch: own and other body, their centres of curvature and radii.

    ``link`` stands for them, a bar between the centres; ``inside`` where its own lies in a hollow.
    """

    link: str
    own: str
    on: str
    centres: tuple[str, str]
    radii: tuple[float, float]
    inside: bool

    @property
    def apart(self) -> float:
        """How far the centres stand apart."""
        own, other = self.radii
        return other - own if self.inside else own + other


@dataclass
class Lever:
    """A follower that swings about a pin of the carrier; ``side`` +1 where its bar is to the left.

    ``face`` is how much nearer to the cam than the bar its flat face lies.
    """

    pin: str
    tip: str
    side: int
    face: float = 0.0


@dataclass
class CamLaw:
    """A follower that a cam lifts, both on a body ``carrier``: its tip, its sizes, its law.

    ``pieces`` are the angle (degrees) at which each ends, its rise (m, of a lever in degrees) and
    its motion; of a table the lifts there with no motion. The law counts from the cam's angle
    ``start`` (degrees), ``sense`` +1 counter-clockwise. A cam that ``slides`` has lengths instead.
    """

    follower: str
    on: str
    pivot: str
    tip: str
    base: float
    roller: float
    pieces: list[tuple[float, float, str]]
    start: float
    sense: int
    carrier: str = FRAME
    lever: Lever | None = None
    slides: bool = False


@dataclass
class Drive:
    """A given motion: position (radians or metres), speed and acceleration.

    With a ``law`` it is position + swing·sin(rate·(time - moment)), angles in degrees.
    """

    kind: str
    body: str
    against: str
    position: float
    speed: float
    acceleration: float = 0.0
    of: tuple[str, str] | None = None
    law: tuple[float, float] | None = None
    """Swing (degrees or metres) and rate (degrees in the second)."""


@dataclass
class Body:
    """A link: its points and their places, in the order written."""

    name: str
    points: dict[str, complex]
    origin: complex = 0j
    along: complex | None = None
    """Direction of the x axis; None where it runs from the first point to the second."""
    wheels: list[tuple[str, float]] = field(default_factory=list)
    ways: dict[str, str] = field(default_factory=dict)
    """How each point beyond the second is written: triangle, angle or polar."""
    length: float | None = None
    """How far its two points stand apart, of a link that the program puts in itself."""

    @property
    def unwritten(self) -> bool:
        """Whether the program puts it in itself."""
        return self.length is not None

    @property
    def axis(self) -> complex:
        """The direction of its x axis in the plane."""
        if self.along is not None:
            return self.along
        a, b, *_ = self.points.values()
        return (b - a) / abs(b - a)

    @property
    def corner(self) -> complex:
        """The origin of its axes."""
        return next(iter(self.points.values())) if self.along is None else self.origin

    @property
    def angle(self) -> float:
        """The angle of its x axis in radians; half a turn back, but for rounding, is one ahead."""
        angle = phase(self.axis)
        return angle + math.tau if angle < ROUND - math.pi else angle


@dataclass
class Standing:
    """A whole mechanism in one position."""

    bodies: dict[str, Body] = field(default_factory=lambda: {FRAME: Body(FRAME, {}, 0j, 1 + 0j)})
    slides: dict[str, Slide] = field(default_factory=dict)
    straights: list[Straight] = field(default_factory=list)
    gears: list[Gear] = field(default_factory=list)
    cams: list[CamLaw] = field(default_factory=list)
    touches: list[Touch] = field(default_factory=list)
    drives: list[Drive] = field(default_factory=list)
    moment: float = 0.0
    """The time (s) at which laws of time are drawn."""
    led: set[str] = field(default_factory=set)
    """Bodies that contacts turn, which so count whole turns."""
    idle: dict[str, tuple[str, str]] = field(default_factory=dict)
    """Idle bars: what they are pinned to, and the point that they only point to."""

    def place(self, point: str) -> complex:
        """Where a point stands."""
        return next(body.points[point] for body in self.bodies.values() if point in body.points)

    def owners(self) -> dict[str, list[str]]:
        """The bodies that own each point."""
        found: dict[str, list[str]] = {}
        for body in self.bodies.values():
            for point in body.points:
                found.setdefault(point, []).append(body.name)
        return found

    @property
    def size(self) -> float:
        """The largest distance from the first point to another (m)."""
        places = [z for body in self.bodies.values() for z in body.points.values()]
        return max(abs(z - places[0]) for z in places)

    @property
    def least(self) -> float:
        """The shortest bar (m)."""
        lengths = [
            abs(b - a)
            for body in self.bodies.values()
            if body.name != FRAME
            for i, a in enumerate(body.points.values())
            for b in list(body.points.values())[:i]
        ]
        return min((length for length in lengths if length > 0), default=self.size)
