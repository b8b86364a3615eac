"""The page that draws itself in Firefox: three sizes, every look, keys, mouse and finger."""

from __future__ import annotations

from itertools import cycle, product
from pathlib import Path
from typing import Any

import pytest

from graphkin.mechanism import load
from graphkin.web.step_page import step_page
from tests.browser.firefox import LOOKS, Firefox
from tests.browser.opening import missing
from tests.chosen import EVERY
from tests.documents.sheet_tools import mechanism_named

SIZES = {(1440, 900): 0.60, (1280, 720): 0.60, (820, 1180): 0.45}
"""The least part of a window's height that the drawings take."""
PLACE = """const box = document.querySelector(arguments[0]).getBoundingClientRect();
return [box.x + box.width / 2, box.y + box.height / 2];"""
DRIVEN = ".sheet:not([hidden]) .grip.driven"
TOLD = f"""return [...document.querySelectorAll('{DRIVEN}')]
  .map(one => one.getAttribute('aria-valuetext'))"""
GRIP = "#sheet-0 .grip.driven"
DRIVER = "return Number(document.getElementById('driver').value)"
COUNT = "return document.getElementById('count').textContent"
FIELD = "return document.querySelector('#sheet-0 .view').clientHeight / innerHeight"
AXE = """const done = arguments[arguments.length - 1];
axe.run(document).then(({ violations }) => done(
  violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html.slice(0, 120))])));"""
QUERIES = {
    "light": "(prefers-color-scheme:light)",
    "dark": "(prefers-color-scheme:dark)",
    "forced": "(forced-colors:active)",
    "still": "(prefers-reduced-motion:reduce)",
}
SHOWN = [*(product(SIZES, LOOKS) if EVERY else [*zip(cycle(SIZES), LOOKS)][::2])]
"""Every size and look; or the largest in light colours, and an upright one in forced colours."""
RIGHT, LEFT, HOME = "\ue014", "\ue012", "\ue011"


