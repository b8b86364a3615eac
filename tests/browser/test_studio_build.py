"""Mechanisms built in the studio's field by the mouse, from nothing, are those that are shipped."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from PIL import Image, ImageDraw

from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.studio.server import Served
from tests.browser.building_hand import (
    Hand,
    build_offset_slider_crank,
    build_pump,
    four_bar,
)
from tests.browser.opening import PAINTED, barred, watched


@pytest.fixture
def hand(chromium: Any, tabs: Any, served: Served) -> Iterator[Hand]:
    """A hand at an empty field; fails on any error that the page tells."""
    own = (f"http://127.0.0.1:{served.port}/", "blob:", "data:")
    with watched(chromium, tabs, own, ("error", "warning")) as new_page:
        page = new_page(f"{served.address}?empty=yes", viewport={"width": 1440, "height": 900})
        page.wait_for_selector("#canvas svg[viewBox]")
        yield Hand(page)


def test_the_pump_is_built_from_an_empty_field(hand):
    build_pump(hand)


def test_a_newcomer_builds_the_offset_slider_crank(hand):
    """An empty field says how to begin, and its first click sets a fixed pin."""
    assert hand.page.inner_text("#how").startswith("Click where a fixed pin is")
    assert hand.count.startswith("Click where a fixed pin is")
    hand.page.mouse.move(*hand.pixel(complex(100, -50)))
    assert hand.page.inner_text("#at") == "(100; -50) mm"
    build_offset_slider_crank(hand)
    assert not barred(hand.page)
    crank = 0.5 * hand.place("A")
    hand.click("driver", crank)
    hand.page.wait_for_selector("#tip:not([hidden])")
    assert "is driven already" in hand.told
    hand.take("bar")
    assert hand.page.locator("#tip").is_hidden()
    upper = hand.page.locator("#canvas").bounding_box()["y"]
    hand.driver(crank, 90)
    assert abs(hand.page.locator("#canvas").bounding_box()["y"] - upper) < 0.1  # of a dot
    assert hand.text.count("speed = 90") == 1
    hand.write("speed", "75")
    hand.settled(lambda: hand.page.press("#speed", "Enter"))
    assert hand.text.count("speed = 75") == 1
    assert hand.page.inner_text("#speed-unit") == "rev/min"


def test_a_planet_is_built_from_an_empty_field(hand, tmp_path):
    """The field stays where it is under the pointer."""
    hand.page.set_viewport_size({"width": 1000, "height": 800})
    upper = hand.page.locator("#canvas").bounding_box()["y"]
    hand.pivot(0)
    hand.take("bar")
    assert hand.page.locator("#canvas").bounding_box()["y"] == pytest.approx(upper, abs=0.1)
    hand.page.set_viewport_size({"width": 1440, "height": 900})
    hand.page.evaluate(PAINTED)
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
    text = hand.text
    hand.drag("bar", 0, 220)
    hand.page.wait_for_selector("#tip:not([hidden])")
    assert "both pins belong to the frame" in hand.page.inner_text("#tip")
    box, (x, y) = hand.page.locator("#tip").bounding_box(), hand.pixel(220)
    assert abs(box["y"] - y) < 40 and abs(box["x"] - x) < 200
    assert hand.text == text
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
    hand.page.wait_for_selector("#tip:not([hidden])")
    assert "would share two pins" in hand.page.inner_text("#tip")
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


def test_comments_and_order_of_an_opened_scene_are_kept(hand, served):
    page = hand.page
    page.goto(f"{served.address}?lab=pump")
    page.wait_for_selector("body[data-settled=true] #velocity .drawing svg")
    before = hand.text
    page.click("#build")
    page.wait_for_selector("body[data-settled=true] #canvas [data-point='O2']")
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
        picture.scroll_into_view_if_needed()
        links = set(load(lab).scene.links)
        bars = picture.locator("polygon[data-link]")
        assert {bar.get_attribute("data-link") for bar in bars.all()} <= links
        assert bars.count() >= 3 or lab == "offset-slider-crank"
    assert page.locator("[data-name='broken.toml'] svg").count() == 0
    assert not barred(page)
    page.fill("#sought", "GEARS ring")
    shown = page.locator("#opening li:visible [data-key]")
    assert [each.get_attribute("data-name") for each in shown.all()] == ["gears-ring"]
    page.fill("#sought", "")
    gears = page.locator("#examples [data-name='gears-ring']")
    gears.scroll_into_view_if_needed()
    gears.locator("svg circle.wheel").first.wait_for()
    assert gears.locator("svg circle.wheel").count() == 3
    page.click("#labs [data-name='slotted-lever']")
    page.wait_for_selector("#file[value='slotted-lever.toml']")
    page.goto(f"{served.address}?gallery=yes")
    page.click("#scenes li:has([data-name='own.toml']) button:not([data-key])")
    page.wait_for_selector("#file[value='own-2.toml']")
    page.goto(f"{served.address}?gallery=yes")
    page.click("#from-nothing")
    page.wait_for_selector("#canvas svg[viewBox]")
    assert "[" not in hand.text


def share(hand: Hand) -> float:
    """The part of the field's width, or of its height, that the pins take."""
    _, _, width, height = map(
        float, hand.page.locator("#canvas svg").get_attribute("viewBox").split()
    )
    spread = hand.place("A") - hand.place("O1")
    return max(abs(spread.real) / width, abs(spread.imag) / height)


