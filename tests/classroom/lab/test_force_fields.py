"""The fields of a form for forces: what a scene asks, their keys and tolerances, their lengths."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from graphkin.classroom.grading.standard import standard
from graphkin.classroom.lab.fairness import judged
from graphkin.classroom.lab.items import asked_fields
from graphkin.classroom.lab.lab_model import Lab, LabRule, Rubric
from graphkin.construction.core.solution import by_name
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text

SCENES = Path(__file__).parents[2] / "scenes" / "forces"
NAMES = ("four-bar", "gears", "ram", "shaper")


def text_of(name: str) -> str:
    return (SCENES / f"{name}.toml").read_text(encoding="utf-8")


def test_reactions_and_balance_have_fields_by_the_symbols_of_the_plan():
    found = asked_fields(load(SCENES / "four-bar.toml"))
    pairs = [f"R_{pair}{tail}" for pair in ("12", "03", "32", "01") for tail in ("_mm", "")]
    assert [*found] == [*pairs, "M_b1", "M_b1_sense"]
    assert [found[name].unit for name in ("R_12_mm", "R_12", "M_b1")] == ["mm", "N", "N·m"]


def test_only_what_is_asked_has_fields():
    text = text_of("four-bar").partition("[ask]")[0]
    some = Mechanism(read_text(text + '[ask]\nreactions = ["B"]\n', "some", None, {}))
    assert [*asked_fields(some)] == ["R_32_mm", "R_32"]
    force = Mechanism(read_text(text_of("ram").replace('"O", "A", 3', "3"), "ram", None, {}))
    assert [*asked_fields(force)] == ["R_03_mm", "R_03", "F_b3_mm", "F_b3"]


def test_a_scene_that_asks_for_nothing_has_a_field_for_every_motion():
    text = text_of("four-bar").partition("[ask]")[0]
    fields = asked_fields(Mechanism(read_text(text, "all", None, {})))
    assert {"v_A", "a_B", "omega_3"} <= fields.keys()
    assert not {name for name in fields if name.startswith(("R_", "M_"))}


def test_its_motions_are_those_of_masses_and_loads():
    targets = load(SCENES / "four-bar.toml").asked()
    assert set(targets) == {
        *(("velocity", each) for each in ("S2", "S3")),
        *(("acceleration", each) for each in ("S2", "S3")),
        *(("epsilon", each) for each in ("2", "3")),
        ("omega", "3"),
    }


@pytest.mark.parametrize("name", NAMES)
def test_the_key_is_what_the_equations_of_equilibrium_give(name):
    mechanism = load(SCENES / f"{name}.toml")
    fields = asked_fields(mechanism)
    found = standard(mechanism, fields.values(), Rubric())
    solved, verdict = mechanism.forces()
    assert verdict.agrees
    sizes = [
        abs(each.force)
        for asked in mechanism.scene.forces.reactions
        for pair in by_name(solved, asked).values()
        for each in pair
    ]
    (balance,) = solved.balance
    for field, item in fields.items():
        key = found.key[field]
        if item.quantity == "reaction" and item.what == "value":
            assert min(abs(key - size) for size in sizes) < 1e-9 * key
            assert abs(found.key[f"{field}_mm"] * found.scales.kF / 1000 - key) < 1e-9 * key
        elif item.quantity.startswith("balancing") and item.what == "value":
            expected = balance.moment if balance.force is None else abs(balance.force)
            assert abs(key - expected) < 1e-9 * abs(expected)


@pytest.mark.parametrize("name", NAMES)
def test_tolerances_come_from_pencil_and_ruler(name):
    """A side of a polygon is read to 0.25 mm, and a moment with no ruler at all."""
    mechanism = load(SCENES / f"{name}.toml")
    found = standard(mechanism, asked_fields(mechanism).values(), Rubric())
    coarse = standard(mechanism, asked_fields(mechanism).values(), Rubric(point=1.0, line=1.0))
    for field, allowed in found.tolerance.items():
        item = found.by_field[field].item
        unit = {"mm": 1.0, "N": found.scales.kF / 1000, "N·m": 0.0}.get(item.unit)
        if unit is not None:
            assert abs(allowed.ruler - 0.25 * unit) < 1e-9
        assert 0 < allowed.pencil < coarse.tolerance[field].pencil


def test_lengths_of_many_variants_are_those_of_their_own_sheets(tmp_path):
    text = text_of("four-bar").replace("angle = 60", 'angle = "phi"')
    text = text.replace(
        "[frame]", "[parameters]\nphi = { value = 60, min = 0, max = 360 }\n[frame]", 1
    )
    scene = tmp_path / "scene.toml"
    scene.write_text(text, encoding="utf-8")
    lab = Lab("x", tmp_path, scene, LabRule())
    many = [{"phi": Fraction(angle)} for angle in (20, 95, 200, 310)]
    found = judged(lab, many)
    assert found.fits.all()
    for i, settings in enumerate(many):
        mechanism = lab.variant(settings)
        own = standard(mechanism, asked_fields(mechanism).values(), Rubric())
        for field, lengths in found.lengths.items():
            assert abs(lengths[i] - own.key[field]) < 1e-9 * own.key[field]
