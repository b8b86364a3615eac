"""Where bodies stand: every block as far from its guide as is written, every wheel on its track."""

from __future__ import annotations

import pytest

from graphkin.construction.core.link_poses import LinkPoses
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import cross
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import mechanism_named
from tests.documents.test_words import RARE, rare


def poses(mechanism: Mechanism) -> LinkPoses:
    """The bodies of a mechanism where its scene stands."""
    return LinkPoses(mechanism.scene, mechanism.trace(mechanism.program.targets))


MADE = {**dict.fromkeys(CHOSEN, mechanism_named), **dict.fromkeys(RARE, rare)}


def test_every_block_is_as_far_from_its_guide_as_is_written():
    seen = 0
    for name, made in MADE.items():
        for way in poses(made(name)).guideways:
            assert abs(way.along) == pytest.approx(1), name
            off = float(cross(way.along, way.at - way.zero))
            assert off == pytest.approx(way.offset, abs=1e-9), (name, way.block)
            seen += abs(way.offset) > 0
    assert seen > 1


def test_every_wheel_touches_its_track_at_its_rim():
    seen = 0
    for name, made in MADE.items():
        for touch in poses(made(name)).touches:
            if touch.rolling.belt is not None:
                continue
            away = touch.at - touch.disc.centre
            assert abs(away) == pytest.approx(touch.disc.radius, rel=1e-9), name
            assert abs((away.conjugate() * touch.along).real) <= 1e-9 * abs(away), name
            seen += 1
    assert seen > 10
