"""Names of points in the text of a scene: found wherever a key says them, and nowhere else."""

from __future__ import annotations

import re
from tomllib import loads

import pytest
import tomlkit

from graphkin.construction.core.quantities import WHOSE
from graphkin.scene.model import Ask
from graphkin.scene.read_scene import read_text
from graphkin.studio.building import Act, built, named_anew, renamed, says
from graphkin.studio.sketch import sketch
from graphkin.text.errors import SceneError
from tests.chosen import FOLDER
from tests.scene_files import scene_text

LINK = """[links.1]
O2-{p} = 20 # a bar
P = "left of O2-{p}"
wheels = [{{ centre = "{p}", radius = 9 }}, {{ centre = "O2", radius = 4 }}]
slides = {{ on = 0, along = "O1-{p}" }}
belt = {{ on = 1, wheels = [2, 1] }}
"""


def test_a_point_is_named_anew_wherever_a_link_says_it():
    text = tomlkit.parse(LINK.format(p="B"))
    renamed(text["links"]["1"], "B", "C")
    assert tomlkit.dumps(text) == LINK.format(p="C")


@pytest.mark.parametrize(
    ("key", "value", "named"),
    [
        ("O2-B", 20, True),
        ("P", "left of O2-B", True),
        ("P", "left of O2-BB", False),
        ("wheel", {"centre": "B", "radius": 9}, True),
        ("rolls", {"on": 0, "through": "B"}, True),
        ("slides", {"on": 0, "along": "O1-B"}, True),
        ("slides", {"on": 0, "through": [0, 1]}, False),
        ("belt", {"on": 1, "wheels": [1, 2]}, False),
    ],
)
def test_what_a_key_of_a_link_names(key, value, named):
    assert says("B", key, value) is named


ASKED = scene_text("studio/everything-asked")
"""A text that has every kind of asking."""


def lists_in(text: str) -> dict[str, list[object]]:
    """The lists of [ask] of a text."""
    return loads(text)["ask"]


def after(text: str, kind: str, *of: str, at: complex = 0j, **more: str) -> str:
    """The text after an act of the hand."""
    places = {name: complex(*at) for name, at in sketch(ASKED, "own", {}).points.items()}
    places |= {"O3": 100 + 300j, "D": 300 + 300j}
    return built(text, Act(kind, of, at, places, **more)).text


def test_every_kind_of_asking_is_tried():
    assert {*lists_in(ASKED)} == {*WHOSE} - {"pairs"} == {*Ask.__struct_fields__} - {"pairs"}
    scene = read_text(ASKED, "own", None, {}).ask
    for key, whose in WHOSE.items():
        assert getattr(scene, key)
        assert whose in ("points", "links", "slides")


@pytest.mark.parametrize(
    ("kind", "of", "made", "words"),
    [
        ("plate", ("3",), "D", "point"),
        ("bar", ("B",), "6", "link"),
        ("bar", ("B",), "D", "point"),
        ("pivot", (), "O3", "point"),
        ("wheel", ("O1",), "6", "link"),
    ],
)
def test_what_is_added_and_deleted_leaves_the_same_text(kind, of, made, words):
    text = after(ASKED, kind, *of, at=150 + 100j)
    assert text != ASKED
    assert after(text, "delete", made, words=words) == ASKED


@pytest.mark.parametrize("words", ["point", "link"])
def test_a_deletion_takes_along_what_is_asked_of_the_deleted_and_nothing_else(words):
    scene = read_text(ASKED, "own", None, {})
    for name in {"point": scene.points, "link": scene.links}[words]:
        text = after(ASKED, "delete", name, words=words)
        tables = loads(text)
        links = {*tables.get("links", {})}
        slide = {link for link in links if "slides" in tables["links"][link]}
        points = {
            point
            for table in (tables.get("frame", {}), *tables.get("links", {}).values())
            for key in table
            if key != "slides"
            for point in key.split("-")
        }
        for key, before in lists_in(ASKED).items():
            left = {"slides": slide}.get(key, links) | points | {"0", "frame", "all"}
            kept = [one for one in before if {*re.findall(r"\w+", str(one))} <= left]
            assert lists_in(text)[key] == kept, (name, key)
        assert not [
            problem for problem in problems_of(text) if problem.startswith(("ask", "names"))
        ]


@pytest.mark.parametrize(
    ("scene", "name", "words"),
    [
        ("crank-slot", "2", "link"),  # the guide of a block
        ("rope-levers", "O", "point"),  # the centre of a wheel
        ("gears-planet", "2", "link"),  # the arm by which turns are counted
        ("centrodes-roller", "W", "point"),  # a roller that is driven
        ("excavator-relative", "boom", "link"),  # against which another is driven
        ("geneva-dwell", "O1", "point"),  # about which a profile is drawn
        ("cam-conjugate", "1", "link"),  # a cam
    ],
)
def test_nothing_that_is_left_names_what_is_deleted(scene, name, words):
    text = after(FOLDER.joinpath(f"{scene}.toml").read_text("utf-8"), "delete", name, words=words)
    left = text.partition("[frame]")[2]
    assert not [problem for problem in problems_of(text) if problem.count(".") > 1], left


def problems_of(text: str) -> list[str]:
    """The places of what is wrong with a text."""
    try:
        read_text(text, "own", None, {})
    except SceneError as error:
        return [problem.place for problem in error.problems]
    return []


def test_a_point_is_asked_under_its_other_name_and_no_link_is():
    for key, whose in WHOSE.items():
        ask = tomlkit.parse(f'{key} = ["B", "B@3", 3, "C"] # kept')
        named_anew(ask, "B", "C")
        points = f'{key} = ["C@3", 3, "C"] # kept'
        assert tomlkit.dumps(ask) == (
            points if whose == "points" else f'{key} = ["B", "B@3", 3, "C"] # kept'
        )
    text = after(ASKED, "pivot", at=100 + 300j)
    text = after(after(text, "bar", "O3", at=300 + 300j), "join", "B", "D")
    assert lists_in(text) == {
        key: ["D" if one == "B" else one for one in asked] for key, asked in lists_in(ASKED).items()
    }
