"""The scenes of the format's own description, read into records."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest

from graphkin.scene.model import Apart, At, Closure, Scene, Side, Slide, Triangle, Way
from graphkin.scene.phrases import branch_words
from graphkin.scene.quantity import exact
from graphkin.scene.read_scene import read_scene, read_text
from tests.scene_files import scene_text


def test_the_pump(data: Path) -> None:
    pump = read_scene(data / "pump.toml")
    assert (pump.name, pump.title) == ("pump", "Pump mechanism")
    assert pump.units == {"length": "cm", "angle": "deg", "speed": "rev/min"}
    assert pump.frame.points == ("O1", "O2")
    assert pump.frame.placings[1] == At("O2", exact(0, "cm"), exact(-30, "cm"))
    assert [link.points for link in pump.links.values()] == [
        ("O1", "A"),
        ("O2", "B"),
        ("A", "B", "C"),
        ("C", "D"),
        ("D",),
    ]
    zero = exact(0, "cm")
    assert pump.links["3"].placings == (
        At("A", zero, zero),
        Apart("B", "A", exact(40, "cm")),
        Triangle("C", "A", "B", exact(20, "cm"), exact(25, "cm"), 1),
    )
    guide = Slide("0", "O1", exact(0, "deg"), None, zero)
    assert pump.links["5"].slides == (guide,)
    assert pump.branches == {"B": Side("A", "O2", -1), "5": Way(1)}
    assert pump.ask.velocity == pump.ask.acceleration == ("D",)
    assert pump.ask.poles == ("3", "4")


@pytest.mark.parametrize("lab", ["pump", "pump-collinear"])
def test_the_shipped_sheets(lab: str) -> None:
    folder = Path(__file__).parents[2] / "sheets" / lab
    crank = {"r": Fraction(30)} if lab == "pump-collinear" else {}
    scene = read_scene(folder / "scene.toml", {"n": 12})
    assert (scene.name, scene.values) == (lab, {**crank, "n": Fraction(12)})
    assert scene.drivers[0].position.written(scene.values) == "54"
    assert scene.sheet.language == "ro"
    assert scene.titles["ro"].startswith("Mecanism de pompă")


def test_two_blocks_offsets_and_pins(changed: Callable[..., Scene]) -> None:
    two = (
        'slides = [{ on = "frame", through = "O1", angle = 0, offset = "2*n", pin = true },'
        ' { on = 3, along = "A - B", offset = -1 }]'
    )
    scene = changed('slides = { on = 0, through = "O1", angle = 0 }', two)
    first, second = scene.links["5"].slides
    assert (first.on, first.pin, first.offset.number(scene.values)) == ("0", True, 14)
    assert (second.on, second.along, second.offset) == ("3", ("A", "B"), exact(-1, "cm"))


def test_drivers_against_a_link_and_of_a_line(changed: Callable[..., Scene]) -> None:
    scene = changed("turn = 1", 'turn = 3\nagainst = "2"\nof = "C-B"\nacceleration = 1.5')
    (driver,) = scene.drivers
    assert (driver.link, driver.against, driver.of) == ("3", "2", ("C", "B"))
    assert driver.acceleration.number({}) == Fraction(3, 2)


def test_a_sliding_driver(changed: Callable[..., Scene]) -> None:
    old = 'turn = 1\nangle = "30 + 2*n"\nspeed = "300 + 10*n"'
    (driver,) = changed(old, "slide = 5\nposition = 40\nspeed = -2.5").drivers
    assert (driver.position.unit, driver.speed.unit, driver.acceleration.unit) == (
        "cm",
        "cm/s",
        "cm/s²",
    )
    assert driver.speed.si({}) == -0.025


def test_wheels_by_teeth_and_tracks_of_both_kinds() -> None:
    scene = read_text(scene_text("scene/rack"), "rack")
    ring = scene.frame.wheels[0]
    assert ring.inside and ring.teeth == exact(60)
    assert ring.radius is not None and ring.radius.number({}) == 120
    first, second = scene.links["planet"].wheels
    assert first.radius is not None and first.radius.si({}) == 0.06
    assert second.radius is not None and second.radius.number({}) == 10
    circular, straight = scene.links["planet"].rolls
    assert circular.through is None and circular.start["arm"].text == "pi/2"
    assert (straight.side, straight.through) == (-1, (exact(0, "mm"), exact(60, "mm")))
    assert scene.drivers[0].kind == "roll"


def test_branches_in_all_words(changed: Callable[..., Scene]) -> None:
    words = 'A = "left  of  O2 - B"\n2 = "closure 3"\n4 = "backward"'
    branches = changed("[branches]", f"[branches]\n{words}").branches
    assert branches["A"] == Side("O2", "B", 1)
    assert branches["2"] == Closure(3)
    assert branches["4"] == Way(-1)


def test_the_title_block(changed: Callable[..., Scene]) -> None:
    sheet = """
[sheet]
owner = "Universitatea"
author = "A. Popescu"
approved = "B. Ionescu"
date = 2024-05-17
number = 12
language = "it"
scale = "1:5"
sheets = 1
[notes]
ro = '''
O notă
pe două rânduri.'''
"""
    scene = changed("[ask]", sheet + "[ask]")
    assert (scene.sheet.date, scene.sheet.number) == ("2024-05-17", "12")
    assert (scene.sheet.owner, scene.sheet.sheets) == ("Universitatea", 1)
    assert scene.sheet.scale is not None and scene.sheet.scale.number({}) == Fraction(5)
    assert scene.notes == {"ro": "O notă\npe două rânduri."}


def test_parameters_in_both_forms(changed: Callable[..., Scene]) -> None:
    scene = changed(
        "[parameters]", "[parameters]\nr = 0.1\nq = { value = '1/3', max = 1 }", r="0.2"
    )
    assert scene.values == {"n": 7, "r": Fraction(1, 5), "q": Fraction(1, 3)}
    assert scene.parameters["r"].minimum is None
    assert scene.parameters["n"].maximum == exact(30)


@pytest.mark.parametrize("value", [8, "8", " 8.0 ", "16/2", 8.0, Fraction(8), "2**3"])
def test_settings_are_exact(changed: Callable[..., Scene], value: object) -> None:
    assert changed(n=value).values == {"n": Fraction(8)}


def test_a_float_setting_is_the_decimal_it_shows(changed: Callable[..., Scene]) -> None:
    scene = changed("step = 1", "step = 0.1", n=7.1)
    assert scene.values["n"] == Fraction(71, 10)


def test_reading_needs_no_numpy() -> None:
    code = "import sys, graphkin.scene.read_scene; sys.exit('numpy' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parents[2])


@pytest.mark.parametrize(
    ("words", "branch"),
    [
        ("closure 1", Closure(1)),
        ("closure 9999", Closure(9999)),
        ("closure 10000", None),
        ("closure -1", None),
        ("closure one", None),
        ("forward", Way(1)),
        ("backward", Way(-1)),
        ("onward", None),
    ],
)
def test_a_branch_is_a_way_or_a_closure_of_four_digits_at_most(words, branch):
    assert branch_words(words) == branch
