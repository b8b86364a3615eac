"""A whole plan at another scale, turned or mirrored has one cause; a right one has none."""

from __future__ import annotations

import cmath

import pytest

from graphkin.reading.marked_drawing import DASH, dashes, expected_lines
from graphkin.reading.plan_causes import PlanCause, Shaft, Similarity, similarity_of
from graphkin.reading.point_reading import PointReading, pair
from graphkin.reading.read_sheet import SheetRecord
from graphkin.text import words
from tests.reading.test_reading import ink_of
from tests.reading.test_vector_ends import Strokes, vector

POLE = 300 + 150j
TIPS = [POLE + each for each in (60 - 30j, 48 + 26j, -20 + 44j)]
SHAFTS: list[Shaft] = [*((POLE, tip) for tip in TIPS), (TIPS[0], TIPS[1]), (TIPS[1], TIPS[2])]
"""The vectors of the key."""
CASES = {
    "halved": Similarity(POLE, 0.5 + 0j, False),
    "spun": Similarity(POLE, cmath.rect(1.0, 0.5), False),
    "mirrored": Similarity(POLE, -1 + 0j, True),
    "smaller and spun": Similarity(POLE, cmath.rect(0.8, -1.0), False),
}


def strokes(drawn: Similarity, *, lacking: int = 0) -> Strokes:
    """A plan drawn by a similarity, without some of its last vectors."""
    shafts = SHAFTS[: len(SHAFTS) - lacking]
    return [stroke for tail, tip in shafts for stroke in vector(drawn(tail), drawn(tip))]


def found(drawn: Similarity, *, lacking: int = 0) -> PlanCause | None:
    """The cause seen where the first point was read."""
    ink = ink_of(*strokes(drawn, lacking=lacking))
    similarity = similarity_of(ink, SHAFTS, POLE, [drawn(TIPS[0])])
    return None if similarity is None else similarity.cause


@pytest.mark.parametrize("name", CASES)
def test_the_similarity_of_a_whole_plan_is_found(name: str) -> None:
    drawn, cause = CASES[name], found(CASES[name])
    assert cause is not None
    assert cause.factor == pytest.approx(abs(drawn.size), abs=0.02)
    assert cause.mirrored == drawn.mirrored
    if not drawn.mirrored:
        assert cmath.rect(1, cmath.pi / 180 * cause.turn) == pytest.approx(
            drawn.size.conjugate() / abs(drawn.size), abs=0.02
        )


def test_a_right_plan_and_one_that_lacks_a_vector_have_no_cause() -> None:
    assert found(Similarity(POLE, 1 + 0j, False)) is None
    assert found(CASES["halved"]) is not None
    assert found(CASES["halved"], lacking=1) is None


def test_a_right_plan_with_a_small_one_on_it_has_no_cause() -> None:
    """A point was misread where letters look like a plan of a tenth of the size."""
    right = Similarity(POLE, 1 + 0j, False)
    small = Similarity(POLE, cmath.rect(0.4, 1.2), False)
    assert found(small) is not None
    ink = ink_of(*strokes(small), *strokes(right, lacking=1))
    assert similarity_of(ink, SHAFTS, POLE, [small(TIPS[0])]) is None


def test_the_cause_is_said_in_the_readers_language() -> None:
    half, turned = PlanCause(0.5, 0.0), PlanCause(1.0, -30.0)
    assert list(half.sentences(words("en"))) == ["The whole plan is drawn at 0.50 times its size"]
    assert list(half.sentences(words("it"))) == [
        "L’intero piano è disegnato 0,50 volte la sua grandezza"
    ]
    assert list(turned.sentences(words("en"))) == ["The whole plan is turned by −30°"]
    assert list(PlanCause(1.0, 140.0, True).sentences(words("en"))) == [
        "The whole plan is mirrored"
    ]


def line_of(tail: complex, tip: complex) -> tuple[float, float, float, float]:
    return (*pair(tail), *pair(tip))