def test_the_field_is_fitted_panned_and_zoomed_by_hand_and_by_keys(hand):
    hand.pivot(0j)
    hand.bar("O1", complex(120, 30))
    fit, field = hand.page.locator("#fit"), hand.page.locator("#canvas svg")
    fit.click()
    whole = share(hand)
    assert 0.5 < whole <= 1
    free = complex(60, -12)
    before = complex(*hand.pixel(0j))
    hand.drag("move", free, free + complex(-20, 10))
    moved = complex(*hand.pixel(0j)) - before
    assert moved.real < -5 and moved.imag < -5  # the field follows the pointer, left and up
    field.focus()
    hand.page.keyboard.press("+")
    assert share(hand) > 1.2 * whole
    hand.page.keyboard.press("0")
    assert share(hand) == pytest.approx(whole, rel=0.1)
    hand.page.keyboard.press("3")
    assert hand.page.locator("#tools input[value='bar']").is_checked()
    hand.page.set_viewport_size({"width": 1100, "height": 900})
    hand.page.wait_for_function("innerWidth === 1100")
    hand.page.evaluate(PAINTED)
    assert share(hand) == pytest.approx(whole, rel=0.2)


def test_a_scene_fills_the_field_when_it_is_first_built_on(hand, served):
    """Opened with its pins, and not left as small as in the view of an empty field."""
    hand.page.goto(served.address)
    hand.page.wait_for_selector("body[data-settled=true] .drawing svg")
    hand.page.click("#build")
    hand.page.wait_for_selector("#canvas svg[viewBox] [data-point='A']")
    hand.page.evaluate(PAINTED)
    pins = hand.page.locator("#canvas [data-point]").all()
    places = [hand.place(pin.get_attribute("data-point")) for pin in pins]
    _, _, *field = map(float, hand.page.locator("#canvas svg").get_attribute("viewBox").split())
    axes = [[at.real for at in places], [at.imag for at in places]]
    assert max((max(axis) - min(axis)) / size for axis, size in zip(axes, field, strict=True)) > 0.3


def typed_drag(hand, tool: str, start: complex, way: complex, keys: str) -> None:
    """Drag with a tool, and type in the middle of it."""
    hand.take(tool)
    hand.page.mouse.move(*hand.pixel(start))
    hand.page.mouse.down()
    hand.page.mouse.move(*hand.pixel(start + way))
    for key in keys:
        hand.page.keyboard.press("Space" if key == " " else key)
    hand.settled(hand.page.mouse.up)


def test_lengths_and_angles_are_typed_on_the_field(hand):
    """Not rounded to the grid: a bar by length and angle, one by its length, a wheel, a guide."""
    hand.pivot(0j)
    typed_drag(hand, "bar", 0j, complex(80, 20), "123.4 30")
    assert "O1-A = 123.4" in hand.text
    end = hand.place("A")
    assert abs(end - 123.4 * complex(3**0.5 / 2, 0.5)) < 1e-3
    typed_drag(hand, "bar", end, complex(100, 0), "77,25")
    assert "A-B = 77.25" in hand.text
    assert abs(abs(hand.place("B") - end) - 77.25) < 1e-3
    typed_drag(hand, "block", hand.place("B"), complex(60, 4), " 12.5")
    assert "angle = 12.5" in hand.text
    assert hand.page.locator("#tools input[value='block']").is_checked()  # digits chose no tool
