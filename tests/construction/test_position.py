"""The mechanism to scale: it stands where the scene says that it stands."""

from __future__ import annotations

from cmath import rect
from itertools import combinations

import pytest
from hypothesis import given

from graphkin.construction.core.link_poses import LinkPoses
from graphkin.construction.guides.guides import stretch
from graphkin.mechanism import Mechanism
from graphkin.numbers.plane import cross
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import mechanism_named
from tests.documents.test_words import RARE, rare
from tests.mechanisms import LAW, mechanism_of, mechanisms
from tests.scene_files import scene_text

SLIDER_CRANK = scene_text("construction/slider-crank")
FOUR_BAR = scene_text("construction/four-bar")


@LAW
@given(mechanisms())
def test_a_slide_counts_from_the_zero_of_its_guide_to_the_blocks_first_point(made):
    slides = made.mechanism().solve().slides
    extent = max(abs(p - q) for p, q in combinations(made.places.values(), 2))
    assert set(slides) == {block.name for block in made.blocks}
    for block in made.blocks:
        assert abs(slides[block.name].position - block.zero) <= 1e-11 * extent


@pytest.mark.parametrize("here", [0, 3 - 2j])
@pytest.mark.parametrize("way", [1, 1j, rect(1, 2.3)])
def test_a_stretched_bar_reaches_from_pin_to_pin_in_the_axes_of_its_guide(here, way):
    """The guide runs through any point of its link; its block stands 5 along it and 2 beside."""
    own, block_pin, first = 0.7 + 0.4j, 1.5 - 1j, 0.5 + 0.25j
    found = stretch(block_pin, first, 2.0, here + own * way, here, 3 * way, 5.0)
    seen = here + (5 + 2j + block_pin - first) * way
    assert found * way == pytest.approx(seen - (here + own * way))


@pytest.mark.parametrize("angle", [0, 17, 60, 90, 133, 180, 200, 270, 359])
def test_the_other_branch_is_the_other_crossing(angle):
    """Four-bar: mirrored in the line of the known pins. Slider-crank: about the foot of A."""
    scene = FOUR_BAR.replace("angle = 60", f"angle = {angle}")
    left, right = (
        mechanism_of(text).solve().points for text in (scene, scene.replace("left", "right"))
    )
    axis = left["Q"].position - left["A"].position
    ratios = [(p["B"].position - p["A"].position) / axis for p in (left, right)]
    assert ratios[0].imag > 0
    assert ratios[1] == pytest.approx(ratios[0].conjugate(), rel=1e-14)
    scene = SLIDER_CRANK.replace("angle = 60", f"angle = {angle}")
    forth, back = (
        mechanism_of(text).solve().points for text in (scene, scene.replace("for", "back"))
    )
    assert forth["B"].position.real > back["B"].position.real
    middle = (forth["B"].position + back["B"].position) / 2
    assert middle == pytest.approx(complex(forth["A"].position.real), rel=1e-14, abs=1e-14)


def test_whole_quarters_are_exact():
    """An angle of 90° is 90°: no 6e-17 is left of its cosine."""
    for angle, tip in ((0, 1), (90, 1j), (180, -1), (270, -1j), (-90, -1j), (450, 1j)):
        scene = SLIDER_CRANK.replace("angle = 60", f"angle = {angle}")
        assert mechanism_of(scene).solve().points["A"].position == tip


def test_a_driver_may_give_the_angle_of_another_line_of_its_link():
    text = FOUR_BAR.replace("O-A = 1", 'O-A = 1\nO-C = 2\nA-C = 2.5\nC = "left of O-A"')
    by_axis = mechanism_of(text).solve().points
    assert by_axis["A"].position == pytest.approx(complex(0.5, 3**0.5 / 2))
    of_line = mechanism_of(text.replace("angle = 60", 'of = "A-C"\nangle = 60')).solve().points
    line = of_line["C"].position - of_line["A"].position
    assert line / abs(line) == pytest.approx(complex(0.5, 3**0.5 / 2))


def test_a_link_in_coordinates_keeps_its_own_axes():
    """The driver's angle is that of the link's x axis, not of its first two points."""
    scene = FOUR_BAR.replace("O-A = 1", "O = [2, 2]\nA = [2, 3]").replace("angle = 60", "angle = 0")
    assert mechanism_of(scene).solve().points["A"].position == 1j


def test_the_known_pins_may_be_named_in_either_order():
    there, back = (
        mechanism_of(FOUR_BAR.replace("left of A-Q", words)).solve()
        for words in ("left of A-Q", "right of Q-A")
    )
    assert there == back


# --- Where bodies stand: every block as far from its guide as is written, every wheel ------------


def poses(mechanism: Mechanism) -> LinkPoses:
    """The bodies of a mechanism where its scene stands."""
    return LinkPoses(mechanism.scene, mechanism.trace(mechanism.program.targets))


MADE = {**dict.fromkeys(CHOSEN, mechanism_named), **dict.fromkeys(RARE, rare)}


@pytest.mark.parametrize("known", [True, False], ids=["through a point", "through none"])
def test_every_block_is_as_far_from_its_guide_as_is_written(known, monkeypatch):
    """Also where nothing tells where the guide's point stands: then its foot is its place."""
    if not known:
        monkeypatch.setattr(LinkPoses, "carried", lambda *_: None)
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
