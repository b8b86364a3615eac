"""The odds of a copy are odds: of honest pairs 1 in N has more than N, or fewer.

Hands share nothing with the marking; those of a pair have the same data and the same slip, or
other data and other slips.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from math import comb, exp, log, pi, sqrt
from types import SimpleNamespace

import numpy as np
import pytest

from graphkin.classroom.grading.copied_answers import (
    FEW,
    AnswerSheet,
    by_oneself,
    by_own_scales,
    chosen,
    copies,
    copy_evidence,
    misunderstood,
    sheet,
    with_causes,
)
from graphkin.classroom.grading.graded import Answer, Graded
from graphkin.classroom.grading.keys import (
    MISTAKES,
    PENCILS,
    Key,
    Keys,
    distinct,
    judged,
    likelihood_if_drawn,
    scattered,
)
from graphkin.classroom.grading.marking import is_one_drawing
from graphkin.classroom.lab.lab_model import exact_text
from graphkin.classroom.roster.students import Student, Taker
from tests.chosen import EVERY
from tests.classroom.grading import hand
from tests.classroom.grading.classes import LABS, Kind, book_of, row
from tests.classroom.grading.students import marker_of

FINE = Kind("fine", (0.25, 0.25))
ORDINARY = Kind("ordinary", (0.5, 0.5), digits=3)
WEAK = Kind("weak", (0.5, 0.5), step=1, digits=2)
COMPUTED = Kind("computed", (0.0, 0.02), step=0.1)
KINDS = (FINE, ORDINARY, WEAK, COMPUTED) if EVERY else (ORDINARY, WEAK)
EACH = 12 if EVERY else 8
SLIPS = (None, *hand.SLIPS)
SOME = SLIPS if EVERY else ("wrong_scale", "normal_reversed")
Rows = Sequence[Mapping[str, Answer]]


def marked(lab: str, numbers: Sequence[int], rows: Rows) -> list[Graded]:
    """The marks of students with some numbers."""
    takers = [
        Taker(Student(i + 1, f"s{i:03d}"), {"n": exact_text(Fraction(n))})
        for i, n in enumerate(numbers)
    ]
    book = book_of(lab)
    book.prepare(takers)
    return [book.marker_of(who).mark(who, row) for who, row in zip(takers, rows, strict=True)]


def drawings(lab: str, kind: Kind, given: Sequence[tuple[int, str | None]], seed: int) -> Rows:
    """Honest answers, each to a number, with a slip or none."""
    rng = np.random.default_rng([seed, *kind.name.encode()])
    rows = []
    for number, slip in given:
        taker = Taker(Student(1, "s"), {"n": exact_text(Fraction(number))})
        own = Kind(kind.name, kind.sigma, 1.0, kind.step, kind.digits, float(bool(slip)), (slip,))
        rows.append(row(lab, taker, own, rng))
    return rows


def odds(lab: str, graded: Sequence[Graded], is_pair=lambda i, j: True) -> list[float]:
    """The odds of a copy of all pairs; zero where too few digits are the same."""
    book = book_of(lab)
    standards = [book.expectation(each.taker) for each in graded]
    own, mine = distinct(standards)
    keys = Keys.of(own)
    sheets = {
        i: with_causes(sheet(each, keys, mine[id(standard)]), each, keys, book.ways)
        for i, (each, standard) in enumerate(zip(graded, standards, strict=True))
    }
    found = []
    for pair in combinations(range(len(graded)), 2):
        one, other = (sheets[who].answers for who in pair)
        places = np.flatnonzero((one == other) & (one != 0)).tolist()
        if is_pair(*pair):
            enough = len(places) >= FEW
            found.append(exp(copy_evidence(pair, sheets, keys, places)) if enough else 0.0)
    return found


def assert_odds(found: Sequence[float]) -> None:
    """That of so many pairs no larger share has odds above a number than odds allow."""
    for number in (3, 10, 30, 100, 1000):
        assert sum(each > number for each in found) <= max(1.0, len(found) / number), number


@pytest.mark.parametrize("lab", LABS if EVERY else LABS[1:2])
def test_two_honest_hands_with_one_misunderstanding_and_the_same_data(lab):
    """Whichever they draw with, and however coarsely they write."""
    found = []
    for place, slip in enumerate(SOME):
        for kind in KINDS:
            numbers = [3 * place + 2] * EACH
            rows = drawings(lab, kind, [(n, slip) for n in numbers], place)
            found += odds(lab, marked(lab, numbers, rows))
    assert len(found) == comb(EACH, 2) * len(KINDS) * len(SOME)
    assert sum(each > 0 for each in found) > 30
    assert_odds(found)


@pytest.mark.parametrize("slip", hand.SLIPS if EVERY else ["wrong_scale"])
def test_an_honest_hand_with_a_misunderstanding_and_one_with_other_data(slip):
    """A value twice as large is another's value: who takes a scale wrongly has that in all."""
    lab, numbers = "slotted-lever", [*range(1, 31)] * 4
    given = [(n, slip if i < 60 else None) for i, n in enumerate(numbers)]
    graded = marked(lab, numbers, drawings(lab, WEAK, given, 7))
    found = odds(lab, graded, lambda i, j: i < 60 <= j and (j - i) % 30 > 0)
    assert len(found) == 60 * 58
    assert slip != "wrong_scale" or sum(each > 0 for each in found) > 3
    assert_odds(found)


