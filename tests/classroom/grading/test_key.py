"""The key earns everything, and a careful drawing nearly everything, in every shipped lab."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
from msgspec.structs import replace

from graphkin.accuracy.pencil import Pencil
from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.grading.graded import Status
from graphkin.classroom.grading.marking import sense_is_open
from graphkin.classroom.grading.standard import (
    FINE,
    added,
    combined,
    covariance,
    extent,
    joint_drawings,
)
from tests.classroom.grading.students import (
    LABS,
    book_of,
    drawn,
    given,
    key_answers,
    lab_of,
    marker_of,
    marker_with,
    scene_of,
    taker,
)

VARIANTS = range(1, 31)
"""The numbers of a half-group, for which the shipped labs are made."""
DRAWINGS = 600
CAREFUL, COARSE = 0.25, 2.0


@pytest.mark.parametrize("name", LABS)
def test_the_key_earns_all_points_in_every_variant(name):
    for n in VARIANTS:
        marker = marker_of(name, n)
        graded = marker.mark(taker(n), key_answers(marker.standard))
        assert graded.earned == graded.points > 0, [
            (m.item.field, m.status) for m in graded.marks if m.earned < m.points
        ]


def test_where_no_drawing_tells_a_sense_both_are_right():
    """A rate that is zero within what a hand as coarse as six millimetres makes of it."""
    marker = marker_with("pump", (), point=6.0, line=6.0)
    key, found = marker.standard.key, {}
    for field in (f for f in key if f.endswith("_sense")):
        answers = key_answers(marker.standard) | given({field: -key[field]})
        rate = field.removesuffix("_sense")
        is_open = abs(key[rate]) <= 0.9 * marker.standard.tolerance[rate].pencil
        found.setdefault(is_open, set()).add(marker.mark(taker(), answers).mark(field).status)
    assert found[True] == {Status.RIGHT}
    assert Status.RIGHT not in found.get(False, ())


def chances(name: str, pencil: float) -> dict[str, list[float]]:
    """How often each field of each variant is right by the key with a pencil."""
    found: dict[str, list[float]] = {}
    for n in VARIANTS[::2]:
        marker = marker_of(name, n)
        standard, points = marker.standard, marker.standard.rubric.points
        for field, values in drawn(standard, pencil, DRAWINGS, seed=n).items():
            if field not in points:
                continue
            if standard.by_field[field].item.what == "sense":
                right = (values == standard.key[field]) | sense_is_open(standard, field)
            elif standard.by_field[field].item.what == "place":
                right = abs(values - standard.key[field]) <= standard.tolerance[field].value
            else:
                off = abs(abs(values) - abs(standard.key[field]))
                right = off <= standard.tolerance[field].value
            found.setdefault(field, []).append(float(np.mean(right)))
    return found


@pytest.mark.parametrize("name", LABS)
def test_a_careful_pencil_passes_every_field_in_95_of_100_drawings_and_a_coarse_one_fewer(name):
    lucky = 0.95 - 4 * (0.95 * 0.05 / DRAWINGS) ** 0.5  # the least of 200 shares
    for field, shares in chances(name, CAREFUL).items():
        assert np.mean(shares) >= 0.95, field
        assert min(shares) >= lucky, (field, shares)
    found = chances(name, COARSE)
    measured = {field: np.mean(shares) for field, shares in found.items() if "_sense" not in field}
    assert measured
    assert max(measured.values()) < 0.75, measured


@pytest.mark.parametrize("name", LABS)
def test_tolerances_are_made_of_pencil_ruler_floor_and_cap(name):
    for n in (1, 7, 25):
        standard = marker_of(name, n).standard
        rubric = standard.rubric
        for field, found in standard.tolerance.items():
            size = abs(standard.key[field])
            whole = np.hypot(found.pencil, found.ruler)
            fine = np.hypot(FINE * found.pencil, found.ruler)
            assert found.value >= found.ruler
            if standard.by_field[field].item.what != "place":
                assert found.value >= rubric.floor * size
                assert found.value <= max(rubric.cap * size, fine, rubric.floor * size) * (
                    1 + 1e-12
                )
                assert found.unsure == (whole > rubric.cap * size)


@pytest.mark.parametrize("name", LABS)
def test_the_pencil_of_a_tolerance_is_that_of_drawings_in_which_all_marks_are_off(name):
    """The 95th percentile of 4 000 joint drawings, within a tenth; unsure fields are left out."""
    standard = marker_of(name, 12).standard
    found = joint_drawings(standard.exact, Pencil(0.5, 0.5), 4000, seed=3)
    for probe in standard.layout.probes:
        field = probe.item.field
        if probe.item.what != "sense" and not standard.tolerance[field].unsure:
            off = abs(probe.error(found, standard.paper, standard.key[field]))
            drawn_error = np.percentile(np.broadcast_to(off, 4000), 95)
            assert standard.tolerance[field].pencil == pytest.approx(drawn_error, rel=0.1)


def test_tolerances_do_not_hang_on_where_the_origin_lies():
    """Where all points of the frame are moved alike, what caps those of places stays as large."""
    lab = lab_of("pump")
    strict = replace(lab, rubric=replace(lab.rubric, cap=0.001))
    text = scene_of("pump").read_text(encoding="utf-8")
    moved = text
    for old, new in (("[0, 0]", "[500, 200]"), ("[0, -30]", "[500, 170]")):
        moved = moved.replace(old, new)
    here, there = (Book(strict, each).marker({"n": "7"}).standard for each in (text, moved))
    values = {field: one.value for field, one in here.tolerance.items()}
    assert {f: one.value for f, one in there.tolerance.items()} == pytest.approx(values, rel=1e-9)


def test_a_computed_value_is_held_to_the_cap():
    """Student 25 cannot measure the piston's acceleration: zero is not right for 30 m/s²."""
    book = book_of("pump")
    measured = book.marker({"n": "25"}).standard
    computed = book.marker({"n": "25"}, ("a_D_mm", "a_D")).standard
    right = abs(computed.key["a_D"])
    assert measured.tolerance["a_D"].value > right
    assert computed.tolerance["a_D"].value == pytest.approx(computed.rubric.cap * right)
    assert computed.tolerance["v_D"] == measured.tolerance["v_D"]


