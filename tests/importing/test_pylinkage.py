"""A mechanism that pylinkage writes moves here as pylinkage moves it."""

from __future__ import annotations

import json
from math import cos, pi, sin, sqrt

import pytest

from graphkin.importing.formats import imported
from graphkin.importing.scene_text import scene_text
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import GraphkinError

STEP = 1e-5
MM = 0.001


@pytest.fixture(scope="module")
def pylinkage():
    """Loaded by the worker that runs these tests alone: it takes as long as all of graphkin."""
    return pytest.importorskip("pylinkage.mechanism")


def saved(pylinkage, mechanism) -> str:
    return json.dumps(pylinkage.mechanism_to_dict(mechanism))


def opened(text: str):
    return Mechanism(read_text(scene_text(imported(text)).text, "imported")).solve()


MADE = {
    "four-bar": lambda pylinkage: pylinkage.fourbar(
        crank=20, coupler=60, rocker=50, ground=70, omega=STEP, initial_angle=0.7
    ),
    "other-branch": lambda pylinkage: pylinkage.fourbar(
        crank=20, coupler=60, rocker=50, ground=70, omega=STEP, initial_angle=0.7, branch=0
    ),
    "slider-crank": lambda pylinkage: pylinkage.slider_crank(
        crank=20,
        rod=60,
        omega=STEP,
        initial_angle=0.7,
        slide_through=(0, 5),
        slide_direction=(cos(0.2), sin(0.2)),
    ),
}


@pytest.mark.parametrize("name", MADE)
def test_every_joint_moves_as_pylinkage_steps_it(pylinkage, name):
    mechanism = MADE[name](pylinkage)
    found = opened(saved(pylinkage, mechanism))
    start = {joint.id: complex(*joint.position) for joint in mechanism.joints}
    names = [joint.id for joint in mechanism.joints]
    steps = [dict(zip(names, places, strict=True)) for places in mechanism.step(iterations=2)]
    at = [start, *({own: complex(*place) for own, place in step.items()} for step in steps)]
    ids = {own: "".join(sign if sign.isalnum() else "_" for sign in own) for own in names}
    moving = [own for own in names if abs(at[1][own] - start[own]) > 1e-9]
    assert len(moving) >= 2
    for own in names:
        point = found.points[ids[own]]
        assert abs(complex(point.position) / MM - start[own]) < 1e-4
        rate = (-3 * at[0][own] + 4 * at[1][own] - at[2][own]) / (2 * STEP)
        velocity = complex(point.velocity) / MM / STEP if point.velocity else 0j
        assert abs(velocity - rate) < 1e-3, own


def changed(text: str, part: str, number: int, **changes: object) -> str:
    data = json.loads(text)
    data[part][number] |= changes
    return json.dumps(data)


def test_a_tracker_is_a_point_of_its_link(pylinkage):
    """A point over the middle of the coupler, at half its length, is at 45° from its first end."""
    data = json.loads(saved(pylinkage, MADE["four-bar"](pylinkage)))
    coupler = next(link for link in data["links"] if link["id"] == "coupler")
    one, other = coupler["joints"]
    tracker = {"id": "T", "type": "tracker", "position": [0, 0], "ref_joint1_id": one}
    tracker |= {"ref_joint2_id": other, "distance": 30 * sqrt(2), "angle": pi / 4}
    data["joints"].append(tracker)
    points = opened(json.dumps(data)).points
    at = {joint["id"]: complex(*joint["position"]) for joint in data["joints"]}
    way = (at[other] - at[one]) / 60
    assert complex(points["T"].position) / MM == pytest.approx(at[one] + way * (30 + 30j))


def test_what_cannot_be_imported_is_refused_by_its_name(pylinkage):
    text = saved(pylinkage, MADE["four-bar"](pylinkage))
    for number, changes, words in (
        (0, {"type": "Crank"}, "kind Crank"),
        (1, {"position": [None, None]}, "no position"),
        (1, {"position": ["x", 0]}, "damaged"),
    ):
        with pytest.raises(GraphkinError, match=words):
            imported(changed(text, "joints", number, **changes))
    for length in range(1, len(text), 40):
        with pytest.raises(GraphkinError):
            imported(text[:length])
    with pytest.raises(GraphkinError):
        imported("{" * 100000)
