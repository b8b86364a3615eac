"""Firefox: the page that draws itself in every look, by keys, mouse and finger; the studio's field.

Chromium looks at all else of both: here stands what is another browser's own.
"""

from __future__ import annotations

from itertools import cycle, product
from pathlib import Path
from time import sleep
from typing import Any

import pytest

from graphkin.mechanism import load
from graphkin.studio.server import Served
from graphkin.web.step_page import step_page, task_page
from tests.browser.building_hand import SHOWS_ANOTHER, Hand, build_slotted_lever
from tests.browser.firefox import LOOKS, Firefox
from tests.browser.opening import LONG, missing
from tests.browser.test_task_board import TYPED
from tests.chosen import EVERY
from tests.web.drawn_logs import VELOCITIES

SIZES = {(1440, 900): 0.60, (1280, 720): 0.60, (820, 1180): 0.45}
"""The least part of a window's height that the drawings take."""
PLACE = """const box = document.querySelector(arguments[0]).getBoundingClientRect();
return [box.x + box.width / 2, box.y + box.height / 2];"""
GRIP = "#sheet-0 .grip.driven"
DRIVER = "return Number(document.getElementById('driver').value)"
BACK = "document.getElementById('back').click()"
FIGURE = "return document.querySelector('#figures .figure').textContent"
COUNT = "return document.getElementById('count').textContent"
FIELD = "return document.querySelector('#sheet-0 .view').clientHeight / innerHeight"
AXE = """const done = arguments[arguments.length - 1];
axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => done(
  violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html.slice(0, 120))])));"""
QUERIES = {
    "light": "(prefers-color-scheme:light)",
    "dark": "(prefers-color-scheme:dark)",
    "forced": "(forced-colors:active)",
    "still": "(prefers-reduced-motion:reduce)",
}
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
SHOWN = [*(product(SIZES, LOOKS) if EVERY else [*zip(cycle(SIZES), LOOKS)][2:3])]
"""Every size and look; or an upright one in forced colours."""
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
    firefox.press(HOME)
    walked = firefox.later(WALK)
    assert len(walked) == 42
    assert all(said and read and not wide for said, read, wide, _ in walked)
    assert sum(drawn for *_, drawn in walked) > 0.8 * len(walked)


def test_it_is_led_by_mouse_finger_and_keys(firefox, pump):
    """Its crank and its figure; what is led goes back; a turn helps itself to its end."""
    firefox.open(pump, "#step=9", (1440, 900), "still")
    before = firefox.run(DRIVER)
    assert firefox.run(FIELD) >= SIZES[1440, 900]
    for kind in ("mouse", "touch"):
        x, y = firefox.run(PLACE, GRIP)
        firefox.drag((x, y), (x - 60, y - 30), kind)
        assert firefox.run(DRIVER) > before + 3
        firefox.run(BACK)
    firefox.run("document.querySelector(arguments[0]).focus()", GRIP)
    firefox.press(RIGHT)
    assert firefox.run(DRIVER) == pytest.approx(before + 1)
    firefox.run("document.querySelector('#figures .figure').focus()")
    firefox.press(RIGHT, RIGHT, LEFT)
    assert firefox.run(FIGURE) == "8"
    assert firefox.run(DRIVER) == pytest.approx(before + 2)  # φ = 30 + 2n
    firefox.press(HOME)
    assert firefox.run(FIGURE) == "1"
    firefox.run(BACK)
    x, y = firefox.run(PLACE, "#figures .figure")
    firefox.drag((x, y), (x + 25, y))
    assert firefox.run(FIGURE) == "12"
    firefox.run(BACK)
    assert firefox.run(FIGURE) == "7"
    assert firefox.run("return document.getElementById('driven').textContent") == "44.0°"
    left = firefox.run(TURN)
    assert firefox.run("return document.querySelectorAll('#score li').length") == len(left) > 10
    assert left[-1].endswith("All is drawn.") or "all drawn." in left[-1]
    assert firefox.run("return document.querySelectorAll('#results .unknown').length") == 0
    assert firefox.run("return document.documentElement.scrollWidth <= innerWidth")
    assert barred(firefox) == []


# --- drawing --------------------------------------------------------------------------------------

LOG = "return Object.entries(localStorage).find(([key]) => key.startsWith('graphkin board'))[1]"
GIVEN = ".sheet circle[data-name='{}']"
ENTER, ESCAPE = "\ue007", "\ue00c"


def type_lines(window: Firefox, lines: str) -> None:
    """Type moves as a student does; after a stroke the result to take."""
    for line in lines.strip().splitlines():
        text, _, which = line.partition(" /")
        window.press(*text, ENTER, *which)