@pytest.mark.parametrize("bias", [2.0, 3.0])
def test_errors_that_lead_to_one_side_widen_the_95th_percentile(bias):
    """Fifty alike, of variance 1 together, whose bends move their sum by a bias: it is nearly
    normal, and a scaled chi-square has the mean and the variance of its square."""
    count, node = 50, np.sqrt(3)
    off = np.array([way * node / np.sqrt(count) + 3 * bias / count for way in (-1, 1)])
    ((error,), _) = added(np.broadcast_to(off, (1, count, 2)))
    places, weights = np.polynomial.hermite_e.hermegauss(8)
    square = (bias + np.sqrt(1 + 2 * bias**2 / count) * places) ** 2
    mean = np.average(square, weights=weights)
    degrees = 2 * mean**2 / np.average((square - mean) ** 2, weights=weights)

    def lacking(x):
        return mpmath.gammainc(degrees / 2, 0, x / 2, regularized=True) - 0.95

    expected = np.sqrt(float(mpmath.findroot(lacking, degrees + 4)) * mean / degrees)
    assert error == pytest.approx(expected, rel=0.006)  # of Wilson and Hilferty


def test_fields_go_together_as_the_errors_that_move_them_do():
    """Each error is √3 deviations off to either side once in six drawings, and else right; of two
    errors all nine drawings are written down. A field whose errors do not just add goes alone."""
    off = np.array([[[-1.0, 1.2], [0.5, -0.4]], [[-0.3, 0.3], [0.8, -1.0]], [[2.0, 2.0], [1, 1]]])
    ways = np.insert(off, 1, 0.0, axis=2)
    drawn_off = (ways[:, 0, :, None] + ways[:, 1, None, :]).reshape(3, 9)
    share = np.outer([1, 4, 1], [1, 4, 1]).ravel() / 36
    expected = np.cov(drawn_off, aweights=share, ddof=0)
    expected[2], expected[:, 2] = 0, 0
    expected[2, 2] = (9.8 / 1.959963984540054) ** 2
    bent = np.array([False, False, True])
    assert covariance(off, np.array([5.0, 5.0, 9.8]), bent) == pytest.approx(expected)


def test_what_is_drawn_is_held_to_no_less_than_the_ruler_tells_though_no_drawing_closes():
    standard = marker_of("pump", 7).standard
    (reading, *_) = [each for each in standard.readings if each.probe.item.unit == "mm"]
    strict = replace(standard.rubric, cap=0.0, floor=0.0)
    found = combined(reading, float("inf"), strict, 100.0, drawn=True)
    assert found.value == found.most == strict.ruler > 0
    assert combined(reading, float("inf"), strict, 100.0, drawn=False).value == 0


@pytest.mark.parametrize(("cap", "unsure"), [(4.9, True), (5.1, False)])
def test_a_field_is_unsure_where_pencil_and_ruler_together_are_beyond_the_cap(cap, unsure):
    """3 mm and 4 mm are 5 mm together."""
    standard = marker_of("pump", 7).standard
    (reading, *_) = [each for each in standard.readings if each.probe.item.what == "segment"]
    rubric = replace(standard.rubric, cap=cap / abs(reading.value), ruler=4.0)
    assert combined(reading, 3.0, rubric, 100.0, drawn=True).unsure is unsure


@pytest.mark.parametrize("name", ["pump", "offset-slider-crank"])
def test_a_mechanism_is_as_large_as_the_longer_side_of_the_box_round_its_points(name):
    """The pump is higher than wide, the slider-crank wider than high."""
    standard = marker_of(name, 7).standard
    places = [point.position for point in standard.mechanism.solve().points.values()]
    wide, high = np.ptp(np.real(places)), np.ptp(np.imag(places))
    assert (wide > high) == (name != "pump")
    assert extent(standard.exact) == pytest.approx(1000 * max(wide, high) / standard.scales.kL)
