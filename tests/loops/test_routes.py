"""Each quantity that can be asked has an independent route, which finds a wrong value out."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from graphkin.construction.core import quantities
from graphkin.construction.core.quantities import (
    ASKED,
    QUANTITIES,
    MotionQuantity,
    PointMotion,
)
from graphkin.construction.core.run import run
from graphkin.construction.core.solution import Solution, gathered
from graphkin.loops import differences
from graphkin.loops.differences import ROUTES
from graphkin.loops.witness import compare
from graphkin.mechanism import Mechanism, load
from graphkin.numbers.arithmetic import FLOAT
from graphkin.numbers.plane import Ratio
from graphkin.scene.model import Ask
from graphkin.text.errors import WitnessError
from tests.diagnosis.scope import shipped
from tests.scene_files import FOLDER as SCENE_FILES

SCENES = ("pump", "crank-slot", "instant-centres", "inflection-cardan", "centrodes-four-bar")
"""Scenes that ask for every quantity of links and blocks between them."""
CURVED = "construction/coupler-point-curvature"
"""A scene of the tests that asks for the centre of curvature of a point's path."""


@cache
def asking(name: str) -> Mechanism:
    """A scene by its name."""
    return load(SCENE_FILES / f"{name}.toml") if name == CURVED else shipped(name)


def doubled(value: Any) -> Any:
    """Twice a value; a centre twice as far from where it is counted."""
    if isinstance(value, Ratio):
        return Ratio(value.start, 2 * value.shift, value.size)
    return 2 * value


def is_changed(value: Any) -> bool:
    """Whether a value differs from its double by more than rounding; none does at infinity."""
    parts = (value.shift, value.size) if isinstance(value, Ratio) else (value,)
    return min(float(np.abs(part)) for part in parts) > 1e-6


def caught(mechanism: Mechanism, target: tuple[str, str]) -> bool | None:
    """Whether a target constructed twice as large is found out; None where its double is itself."""
    program, values = mechanism.program, mechanism.scene.values
    needed, number = program.needed([target]), program.targets[target]
    value = run(program, needed, values, FLOAT).values[number]
    if not is_changed(value):
        return None
    wrong = run(program, needed, values, FLOAT, overrides={number: doubled(value)})
    try:
        return not mechanism.witness(gathered(wrong)).agrees
    except WitnessError:
        return True


@pytest.mark.parametrize("quantity", [each.target for each in QUANTITIES])
def test_a_quantity_constructed_twice_as_large_does_not_agree(quantity):
    found = {
        (name, *target): caught(asking(name), target)
        for name in (*SCENES, CURVED)
        for target in asking(name).program.targets
        if target[0] == quantity
    }
    judged = [target for target, seen in found.items() if seen is not None]
    assert judged, "no scene of these has the quantity"
    assert [target for target in judged if not found[target]] == []


def test_every_quantity_has_its_route_and_every_question_its_quantities():
    assert ROUTES.keys() == {each.target for each in QUANTITIES}
    assert ASKED.keys() == set(Ask.__struct_fields__)


class Snapping(PointMotion, frozen=True):
    """A motion with a quantity that nothing witnesses."""

    snap: complex | None = None


def test_a_quantity_without_a_route_is_refused(monkeypatch):
    snap = MotionQuantity(
        "snap", "points", "snap", "acceleration", "vector", "s", "m/s⁴", "snap", ()
    )
    for module in (quantities, differences):
        monkeypatch.setattr(module, "QUANTITIES", (*QUANTITIES, snap))
    pump = shipped("pump")
    place = pump.solve().points["D"].position
    silent = Solution({"D": Snapping(place)}, {})
    assert compare(pump.scene, silent).agrees
    with pytest.raises(WitnessError, match="no independent route gives this quantity"):
        compare(pump.scene, Solution({"D": Snapping(place, snap=1j)}, {}))
