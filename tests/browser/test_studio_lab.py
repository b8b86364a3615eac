"""A lab in the studio: its rules beside its scene, a class that follows what is written."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest

from graphkin.classroom.lab.read_lab import read_lab
from graphkin.studio.server import Served
from tests.browser.opening import barred, put, watched


@pytest.fixture
def page(chromium: Any, tabs: Any, served: Served) -> Iterator[Any]:
    """An empty studio; fails on any error that the page tells."""
    own = (f"http://127.0.0.1:{served.port}/", "blob:", "data:")
    with watched(chromium, tabs, own, ("error", "warning")) as new_page:
        yield new_page(f"{served.address}?empty=yes", viewport={"width": 1440, "height": 900})


def fairness(page: Any, fair: int, count: int = 30) -> None:
    """Wait until so many of the variants are told to be fair."""
    words = f"{fair} of {count} variants are fair."
    page.locator("#fairness", has_text=re.compile(f"^{words}$")).wait_for()


def test_students_are_looked_at_a_formula_is_mended_and_the_lab_saved(page, served, tmp_path):
    """The map tells who is near to whom, and the sheets of each are drawn; what is written in
    either text is followed; one undo goes through both."""
    page.goto(f"{served.address}?lab=pump&rules=yes")
    fairness(page, 29)
    page.click("#lab")
    page.hover("#neighbours rect[data-own='1'][data-other='0']")
    assert page.inner_text("#pointed") == "1’s right values earn 78 % on the sheet of 2"
    assert page.inner_text("#closest") == "Closest: 1’s right values earn 78 % on the sheet of 2."
    page.click("#students tbody tr:nth-child(5) button")
    page.wait_for_selector("#student-pages img")
    assert page.inner_text("#student") == "Student 5: n = 5"
    pages = page.locator("#student-pages img")
    assert pages.count() == 2
    wide = "image => image.decode().then(() => image.naturalWidth / image.naturalHeight)"
    assert pages.first.evaluate(wide) == pytest.approx(420 / 297, abs=0.01)
    assert not barred(page)
    rules, scene = page.input_value("#rules"), page.input_value("#text")
    put(page, "#rules", rules.replace("0.05, 4", "0.04, 4"))
    fairness(page, 30)
    page.click("#rules")
    page.keyboard.press("Control+z")
    fairness(page, 29)
    page.click("#find-ranges")
    page.locator("#advice button").first.click()
    assert page.input_value("#text") == scene.replace("B-C = 25", "B-C = 25.2")
    fairness(page, 30)
    assert page.input_value("#file") == "pump/scene.toml"
    page.click("#save")
    page.locator("#status", has_text="Saved: pump/scene.toml, pump/lab.toml").wait_for()
    saved = read_lab(tmp_path / "pump")
    assert saved.text == rules
    assert "25.2" in (tmp_path / "pump" / "scene.toml").read_text(encoding="utf-8")
    page.reload()
    assert page.input_value("#rules") == rules


def test_a_lab_is_begun_beside_any_scene(page, served):
    page.click("#lab")
    told = page.locator("#fairness.wrong", has_text="expected")
    told.wait_for()
    page.goto(f"{served.address}")
    page.wait_for_selector("body[data-settled=true]")
    page.click("#lab")
    page.locator("#fairness", has_text="of 1000 variants are fair").wait_for()
    assert "[variants.draw]" in page.input_value("#rules")
    assert page.input_value("#file") == "new/scene.toml"
    assert page.inner_text("#rules-count") == "No mistakes."
    put(page, "#rules", page.input_value("#rules").replace("segment = 5", "segment = -5"))
    page.locator("#rules-part .gutter .wrong").wait_for()
    assert page.inner_text("#rules-part .under mark") == "segment = -5"


def test_ranges_are_sought_of_a_whole_lab_alone(page, served):
    """Where the scene or the rules have mistakes, the button says what is to be mended first."""
    page.goto(f"{served.address}?lab=pump&rules=yes")
    page.click("#lab")
    fairness(page, 29)
    for part, first in (("#text", "The scene"), ("#rules", "The rules")):
        text = page.input_value(part)
        assert page.is_enabled("#find-ranges")
        put(page, part, f"{text}\nbroken = ")
        page.locator("#why-no-ranges", has_text=f"{first} ha").wait_for()
        assert page.is_disabled("#find-ranges")
        put(page, part, text)
        page.locator("#find-ranges:enabled").wait_for()
        fairness(page, 29)
        assert page.inner_text("#why-no-ranges") == ""
