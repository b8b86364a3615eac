"""Groups that no construction takes are refused, each by its own limit."""

import math
from types import SimpleNamespace

import pytest

from graphkin.construction.core.bases import CLOSING, HELD, no_construction
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Unresolved
from graphkin.text.errors import StructureError
from tests.examples.scenes import mechanism

HEAD = """
graphkin = 1
title = "limit"
units = { length = "mm", angle = "deg", speed = "rad/s" }
"""
LEG = """
[links.{rod}]
{foot} = [0, 0]
[links.{block}]
{head} = [0, 0]
slides = {{ on = {rod}, through = "{foot}", angle = 0 }}
[[drivers]]
slide = {block}
against = {rod}
position = 130
speed = 10
"""
LEGS = ("A1-P1", "A2-P2", "A3-Q1", "A4-Q2", "P3-Q3", "P4-Q4")
CYLINDERS = (
    HEAD
    + "[frame]\nA1 = [0, 0]\nA2 = [300, 0]\nA3 = [150, 260]\nA4 = [400, 200]\n"
    + "".join(
        LEG.format(foot=leg[:2], head=leg[3:], rod=2 * n + 1, block=2 * n + 2)
        for n, leg in enumerate(LEGS)
    )
    + "[links.13]\nP1 = [0, 0]\nP2 = [100, 0]\nP3 = [50, 80]\nP4 = [90, 70]\n"
    + "[links.14]\nQ1 = [0, 0]\nQ2 = [100, 0]\nQ3 = [50, 80]\nQ4 = [90, 70]\n"
)
"""Two plates, each on two cylinders, and two cylinders between them."""
ROLLER = """
[links.{n}]
{p} = [0, 0]
wheel = {{ centre = "{p}", radius = 20 }}
rolls = [{{ on = 0, through = "O", angle = 0 }}, {{ on = 3, through = "A", angle = 0 }}]
"""
PLANK = (
    HEAD
    + "[frame]\nO = [0, 0]\n"
    + ROLLER.format(n=1, p="P")
    + ROLLER.format(n=2, p="Q")
    + "[links.3]\nA = [0, 0]\n[[drivers]]\nroll = 1\nposition = 130\nspeed = 10\n"
)
BICYCLE = (
    HEAD
    + """
[frame]
R = [0, 0]
[links.1]
C = [0, 0]
K = [420, -50]
slides = { on = 0, through = [0, 340], angle = 0 }
[links.2]
C-V = 300
wheels = [{ centre = "C", radius = 340 }, { centre = "C", radius = 40 }]
rolls = { on = 0, through = "R", angle = 0 }
[links.3]
K-P = 170
wheel = { centre = "K", radius = 90 }
belt = { on = 2, wheels = [1, 2] }
"""
)
"""Frame, driving wheel with its sprocket, pedals; what drives it is left open."""
PEDALS = "[[drivers]]\nturn = 3\nangle = -50\nspeed = -6\n"


def test_a_plank_on_rollers_of_one_size_is_told_to_slide():
    """They keep it parallel however they roll: their rolling says nothing of its direction."""
    with pytest.raises(StructureError) as error:
        Mechanism(read_text(PLANK, "limit")).solve()
    found = "hold link 3, a straight track, by wheels and pins alone"
    assert [problem.found for problem in error.value.problems] == [found]
    assert "wheels of one size on one track keep it parallel" in str(error.value)


@pytest.mark.parametrize(
    ("limit", "found", "expected"),
    [
        (
            {
                "driven": (
                    SimpleNamespace(link="3", against="0"),
                    SimpleNamespace(link="5", against="4"),
                )
            },
            "close only with 2 drivers at once: link 3 on 0, link 5 on 4",
            "one driver within a group that is tried",
        ),
        (
            {"tracks": ("3", "5")},
            "hold link 3, 5, a straight track, by wheels and pins alone",
            HELD,
        ),
        (
            {"wedged": ("7", "8")},
            "hold wheels 7, 8 between two tracks that are not parallel",
            "parallel tracks",
        ),
        (
            {"wedged": ("7",)},
            "hold wheel 7 between two tracks that are not parallel",
            "parallel tracks",
        ),
        ({}, "do not close after four of them are tried at once", CLOSING),
    ],
)
def test_links_without_a_construction_are_told_their_limit(limit, found, expected):
    (problem,) = no_construction(Unresolved(("3", "4"), **limit)).problems
    assert (problem.place, problem.found, problem.expected) == ("links.3, 4", found, expected)


