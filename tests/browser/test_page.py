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
from tests.browser.opening import PAINTED, Opened, barred, heard
from tests.chosen import EVERY, SCENES
from tests.documents.sheet_tools import mechanism_named
from tests.web.test_page import NASTY

DESKTOP = {"viewport": {"width": 1440, "height": 900}, "reduced_motion": "reduce"}
MOVING = DESKTOP | {"reduced_motion": "no-preference"}
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "device_scale_factor": 2}
SHAPES = {"phone": PHONE, "dark": DESKTOP | {"color_scheme": "dark"}}
STEPS = "document.querySelectorAll('#steps li').length"
UNSEEN = """[...document.querySelectorAll('svg [data-at]:not([visibility])')]
  .filter(mark => !mark.checkVisibility({ visibilityProperty: true })).length"""
CIRCLES = """view => [...view.querySelectorAll('circle:is(.pin,.point,.pole)[data-of]')]
  .filter(circle => !circle.hasAttribute('visibility'))
  .map(circle => [circle.dataset.of, circle.getAttribute('cx'), circle.getAttribute('cy')])
  .map(row => row.map(Number))"""
FEW = ("pump", "slotted-lever")


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
    task = task_page(mechanism_of("pump"), "en")
    (folder / "pump-task.html").write_text(task, encoding="utf-8")
    nasty = Mechanism(read_text(NASTY, "nasty", None, {}))
    (folder / "nasty.html").write_text(step_page(nasty), encoding="utf-8")
    return folder


def step_of(page: Any) -> int:
    """The step that is shown, once a link has led there; 0 for the beginning."""
    page.evaluate(PAINTED)
    count = page.locator("#count").inner_text()
    return 0 if count == "The task" else int(count.split()[1])


def marked(page: Any, look: str) -> set[str]:
    """The names of the points whose marks are marked, as new or as old."""
    chosen = ".now" if look == "new" else "[data-of]:not(.rest):not(.now)"
    found = page.locator(f".sheet:not([hidden]) svg circle{chosen}").all()
    return {mark.get_attribute("data-name") for mark in found}


# --- steps ---------------------------------------------------------------------------------------


def test_what_b_is_drawn_from_is_marked_and_named(kept: Opened, pages: Path):
    page = kept(pages / "pump.html", "#step=0", **DESKTOP)
    page.locator("#steps a[data-number='6']").click()
    assert marked(page, "old") == {"a", "o", "A", "B", "O2"}
    assert page.locator("#from").inner_text() == "O2, o, A (1), B (2), a (5)"
    assert page.locator(".halo .side").count() == 2
    page.locator("#steps a[data-number='7']").click()
    assert marked(page, "new") == {"b"}
    page.locator("#steps a[data-number='6']").click()
    page.locator("#from a", has_text="B").click()
    assert step_of(page) == 2


def test_a_reason_lights_its_own_stroke_alone(kept: Opened, pages: Path):
    page = kept(pages / "pump.html", "#step=6", **DESKTOP)
    reasons = page.locator("#reason .line")
    assert reasons.count() == 2
    lit = ".sheet:not([hidden]) .halo line.new"
    both = page.locator(lit).count()
    for place in (0, 1):
        reasons.nth(place).focus()
        assert 0 < page.locator(lit).count() < both
        assert page.locator(f"{lit}.t{place}").count() == page.locator(lit).count()
    page.locator("#next").focus()
    assert page.locator(lit).count() == both


def test_the_keys_go_through_why_and_what_it_hangs_on(kept: Opened, pages: Path):
    """The list of what a reason hangs on is told anew, and does not drop the focus."""
    page = kept(pages / "pump.html", "#step=6", **DESKTOP)
    page.locator("#because summary").focus()
    all_there = page.locator("#reason button").count() + page.locator("#from a").count()
    inside = "document.activeElement.closest('#reason,#from')?.id ?? null"
    seen = []
    while page.keyboard.press("Tab") or (part := page.evaluate(inside)):
        seen.append(part)
    assert {*seen} == {"reason", "from"} and len(seen) <= all_there
    assert page.evaluate("document.activeElement !== document.body")
    assert page.locator("#from a").count() == 3


