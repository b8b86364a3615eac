"""The studio in a real browser: written, marked, mended, moved, saved; by mouse and by keys."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from graphkin.mechanism import load
from graphkin.studio.server import Served, serve
from tests.browser.opening import barred
from tests.studio.pump import PUMP, desk_in, running

DESKTOP = {"viewport": {"width": 1440, "height": 900}}
SMALL = {"viewport": {"width": 1280, "height": 800}}
TABLET = {"viewport": {"width": 1024, "height": 768}}
PHONE = {"viewport": {"width": 390, "height": 844}}
SHAPES = {
    "desktop": DESKTOP,
    "tablet, dark": TABLET | {"color_scheme": "dark"},
    "phone": PHONE,
    "phone, dark": PHONE | {"color_scheme": "dark"},
}
Studio = Callable[..., Any]


@pytest.fixture
def place(tmp_path) -> Path:
    """A folder with one scene."""
    (tmp_path / "mine.toml").write_text(PUMP, encoding="utf-8")
    return tmp_path


@pytest.fixture
def served(place) -> Iterator[Served]:
    """A studio that runs there, in English."""
    session = desk_in(place)
    session.language = "en"
    with running(serve(session)) as found:
        yield found


@pytest.fixture
def studio(chromium: Any, served: Served) -> Iterator[Studio]:
    """Open the page: studio("?lab=pump", color_scheme="dark"); fails on any error it tells."""
    contexts, wrong = [], []
    own = f"http://127.0.0.1:{served.port}/"

    def opened(query: str = "?scene=mine.toml", **options: Any) -> Any:
        context = chromium.new_context(**{**DESKTOP, **options})
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda m: wrong.append(m.text) if m.type in ("error", "warning") else 0)
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("request", lambda r: None if r.url.startswith(own) else wrong.append(r.url))
        page.goto(served.address + query)
        at_rest(page)
        return page

    yield opened
    for context in contexts:
        context.close()
    assert not wrong


def at_rest(page: Any) -> None:
    """Wait until everything is drawn."""
    page.wait_for_selector("body[data-settled=true] #velocity .drawing svg", timeout=20_000)


def until(page: Any, holds: str) -> None:
    """Wait until an expression holds; asked from here, for the page evaluates no strings."""
    for _ in range(1000):
        if page.evaluate(holds):
            return
        page.wait_for_timeout(20)
    pytest.fail(f"{holds} never holds")


def answered(page: Any, work: Callable[[], object]) -> None:
    """Do something, and wait until its answer at rest is shown."""
    before = int(page.get_attribute("body", "data-shown"))
    work()
    until(
        page,
        f"+document.body.dataset.shown > {before} && document.body.dataset.settled === 'true'",
    )


def write(page: Any, old: str, new: str) -> None:
    """Change the text of the scene."""
    text = page.input_value("#text")
    assert old in text
    answered(page, lambda: page.fill("#text", text.replace(old, new, 1)))


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
    write(page, "A-B = 40", "A-B = forty")
    assert page.inner_text("#count") == "1 mistake"
    assert page.locator("#gutter .wrong").all_inner_texts() == ["24"]
    assert page.inner_text("#under mark") == "forty"
    assert page.is_visible("#old")
    page.click("#problems button")
    assert selection(page) == "forty"
    page.keyboard.type("40")
    page.wait_for_selector("#count:not(.wrong)")
    assert page.inner_text("#count") == "No mistakes."
    assert page.locator("#gutter .wrong").count() == 0
    assert not page.is_visible("#old")


def test_every_mistake_is_listed_and_a_click_goes_to_each(studio):
    page = studio()
    write(page, 'velocity = ["D"]', 'velocity = ["D", "Q"]')
    write(page, 'B = "right of A-O2"', 'B = "right of A-Z"')
    write(page, "slides = { on = 0,", "slides = { on = 77,")
    found = page.locator("#problems button")
    assert found.count() == 3
    places = []
    for i in range(3):
        found.nth(i).click()
        places.append(selection(page))
    assert places == ["on = 77", 'B = "right of A-Z"', '"Q"']
    assert page.locator("#gutter .wrong").all_inner_texts() == ["34", "42", "46"]


def test_the_mark_lies_under_the_words_that_are_wrong(studio):
    """The transparent text beneath has the measures of the one that is written."""
    page = studio()
    write(page, "C-D = 20", "C-D = true")
    wrong = page.locator("#gutter .wrong")
    assert page.locator("#under mark").inner_text() == "C-D = true"
    for scroll in (0, 150):
        page.evaluate(f"document.getElementById('text').scrollTop = {scroll}")
        page.wait_for_timeout(50)
        number, mark = wrong.bounding_box(), page.locator("#under mark").bounding_box()
        assert number["y"] == pytest.approx(mark["y"], abs=3)


@pytest.mark.parametrize("shape", list(SHAPES)[::2])
def test_long_lines_are_wrapped_and_what_lies_beneath_is_wrapped_alike(studio, shape):
    """As high in all, and so at every line: what is longer takes more lines in both or neither."""
    page = studio(**SHAPES[shape])
    height = "document.getElementById('{}').scrollHeight"
    written, beneath = (page.evaluate(height.format(name)) for name in ("text", "under"))
    line = page.evaluate("parseFloat(getComputedStyle(text).lineHeight)")
    assert written > line * (PUMP.count("\n") + 2)
    assert written == beneath
    last = [
        page.locator(f"#{name} > span").last.bounding_box()["y"] for name in ("gutter", "under")
    ]
    assert last[0] == pytest.approx(last[1], abs=1)
    assert page.evaluate("document.getElementById('text').scrollWidth <= text.clientWidth")


def test_a_slider_moves_drawings_and_numbers(studio):
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
    assert slider.get_attribute("aria-valuetext") == "12"
    answered(page, lambda: page.click("#reset"))
    assert page.input_value("#value-n") == "7"
    assert page.inner_html("#velocity .drawing svg") == before


def test_the_drawn_vector_is_as_long_as_the_number_says(studio):
    page = studio()
    answered(page, lambda: (page.fill("#value-n", "20"), page.press("#value-n", "Enter")))
    row = page.locator("#results tr", has=page.locator("th", has_text=re.compile("^vD$"))).first
    millimetres = float(row.locator("td").nth(1).inner_text())
    drawn = page.evaluate(
        "[...document.querySelectorAll('#velocity .drawing line.velocity[data-name=od]')].map(l =>"
        " Math.hypot(l.x2.baseVal.value - l.x1.baseVal.value,"
        " l.y2.baseVal.value - l.y1.baseVal.value))"
    )
    assert any(abs(length - millimetres) < 0.01 for length in drawn), (drawn, millimetres)


def test_many_quick_moves_end_at_the_last(studio, served):
    page = studio()
    asked = []
    page.on("request", lambda request: asked.append(request.url))
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


def test_a_value_that_is_not_allowed_is_told_beside_its_field(studio):
    page = studio()
    answered(page, lambda: (page.fill("#value-n", "31"), page.press("#value-n", "Enter")))
    assert page.get_attribute("#value-n", "aria-invalid") == "true"
    assert "out of range" in page.inner_text("#problems")
    answered(page, lambda: (page.fill("#value-n", "30"), page.press("#value-n", "Enter")))
    assert page.get_attribute("#value-n", "aria-invalid") == "false"


def test_values_go_into_the_text_and_back_by_undo(studio):
    page = studio()
    page.fill("#value-n", "12")
    answered(page, lambda: page.press("#value-n", "Enter"))
    answered(page, lambda: page.click("#write"))
    assert "n = { value = 12, min = 1" in page.input_value("#text")
    assert page.is_disabled("#reset")
    answered(page, lambda: page.keyboard.press("Control+z"))
    assert page.input_value("#text") == PUMP
    assert page.input_value("#value-n") == "7"


def test_the_construction_on_the_mechanism_is_chosen(studio):
    page = studio()
    answered(page, lambda: page.check("input[value=acceleration]"))
    assert page.locator("#mechanism [data-name='J3']").count()
    answered(page, lambda: page.check("input[value=velocity]"))
    assert page.locator("#mechanism [data-name='I3']").count()


@pytest.mark.parametrize("shape", [SMALL, TABLET, PHONE])
def test_the_slider_stays_in_sight_of_the_plans(studio, shape):
    page = studio(**shape)
    page.locator("#acceleration .drawing").scroll_into_view_if_needed()
    slider, plan = (page.locator(of).bounding_box() for of in ("#slider-n", "#acceleration"))
    assert 0 <= slider["y"] < plan["y"] < shape["viewport"]["height"]
    answered(page, lambda: page.press("#slider-n", "ArrowRight"))
    after = page.locator("#slider-n").bounding_box()
    assert after["y"] == pytest.approx(slider["y"], abs=2)


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


def test_what_another_has_saved_meanwhile_is_shown_before_it_is_replaced(studio, place):
    page, other = studio(), studio()
    write(other, "A-B = 40", "A-B = 41")
    other.click("#save")
    said(other, "Saved: mine.toml")
    write(page, "C-D = 20", "C-D = 21")
    page.click("#save")
    page.wait_for_selector("#asking[open]")
    assert "mine.toml has been changed elsewhere" in page.inner_text("#question")
    lines = page.inner_text("#asked-lines").splitlines()
    assert [line for line in lines if line[0] in "-+"] == [
        "-A-B = 41",
        "+A-B = 40",
        "-C-D = 20",
        "+C-D = 21",
    ]
    page.click("#no")
    assert "A-B = 41" in (place / "mine.toml").read_text(encoding="utf-8")


def test_why_nothing_was_saved_stays_when_the_drawing_is_new(studio, place):
    """The text with the sliders' values is drawn again while it is saved."""
    page = studio()
    page.fill("#file", "lever.txt")
    moved(page, "12")
    page.click("#save")
    name = "Write n = 12 into the text and save"
    answered(page, lambda: page.get_by_role("button", name=name).click())
    said(page, "the name does not end in .toml")
    answered(page, lambda: page.locator("#shown input[value=acceleration]").check())
    said(page, "the name does not end in .toml")
    assert [path.name for path in place.iterdir()] == ["mine.toml"]
    page.fill("#file", "lever")
    page.click("#save")
    said(page, "Saved: lever.toml")
    assert "value = 12" in (place / "lever.toml").read_text(encoding="utf-8")


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
    page.keyboard.press("Control+s")
    page.wait_for_timeout(100)
    assert not page.is_visible("#asking")


