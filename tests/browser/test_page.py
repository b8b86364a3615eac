"""The step page in a real browser: steps, keys, addresses, driver, print, and without a script."""

from __future__ import annotations

from cmath import rect
from functools import cache
from math import degrees as degrees_of
from math import radians
from pathlib import Path
from typing import Any

import pytest

from graphkin.construction.core.crossings import crossings
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.run import Trace, run
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.arithmetic import FLOAT
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.web.screen_sheets import screen_sheets
from graphkin.web.step_page import step_page, task_page
from tests.browser.opening import Opened, barred
from tests.chosen import SCENES
from tests.documents.sheet_tools import mechanism_named
from tests.web.test_page import NASTY

DESKTOP = {"viewport": {"width": 1440, "height": 900}}
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "device_scale_factor": 2}
SHAPES = {"desktop": DESKTOP, "phone": PHONE, "dark": DESKTOP | {"color_scheme": "dark"}}
STEPS = "document.querySelectorAll('#steps li').length"
UNSEEN = """[...document.querySelectorAll('svg [data-at]:not([visibility])')]
  .filter(mark => !mark.checkVisibility({ visibilityProperty: true })).length"""
CIRCLES = """view => [...view.querySelectorAll('circle:is(.pin,.point,.pole)[data-of]')]
  .filter(circle => !circle.hasAttribute('visibility'))
  .map(circle => [circle.dataset.of, circle.getAttribute('cx'), circle.getAttribute('cy')])
  .map(row => row.map(Number))"""
FEW = ("pump", "slotted-lever", "rapid-return")


@cache
def mechanism_of(name: str) -> Mechanism:
    """A mechanism by its name."""
    return mechanism_named(name) if name in SCENES else load(name)


@pytest.fixture(scope="module")
def pages(tmp_path_factory) -> Path:
    """A folder with the pages of some scenes."""
    folder = tmp_path_factory.mktemp("pages")
    for name in FEW:
        page = step_page(mechanism_of(name), "en")
        (folder / f"{name}.html").write_text(page, encoding="utf-8")
        task = task_page(mechanism_of(name), "en")
        (folder / f"{name}-task.html").write_text(task, encoding="utf-8")
    nasty = Mechanism(read_text(NASTY, "nasty", None, {}))
    (folder / "nasty.html").write_text(step_page(nasty), encoding="utf-8")
    return folder


def step_of(page: Any) -> int:
    """The step that is shown."""
    return int(page.locator("#count").inner_text().split()[1])


def marked(page: Any, look: str) -> set[str]:
    """The names of the points whose marks are marked, as new or as old."""
    chosen = ".now" if look == "new" else "[data-of]:not(.rest):not(.now)"
    found = page.locator(f".sheet:not([hidden]) svg circle{chosen}").all()
    return {mark.get_attribute("data-name") for mark in found}


# --- steps ---------------------------------------------------------------------------------------


