"""Which links of a single loop turn fully: Grashof's rule against the loop closed all round."""

from __future__ import annotations

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from graphkin.structure.grashof import FourBar, SliderCrank, grashof, single_loops
from tests.mechanisms import LAW, scene_of
from tests.scene_files import scene_text

LENGTHS = st.integers(1, 60).map(float)
DRIVEN = "[[drivers]]\nturn = 1\nangle = 40\nspeed = 1\n"


@pytest.mark.parametrize(
    ("lengths", "kind"),
    [
        ((100, 40, 90, 70), "crank-rocker"),
        ((100, 70, 90, 40), "crank-rocker"),
        ((50, 100, 120, 110), "double crank"),
        ((120, 90, 50, 100), "double rocker"),
        ((130, 70, 80, 90), "triple rocker"),
        ((130, 70, 130, 70), "change point"),
        ((5, 1, 4, 2), "change point"),
        ((0.3, 0.1, 0.2, 0.4), "change point"),
    ],
)
def test_the_classes_of_the_course(lengths, kind):
    """Examples of every class; the last adds up only when rounding is allowed for."""
    assert grashof(*lengths) == kind


def closes_all_round(fixed: float, crank: float, coupler: float, rocker: float) -> bool:
    """Whether the other two bars reach across at every angle of the crank: by the triangle."""
    spans = (abs(fixed - crank), fixed + crank)
    return all(abs(coupler - rocker) <= span <= coupler + rocker for span in spans)


@LAW
@given(LENGTHS, LENGTHS, LENGTHS, LENGTHS)
def test_a_crank_turns_fully_as_the_rule_says(a, b, c, d):
    """Each pair of neighbours in the loop, one held and the other turned all round."""
    loop = FourBar(("a", "b", "c", "d"), (a, b, c, d))
    bars = list(zip(loop.links, loop.lengths, strict=True))
    for start in range(4):
        turned = bars[start:] + bars[:start]
        full = closes_all_round(*(length for _, length in turned))
        assert full == (not {turned[0][0], turned[1][0]}.isdisjoint(loop.turning))


@LAW
@given(LENGTHS, LENGTHS, st.integers(-30, 30))
def test_a_slider_crank_turns_fully_iff_crank_and_offset_stay_within_the_rod(crank, rod, offset):
    """The rod must span the height of the crank's pin above the block's line, at every angle."""
    assume(crank != rod)
    loop = SliderCrank("0", "3", ("1", crank), ("2", rod), offset)
    heights = [crank * math.sin(math.radians(angle)) - offset for angle in range(360)]
    assert ("1" in loop.turning) == all(abs(height) <= rod for height in heights)
    heights = [rod * math.sin(math.radians(angle)) + offset for angle in range(360)]
    assert ("2" in loop.turning) == all(abs(height) <= crank for height in heights)


# --- loops found in a scene ----------------------------------------------------------------------

SIX_BAR = scene_text("structure/six-bar")
SLOTTED_LEVER = """[frame]
O = [0, 0]
Q = [0, -3]
[links.1]
O-A = {crank}
[links.2]
A = [0, 0]
slides = {{ on = 3, along = "Q-B", offset = 0.5 }}
[links.3]
Q-B = 6
"""


def test_a_six_bar_has_a_four_bar_and_a_slider_crank_on_its_double_hinge():
    four, slider = single_loops(scene_of(SIX_BAR + DRIVEN))
    assert isinstance(four, FourBar)
    assert (four.links, four.lengths) == (("0", "1", "2", "3"), (10, 4, 9, 7))
    assert (four.kind, four.turning) == ("crank-rocker", ("1",))
    assert isinstance(slider, SliderCrank)
    assert slider.links == ("0", "3", "4", "5")
    assert (slider.crank, slider.rod) == (("3", 7), ("4", 12))


def test_an_offset_is_that_of_the_block_s_pin():
    """The guide leads backwards at -3; left of it is below; the pin lies 2 further left of D."""
    _, slider = single_loops(scene_of(SIX_BAR + DRIVEN))
    assert abs(slider.offset) == pytest.approx(3 + 1 + 2, rel=1e-14)
    assert slider.slack == -1


@pytest.mark.parametrize(("crank", "turning"), [(1, ("1",)), (5, ("0",)), (2.75, ())])
def test_a_slotted_lever_rocks_or_goes_round_by_which_bar_is_the_shorter(crank, turning):
    """Crank 1 under a base of 3; Whitworth's with 5; between them the offset 0.5 jams it."""
    (loop,) = single_loops(scene_of(SLOTTED_LEVER.format(crank=crank) + DRIVEN))
    assert isinstance(loop, SliderCrank)
    assert (loop.guide, loop.block) == ("3", "2")
    assert dict([loop.crank, loop.rod]) == {"0": 3, "1": crank}
    assert loop.turning == turning