def test_the_focus_stays_where_a_step_takes_its_element_away(opened: Opened, pages: Path):
    """On the sentence after a link in it, on the slider after the last press of a button."""
    page = opened(pages / "pump.html", "#step=6", **DESKTOP)
    focused = "document.activeElement.id"
    page.locator("#from a", has_text="B").focus()
    page.keyboard.press("Enter")
    assert (step_of(page), page.evaluate(focused)) == (2, "narration")
    for button, step in (("previous", 1), ("next", page.evaluate(STEPS) - 1)):
        page.evaluate(f"location.hash = '#step={step}'")
        page.evaluate(PAINTED)
        page.locator(f"#{button}").focus()
        page.keyboard.press("Enter")
        assert page.evaluate(focused) == "step"


# --- the beginning -------------------------------------------------------------------------------


VISIBLE = """name => [...document.querySelectorAll(`#sheet-0 [data-name='${name}']`)]
  .some(mark => mark.checkVisibility({ visibilityProperty: true }))"""


def test_the_page_begins_with_the_whole_mechanism_and_the_task(kept: Opened, pages: Path):
    page = kept(pages / "pump.html", "#step=0", **DESKTOP)
    assert page.locator("#count").inner_text() == "The task"
    brief = page.locator("#brief").inner_text()
    assert "the velocity of D" in brief and "O1A = O2B = 30 cm" in brief
    assert page.evaluate("[...'ABCD'].every(" + VISIBLE + ")")
    assert page.evaluate("document.querySelectorAll('.halo .new').length") == 0
    page.keyboard.press("ArrowRight")
    assert not page.locator("#brief").is_visible()
    assert [page.evaluate(VISIBLE, name) for name in "ABCD"] == [True, False, False, False]


def test_a_result_is_hidden_until_the_step_that_finds_it(kept: Opened, pages: Path):
    page = kept(pages / "pump.html", "#step=14", **DESKTOP)
    values = page.locator("#values")
    assert "vD = 3.827 m/s" in values.inner_text() and "ω2 = 6.171" in values.inner_text()
    assert "ω3 = ?" in values.inner_text()
    assert page.locator("[data-row='ω3']").get_attribute("class") == "unknown"
    page.keyboard.press("ArrowRight")
    assert "ω3 = 27.65" in values.inner_text()
    assert page.locator(".halo .turn.tip").count() == 1
    page.emulate_media(media="print")  # on paper it is the same wherever it stood
    assert all(sheet.is_visible() for sheet in page.locator(".sheet").all())
    assert not page.locator("#dock").is_visible()
    assert page.evaluate(UNSEEN) == 0
    assert page.locator("#steps li").count() == 42
    colours = (
        "[...document.querySelectorAll('#results td')].map(cell => getComputedStyle(cell).color)"
    )
    assert len({*page.evaluate(colours)}) == 1


def test_a_rate_that_is_not_asked_for_is_told_while_the_driver_goes(opened: Opened, pages: Path):
    """Of each place the rates there, not those of the place before; block and lever turn alike."""
    page = opened(pages / "slotted-lever.html", "#step=12", stopped=True, **DESKTOP)
    drawing = screen_sheets(load("slotted-lever"), "en")[0].drawing
    asked = "[data-row='{}'][data-asked]"
    assert [page.locator(asked.format(row)).count() for row in ("ω3", "ω2")] == [1, 0]
    for asked_for in ("80", "50"):
        page.locator("#driver").fill(asked_for)
        page.clock.run_for(100)
        place = float(page.locator("#driver").input_value())
        trace = moved(drawing, load("slotted-lever"), place)
        omega = words("en").significant(abs(trace.value("omega", "3")))
        assert page.locator("#sentence").inner_text().count(f" = {omega} rad/s") == 2
    page.clock.run_for(1000)
    assert page.locator("#sentence").inner_text().count(f" = {omega} rad/s") == 2