# --- one pair ------------------------------------------------------------------------------------

DOUBLED = {
    "v_C_mm": "128", "v_C": "1.4", "v_A3_mm": "86", "v_A3": "0.94", "a_C_mm": "92", "a_C": "5.5",
    "a_A3_mm": "48", "a_A3": "2.8", "omega_3": "2.5", "omega_4": "2.2", "epsilon_3": "6.9",
    "epsilon_4": "4.4", "v_slide_2": "0.93", "a_slide_2": "3.9",
}  # fmt: skip
"""Number 1, all values by scales twice as large."""
RIGHT = {
    "v_C_mm": "161", "v_C": "1.4", "v_A3_mm": "107", "v_A3": "0.94", "a_C_mm": "49", "a_C": "3.8",
    "a_A3_mm": "36", "a_A3": "2.8", "omega_3": "2.4", "omega_4": "1.3", "epsilon_3": "4.1",
    "epsilon_4": "15", "v_slide_2": "0.48", "a_slide_2": "6.2",
}  # fmt: skip
"""Number 17."""


def test_who_doubles_all_values_has_three_of_another_by_chance():
    """Alone in their class, where no other pair was looked through: the rest of the sheet tells of
    the doubling, and then these are as likely, within a factor of two, as they are for whoever has
    them rightly: a drawing of twice the size has errors of its own."""
    rows = [{f: Answer(text, float(text)) for f, text in row.items()} for row in (DOUBLED, RIGHT)]
    graded = marked("slotted-lever", [1, 17], rows)
    same = [f for f in DOUBLED if DOUBLED[f] == RIGHT[f]]
    assert same == ["v_C", "v_A3", "a_A3"]
    book = book_of("slotted-lever")
    assert copies(graded, [book.expectation(each.taker) for each in graded], book.ways) == ()
    (found,) = odds("slotted-lever", graded)
    assert 0 < found < 1
    keys = Keys.of([book.expectation(each.taker) for each in graded])
    one, other = (
        with_causes(sheet(each, keys, i), each, keys, book.ways) for i, each in enumerate(graded)
    )
    agree = one.answers == other.answers
    doubled, right = (
        by_oneself(*pair, keys, agree, ~agree) for pair in ((one, other), (other, one))
    )
    assert doubled == pytest.approx(right, abs=log(2))


