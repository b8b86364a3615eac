"""A file of MotionGen stands as it is drawn and moves as its circles cross, found here."""

from __future__ import annotations

import json
from cmath import phase, pi, rect

import pytest

from graphkin.importing.formats import imported
from graphkin.importing.scene_text import scene_text
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import GraphkinError
from tests.importing.test_import import crossing

PLACES = {"a": 0j, "b": 1 + 2j, "c": 5 + 4j, "d": 6 - 1j, "e": 3 + 6j}
BARS = {"crank": "ab", "coupler": "bce", "rocker": "cd"}
UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
STEP = 1e-6


def file(unit: str = "in", angle: str = "rad", **more: object) -> dict[str, object]:
    """A four-bar with a coupler point, as the program saves it, and more keys of its mechanism."""
    joints = [{"id": own, "x": z.real, "y": z.imag, "isWelded": False} for own, z in PLACES.items()]
    links = [
        {"id": own, "jointIds": [*ends], "slotIds": [], "isGround": False, "paths": None}
        for own, ends in BARS.items()
    ]
    links.append({"id": "frame", "jointIds": ["a", "d"], "slotIds": [], "isGround": True})
    motor = {"id": "m", "type": "rotary", "at": "a", "from": "d", "to": "b", "min": 0, "max": 360}
    mechanism = {"mode": "standard", "joints": joints, "links": links, "slots": [], "cylinders": []}
    mechanism |= {"actuators": [motor | {"velocity": 10}], "measurements": []} | more
    settings = {"linearUnit": unit, "angularUnit": angle}
    return {"name": "motiongen", "version": "1.1.5", "mechanism": mechanism, "settings": settings}


def opened(data: dict[str, object]) -> Mechanism:
    return Mechanism(read_text(scene_text(imported(json.dumps(data))).text, "file"))


@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.parametrize(("angle", "omega"), [("rad", 10.0), ("deg", 10 * pi / 180)])
def test_the_coupler_point_moves_as_the_circles_cross(unit, angle, omega):
    solved = opened(file(unit, angle)).solve()
    a, b, c, d, e = PLACES.values()

    def point(time: float) -> complex:
        pin = a + (b - a) * rect(1, omega * time)
        joint = crossing(pin, abs(c - b), d, abs(c - d), c)
        return pin + (e - b) * rect(1, phase((joint - pin) / (c - b)))

    rate = (point(STEP) - point(-STEP)) / (2 * STEP) * UNITS[unit]
    assert complex(solved.points["E"].position) == pytest.approx(e * UNITS[unit], rel=1e-6)
    assert complex(solved.points["E"].velocity) == pytest.approx(rate, rel=1e-6)


def test_links_at_a_welded_joint_are_one():
    data = file()
    mechanism = data["mechanism"]
    mechanism["joints"].append({"id": "f", "x": 4.0, "y": 8.0})
    mechanism["links"].append({"id": "tail", "jointIds": ["e", "f"], "isGround": False})
    mechanism["joints"][4]["isWelded"] = True
    points = opened(data).scene.link("2").points
    assert {"B", "C", "E", "F"} == {*points}


@pytest.mark.parametrize(
    ("more", "part"),
    [
        ({"slots": [{}]}, "slots"),
        ({"cylinders": [{}]}, "cylinders"),
        ({"actuators": [{"type": "linear", "at": "a"}]}, "linear actuators"),
    ],
)
def test_parts_of_another_form_are_refused_by_name(more, part):
    with pytest.raises(GraphkinError, match=f"the file has {part}"):
        opened(file(**more))


def test_a_file_that_breaks_off_is_refused_in_words():
    text = json.dumps(file())
    for length in range(0, len(text), 40):
        with pytest.raises(GraphkinError):
            imported(text[:length])


def test_joints_that_no_link_names_or_that_are_missing_are_no_fault():
    data = file()
    data["mechanism"]["joints"].append({"id": "z", "x": 90.0, "y": 0.0})
    assert "Z" not in opened(data).solve().points
    data["mechanism"]["links"][0]["jointIds"] = ["a", "nowhere"]
    with pytest.raises(GraphkinError):
        opened(data)
