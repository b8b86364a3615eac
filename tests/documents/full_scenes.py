"""Scenes that fill a sheet: long tables, flat mechanisms beside narrow plans, long names."""

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.documents.sheet_tools import HEAD

STAR = """
[frame]
O = [0, 0]
[links.1]
O-A = 40
O-B = 40
A-O-B = 120
O-C = 40
A-O-C = 240
[links.2]
A-D = 120
[links.3]
D = [0, 0]
slides = { on = 0, through = "O", angle = 0 }
[links.4]
B-E = 120
[links.5]
E = [0, 0]
slides = { on = 0, through = "O", angle = 120 }
[links.6]
C-F = 120
[links.7]
F = [0, 0]
slides = { on = 0, through = "O", angle = 240 }
[[drivers]]
turn = 1
angle = 35
speed = 30
[branches]
3 = "forward"
5 = "forward"
7 = "forward"
[ask]
velocity = ["D", "E", "F"]
acceleration = ["D", "E", "F"]
omega = [2, 4, 6]
epsilon = [2, 4, 6]
slides = [3, 5, 7]
"""
"""Three cylinders in a star."""
DYADS = """
[frame]
O1 = [0, 0]
O2 = [130, 0]
O4 = [260, 30]
O6 = [390, -20]
[links.1]
O1-A = 45
[links.2]
A-B = 120
A-P = 70
B-P = 80
P = "left of A-B"
[links.3]
O2-B = 90
O2-C = 80
B-C = 50
C = "right of O2-B"
[links.4]
C-D = 110
[links.5]
O4-D = 85
O4-E = 80
D-O4-E = -40
[links.6]
E-F = 115
[links.7]
O6-F = 95
[[drivers]]
turn = 1
angle = 65
speed = 12
[branches]
B = "left of A-O2"
D = "left of C-O4"
F = "left of E-O6"
[ask]
velocity = ["F"]
acceleration = ["F"]
omega = [2, 3, 4, 5, 6, 7]
epsilon = [7]
centres = [2, 4, 6]
poles = [2]
"""
"""An eight-bar of three dyads."""

FLAT = """
[frame]
O1 = [0, 0]
O2 = [600, 0]
[links.1]
O1-A = 12
[links.2]
A-B = 590
[links.3]
O2-B = 14
[[drivers]]
turn = 1
angle = 35
speed = 10.471975512
[branches]
B = "left of A-O2"
[ask]
velocity = ["A", "B"]
acceleration = ["A", "B"]
omega = [2, 3]
epsilon = [2, 3]
centres = [2]
poles = [2]
"""
"""A four-bar fifty times as broad as high."""
TOGGLE = """
[frame]
O1 = [0, 0]
O2 = [120, 0]
[links.1]
O1-A = 60
[links.2]
A-B = 70
[links.3]
O2-B = 80
[[drivers]]
turn = 1
angle = 108.205
speed = 6.283185307
[branches]
B = "left of A-O2"
[ask]
velocity = ["A", "B"]
acceleration = ["A", "B"]
omega = [2, 3]
epsilon = [2, 3]
centres = [2]
poles = [2]
"""
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
