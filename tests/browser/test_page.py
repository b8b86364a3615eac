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
from graphkin.web.protocol import telling
from graphkin.web.screen_sheets import screen_sheets
from graphkin.web.step_page import step_page, task_page
from tests.browser.opening import Opened, barred
from tests.chosen import SCENES
from tests.documents.sheet_tools import mechanism_named
from tests.web.test_page import NASTY

DESKTOP = {"viewport": {"width": 1440, "height": 900}}
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "device_scale_factor": 2}
SMALL = PHONE | {"viewport": {"width": 360, "height": 640}}
LYING = PHONE | {"viewport": {"width": 844, "height": 390}, "color_scheme": "dark"}
SHAPES = {"desktop": DESKTOP, "phone": PHONE, "dark": DESKTOP | {"color_scheme": "dark"}}
SHAPES |= {"small": SMALL, "lying": LYING}
STEPS = "document.querySelectorAll('#steps li').length"
STATE = """() => {
  const step = Number(document.getElementById('step').value);
  const seen = mark => mark.checkVisibility({ visibilityProperty: true });
  const sheets = [...document.querySelectorAll('.sheet')];
  const all = '.sheet:not([hidden]) svg [data-at]:not([visibility])';
  const marks = [...document.querySelectorAll(all)];
  const current = [...document.querySelectorAll('#steps [aria-current=step]')];
  return {
    count: document.getElementById('count').textContent,
    wrong: marks.filter(mark => seen(mark) !== (mark.dataset.at <= step)).map(mark => mark.id),
    sheets: sheets.flatMap((sheet, i) => sheet.hidden ? [] : [i]),
    current: current.map(link => link.dataset.number),
    sentence: document.getElementById('sentence').textContent,
    listed: document.querySelector(`#step-${step} .say`).textContent,
  };
}"""
UNSEEN = """[...document.querySelectorAll('svg [data-at]:not([visibility])')]
  .filter(mark => !mark.checkVisibility({ visibilityProperty: true })).length"""
OUT_OF_SIGHT = """() => {
  const parts = document.querySelectorAll(
    '#say, #next, #step, #stops [aria-current], #driver, #values, .sheet:not([hidden]) .view');
  const boxes = [...parts].map(part => [part.id || part.className, part.getBoundingClientRect()]);
  const wide = document.documentElement.scrollWidth > innerWidth ? ['too wide'] : [];
  const lost = boxes.filter(([, box]) => box.top < 0 || box.bottom > innerHeight + 1 ||
    box.left < 0 || box.right > innerWidth + 1 || !box.width);
  return lost.map(([name]) => name).concat(wide);
}"""
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


@pytest.mark.parametrize("name", FEW)
def test_each_step_shows_what_was_drawn_until_then(opened: Opened, pages: Path, name):
    page = opened(pages / f"{name}.html", **DESKTOP)
    said = telling(screen_sheets(mechanism_of(name), "en")).said
    for step in range(1, len(said) + 1):
        found = page.evaluate(STATE)
        assert found["count"] == f"Step {step} of {len(said)}"
        assert found["wrong"] == []
        assert found["sheets"] == [said[step - 1].sheet]
        assert found["current"] == [str(step)]
        assert found["sentence"] == found["listed"]
        page.keyboard.press("ArrowRight")
    assert page.locator("#next").is_disabled()


