"""A wheel on a known track turns at the instant about its point of contact: no trial moves it."""

from pathlib import Path

import pytest

from graphkin.construction.core.kind import constructions
from graphkin.construction.higher_class.two_trials import TwoTrials
from graphkin.mechanism import load
from graphkin.structure.groups import Higher, Stretched

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"


def test_a_rod_on_a_rolling_wheel_is_placed_by_a_trial_and_moved_without():
    (group,) = load(SCENES / "rod-and-wheel.toml").groups
    assert isinstance(group, Higher)
    (dyad,) = group.at_instant
    assert isinstance(dyad, Stretched)
    assert dyad.dyad.type == "RRR"
    assert dyad.dyad.right.point == "T@3"


@pytest.mark.parametrize("q", [170, 190, 210, 230])
def test_its_plans_hold_no_trials(q):
    """v_B is square to TB, and T of the wheel accelerates to the centre with ω²r alone."""
    mechanism = load(SCENES / "rod-and-wheel.toml", q=q)
    assert not [*constructions(mechanism.program, TwoTrials)]
    found = mechanism.solve()
    assert mechanism.witness(found).agrees
    b, c, omega = found.points["B"], found.points["C"], found.links["3"].omega
    contact = c.position - 0.06j
    assert b.velocity == pytest.approx(1j * omega * (b.position - contact), rel=1e-12)
    epsilon = found.links["3"].epsilon
    arm = b.position - contact
    rolled = 1j * omega**2 * 0.06
    assert b.acceleration == pytest.approx(rolled + (1j * epsilon - omega**2) * arm, rel=1e-11)


@pytest.mark.parametrize("name", ["stephenson-2-binary", "stephenson-3-crank", "rapid-return"])
def test_groups_without_wheels_are_tried_in_the_plans_too(name):
    groups = load(SCENES / f"{name}.toml").groups
    assert [group.at_instant for group in groups if isinstance(group, Higher)] == [()]