def test_what_b_is_drawn_from_is_marked_and_named(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    page.locator("#steps a[data-number='6']").click()
    assert marked(page, "new") == {"b"}
    assert marked(page, "old") == {"a", "o", "A", "B", "O2"}
    assert page.locator("#from").inner_text() == "O2, o, A (1), B (2), a (5)"
    assert page.locator(".halo .side").count() == 2
    page.locator("#from a", has_text="B").click()
    assert step_of(page) == 2


# --- keys and addresses --------------------------------------------------------------------------


def test_keys_go_through_the_steps(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    last = page.evaluate(STEPS)
    found = []
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft", "End", "ArrowRight", "Home", "2", "6"):
        page.keyboard.press(key)
        found.append(step_of(page))
    assert found == [2, 3, 2, last, last, 1, 5, 18]


def test_an_address_leads_to_its_step_and_place(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    address = (pages / "pump.html").as_uri()
    for turned in ("330", "-30", "690"):
        page.goto(f"{address}#step=7&x={turned}")
        assert page.locator("#driven").inner_text() == "−30.0°"
    page.goto(f"{address}#step=7&x=80")
    assert step_of(page) == 7
    assert page.locator("#driven").inner_text() == "80.0°"
    page.keyboard.press("ArrowRight")
    page.wait_for_url("**#step=8&x=80")
    page.locator("#back").click()
    page.wait_for_url("**#step=8")
    for wrong in ("step=999", "step=banana&x=nothing", "step=-3", "nonsense"):
        page.goto(f"{address}#{wrong}")
        assert 1 <= step_of(page) <= page.evaluate(STEPS)


# --- the driver ----------------------------------------------------------------------------------


def moved(drawing: Drawing, mechanism: Mechanism, degrees: float) -> Trace:
    """A drawing's steps with the crank turned to an angle."""
    program, drawn = mechanism.program, drawing.trace.values
    (drive,) = program.drives
    overrides: dict[int, Any] = {drive.position: rect(1, radians(degrees))}
    if drive.angle is not None:
        overrides[drive.angle] = radians(degrees)
    overrides |= {program.seconds: drawn[program.seconds]} if program.seconds in drawn else {}
    needed = sorted(drawn)
    return run(program, needed, mechanism.scene.values, FLOAT, overrides=overrides)


@pytest.mark.parametrize(("name", "degrees"), [("pump", 20.0), ("slotted-lever", 121.5)])
def test_points_move_to_where_python_draws_them(opened: Opened, pages: Path, name, degrees):
    page, mechanism = opened(pages / f"{name}.html", **DESKTOP), mechanism_of(name)
    page.goto(f"{(pages / name).as_uri()}.html#step=99&x={degrees}")
    compared = 0
    for place, sheet in enumerate(screen_sheets(mechanism, "en")):
        values = moved(sheet.drawing, mechanism, degrees).values
        for side, field in enumerate((sheet.layout.mechanism, sheet.layout.plan)):
            view = page.locator(f"#sheet-{place} .view").nth(side)
            for step, x, y in view.evaluate(CIRCLES):
                if isinstance(values.get(step), complex):
                    assert (x, y) == pytest.approx(field(values[step]), abs=0.01), step
                    compared += 1
    assert compared > 10


def test_tables_margins_and_line_follow_the_driver(opened: Opened, pages: Path):
    page, mechanism = opened(pages / "pump.html", **DESKTOP), load("pump")
    before = page.locator("[data-row='v_D'] td").all_inner_texts()
    page.goto(f"{(pages / 'pump.html').as_uri()}#step=6&x=80")
    sheet = screen_sheets(mechanism, "en")[0]
    trace = moved(sheet.drawing, mechanism, 80.0)
    speed = abs(trace.value("velocity", "D"))
    spoken = words("en")
    _, length, size = page.locator("[data-row='v_D'] td").all_inner_texts()
    assert length == spoken.fixed(1000 * speed / sheet.drawing.scales.kv, 2)
    assert size == spoken.significant(speed)
    assert before[2] != size
    assert f"vD = {size} m/s" in page.locator("#values").inner_text()
    (b,) = (found for found in crossings(trace) if found.name == "b")
    told = f"b: the lines cross at {degrees_of(b.angle):.0f}°, "
    told += f"a 1 mm drawing error grows to as much as {b.factor:.1f} mm"
    assert page.locator("#crossing").inner_text() == told
    for link in "234":
        omega = trace.value("omega", link)
        sense = spoken("page.anticlockwise" if omega > 0 else "page.clockwise")
        row = page.locator(f"[data-row='ω{link}'] td")
        assert row.all_inner_texts() == [spoken.significant(abs(omega)), sense]
    page.locator("#back").click()
    assert page.locator("[data-row='v_D'] td").all_inner_texts() == before


def test_at_a_dead_point_no_vector_is_drawn_that_hangs_on_it(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    page.goto(f"{(pages / 'pump.html').as_uri()}#step=10&x=9999")
    seen = """name => [...document.querySelectorAll(`.sheet:not([hidden]) [data-name='${name}']`)]
      .filter(mark => mark.checkVisibility({ visibilityProperty: true })).length"""
    assert page.evaluate(seen, "v_D") == 0
    assert page.evaluate(seen, "d") == 0
    assert page.evaluate(seen, "v_A") > 0
    assert page.evaluate(seen, "D") > 0
    page.locator("#back").click()
    assert page.evaluate(seen, "v_D") > 0


# --- sizes and directions ------------------------------------------------------------------------


# --- every reader --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "shape"),
    [("pump", "dark"), ("pump-task", "phone"), ("nasty", "desktop")],
)
def test_axe_finds_nothing_against_the_page(opened: Opened, pages: Path, name, shape):
    page = opened(pages / f"{name}.html", **SHAPES[shape])
    page.keyboard.press("2")
    page.evaluate("Promise.all(document.getAnimations().map((each) => each.finished))")
    assert not barred(page)


def test_without_a_script_it_is_the_finished_drawing_with_its_list(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP, java_script_enabled=False)
    assert page.locator(".sheet").count() == 2
    assert all(sheet.is_visible() for sheet in page.locator(".sheet").all())
    assert page.locator("#steps li").count() == 20
    assert page.locator("#dock, button, input").count() == 0
    assert all(mark.is_visible() for mark in page.locator("circle.point").all())


@pytest.mark.parametrize("step", ["1"])
def test_on_paper_it_is_the_same_wherever_it_stood(opened: Opened, pages: Path, step):
    page = opened(pages / "pump.html", **DESKTOP)
    page.goto(f"{(pages / 'pump.html').as_uri()}#step={step}")
    page.emulate_media(media="print")
    assert all(sheet.is_visible() for sheet in page.locator(".sheet").all())
    assert not page.locator("#dock").is_visible()
    assert page.evaluate(UNSEEN) == 0
    assert page.locator("#steps li").count() == 20


def test_hostile_names_do_nothing(opened: Opened, pages: Path):
    page = opened(pages / "nasty.html", **DESKTOP)
    page.on("dialog", lambda dialog: pytest.fail("a name was run"))
    page.keyboard.press("End")
    assert "alert(1)" in page.locator("h1").inner_text()
    assert page.locator("header script, main script").count() == 0
