"""What a mechanism's field holds: the same for many sheets at once as for each by itself."""

import numpy as np
import pytest

from graphkin.construction.core.layout import GROUND, POLES, SPARE, held_beside, room_below
from graphkin.drawing.field import A3, ABOVE, LEAST_FIELD, MARGIN
from graphkin.drawing.scale import Extent

DRAWN = np.random.default_rng(19)
COUNT = 40
LEFT, BOTTOM = DRAWN.uniform(-0.3, 0, (2, COUNT))
RIGHT, TOP = DRAWN.uniform(0, 0.3, (2, COUNT))
AWAY = DRAWN.uniform(-1, 1, (2, COUNT)) + 1j * DRAWN.uniform(-1, 1, (2, COUNT))
MM, PLAN = DRAWN.uniform(100, 500, COUNT), DRAWN.uniform(20, 300, COUNT)


def test_many_sheets_at_once_hold_what_each_holds_by_itself():
    every = held_beside(A3, Extent(LEFT, BOTTOM, RIGHT, TOP), [*AWAY], MM, PLAN)
    for k in range(COUNT):
        box = Extent(*(float(side[k]) for side in (LEFT, BOTTOM, RIGHT, TOP)))
        poles = [complex(pole[k]) for pole in AWAY]
        own = held_beside(A3, box, poles, float(MM[k]), float(PLAN[k]))
        assert [side[k] for side in every.box.sides] == [*own.box.sides]
        assert every.width[k] == own.width


def test_a_pole_is_held_only_where_the_field_has_room_for_it():
    box = Extent(0.0, 0.0, 0.1, 0.1)
    near, far = (
        held_beside(A3, box, [0.2 + 0.1j], 500.0, 200.0),
        held_beside(A3, box, [9j], 500.0, 50.0),
    )
    assert near.box == Extent(0.0, 0.0, 0.2, 0.1)
    assert near.width == max(0.2 * 500 + POLES, LEAST_FIELD)
    assert far.box == box


@pytest.mark.parametrize("plan", [50.0, 150.0, 200.0, 240.0, 280.0])
def test_what_a_wide_field_of_the_plan_has_too_much_of_is_shared_equally(plan):
    width = held_beside(A3, Extent(0.0, 0.0, 0.1, 0.1), [], 500.0, plan).width
    beside = A3.fields[2] - A3.fields[0] - width
    more = width - LEAST_FIELD, beside - max(plan + 2 * MARGIN, LEAST_FIELD) - SPARE
    assert more[0] == pytest.approx(max(more[1], 0.0))
    assert min(more) <= 0 or more[0] == pytest.approx(more[1])


def test_a_pole_at_infinity_leaves_the_box_of_its_sheet_alone():
    box = Extent(np.zeros(2), np.zeros(2), np.full(2, 0.1), np.full(2, 0.1))
    held = held_beside(A3, box, [np.array([np.nan + 0j, 0.2 + 0.1j])], np.full(2, 500.0), 50.0)
    assert [*held.box.right] == [0.1, 0.2]


@pytest.mark.parametrize("spare", [0.0, 4.0, 12.0, 18.0, 60.0, -20.0])
def test_what_is_spare_goes_half_below_but_the_ground_of_the_pivots_gets_its_room_first(spare):
    below = room_below(A3, A3.upright - spare) - ABOVE
    over = max(spare, 0.0) - below
    if below > GROUND - ABOVE:
        assert below == pytest.approx(over)
    elif over > 0:
        assert below == pytest.approx(GROUND - ABOVE)
        assert over < below
    else:
        assert below == pytest.approx(max(spare, 0.0))
