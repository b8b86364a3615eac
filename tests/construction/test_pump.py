"""The laboratory work itself: the figures that a student should find, to all printed digits."""

from __future__ import annotations

import numpy as np
import pytest

from tests.chosen import STUDENTS
from tests.mechanisms import SHIPPED, shipped

PRINTED = {
    "pump": {
        ("velocity", "D"): "-3.826845090",
        ("acceleration", "D"): "-473.3382916",
        ("omega", "2"): "6.170899",
        ("omega", "3"): "27.647074",
        ("omega", "4"): "-30.749516",
        ("epsilon", "2"): "467.7126",
        ("epsilon", "3"): "-227.1911",
        ("epsilon", "4"): "656.9140",
    },
    "pump-collinear": {
        ("velocity", "D"): "-6.924166867",
        ("acceleration", "D"): "-232.2322399",
        ("omega", "4"): "-21.6973",
        ("epsilon", "4"): "813.359",
    },
}
POLES = {"3": ("-28.5432", "-5.1933"), "4": ("-0.5390", "-23.4573")}
"""Acceleration poles of the pump at n = 7, in cm."""


def as_printed(value: float, printed: str) -> str:
    """A value rounded to as many decimals as the printed one."""
    return f"{value:.{len(printed.partition('.')[2])}f}"


@pytest.mark.parametrize("asked", [False, True], ids=["everything", "only what is asked"])
@pytest.mark.parametrize("name", SHIPPED)
def test_number_7_finds_the_printed_digits(name, asked):
    mechanism = shipped(name, 7)
    trace = mechanism.trace(mechanism.asked() if asked else None)
    for (quantity, of), printed in PRINTED[name].items():
        value = trace.value(quantity, of)
        assert as_printed(value.real, printed) == printed
        assert abs(value.imag) <= 1e-15 * abs(value)


@pytest.mark.parametrize("link", POLES)
def test_number_7_finds_the_printed_acceleration_poles(link):
    pole = shipped("pump", 7).solve().links[link].acceleration_pole
    found = 100 * (pole.start + pole.shift / pole.size)
    assert (as_printed(found.real, "0.1234"), as_printed(found.imag, "0.1234")) == POLES[link]


@pytest.mark.parametrize("name", SHIPPED)
def test_the_batch_of_all_students_holds_the_printed_digits_at_number_7(name):
    batch = shipped(name, 1).batch(n=np.arange(1, 31))
    kinds = {"velocity": "points", "acceleration": "points", "omega": "links", "epsilon": "links"}
    for (quantity, of), printed in PRINTED[name].items():
        value = getattr(getattr(batch, kinds[quantity])[of], quantity)[6]
        assert as_printed(value.real, printed) == printed


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("n", STUDENTS)
def test_the_loops_agree_for_every_student(name, n):
    mechanism = shipped(name, n)
    verdict = mechanism.witness(mechanism.solve())
    assert verdict.agrees
    assert verdict.largest_difference <= 1e-11
    assert verdict.residual <= 1e-14
    assert verdict.branches == ()


def test_the_loops_do_not_agree_with_another_students_answer():
    """The verdict has teeth: the neighbour's numbers do not pass."""
    verdict = shipped("pump", 7).witness(shipped("pump", 8).solve())
    assert not verdict.agrees


def test_the_statement_of_the_lab_is_what_the_drawing_shows():
    """The lengths of the text, measured on the constructed positions; B, C and D on their sides."""
    for n in range(1, 31):
        p = {name: point.position for name, point in shipped("pump", n).solve().points.items()}
        for bar, centimetres in (("O1A", 30), ("O1O2", 30), ("O2B", 30), ("AB", 40), ("AC", 20)):
            start, end = ("O1", bar[2:]) if bar[:2] == "O1" else (bar[:-1], bar[-1])
            assert 100 * abs(p[end] - p[start]) == pytest.approx(centimetres, rel=1e-14)
        assert 100 * abs(p["D"] - p["C"]) == pytest.approx(20, rel=1e-14)
        assert 100 * abs(p["C"] - p["B"]) == pytest.approx(25, rel=1e-14)
        assert ((p["B"] - p["A"]) / (p["O2"] - p["A"])).imag < 0
        assert ((p["C"] - p["A"]) / (p["B"] - p["A"])).imag > 0
        assert p["D"].imag == 0
        assert p["D"].real > p["C"].real


def test_in_the_collinear_pump_c_divides_its_images_as_c_divides_the_bar():
    """C at the middle of AB: c at the middle of ab, c′ at the middle of a′b′."""
    for n in range(1, 31):
        points = shipped("pump-collinear", n).solve().points
        for quantity in ("position", "velocity", "acceleration"):
            a, b, c = (getattr(points[name], quantity) for name in "ABC")
            assert abs(c - (a + b) / 2) <= 1e-15 * max(abs(a), abs(b))
