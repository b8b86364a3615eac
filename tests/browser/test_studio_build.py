"""Mechanisms built in the studio's field by the mouse, from nothing, are those that are shipped."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from PIL import Image, ImageDraw

from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.studio.server import Served, serve
from tests.browser.opening import barred
from tests.studio.pump import desk_in, running

LONG = 60_000
"""Milliseconds after which nothing more is waited for."""


@pytest.fixture
def served(tmp_path) -> Iterator[Served]:
    """A studio in an empty folder, in English."""
    session = desk_in(tmp_path)
    session.language = "en"
    with running(serve(session)) as found:
        yield found


class Hand:
    """A mouse in the field, told places in the scene's own unit."""

    def __init__(self, page: Any) -> None:
        self.page = page

    def settled(self, work: Callable[[], object]) -> None:
        """Do something that changes the text, and wait until the field shows it."""
        page, before = self.page, self.text
        work()
        for _ in range(LONG // 20):
            if self.text != before and page.get_attribute("body", "data-settled") == "true":
                return
            page.wait_for_timeout(20)
        pytest.fail(f"nothing is shown; told: {page.inner_text('#told')}")

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

    def driver(self, at: complex, speed: float) -> None:
        """Drive a bar."""
        self.take("driver")
        self.page.fill("#speed", str(speed))
        self.settled(lambda: self.click("driver", at))

    @property
    def text(self) -> str:
        """The text of the scene."""
        return self.page.input_value("#text")


@pytest.fixture
def hand(chromium: Any, served: Served) -> Iterator[Hand]:
    """A hand at an empty field; fails on any error that the page tells."""
    context = chromium.new_context(viewport={"width": 1440, "height": 900})
    page = context.new_page()
    wrong: list[str] = []
    page.on("console", lambda m: wrong.append(m.text) if m.type in ("error", "warning") else 0)
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.goto(f"{served.address}?empty=yes")
    page.wait_for_selector("#canvas svg[viewBox]")
    yield Hand(page)
    context.close()
    assert not wrong


def same(text: str, shipped: str, points: str) -> None:
    """Fail unless the points of a text move as those of a shipped scene."""
    own = Mechanism(read_text(text, "own", None, {})).solve().points
    other = load(shipped).solve().points
    for name in points:
        for quantity in ("position", "velocity", "acceleration"):
            found, meant = getattr(own[name], quantity), getattr(other[name], quantity)
            assert abs(found - meant) < 1e-6 * max(1.0, abs(meant)), (name, quantity)


def test_the_pump_is_built_from_an_empty_field(hand):
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
    assert hand.page.inner_text("#count") == "No mistakes."
    same(hand.text, "pump", "ABCD")


def test_a_slotted_lever_is_built_from_an_empty_field(hand):
    at = {name: 1000 * p.position for name, p in load("slotted-lever").solve().points.items()}
    hand.pivot(0)
    hand.pivot(-300j)
    hand.bar("O1", at["A"])
    hand.bar("O2", at["B"])
    hand.settled(lambda: hand.drag("block", hand.place("A"), at["A"] + 0.5 * (at["B"] - at["A"])))
    hand.bar("B", at["C"])
    hand.settled(lambda: hand.drag("block", hand.place("C"), hand.place("C") + 150))
    hand.driver(0.5 * at["A"], 64)
    assert hand.page.inner_text("#count") == "No mistakes."
    points = Mechanism(read_text(hand.text, "own", None, {})).solve().points
    assert abs(points["B"].position - at["B"] / 1000) < 1e-6
    same(hand.text, "slotted-lever", "ABC")


def test_a_planet_is_built_from_an_empty_field(hand, tmp_path):
    hand.pivot(0)
    hand.settled(lambda: hand.drag("wheel", 0, 60))
    hand.bar("O1", 100j)
    hand.settled(lambda: hand.drag("wheel", hand.place("A"), 60j))
    hand.settled(lambda: hand.drag("plate", hand.place("A") + 40, hand.place("A") + 25))
    hand.driver(30j, 100)
    hand.driver(60 * (-1) ** 0.25, -50)
    assert hand.page.inner_text("#count") == "No mistakes."
    links = Mechanism(read_text(hand.text, "own", None, {})).solve().links
    turned = [links[name].omega / links["2"].omega for name in ("1", "3")]
    assert turned == pytest.approx([-0.5, 1 + 1.5 * 1.5])
    assert hand.page.locator("#canvas circle.wheel").count() == 2
    assert not barred(hand.page)


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


def test_a_four_bar_is_built_changed_and_taken_back(hand):
    four_bar(hand)
    page, whole = hand.page, hand.text
    drawn = Mechanism(read_text(whole, "own", None, {})).solve().points
    assert abs(hand.place("C") / 1000 - drawn["C"].position) < 1e-9
    before = hand.place("B")
    ghost = page.locator("[data-ghost='B']")
    other = complex(float(ghost.get_attribute("cx")), -float(ghost.get_attribute("cy")))
    hand.settled(lambda: hand.click("move", other))
    assert abs(hand.place("B") - other) < 1e-9
    hand.settled(lambda: page.keyboard.press("Control+z"))
    assert hand.text == whole
    hand.settled(lambda: page.click("#redo"))
    assert abs(hand.place("B") - other) < 1e-9
    hand.settled(lambda: page.click("#undo"))
    assert hand.text == whole
    assert abs(hand.place("B") - before) < 1e-9
    hand.settled(lambda: hand.drag("move", hand.place("B"), hand.place("B") + 40))
    assert abs(hand.place("B") - before - 40) < 10
    assert hand.text != whole
    hand.settled(lambda: hand.click("delete", hand.place("C")))
    assert "C" not in hand.text.split("[links.3]")[1]
    for _ in range(40):
        if "[frame]" not in hand.text:
            break
        page.click("#undo")
    assert hand.text.count("[") == 0


def test_a_pin_dragged_onto_another_is_joined_with_it_or_told_why_not(hand):
    hand.pivot(0)
    hand.pivot(220)
    hand.bar("O1", 40 + 70j)
    hand.bar("O2", 250 + 150j)
    hand.bar("A", 150 + 200j)
    hand.driver(0.5 * hand.place("A"), 57)
    assert hand.page.inner_text("#count") != "No mistakes."
    hand.settled(lambda: hand.drag("move", hand.place("C"), hand.place("B")))
    assert hand.page.inner_text("#count") == "No mistakes."
    joined_links = read_text(hand.text, "own", None, {}).links
    assert set(joined_links["3"].points) == {"A", "B"}
    joined = hand.text
    hand.drag("move", hand.place("A"), hand.place("O2"))
    hand.page.wait_for_selector("#told:not([hidden])")
    assert "would share two pins" in hand.page.inner_text("#told")
    assert hand.text == joined
    hand.settled(lambda: hand.page.click("#undo"))
    assert "A-C" in hand.text


def test_a_figure_is_traced_at_its_scale(hand, tmp_path):
    """A crank of 60 mm and a rod of 200 mm are traced over a picture of theirs, on whose crank its
    length is laid; the picture goes into no text and into no file."""
    page, shapes = hand.page, {"O1": (100, 300), "A": (220, 180), "B": (660, 300)}
    figure = Image.new("RGB", (800, 500), "white")
    ImageDraw.Draw(figure).line([*shapes.values()], fill="black", width=4)
    figure.save(tmp_path / "figure.png")
    page.set_input_files("#picture-file", tmp_path / "figure.png")
    page.wait_for_selector("#canvas image")

    def seen(name: str) -> complex:
        lower, upper = (page.locator("#canvas image").get_attribute(key) for key in ("y", "x"))
        one = float(page.locator("#canvas image").get_attribute("width")) / 800
        x, y = shapes[name]
        return complex(float(upper) + x * one, -float(lower) - y * one)

    hand.take("scale")
    page.fill("#span", "60")
    hand.drag("scale", seen("O1"), seen("A"))
    assert abs(seen("A") - seen("O1")) == pytest.approx(60, rel=0.01)
    hand.drag("shift", seen("O1"), 0)
    assert abs(seen("O1")) < 1
    hand.pivot(seen("O1"))
    hand.bar("O1", seen("A"))
    hand.bar("A", seen("B"))
    assert "O1-A = 60" in hand.text
    rod = abs(complex(440, 120)) / abs(complex(120, 120)) * 60
    stated = float(re.search(r"A-B = ([\d.]+)", hand.text)[1])
    assert stated == pytest.approx(rod, abs=5)
    page.click("#no-picture")
    assert page.locator("#canvas image").count() == 0
    assert "image" not in hand.text
    assert not barred(page)


def test_what_is_impossible_is_told_at_the_pointer(hand):
    hand.pivot(0)
    hand.pivot(200)
    text = hand.text
    hand.drag("bar", 0, 200)
    hand.page.wait_for_selector("#told:not([hidden])")
    assert "both pins belong to the frame" in hand.page.inner_text("#told")
    box, (x, y) = hand.page.locator("#told").bounding_box(), hand.pixel(200)
    assert abs(box["y"] - y) < 40
    assert abs(box["x"] - x) < 200
    assert hand.text == text
    assert not barred(hand.page)


def test_comments_and_order_of_an_opened_scene_are_kept(hand, served):
    page = hand.page
    page.goto(f"{served.address}?lab=pump")
    page.wait_for_selector("body[data-settled=true] #velocity .drawing svg", timeout=LONG)
    before = hand.text
    page.click("#build")
    page.wait_for_selector("body[data-settled=true] #canvas [data-point='O2']", timeout=LONG)
    hand.settled(lambda: hand.drag("move", hand.place("O2"), hand.place("O2") + 4j))
    after = hand.text
    pairs = list(zip(before.split("\n"), after.split("\n"), strict=True))
    changed = [pair for pair in pairs if pair[0] != pair[1]]
    assert [old for old, _ in changed] == ["O2 = [0, -30]", "O2-B = 30"]
    assert changed[0][1] == "O2 = [0, -26]"


def test_one_starts_from_a_gallery_with_a_picture_of_each(hand, served, tmp_path):
    page = hand.page
    (tmp_path / "broken.toml").write_text("= =", encoding="utf-8")
    (tmp_path / "own.toml").write_text(hand.text, encoding="utf-8")
    page.goto(f"{served.address}?gallery=yes")
    page.wait_for_selector("#opening[open]")
    for lab in ("pump", "slotted-lever", "offset-slider-crank", "pump-collinear"):
        picture = page.locator(f"#labs [data-name='{lab}'] svg")
        picture.scroll_into_view_if_needed(timeout=LONG)
        links = set(load(lab).scene.links)
        bars = picture.locator("polygon[data-link]")
        assert {bar.get_attribute("data-link") for bar in bars.all()} <= links
        assert bars.count() >= 3 or lab == "offset-slider-crank"
    assert page.locator("[data-name='broken.toml'] svg").count() == 0
    assert not barred(page)
    page.click("#labs [data-name='slotted-lever']")
    page.wait_for_selector("#file[value='slotted-lever.toml']")
    page.goto(f"{served.address}?gallery=yes")
    page.click("#from-nothing")
    page.wait_for_selector("#canvas svg[viewBox]")
    assert "[" not in hand.text
