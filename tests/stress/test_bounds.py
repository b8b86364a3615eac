"""The printed limit bounds the true error, wherever flat crossings and unequal lengths lead it."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest
from click.testing import CliRunner

from graphkin.cli.main import app
from graphkin.loops import loop_motion
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import ClosureError
from tests.scene_files import scene_text
from tests.stress.families import FAMILIES, errors, four_bar

SCENES = 6
"""Scenes of each family; thousands hold when this is raised."""
DEAD = scene_text("stress/dead")
NEARLY = scene_text("stress/nearly")


def verdicts(family: str, count: int = SCENES) -> list[tuple[float, object]]:
    """The largest true error of what is sure, and the verdict, of some scenes of a family."""
    rng, found = random.Random(family), []
    for n in range(count):
        truth = FAMILIES[family](rng)
        mechanism = Mechanism(read_text(truth.text, f"made-{n}", None, {}))
        try:
            solution = mechanism.solve()
        except ClosureError:
            continue
        verdict = mechanism.witness(solution)
        missed = errors(solution, truth)
        sure = (error for name, error in missed.items() if name not in verdict.unsure)
        found.append((max(sure), verdict))
    return found


@pytest.mark.parametrize("family", FAMILIES)
def test_no_true_error_is_beyond_the_limit_and_nothing_right_is_refused(family):
    found = verdicts(family)
    assert found
    for missed, verdict in found:
        assert verdict.agrees, verdict
        assert missed <= verdict.limit, verdict


def test_crossings_one_after_the_other_multiply(monkeypatch):
    """Every bound grows with the units of rounding: with a millionth of them errors exceed it."""
    flat = [missed / verdict.limit for missed, verdict in verdicts("4 flat dyads")]
    assert max(flat) < 0.2
    monkeypatch.setattr(loop_motion, "UNIT", loop_motion.UNIT * 1e-6)
    assert any(missed > verdict.limit for missed, verdict in verdicts("4 flat dyads"))


def test_digits_are_those_that_hold():
    """As many as the truth confirms, and not fewer than half of them."""
    rng = random.Random(3)
    for _ in range(6):
        truth = four_bar(rng, 0.5, 3)
        mechanism = Mechanism(read_text(truth.text, "made", None, {}))
        solution = mechanism.solve()
        verdict = mechanism.witness(solution)
        worst = max(e for n, e in errors(solution, truth).items() if n.endswith("acceleration"))
        assert worst < 10.0 ** -verdict.digits["acceleration"]
        assert not verdict.unsure


def told(text: str, tmp_path: Path, *options: str):
    path = tmp_path / "near.toml"
    path.write_text(text, encoding="utf-8")
    return CliRunner().invoke(app, ["solve", str(path), *options])


def test_a_number_of_which_no_digit_is_sure_is_not_printed(tmp_path):
    """The sine is 1e-9, rounded 2.9e-8: doubles find ω = -3.2e7 rad/s, and -9.27e8 is true."""
    said = told(DEAD, tmp_path, "--json")
    assert said.exit_code == 1
    found = json.loads(said.stdout)
    assert found["links"]["2"]["omega"] is None
    assert found["points"]["B"]["velocity"] == [None, None]
    assert found["points"]["B"]["position"] == pytest.approx([0.1571429, 0.0529728], abs=1e-6)
    assert found["links"]["1"]["omega"] == 1
    assert found["witness"]["agrees"]
    assert found["witness"]["digits"] == {"position": 5, "velocity": 0, "acceleration": 0}
    assert "links.2.omega" in found["witness"]["unsure"]
    words = told(DEAD, tmp_path)
    assert "3.21259" not in words.output
    assert "no digit is sure of points.B.velocity" in words.output
    proved = json.loads(told(DEAD, tmp_path, "--digits", "3", "--json").stdout)
    assert proved["links"]["2"]["omega"] == "-9.27e+08"


def test_with_digits_balls_decide_whether_a_position_is_a_dead_point(tmp_path):
    """Bars 1, 2 + 1e-20, 1 in a frame of 4: not in line, however near; without the rest they are.

    To first order in the difference h of the bars the pin stands sqrt(4h/3) aside.
    """
    assert told(NEARLY.replace("BAR", "2+1/10**20"), tmp_path).exit_code == 2
    near = told(NEARLY.replace("BAR", "2+1/10**20"), tmp_path, "--digits", "12", "--json")
    assert near.exit_code == 1
    place = json.loads(near.stdout)["points"]["B"]["position"]
    assert place == ["3.00000000000", "1.15470053838e-10"]
    assert told(NEARLY.replace("BAR", "2"), tmp_path, "--digits", "12").exit_code == 2
