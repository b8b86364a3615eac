"""Sliders stand only at values that the scene allows, and say them exactly."""

from __future__ import annotations

from fractions import Fraction

import pytest

from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from graphkin.studio.scene_edits import Edit, edits
from graphkin.studio.sliders import MOST, ParameterSlider, sliders
from graphkin.studio.toml_spans import values
from graphkin.text.errors import SceneError

PUMP = scene_files.find("pump").read_text(encoding="utf-8")
GIVEN = "n = { value = 7, min = 1, max = 30, step = 1 }"


def one(written: str, **settings: str) -> ParameterSlider:
    """The slider of a parameter p written in some way."""
    text = PUMP.replace(GIVEN, f"{GIVEN}\np = {written}")
    found = {slider.name: slider for slider in sliders(read_text(text, "s", None, settings))}
    return found["p"]


def test_the_pump_has_one_with_a_place_for_each_student():
    (slider,) = sliders(read_text(PUMP, "pump", None, {"n": "12"}))
    assert slider.stops == tuple(str(n) for n in range(1, 31))
    assert (slider.index, slider.value, slider.low, slider.high) == (11, "12", "1", "30")


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


def test_bounds_that_are_stated_are_the_ends_of_the_slider():
    slider = one("{ value = 0.5, min = 0.123, max = 1.777 }")
    assert (slider.stops[0], slider.stops[-1]) == ("0.123", "1.777")


def test_a_value_between_the_places_is_shown_at_the_nearest():
    written = "{ value = 0, min = 0, max = 100000, step = 5 }"  # a place at each 100
    for value, nearest in (("145", "100"), ("150", "100"), ("155", "200"), ("100000", "100000")):
        slider = one(written, p=value)
        assert (slider.value, slider.stops[slider.index]) == (value, nearest)


def test_a_slider_has_the_unit_of_what_it_changes():
    text = PUMP.replace(GIVEN, f"{GIVEN}\nrod = 20").replace("C-D = 20", 'C-D = "rod"')
    units = {slider.name: slider.unit for slider in sliders(read_text(text, "s"))}
    assert units == {"n": "", "rod": "cm"}


@pytest.mark.parametrize(
    ("given", "value", "expected"),
    [
        (GIVEN, "12", GIVEN.replace("value = 7", "value = 12")),
        ("n = 7", "12.25", "n = 12.25"),
        ("n = 7", "1/3", 'n = "1/3"'),
        ("n.value = 7 # seven", "8", "n.value = 8 # seven"),
    ],
)
def test_values_are_written_where_the_text_states_them(given, value, expected):
    text = PUMP.replace(GIVEN, f"# 🛠 {GIVEN}\n{given}")
    (edit,) = edits(text, {"n": value})
    assert applied(text, [edit]) == text.replace(f"\n{given}", f"\n{expected}")


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


def test_values_of_keys_are_found_without_their_keys():
    found = values(PUMP)
    assert PUMP[slice(*found["parameters", "n", "value"])] == "7"


def test_what_is_no_number_is_not_written():
    for value in ('7 }\n[evil]\nx = "', "seven", "sqrt(2)", ""):
        with pytest.raises(SceneError, match=r"^setting n: "):
            edits(PUMP, {"n": value})


def test_a_value_that_the_text_states_already_changes_nothing():
    text = PUMP.replace(GIVEN, f'{GIVEN}\na = "1/3"')
    assert not edits(text, {"n": "7.0", "a": "1/3"})
    (edit,) = edits(text, {"n": "7", "a": "2/6 + 1"})
    assert (edit.name, edit.before, edit.text) == ("a", '"1/3"', '"4/3"')
