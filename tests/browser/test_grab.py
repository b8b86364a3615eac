"""Pins that are dragged, fields that are zoomed and moved, and how still all stays meanwhile."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from graphkin.mechanism import load
from graphkin.web.step_page import step_page
from tests.browser.opening import Opened
from tests.browser.stillness import counted, page_of
from tests.chosen import EVERY
from tests.documents.sheet_tools import mechanism_named

DESKTOP = {"viewport": {"width": 1440, "height": 900}, "reduced_motion": "reduce", "stopped": True}
SIZES = {(1280, 720): 0.60, (1024, 768): 0.45}
"""The least part of a window's height that the drawings take."""
PLACE = """name => { const pin = document.querySelector(`#sheet-0 circle.pin[data-name='${name}']`);
  const { x, y, width, height } = pin.getBoundingClientRect();
  return [x + width / 2, y + height / 2]; }"""
FRAMES = (
    "[...document.querySelectorAll('#sheet-0 .view > svg')].map(svg => svg.getAttribute('viewBox'))"
)
DRIVER = "Number(document.getElementById('driver').value)"
HUSHED = """async () => {
  for (let i = 0; i < 30; i++) await new Promise(requestAnimationFrame);
  const text = document.querySelector(".view text.rest");
  text.classList.add("hushed");
  await Promise.allSettled(text.getAnimations().map(each => each.finished));
  return getComputedStyle(text).opacity;
}"""
"""How much is seen of a label that is hushed, once all rests and it has faded."""
LED = """[...document.querySelectorAll('#sheet-0 .grip.driven')]
  .map(one => one.getAttribute('aria-valuetext'))"""
"""Where the drivers stand."""
CROWDED = """Object.fromEntries([...document.querySelectorAll('#dock button')]
  .filter(one => one.checkVisibility())
  .map(one => [one.id || one.textContent, one.getBoundingClientRect()])
  .map(([name, { x, y, width, height }]) => [name, [x, y, x + width, y + height]]))"""


@pytest.fixture(scope="module")
def pump(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pump's page."""
    path = tmp_path_factory.mktemp("grab") / "pump.html"
    path.write_text(step_page(load("pump"), "en"), encoding="utf-8")
    return path


def dragged(page: Any, name: str, across: float, down: float) -> None:
    """Take a pin and lead it by some dots; it is let go at the end."""
    x, y = page.evaluate(PLACE, name)
    page.mouse.move(x, y)
    page.mouse.down()
    for part in range(1, 11):
        page.mouse.move(x + across * part / 10, y + down * part / 10)
        page.clock.run_for(20)
    page.mouse.up()


def test_a_pin_goes_along_its_way_to_where_it_is_led(kept: Opened, pump: Path):
    page = kept(pump, "#step=9", **DESKTOP)
    before = page.evaluate(DRIVER)
    dragged(page, "A", 10, 10)
    first = page.evaluate(FRAMES)
    for across, down in ((20, 30), (5, 25), (-20, 30)):  # scale and frame stay
        dragged(page, "A", across, down)
        assert page.evaluate(FRAMES) == first
    page.locator("#back").click()
    dragged(page, "C", 40, 30)
    page.clock.run_for(500)
    assert abs(page.evaluate(DRIVER) - before) > 3
    assert page.locator("#driven").inner_text() != "44.0°"
    page.locator("#back").click()
    assert page.evaluate(DRIVER) == before


def test_a_pin_moves_by_keys_and_the_motion_plays(kept: Opened, pump: Path):
    page = kept(pump, "#step=9", **DESKTOP)
    before = page.evaluate(DRIVER)
    page.locator("#sheet-0 .grip.driven").focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate(DRIVER) == pytest.approx(before + 1)
    assert page.locator("#sheet-0 .grip.driven").get_attribute("aria-valuetext") == "45.0°"
    page.keyboard.press("m")
    page.clock.run_for(400)
    assert page.evaluate(DRIVER) > before + 2
    page.keyboard.press("m")
    held = page.evaluate(DRIVER)
    page.clock.run_for(200)
    assert page.evaluate(DRIVER) == held


def test_the_motion_plays_before_the_first_step(kept: Opened, pump: Path):
    """No step is shown yet, so none lists crossings: a page that stops there is heard."""
    page = kept(pump, "#step=0", **DESKTOP)
    before = page.evaluate(DRIVER)
    page.keyboard.press("m")
    page.clock.run_for(400)
    page.keyboard.press("m")
    assert page.evaluate(DRIVER) > before + 2


def test_a_figure_leads_all_that_hangs_on_it(opened: Opened, pump: Path):
    """n = 8: φ = 30 + 2n = 46°, n1 = 300 + 10n = 380 rev/min, and v_D with them."""
    page = opened(pump, "#step=14", **DESKTOP)
    figure, before = page.locator("#figures .figure"), page.locator("#values").inner_text()
    x, y = (figure.bounding_box()[side] + 5 for side in ("x", "y"))
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 6, y, steps=3)
    page.mouse.up()
    page.clock.run_for(500)
    assert figure.inner_text() == "8"
    assert page.locator("#driven").inner_text() == "46.0°"
    assert "n1 = 380 rev/min" in page.locator("#given").inner_text()
    assert page.locator("#values").inner_text() != before
    speed = float(load("pump", n=8).solve().points["D"].velocity.real)
    assert f"vD = {abs(speed):.3f} m/s" in page.locator("#values").inner_text()
    assert "set=n" in page.evaluate("location.hash")
    page.reload()
    assert figure.inner_text() == "8"
    page.locator("#back").click()
    assert figure.inner_text() == "7"
    assert page.locator("#values").inner_text() == before


