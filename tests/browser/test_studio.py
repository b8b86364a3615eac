"""The studio in a real browser: written, marked, mended, moved, saved; by mouse and by keys."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from graphkin.mechanism import load
from graphkin.scene import scene_files
from graphkin.studio.server import Served
from tests.browser.opening import LONG, barred, heard, put, watched
from tests.studio.pump import BAR, PUMP

DESKTOP = {"viewport": {"width": 1440, "height": 900}}
PHONE = {"viewport": {"width": 390, "height": 844}}
Studio = Callable[..., Any]


@pytest.fixture
def place(tmp_path) -> Path:
    """A folder with one scene."""
    (tmp_path / "mine.toml").write_text(PUMP, encoding="utf-8")
    return tmp_path


@pytest.fixture
def studio(chromium: Any, tabs: Any, place: Path, served: Served) -> Iterator[Studio]:
    """Open the page: studio("?lab=pump", color_scheme="dark"); fails on any error it tells."""
    own = (f"http://127.0.0.1:{served.port}/", "blob:", "data:")
    with watched(chromium, tabs, own, ("error", "warning")) as new_page:

        def opened(query: str = "?scene=mine.toml", **options: Any) -> Any:
            page = new_page(served.address + query, **{**DESKTOP, **options})
            at_rest(page)
            return page

        yield opened


def at_rest(page: Any) -> None:
    """Wait until everything is drawn."""
    page.wait_for_selector("body[data-settled=true] #velocity .drawing svg")


def until(page: Any, holds: str) -> None:
    """Wait until an expression holds; the page itself evaluates no strings."""
    look = f"look = () => ({holds}) ? done(true) : left-- ? setTimeout(look, 20) : done(false)"
    if not page.evaluate(
        f"new Promise(done => {{ let left = {LONG // 20}; const {look}; look(); }})"
    ):
        pytest.fail(f"{holds} never holds")


def opened_as(page: Any, name: str) -> None:
    """Wait until the page of a scene has come in place of another, and everything is drawn."""
    page.wait_for_selector(f"#file[value='{name}']")
    at_rest(page)


def answered(page: Any, work: Callable[[], object]) -> None:
    """Do something, and wait until its answer at rest is shown."""
    before = page.get_attribute("body", "data-shown")
    work()
    page.wait_for_selector(f"body[data-settled=true]:not([data-shown='{before}'])")


def write(page: Any, old: str, new: str) -> None:
    """Change the text of the scene."""
    text = page.input_value("#text")
    assert old in text
    answered(page, lambda: put(page, "#text", text.replace(old, new, 1)))


def selection(page: Any) -> str:
    """What is selected in the text."""
    return page.evaluate(
        "(() => { const t = document.getElementById('text');"
        " return t.value.slice(t.selectionStart, t.selectionEnd); })()"
    )


def speed_of_d(page: Any) -> float:
    """The velocity of D in the table."""
    row = page.locator("#results tr", has=page.locator("th", has_text=re.compile("^vD$"))).first
    return float(row.locator("td").last.inner_text())


def test_a_mistake_is_marked_at_its_place_and_gone_when_it_is_mended(studio):
    page = studio()
    assert page.inner_text("#count") == "No mistakes."
    top = page.locator("#drawings").bounding_box()["y"]
    write(page, "A-B = 40", "A-B = forty")
    assert page.inner_text("#count") == "1 mistake"
    assert page.locator("#drawings").bounding_box()["y"] == top  # nothing jumps while one writes
    assert page.locator("#scene-part .gutter .wrong").all_inner_texts() == [str(BAR)]
    assert page.inner_text("#scene-part .under mark") == "forty"
    assert page.is_visible("#old")
    english = page.inner_text("#problems")
    for language, words in (("ro", "aici stă un număr"), ("it", "qui sta un numero")):
        page.select_option("#language", language)
        page.locator("#problems", has_text=words).wait_for(timeout=LONG)
        page.wait_for_selector("body[data-settled=true]", timeout=LONG)
    page.select_option("#language", "en")
    page.locator("#problems", has_text="a number, in the unit").wait_for(timeout=LONG)
    assert page.inner_text("#problems") == english
    page.click("#problems button")
    assert selection(page) == "forty"
    page.keyboard.type("40")
    page.wait_for_selector("#count:not(.wrong)")
    assert page.inner_text("#count") == "No mistakes."
    assert page.locator("#scene-part .gutter .wrong").count() == 0
    assert not page.is_visible("#old")


def test_a_slider_moves_drawings_and_numbers_and_each_drawing_is_saved(studio, tmp_path):
    """A saved file looks the same alone; many quick moves end at the last."""
    page = studio()
    before = page.inner_html("#velocity .drawing svg")
    slider = page.get_by_label("n", exact=True)
    slider.focus()
    answered(page, lambda: [slider.press("ArrowRight") for _ in range(5)])
    until(page, "document.getElementById('value-n').value === '12'")
    page.wait_for_selector("body[data-settled=true]")
    velocity = abs(load("pump", n=12).solve().points["D"].velocity)
    assert speed_of_d(page) == pytest.approx(velocity, rel=1e-3)
    assert page.inner_html("#velocity .drawing svg") != before
    row = page.locator("#results tr", has=page.locator("th", has_text=re.compile("^vD$"))).first
    millimetres = float(row.locator("td").nth(1).inner_text())
    drawn = page.evaluate(
        "[...document.querySelectorAll('#velocity .drawing line.velocity[data-name=od]')].map(l =>"
        " Math.hypot(l.x2.baseVal.value - l.x1.baseVal.value,"
        " l.y2.baseVal.value - l.y1.baseVal.value))"
    )
    assert any(abs(length - millimetres) < 0.01 for length in drawn), (drawn, millimetres)
    assert slider.get_attribute("aria-valuetext") == "12"
    answered(page, lambda: page.click("#reset"))
    assert page.input_value("#value-n") == "7"
    assert page.inner_html("#velocity .drawing svg") == before
    other = page.context.browser.new_page()
    strokes = (
        "(svg) => [...svg.querySelectorAll('path, line, circle, text')].map((each) => {"
        " const { stroke, strokeWidth, fill, fontSize, fontFamily } = getComputedStyle(each);"
        " return [stroke, strokeWidth, fill, fontSize, fontFamily.split(',')[0]]; })"
    )
    for name in ("mechanism", "velocity", "acceleration"):
        with page.expect_download() as taken:
            page.click(f"#{name} .take")
        assert taken.value.suggested_filename == f"{name}.svg"
        file = tmp_path / f"{name}.svg"
        taken.value.save_as(file)
        svg = ElementTree.parse(file).getroot()
        width, height = svg.get("viewBox").split()[2:]
        assert (svg.get("width"), svg.get("height")) == (f"{width}mm", f"{height}mm")
        here = page.eval_on_selector(f"#{name} .drawing svg", strokes)
        other.goto(file.as_uri())
        assert other.eval_on_selector("svg", strokes) == here
    other.close()
    with heard(page, "request") as asked:
        answered(
            page,
            lambda: page.evaluate(
                "(() => { const s = document.getElementById('slider-n');"
                " for (let i = 0; i < 200; i++) { s.value = String(i % 30);"
                " s.dispatchEvent(new Event('input')); } })()"
            ),
        )
    assert len(asked) < 10
    assert page.input_value("#value-n") == "20"
    velocity = abs(load("pump", n=20).solve().points["D"].velocity)
    assert speed_of_d(page) == pytest.approx(velocity, rel=1e-3)


def test_one_history_holds_typing_sliders_and_acts_in_their_order(studio):
    page = studio()
    at_rest(page)
    answered(page, lambda: write(page, "Pump mechanism", "A pump"))
    typed = page.input_value("#text")
    page.focus("#slider-n")
    answered(page, lambda: page.keyboard.press("ArrowRight"))
    until(page, "document.querySelector('#value-n').value === '8'")
    answered(page, lambda: page.click("#build"))
    page.check("#tools input[value='pivot']")
    box = page.locator("#canvas svg").bounding_box()
    answered(page, lambda: page.mouse.click(box["x"] + 30, box["y"] + 30))
    built = page.input_value("#text")
    assert "O3 = " in built
    answered(page, lambda: page.click("#undo"))
    assert (page.input_value("#text"), page.input_value("#value-n")) == (typed, "8")
    answered(page, lambda: page.click("#undo"))
    assert (page.input_value("#text"), page.input_value("#value-n")) == (typed, "7")
    answered(page, lambda: page.click("#undo"))
    while page.input_value("#text") != PUMP:
        answered(page, lambda: page.click("#undo"))
    for _ in range(9):
        page.click("#redo")
    until(page, "document.querySelector('#value-n').value === '8'")
    assert page.input_value("#text") == built
    answered(page, lambda: page.click("#write"))
    assert "n = { value = 8, min = 1" in page.input_value("#text")
    assert page.is_disabled("#reset")
    page.focus("#text")
    answered(page, lambda: page.keyboard.press("Control+z"))
    assert (page.input_value("#text"), page.input_value("#value-n")) == (built, "8")
    answered(page, lambda: page.keyboard.press("Control+Shift+z"))
    assert "n = { value = 8, min = 1" in page.input_value("#text")
    answered(page, lambda: page.keyboard.press("Control+z"))
    answered(page, lambda: page.keyboard.press("Control+y"))
    assert "n = { value = 8, min = 1" in page.input_value("#text")


def test_a_scene_is_saved_where_it_was_opened_and_no_other_is_replaced_unasked(studio, place):
    page = studio()
    (place / "other.toml").write_text(PUMP, encoding="utf-8")
    for before, after in ((20, 21), (21, 22)):
        write(page, f"C-D = {before}", f"C-D = {after}")
        assert page.inner_text("#status") == "not saved"
        page.keyboard.press("Control+s")
        said(page, "Saved: mine.toml")
        assert f"C-D = {after}" in (place / "mine.toml").read_text(encoding="utf-8")
        assert not page.is_visible("#asking")
    page.fill("#file", "other")
    page.click("#save")
    page.wait_for_selector("#asking[open]")
    assert page.inner_text("#question").startswith("There already: other.toml.")
    page.click("#no")
    assert (place / "other.toml").read_text(encoding="utf-8") == PUMP
    page.click("#save")
    page.click("#yes")
    said(page, "Saved: other.toml")
    assert page.input_value("#file") == "other.toml"
    assert "C-D = 22" in (place / "other.toml").read_text(encoding="utf-8")
    (place / "other.toml").unlink()
    put(page, "#text", page.input_value("#text") + "# more\n")
    page.locator("#status.poor", has_text="is not on the disk any more").wait_for()
    page.click("#save")
    said(page, "Saved: other.toml")
    assert (place / "other.toml").read_text(encoding="utf-8").endswith("# more\n")


def moved(page: Any, value: str) -> None:
    """Give the parameter another value than the text says."""
    answered(page, lambda: (page.fill("#value-n", value), page.press("#value-n", "Enter")))


def said(page: Any, words: str) -> None:
    """Wait until the page says something at its top."""
    until(page, f"document.getElementById('status').textContent.includes({words!r})")


def test_values_of_sliders_are_saved_or_not_as_it_is_answered(studio, place):
    page = studio()
    moved(page, "12")
    page.click("#save")
    page.wait_for_selector("#asking[open]")
    assert "n = 12; the text says n = 7" in page.inner_text("#question")
    page.click("#no")
    assert page.input_value("#text") == PUMP
    page.fill("#file", "text.toml")
    page.click("#save")
    page.get_by_role("button", name="Save the text as it is").click()
    said(page, "Saved: text.toml; as the text says, with n = 7; what the sliders show, n = 12,")
    assert (place / "text.toml").read_text(encoding="utf-8") == PUMP
    page.fill("#file", "moved.toml")
    page.click("#save")
    page.get_by_role("button", name="Write n = 12 into the text and save").click()
    said(page, "Saved: moved.toml; n = 12 written into it")
    text = (place / "moved.toml").read_text(encoding="utf-8")
    assert text == PUMP.replace("value = 7", "value = 12")
    assert page.input_value("#text") == text
    with page.expect_response("**/save"):
        page.keyboard.press("Control+s")
    assert not page.is_visible("#asking")


def test_labs_and_scenes_are_opened_after_asking_for_what_is_not_saved(studio):
    page = studio()
    write(page, "C-D = 20", "C-D = 21")
    page.click("#open")
    page.get_by_role("button", name="slotted-lever").click()
    assert "not saved" in page.inner_text("#question")
    page.click("#no")
    assert "C-D = 21" in page.input_value("#text")
    page.click("#open")
    page.get_by_role("button", name="slotted-lever").click()
    page.click("#yes")
    opened_as(page, "slotted-lever.toml")
    page.click("#new")
    opened_as(page, "new.toml")
    assert page.inner_text("#count") == "No mistakes."


def test_it_can_be_used_by_keys_alone(studio, place):
    page = studio()

    def tab_to(selector: str) -> None:
        for _ in range(60):
            page.keyboard.press("Tab")
            if page.evaluate(f"document.activeElement.matches({selector!r})"):
                return
        pytest.fail(f"{selector} is not reached")

    tab_to("#text")
    page.keyboard.press("Control+Home")
    line = "document.getElementById('text').value.slice(0, text.selectionStart).split('\\n').length"
    while page.evaluate(line) < BAR:
        page.keyboard.press("ArrowDown")
    page.keyboard.press("End")
    answered(page, lambda: page.keyboard.type(",5"))
    tab_to("#problems button")
    page.keyboard.press("Enter")
    assert selection(page) == ",5"
    answered(page, lambda: page.keyboard.press("Delete"))
    assert page.inner_text("#count") == "No mistakes."
    tab_to("#slider-n")
    answered(page, lambda: page.keyboard.press("ArrowRight"))
    assert page.input_value("#value-n") == "8"
    tab_to("#write")
    answered(page, lambda: page.keyboard.press("Enter"))
    assert "value = 8" in page.input_value("#text")
    tab_to("#shown input")
    answered(page, lambda: page.keyboard.press("ArrowRight"))
    tab_to("#numbers")
    tab_to("#file")
    page.keyboard.press("Control+a")
    page.keyboard.type("other.toml")
    page.keyboard.press("Control+s")
    until(page, "document.getElementById('status').textContent === 'Saved: other.toml'")
    assert "value = 8" in (place / "other.toml").read_text(encoding="utf-8")
    page.keyboard.press("Shift+Tab")
    assert page.evaluate("document.activeElement.id") == "open"
    page.keyboard.press("Enter")
    page.wait_for_selector("#opening[open]")
    page.keyboard.press("Escape")
    assert page.evaluate("document.activeElement.id") == "open"


def test_what_is_not_saved_is_kept_over_a_reload_and_replaces_no_newer_file(studio, place):
    page = studio()
    write(page, "C-D = 20", "C-D = 21")
    (place / "mine.toml").write_text(PUMP.replace("A-B = 40", "A-B = 41"), encoding="utf-8")
    page.reload()
    at_rest(page)
    assert "C-D = 21" in page.input_value("#text")
    assert page.inner_text("#status") == "not saved"
    page.click("#save")
    page.wait_for_selector("#asking[open]")
    assert "A-B = 41" in page.inner_text("#asked-lines")
    page.click("#no")
    assert "A-B = 41" in (place / "mine.toml").read_text(encoding="utf-8")
    page.click("#save")
    page.click("#yes")
    said(page, "Saved: mine.toml")
    page.reload()
    at_rest(page)
    assert "C-D = 21" in page.input_value("#text")
    assert page.inner_text("#status") == ""


def test_a_scene_that_is_gone_from_the_disk_is_not_lost_with_it(studio, place):
    """Saved or not, what this tab has shown is in the text again; another says what to do."""
    page = studio()
    (place / "mine.toml").unlink()
    page.reload()
    page.locator("#status.poor", has_text="mine.toml is not on the disk any more").wait_for()
    at_rest(page)
    assert page.input_value("#text") == PUMP
    write(page, "C-D = 20", "C-D = 21")
    page.reload()
    at_rest(page)
    assert "C-D = 21" in page.input_value("#text")
    other = page.context.new_page()
    other.goto(page.url)
    other.locator("#status.poor", has_text="this tab keeps nothing of it").wait_for()
    assert other.is_visible("#open") and other.input_value("#file") == "mine.toml"
    other.close()
    page.click("#save")
    said(page, "Saved: mine.toml")
    assert "C-D = 21" in (place / "mine.toml").read_text(encoding="utf-8")


def test_each_field_shows_its_drawing_whole(studio):
    page = studio("?lab=slotted-lever")
    for width, height in ((1440, 900), (1280, 720), (820, 1180)):
        page.set_viewport_size({"width": width, "height": height})
        fields = page.evaluate(
            """[...document.querySelectorAll(".drawing")].map((field) => {
              const [inner, outer] = [field.querySelector("svg"), field].map((each) => {
                const { x, y, right, bottom } = each.getBoundingClientRect();
                return [x, y, -right, -bottom];
              });
              return inner.map((edge, i) => edge - outer[i]);
            })"""
        )
        assert len(fields) == 3
        assert min(min(edges) for edges in fields) > -1
        text, drawings = (
            page.locator(part).bounding_box() for part in ("#scene-part", "#drawings")
        )
        beside = text["x"] + text["width"] <= drawings["x"]
        assert beside or text["y"] + text["height"] <= drawings["y"]


def test_hostile_titles_are_shown_as_text(studio, place):
    evil = "<img src=x onerror=alert(1)><script>alert(2)</script>"
    text = PUMP.replace('en = "Pump mechanism"', f'en = "{evil}"') + f"# </textarea>{evil}\n"
    (place / "evil.toml").write_text(text, encoding="utf-8")
    page = studio("?scene=evil.toml")
    assert page.inner_text("#title") == evil
    assert page.input_value("#text") == text
    assert page.locator("img").count() == 0
    assert page.locator("script").count() == 1


def test_axe_finds_nothing_against_the_page(studio):
    page = studio(**PHONE, color_scheme="dark")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    write(page, 'velocity = ["D"]', 'velocity = ["Q"]')
    assert not barred(page)
    page.click("#sheets")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_sheets_are_saved_and_the_scene_is_not(studio):
    """What is written and not saved is told beside the names of the sheets."""
    page = studio()
    write(page, 'velocity = ["D"]', 'velocity = ["C"]')
    page.click("#sheets")
    page.uncheck("[name=formats][value=pdf]")
    page.click("#draw")
    page.locator("#status").filter(has_text="Saved: ").wait_for()
    assert page.inner_text("#status").endswith(".svg; mine.toml: not saved")


def test_the_mechanism_is_moved_within_the_page(studio):
    """Played by its driver beside its curves, led to a dead point, and dragged step by step; what
    is written is followed."""
    page = studio()
    page.click("#move")
    moving = page.frame_locator("#moving")
    chart, frame = moving.locator("#curves figure").first.bounding_box(), page.locator("#moving")
    assert chart["y"] + chart["height"] <= sum(map(frame.bounding_box().get, ("y", "height")))
    dead = moving.locator("#notable button").first
    dead.click()
    assert dead.get_attribute("title").startswith("−32.6°: dead point")
    low = moving.locator("#position").inner_text()
    moving.locator("#play").click()
    moving.locator("#position").filter(has_not_text=re.compile(f"^{re.escape(low)}$")).wait_for()
    moving.locator("#play").click()
    assert not page.is_visible("#motion-driver")
    five_bar = scene_files.examples()["five-bar"].read_text("utf-8")
    put(page, "#text", five_bar)
    page.select_option("#motion-driver", label="turn = 4")
    moving.locator("#at[max='360']").wait_for()
    page.check("#motion-kind [value=steps]")
    moving.locator("#turn").wait_for()
    assert moving.locator("#count").inner_text().startswith("Step 1 of ")
    assert not page.is_visible("#motion-driver")
    page.check("#motion-kind [value=positions]")
    moving.locator("svg [data-name='path B']").first.wait_for()
    page.click("#sheets")
    page.locator("#saving[open]").wait_for()
    assert page.input_value("#view") == "positions"
    page.click("#saving .close")
    page.click("#move")
    assert page.locator("#mechanism").is_visible()


BOXES = """() => Object.fromEntries(Object.entries({
    editor: "#scene-part .editor", list: "#scene-part .mistakes", offered: "#offered",
    line: "#scene-part .under > :last-child" }).map(([name, part]) => {
  const { left, top, right, bottom } = document.querySelector(part).getBoundingClientRect();
  return [name, [left, top, right, bottom]];
}))"""


def test_mistakes_leave_the_editor_its_room_and_the_caret_in_sight(studio):
    """Also of whoever writes at the end of a long text, where words are offered above the line."""
    page = studio()
    before = page.evaluate(BOXES)["editor"]
    page.focus("#text")
    page.keyboard.press("Control+End")
    answered(page, lambda: page.keyboard.type("\n[links.6]\nA-B = -1\nC-D = -2\nQ = 3\nR = 4\n"))
    assert page.locator("#problems li").count() > 2
    list_of = page.locator("#problems")
    list_of.evaluate("list => { list.scrollTop = list.scrollHeight; }")
    last, part = list_of.locator("li").last.bounding_box(), page.evaluate(BOXES)["list"]
    assert last["y"] + last["height"] <= part[3] + 1
    page.keyboard.type("sl")
    page.locator("#offered li").first.wait_for()
    boxes = page.evaluate(BOXES)
    assert boxes["editor"] == before
    assert before[1] <= boxes["line"][1] and boxes["line"][3] <= before[3] + 1  # of its leading
    assert before[1] <= boxes["offered"][1] and boxes["offered"][3] <= before[3]
    assert boxes["offered"][3] <= boxes["line"][1] or boxes["offered"][1] >= boxes["line"][3]


def test_what_is_written_is_completed_and_mended(studio):
    """A key is offered as it is begun, a name within its quotes; what has a hint is mended with a
    click; a mark of the mechanism leads to where it is written."""
    page = studio()
    before = page.input_value("#text")
    page.locator("#mechanism .drawing [data-name='A']").last.click()
    chosen = "text => text.value.slice(text.selectionStart, text.selectionEnd)"
    assert page.locator("#text").evaluate(chosen) == "O1-A = 30"
    page.keyboard.press("Control+End")
    page.keyboard.type("[links.6]\nsl")
    assert page.locator("#offered li").all_inner_texts() == ["slides"]
    page.dispatch_event("#text", "scroll")  # a long text moves as one writes at its end
    page.keyboard.press("Enter")
    page.keyboard.type(" = { on = 0, thr")
    page.keyboard.press("Tab")
    page.keyboard.type(' = "O')
    assert page.locator("#offered li").all_inner_texts() == ["O1", "O2"]
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    assert page.input_value("#text").endswith('slides = { on = 0, through = "O2')
    put(page, "#text", before.replace("omega =", "omga =").replace("O1-A = 30", "O1-A = 30 cm"))
    for _ in range(2):
        page.locator(".mend").first.click()
        page.wait_for_selector("body[data-settled=true]")
    assert page.input_value("#text") == before
    assert page.inner_text("#count") == "No mistakes."
    colours = page.locator(".under span span").evaluate_all(
        "all => new Set(all.map((each) => getComputedStyle(each).color)).size"
    )
    assert colours > 3


FOUR_BAR_LINK = "https://app.pmksplus.com/?2P.Fe.K,0.1011.MA,A,0,0,0.GB,B,0,Fe,0.KC,C,ku,0,0.GD,D,0RF,Oj,0.HP,P,0,Fe,0,CD,C,D..YRAB,AB,Fe,Fe,0,7q,c5cae9,A,B,,.YRCD,CD,Fe,Fe,9q,CN,303e9f,C,D,,.YPBP,BP,Fe,0,0,0,,B,P,,...N_r"
TRIANGLE = (
    "<geogebra><construction>"
    + "".join(
        f'<element type="point" label="{name}"><coords x="{x}" y="{y}" z="1"/></element>'
        for name, x, y in (("A", 0, 0), ("B", 20, 30), ("C", 90, 60), ("D", 100, 0))
    )
    + "".join(
        f'<command name="Segment"><input a0="{one}" a1="{other}"/><output a0="s{one}"/></command>'
        for one, other in ("AB", "BC", "CD")
    )
    + "</construction></geogebra>"
)


def test_a_pasted_link_becomes_the_scene_and_can_be_undone(studio: Studio) -> None:
    page = studio()
    before = page.input_value("#text")
    page.evaluate(
        """link => {
          const data = new DataTransfer();
          data.setData("text/plain", link);
          const paste = new ClipboardEvent("paste", { clipboardData: data, cancelable: true });
          document.getElementById("text").dispatchEvent(paste);
        }""",
        FOUR_BAR_LINK,
    )
    until(page, "document.getElementById('text').value.includes('# from PMKS+')")
    at_rest(page)
    assert page.input_value("#file") == "imported.toml"
    page.focus("#text")
    page.keyboard.press("Control+z")
    until(page, "!document.getElementById('text').value.includes('# from PMKS+')")
    assert page.input_value("#text") == before


def test_a_drawing_is_asked_what_is_fixed(studio: Studio, tmp_path: Path) -> None:
    drawing = tmp_path / "bars.ggb"
    with zipfile.ZipFile(drawing, "w") as archive:
        archive.writestr("geogebra.xml", TRIANGLE)
    page = studio()
    page.click("#open")
    page.set_input_files("#import-file", str(drawing))
    page.wait_for_selector("#import-drawing:not([hidden])")
    assert "C (90, 60)" in page.text_content("#import-said")
    page.fill("#import-fixed", "A, D")
    page.fill("#import-drive", "A-B")
    page.click("#import")
    until(page, "document.getElementById('text').value.includes('# from GeoGebra')")
    at_rest(page)
    assert page.input_value("#file") == "bars.toml"


def test_help_opens_the_page_of_the_key_at_the_caret(studio: Studio) -> None:
    page = studio()
    at = page.input_value("#text").index("slides") + 2
    page.evaluate(
        f"find = document.getElementById('text'), find.focus(), find.setSelectionRange({at}, {at})"
    )
    with page.expect_popup() as opening:
        page.keyboard.press("F1")
    manual = opening.value
    manual.wait_for_url("**/manual/reference/scene.html#slides")
    assert "slides" in manual.text_content("main")
    manual.close()