def test_a_tap_beside_a_line_leads_to_its_step(kept: Opened, pages: Path):
    """A finger is wider than a line: some dots off it are still meant for it."""
    page = kept(pages / "pump.html", "#step=16", **DESKTOP)
    line = page.locator("#sheet-0 line[data-name='ab']:not(.halo *)").first
    middle = line.evaluate(
        """mark => { const { x, y, width, height } = mark.getBoundingClientRect();
          return [x + width / 2 + 3, y + height / 2 - 2]; }"""
    )
    page.mouse.click(*middle)
    assert step_of(page) == 7


# --- both plans, and the pen ---------------------------------------------------------------------


def test_the_velocity_plan_stands_beside_where_its_segment_is_carried_over(opened, pages: Path):
    page = opened(pages / "pump.html", "#step=19", **DESKTOP)
    small = page.locator(".carried")
    assert small.is_visible()
    assert small.locator(".lit").count() == 1
    ends = small.locator(".lit").evaluate(
        "line => ['x1', 'y1', 'x2', 'y2'].map(name => Number(line.getAttribute(name)))"
    )
    sheet = screen_sheets(load("pump"), "en")[0]
    values = [sheet.drawing.trace.value("velocity", name) for name in "AB"]
    assert ends == pytest.approx([x for one in values for x in sheet.layout.plan(one)], abs=0.01)
    page.locator("#steps a[data-number='29']").click()
    assert not small.is_visible()
    page.locator("#steps a[data-number='19']").click()
    assert small.is_visible()
    page.locator("#turn").click()  # a turn leaves nothing of it, and nothing lit
    assert not small.is_visible()
    assert page.locator(".halo > *").count() == 0


