"""Scenes that fill a sheet: long tables, flat mechanisms beside narrow plans, long names."""

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.documents.sheet_tools import HEAD
from tests.scene_files import scene_text

STAR = scene_text("documents/star")
"""Three cylinders in a star."""
DYADS = scene_text("documents/dyads")
"""An eight-bar of three dyads."""

FLAT = scene_text("documents/flat")
"""A four-bar fifty times as broad as high."""
TOGGLE = scene_text("documents/toggle")
"""A four-bar within one degree of its dead point."""

NAMED = """
[frame]
O_left = [0, 0]
O_right = [130, 0]
[links.crank]
O_left-{crank} = 50
[links.coupler]
{crank}-{rocker} = 120
[links.rocker]
O_right-{rocker} = 90
[[drivers]]
turn = "crank"
angle = 60
speed = 10
[branches]
{rocker} = "left of {crank}-O_right"
[ask]
velocity = ["{crank}", "{rocker}"]
acceleration = ["{crank}", "{rocker}"]
omega = ["coupler", "rocker"]
epsilon = ["coupler", "rocker"]
"""
"""A four-bar with the names of its moving points left open."""


def drawings_from(text: str, language: str = "en", title: str = "Full") -> list[Drawing]:
    """The material of both sheets of a scene given as text."""
    mechanism = Mechanism(read_text(HEAD.format(title=title) + text, title, None, {}))
    return drawings_of(mechanism, proved(mechanism, mechanism.solve()), words(language))