def test_what_b_is_drawn_from_is_marked_and_named(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    page.locator("#steps a[data-number='6']").click()
    assert marked(page, "new") == {"b"}
    assert marked(page, "old") == {"a", "o", "A", "B", "O2"}
    assert page.locator("#from").inner_text() == "O2, o, A (1), B (2), a (5)"
    assert page.locator(".halo .side").count() == 2
    page.locator("#from a", has_text="B").click()
    assert step_of(page) == 2


def test_a_click_on_a_mark_goes_to_the_step_that_draws_it(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    page.locator("#steps a[data-number='8']").click()
    page.locator("#sheet-0 text.label[data-name='b']").click()
    assert step_of(page) == 6


def test_pointing_at_a_mark_shows_what_it_alone_is_drawn_from(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    page.locator("#steps a[data-number='8']").click()
    page.locator("#sheet-0 text.label[data-name='a']").hover()
    assert page.locator("#from").inner_text() == "O1, o, A (1)"
    assert "b (6)" not in page.locator("#from").inner_text()
    page.locator("h1").hover()
    assert "c (7)" in page.locator("#from").inner_text()


# --- keys and addresses --------------------------------------------------------------------------


def test_keys_go_through_the_steps(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    last = page.evaluate(STEPS)
    found = []
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft", "End", "ArrowRight", "Home", "2", "6"):
        page.keyboard.press(key)
        found.append(step_of(page))
    assert found == [2, 3, 2, last, last, 1, 5, 18]


def test_every_control_is_reached_by_tab_and_has_a_name(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    page.keyboard.press("End")
    found = {}
    for _ in range(60):
        page.keyboard.press("Tab")
        focus = "({id, textContent, ariaLabel}) => [id, ariaLabel || textContent.trim()]"
        name, told = page.evaluate(f"({focus})(document.activeElement)")
        found[name] = told or page.evaluate("document.activeElement.labels?.[0]?.textContent")
    wanted = {"previous", "play", "step", "follow", "driver"}
    assert wanted <= found.keys()
    assert all(found[name] for name in wanted)
    assert page.locator("#stops button").count() == 6


def test_on_the_sliders_the_arrow_keys_are_their_own(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    page.locator("#step").focus()
    page.keyboard.press("ArrowRight")
    assert step_of(page) == 2
    page.locator("#driver").focus()
    before = page.locator("#driven").inner_text()
    page.keyboard.press("ArrowRight")
    assert step_of(page) == 2
    assert page.locator("#driven").inner_text() != before


def test_space_plays_to_the_end_and_stops_there(opened: Opened, pages: Path):
    page = opened(pages / "slotted-lever.html", **DESKTOP)
    page.clock.install()
    page.reload()
    page.keyboard.press(" ")
    assert page.locator("#play").get_attribute("aria-label") == words("en")("screen.pause")
    page.clock.run_for(13_000)
    assert step_of(page) > 1
    page.keyboard.press(" ")
    stood = step_of(page)
    page.clock.run_for(60_000)
    assert step_of(page) == stood
    page.locator("#play").click()
    page.clock.run_for(600_000)
    assert step_of(page) == page.evaluate(STEPS)
    assert page.locator("#play").get_attribute("aria-label") == words("en")("screen.play")


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


@pytest.mark.parametrize("degrees", [20.0, 121.5])
@pytest.mark.parametrize("name", ["pump", "slotted-lever"])
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
    told = f"b: the lines cross at {degrees_of(b.angle):.0f}°, 1 mm of pencil becomes up to"
    assert page.locator("#crossing").inner_text() == f"{told} {b.factor:.1f} mm"
    for link in "234":
        omega = trace.value("omega", link)
        sense = spoken("page.anticlockwise" if omega > 0 else "page.clockwise")
        row = page.locator(f"[data-row='ω{link}'] td")
        assert row.all_inner_texts() == [spoken.significant(abs(omega)), sense]
    page.locator("#back").click()
    assert page.locator("[data-row='v_D'] td").all_inner_texts() == before


@pytest.mark.parametrize("name", FEW)
def test_every_row_of_the_tables_has_its_value(opened: Opened, pages: Path, name):
    page = opened(pages / f"{name}.html", **DESKTOP)
    shown = page.evaluate("[...document.querySelectorAll('[data-row]')].map(r => r.dataset.row)")
    known = page.evaluate("Object.keys(graphkinMotion.values(graphkinMotion.start))")
    assert set(shown) <= set(known)
    kept = page.locator("#results").inner_text()
    page.evaluate("document.getElementById('driver').dispatchEvent(new Event('input'))")
    assert page.locator("#results").inner_text() == kept


def test_where_lines_do_not_cross_nothing_is_read_off(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    page.goto(f"{(pages / 'pump.html').as_uri()}#step=6&x=9999")
    assert page.locator("#place").inner_text() == words("en")("screen.dead")
    assert not page.locator("#values").is_visible()
    page.locator("#back").click()
    assert page.locator("#place").inner_text() == ""
    assert page.locator("#values").is_visible()


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


NOTES = ".moved-note:not([hidden])"


@pytest.mark.parametrize("media", ["screen", "print"])
def test_away_from_the_drawn_position_the_page_says_so(opened: Opened, pages: Path, media):
    page = opened(pages / "pump.html", **DESKTOP)
    page.emulate_media(media=media)
    assert page.locator(NOTES).count() == 0
    assert "φ = 44°" in page.locator("#given").inner_text().replace("\u00a0", " ")
    page.evaluate("location.hash = '#step=6&x=120'")
    page.wait_for_selector(NOTES, state="attached")
    told = words("en")("screen.moved", place="φ = 120.0°", start=page.evaluate(START))
    assert [note.text_content() for note in page.locator(NOTES).all()] == [told] * 3
    assert page.locator("#datum").inner_text() == "φ = 120.0°"
    assert not page.locator("footer p").is_visible()
    page.evaluate("location.hash = '#step=6'")
    page.wait_for_selector(NOTES, state="detached")
    assert "φ = 44°" in page.locator("#given").inner_text().replace("\u00a0", " ")
    assert page.locator("footer p").is_visible()


START = "`φ = ${graphkinMotion.start.toFixed(1)}°`"


def test_the_slider_says_how_far_it_goes_and_why(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP)
    low, high = page.locator("#move .end").all_inner_texts()
    assert low == f"−{abs(page.evaluate('graphkinMotion.low')):.1f}°"
    assert high == f"{page.evaluate('graphkinMotion.high'):.1f}°"
    told = words("en")("screen.limits", list=f"{low} / {high}")
    assert page.locator("#limits").inner_text() == told
    page = opened(pages / "slotted-lever.html", **DESKTOP)
    assert page.locator("#limits").count() == 0


# --- sizes and directions ------------------------------------------------------------------------

BARS = """() => [...document.querySelectorAll('.sheet:not([hidden]) figure')].map(figure => [
  Number(figure.querySelector('.mm').textContent),
  figure.querySelector('.bar i').getBoundingClientRect().width,
  figure.querySelector('svg').getScreenCTM().a,
  figure.querySelector('.bar i').getBoundingClientRect().left - figure.getBoundingClientRect().left,
])"""


@pytest.mark.parametrize("shape", ["desktop", "phone", "small", "lying"])
def test_the_bar_of_a_field_is_as_long_as_it_says(opened: Opened, pages: Path, shape):
    page = opened(pages / "pump.html", **SHAPES[shape])
    lengths = set()
    for address in ("step=5", "step=12", "step=15", "step=19&x=180", "step=15&x=12"):
        page.evaluate("address => { location.hash = address; }", address)
        page.wait_for_timeout(200)
        for key in ("", "z"):
            page.keyboard.press(key) if key else None
            for told, wide, dots, room in page.evaluate(BARS):
                assert wide == pytest.approx(told * dots, abs=1.5)
                assert wide > 4
                assert room > 0
                lengths.add(round(dots, 1))
    assert len(lengths) > 4


def test_in_print_and_without_a_script_the_bars_are_as_long_as_they_say(
    opened: Opened, pages: Path
):
    page = opened(pages / "pump.html", **DESKTOP)
    page.keyboard.press("5")
    page.emulate_media(media="print")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    bare = opened(pages / "pump.html", **DESKTOP, java_script_enabled=False)
    small = opened(pages / "pump.html", **PHONE, java_script_enabled=False)
    task = opened(pages / "pump-task.html", **DESKTOP)
    task_printed = opened(pages / "pump-task.html", **DESKTOP)
    task_printed.emulate_media(media="print")
    for one in (page, bare, small, task, task_printed):
        found = one.evaluate(BARS)
        assert len(found) in (2, 4)
        for told, wide, dots, room in found:
            assert wide == pytest.approx(told * dots, abs=1.5)
            assert room > 0


# --- every reader --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "shape"),
    [*(("pump", shape) for shape in SHAPES), ("pump-task", "phone"), ("nasty", "desktop")],
)
def test_axe_finds_nothing_against_the_page(opened: Opened, pages: Path, name, shape):
    page = opened(pages / f"{name}.html", **SHAPES[shape])
    page.keyboard.press("2")
    page.wait_for_timeout(400)  # until the marks have appeared
    assert not barred(page)


@pytest.mark.parametrize("name", FEW[:1])
@pytest.mark.parametrize("shape", ["desktop", "phone", "small", "lying"])
def test_drawing_sentence_and_keys_are_in_sight_together(opened: Opened, pages: Path, name, shape):
    page = opened(pages / f"{name}.html", **SHAPES[shape])
    for step in range(1, page.evaluate(STEPS) + 1):
        assert page.evaluate(OUT_OF_SIGHT) == [], step
        page.keyboard.press("ArrowRight")


def test_without_a_script_it_is_the_finished_drawing_with_its_list(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP, java_script_enabled=False)
    assert page.locator(".sheet").count() == 2
    assert all(sheet.is_visible() for sheet in page.locator(".sheet").all())
    assert page.locator("#steps li").count() == 20
    assert page.locator("#dock, button, input").count() == 0
    assert all(mark.is_visible() for mark in page.locator("circle.point").all())


@pytest.mark.parametrize("step", ["1", "13"])
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
