"""Profiles on the mechanism: arcs about their centres that touch where the scene says they do."""

from __future__ import annotations

from math import degrees, hypot, isclose

import pytest

from graphkin.construction.core.layout import lay_out
from graphkin.construction.links.wheel_symbols import HALF, WIDEST
from graphkin.documents.sheet import left_board
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.marks import Arc, CircleMark
from graphkin.mechanism import Mechanism, load
from graphkin.text import words
from graphkin.text.errors import PageError
from tests.documents.sheet_tools import FOLDER
from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text

TOUCHING = str(FOLDER / "gears-profiles.toml")
ANGLES = (10, 15, 20, 25, 30)
HOLLOW = scene_text("construction/profile-in-a-hollow")


def meeting(angle: float, **arc: float) -> Mechanism:
    """A crank whose tip meets a profile of the frame."""
    text = scene_text("construction/profile-of-the-frame", angle=angle)
    return mechanism_of(text.replace('"A" }', f'"A", arc = {arc["arc"]} }}') if arc else text)


def drawn(mechanism: Mechanism, view: str = "key"):
    """For each sheet of a mechanism where its points stand on the page, and its profiles."""
    for drawing in drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en")):
        layout = lay_out(drawing)
        marks = left_board(drawing, layout, view).marks
        places = {name: layout.mechanism(at) for name, at in drawing.positions.items()}
        yield places, {mark.name: mark for mark in marks if mark.cls == "profile"}


def apart(one: tuple[float, float], other: tuple[float, float]) -> float:
    """The distance of two places of the page, in mm."""
    return hypot(one[0] - other[0], one[1] - other[1])


def check_touching(mechanism: Mechanism, *, inside: bool) -> None:
    """Both profiles are about their centres through M, and have one tangent there."""
    sheets = list(drawn(mechanism))
    assert len(sheets) == 2
    for places, profiles in sheets:
        assert set(profiles) == {"1", "2"}
        for link, arc in profiles.items():
            assert isinstance(arc, Arc)
            assert apart((arc.cx, arc.cy), places[f"K{link}"]) < 1e-9
            assert apart(arc.at((arc.start + arc.end) / 2), places["M"]) < 1e-9
            half = min(degrees(HALF / arc.r), WIDEST)
            assert isclose(arc.end - arc.start, 2 * half)
        (x, y), *ways = places["M"], *((arc.cx, arc.cy) for arc in profiles.values())
        (u, v), (s, t) = ((cx - x, cy - y) for cx, cy in ways)
        sine = (u * t - v * s) / hypot(u, v) / hypot(s, t)
        assert abs(sine) < 1e-9
        assert (u * s + v * t > 0) is inside


@pytest.mark.parametrize("angle", ANGLES)
def test_both_profiles_touch_at_the_contact_all_over_the_range(angle):
    check_touching(load(TOUCHING, angle=angle), inside=False)


@pytest.mark.parametrize("angle", [-40, 5, 60])
def test_a_profile_in_the_hollow_of_another_touches_it_from_inside(angle):
    text = HOLLOW.replace("angle = 25", f"angle = {angle}")
    check_touching(mechanism_of(text), inside=True)


def test_a_profile_of_the_frame_is_drawn_and_one_without_a_radius_refused():
    ((places, profiles),) = drawn(meeting(90))
    arc = profiles["0"]
    assert apart((arc.cx, arc.cy), places["P"]) < 1e-9
    assert isclose(arc.r, apart(places["A"], places["P"]))
    with pytest.raises(PageError, match="P and A coincide; expected an arc") as told:
        list(drawn(meeting(0)))
    assert told.value.problems[0].place == "frame.profiles"


def test_an_arc_of_360_degrees_is_the_whole_circle():
    """The disc of an eccentric."""
    for places, profiles in drawn(meeting(90, arc=360)):
        disc = profiles["0"]
        assert isinstance(disc, CircleMark)
        assert apart((disc.cx, disc.cy), places["P"]) < 1e-9
        assert isclose(disc.r, apart(places["A"], places["P"]))


def test_a_disc_lies_in_a_hollow_whose_link_is_not_drawn_to_the_centre():
    """A Geneva drive that dwells: two arcs of one circle, and a plate that ends at its hollow."""
    mechanism = load(FOLDER / "geneva-dwell.toml")
    drawing, *_ = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words("en"))
    layout = lay_out(drawing)
    marks = left_board(drawing, layout, "key").marks
    disc, hollow = sorted((m for m in marks if m.cls == "profile"), key=lambda mark: mark.name)
    centre = layout.mechanism(drawing.positions["O1"])
    assert apart((disc.cx, disc.cy), centre) < 1e-9
    assert apart((hollow.cx, hollow.cy), centre) < 1e-9
    assert isclose(disc.r, hollow.r)
    assert (isclose(disc.end - disc.start, 270), isclose(hollow.end - hollow.start, 80)) == (1, 1)
    plate = next(mark for mark in marks if mark.cls == "plate" and mark.name == "2")
    assert min(apart(corner, centre) for corner in plate.points) > hollow.r - 1e-9
    assert sum(m.cls == "hinge" and m.name == "O1" for m in marks) == 0
