"""The sheet of a cam's law: closed forms, derivatives of one another, what is marked and said."""

from __future__ import annotations

from functools import cache
from math import degrees, pi, radians

import numpy as np
import pytest

from graphkin.documents.cam_law_sheet import CamLaw, axes_of, limit_of, strips
from graphkin.documents.diagrams_sheet import Axes, numbers_along
from graphkin.documents.positions import positions_of
from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.marks import LineMark, Page, Text
from graphkin.mechanism import load
from graphkin.motion.extremes import all_extremes
from graphkin.text import LANGUAGES, words
from tests.chosen import FOLDER

CAMS = ("cam-roller", "cam-plate", "cam-table", "cam-lever", "cam-fixed", "cam-plate-lever")


@cache
def law_of(name: str) -> CamLaw:
    found = positions_of(load(FOLDER / f"{name}.toml"), words("en"))
    return CamLaw(found, next(iter(found.cycle.scene.cams)))


@cache
def page_of(name: str, language: str = "en") -> Page:
    made = {p.kind: p.pages for p in hand_out(load(FOLDER / f"{name}.toml"), "diagrams", language)}
    (page,) = made["cams"]
    return page


def said(name: str, language: str = "en") -> str:
    return " ".join(m.markup for m in page_of(name, language).marks if isinstance(m, Text))


def test_a_cycloidal_rise_has_the_textbook_s_v_a_j():
    """Norton, Cam Design, section 3: s′ = 2h/β, s″ = 2πh/β², s‴ = 4π²h/β³ at the most."""
    law, lift, beta = law_of("cam-roller"), 0.02, radians(120)
    own = [values[0] for values in law.orders]
    assert own[0][-1] == pytest.approx(lift)
    assert own[1].max() == pytest.approx(2 * lift / beta, rel=1e-9)
    assert own[2].max() == pytest.approx(2 * pi * lift / beta**2, rel=1e-9)
    assert own[3].max() == pytest.approx(4 * pi**2 * lift / beta**3, rel=1e-9)
    assert own[3].min() == pytest.approx(-4 * pi**2 * lift / beta**3, rel=1e-9)


@pytest.mark.parametrize("name", CAMS)
def test_each_diagram_is_the_derivative_of_the_one_above(name):
    law = law_of(name)
    for before, after in zip(law.orders, law.orders[1:], strict=False):
        slopes = np.gradient(before, axis=1, edge_order=2) / np.gradient(law.at, axis=1)
        size = np.abs(after).max()
        assert np.abs(slopes - after)[:, 1:-1].max() < 2e-3 * size


def test_the_steepest_places_are_the_middles_of_rise_and_return():
    law = law_of("cam-roller")
    rise, back = law.steepest(1), law.steepest(-1)
    assert degrees(rise[0]) == pytest.approx(60, abs=1e-4)
    assert rise[1] == pytest.approx(0.04 / radians(120))
    assert degrees(back[0]) == pytest.approx(240, abs=1e-4)
    assert back[1] == pytest.approx(-1.875 * 0.02 / radians(120))
    names = {mark.name for mark in page_of("cam-roller").marks if isinstance(mark, LineMark)}
    assert {"steepest rise", "steepest return"} <= names
    assert "19.10 mm/rad" in said("cam-roller")


def test_a_law_that_jumps_says_where():
    assert law_of("cam-roller").jumps(2) == []
    assert [round(degrees(u)) for u in law_of("cam-roller").jumps(3)] == [0, 120, 180, 300]
    assert law_of("cam-plate").jumps(2) == pytest.approx([0.08])


def test_the_pressure_angle_is_held_against_its_limit():
    assert limit_of(law_of("cam-roller")) == 30
    assert limit_of(law_of("cam-lever")) == 35
    beyond = law_of("cam-plate")
    assert beyond.pressure.max() > limit_of(beyond)
    assert any(m.name == "limit" for m in page_of("cam-plate").marks if isinstance(m, LineMark))
    assert "beyond the customary limit" in said("cam-plate")
    assert "within the customary limit" in said("cam-roller")


@pytest.mark.parametrize("name", ["cam-roller", "cam-plate", "cam-lever"])
def test_the_largest_pressure_angle_is_as_sure_as_that_of_the_cycle(name):
    """Not that of the nearest sample; the extremes of the cycle find it by another search."""
    law = law_of(name)
    at, most = law.largest(law.pressure_at)
    ((*found,),) = all_extremes(law.found.cycle)
    (own,) = [each for each in found if each.measure.name == "pressure angle"]
    assert most == pytest.approx(own.largest.value, rel=1e-9)
    assert most >= law.pressure.max()
    assert f"{most:.3f}°" in said(name)
    beside = law.pressure_at(np.array([at - 1e-3, at + 1e-3]))
    assert (beside < most).all()


def test_every_axis_has_two_numbers_beside_zero():
    """Also where values reach a little farther than one round number to both sides."""
    axes = Axes((0.0, 0.0, 100.0, 20.0), 10.0, 1.0, 2.2, 0.0)
    marks = [*numbers_along(words("en"), axes, "s", 1.0, 4)]
    told = [float(m.markup.replace("−", "-")) for m in marks if isinstance(m, Text)]
    assert len(told) >= 2
    assert max(map(abs, told)) <= 10 / 2.2
    for name in CAMS:
        law = law_of(name)
        for index, strip in enumerate(strips(law)):
            frame = axes_of(law, strip, 10.0, 35.0)
            made = [*numbers_along(words("en"), frame, f"{index}", strip.factor, 4)]
            assert sum(isinstance(m, Text) for m in made) >= 2, (name, strip.symbol)


def test_a_flat_face_that_slides_has_no_pressure_angle():
    assert len(strips(law_of("cam-flat"))) == 4
    assert len(strips(law_of("cam-lever"))) == 5


def test_the_diagrams_fit_their_field_in_every_language():
    for language in LANGUAGES:
        for mark in page_of("cam-roller", language).marks:
            if isinstance(mark, LineMark):
                assert 0 < min(mark.x1, mark.x2) <= max(mark.x1, mark.x2) < 420
                assert 0 < min(mark.y1, mark.y2) <= max(mark.y1, mark.y2) < 297