def test_a_slider_that_is_back_where_the_text_has_it_is_not_asked_about(studio):
    page = studio()
    moved(page, "12")
    moved(page, "7.0")
    page.fill("#file", "back.toml")
    page.click("#save")
    said(page, "Saved: back.toml")
    assert page.inner_text("#status") == "Saved: back.toml"


def test_mistakes_that_are_saved_are_told(studio, place):
    page = studio()
    page.fill("#file", "bad.toml")
    write(page, "A-B = 40", "A-B = ")
    page.click("#save")
    said(page, "Saved: bad.toml; 1 mistake (line 24); as it stands it cannot be drawn")
    assert "A-B = \n" in (place / "bad.toml").read_text(encoding="utf-8").replace("  ", "")
    assert "line 24, column 7" in page.inner_text("#problems")
    assert "the value is missing" in page.inner_text("#problems")


def test_sheets_of_what_is_wrong_are_refused_at_once(studio, place):
    page = studio()
    page.fill("#text", page.input_value("#text").replace("A-B = 40", "A-B = forty"))
    page.click("#sheets")
    page.wait_for_selector("#status.wrong")
    said = page.inner_text("#status")
    assert said.startswith("No sheets yet, mend first: line 24, column 7: not TOML: ")
    assert said.count("line 24") == 1
    assert not page.is_visible("#saving")
    assert page.evaluate("document.activeElement.matches('#problems button')")
    assert [path.name for path in place.iterdir()] == ["mine.toml"]


