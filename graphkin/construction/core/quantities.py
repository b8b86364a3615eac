"""The quantities of a motion: owner, notation, printed form and sheet of each.

Every table of quantities is made from these. They define the keys of [ask], the fields of a
solution, and the names and units in reports, forms and measurements.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import degrees
from typing import Any, Literal, NewType

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.program import Plane, Target
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import Ask, Scene
from graphkin.scene.quantity import Quantity, plain_unit
from graphkin.text import Words

KINDS = ("position", "velocity", "acceleration")
"""The derivatives of a motion."""
SHEETS = KINDS[1:]
"""The derivatives that have a plan, and a sheet that shows it."""
FORCE = "force"
"""The kind of the sheet of forces, which no quantity of a motion belongs to."""
JERK = "jerk"
"""The third derivative, which has no plan."""
ORDERS = (*KINDS, JERK)
"""The derivatives whose certain digits are reported."""
PLURALS = dict(zip(ORDERS, ("positions", "velocities", "accelerations", "jerks"), strict=True))
"""The derivatives of several points in words."""
PLANES = dict(
    zip(
        ORDERS, (Plane.MECHANISM, Plane.VELOCITIES, Plane.ACCELERATIONS, Plane.NUMBERS), strict=True
    )
)
PLANES[FORCE] = Plane.FORCES


Whose = Literal["points", "links", "slides", "pairs"]
"""The owner of a quantity: the part of a solution that holds it."""
Sort = Literal["vector", "number", "place", "centre", "travel"]
"""The sort of a value: a vector of a plan, a number, a place, a centre, or of a whole motion.

