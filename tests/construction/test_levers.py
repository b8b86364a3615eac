"""Points of levers and plates: on a slot or beside it, on the line of two others."""

from __future__ import annotations

from cmath import exp, phase

import numpy as np
import pytest

from graphkin.construction.core.program import Plane
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of
from graphkin.drawing.richtext import plain
from graphkin.text import words
from graphkin.text.errors import ClosureError
from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text

CRANK, PIVOT, RADIUS, ANGLE, SPEED = 0j, -0.04j, 0.09, 35.0, 9.0
LEVER = scene_text("construction/crank-and-lever")
BELL = "Q-B = 0.07\nB-Q-E = 90\nQ-E = 0.06"
SLOTTED = scene_text("construction/second-slot")


def lever_of(shape: str, more: str = ""):
    """The crank and lever with some shape of the lever, and what else there is."""
    return mechanism_of(LEVER.replace("SHAPE", shape) + more)


def lever_turn(time: float) -> complex:
    """The direction from the pivot to the crank's pin, at a time from the drawn position."""
    pin = CRANK + RADIUS * exp(1j * (np.radians(ANGLE) + SPEED * time))
    return exp(1j * phase(pin - PIVOT))


def rates(place, step: float = 1e-4) -> tuple[complex, complex, complex]:
    """A place at the drawn position, its velocity and acceleration, by central differences."""
    before, here, after = (place(k * step) for k in (-1, 0, 1))
    return here, (after - before) / (2 * step), (after - 2 * here + before) / step**2


def test_a_second_slot_of_a_lever_stands_at_its_own_angle():
    """E lies square to QB: the block of the second slot is led by that, not by the first slot."""
    mechanism = lever_of(BELL, SLOTTED)
    solution = mechanism.solve()

    def led(time: float) -> complex:
        way = 1j * lever_turn(time)
        return PIVOT + way * (-0.08 - PIVOT.real) / way.real

    for point, place in (("D", led), ("E", lambda t: PIVOT + 0.06j * lever_turn(t))):
        found = solution.points[point]
        here, velocity, acceleration = rates(place)
        assert found.position == pytest.approx(here, rel=1e-14)
        assert found.velocity == pytest.approx(velocity, rel=1e-5)
        assert found.acceleration == pytest.approx(acceleration, rel=1e-4)
    assert mechanism.witness(solution).agrees


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        (BELL, "they meet at E, left of Q→B"),
        ("Q-E = 0.06\nQ-B = 0.07\nB-Q-E = 90", "they meet at E, left of Q→B"),
        ("Q-B = 0.07\nQ-E = 0.06\nE = 'beyond Q on B-Q'", "on QB produced beyond Q lay off QE: E"),
        ("Q-B = 0.07\nQ-E = 0.02\nE = 'on Q-B'", "on QB lay off QE: E"),
    ],
    ids=["bell-crank", "bell-crank, other order", "two arms", "on the slot"],
)
@pytest.mark.parametrize(("along", "way"), [("Q-B", "forward"), ("B-Q", "backward")])
def test_the_other_points_of_a_lever_follow_from_the_one_on_its_slot(shape, expected, along, way):
    """By compass from the pivot and that point: no hand knows at what angle the lever stands."""
    text = LEVER.replace("SHAPE", shape).replace('Q-B" }', f'{along}" }}')
    mechanism = mechanism_of(text.replace("forward", way))
    solution = mechanism.solve()
    assert solution.points["B"].position == pytest.approx(PIVOT + 0.07 * lever_turn(0), rel=1e-14)
    assert mechanism.witness(solution).agrees
    drawing = drawings_of(mechanism, solution, words("en"))[0]
    steps = drawing.trace.program.steps
    said = [
        plain(each.markup)
        for each in sentences(drawing)
        if steps[each.step].plane is Plane.MECHANISM
    ]
    assert any("on the line of the link lay off QB: B" in each for each in said)
    assert any(expected in each for each in said)
    assert not any("°" in each for each in said)


COUPLER = scene_text("construction/points-of-a-coupler")


def test_a_point_between_others_is_laid_off_on_their_line_and_not_by_flat_arcs():
    """A and P stand: M and N need neither an arc about B nor its crossing with one about A."""
    mechanism = mechanism_of(COUPLER)
    solution = mechanism.solve()
    a, p, m, n = (solution.points[name].position for name in "APMN")
    assert m == pytest.approx(a + (p - a) * 5 / 7, rel=1e-14)
    assert n == pytest.approx(a + (p - a) * 9 / 7, rel=1e-14)
    drawing = drawings_of(mechanism, solution, words("en"))[0]
    said = " / ".join(plain(each.markup) for each in sentences(drawing))
    assert "on AP lay off AM: M" in said
    assert "on PA produced beyond P lay off PN: N" in said
    assert mechanism.witness(solution).agrees


def test_a_guide_that_its_pin_cannot_reach_is_told_by_its_link():
    """The slot passes Q at 0.2, the pin comes no farther than 0.13 from Q."""
    text = LEVER.replace("SHAPE", "Q-B = 0.07").replace('"Q-B" }', '"Q-B", offset = 0.2 }')
    with pytest.raises(ClosureError) as caught:
        mechanism_of(text).solve()
    assert str(caught.value).startswith(
        "position of link 3: the angle of link 3 cannot be found: "
        "A is nearer to Q than the guide passes it; "
    )
