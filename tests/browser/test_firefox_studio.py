"""The studio in Firefox: mechanisms built in its field by the mouse alone, moved, and completed."""

from __future__ import annotations

from time import sleep

import pytest

from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.studio.server import Served
from tests.browser.building_hand import LONG, Hand, build_slotted_lever, four_bar
from tests.browser.firefox import Firefox

FIELD = """const svg = document.querySelector("#canvas svg"), box = svg.getBoundingClientRect();
return [box.x, box.y, box.width, box.height, svg.getAttribute("viewBox")];"""
PIN = """const pin = document.querySelector(`#canvas [data-point='${arguments[0]}']`);
return [pin.getAttribute("cx"), pin.getAttribute("cy")];"""
TOOL = """document.querySelector(`#tools input[value='${arguments[0]}']`).click();"""
FRAMES = """const done = arguments[arguments.length - 1];
requestAnimationFrame(() => requestAnimationFrame(() => done(true)));"""
"""What a tool needs shows itself, and the field takes the room that is left."""
WRITE = "document.getElementById(arguments[0]).value = arguments[1];"


class FirefoxHand(Hand):
    """The same hand at a window of Firefox."""

    def __init__(self, window: Firefox) -> None:
        self.window = window

    def pixel(self, at: complex) -> tuple[float, float]:
        x, y, across, down, view = self.window.run(FIELD)
        left, top, width, height = map(float, view.split())
        return x + (at.real - left) / width * across, y + (-at.imag - top) / height * down

    def place(self, point: str) -> complex:
        x, y = self.window.run(PIN, point)
        return complex(float(x), -float(y))

    def take(self, tool: str) -> None:
        self.window.run(TOOL, tool)
        self.window.later(FRAMES)

    def click(self, tool: str, at: complex) -> None:
        self.take(tool)
        self.window.click(self.pixel(at))

    def drag(self, tool: str, start: complex, end: complex) -> None:
        self.take(tool)
        self.window.drag(self.pixel(start), self.pixel(end))

    def write(self, field: str, value: str) -> None:
        self.window.run(WRITE, field, value)

    def wait(self) -> None:
        sleep(0.02)

    @property
    def is_settled(self) -> bool:
        return bool(self.window.run("return document.body.dataset.settled === 'true'"))

    @property
    def count(self) -> str:
        return str(self.window.run("return document.getElementById('count').textContent"))

    @property
    def told(self) -> str:
        return str(self.window.run("return document.getElementById('told').textContent"))

    @property
    def text(self) -> str:
        return str(self.window.run("return document.getElementById('text').value"))


@pytest.fixture
def hand(firefox: Firefox, served: Served) -> Hand:
    """A hand at an empty field."""
    firefox.open_address(f"{served.address}?empty=yes", (1440, 900))
    found = FirefoxHand(firefox)
    for _ in range(LONG // 20):
        if found.is_settled and found.window.run(FIELD)[4]:
            return found
        found.wait()
    pytest.fail("the field does not open")


def test_a_slotted_lever_is_built(hand):
    build_slotted_lever(hand, r"38|38\.5|39")


def test_a_four_bar_with_a_coupler_point_is_built(hand):
    four_bar(hand)
    assert hand.count == "No mistakes."
    drawn = Mechanism(read_text(hand.text, "own", None, {})).solve().points
    assert abs(hand.place("C") / 1000 - drawn["C"].position) < 1e-9
