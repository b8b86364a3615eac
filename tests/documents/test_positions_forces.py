"""The sheets of the forces of all positions, held to the equations of equilibrium at each."""

from __future__ import annotations

import re
from cmath import phase
from functools import cache
from itertools import pairwise
from math import degrees
from pathlib import Path

import pytest
from msgspec.structs import replace

from graphkin.documents.positions import positions_of
from graphkin.documents.positions_forces import forced
from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import LineMark, Page, Text, style_class
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism, load
from graphkin.scene.model import StatedPositions
from graphkin.text import LANGUAGES, words
from graphkin.text.errors import WitnessError
from tests.chosen import FOLDER, by_turns
from tests.laws.force_routes import of_equations, on_links

SHOWN = ("engine-forces", "pump-forces", "shaper-forces", "gears-forces", "belts-forces")
"""Dyads with guides, with pins and in slots, a train of wheels, and belts."""


@cache
def sheets(name: str, language: str = "en", count: int = 12) -> tuple[Page, ...]:
    """The sheets of the forces of all positions."""
    scene = load(str(FOLDER / f"{name}.toml")).scene
    mechanism = Mechanism(replace(scene, positions=StatedPositions(count=count)))
    return {e.kind: e.pages for e in hand_out(mechanism, "positions", language)}["force"]


def table_of(page: Page) -> dict[str, list[float | None]]:
    """The columns of the table by their heads, read from left to right and downwards."""
    cells = [m for m in page.marks if isinstance(m, Text) and m.name == "forces"]
    columns: dict[float, list[str]] = {}
    for mark in cells:
        columns.setdefault(round(mark.x, 3), []).append(plain(mark.markup).replace("−", "-"))
    return {
        head: [None if text == "–" else float(text) for text in texts]
        for head, *texts in columns.values()
    }


def by_equations(n: int) -> dict[str, complex | float]:
    """The forces of the engine at the crank angle of a position, from all equations at once."""
    mechanism = load(str(FOLDER / "engine-forces.toml"), phi=(45 + 30 * n) % 360)
    found = of_equations(mechanism)
    return {**on_links(found), "M_b1": found.balance[0].moment or 0.0}


def test_the_table_has_what_the_equations_of_equilibrium_give_at_each_position():
    columns = table_of(sheets("engine-forces")[-1])
    assert columns["position"] == [*range(12)]
    for n in range(12):
        known = by_equations(n)
        for pair in ("01", "03", "32"):
            force = known[f"R_{pair}"]
            assert columns[f"R{pair} (N)"][n] == pytest.approx(abs(force), abs=0.6)
            way = degrees(phase(force)) % 360
            off = (columns[f"∠R{pair} (°)"][n] - way + 180) % 360 - 180
            assert abs(off) < 0.06
        assert columns["Mb1 (N·m)"][n] == pytest.approx(known["M_b1"], abs=0.06)


def test_the_sides_of_the_polygons_have_the_lengths_of_the_forces():
    """A side is its force at the scale of the sheet, or at the scale beside its number."""
    first = sheets("engine-forces")[0]
    said = [plain(m.markup) for m in first.marks if isinstance(m, Text)]
    usual = next(float(found[1]) for text in said if (found := re.search(r"\(kF = (\d+)", text)))
    own = {
        m.name: float(plain(m.markup).split("= ")[1].split()[0])
        for m in first.marks
        if isinstance(m, Text) and plain(m.markup).startswith("kF =")
    }
    for n in range(12):
        known, k = by_equations(n), own.get(f"scale_{n}", usual)
        for pair in ("03", "32"):
            name = f"R_{pair},{n}"
            arrows = (m for m in first.marks if isinstance(m, LineMark) and m.name == name)
            sides = [m for m in arrows if style_class(m) == "reaction"]
            drawn = [complex(m.x2 - m.x1, m.y1 - m.y2) * k for m in sides]
            force = known[f"R_{pair}"]
            assert drawn == ([pytest.approx(force, abs=0.01 * k)] if abs(force) > 0.1 * k else [])


@pytest.mark.parametrize(("name", "language"), by_turns(SHOWN, LANGUAGES))
def test_every_sheet_fits_and_no_gap_is_open_in_any_language(name: str, language: str):
    for page in sheets(name, language):
        page.check()
        shown = [plain(m.markup) for m in page.marks if isinstance(m, Text)]
        assert not [text for text in shown if re.search(r"None|nan\b|[{}]", text)]


def test_many_positions_stand_in_blocks_beside_one_another():
    page = sheets("engine-forces", count=48)[-1]
    page.check()
    numbers = [m.markup for m in page.marks if isinstance(m, Text) and m.name == "forces"]
    assert {str(n) for n in range(48)} <= set(numbers)


@pytest.mark.parametrize("name", ["engine-forces", "pump-forces"])
def test_every_sheet_gives_the_masses_and_the_loads_that_the_forces_follow_from(name):
    forces = load(str(FOLDER / f"{name}.toml")).scene.forces
    for page in sheets(name):
        said = " ".join(plain(m.markup) for m in page.marks if isinstance(m, Text))
        for link, mass in forces.masses.items():
            assert mass.mass.is_zero() or re.search(rf"m{link}\b", said)
        assert forces.gravity is None or re.search(r"\bg\b", said)


def test_a_load_of_a_table_has_its_value_at_each_position():
    """By the table alone, interpolated anew; no single position's value is among the data."""
    table = (4200, 7600, 4100, 2300, 1500, 900, 300, 120, 140, 260, 620, 1700)
    gas = load(Path(__file__).parents[1] / "scenes/forces/gas-engine.toml")
    pages = {e.kind: e.pages for e in hand_out(gas, "positions", "en")}["force"]
    column = table_of(pages[-1])["PA (N)"]
    between = [(a + b) / 2 for a, b in pairwise((*table, table[0]))]
    assert column == between[1:] + between[:1]
    assert "(Forces of the positions), 180°" in " ".join(
        plain(m.markup) for m in pages[-1].marks if isinstance(m, Text)
    )


def test_a_scene_that_asks_for_no_forces_has_no_such_sheets():
    kinds = {each.kind for each in hand_out(load(str(FOLDER / "crank-rocker.toml")), "positions")}
    assert kinds == {"mechanism", "velocity", "acceleration"}


def test_no_sheet_is_handed_out_where_polygons_and_equations_differ(
    monkeypatch: pytest.MonkeyPatch,
):
    from graphkin.documents import force_fields

    monkeypatch.setattr(force_fields, "HELD", 0.0)
    found = positions_of(load(str(FOLDER / "engine-forces.toml")), words("en"))
    with pytest.raises(WitnessError):
        [*forced(found)]
