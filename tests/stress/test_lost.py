"""Arcs that meet are not said to miss each other, however far rounding has moved them."""

from __future__ import annotations

import random
import re

import mpmath
import pytest
from click.testing import CliRunner

from graphkin.cli.main import app
from graphkin.diagnosis.assembly_failure import ROUNDING
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import ClosureError
from tests.stress.families import chain

MP = mpmath.mp.clone()
MP.dps = 60

LOST = (11, 55, 185)
"""Chains of six flat dyads whose last arcs doubles do not find to meet."""


def last_arcs(text: str) -> tuple[complex, object, object]:
    """The pivot of the last dyad, and the lengths of its two bars, as the scene writes them."""
    pivot = MP.mpc(*re.search(r'Q6 = \["(.*?)", "(.*?)"\]', text).groups())
    first, second = (MP.mpf(re.search(rf'{bar} = "(.*?)"', text)[1]) for bar in ("B5-B6", "Q6-B6"))
    return pivot, first, second


def crossing(truth, shorter=0) -> float:
    """By how much the last two arcs cross (m), in decimals of 60 digits; negative: they miss."""
    pivot, first, second = last_arcs(truth.text)
    apart = abs(pivot - truth.points["B5"][0])
    second -= shorter
    return float(min(first + second - apart, apart - abs(first - second)))


def refused(text: str) -> str:
    with pytest.raises(ClosureError) as raised:
        Mechanism(read_text(text, "chain", None, {})).solve()
    return str(raised.value)


@pytest.mark.parametrize("seed", LOST)
def test_arcs_that_cross_are_said_to(seed, tmp_path):
    truth = chain(random.Random(seed), 6)
    words = refused(truth.text)
    assert "miss each other" not in words
    said = re.search(r"B6 cannot be found in doubles: the arcs cross, by (\S+) m, but", words)
    assert float(said[1]) == pytest.approx(crossing(truth), rel=1e-3)
    moved = re.search(r"enlarge rounding to (\S+) m", words)
    assert float(moved[1]) > max(crossing(truth), ROUNDING)
    path = tmp_path / "chain.toml"
    path.write_text(truth.text, encoding="utf-8")
    result = CliRunner().invoke(app, ["solve", str(path), "--digits", "12", "--json"])
    place = re.search(r'"B6": \{\s*"position": \[\s*"(.*?)",\s*"(.*?)"', result.stdout)
    for found, exact in zip(place.groups(), truth.points["B6"][0]._mpc_, strict=True):
        assert float(found) == pytest.approx(float(MP.make_mpf(exact)), rel=1e-11)


@pytest.mark.parametrize("seed", LOST)
def test_arcs_that_miss_each_other_are_said_to_by_how_much(seed):
    """With a bar so much shorter, or longer, that they do: the true gap is told, not a rounded."""
    truth = chain(random.Random(seed), 6)
    pivot, first, second = last_arcs(truth.text)
    apart = abs(pivot - truth.points["B5"][0])
    stretched = first + second - apart < apart - abs(first - second)
    change = 3 * crossing(truth) * (1 if stretched or second < first else -1)
    text = re.sub(r'Q6-B6 = "(.*?)"', f'Q6-B6 = "{MP.nstr(second - change, 50)}"', truth.text)
    said = re.search(r"the arcs miss each other by (\S+) m", refused(text))
    assert float(said[1]) == pytest.approx(-crossing(truth, change), rel=1e-3)
