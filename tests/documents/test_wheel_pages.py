"""Pages with wheels: ground, marks, names of contacts, and sentences that a pencil can follow."""

from __future__ import annotations

import re

import pytest
from shapely import LineString, Point

from graphkin.construction.centres.instant_centre import set_before
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.link_poses import lettered
from graphkin.construction.core.program import CONTACT
from graphkin.documents.relations import relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import left_board
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.documents.step_numbers import stages
from graphkin.drawing.marks import CircleMark, LineMark
from graphkin.drawing.richtext import plain
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.chosen import CHOSEN
from tests.documents.sheet_tools import drawings, drawn
from tests.scene_files import scene_text

WHEELS = ("gears-pair", "gears-planet", "gears-rack", "gears-ring", "rod-and-wheel", "roller")


RACK_ON_ARM = scene_text("documents/rack-on-arm")


def said(name, kind="velocity"):
    """The sentences of a sheet without their markup."""
    drawing = next(each for each in drawings(name) if each.kind == kind)
    return [plain(sentence.markup) for sentence in sentences(drawing)]


def test_a_fixed_ring_stands_on_hatched_ground_in_the_task_too():
    page = drawn("gears-ring", None, "velocity", "task")
    (ring,) = (m for m in page.marks["mechanism"] if isinstance(m, CircleMark) and m.cls == "wheel")
    strokes = [m for m in page.marks["mechanism"] if isinstance(m, LineMark) and m.cls == "ground"]
    centre = complex(ring.cx, ring.cy)
    around = [m for m in strokes if abs(abs(complex(m.x1, m.y1) - centre) - ring.r) < 1e-6]
    assert len(around) > 50
    assert all(abs(complex(m.x2, m.y2) - centre) > ring.r + 1 for m in around)


@pytest.mark.parametrize("view", ["key", "task"])
@pytest.mark.parametrize("name", CHOSEN)
def test_every_point_that_bears_a_letter_has_a_circle(name, view):
    for kind in {drawing.kind for drawing in drawings(name)}:
        page = drawn(name, None, kind, view)
        scene, marks = page.drawing.scene, page.marks["mechanism"]
        circles = {m.name for m in marks if isinstance(m, CircleMark) and m.cls == "pin"}
        owned = {p for link in (scene.frame, *scene.links.values()) for p in link.points}
        shown = scene.frame.points if view == "task" else owned & page.drawing.positions.keys()
        assert set(shown) <= circles


@pytest.mark.parametrize("name", WHEELS)
def test_a_point_of_contact_has_one_velocity_under_one_name(name):
    found = [r for _, section in relations(drawings(name)) for r in section if r.result]
    assert not [r.left for r in found if r.remark == "no slip"]
    (velocity, *_) = drawings(name)
    contacts = {of for what, of in velocity.trace.program.targets if of[:1] == CONTACT}
    linked = {lettered(of) for of in contacts if "@" in of}
    assert linked
    symbols = {step.of.symbol for _, step, _ in velocity.steps(velocity.plane) if step.arrow}
    assert not {s for s in symbols if any(each in s for each in linked)}


def test_a_roller_stands_halfway_and_each_track_is_told():
    lines = said("roller-plates")
    assert lines[2].startswith("draw the track of wheel 3 on link 1: the line of link 1 through")
    assert "halfway between the points at which both tracks were touched" in lines[2]
    assert lines[4].startswith("draw the track of wheel 3 on link 2: the line of link 2 through")
    assert not any("from its zero" in line for line in lines[2:])


def test_a_centre_on_the_line_of_parallel_velocities_is_found_by_their_tips():
    text = next(line for line in said("roller-plates") if "I3" in line)
    assert text.startswith("the velocities of O and A are parallel")
    assert any(
        line == "I1, the instantaneous centre of link 1, is C, whose velocity is zero"
        for line in said("roller")
    )


def test_the_line_through_the_tips_is_drawn_through_the_centre_with_both_velocities_first():
    (drawing, _) = drawings("roller-plates")
    layout, own = lay_out(drawing), sentences(drawing)
    place, staged = layout.mechanism, stages(drawing, own)
    early = set_before(drawing)
    (number,) = set(early.values())
    lines = [
        LineString([(m.x1, m.y1), (m.x2, m.y2)])
        for m in left_board(drawing, layout, "key").marks
        if isinstance(m, LineMark) and m.step == number and m.cls == "ray"
    ]
    values = drawing.trace.values
    ends = [place(values[arrow].tip) for arrow in early]
    ends.append(place(drawing.place(values[number])))
    assert len(lines) == 1 and len(ends) == 3
    assert all(lines[0].distance(Point(end)) < 1e-6 for end in ends)
    assert {staged[arrow] for arrow in early} == {staged[number]}
    assert "set vB, vM on" in said("roller-plates")[-1]


@pytest.mark.parametrize("name", ["roller", "centrodes-roller"])
def test_the_arrow_of_a_wheels_speed_stands_at_its_centre(name):
    (drawing, *_) = drawings(name)
    layout = lay_out(drawing)
    marks = left_board(drawing, layout, "key").marks
    (arrow,) = [m for m in marks if isinstance(m, LineMark) and m.name == "speed 1"]
    middle = complex(arrow.x1 + arrow.x2, arrow.y1 + arrow.y2) / 2
    assert abs(middle - complex(*layout.mechanism(drawing.positions["O"]))) < 8


