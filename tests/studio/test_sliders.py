"""Sliders stand only at values that the scene allows, and say them exactly."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from graphkin.studio.look import MOST, ParameterSlider, sliders
from graphkin.studio.session import Edit, edits
from graphkin.text.errors import SceneError

PUMP = Path(scene_files.find("pump")).read_text(encoding="utf-8")
GIVEN = "n = { value = 7, min = 1, max = 30, step = 1 }"


def one(written: str, **settings: str) -> ParameterSlider:
    """The slider of a parameter p written in some way."""
    text = PUMP.replace(GIVEN, f"{GIVEN}\np = {written}")
    found = {slider.name: slider for slider in sliders(read_text(text, "s", None, settings))}
    return found["p"]


@pytest.mark.parametrize(
    "written",
    [
        "{ value = 0.5, min = 0.1, max = 1.3, step = 0.1 }",
        '{ value = "1/3", min = "1/3", max = 3, step = "1/3" }',
        "{ value = 5, min = 0, max = 100000, step = 5 }",
        "{ value = 7, step = 2 }",
        "{ value = -3, max = 0 }",
        "{ value = 0 }",
        "40",
        "{ value = 0.001, min = 0, max = 0.01 }",
        "{ value = 2, min = 2, max = 2 }",
        "{ value = 3, min = 3, step = 10 }",
    ],
)
def test_every_place_of_a_slider_is_a_value_that_can_be_set(written):
    slider = one(written)
    assert 1 <= len(slider.stops) <= MOST + 2
    ordered = [Fraction(stop) for stop in slider.stops]
    assert ordered == sorted(set(ordered))
    assert Fraction(slider.value) in ordered or len(ordered) > MOST / 2
    for stop in (slider.stops[0], slider.stops[len(ordered) // 2], slider.stops[-1]):
        moved = one(written, p=stop)  # raises where the scene does not allow it
        assert moved.value == stop
        if moved.stops == slider.stops:
            assert moved.stops[moved.index] == stop


def test_a_slider_has_the_unit_of_what_it_changes():
    text = PUMP.replace(GIVEN, f"{GIVEN}\nrod = 20").replace("C-D = 20", 'C-D = "rod"')
    units = {slider.name: slider.unit for slider in sliders(read_text(text, "s"))}
    assert units == {"n": "", "rod": "cm"}


def applied(text: str, found: list[Edit]) -> str:
    """A text with pieces of it changed as a browser changes them."""
    data = text.encode("utf-16-le")
    for edit in found:
        words = edit.text.encode("utf-16-le")
        data = data[: 2 * edit.start] + words + data[2 * edit.end :]
    return data.decode("utf-16-le")


def test_several_values_are_changed_from_the_last_to_the_first():
    text = PUMP.replace(GIVEN, f"{GIVEN}\na = 5\nb = {{ value = 6 }}")
    changed = applied(text, edits(text, {"a": "100", "n": "30", "b": "0.125", "gone": "1"}))
    scene = read_text(changed, "s")
    assert scene.values == {"n": 30, "a": 100, "b": Fraction(1, 8)}


def test_what_is_no_number_is_not_written():
    for value in ('7 }\n[evil]\nx = "', "seven", "sqrt(2)", ""):
        with pytest.raises(SceneError, match=r"^setting n: "):
            edits(PUMP, {"n": value})
