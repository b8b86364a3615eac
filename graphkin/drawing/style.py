"""The style of each class of mark: line width in mm, colour, dashes and fill, in two inks.

Widths follow line group 0.5 of ISO 128 (thick 0.5, thin 0.25); the mechanism's links are emphasised
with 0.7. The first class of a mark decides. A style without its own colour takes that of the mark's
next class: ``arrowhead velocity`` and ``label velocity`` are drawn in the velocity's blue.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Literal

from msgspec import Struct
from msgspec.structs import replace

Ink = Literal["colour", "black"]

BLACK = "#000000"
GREY = "#6a6a6a"
BODY = "#767676"  # of links; grey in both inks, so that vectors along them are visible
BLUE = "#0b4f9e"
TEAL = "#006d77"
RED = "#b3260e"
PURPLE = "#6600cc"
GREEN = "#1c6b2a"
BROWN = "#8a4500"
LIGHT = "#e9edf2"
PALE = "#f5f6f8"
WHITE = "#ffffff"
TINTS = (LIGHT, PALE)
INKS = {
    BLACK: "ink",
    GREY: "grey",
    BODY: "grey",
    BLUE: "blue",
    TEAL: "teal",
    RED: "red",
    PURPLE: "purple",
    GREEN: "green",
    BROWN: "brown",
    LIGHT: "light",
    PALE: "pale",
    WHITE: "paper",
}
"""The CSS variable for each ink, so that a dark page can set its own colours."""
NEXT = ""  # use the colour of the mark's next class
NOW = "now"
"""The class of what the current sentence of a step page draws."""
BARE = "bare"
"""The class of a figure drawn without its light fill."""
STRONGER = 0.2
"""How much wider the lines of class NOW are, in mm."""
BRIEF = "brief"
"""The class of a short vector, whose shaft is thinner so that its head is visible."""
SHAFT = 0.25
"""The widest shaft of a short vector, in mm."""

DASHED, LONG = (2.4, 0.8), (7.0, 1.0)
CHAIN = (5.0, 0.8, 0.4, 0.8)
SHORT_CHAIN = (3.2, 0.7, 0.7, 0.7)
DOTTED = (0.7, 0.7)
DOUBLE_CHAIN = (3.2, 0.6, 0.6, 0.6, 0.6, 0.6)


class Style(Struct, frozen=True):
    """Line width in mm (0: no line), colour, dashes in mm, fill colour ("ink": the line's)."""

    width: float
    colour: str = BLACK
    dash: tuple[float, ...] = ()
    fill: str = ""
    round: bool = False


class VectorKind(Struct, frozen=True):
    """A kind of acceleration component: class, sign, style, legend, and pattern in words."""

    look: str
    sign: str
    style: Style
    legend: str
    pattern: str


COMPONENTS = (
    VectorKind("normal", "ν", Style(0.4, RED, DASHED), "legend.normal", "positions.normal_lines"),
    VectorKind(
        "tangential",
        "τ",
        Style(0.4, RED, SHORT_CHAIN),
        "legend.tangential",
        "positions.tangential_lines",
    ),
    VectorKind(
        "coriolis", "c", Style(0.4, PURPLE, DOTTED), "legend.coriolis", "positions.coriolis_lines"
    ),
    VectorKind(
        "sliding", "r", Style(0.4, TEAL, DOUBLE_CHAIN), "legend.along", "positions.sliding_lines"
    ),
)
"""The components of accelerations."""
BY_SIGN = {kind.sign: kind for kind in COMPONENTS}
"""The components of accelerations, by sign."""
AUXILIARY = OWN_LINES, CHAIN_LINES = "trial", "trial-line"
"""The classes of lines in auxiliary plans: their own, and chain lines through their points."""
MOTIONS = ("velocity", "relative-velocity", "acceleration", *(kind.look for kind in COMPONENTS))
"""The classes of lines that are vectors of a motion."""
FORCES = ("load", "inertia", "reaction", "reaction-part", "balance")
"""The classes of lines that are forces: given, of inertia, in pairs, their parts, of a driver."""
VECTORS = (*MOTIONS, *FORCES)
"""The classes of lines that are vectors."""
DRAWN = ("construction", "ray", "compass", *AUXILIARY, "centre", "inflection", "ordinate", *MOTIONS)
"""The classes of lines that a construction draws."""
CURVES = ("curve", "curve-dashed", "curve-dotted", "curve-chain")
"""The classes of the lines of curves by stroke; a hue gives their colour."""
HUES = tuple(f"hue-{i}" for i in range(1, 9))
"""The classes that give curves their colours, in order; the last is the ink."""
CENTRODES = {"fixed-centrode": "relative-velocity", "moving-centrode": "coriolis"}
"""The classes whose colours the names of centrodes take."""

STYLES: dict[str, Style] = {
    **{kind.look: kind.style for kind in COMPONENTS},
    # sheet
    "frame": Style(0.7),
    "border": Style(0.35),
    "field": Style(0.35, fill="ink"),
    "title": Style(0.35, fill="ink"),
    "table": Style(0.25, fill="ink"),
    "check-bar": Style(0.25, fill="ink"),
    "caption": Style(0.25, fill="ink"),
    "panel": Style(0.25, GREY),
    "register": Style(0.18, GREY),
    "white": Style(0, WHITE, fill="ink"),
    "qr": Style(0, fill="ink"),
    "shade": Style(0, PALE, fill="ink"),
    # mechanism
    "link": Style(0.7, BODY, round=True),
    "plate": Style(0.5, BODY, fill=LIGHT, round=True),
    "outline": Style(0.5, BODY, round=True),
    "ground": Style(0.25),
    "guide": Style(0.5),
    "slider": Style(0.5, fill=WHITE),
    "block": Style(0.5, fill=WHITE),
    "guide-bar": Style(0.7, BODY, round=True),
    "gear-disc": Style(0.35, fill=PALE, round=True),
    "slot": Style(0.5, fill=WHITE, round=True),
    "weld": Style(0, BODY, fill="ink"),
    "profile": Style(0.5, round=True),
    "hinge": Style(0.25),
    "wheel": Style(0.5),
    "disc": Style(0.5, fill=PALE),
    "spoke": Style(0.35, BODY, round=True),
    "track": Style(0.5),
    "belt": Style(0.35),
    "pitch": Style(0.25, GREY, CHAIN),
    "gear": Style(0.35, round=True),
    "contact": Style(0, fill="ink"),
    "drive": Style(0.25),
    "pin": Style(0.35, fill=WHITE),
    "fixed-pivot": Style(0.5, fill=WHITE, round=True),
    "dimension": Style(0.25, fill="ink"),
    "angle": Style(0.25),
    "sense": Style(0.35, NEXT),
    "locus": Style(0.18, GREY, DASHED),
    "weak-link": Style(0.25, BODY, round=True),
    "dead-link": Style(0.35, BODY, DASHED, round=True),
    "trajectory": Style(0.25, GREY, DOUBLE_CHAIN),
    "centre-line": Style(0.25, GREY, CHAIN),
    # construction
    "construction": Style(0.18, GREY),
    "ray": Style(0.18, GREY, DASHED),
    "compass": Style(0.18, GREY),
    "square-mark": Style(0.18, GREY),
    "parallel-mark": Style(0.25, GREY),
    # plans
    "velocity": Style(0.5, BLUE),
    "relative-velocity": Style(0.35, TEAL),
    "ordinate": Style(0.35, BLUE),  # of a velocity laid off perpendicular to an axis
    "acceleration": Style(0.5, RED),
    "relative-acceleration": Style(0.35, RED),
    # forces
    "force": Style(0.5, GREEN),
    "load": Style(0.5, GREEN),
    "inertia": Style(0.5, GREEN, DASHED),
    "reaction": Style(0.5, BROWN),
    "reaction-part": Style(0.35, BROWN, SHORT_CHAIN),
    "balance": Style(0.5, BROWN, DOTTED),
    # charts
    **{
        name: Style(0.4, NEXT, dash, round=not dash)
        for name, dash in zip(CURVES, ((), DASHED, DOTTED, SHORT_CHAIN), strict=True)
    },
    **{
        name: Style(0, colour)
        for name, colour in zip(
            HUES, (BLUE, RED, GREEN, PURPLE, BROWN, TEAL, GREY, BLACK), strict=True
        )
    },
    "grid": Style(0.25, LIGHT),
    "scale-line": Style(0.18, GREY),
    "dot": Style(0, NEXT, fill="ink"),
    "limit": Style(0.25, RED, DASHED),
    "here": Style(0.25, GREY, DOTTED),
    # drawings given back
    "right": Style(0.5, GREEN, fill="ink"),
    "wrong": Style(0.5, RED, fill="ink"),
    "trial": Style(0.13, GREY),
    "trial-line": Style(0.18, GREY, CHAIN),
    "arrowhead": Style(0, NEXT, fill="ink"),
    "pole": Style(0.35, NEXT, fill=WHITE),
    "point": Style(0.25, NEXT, fill=WHITE),
    "centre": Style(0.35, NEXT),
    "inflection": Style(0.35, NEXT, SHORT_CHAIN),
    "fixed-centrode": Style(0.25, TEAL),
    "moving-centrode": Style(0.35, PURPLE, DASHED),
    # lettering
    "label": Style(0, NEXT, fill="ink"),
    "leader": Style(0.13, NEXT, DOTTED),
    "detail": Style(0.18, GREY),
    "number": Style(0.25, NEXT, fill=WHITE),
}


IN_BLACK = dict.fromkeys(("relative-velocity", "relative-acceleration", "reaction"), LONG)
"""The dashes of vectors that only their colour tells from others, in black ink."""


@lru_cache(maxsize=512)
def style_of(cls: str, ink: Ink = "colour", weight: float = 1.0) -> Style:
    """The style of a mark's classes, with fill and colour resolved. Raises KeyError if unknown.

    ``weight`` is a factor on the widths of lines.
    """
    names = cls.split()
    first = STYLES[names[0]]
    colours = (STYLES[name].colour for name in names if name in STYLES)
    colour = next((found for found in colours if found), BLACK)
    fill = colour if first.fill == "ink" else first.fill
    if BARE in names and fill in TINTS:
        fill = ""
    if BRIEF in names:
        first = replace(first, width=min(first.width, SHAFT))
    if NOW in names:
        colour = BLACK if colour in (GREY, BODY) else colour
        first = replace(first, width=first.width + STRONGER if first.width else 0)
    if ink == "black":
        colour, fill = black(colour), black(fill)
        first = replace(first, dash=IN_BLACK.get(names[0], first.dash))
    if weight != 1:
        first = replace(first, width=round(weight * first.width, 3))
    return replace(first, colour=colour, fill=fill)


def black(colour: str) -> str:
    """The colour in black ink: black; but white, light fills and the grey of links are kept."""
    return colour if colour in ("", WHITE, LIGHT, PALE, BODY) else BLACK


def in_variables(rules: str) -> str:
    """Style rules with each ink's colour replaced by its CSS variable."""
    return re.sub("#[0-9a-f]{6}", lambda found: f"var(--{INKS[found[0]]})", rules)
