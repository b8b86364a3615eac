"""The quantities of a motion: owner, notation, printed form and sheet of each.

Every table of quantities is made from these. They define the keys of [ask], the fields of a
solution, and the names and units in reports, forms and measurements.
"""

from __future__ import annotations

from math import degrees
from typing import Any, Literal, NewType

from msgspec import Struct

from graphkin.construction.core.program import Plane, Target
from graphkin.scene.model import Ask, Scene
from graphkin.scene.quantity import Quantity
from graphkin.text import Words

KINDS = ("position", "velocity", "acceleration")
"""The derivatives of a motion."""
SHEETS = KINDS[1:]
"""The derivatives that have a plan, and a sheet that shows it."""
PLANES = dict(zip(KINDS, (Plane.MECHANISM, Plane.VELOCITIES, Plane.ACCELERATIONS), strict=True))


Whose = Literal["points", "links", "slides"]
"""The owner of a quantity: the part of a solution that holds it."""
Sort = Literal["vector", "number", "place"]
"""The sort of a value: a vector of a plan, a number, or a place on the mechanism."""


class MotionQuantity(Struct, frozen=True):
    """One quantity: ``target`` is its name in a program, ``attribute`` its name in a solution.

    ``kind`` is its derivative, or the one by which a centre is found. ``asked_by`` are the keys of
    [ask] that need it. A quantity without ``words`` only serves another one. A place may have a
    ``circle``, reported with it: on the segment from the place ``circle_from`` of the link.
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
    circle: str = ""
    circle_from: str = ""

    @property
    def plane(self) -> Plane:
        """The drawing in which it is measured."""
        return Plane.MECHANISM if self.sort == "place" else PLANES[self.kind]

    @property
    def caret_unit(self) -> str:
        """The unit in column heads and marked-up text: m/s^2."""
        return self.unit.replace("²", "^2")


def of_point(kind: str, sort: Sort, letter: str, unit: str, key: str) -> MotionQuantity:
    """A quantity of points, with the same name everywhere."""
    return MotionQuantity(kind, "points", kind, kind, sort, letter, unit, kind, (key,))


def of_link(
    target: str, attribute: str, kind: str, letter: str, unit: str, words: str, *keys: str
) -> MotionQuantity:
    """A rate of links, or a place (in m) that belongs to a link."""
    sort: Sort = "place" if unit == "m" else "number"
    return MotionQuantity(target, "links", attribute, kind, sort, letter, unit, words, keys)


def of_slide(target: str, attribute: str, kind: str, letter: str, unit: str) -> MotionQuantity:
    """The motion of blocks along their guides."""
    own = ("slides",)
    return MotionQuantity(target, "slides", attribute, kind, "number", letter, unit, attribute, own)


QUANTITIES = (
    of_point("velocity", "vector", "v", "m/s", "velocity"),
    of_point("acceleration", "vector", "a", "m/s²", "acceleration"),
    of_link("omega", "omega", "velocity", "ω", "rad/s", "ω", "omega"),
    of_link("epsilon", "epsilon", "acceleration", "ε", "rad/s²", "ε", "epsilon"),
    of_link(
        *("centre", "instant_centre", "velocity", "I", "m", "instantaneous centre"),
        *("centres", "pairs", "centrodes"),
    ),
    of_point("position", "place", "", "m", "curves"),
    of_link("pole", "acceleration_pole", "acceleration", "J", "m", "acceleration pole", "poles"),
    MotionQuantity(
        *("inflection", "links", "inflection_pole", "acceleration", "place"),
        *("W", "m", "inflection pole", ("inflection",)),
        *("inflection circle", "instant_centre"),
    ),
    of_link("inflection centre", "instant_centre", "velocity", "I", "m", "", "inflection"),
    of_slide("slide", "position", "position", "s", "m"),
    of_slide("slide speed", "speed", "velocity", "v", "m/s"),
    of_slide("slide acceleration", "acceleration", "acceleration", "a", "m/s²"),
    MotionQuantity(
        *("coriolis", "slides", "coriolis", "acceleration", "vector"),
        *("c", "m/s²", "Coriolis", ()),
    ),
)
"""All quantities, in the order of the keys of [ask]."""
BY_TARGET = {each.target: each for each in QUANTITIES}
ASKED = {
    key: tuple(each for each in QUANTITIES if key in each.asked_by)
    for key in dict.fromkeys(key for each in QUANTITIES for key in each.asked_by)
}
"""The quantities that each key of [ask] asks for."""
WHOSE: dict[str, Whose] = {key: found[0].whose for key, found in ASKED.items()}
"""The owners that each key of [ask] lists."""


def those(whose: Whose, *sorts: Sort) -> tuple[MotionQuantity, ...]:
    """The reported quantities of points, links or blocks, in the order of their derivatives.

    ``sorts`` restricts them to some sorts.
    """
    found = [e for e in QUANTITIES if e.whose == whose and (not sorts or e.sort in sorts)]
    return tuple(sorted(filter(lambda q: q.words, found), key=lambda q: KINDS.index(q.kind)))


OF_POINTS = those("points")
VECTORS = those("points", "vector")
RATES = those("links", "number")
CENTRES = those("links", "place")
CIRCLES = {each.target: each for each in CENTRES if each.circle}
OF_SLIDES = those("slides")
MOTION = {each.kind: each for each in OF_POINTS}
TURNING = OMEGA, EPSILON = tuple(each.target for each in RATES)
RATE = {each.kind: each for each in RATES}
SLIDING = {each.kind: each for each in OF_SLIDES if each.sort == "number"}
"""The quantity of points, of links and of blocks that belongs to each sheet."""


def motion_value(motion: Any, quantity: MotionQuantity) -> Any:
    """The value of a quantity in a motion; None where it is not known."""
    return getattr(motion, quantity.attribute)


def names_asked(ask: Ask, quantity: MotionQuantity) -> tuple[str, ...]:
    """The points, links or pairs for which [ask] asks the quantity itself, not a curve."""
    keys = (key for key in quantity.asked_by if key != "centrodes")
    return tuple(name for key in keys for name in getattr(ask, key))


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


def in_mm(words: Words, length: OnPaper) -> str:
    """A drawn length in mm as printed; one too short for a ruler is printed as <0.01."""
    under = f"<\N{NO-BREAK SPACE}{words.fixed(0.01, 2)}"
    return under if ROUNDING < abs(length) < 0.005 else words.fixed(length, 2)


def quantity_text(scene: Scene, words: Words, quantity: Quantity) -> str:
    """A quantity as printed: in its written unit, in the style of the language."""
    unit = unit_words(words, quantity.unit)
    return number_of(scene, words, quantity) + ("" if unit == "°" else " ") + unit


def unit_words(words: Words, unit: str) -> str:
    """A unit of a scene as printed."""
    return words(f"unit.{unit}") if words.has(f"unit.{unit}") else unit


def number_of(scene: Scene, words: Words, quantity: Quantity) -> str:
    """A quantity as printed, without its unit; a long number is rounded."""
    text = quantity.written(scene.values)
    if len(text) > LONGEST:
        text = f"{float(text):.{LONGEST - 3}g}"
    return words.decimal(text)
