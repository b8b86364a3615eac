"""The page of a cycle in a real browser: it plays, follows keys, and shows what Python does."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphkin.drawing.marks import Text, reach
from graphkin.mechanism import load
from graphkin.motion.cycle import cycle
from graphkin.text import words
from graphkin.web.animation_pictures import Stage, stage
from graphkin.web.frames import FrameSequence, motion
from graphkin.web.player import player_page
from tests.browser.opening import Opened, barred
from tests.chosen import EVERY

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
NAMES = ("pump", "trammel", "gears-ring", "five-bar") if EVERY else ("trammel", "five-bar")
STILL = {"reduced_motion": "reduce"}
NEAR = 0.01
"""Millimetres by which a mark of the page may be off."""


@lru_cache
def shown(name: str) -> tuple[FrameSequence, Stage]:
    """A motion and its stage."""
    path = SCENES / f"{name}.toml"
    mechanism = load(str(path)) if path.is_file() else load(name, n=7)
    found = motion(cycle(mechanism), words("en"), 24)
    return found, stage(found, words("en"), beside=True)


@pytest.fixture
def page_of(tmp_path: Path, opened: Opened) -> Any:
    """Open the page of a scene: page_of("pump", reduced_motion="reduce")."""

    def told(name: str, **options: Any) -> Any:
        path = tmp_path / f"{name}.html"
        path.write_text(player_page(shown(name)[0], words("en")), encoding="utf-8")
        return opened(path, **options)

    return told


def put(page: Any, x: float) -> float:
    """Move the slider; where the driver then is."""
    page.evaluate(
        "x => { const at = document.getElementById('at'); at.step = 'any'; at.value = x;"
        " at.dispatchEvent(new Event('input')); }",
        x,
    )
    return float(page.input_value("#at"))


CIRCLES = """() => Object.fromEntries([...document.querySelectorAll('svg circle[id]')]
  .filter(mark => !mark.getAttribute('visibility'))
  .map(mark => [mark.dataset.name + ' ' + mark.closest('figure').id,
    [Number(mark.getAttribute('cx')), Number(mark.getAttribute('cy'))]]))"""


@pytest.mark.parametrize("name", NAMES)
def test_the_page_stands_where_python_stands(page_of, name):
    """Pins, and the points of both plans, against the batch of the cycle at the same place."""
    found, set_up = shown(name)
    page = page_of(name, **STILL)
    sweep = found.cycle.sweep
    metres = {"m": 1.0, "cm": 0.01, "mm": 0.001}[found.cycle.scene.units["length"]]
    unit = metres if sweep.what in ("slide", "roll") else 1.0
    low, high = (float(page.get_attribute("#at", end)) for end in ("min", "max"))
    if not found.cycle.path.whole:
        assert low * unit == pytest.approx(found.low, abs=1e-6 * abs(found.high - found.low) + 1e-9)
    compared = 0
    for part in (0.03, 0.3, 0.5, 0.77, 0.97):
        at = put(page, low + part * (high - low)) * unit
        rows = found.cycle.along([at])
        assert len(rows.at) == 1
        circles = page.evaluate(CIRCLES)
        fields = [("field-0", "position", set_up.mechanism)]
        for number, (kind, field) in enumerate(set_up.plans.items(), 1):
            fields.append((f"field-{number}", kind, field))
        for figure, what, field in fields:
            for point, moves in rows.solution.points.items():
                tail = {"position": "", "velocity": "", "acceleration": "′"}[what]
                letter = point if what == "position" else point.lower() + tail
                mark = circles.get(f"{letter} {figure}")
                value = getattr(moves, what)
                image = what == "position" or (len(point) == 1 and point != "O")
                if mark is None or value is None or not image:
                    continue  # the images of some points have other letters: the pole is o
                x, y = field(complex(np.ravel(value)[0]))
                assert abs(mark[0] - x) < NEAR, (name, at, letter, figure)
                assert abs(mark[1] - y) < NEAR, (name, at, letter, figure)
                compared += 1
    assert compared >= 10


LETTERS = """() => {
  const run = JSON.parse(document.getElementById('run').textContent);
  return run.letters.flat().map(([id, point, x, y]) => {
    const text = document.getElementById(id);
    const [u, v] = text.getAttribute('transform').match(/-?[\\d.]+/g).map(Number);
    return [text.dataset.name, text.closest('figure').id,
      text.getAttribute('visibility') === 'hidden', x + u, y + v];
  });
}"""


@pytest.mark.parametrize("name", ["slotted-lever"] if EVERY else ["pump"])
def test_letters_and_panes_stand_where_python_puts_them(page_of, name):
    """The window of each plan, and the middle of each letter, against the same place in a GIF.

    On a screen so large that no letter is enlarged.
    """
    found, set_up = shown(name)
    page = page_of(name, **STILL, viewport={"width": 3200, "height": 2400})
    for moment in found.moments[1:-1:5]:
        put(page, moment.at)
        marks = set_up.mechanism_marks(moment.alone)
        texts = {("field-0", mark.name): mark for mark in marks if isinstance(mark, Text)}
        for number, (kind, field) in enumerate(set_up.plans.items(), 1):
            drawing = moment.drawings[kind]
            at = set_up.seated(drawing).at
            box = page.get_attribute(f"#field-{number} svg", "viewBox")
            window = [float(part) for part in box.split()]
            assert window[0] == pytest.approx(field.rect[0] - (at[0] - field.at[0]), abs=0.05)
            assert window[1] == pytest.approx(field.rect[1] - (at[1] - field.at[1]), abs=0.05)
            marks = set_up.plan_marks(drawing, field)
            texts |= {(f"field-{number}", m.name): m for m in marks if isinstance(m, Text)}
        seen = 0
        for letter, figure, hidden, x, y in page.evaluate(LETTERS):
            mark = texts.get((figure, letter))
            if hidden or mark is None:
                continue
            box = reach(mark)
            assert (box[0] + box[2]) / 2 == pytest.approx(x, abs=0.05), (moment.at, letter)
            assert (box[1] + box[3]) / 2 == pytest.approx(y, abs=0.05), (moment.at, letter)
            seen += 1
        assert seen >= 0.8 * len(texts)


def moved(page: Any) -> float:
    """How far the slider goes in some pictures."""
    before = float(page.input_value("#at"))
    page.evaluate(
        "() => new Promise(done => { let n = 0;"
        " const wait = () => (++n > 20 ? done() : requestAnimationFrame(wait)); wait(); })"
    )
    return abs(float(page.input_value("#at")) - before)


@pytest.mark.parametrize("name", ["pump", "slider-crank-slider"])
def test_beyond_its_end_it_begins_anew_and_never_goes_against_its_speed(page_of, name):
    """A range and a whole turn, of drivers in both senses."""
    found, _ = shown(name)
    sense = 1 if found.cycle.sweep.driver.speed.si(found.cycle.scene.values) > 0 else -1
    page = page_of(name, **STILL)
    low, high = (float(page.get_attribute("#at", end)) for end in ("min", "max"))
    near = high if sense > 0 else low
    put(page, near - sense * 0.02 * (high - low))
    page.get_by_role("button", name="Play").click()
    at = page.evaluate(
        """far => new Promise(done => {
          const at = [], slider = document.getElementById("at");
          const look = () => {
            at.push(Number(slider.value));
            const jumps = at.map((x, i) => i && Math.abs(x - at[i - 1]) > far);
            if (jumps.indexOf(true) >= 0 && jumps.indexOf(true) < at.length - 5) done(at);
            else requestAnimationFrame(look);
          };
          look();
        })""",
        (high - low) / 2,
    )
    steps = sense * np.diff(at)
    assert np.sum(steps < 0) == 1
    assert steps[-1] > 0


# --- curves, and names of vectors ----------------------------------------------------------------


def test_a_curve_goes_where_the_batch_of_the_cycle_goes(page_of):
    """Each dot against the value of the batch, by the numbers beside the lines of the grid."""
    found, _ = shown("gears-ring")
    page = page_of("gears-ring", **STILL)
    assert page.locator("#anew").count() == 0  # what goes round has no way back
    low, high = (float(page.get_attribute("#at", end)) for end in ("min", "max"))
    for part in (0.2, 0.6, 0.9):
        at = put(page, low + part * (high - low))
        rows = found.cycle.along([at])
        links = rows.solution.links
        seen = page.evaluate(DOTS)
        omegas = [number for number in links if f"ω{number}" in seen]
        assert omegas
        for link in omegas:
            assert seen[f"ω{link}"] == pytest.approx(
                float(np.ravel(links[link].omega)[0]), rel=0.02, abs=0.05
            )


DOTS = """() => {
  const found = {}, rows = [...document.querySelectorAll('#values [data-row]')];
  for (const svg of document.querySelectorAll('#curves figure > svg')) {
    const levels = [...svg.querySelectorAll('.level')].map(line => [
      Number(line.getAttribute('y1')),
      Number(line.nextElementSibling.textContent.replace('−', '-')),
    ]);
    const [[y, a], [z, b]] = [levels[0], levels.at(-1)];
    const units = rows.filter(row => row.querySelector('.unit').innerHTML
      === svg.previousElementSibling.lastChild.innerHTML);
    svg.querySelectorAll('.dot').forEach((dot, i) => {
      found[units[i].dataset.row] = a + (Number(dot.getAttribute('cy')) - y) / (z - y) * (b - a);
    });
  }
  return found;
}"""


def test_keys_and_clicks_on_a_curve_play_and_move_and_a_velocity_bears_its_name(page_of):
    page = page_of("pump", **STILL)
    low, high = (float(page.get_attribute("#at", end)) for end in ("min", "max"))
    start = page.inner_text("#position")
    assert start == "44.0°"
    page.keyboard.press("ArrowRight")
    assert float(page.inner_text("#position")[:-1]) > 44
    page.keyboard.press("Space")
    assert moved(page) > 0
    page.keyboard.press("Space")
    assert moved(page) == 0
    page.keyboard.press("Home")
    assert page.inner_text("#position") == start
    page.focus("#speed")
    page.keyboard.press("ArrowDown")
    assert page.input_value("#speed") == "2"
    assert page.inner_text("#position") == start
    chart = page.locator("#curves figure > svg").first
    box = chart.bounding_box()
    chart.click(position={"x": box["width"] * (44 + (320 - 60) / 2) / 320, "y": box["height"] / 2})
    assert float(page.input_value("#at")) == pytest.approx((low + high) / 2, abs=1.5)
    chart.focus()
    before = page.inner_text("#position")
    page.keyboard.press("ArrowRight")
    assert page.inner_text("#position") != before
    assert chart.get_attribute("aria-valuetext") == page.inner_text("#position")
    for part in (0.1, 0.4, 0.7):
        put(page, low + part * (high - low))
        off, text, line = page.evaluate(
            """() => {
              const name = document.querySelector('#field-1 text[data-name=v_D]');
              const box = mark => { const { x, y, width, height } = mark.getBoundingClientRect();
                return [x + width / 2, y + height / 2, width, height]; };
              const line = document.querySelector('#field-1 line[data-name=od]');
              return [name.hasAttribute('data-off'), box(name), box(line)];
            }"""
        )
        if not off:
            assert abs(text[0] - line[0]) < line[2] / 2 + text[2]
            assert abs(text[1] - line[1]) < line[3] / 2 + 2 * text[3]
    assert not off
    assert "not shown going back" in page.inner_text("#anew")


def test_the_page_is_accessible(page_of):
    shape = {"width": 390, "height": 844}
    page = page_of("pump", color_scheme="dark", viewport=shape, **STILL)
    assert not barred(page)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


CUT = """() => [...document.querySelectorAll("#curves figure > svg > text")].filter(text => {
  const own = text.getBBox(), whole = text.ownerSVGElement.viewBox.baseVal;
  return own.x < 0 || own.x + own.width > whole.width || own.y + own.height > whole.height;
}).map(text => text.textContent)"""
"""The numbers of charts that their edges cut."""


@pytest.mark.parametrize("name", ["crank-rocker", "engine", "pump"])
def test_no_number_of_a_chart_is_cut(page_of, name: str):
    """A whole turn ends at 360°, whose number stands at the right edge."""
    page = page_of(name, **STILL)
    assert page.locator("#curves figure > svg > text").count() > 10
    assert page.evaluate(CUT) == []