A centre is a place on the mechanism that may lie at infinity: a Ratio.
"""
OWNERS: Mapping[Whose, str] = {
    "points": "{of}",
    "links": "link {of}",
    "slides": "block {of}",
    "pairs": "{of}",
}
"""An owner of a quantity in words."""


class Around(Struct, frozen=True):
    """The circle reported with a centre, through the place ``start`` of the same motion.

    ``across`` says that the segment from that place to the centre found is its diameter, not its
    radius. ``missing`` says what holds where there is no such circle.
    """

    words: str
    start: str
    across: bool = False
    missing: str = "at infinity"

    def parts(self, start: Any, found: Any) -> dict[str, Any]:
        """Its centre (m) and radius (m), after the pole at the end of a diameter."""
        if self.across:
            return {"pole": found, "centre": (start + found) / 2, "radius": abs(found - start) / 2}
        return {"centre": found, "radius": abs(found - start)}


class MotionQuantity(Struct, frozen=True):
    """One quantity: ``target`` is its name in a program, ``attribute`` its name in a solution.

    ``kind`` is its derivative, or the one by which a centre is found. ``asked_by`` are the keys of
    [ask] that need it. A quantity without ``words`` only serves another one. ``meaning`` names it
    with its owner, where the words do not. A centre may have a ``circle``, reported with it.
    """

    target: str
    whose: Whose
    attribute: str
    kind: str
    sort: Sort
    letter: str
    unit: str
    words: str
    asked_by: tuple[str, ...]
    meaning: str = ""
    circle: Around | None = None

    @property
    def plane(self) -> Plane:
        """The drawing in which it is measured."""
        return Plane.MECHANISM if self.is_place else PLANES[self.kind]

    @property
    def is_place(self) -> bool:
        """Whether it is a place on the mechanism, at a finite distance or not."""
        return self.sort in ("place", "centre")

    @property
    def name(self) -> str:
        """Its letter in the names of fields, or its target where the letter is not ASCII."""
        return self.letter if self.letter.isascii() else self.target

    @property
    def key(self) -> str:
        """Its key in a record: that of its circle, or the attribute of a solution."""
        return self.target if self.circle else self.attribute

    def of(self, name: str) -> str:
        """The quantity of a point, link or block in words."""
        return (self.meaning or f"{self.words} of {OWNERS[self.whose]}").format(of=name)

    @property
    def caret_unit(self) -> str:
        """The unit in column heads and marked-up text: m/s^2."""
        return self.unit.replace("²", "^2").replace("³", "^3")


def of_point(kind: str, sort: Sort, letter: str, unit: str, key: str) -> MotionQuantity:
    """A quantity of points, with the same name everywhere."""
    return MotionQuantity(kind, "points", kind, kind, sort, letter, unit, kind, (key,))


def rate(target: str, kind: str, letter: str, unit: str, words: str) -> MotionQuantity:
    """A rate of links, with the same name everywhere; ``words`` are for its meaning."""
    meaning = f"{words} of {OWNERS['links']}"
    return MotionQuantity(
        *(target, "links", target, kind, "number", letter, unit, letter, (target,)), meaning
    )


def centre(
    target: str, whose: Whose, attribute: str, kind: str, letter: str, words: str, *keys: str
) -> MotionQuantity:
    """A place (in m) that belongs to a link or a point and may lie at infinity."""
    return MotionQuantity(target, whose, attribute, kind, "centre", letter, "m", words, keys)


def of_slide(target: str, attribute: str, kind: str, letter: str, unit: str) -> MotionQuantity:
    """The motion of blocks along their guides."""
    meaning = f"{attribute} of {OWNERS['slides']} along its guide"
    named = (letter, unit, attribute, ("slides",), meaning)
    return MotionQuantity(target, "slides", attribute, kind, "number", *named)


QUANTITIES = (
    of_point("velocity", "vector", "v", "m/s", "velocity"),
    of_point("acceleration", "vector", "a", "m/s²", "acceleration"),
    of_point(JERK, "vector", "j", "m/s³", JERK),
    rate("omega", "velocity", "ω", "rad/s", "angular velocity"),
    rate("epsilon", "acceleration", "ε", "rad/s²", "angular acceleration"),
    centre(
        *("centre", "links", "instant_centre", "velocity", "I", "instantaneous centre"),
        *("centres", "pairs", "centrodes"),
    ),
    of_point("position", "place", "", "m", "curves"),
    centre(
        *("pole", "links", "acceleration_pole", "acceleration", "J", "acceleration pole"), "poles"
    ),
    replace(
        centre(
            *("inflection", "links", "inflection_pole", "acceleration", "W", "inflection pole"),
            "inflection",
        ),
        circle=Around("inflection circle", "instant_centre", across=True),
    ),
    replace(
        centre(
            *("curvature", "points", "curvature_centre", "acceleration", "Ω"),
            *("centre of curvature", "curvature"),
        ),
        meaning=f"centre of curvature of the path of {OWNERS['points']}",
        circle=Around("osculating circle", "position", missing="none: straight, or at rest"),
    ),
    centre("inflection centre", "links", "instant_centre", "velocity", "I", "", "inflection"),
    of_slide("slide", "position", "position", "s", "m"),
    of_slide("slide speed", "speed", "velocity", "v", "m/s"),
    of_slide("slide acceleration", "acceleration", "acceleration", "a", "m/s²"),
    MotionQuantity(
        *("coriolis", "slides", "coriolis", "acceleration", "vector"),
        *("c", "m/s²", "Coriolis", ()),
    ),
)
"""All quantities, in the order of the keys of [ask]."""


def of_force(target: str, sort: Sort, letter: str, unit: str, key: str) -> MotionQuantity:
    """A quantity of the plan of forces, by its symbol there, such as R_12."""
    named = (letter, unit, target, (key,), f"{target} {{of}}")
    return MotionQuantity(target, "pairs", target, FORCE, sort, *named)


FORCES = PAIR_REACTION, BALANCING_FORCE, BALANCING_MOMENT = (
    of_force("reaction", "vector", "R", "N", "reactions"),
    of_force("balancing force", "vector", "F", "N", "balance"),
    of_force("balancing moment", "number", "M", "N·m", "balance"),
)
"""The quantities of the plan of forces, which only a scene with forces has."""


def of_travel(target: str, whose: Whose, letter: str, unit: str, key: str) -> MotionQuantity:
    """A quantity of the travel of a follower, which takes its whole motion."""
    return MotionQuantity(target, whose, target, "position", "travel", letter, unit, target, (key,))


TRAVEL = STROKE, SWING, TIME_RATIO = (
    of_travel("stroke", "slides", "H", "m", "strokes"),
    of_travel("swing", "links", "ψ", "°", "strokes"),
    of_travel("time ratio", "links", "K", "", "time_ratios"),
)
"""The travel of followers between their dead positions: no plan of one position shows it."""
BY_TARGET = {each.target: each for each in (*QUANTITIES, *FORCES, *TRAVEL)}
ASKED = {
    key: tuple(each for each in (*QUANTITIES, *TRAVEL) if key in each.asked_by)
    for key in dict.fromkeys(key for each in (*QUANTITIES, *TRAVEL) for key in each.asked_by)
}
"""The quantities that each key of [ask] asks for."""
WHOSE: dict[str, Whose] = {
    key: "links" if len({each.whose for each in found}) > 1 else found[0].whose
    for key, found in ASKED.items()
}
"""The owners that each key of [ask] lists."""


def those(*of: Whose | Sort) -> tuple[MotionQuantity, ...]:
    """The reported quantities of some owners and sorts, in the order of their derivatives."""
    found = [e for e in QUANTITIES if e.words and e.whose in of and e.sort in of]
    return tuple(sorted(found, key=lambda q: ORDERS.index(q.kind)))


OF_POINTS = those("points", "place", "vector")
VECTORS = tuple(each for each in those("points", "vector") if each.kind in SHEETS)
RATES = those("links", "number")
CENTRES = those("links", "points", "centre")
CIRCLES = {each.target: each.circle for each in CENTRES if each.circle}
OF_SLIDES = those("slides", "number", "vector")
MOTION = {each.kind: each for each in OF_POINTS}
TURNING = OMEGA, EPSILON = tuple(each.target for each in RATES)
CLOCKWISE = (*TURNING, BALANCING_MOMENT.target)
"""The quantities whose sense is counter-clockwise or clockwise."""
RATE = {each.kind: each for each in RATES}
SLIDING = {each.kind: each for each in OF_SLIDES if each.sort == "number"}
"""The quantity of points, of links and of blocks that belongs to each sheet."""


# --- the values of a motion, by the attributes of these quantities --------------------------------


class PointMotion(Struct, frozen=True):
    """Position (m), velocity, acceleration and jerk of a point in SI; None where not asked.

    ``curvature_centre`` is the centre of curvature of its path, at infinity where that is straight.
    """

    position: Point | None = None
    velocity: Point | None = None
    acceleration: Point | None = None
    jerk: Point | None = None
    curvature_centre: Ratio | None = None


class LinkMotion(Struct, frozen=True):
    """Angular velocity (rad/s) and acceleration (rad/s²), counter-clockwise positive, and centres.

    A centre is a Ratio, so that it may lie at infinity; None where it was not asked for. The
    inflection circle has the segment from the instantaneous centre to inflection_pole as its
    diameter.
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