def test_a_drag_leaves_no_listener_behind(kept: Opened, pump: Path):
    page = kept(pump, "#step=9", **DESKTOP)
    browser = page.context.new_cdp_session(page)

    def listening(selector: str) -> int:
        found = browser.send(
            "Runtime.evaluate", {"expression": f"document.querySelector('{selector}')"}
        )
        of = {"objectId": found["result"]["objectId"]}
        return len(browser.send("DOMDebugger.getEventListeners", of)["listeners"])

    driven = "#sheet-0 .grip.driven"
    parts = (driven, "#figures .figure")
    before = [listening(part) for part in parts]
    for part in parts:
        box = page.locator(part).bounding_box()
        for across in (12, -12):
            page.mouse.move(box["x"] + 4, box["y"] + 4)
            page.mouse.down()
            page.mouse.move(box["x"] + 4 + across, box["y"] + 4, steps=2)
            page.mouse.up()
    assert [listening(part) for part in parts] == before
    browser.detach()


def test_the_wheel_and_keys_zoom_and_a_double_click_restores(opened: Opened, pump: Path):
    page = opened(pump, "#step=9", **DESKTOP)
    drawn = page.evaluate(FRAMES)
    plan = page.locator("#sheet-0 .view > svg").nth(1)
    plan.hover(position={"x": 20, "y": 300})
    page.mouse.wheel(0, -200)
    page.clock.run_for(100)
    zoomed = page.evaluate(FRAMES)
    assert zoomed[0] == drawn[0] and zoomed[1] != drawn[1]
    plan.dblclick(position={"x": 20, "y": 300})
    page.clock.run_for(100)
    assert page.evaluate(FRAMES) == drawn
    plan.focus()
    page.keyboard.press("+")
    page.clock.run_for(100)
    assert page.evaluate(FRAMES) != drawn
    page.keyboard.press("ArrowDown")  # marks are reached by keys
    assert page.locator("#pointed").inner_text()
    page.keyboard.press("Enter")
    assert page.locator("#count").inner_text() != "Step 9 of 42"


def test_the_drawings_have_room_and_no_button_covers_another(opened: Opened, pump: Path):
    page = opened(pump, "#step=9", **DESKTOP | {"stopped": False})
    for (width, height), part in SIZES.items():
        page.set_viewport_size({"width": width, "height": height})
        high = page.locator("#sheet-0 .view").first.evaluate("view => view.clientHeight")
        assert high >= part * height
        keys = page.evaluate(CROWDED)
        stops = page.locator("#stops").bounding_box()
        for name in ("previous", "play", "next", "follow", "turn"):
            left, top, right, bottom = keys[name]
            beside = right <= stops["x"] or left >= stops["x"] + stops["width"]
            assert beside or bottom <= stops["y"] or top >= stops["y"] + stops["height"]


def test_each_driver_of_an_excavator_is_dragged_by_its_own_pin(opened: Opened, tmp_path: Path):
    path = tmp_path / "excavator.html"
    path.write_text(step_page(mechanism_named("excavator-relative"), "en"), encoding="utf-8")
    page = opened(path, "#step=5", **DESKTOP)
    for place, name in enumerate("ABC"):
        before = page.evaluate(LED)
        dragged(page, name, -40, -30)
        after = page.evaluate(LED)
        assert [one == other for one, other in zip(before, after, strict=True)] == [
            k != place for k in range(3)
        ]
        page.clock.run_for(1000)


LEAPT = {"gears-ring": 2058, "pump": 973, "stephenson-3": 1167}
"""How many labels leapt when they changed sides at once."""


@pytest.mark.parametrize("name", LEAPT if EVERY else ["pump"])
def test_labels_neither_leap_nor_lie_on_one_another_while_all_moves(
    opened: Opened, tmp_path: Path, name: str
):
    """At most 1 % of the leaps that there were; over a third of the range, or all of it."""
    path = tmp_path / f"{name}.html"
    path.write_text(page_of(name), encoding="utf-8")
    page = opened(path, **DESKTOP | {"stopped": False})
    part = 1.0 if EVERY else 0.34
    found = counted(page, path, part)
    assert found["leaps"] <= 0.01 * LEAPT[name] * part
    assert found["overlapping"] <= 0.02 * found["positions"]
    assert found["faded"] < 0.15 * found["shown"]  # the pump’s end and the ring are crowded
    assert page.evaluate(HUSHED) == "0"
