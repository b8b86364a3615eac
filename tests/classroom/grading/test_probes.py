"""What is read off many drawings at once."""

import warnings

import numpy as np

from graphkin.accuracy.pencil import Paper
from graphkin.classroom.grading.probes import Probe
from graphkin.classroom.lab.lab_model import Item
from graphkin.construction.core.program import Plane
from graphkin.numbers.plane import Ratio


def test_a_centre_that_is_at_infinity_in_one_of_many_drawings_is_no_number_there_and_quiet():
    item = Item("I_4", "place", "", "mm", "", "", axis="x")
    centre = Ratio(1 + 0j, np.array([3 + 0j, 3 + 0j]), np.array([0j, 2 + 0j]))
    probe = Probe(item, (0, 1), Plane.MECHANISM)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        far, near = probe.read({0: 0.5 + 0j, 1: centre}, Paper(1.0, 1.0, 1.0))
    assert not np.isfinite(far)
    assert near == 2000.0
