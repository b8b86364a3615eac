"""Forces over a turn: each row is what solve gives in that position, and the lever agrees."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphkin.cli.report.cycle_report import cycle_rows
from graphkin.drawing.marks import Text
from graphkin.mechanism import Mechanism, load
from graphkin.motion.curves import over_driver
from graphkin.motion.cycle import cycle
from graphkin.scene.read_scene import read_text
from tests.laws.force_routes import on_links

SCENES = Path(__file__).parents[1] / "scenes" / "forces"


@pytest.mark.parametrize(
    ("name", "place", "steps"),
    [("four-bar", "angle = 60", 9), ("shaper", "angle = 38", 5), ("ram", "position = 330", 4)],
)
def test_a_row_has_the_forces_of_its_position(name, place, steps):
    text = (SCENES / f"{name}.toml").read_text(encoding="utf-8")
    found = cycle(load(SCENES / f"{name}.toml"), steps=steps)
    head, *rows = cycle_rows(found)
    assert found.forces is not None and len(rows) >= steps - 1
    for row, at in zip(rows, found.at, strict=True):
        key, unit = place.split(" = ")[0], 1000 if name == "ram" else 1
        one = Mechanism(read_text(text.replace(place, f"{key} = {at * unit:.17g}"), "x", None, {}))
        solved, _ = one.forces()
        told, expected = dict(zip(head, row, strict=True)), on_links(solved)
        largest = max(map(abs, expected.values()))
        names = {h.split("x_")[1].split(" ")[0] for h in head if h.startswith("Rx_")}
        assert names
        for index in names:
            force = complex(told[f"Rx_{index} [N]"], told[f"Ry_{index} [N]"])
            assert abs(force - expected[f"R_{index}"]) < 1e-9 * largest
        (balance,) = solved.balance
        if balance.moment is not None:
            assert abs(told["M_b1 [N·m]"] - balance.moment) < 1e-9 * largest
        else:
            assert abs(told["Fx_b3 [N]"] - balance.force.real) < 1e-9 * largest
        assert told["force_witness"] < 1e-9


def test_the_work_of_the_balance_over_a_turn_is_that_of_the_load():
    """Masses give back over a turn what they take, so ∮M dφ is the work of the load, 0 here."""
    found = cycle(load(SCENES / "four-bar.toml"), steps=720)
    moment = found.forces.values["balancing moment", "M_b1"]
    assert abs(np.mean(moment)) < 1e-6 * np.max(np.abs(moment))


def test_a_scene_that_asks_for_no_force_has_no_such_column():
    text = (SCENES / "four-bar.toml").read_text(encoding="utf-8").partition("[ask]")[0]
    found = cycle(Mechanism(read_text(text, "none", None, {})), steps=4)
    head, *_ = cycle_rows(found)
    assert found.forces is None and not [each for each in head if "[N" in each]


def test_the_figure_of_forces_has_a_panel_for_the_moment():
    found = over_driver.sampled(cycle(load(SCENES / "four-bar.toml"), steps=12), fine=24)
    marks = over_driver.pictures(found)["forces"]().marks
    units = [mark.markup for mark in marks if isinstance(mark, Text) and mark.name == "unit"]
    assert units == ["N", "N·m"]