def test_the_language_is_chosen_on_the_page_and_stays(studio, place):
    page = studio()
    write(page, "C-D = 20", "C-D = 21")
    answered(page, lambda: page.select_option("#language", "it"))
    assert page.inner_text("#save") == "Salva la scena"
    assert page.inner_text("#title") == "Meccanismo di pompa"
    assert page.inner_text("#status") == "non salvato"
    assert page.inner_text("#count") == "Nessun errore."
    assert "scala" in page.inner_text("#caption-mechanism")
    assert page.get_attribute("html", "lang") == "it"
    assert page.get_attribute("#mechanism .enlarge", "aria-label") == "Ingrandisci: meccanismo"
    assert page.get_by_label("valore di n").count() == 1
    assert "C-D = 21" in page.input_value("#text")
    page.click("#sheets")
    page.wait_for_selector("#saving[open]")
    assert page.input_value("#sheet-language") == "it"
    assert "n = 7" in page.inner_text("#saving-values")
    page.select_option("#sheet-language", "ro")
    page.get_by_label("PDF").uncheck()
    page.click("#draw")
    page.wait_for_selector("#saving", state="hidden", timeout=20_000)
    assert "Planul vitezelor" in (place / "mine-n7-velocity-key.svg").read_text(encoding="utf-8")
    page.click("#new")
    page.click("#yes")
    until(page, "document.getElementById('file').value === 'new.toml'")
    at_rest(page)
    assert page.inner_text("#save") == "Salva la scena"
    left = page.locator("[data-say]").evaluate_all("all => all.map(each => each.textContent)")
    assert not [words for words in left if not words]


