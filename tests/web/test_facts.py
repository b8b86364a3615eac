"""What a task says of its scales: where to draw, how large the plan is, at which scale mm count."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

import pytest

from graphkin.classroom.grading.standard import standard
from graphkin.classroom.lab.items import items
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.construction.core.program import Plane
from graphkin.documents.scaling import scales
from graphkin.drawing.scale import digits
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
from graphkin.web.step_page import task_page
from tests.chosen import by_turns
from tests.classroom.grading.students import LABS

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
NAMES = ("pump", "slotted-lever", "gears-rack", "gears-planet", "oldham", "engine")


def mechanism_of(name: str) -> Mechanism:
    """A lab, or a scene of the examples."""
    path = SCENES / f"{name}.toml"
    return load(str(path)) if path.is_file() else load(name)


def told(mechanism: Mechanism, language: str = "en") -> list[str]:
    """What each sheet of a task says of its scales, without tags."""
    told = re.findall(r'<p class="scales">(.*?)</p>', task_page(mechanism, language))
    return [unescape(re.sub(r"<[^>]+>", "", said)) for said in told]


@pytest.mark.parametrize(("name", "language"), by_turns(NAMES, LANGUAGES))
def test_a_task_says_at_which_scale_to_draw_on_paper(name, language):
    mechanism, spoken = mechanism_of(name), words(language)
    chosen = scales(mechanism)
    factor = spoken.decimal(digits(chosen.kL / 1000))
    for said in told(mechanism, language):
        assert spoken.decimal(chosen.words) in said
        assert f"kL = {factor}" not in said  # the drawing has a blank for it


@pytest.mark.parametrize("name", LABS)
def test_the_scale_that_is_told_is_that_by_which_millimetres_are_marked(name):
    mechanism, lab = load(name), read_lab(name)
    paper = standard(mechanism, items(mechanism, lab), lab.rubric).paper
    speed = abs(float(mechanism.scene.drivers[0].speed.si(mechanism.scene.values)))
    rules = {r"kv = ω1·kL(?:/([\d.]+))?": speed, r"ka = ω12·kL(?:/([\d.]+))?": speed**2}
    planes = (Plane.VELOCITIES, Plane.ACCELERATIONS)
    for said, plane in zip(told(mechanism), planes, strict=True):
        values = [float(value) for value in re.findall(r"= ([\d.]+) \(m/s", said)]
        for rule, rate in rules.items():
            for times in re.findall(rule, said):
                values.append(rate * paper.mechanism / 1000 / float(times or 1))
        assert values == pytest.approx([paper.millimetre(plane)], rel=1e-4)


def test_a_plan_that_is_enlarged_or_has_a_stated_ka_says_so():
    text = (SCENES / "crank-rocker.toml").read_text(encoding="utf-8")
    velocity, acceleration = told(Mechanism(read_text(f"{text}\n[sheet]\nenlarge = 2\n", "larger")))
    assert "kv = ω1·kL/2, oa = 2·O1A/kL." in velocity
    assert "ka = ω12·kL/2." in acceleration
    again = Mechanism(read_text(f"{text}\n[sheet]\nka = 0.5\n", "stated"))
    assert "ka = 0.5 (m/s2)/mm." in told(again)[1]
