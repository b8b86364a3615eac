"""Every kind of vector has its own line: told apart in black, and by eyes that lack a cone.

The matrices are those of Machado, Oliveira and Fernandes, A physiologically-based model for
simulation of color vision deficiency, IEEE TVCG 15 (2009), severity 1, on linear sRGB. Distances
are those of CIELAB (CIE 1976, D65), in which 2.3 is just noticed; contrast is that of WCAG 2.1.
"""

from itertools import combinations

import numpy as np
import pytest

from graphkin.drawing.style import (
    BLACK,
    BLUE,
    COMPONENTS,
    FORCES,
    GREY,
    PURPLE,
    RED,
    TEAL,
    style_of,
)

SHEETS = {
    "velocity": ("velocity", "relative-velocity", "fixed-centrode", "moving-centrode"),
    "acceleration": (
        "acceleration",
        "relative-velocity",
        "normal",
        "tangential",
        "coriolis",
        "sliding",
    ),
}
"""The lines with a meaning of their own that meet on each sheet."""
APART = 2**0.5 - 0.04
"""Least ratio of two widths that the eye tells apart: the step of ISO 128, which rounds it."""
FAR = 20.0
"""Least distance of two inks."""
LEGIBLE = 4.5
"""Least contrast of lettering on white paper (WCAG 2.1, level AA)."""
INKS = {"blue": BLUE, "teal": TEAL, "red": RED, "purple": PURPLE}
SIGHTS = {
    "all cones": np.eye(3),
    "protanopia": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "deuteranopia": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
}
TO_XYZ = np.array(
    [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ]
)
D65 = np.array([0.95047, 1.0, 1.08883])


def linear(colour):
    """Linear sRGB of a colour #rrggbb."""
    coded = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    return np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    """CIELAB of linear sRGB."""
    part = TO_XYZ @ np.clip(rgb, 0, 1) / D65
    root = np.where(part > 216 / 24389, np.cbrt(part), (24389 / 27 * part + 16) / 116)
    return np.array([116 * root[1] - 16, 500 * (root[0] - root[1]), 200 * (root[1] - root[2])])


def distance(one, other, sight):
    return float(np.linalg.norm(lab(sight @ linear(one)) - lab(sight @ linear(other))))


def contrast(colour):
    return 1.05 / (float((TO_XYZ @ linear(colour))[1]) + 0.05)


def apart(one, other):
    """Whether two lines are told apart without colour: by their dashes or by their widths."""
    if len(one.dash) != len(other.dash):
        return True
    if one.dash:
        drawn = [dash / sum(style.dash) for style in (one, other) for dash in style.dash[:1]]
        if abs(drawn[0] - drawn[1]) > 0.1:
            return True
    return max(one.width, other.width) / min(one.width, other.width) >= APART


@pytest.mark.parametrize("sheet", SHEETS)
def test_lines_are_told_apart_in_black(sheet):
    alike = [
        pair
        for pair in combinations(SHEETS[sheet], 2)
        if not apart(*(style_of(cls, "black") for cls in pair))
    ]
    assert not alike


@pytest.mark.parametrize("sight", SIGHTS)
def test_inks_are_told_apart_by_every_eye(sight):
    near = {
        (one, other): round(distance(INKS[one], INKS[other], SIGHTS[sight]))
        for one, other in combinations(INKS, 2)
        if distance(INKS[one], INKS[other], SIGHTS[sight]) < FAR
    }
    assert not near


def test_inks_can_be_read_on_white():
    for name, colour in {**INKS, "grey": GREY, "black": BLACK}.items():
        assert contrast(colour) >= LEGIBLE, name


@pytest.mark.parametrize(
    "kinds",
    [
        ("velocity", "relative-velocity"),
        ("acceleration", "relative-velocity", *(kind.look for kind in COMPONENTS)),
        FORCES,
    ],
)
def test_in_black_ink_the_vectors_of_a_sheet_differ_by_their_dashes(kinds):
    assert len({style_of(kind, "black").dash for kind in kinds}) == len(kinds)
