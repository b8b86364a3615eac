"""What solve does not print for want of a sure digit, no table, batch or page prints either."""

from __future__ import annotations

import csv
import io
import random
import re

import numpy as np
import pytest

from graphkin.cli.report.cycle_report import cycle_lines, cycle_table
from graphkin.loops import witness
from graphkin.mechanism import Mechanism, load
from graphkin.motion.cycle import cycle
from graphkin.scene.read_scene import read_text
from graphkin.studio.look import Sight, look
from graphkin.studio.panels import Memory
from tests.stress.families import chain

ASK = """[ask]
velocity = ["B1", "B5"]
acceleration = ["B1", "B5"]
omega = [2, 11]
epsilon = [2, 11]
"""
POINT = {"position": "", "velocity": "v", "acceleration": "a"}


def flat_chain() -> str:
    """Five flat dyads, the last lost in doubles; a parameter turns the crank."""
    text = chain(random.Random(1), 5).text
    return text.replace("angle = 40", 'angle = "at"').replace(
        "[frame]", "[parameters]\nat = 40\n[frame]", 1
    )


@pytest.fixture(scope="module")
def flat() -> Mechanism:
    return Mechanism(read_text(flat_chain() + ASK, "flat", None, {}))


@pytest.fixture(scope="module")
def unsure(flat) -> set[str]:
    found = set(flat.witness(flat.solve()).unsure)
    assert {"points.B5.acceleration", "links.11.epsilon"} <= found
    assert not {"points.B1.velocity", "links.2.omega"} & found
    return found


def test_a_batch_has_no_number_where_solve_has_none(flat, unsure):
    found = flat.batch(at=[40.0, 40.0, 40.0])
    values = found.links["11"].epsilon
    assert np.isnan(values).all()
    for row in range(3):
        gone = {
            f"points.{name}.{key}"
            for name, motion in found.points.items()
            for key in POINT
            if np.isnan(np.broadcast_to(getattr(motion, key), 3)[row])
        }
        assert gone == {path for path in unsure if path.startswith("points")}


@pytest.mark.parametrize("count", [3, 2_500])
def test_only_the_variants_that_lose_their_digits_are_lost(flat, count):
    """However a batch is run, each variant loses what it loses by itself."""
    at = 40 - np.logspace(-13, -2, count)
    gone = np.isnan(flat.batch(at=at).links["11"].epsilon)
    assert gone[0]
    assert not gone[-1]
    for row in (0, count // 2, count - 1):
        mechanism = Mechanism(read_text(flat_chain(), "flat", None, {"at": repr(float(at[row]))}))
        assert gone[row] == ("links.11.epsilon" in mechanism.witness(mechanism.solve()).unsure)


def test_a_batch_that_is_not_flat_is_not_examined(monkeypatch):
    """What costs as much as a hundred variants is done only where digits may be lost."""
    monkeypatch.setattr(witness, "examine", None)
    pump = load("pump").batch(n=np.linspace(1, 30, 3_000))
    assert np.isfinite(pump.points["D"].acceleration).all()


def test_a_table_of_the_cycle_leaves_such_cells_empty(flat, unsure):
    found = cycle(flat, low=40 - 1e-12, high=40 + 1e-12, steps=4)
    rows = list(csv.DictReader(io.StringIO(cycle_table(found))))
    (row,) = (row for row in rows if float(row["phi [deg]"]) == 40)
    for name in flat.solve().points:
        if f"ax_{name} [m/s^2]" in row:
            assert (row[f"ax_{name} [m/s^2]"] == "") == (f"points.{name}.acceleration" in unsure)
            assert (row[f"vx_{name} [m/s]"] == "") == (f"points.{name}.velocity" in unsure)
    assert row["epsilon_11 [rad/s^2]"] == ""
    words = "\n".join(cycle_lines(found))
    assert re.search(r"digits +none is sure of .*points.B5.acceleration", words, re.S)
    assert "whose cells are empty" in words


def test_the_studio_shows_a_dash_and_says_why(unsure):
    found = look(Sight(flat_chain() + ASK, "flat", "en"), Memory(), lambda: None)
    table = re.findall(r"<tr[^>]*>(.*?)</tr>", found["results"])
    cells = {}
    for line in table:
        name, *values = (re.sub(r"<[^>]+>", "", cell) for cell in line.split("</t"))
        cells[re.sub(r".*>", "", name)] = [value.lstrip("hd>") for value in values]
    assert cells["ε11"][:2] == ["–", "–"]
    assert cells["ω2"][0] != "–"
    assert "–" in cells["aB5"]
    assert any("no digit of it is sure" in p["found"] for p in found["problems"])