def test_every_word_of_the_page_changes_with_its_language(studio):
    """What is written in it is what a page in that language begins with."""
    begun, changed = studio("?scene=mine.toml&lang=ro"), studio()
    answered(changed, lambda: changed.select_option("#language", "ro"))
    words = "document.body.innerText"
    names = "[...document.querySelectorAll('[aria-label]')].map(e => e.ariaLabel).join()"
    assert begun.evaluate(words) == changed.evaluate(words)
    assert begun.evaluate(names) == changed.evaluate(names)


def test_a_name_that_leads_elsewhere_is_refused(studio, place):
    page = studio()
    page.fill("#file", "../evil.toml")
    page.click("#save")
    page.wait_for_selector("#status.wrong")
    assert "ending in .toml, such as evil.toml" in page.inner_text("#status")
    assert not (place.parent / "evil.toml").exists()


def test_sheets_are_saved(studio, place):
    page = studio()
    page.fill("#value-n", "9")
    answered(page, lambda: page.press("#value-n", "Enter"))
    page.click("#sheets")
    page.get_by_label("PDF").uncheck()
    page.get_by_label("SVG").uncheck()
    page.click("#draw")
    assert page.inner_text("#saving-said") == "Choose at least one kind of file."
    page.get_by_label("SVG").check()
    page.select_option("#view", "task")
    page.click("#draw")
    page.wait_for_selector("#saving", state="hidden", timeout=20_000)
    names = {path.name for path in place.iterdir()}
    assert {"mine-n9-velocity-task.svg", "mine-n9-acceleration-task.svg"} <= names
    assert "mine-n9-velocity-task.svg" in page.inner_text("#status")


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
    until(page, "document.getElementById('file').value === 'slotted-lever.toml'")
    at_rest(page)
    page.click("#open")
    page.get_by_role("button", name="mine.toml").click()
    until(page, "document.getElementById('file').value === 'mine.toml'")
    at_rest(page)
    assert page.input_value("#text") == PUMP
    page.click("#new")
    until(page, "document.getElementById('file').value === 'new.toml'")
    at_rest(page)
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
    while page.evaluate(line) < 24:
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


def test_a_page_that_is_no_longer_served_says_so(chromium, place):
    session = desk_in(place)
    session.language = "en"
    page = chromium.new_page()
    with running(serve(session)) as found:
        page.goto(f"{found.address}?scene=mine.toml")
        at_rest(page)
    page.get_by_label("n", exact=True).press("ArrowRight")
    page.wait_for_selector("#status.wrong")
    assert "has it been stopped" in page.inner_text("#status")
    page.close()


def test_hostile_titles_are_shown_as_text(studio, place):
    evil = "<img src=x onerror=alert(1)><script>alert(2)</script>"
    text = PUMP.replace('en = "Pump mechanism"', f'en = "{evil}"') + f"# </textarea>{evil}\n"
    (place / "evil.toml").write_text(text, encoding="utf-8")
    page = studio("?scene=evil.toml")
    assert page.inner_text("#title") == evil
    assert page.input_value("#text") == text
    assert page.locator("img").count() == 0
    assert page.locator("script").count() == 1


@pytest.mark.parametrize("shape", SHAPES)
def test_axe_finds_nothing_against_the_page(studio, shape):
    page = studio(**SHAPES[shape])
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert not barred(page)
    write(page, 'velocity = ["D"]', 'velocity = ["Q"]')
    assert not barred(page)
    page.click("#open")
    page.wait_for_selector("#labs button")
    assert not barred(page)
    page.keyboard.press("Escape")
    page.click("#sheets")
    assert not barred(page)
