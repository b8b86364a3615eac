"""A hand that builds in the studio's field, and what it builds: the same in every browser."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pytest

from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from tests.browser.opening import LONG

SHOWS_ANOTHER = f"""let left = {LONG // 20};
const shown = () => document.getElementById("text").value !== before &&
  document.body.dataset.settled === "true";
const look = () => shown() ? done(true) : left-- ? setTimeout(look, 20) : done(false);
look();"""


class Hand:
    """A mouse in the field, told places in the scene's own unit."""

    def __init__(self, page: Any) -> None:
        self.page = page

    def settled(self, work: Callable[[], object]) -> None:
        """Do something that changes the text, and wait until the field shows it."""
        before = self.text
        work()
        if not self.has_shown(before):
            pytest.fail(f"nothing is shown; told: {self.told}")

    def has_shown(self, before: str) -> bool:
        """Wait until another text is there and the field shows it; whether it ever does."""
        return bool(
            self.page.evaluate(f"before => new Promise(done => {{ {SHOWS_ANOTHER} }})", before)
        )

    def pixel(self, at: complex) -> tuple[float, float]:
        """Where a place of the scene is on the screen."""
        svg = self.page.locator("#canvas svg")
        box = svg.bounding_box()
        left, top, width, height = map(float, svg.get_attribute("viewBox").split())
        x = box["x"] + (at.real - left) / width * box["width"]
        y = box["y"] + (-at.imag - top) / height * box["height"]
        return x, y

    def place(self, point: str) -> complex:
        """Where a point is drawn."""
        pin = self.page.locator(f"#canvas [data-point='{point}']")
        return complex(float(pin.get_attribute("cx")), -float(pin.get_attribute("cy")))

    def take(self, tool: str) -> None:
        """Choose a tool."""
        self.page.check(f"#tools input[value='{tool}']")

    def click(self, tool: str, at: complex) -> None:
        """Click a place with a tool."""
        self.take(tool)
        self.page.mouse.click(*self.pixel(at))

    def drag(self, tool: str, start: complex, end: complex) -> None:
        """Drag from a place to another with a tool."""
        self.take(tool)
        self.page.mouse.move(*self.pixel(start))
        self.page.mouse.down()
        self.page.mouse.move(*self.pixel((start + end) / 2))
        self.page.mouse.move(*self.pixel(end))
        self.page.mouse.up()

    def pivot(self, at: complex) -> None:
        """Set a fixed pin."""
        self.settled(lambda: self.click("pivot", at))

    def bar(self, start: str, end: complex | str) -> None:
        """Draw a bar from a pin to another, or to a free place."""
        goal = self.place(end) if isinstance(end, str) else end
        self.settled(lambda: self.drag("bar", self.place(start), goal))

    def write(self, field: str, value: str) -> None:
        """Write into a field."""
        self.page.fill(f"#{field}", value)

    def driver(self, at: complex, speed: float) -> None:
        """Drive a bar."""
        self.take("driver")
        self.write("speed", str(speed))
        self.settled(lambda: self.click("driver", at))

    @property
    def count(self) -> str:
        """How many mistakes are told."""
        return self.page.inner_text("#count")

    @property
    def told(self) -> str:
        """What is told at the pointer."""
        return self.page.inner_text("#tip")

    @property
    def text(self) -> str:
        """The text of the scene."""
        return self.page.input_value("#text")


def same(text: str, shipped: str, points: str) -> None:
    """Fail unless the points of a text move as those of a shipped scene."""
    own = Mechanism(read_text(text, "own", None, {})).solve().points
    other = load(shipped).solve().points
    for name in points:
        for quantity in ("position", "velocity", "acceleration"):
            found, meant = getattr(own[name], quantity), getattr(other[name], quantity)
            assert abs(found - meant) < 1e-6 * max(1.0, abs(meant)), (name, quantity)


def build_pump(hand: Hand) -> None:
    """Build the pump, and hold it against the shipped one."""
    at = {name: 1000 * p.position for name, p in load("pump").solve().points.items()}
    hand.pivot(0)
    hand.pivot(-300j)
    hand.bar("O1", at["A"])
    hand.bar("O2", at["B"])
    hand.bar("A", "B")
    hand.settled(lambda: hand.drag("plate", (at["A"] + at["B"]) / 2, at["C"]))
    hand.bar("C", at["D"])
    hand.settled(lambda: hand.drag("block", hand.place("D"), hand.place("D") + 120))
    hand.driver(0.3 * at["A"], 370)
    assert hand.count == "No mistakes."
    same(hand.text, "pump", "ABCD")


def build_offset_slider_crank(hand: Hand) -> None:
    """Build the offset slider-crank of a textbook, as the page says how, and hold it against the
    shipped one."""
    shipped = str(scene_files.examples()["offset-slider-crank"])
    at = {name: 1000 * p.position for name, p in load(shipped).solve().points.items()}
    hand.settled(lambda: hand.page.mouse.click(*hand.pixel(0)))
    hand.bar("O1", at["A"])
    hand.bar("A", at["B"])
    hand.settled(lambda: hand.drag("block", hand.place("B"), hand.place("B") + 60))
    hand.driver(0.5 * at["A"], 120)
    assert hand.count == "No mistakes."
    same(hand.text, shipped, "AB")


def build_slotted_lever(hand: Hand) -> None:
    """Build the slotted lever, and hold it against the shipped one at that one's angle: where a
    hand points at whole dots, half a degree of the crank is less than a dot."""
    at = {name: 1000 * p.position for name, p in load("slotted-lever").solve().points.items()}
    hand.pivot(0)
    hand.pivot(-300j)
    hand.bar("O1", at["A"])
    hand.bar("O2", at["B"])
    hand.settled(lambda: hand.drag("block", hand.place("A"), at["A"] + 0.5 * (at["B"] - at["A"])))
    hand.bar("B", at["C"])
    hand.settled(lambda: hand.drag("block", hand.place("C"), hand.place("C") + 150))
    hand.driver(0.5 * at["A"], 64)
    assert hand.count == "No mistakes."
    drawn = re.compile(r"^angle = (38|38\.5|39)$", re.MULTILINE)
    assert len(drawn.findall(hand.text)) == 1
    text = drawn.sub("angle = 38.5", hand.text)
    points = Mechanism(read_text(text, "own", None, {})).solve().points
    assert abs(points["B"].position - at["B"] / 1000) < 1e-6
    same(text, "slotted-lever", "ABC")


def four_bar(hand: Hand) -> None:
    """Build the four-bar of a Watt chain with a coupler point."""
    hand.pivot(0)
    hand.pivot(220)
    hand.bar("O1", 40 + 70j)
    hand.bar("O2", 250 + 150j)
    hand.bar("A", "B")
    middle = (hand.place("A") + hand.place("B")) / 2
    hand.settled(lambda: hand.drag("plate", middle, 120 + 200j))
    hand.driver(0.5 * hand.place("A"), 57)