def test_a_plan_is_drawn_on_the_board_of_a_task_and_kept(firefox, tmp_path):
    """By keys and by a drag of mouse and finger; what is drawn outlives the page."""
    path = tmp_path / "pump-task.html"
    path.write_text(task_page(load("pump"), "en"), encoding="utf-8")
    firefox.open(path, "", (1440, 900), "still")
    firefox.press(ESCAPE)
    type_lines(firefox, TYPED)
    assert firefox.run(LOG) == VELOCITIES
    firefox.run("document.querySelector('#palette [data-action=join]').click()")
    firefox.run("document.querySelector('#desk').scrollIntoView()")
    ends = [firefox.run(PLACE, GIVEN.format(letter)) for letter in ("O1", "O2")]
    firefox.drag(*ends)
    assert firefox.run(LOG) == f"{VELOCITIES}|join 0:O1 0:O2"
    firefox.run("document.querySelector('#turn-undo').click()")
    firefox.drag(*ends[::-1], "touch")
    drawn = f"{VELOCITIES}|join 0:O2 0:O1"
    assert firefox.run(LOG) == drawn
    assert barred(firefox) == []
    firefox.open(path, "", (820, 1180), "dark")
    assert firefox.run(LOG) == drawn
    assert firefox.run("return document.querySelectorAll('.halo .vector').length") > 0
    assert firefox.run("return document.documentElement.scrollWidth <= innerWidth")


def test_a_turn_outlives_its_page(firefox, tmp_path):
    """A right line, a wrong one with what would come of it, and the page opened again.

    Equal pages share the turn that they keep, so that its data are its own.
    """
    pump = tmp_path / "pump-n3.html"
    pump.write_text(step_page(load("pump", n=3), "en"), encoding="utf-8")
    firefox.open(pump, "#step=6", (1280, 720), "still")
    firefox.run("document.getElementById('turn').click()")
    type_lines(firefox, "perp O2B o\npar AB a")
    told = firefox.run("return document.getElementById('turn-say').textContent")
    assert told.startswith("AB keeps its length, so vBA cannot lie along it. AB would ")
    count = firefox.run("return document.getElementById('turn-count').textContent")
    firefox.open(pump, "#step=6", (1280, 720), "forced")
    assert firefox.run("return document.getElementById('turn-count').textContent") == count
    firefox.run("document.getElementById('turn-undo').click()")
    assert firefox.run("return document.getElementById('turn-count').textContent") != count


# --- the studio ----------------------------------------------------------------------------------

CANVAS = """const svg = document.querySelector("#canvas svg"), box = svg.getBoundingClientRect();
return [box.x, box.y, box.width, box.height, svg.getAttribute("viewBox")];"""
PIN = """const pin = document.querySelector(`#canvas [data-point='${arguments[0]}']`);
return [pin.getAttribute("cx"), pin.getAttribute("cy")];"""
TOOL = """document.querySelector(`#tools input[value='${arguments[0]}']`).click();"""
FRAMES = """const done = arguments[arguments.length - 1];
requestAnimationFrame(() => requestAnimationFrame(() => done(true)));"""
"""What a tool needs shows itself, and the field takes the room that is left."""
OPEN = """return document.body.dataset.settled === "true" &&
  document.querySelector("#canvas svg")?.hasAttribute("viewBox");"""
WRITE = "document.getElementById(arguments[0]).value = arguments[1];"


class FirefoxHand(Hand):
    """The same hand at a window of Firefox."""

    def __init__(self, window: Firefox) -> None:
        self.window = window

    def pixel(self, at: complex) -> tuple[float, float]:
        x, y, across, down, view = self.window.run(CANVAS)
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

    def has_shown(self, before: str) -> bool:
        wanted = f"const [before, done] = arguments; {SHOWS_ANOTHER}"
        return bool(self.window.later(wanted, before))

    @property
    def count(self) -> str:
        return str(self.window.run("return document.getElementById('count').textContent"))

    @property
    def told(self) -> str:
        return str(self.window.run("return document.getElementById('narration').textContent"))

    @property
    def text(self) -> str:
        return str(self.window.run("return document.getElementById('text').value"))


@pytest.fixture
def hand(firefox: Firefox, served: Served) -> Hand:
    """A hand at an empty field."""
    firefox.open_address(f"{served.address}?empty=yes", (1440, 900))
    found = FirefoxHand(firefox)
    for _ in range(LONG // 20):
        if firefox.run(OPEN):
            return found
        sleep(0.02)
    pytest.fail("the field does not open")


def test_a_slotted_lever_is_built(hand):
    build_slotted_lever(hand)