def test_the_points_of_a_wheel_that_stands_as_at_the_start_are_said_in_one_sentence():
    assert "link 1 stands as at the start: from O lay off C, Q, T, P as given" in said("roller")
    assert "link 3 stands as at the start: from O lay off A, B, M as given" in said("roller-plates")
    assert not any("since the start" in line for line in said("roller") + said("roller-plates"))


def test_where_two_gears_touch_is_told_by_a_radius():
    assert said("gears-planet")[2].endswith("line of centres, r1 = m·z/2 (30.00 mm) from O")
    assert said("gears-ring")[3].endswith("line of centres, r2 = m·z/2 (20.00 mm) from P")


def test_an_acceleration_by_rolling_is_laid_off_in_the_sentence_that_gives_its_length():
    lines = [line for line in said("roller-plates", "acceleration") if "T2O" in line]
    assert (
        lines[0] == "from u′ lay off u′t′2,3 = aT2Oν = ω32·T2O ∥ T2O, from T2 towards O, 50.00 mm"
    )
    every = said("roller-plates", "acceleration")
    assert sum("for rolling gives the point of contact no other" in line for line in every) == 1


def test_a_wheel_that_rolls_on_a_rack_that_turns_is_told_by_both_their_turnings():
    mechanism = Mechanism(read_text(RACK_ON_ARM, "rack", None, {}))
    verdict = proved(mechanism, mechanism.solve())
    lines = [plain(s.markup) for s in sentences(drawings_of(mechanism, verdict, words("en"))[1])]
    assert any("t′3t′2 = aTAν = (ω3 − ω1)2·AT ∥ AT, from A towards T, 21.60 mm" in s for s in lines)


@pytest.mark.parametrize(
    ("name", "kind", "line"),
    [
        ("roller-plates", "acceleration", "l′ falls on o′, for v1 is constant"),
        ("mobility-five-bar", "velocity", "d falls on o, because ω4 is zero"),
        ("mobility-five-bar", "acceleration", "d′ falls on o′, because ω4 is zero"),
    ],
)
def test_why_a_point_falls_on_the_pole_is_told(name, kind, line):
    assert line in said(name, kind)


def test_a_tangential_component_is_not_there_before_the_points_that_it_is_told_of():
    (_, drawing) = drawings("roller-plates")
    staged, program = stages(drawing, sentences(drawing)), drawing.trace.program
    found = {step.of.symbol: n for n, step, _ in drawing.steps(drawing.plane) if step.arrow}
    rims = [n for (what, of), n in program.targets.items() if what == drawing.kind and "@3" in of]
    assert len(rims) == 2
    assert staged[found["a_T2,3T1,3^τ"]] == max(staged[number] for number in rims)


def test_a_rate_is_told_where_it_is_taken_first():
    lines = [line for line in said("roller-plates") if "in the sense of ω3" in line]
    assert [line.endswith("ω3 = vT2T1/T1T2") for line in lines] == [True, False, False]


def test_how_far_a_wheel_or_a_rack_has_come_is_told_by_its_number():
    assert "for link 2 has turned by −18.0° since the start: B" in said("gears-pair")[2]
    assert (
        "by the arc that the wheel has turned through since, 41.89 mm: B" in said("gears-rack")[1]
    )


@pytest.mark.parametrize("language", ["en", "ro", "it"])
def test_a_place_that_was_found_is_told_in_millimetres_of_paper(language):
    drawing = drawings("rod-and-wheel", language=language)[0]
    told = plain(sentences(drawing)[1].markup)
    figure = re.search(r"(\d+[.,]\d\d) mm", told)
    field = lay_out(drawing).mechanism
    from_zero = field(drawing.positions["C"])[0] - field(drawing.positions["R"])[0]
    assert figure is not None
    assert float(figure[1].replace(",", ".")) == pytest.approx(-from_zero, abs=0.005)


@pytest.mark.parametrize(
    ("name", "kind", "note"),
    [
        ("roller-plates", "velocity", "(ov is the image of O, for o is the pole)"),
        ("roller-plates", "acceleration", "T1,3 is the point of link 3 at T1)"),
        ("gears-pair", "acceleration", "T1 is the point of link 1 at T)"),
        ("crank-slot", "velocity", "C2 is the point of link 2 at C)"),
    ],
)
def test_an_index_is_explained_once(name, kind, note):
    assert sum(note in line for line in said(name, kind)) == 1


def test_no_index_is_explained_where_there_is_none():
    assert not any("index" in line or "image of" in line for line in said("crank-rocker"))


def test_the_radius_of_a_gear_is_reckoned_before_it_is_used():
    found = [r for _, section in relations(drawings("gears-ring")) for r in section]
    lefts = [plain(r.left) for r in found]
    assert [(r.figures, r.result, r.unit) for r in found if plain(r.left) == "r2"] == [
        ("4·20/2", "40.00", "mm")
    ]
    used = next(i for i, r in enumerate(found) if "r0/r2" in plain(r.symbols))
    assert max(lefts.index("r0"), lefts.index("r2")) < used