def motion_value(motion: Any, quantity: MotionQuantity) -> Any:
    """The value of a quantity in a motion; None where it is not known."""
    return getattr(motion, quantity.attribute)


def names_asked(ask: Ask, *quantities: MotionQuantity) -> tuple[str, ...]:
    """The points, links or pairs for which [ask] asks some quantities themselves, not a curve."""
    keys = (key for each in quantities for key in each.asked_by if key != "centrodes")
    return tuple(dict.fromkeys(name for key in keys for name in getattr(ask, key)))


def points_asked(ask: Ask) -> tuple[str, ...]:
    """The points for which [ask] asks anything, curves included."""
    return names_asked(ask, *(each for each in QUANTITIES if each.whose == "points"))


def is_found_on(sheet: str, target: Target) -> bool:
    """Whether a sheet can answer a target."""
    found = BY_TARGET.get(target[0])
    return found is not None and bool(found.words and found.asked_by) and found.kind == sheet


OnPaper = NewType("OnPaper", float)
"""A drawn length, in mm of paper; a length of the mechanism is a float, in metres."""
LONGEST = 9
"""Number of characters of the longest number printed in full among the data."""


def in_degrees(scene: Scene, words: Words, quantity: Quantity) -> str:
    """An angle written in radians, in degrees as on a protractor; empty for any other quantity."""
    if quantity.unit != "rad":
        return ""
    return f"{words.fixed(degrees(float(quantity.si(scene.values))), 2)}°"


ROUNDING = 1e-6
"""A length on paper below this, in mm, is only rounding."""


def in_millimetres(words: Words, length: OnPaper) -> str:
    """A length on paper with its unit, as text."""
    return f"{in_mm(words, length)} {words.spelled('mm')}"


def in_mm(words: Words, length: OnPaper) -> str:
    """A drawn length in mm as printed; one too short for a ruler is printed as <0.01."""
    under = f"<\N{NO-BREAK SPACE}{words.fixed(0.01, 2)}"
    return under if ROUNDING < abs(length) < 0.005 else words.fixed(length, 2)


def request(words: Words, key: str, names: Iterable[str]) -> str:
    """The request for a quantity of one or several owners, whose names are markup."""
    every = tuple(names)
    return words(f"{key}_many" if len(every) > 1 else key, list=words("list_mark").join(every))


def quantity_text(scene: Scene, words: Words, quantity: Quantity) -> str:
    """A quantity as printed: in its written unit, in the style of the language."""
    unit = unit_words(words, quantity.unit)
    return number_of(scene, words, quantity) + ("" if unit in ("", "°") else " ") + unit


def unit_words(words: Words, unit: str) -> str:
    """A unit of a scene as printed."""
    unit = plain_unit(unit)
    return words(f"unit.{unit}") if words.has(f"unit.{unit}") else words.spelled(unit)


def number_of(scene: Scene, words: Words, quantity: Quantity) -> str:
    """A quantity as printed, without its unit; a long number is rounded."""
    text = quantity.written(scene.values)
    if len(text) > LONGEST:
        text = f"{float(text):.{LONGEST - 3}g}"
    return words.decimal(text)