def test_what_may_be_copied_of_a_form_has_a_share_that_adds_up_to_one():
    """Every choice of fields: two quantities with a length and a value, and a value alone."""
    keys = Keys((), None, None, np.array([0, 0, 2, 2, 4]), None, None, None, ())
    there = np.ones(5, dtype=bool)
    every = [np.array([bool(n >> i & 1) for i in range(5)]) for n in range(32)]
    assert sum(exp(-chosen(keys, there, each)) for each in every) == pytest.approx(1.0)


@pytest.mark.parametrize(("times", "coarse", "less"), [(1, 1, 1), (3, 3, 1), (0.5, 1, 0.5)])
@pytest.mark.parametrize("apart", [0.0, 7.0])
@pytest.mark.parametrize("digits", [0.05, 0.9])
def test_how_often_two_who_misunderstand_alike_write_the_same_digits(
    times, coarse, less, apart, digits
):
    """The difference of two drawings, each rounded, is spread as the sum of their variances (a
    rounding by up to r has r²/3); digits are the same within twice a rounding about zero."""
    pencil, least, spread = 0.8, 0.25, np.array([0.3, 0.6])
    sizes = np.array([[60.0, 80.0], [60.0 + apart, 80.0 - apart]])
    places, mean = np.zeros(2, dtype=bool), sizes.mean(axis=0)

    def key(variant, read):
        return Key(
            sizes[variant][read], np.diag(spread)[np.ix_(read, read)], None, None, places[read]
        )

    keys = SimpleNamespace(key=key, sizes=sizes)
    one, other = (
        AnswerSheet(times * mean, np.full(2, own), np.full(2, least), places, variant, ())
        for variant, own in ((0, digits), (1, digits / 2))
    )
    rounding = max(digits, least * coarse)
    variances = 2 * (pencil * less) ** 2 * spread + 2 * rounding**2 / 3 + (less * apart) ** 2
    each = [2 * rounding / sqrt(2 * pi * variance) for variance in variances]
    for read in ([True, True], [True, False], [False, True], [False, False]):
        expected = np.prod([share for share, is_read in zip(each, read, strict=True) if is_read])
        found = misunderstood(one, other, keys, np.array(read), pencil)
        assert exp(found) == pytest.approx(min(1.0, expected))


@pytest.mark.parametrize("count", [3, 6, 11])
def test_of_a_hundred_careful_drawings_five_are_taken_for_more_than_one(count):
    """Values that go together are off together; each is rounded besides. Of few nothing is told."""
    rng = np.random.default_rng(count)
    way = rng.normal(size=(count, count)) + 2
    computed, rounded = rng.uniform(0.1, 2, size=(2, count))
    key = Key(None, way @ way.T, computed, None, None)
    off = rng.normal(size=(6000, count)) @ way.T + rng.normal(size=(6000, count)) * computed
    off += rng.uniform(-1, 1, size=(6000, count)) * rounded
    assert is_one_drawing(off, rounded, key).mean() == pytest.approx(0.95, abs=0.012)
    assert not is_one_drawing(off + 9 * np.sqrt(np.diag(key.spread)), rounded, key).any()
    few = Key(None, np.eye(1), np.ones(1), None, None)
    assert not is_one_drawing(np.zeros((4, 1)), np.ones(1), few).any()


@pytest.mark.parametrize("computed", [1e-3, 0.2])
def test_answers_are_as_likely_as_the_normal_law_of_each_pencil_has_them(computed):
    """The mean of its densities over all pencils, by the determinant and the inverse; what is
    written to many digits is as sure as these are."""
    rng = np.random.default_rng(5)
    way, cranks = rng.normal(size=(4, 4)) + 1, rng.normal(size=(1, 4)) * 0.01
    rounding, sizes = np.full(4, computed), np.full(4, 50.0)
    key = Key(sizes, way @ way.T * 1e-4, np.full(4, computed), cranks, np.zeros(4, dtype=bool))
    noise = np.diag(computed**2 + rounding**2 / 3) + 25 * cranks.T @ cranks  # 5° for a crank
    off, fits = rng.normal(size=4) * computed, np.array([True, True, False, True])
    densities = []
    for pencil in PENCILS:
        spread = (pencil**2 * key.spread + noise)[np.ix_(fits, fits)]
        far = off[fits] @ np.linalg.inv(spread) @ off[fits]
        densities.append(exp(-far / 2) / sqrt(np.linalg.det(2 * pi * spread)))
    lost = log(MISTAKES) + scattered(sizes + off, key)[2]
    expected = log(np.mean(densities)) + 3 * log(1 - MISTAKES) + lost
    assert likelihood_if_drawn(sizes + off, rounding, key, fits) == pytest.approx(
        expected, abs=1e-5
    )