def test_the_plan_that_was_expected_is_shown_where_all_of_it_is_moved() -> None:
    """Of the mechanism, which is right, no line is shown again; of a right plan nothing."""
    drawn, pin = CASES["halved"], 80 + 120j
    points = [
        *(PointReading("b", i, pair(drawn(tip)), "wrong", True, pair(tip), pair(tip))
          for i, tip in enumerate(TIPS)),
        PointReading("B", 9, pair(pin), "right", False, pair(pin), pair(pin)),
    ]  # fmt: skip
    plan = tuple(line_of(*shaft) for shaft in SHAFTS)
    lines = (*plan, line_of(pin - 40, pin))
    cause = PlanCause(0.5, 0.0)
    record = SheetRecord("one", "one.jpg", "", key_lines=lines, cause=cause)
    assert expected_lines(record, points) == plan
    assert not expected_lines(SheetRecord("one", "one.jpg", "", key_lines=lines), points)


def test_dashes_cover_half_of_a_line_and_end_on_it() -> None:
    line = (10.0, 20.0, 10.0, 20.0 + 9 * DASH)
    pieces = list(dashes(line))
    assert pieces[-1][3] == line[3]
    assert sum(each[3] - each[1] for each in pieces) == pytest.approx(5 * DASH)


SHORT = POLE + 6 + 18j
"""The tip of a vector of the key that is 19 mm long."""


def test_the_scale_is_that_of_the_lines_and_not_of_one_point_that_was_read_beside() -> None:
    """A point 0.5 mm off at the end of a vector of 9.5 mm gave 0.52 times the size."""
    half = CASES["halved"]
    shafts = [(POLE, SHORT), *SHAFTS]
    ink = ink_of(*strokes(half), *vector(POLE, half(SHORT)))
    beside = half(SHORT) + 0.5 * (SHORT - POLE) / abs(SHORT - POLE)
    similarity = similarity_of(ink, shafts, POLE, [beside])
    assert similarity is not None
    assert similarity.cause.factor == pytest.approx(0.5, abs=0.004)


def test_a_short_vector_under_letters_leaves_a_plan_its_cause() -> None:
    """Of 14 mm on paper no more than the half is seen; a long vector must be drawn."""
    half, tip = CASES["halved"], TIPS[0] + 28j
    shafts = [*SHAFTS, (TIPS[0], tip)]
    part = (half(TIPS[0]), half(TIPS[0]) + 0.55 * (half(tip) - half(TIPS[0])))
    ink = ink_of(*strokes(half), part)
    assert similarity_of(ink, shafts, POLE, [half(TIPS[0])]) is not None
    assert similarity_of(ink, [*SHAFTS, (TIPS[0], tip + 40j)], POLE, [half(TIPS[0])]) is None


def test_some_heads_are_enough_where_all_lines_of_a_plan_are_drawn() -> None:
    """Heads of several vectors to one point cover each other; lines without a head show nothing."""
    half = CASES["halved"]
    bare = [(half(tail), half(tip)) for tail, tip in SHAFTS]
    headed = [stroke for tip in TIPS[::2] for stroke in vector(half(POLE), half(tip))]
    assert similarity_of(ink_of(*bare, *headed), SHAFTS, POLE, [half(TIPS[0])]) is not None
    assert similarity_of(ink_of(*bare), SHAFTS, POLE, [half(TIPS[0])]) is None


@pytest.mark.parametrize("name", ["spun", "mirrored"])
def test_the_direction_of_a_line_that_runs_on_beyond_its_vector_is_enough(name: str) -> None:
    """Of a plan that is turned or mirrored often no point is read: all are far from the key."""
    drawn = CASES[name]
    far = [POLE + 1.3 * (drawn(tip) - POLE) for tip in TIPS]
    ink = ink_of(*strokes(drawn), *((POLE, place) for place in far))
    similarity = similarity_of(ink, SHAFTS, POLE, far)
    assert similarity is not None
    assert similarity.size == pytest.approx(drawn.size, abs=0.01)


def test_a_turned_plan_need_not_be_exact() -> None:
    """A careful hand is a millimetre off at the far ends of a plan."""
    turned = CASES["spun"]
    off = {
        tip: side * 1j * (tip - POLE) / 60 for tip, side in zip(TIPS, (1.1, -1.4, 1.1), strict=True)
    }
    drawn = [(turned(a) + off.get(a, 0), turned(b) + off.get(b, 0)) for a, b in SHAFTS]
    ink = ink_of(*(stroke for shaft in drawn for stroke in vector(*shaft)))
    similarity = similarity_of(ink, SHAFTS, POLE, [b for _, b in drawn[:3]])
    assert similarity is not None
    assert similarity.size == pytest.approx(turned.size, abs=0.03)