BAR = (
    HEAD
    + """
[frame]
O = [0, 0]
C = [200, 40]
G = [400, 200]
[links.1]
O-A = 60
[links.2]
A-B = 300
[links.3]
C-D = 30
wheel = { centre = "C", radius = 30 }
rolls = { on = 2, through = "A", angle = 0, side = "right" }
[links.4]
B-E = 120
[links.5]
G-E = 150
[[drivers]]
turn = 1
angle = 60
speed = 6
[branches]
E = "left of B-G"
"""
)
"""A crank, a bar that a roller leads, and a rod and a rocker that hang on the end of the bar."""


def test_a_track_on_whose_end_a_rod_hangs_asks_for_what_keeps_its_wheel():
    """Two pins seem to hold the bar; with the name that the error proposes the wheel leads it."""
    with pytest.raises(StructureError) as error:
        Mechanism(read_text(BAR, "bar")).solve()
    asked = "if a pin and the wheel of link 3 alone hold link 2, write link = 6 in rolls of link 3"
    assert asked in str(error.value)
    named = BAR.replace('"right"', '"right", link = 6') + '6 = "forward"\n'
    found = Mechanism(read_text(named, "bar"))
    hung = found.solve()
    assert found.witness(hung).agrees
    alone = mechanism("bar-on-roller").solve()
    assert hung.links["2"].omega == pytest.approx(alone.links["2"].omega * 6 / (2 * math.pi))


@pytest.mark.parametrize("against", ["", "\nagainst = 1"])
def test_the_pedals_of_a_bicycle_drive_it_by_way_of_its_wheels(against):
    """The frame goes as far as 40/90 of the pedals' turn rolls the wheel of 340 mm."""
    pedals = PEDALS.replace("turn = 3", f"turn = 3{against}")
    ridden = Mechanism(read_text(BICYCLE + pedals + '[branches]\n1 = "closure 1"\n', "ridden"))
    moved = ridden.solve()
    assert moved.links["2"].omega == pytest.approx(-6 * 90 / 40)
    assert moved.points["C"].velocity == pytest.approx(6 * 90 / 40 * 0.34)
    assert ridden.witness(moved).agrees
    slid = BICYCLE + "[[drivers]]\nslide = 1\nposition = 0\nspeed = 4590\n"
    links = Mechanism(read_text(slid, "slid")).solve().links
    assert links["3"].omega == pytest.approx(-4590 / 340 * 40 / 90) == pytest.approx(-6)


FRONT = """
[links.1]
C = [0, 0]
K = [420, -50]
D = [1000, 0]
[links.4]
D-W = 300
wheel = { centre = "D", radius = 340 }
rolls = { on = 0, through = "R", angle = 0 }
"""


def test_a_bicycle_on_two_wheels_alone_is_driven_by_one_of_them():
    guided = BICYCLE[BICYCLE.index("[links.1]") : BICYCLE.index("[links.2]")]
    free = BICYCLE.replace(guided, FRONT)
    ridden = free + '[[drivers]]\nroll = 2\nposition = 0\nspeed = 4590\n[branches]\n4 = "forward"\n'
    found = Mechanism(read_text(ridden, "limit"))
    moved = found.solve()
    assert moved.links["3"].omega == pytest.approx(-6)
    assert moved.links["4"].omega == moved.links["2"].omega == pytest.approx(-4590 / 340)
    assert found.witness(moved).agrees