def test_mistakes_are_spread_so_that_half_lie_within_a_factor_of_two_or_10_mm():
    """All of them make one, by the trapezoidal rule."""
    for places, far, inner in (
        (False, np.geomspace(1e-5, 1e9, 40001), (25.0, 100.0)),
        (True, np.sinh(np.linspace(-16, 16, 40001)) + 50.0, (40.0, 60.0)),
    ):
        count = len(far)
        key = Key(np.full(count, 50.0), None, None, None, np.full(count, places))
        dense = np.exp(scattered(far, key))
        parts = (dense[1:] + dense[:-1]) / 2 * np.diff(far)
        within = (far[1:] <= inner[1]) & (far[:-1] >= inner[0])
        assert parts.sum() == pytest.approx(1.0, abs=0.04)
        assert parts[within].sum() == pytest.approx(0.5, abs=0.002)


@pytest.mark.parametrize("lab", ("pump", "slotted-lever"))
@pytest.mark.parametrize(("velocities", "accelerations"), [(2.0, 1.0), (1.0, 0.3), (1.3, 0.7)])
def test_scales_of_one_s_own_are_told_plan_by_plan(lab, velocities, accelerations):
    """Lengths are measured whatever the scale is; a scale nearly right is none of one's own."""
    keys = Keys.of([marker_of(lab, 7).standard.expectation])
    begins = {("v", "omega"): velocities, ("a", "epsilon"): accelerations}
    times = np.ones(len(keys.fields))
    for place, field in enumerate(keys.fields):
        for names, factor in begins.items():
            if field.startswith(tuple(f"{name}_" for name in names)) and not field.endswith("_mm"):
                times[place] = factor
    sizes, every = keys.sizes[0], ~np.isnan(keys.sizes[0])
    (way,) = by_own_scales(sizes * times, keys, 0, every)
    assert way.times == pytest.approx(times)
    assert way.sizes == pytest.approx(sizes * times)
    assert not [*by_own_scales(sizes * times, keys, 0, every & (times == 1))]
    assert not [*by_own_scales(sizes * 1.2, keys, 0, every)]


def test_the_answer_least_like_the_others_lies_most_deviations_from_what_they_tell():
    """Each is told by the others as the normal law of all has it; not the one that lies farthest
    off, nor the one that is pulled most."""
    rng, others = np.random.default_rng(11), 0
    for _ in range(20):
        way = rng.normal(size=(4, 4)) * rng.uniform(0.1, 3, (4, 1))
        spread, noise = way @ way.T, np.diag(rng.uniform(0.01, 1, 4))
        off, every = rng.normal(size=4), np.ones(4, dtype=bool)
        found, worst = judged(off, spread, noise, np.zeros(4), every)
        whole = found.pencil**2 * spread + noise
        far = []
        for i in range(4):
            rest = [j for j in range(4) if j != i]
            tells = whole[i, rest] @ np.linalg.inv(whole[np.ix_(rest, rest)])
            far.append((off[i] - tells @ off[rest]) ** 2 / (whole[i, i] - tells @ whole[rest, i]))
        assert worst == int(np.argmax(far))
        scale = np.sqrt(spread.diagonal() + noise.diagonal())
        pulled = np.linalg.solve(whole / np.outer(scale, scale), off / scale)
        others += worst != int(np.argmax(pulled**2))
    assert others > 2
