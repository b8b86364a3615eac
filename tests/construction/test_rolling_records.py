"""Constructions of rolling contact are records: what is said and computed of them is theirs."""

from __future__ import annotations

from functools import cache

import pytest

from graphkin.construction.core.kind import construction, constructions
from graphkin.construction.rolling.contact_points import CentrePath, Track
from graphkin.construction.rolling.rolling_normal import CommonNormal, RollingNormal
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from tests.documents.sheet_tools import FOLDER
from tests.scene_files import scene_text

WHEELS = ("gears-pair", "gears-planet", "gears-rack", "gears-ring", "rod-and-wheel", "roller")
NAMES = (*WHEELS, "roller-plates", "centrodes-roller", "rack-on-arm")


@cache
def mechanism(name):
    """A mechanism with wheels."""
    if name == "rack-on-arm":
        return Mechanism(read_text(scene_text("documents/rack-on-arm"), name, None, {}))
    return load(FOLDER / f"{name}.toml")


EVERY = pytest.mark.parametrize("name", NAMES)


@EVERY
def test_a_rolling_point_is_accelerated_along_the_radius_by_the_square_of_the_relative_rate(name):
    made = mechanism(name)
    trace = made.trace(made.asked())
    for each in constructions(made.program, RollingNormal):
        if each.vector not in trace.values:
            continue
        values = trace.values
        way = values[each.head] - values[each.foot]
        rate = values[each.omega] - values[each.omega_track]
        assert values[each.vector] == pytest.approx(way * rate**2)
        assert values[each.image] - values[each.start] == pytest.approx(values[each.vector])


@EVERY
def test_a_common_normal_and_the_path_of_a_centre_are_parallel_to_what_they_name(name):
    made = mechanism(name)
    trace, spot = made.trace(made.asked()), {}
    for (what, of), number in made.program.targets.items():
        if what == "position" and number in trace.values:
            spot[of] = trace.values[number]
    for each in constructions(made.program, CommonNormal):
        if each.line in trace.values:
            along = trace.values[each.line].along / (spot[each.q] - spot[each.p])
            assert abs(along.imag) <= 1e-9 * abs(along)
    for each in constructions(made.program, CentrePath):
        if each.line in trace.values:
            assert isinstance(construction(made.program.steps[each.track]), Track)
            along = trace.values[each.line].along / trace.values[each.track].along
            assert abs(along.imag) <= 1e-9 * abs(along)