@pytest.fixture(scope="module")
def pump(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pump's page."""
    path = tmp_path_factory.mktemp("firefox") / "pump.html"
    path.write_text(step_page(load("pump"), "en"), encoding="utf-8")
    return path


def barred(window: Firefox) -> list[Any]:
    """What axe finds against the page."""
    try:
        import axe_playwright_python
    except ImportError:
        missing("axe-playwright-python is not installed")
    axe = Path(axe_playwright_python.__file__).with_name("axe.min.js").read_text(encoding="utf-8")
    found: list[Any] = window.later(f"{axe};{AXE}")
    return found


@pytest.mark.parametrize(("size", "look"), SHOWN, ids=str)
def test_it_shows_every_step_with_nothing_against_it(firefox, pump, size, look):
    firefox.open(pump, "#step=9", size, look)
    assert firefox.run("return matchMedia(arguments[0]).matches", QUERIES[look])
    assert firefox.run(COUNT) == "Step 9 of 42"
    assert firefox.run(FIELD) >= SIZES[size]
    assert firefox.run("return document.documentElement.scrollWidth <= innerWidth")
    firefox.press(RIGHT)
    assert firefox.run(COUNT) == "Step 10 of 42"
    firefox.run("return Promise.allSettled(document.getAnimations().map(each => each.finished))")
    assert barred(firefox) == []


@pytest.mark.parametrize("kind", ["mouse", "touch"])
def test_the_crank_is_dragged(firefox, pump, kind):
    firefox.open(pump, "#step=9", (1440, 900), "still")
    before = firefox.run(DRIVER)
    x, y = firefox.run(PLACE, GRIP)
    firefox.drag((x, y), (x - 60, y - 30), kind)
    assert firefox.run(DRIVER) > before + 3


def test_pins_and_figures_are_led_by_keys(firefox, pump):
    firefox.open(pump, "#step=9", (1440, 900), "still")
    before = firefox.run(DRIVER)
    firefox.run("document.querySelector(arguments[0]).focus()", GRIP)
    firefox.press(RIGHT)
    assert firefox.run(DRIVER) == pytest.approx(before + 1)
    firefox.run("document.querySelector('#figures .figure').focus()")
    firefox.press(RIGHT, RIGHT, LEFT)
    assert firefox.run("return document.querySelector('#figures .figure').textContent") == "8"
    assert firefox.run(DRIVER) == pytest.approx(before + 2)  # φ = 30 + 2n
    firefox.press(HOME)
    assert firefox.run("return document.querySelector('#figures .figure').textContent") == "1"


def test_a_figure_is_dragged_and_all_goes_back(firefox, pump):
    firefox.open(pump, "#step=20", (1440, 900), "still")
    x, y = firefox.run(PLACE, "#figures .figure")
    firefox.drag((x, y), (x + 25, y))
    assert firefox.run("return document.querySelector('#figures .figure').textContent") == "12"
    firefox.run("document.getElementById('back').click()")
    assert firefox.run("return document.querySelector('#figures .figure').textContent") == "7"
    assert firefox.run("return document.getElementById('driven').textContent") == "44.0°"


def test_a_turn_begins_and_helps_itself(firefox, pump):
    firefox.open(pump, "#step=5", (1440, 900), "still")
    firefox.run("document.getElementById('turn').click()")
    for _ in range(3):
        firefox.run("document.getElementById('draw-it').click()")
    firefox.run("document.getElementById('turn-score').click()")
    assert firefox.run("return document.querySelectorAll('#score li').length") == 3
    assert barred(firefox) == []


OTHERS = dict(zip(("slotted-lever", "gears-ring", "stephenson-3"), SIZES, strict=True))
"""Other pages, each with the size of its window."""
WALK = """const done = arguments[arguments.length - 1], found = [];
const next = document.getElementById('next'), view = '.sheet:not([hidden]) .view > svg';
while (!next.disabled) {
  next.click();
  const texts = document.querySelectorAll(`${view} .lettering > text`);
  const seen = [...texts].filter(text => !text.matches('.later,.void,[visibility],.hushed'));
  const sizes = seen.flatMap(text => {
    const { a, b, c, d } = text.getScreenCTM(), scale = Math.sqrt(a * d - b * c);
    const runs = [text, ...text.querySelectorAll('tspan')].filter(run => run.textContent.trim());
    return runs.map(run => parseFloat(getComputedStyle(run).fontSize) * scale);
  });
  const said = document.getElementById('sentence').textContent;
  const wide = document.documentElement.scrollWidth > innerWidth;
  const drawn = document.querySelector(`${view} .now`) ?? document.querySelector('.turn');
  found.push([said.length > 0, Math.min(...sizes) >= 9, wide, drawn !== null]);
}
done(found);"""
"""At each step: whether something is said, letters can be read, the page is too wide, and whether
anything is drawn."""
TURN = """const drawn = document.getElementById('draw-it'), left = [];
document.getElementById('turn').click();
while (!drawn.disabled) {
  drawn.click();
  left.push(document.getElementById('turn-say').textContent);
}
return left;"""
"""A whole turn, each step drawn by the page: what it says of each."""


@pytest.fixture(scope="module")
def others(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pages of other scenes."""
    folder = tmp_path_factory.mktemp("others")
    for name in OTHERS:
        mechanism = load(name) if name == "slotted-lever" else mechanism_named(name)
        (folder / f"{name}.html").write_text(step_page(mechanism, "en"), encoding="utf-8")
    return folder


@pytest.mark.parametrize(
    ("name", "look"), [*product(OTHERS, LOOKS)] if EVERY else [("stephenson-3", "still")]
)
def test_other_pages_go_through_every_step(firefox, others, name, look):
    size = OTHERS[name]
    firefox.open(others / f"{name}.html", "", size, look)
    steps = firefox.run("return document.querySelectorAll('#steps li').length")
    walked = firefox.later(WALK)
    assert len(walked) == steps
    assert all(said and read and not wide for said, read, wide, _ in walked)
    assert sum(drawn for *_, drawn in walked) > 0.8 * steps
    firefox.run("return Promise.allSettled(document.getAnimations().map(each => each.finished))")
    assert barred(firefox) == []


@pytest.mark.parametrize("name", OTHERS if EVERY else ["slotted-lever"])
def test_a_whole_turn_on_other_pages(firefox, others, name):
    for look, size in zip(LOOKS, SIZES if EVERY else [OTHERS[name]], strict=False):
        firefox.open(others / f"{name}.html", "#step=1", size, look)
        left = firefox.run(TURN)
        rows = firefox.run("return document.querySelectorAll('#score li').length")
        assert rows == len(left) > 10
        assert left[-1].endswith("All is drawn.") or "all drawn." in left[-1]
        assert firefox.run("return document.querySelectorAll('#results .unknown').length") == 0
        assert firefox.run("return document.documentElement.scrollWidth <= innerWidth")
        assert barred(firefox) == []


@pytest.mark.parametrize("name", OTHERS if EVERY else ["gears-ring"])
def test_the_pin_of_the_driver_is_dragged_on_other_pages(firefox, others, name):
    firefox.open(others / f"{name}.html", "#step=6", (1440, 900), "still")
    before = firefox.run(DRIVER)
    x, y = firefox.run(PLACE, GRIP)
    firefox.drag((x, y), (x + 40, y - 40))
    assert abs(firefox.run(DRIVER) - before) > 3


def test_each_of_two_drivers_has_its_handle(firefox, tmp_path):
    path = tmp_path / "five-bar.html"
    path.write_text(step_page(mechanism_named("five-bar"), "en"), encoding="utf-8")
    firefox.open(path, "#step=9", (1440, 900), "still")
    assert firefox.run(TOLD) == ["115.0°", "50.0°"]
    firefox.run(f"document.querySelectorAll('{DRIVEN}')[1].focus()")
    firefox.press(RIGHT)
    assert firefox.run(TOLD) == ["115.0°", "51.0°"]