def test_a_pen_draws_whole_arcs_and_leaves_their_ticks(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", "#step=1", stopped=True, **MOVING)
    tick = page.locator("#sheet-0 .compass").first.evaluate("mark => mark.getTotalLength()")
    page.keyboard.press("ArrowRight")
    pens = page.locator(".pen")
    assert pens.count() >= 2
    lengths = "all => all.map(one => one.getTotalLength())"
    assert max(page.locator(".pen .ink").evaluate_all(lengths)) > 4 * tick
    page.clock.run_for(5000)
    assert pens.count() == 0
    assert page.locator(".unwritten").count() == 0
    assert marked(page, "new") >= {"B"}
    page.keyboard.press("ArrowLeft")
    assert pens.count() == 0


# --- keys and addresses --------------------------------------------------------------------------


def test_keys_go_through_the_steps(kept: Opened, pages: Path):
    page = kept(pages / "pump.html", "#step=0", **DESKTOP)
    last = page.evaluate(STEPS)
    found = []
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft", "End", "ArrowRight", "Home", "2", "7"):
        page.keyboard.press(key)
        found.append(step_of(page))
    assert found == [1, 2, 1, last, last, 0, 5, 37]
    assert page.locator(".halo .similar").count() == 2  # the triangles of a pole, and their angles
    assert page.locator(".halo .angle").count() == 6
    page.keyboard.press("ArrowLeft")
    assert page.locator(".halo .similar").count() == 0


def test_an_address_leads_to_its_step_and_place(kept: Opened, pages: Path):
    page = kept(pages / "pump.html", "#step=0", **DESKTOP)
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
        assert 0 <= step_of(page) <= page.evaluate(STEPS)


def test_a_number_in_an_address_is_as_if_it_were_dragged(kept: Opened, pages: Path):
    """n leads the driver, and all else, to where `solve` has them; a place beside it holds."""
    page = kept(pages / "pump.html", "#step=0", **DESKTOP)
    address = (pages / "pump.html").as_uri()
    for n in (10, 25):
        page.goto(f"{address}#step=42&set=n:{n}")
        mechanism = load("pump", n=n)
        assert page.locator("#driven").inner_text() == f"{30 + 2 * n}.0°"
        size = words("en").significant(abs(mechanism.solve().points["D"].acceleration))
        assert page.locator("[data-row='a_D'] td").last.inner_text() == size
        assert f"aD = {size} m/s" in page.locator("#values").inner_text()
    page.goto(f"{address}#step=42&x=80&set=n:10")
    assert page.locator("#driven").inner_text() == "80.0°"
    page.locator("#back").click()


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


def test_points_move_to_where_python_draws_them(opened: Opened, pages: Path):
    page, mechanism = opened(pages / "pump.html", **DESKTOP), load("pump")
    page.goto(f"{(pages / 'pump.html').as_uri()}#step=99&x=20")
    compared = 0
    for place, sheet in enumerate(screen_sheets(mechanism, "en")):
        values = moved(sheet.drawing, mechanism, 20.0).values
        for side, field in enumerate((sheet.layout.mechanism, sheet.layout.plan)):
            view = page.locator(f"#sheet-{place} .view").nth(side)
            for step, x, y in view.evaluate(CIRCLES):
                if isinstance(values.get(step), complex):
                    assert (x, y) == pytest.approx(field(values[step]), abs=0.01), step
                    compared += 1
    assert compared > 10


def test_tables_margins_and_line_follow_the_driver(kept: Opened, pages: Path):
    page, mechanism = kept(pages / "pump.html", "#step=0", **DESKTOP), load("pump")
    before = page.locator("[data-row='v_D'] td").all_inner_texts()
    page.goto(f"{(pages / 'pump.html').as_uri()}#step=7&x=80")
    sheet = screen_sheets(mechanism, "en")[0]
    trace = moved(sheet.drawing, mechanism, 80.0)
    speed = abs(trace.value("velocity", "D"))
    spoken = words("en")
    _, length, size = page.locator("[data-row='v_D'] td").all_inner_texts()
    assert length == spoken.fixed(1000 * speed / sheet.drawing.scales.kv, 2)
    assert size == spoken.significant(speed)
    assert before[2] != size
    (b,) = (found for found in crossings(trace) if found.name == "b")
    told = f"b: the lines cross at {degrees_of(b.angle):.0f}°, "
    told += f"a 1 mm drawing error grows to as much as {b.factor:.1f} mm"
    assert page.locator("#crossing").inner_text() == told
    page.keyboard.press("4")
    assert f"vD = {size} m/s" in page.locator("#values").inner_text()
    for link in "234":
        omega = trace.value("omega", link)
        sense = spoken("page.anticlockwise" if omega > 0 else "page.clockwise")
        row = page.locator(f"[data-row='ω{link}'] td")
        assert row.all_inner_texts() == [spoken.significant(abs(omega)), sense]
    page.locator("#steps a[data-number='15']").click()
    told = page.locator("#sentence")
    omega = spoken.significant(abs(trace.value("omega", "3")))
    assert told.inner_text() == f"ω3 = vBA/AB = {omega} rad/s, counter-clockwise"
    page.locator("#back").click()
    assert told.inner_text() == "ω3 = vBA/AB = 11.059/0.4 = 27.65 rad/s (counter-clockwise)"
    assert page.locator("[data-row='v_D'] td").all_inner_texts() == before


CHANGED = """([drawn, count]) => [...document.querySelectorAll('#steps li .say')]
  .filter((each, i) => each.innerText !== drawn[i]).length >= count"""
"""Whether so many sentences of the list have changed; the page changes them one after another."""


def test_what_is_read_off_is_the_same_in_the_list_the_tables_and_above_the_keys(
    kept: Opened, pages: Path
):
    """As drawn, once the driver has moved, and drawn again."""
    page = kept(pages / "pump.html", "#step=42", **DESKTOP)
    listed = page.locator("#steps li .say")
    drawn = listed.all_inner_texts()
    page.locator("#driver").fill("154")
    page.wait_for_url("**x=154")
    sizes = {
        row: page.locator(f"[data-row='{row}'] td").first.inner_text()
        for row in ("ω2", "ω3", "ω4", "ε2", "ε3", "ε4")
    }
    page.wait_for_function(CHANGED, arg=[drawn, len(sizes)])
    read = [text for text in listed.all_inner_texts() if text not in drawn]
    assert len(read) == len(sizes)
    for text, (row, size) in zip(read, sizes.items(), strict=True):
        assert text.startswith(f"{row} = ") and f" = {size} rad/s" in text
    assert page.locator("#sentence").inner_text() == read[-1]
    page.locator("#back").click()
    assert listed.all_inner_texts() == drawn


ENDS = """() => [...document.querySelectorAll('.sheet:not([hidden]) .view > svg')].map(svg => {
  const { left, right, top, bottom } = svg.getBoundingClientRect(), matrix = svg.getScreenCTM();
  const off = ({ x, y }) => x < left - 1 || x > right + 1 || y < top - 1 || y > bottom + 1;
  const lines = [...svg.querySelectorAll('line[data-of]:not(.later,.void,.leader,[visibility])')];
  const cut = lines.filter(line => {
    const [p, q] = ['1', '2'].map(end => new DOMPoint(...['x', 'y'].map(axis =>
      line.getAttribute(axis + end))).matrixTransform(matrix));
    const places = Array.from({ length: 2001 }, (_, i) => i / 2000).map(part =>
      ({ x: p.x + part * (q.x - p.x), y: p.y + part * (q.y - p.y) }));
    return [p, q].some(off) && !places.every(off);
  });
  const marks = [...svg.querySelectorAll('.beyond')].map(mark => mark.getBoundingClientRect());
  const inside = marks.every(({ x, y, width, height }) => !off({ x, y }) ||
    !off({ x: x + width, y: y + height }));
  return [cut.length, marks.length, inside];
})"""
"""Of each field the lines that leave it, and the marks of such."""


def test_lines_that_leave_the_field_are_marked_at_its_edge(opened: Opened, tmp_path: Path):
    """Near a dead point the plans of the trials have no room; as drawn, no line leaves."""
    path = tmp_path / "crank.html"
    path.write_text(step_page(mechanism_of("stephenson-3-crank"), "en"), encoding="utf-8")
    page = opened(path, "#step=99", stopped=True, **DESKTOP)
    assert page.evaluate(ENDS) == [[0, 0, True]] * 2
    page.locator("#driver").fill("70")
    page.clock.run_for(1000)
    mechanism, plan = page.evaluate(ENDS)
    assert mechanism[0] >= 1 and plan[0] > 5
    for lines, marks, inside in (mechanism, plan):
        assert lines <= marks <= 2 * lines and inside
    page.locator("#back").click()
    page.clock.run_for(1000)
    assert page.evaluate(ENDS) == [[0, 0, True]] * 2


def test_at_a_dead_point_no_vector_is_drawn_that_hangs_on_it(kept: Opened, pages: Path):
    page = kept(pages / "pump.html", "#step=16&x=9999", **DESKTOP)
    seen = """name => [...document.querySelectorAll(`.sheet:not([hidden]) [data-name='${name}']`)]
      .filter(mark => mark.checkVisibility({ visibilityProperty: true })).length"""
    assert page.evaluate(seen, "v_D") == 0
    assert page.evaluate(seen, "d") == 0
    assert page.evaluate(seen, "v_A") > 0
    assert page.evaluate(seen, "D") > 0
    page.locator("#back").click()
    assert page.evaluate(seen, "v_D") > 0


# --- sizes and looks -----------------------------------------------------------------------------


LOOKS = (
    {"color_scheme": "light"},
    {"color_scheme": "dark"},
    {"forced_colors": "active"},
    {"reduced_motion": "reduce"},
)
SIZES = {(1440, 900): 0.60, (1280, 720): 0.60, (820, 1180): 0.45}
"""The least part of a window's height that the drawings take."""
LEAST = """() => Math.min(...[...document.querySelectorAll(
    '.sheet:not([hidden]) .view > svg .lettering > text:not(.later,.void,[visibility],.hushed)')]
  .flatMap(text => {
    const { a, b, c, d } = text.getScreenCTM(), scale = Math.sqrt(a * d - b * c);
    const runs = [text, ...text.querySelectorAll('tspan')].filter(run => run.textContent.trim());
    return runs.map(run => parseFloat(getComputedStyle(run).fontSize) * scale);
  }))"""
PINS = """() => [...document.querySelectorAll(
    '.sheet:not([hidden]) .view:first-of-type > svg circle.pin')]
  .map(({ dataset: { name } }) => name)
  .filter(name => ![...document.querySelectorAll(
    `.sheet:not([hidden]) .lettering > text[data-name='${name}']`)]
    .some(text => !text.matches('.later,.void,[visibility],.hushed')))"""
"""The pins of the mechanism whose letters are not seen."""
COLOURS = """() => ['#new-key', '#from-key', '#reason .line', '#reason .line',
    '#steps [aria-current]', '#steps a'].map(name => getComputedStyle(document.querySelector(name)))
  .map((style, i) => style[['backgroundColor', 'borderLeftColor', 'outlineStyle'][i >> 1]])"""


def test_every_size_and_look_has_room_and_letters_to_be_read(opened: Opened, pages: Path):
    """Firefox asks axe of each."""
    page = opened(pages / "pump.html", "#step=9", **MOVING)
    for size, part in SIZES.items():
        page.set_viewport_size(dict(zip(("width", "height"), size, strict=True)))
        for look in LOOKS if EVERY or part < 0.6 else LOOKS[:1]:
            page.emulate_media(color_scheme=None, forced_colors=None, reduced_motion=None)
            page.emulate_media(**look)
            page.evaluate("Promise.all(document.getAnimations().map((each) => each.finished))")
            field = page.locator("#sheet-0 .view").first
            assert field.evaluate("view => view.clientHeight / innerHeight") >= part
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
            assert page.evaluate("stops.scrollWidth <= stops.clientWidth")
            assert page.evaluate(LEAST) >= 9
            if "forced_colors" in look:
                key_and_row_are_seen(page)


def key_and_row_are_seen(page: Any) -> None:
    """Forced colours keep the key of colours and the row in sight."""
    new, old, reason, _, here, other = page.evaluate(COLOURS)
    assert len({new, old, "rgb(255, 255, 255)", "rgba(0, 0, 0, 0)"}) == 4
    assert reason == new
    assert here == "solid" and other == "none"
    inside = """() => { const list = steps.getBoundingClientRect();
      const { top, bottom } = steps.querySelector('[aria-current]').getBoundingClientRect();
      return top >= list.top && bottom <= list.bottom; }"""
    assert page.evaluate(inside)


@pytest.mark.parametrize("name", ["pump", "stephenson-3"] if EVERY else ["stephenson-3"])
def test_letters_can_be_read_on_a_phone_and_those_of_pins_are_there(
    opened: Opened, tmp_path: Path, name: str
):
    path = tmp_path / f"{name}.html"
    path.write_text(step_page(mechanism_of(name), "en"), encoding="utf-8")
    page = opened(path, "", **PHONE)
    last = page.evaluate(STEPS)
    for step in (last // 3, last // 2, last):
        page.evaluate(f"location.hash = '#step={step}'")
        page.wait_for_function(f"document.getElementById('step').value === '{step}'")
        assert page.evaluate(LEAST) >= 9
    assert page.evaluate(PINS) == []


CUT = """() => [...document.querySelectorAll(
    '.sheet:not([hidden]) .view > svg .lettering > text:not(.later,.void,[visibility],.hushed)')]
  .filter(text => {
    const { x, y, width, height } = text.getBBox(), to = text.getScreenCTM();
    const field = text.ownerSVGElement.getBoundingClientRect();
    const ends = [[x, y], [x + width, y + height]].map(end => new DOMPoint(...end));
    const [low, high] = ends.map(end => end.matrixTransform(to));
    return low.x < field.left - 1 || high.x > field.right + 1 ||
      low.y < field.top - 4 || high.y > field.bottom + 4;
  }).map(text => text.dataset.name)"""
"""The labels that the edge of their field cuts, but for the air above and below letters."""


@pytest.mark.parametrize(
    "name", ["bar-on-roller", "centrodes-knee", "instant-centres", "locomotive"]
)
def test_no_label_is_cut_by_the_edge_of_a_narrow_field(opened: Opened, tmp_path: Path, name: str):
    """Labels that are drawn larger than on paper, one on another side, long notes."""
    path = tmp_path / f"{name}.html"
    path.write_text(step_page(mechanism_of(name), "en"), encoding="utf-8")
    narrow = DESKTOP | {"viewport": {"width": 1000, "height": 720}}
    page = opened(path, "", **narrow)
    cut = {}
    for step in range(1, page.evaluate(STEPS) + 1):
        page.evaluate(f"location.hash = '#step={step}'")
        page.wait_for_function(f"document.getElementById('step').value === '{step}'")
        if found := page.evaluate(CUT):
            cut[step] = found
    assert not cut


def test_what_is_read_off_on_a_phone_has_room_before_it_is_found(opened: Opened, pages: Path):
    """The keys stay as tall as they were measured, and cover nothing of the drawing."""
    page = opened(pages / "pump.html", "#step=1", **PHONE)
    tall = page.evaluate("document.getElementById('dock').offsetHeight")
    page.evaluate("location.hash = '#step=16'")
    page.wait_for_function("document.getElementById('step').value === '16'")
    assert "ω4 = " in page.inner_text("#values") and "?" not in page.inner_text("#values")
    assert page.evaluate("document.getElementById('dock').offsetHeight") == tall


# --- every reader --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "shape"),
    [("pump", "dark"), ("pump-task", "phone")],
)
def test_axe_finds_nothing_against_the_page(opened: Opened, pages: Path, name, shape):
    page = opened(pages / f"{name}.html", **SHAPES[shape])
    page.keyboard.press("2")
    page.evaluate("Promise.allSettled(document.getAnimations().map((each) => each.finished))")
    assert not barred(page)


def test_words_that_have_no_room_are_scrolled_by_keys(opened: Opened, pages: Path):
    """A sentence is reached by Tab where it is longer than its box, on a phone held sideways."""
    page = opened(pages / "pump.html", viewport={"width": 844, "height": 390})
    reached = set()
    for step in (0, 3, 9, 15):
        page.evaluate(f"location.hash = '#step={step}'")
        page.evaluate(PAINTED)
        scrolls, tab = page.locator("#narration").evaluate(
            "box => [box.scrollHeight > box.clientHeight + 1, box.tabIndex]"
        )
        assert tab == (0 if scrolls else -1), step
        reached.add(tab)
    assert reached == {0, -1}


def test_without_a_script_it_is_the_finished_drawing_with_its_list(opened: Opened, pages: Path):
    page = opened(pages / "pump.html", **DESKTOP, java_script_enabled=False)
    assert page.locator(".sheet").count() == 2
    assert all(sheet.is_visible() for sheet in page.locator(".sheet").all())
    assert page.locator("#steps li").count() == 42
    assert page.locator("#dock, button, input").count() == 0
    assert all(mark.is_visible() for mark in page.locator("circle.point").all())


def test_hostile_names_do_nothing(opened: Opened, pages: Path):
    page = opened(pages / "nasty.html", **DESKTOP)
    with heard(page, "dialog") as dialogs:
        page.keyboard.press("End")
        assert "alert(1)" in page.locator("h1").inner_text()
        assert page.locator("header script, main script").count() == 0
        page.evaluate("Promise.allSettled(document.getAnimations().map((each) => each.finished))")
    assert not dialogs, "a name was run"


# --- sentences while the page moves ---------------------------------------------------------------

FASTER = """
graphkin = 1
title = "Slider-crank of any speed"
units = { length = "mm", angle = "deg", speed = "rev/min" }
[parameters]
n1 = { value = 90, min = 60, max = 150, step = 10 }
[frame]
O = [0, 0]
[links.1]
O-A = 50
[links.2]
A-B = 190
[links.3]
B = [0, 0]
slides = { on = 0, through = [0, -20], angle = 0 }
[[drivers]]
turn = 1
angle = 55
speed = "n1"
[branches]
3 = "forward"
[ask]
velocity = ["B"]
acceleration = ["B"]
"""
"""A crank whose speed can be changed on the page."""


def test_a_sentence_says_the_lengths_of_a_changed_speed(opened: Opened, tmp_path: Path):
    """The scales stay, so that the vectors of the crank pin grow with ω and with its square."""
    made = step_page(Mechanism(read_text(FASTER, "faster", None, {})), "en")
    (tmp_path / "faster.html").write_text(made, encoding="utf-8")
    said = {}
    for address in ("#step=1", "#step=1&x=118", "#step=1&x=118&set=n1:120"):
        page = opened(tmp_path / "faster.html", address, **DESKTOP)
        every = [one.inner_text() for one in page.locator("#steps .say").all()]
        laid = [one for one in every if "lay off" in one and "mm" in one]
        rows = [f"#results [data-row='{row}'] td:nth-of-type(2)" for row in ("v_A", "a_A")]
        said[address] = laid, [page.locator(row).inner_text() for row in rows]
        law = page.locator("#given li").last
        assert law.evaluate("law => law.hidden") is ("set" in address)
    drawn, turned, faster = said.values()
    assert drawn == turned
    for before, after, size, power in zip(drawn[0], faster[0], faster[1], (1, 2), strict=True):
        assert "times as long" in before and "times as long" not in after
        assert f"{size} mm" in after
        length = float(before.split(": ")[-1].split()[0])
        assert float(size) == pytest.approx(length * (120 / 90) ** power, abs=0.01)


def test_all_numbers_are_of_one_place_as_soon_as_the_motion_stops(opened: Opened, tmp_path: Path):
    """The list tells the angular velocity that the table tells, without waiting for a rest."""
    scene = FASTER + "omega = [2]\n"
    made = step_page(Mechanism(read_text(scene, "faster", None, {})), "en")
    (tmp_path / "faster.html").write_text(made, encoding="utf-8")
    page = opened(tmp_path / "faster.html", "#step=1", stopped=True, **MOVING)
    said = page.locator("#steps .say", has_text="ω2 =")
    before = said.inner_text()
    page.locator("#travel").click()
    page.clock.run_for(700)
    page.locator("#travel").click()
    size = page.locator("#results [data-row='ω2'] td:nth-of-type(1)").inner_text()
    after = said.inner_text()
    assert before != after and f" = {size} rad/s" in after


CAM = """
graphkin = 1
title = "Cam on a gear"
units = { length = "mm", angle = "deg", speed = "rev/min" }
module = 3
[frame]
O1 = [0, 0]
O2 = [90, 0]
[links.1]
O1-P = 20
wheel = { centre = "O1", teeth = 20 }
[links.2]
O2-R = 30
wheel = { centre = "O2", teeth = 40 }
rolls = { on = 1 }
[links.3]
B = [0, 0]
slides = { on = 0, through = "O2", angle = 90, offset = 6 }
[links.3.cam]
on = 2
tip = "roller"
base = 38
roller = 9
clockwise = true
law = [
 { to = 110, rise = 24, motion = "modified sine" },
 { to = 170 },
 { to = 280, rise = -24, motion = "cycloidal" },
 { to = 360 },
]
[[drivers]]
turn = 1
angle = 80
speed = 400
[ask]
velocity = ["B"]
acceleration = ["B"]
"""
"""A cam whose centre of curvature lies on its own centre in a dwell."""


def test_a_bar_without_a_length_lays_off_nothing(opened: Opened, tmp_path: Path):
    made = step_page(Mechanism(read_text(CAM, "cam", None, {})), "en")
    (tmp_path / "cam.html").write_text(made, encoding="utf-8")
    page = opened(tmp_path / "cam.html", "#step=1", stopped=True, **DESKTOP)
    said = page.locator("#steps .say", has_text="from K to O2")
    assert said.count() == 1 and " mm" in said.inner_text()
    page.locator("#driver").fill("300")
    page.clock.run_for(1000)
    assert said.count() == 0
    assert page.locator("#steps .say", has_text="k′ falls on o′").count() == 1
