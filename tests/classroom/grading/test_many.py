"""Many variants worked out together are held to the same as each by itself."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.class_marking import alike, by_driving, standards
from graphkin.classroom.grading.standard import Standard, standard
from graphkin.classroom.lab.items import items
from graphkin.classroom.lab.lab_model import Lab, Rubric, exact_text
from graphkin.construction.core.run import StepFailed, run
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import FLOAT
from graphkin.scene.read_scene import read_text
from tests.classroom.grading.students import LABS, lab_of, scene_of

SCENES = Path(__file__).parents[3] / "examples" / "scenes"
COUNT = 23
"""Variants between the first and the last number, most of them of no student."""


def text_of(name: str) -> str:
    """A shipped lab's scene whose parameter may be any number of its range."""
    return scene_of(name).read_text(encoding="utf-8").replace(", step = 1 ", " ")


def numbers() -> list[Mapping[str, str]]:
    """Numbers from 1 to 30."""
    return [{"n": exact_text(1 + Fraction(29 * i, COUNT - 1))} for i in range(COUNT)]


def with_length(name: str, bar: str, least: int) -> tuple[str, list[Mapping[str, str]]]:
    """A lab in which a length is drawn, too."""
    free = f"q = {{ value = {least}, min = {least}, max = {least + 3} }}\n[frame]"
    text = text_of(name).replace(f"{bar} = {least}", f'{bar} = "q"').replace("[frame]", free, 1)
    return text, [{**each, "q": str(least + i % 4)} for i, each in enumerate(numbers())]


def held(lab: Lab, text: str, many: list[Mapping[str, str]]) -> list[Standard]:
    """Hold variants worked out together to each by itself: scales and keys to the last digit."""
    usual = Mechanism(read_text(text, lab.name))
    form = items(usual, lab)
    small = [("v_D_mm", "v_D") if i % 5 == 0 else () for i in range(len(many))]
    found = standards(usual, text, form, lab.rubric, list(zip(many, small, strict=True)))
    for together, settings, computed in zip(found, many, small, strict=True):
        mechanism = Mechanism(read_text(text, lab.name, settings=dict(settings)))
        alone = standard(mechanism, form, lab.rubric, computed)
        assert together.mechanism.scene == alone.mechanism.scene
        assert together.scales == alone.scales
        assert together.key == pytest.approx(alone.key, rel=0, abs=0, nan_ok=True)
        for field, allowed in alone.tolerance.items():
            own = together.tolerance[field]
            assert (own.value, own.pencil) == pytest.approx((allowed.value, allowed.pencil))
            assert own.unsure == allowed.unsure
    return found


@pytest.mark.parametrize("name", LABS[::2])
def test_together_as_alone(name):
    found = held(lab_of(name), text_of(name), numbers())
    assert len({id(each.mechanism.program) for each in found}) == 1
    assert all(each.errors is not None for each in found)


@pytest.mark.parametrize(
    ("name", "bar", "least"), [("pump", "A-B", 40), ("slotted-lever", "O2-B", 620)]
)
def test_a_length_that_is_drawn_keeps_the_steps_but_is_read_anew(name, bar, least):
    text, many = with_length(name, bar, least)
    assert not by_driving(Mechanism(read_text(text, name)), {"n", "q"})
    found = held(lab_of(name), text, many)
    assert len({id(each.layout) for each in found}) == 1


def test_variants_whose_steps_differ_are_drawn_apart():
    """A plate nearly in line: perpendiculars cross too flat, the similarity theorem steps in."""
    text = text_of("pump").replace("B-C = 25", 'B-C = "q"')
    text = text.replace("[frame]", "q = { value = 25, min = 20, max = 25 }\n[frame]", 1)
    found = held(lab_of("pump"), text, [{"q": "20.02"}, {"q": "24"}, {"q": "20.01"}])
    near, far, other = (each.layout for each in found)
    assert far is not near
    assert far is not other


def test_a_group_of_higher_class_is_drawn_for_each_variant_by_itself():
    path = SCENES / "stephenson-3-crank.toml"
    text = path.read_text(encoding="utf-8")
    mechanism = Mechanism(read_text(text, "stephenson-3-crank"))
    lab = replace(lab_of("pump"), rubric=Rubric())
    form = items(mechanism, lab)
    found = standards(mechanism, text, form, lab.rubric, [({}, ()), ({}, ())])
    assert list(alike(found)) == [[0], [1]]
    assert all(each.errors is None and each.tolerance for each in found)


@pytest.mark.parametrize("name", LABS)
def test_only_what_hangs_on_a_changed_value_need_be_run_again(name):
    """Of a construction with one value put in place of its own every field is as of a whole run."""
    found = held(lab_of(name), text_of(name), numbers()[:2])[1]
    program, values = found.layout.program, found.mechanism.scene.values_in(FLOAT)
    for number in found.layout.needed:
        value = found.exact.trace.values[number]
        if isinstance(value, complex | float):
            put = {number: 1.25 * value}
            given = {program.seconds: found.scales.seconds} if program.seconds is not None else {}
            try:
                whole = run(program, found.layout.needed, values, FLOAT, overrides={**given, **put})
            except StepFailed:
                assert not found.rerun(put)
                continue
            told = found.read(whole.values)
            assert found.reread(put) == pytest.approx(told, rel=0, abs=0, nan_ok=True)
