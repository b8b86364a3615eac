"""Pages with wheels: ground, marks, names of contacts, and sentences that a pencil can follow."""

from __future__ import annotations

import pytest

from graphkin.paper.marks import Circle, Line
from graphkin.paper.relations import relations
from graphkin.paper.richtext import plain
from graphkin.paper.sentences import sentences
from graphkin.paper.standing import lettered
from graphkin.steps.program import CONTACT
from tests.paper.sheet_tools import SCENES, drawings, drawn

WHEELS = ("gears-pair", "gears-planet", "gears-rack", "gears-ring", "rod-and-wheel", "roller")


def said(name, kind="velocity"):
    """The sentences of a sheet without their markup."""
    drawing = next(each for each in drawings(name) if each.kind == kind)
    return [plain(sentence.markup) for sentence in sentences(drawing)]


def test_a_fixed_ring_stands_on_hatched_ground_in_the_task_too():
    page = drawn("gears-ring", None, "velocity", "task")
    (ring,) = (m for m in page.marks["mechanism"] if isinstance(m, Circle) and m.cls == "wheel")
    strokes = [m for m in page.marks["mechanism"] if isinstance(m, Line) and m.cls == "ground"]
    centre = complex(ring.cx, ring.cy)
    around = [m for m in strokes if abs(abs(complex(m.x1, m.y1) - centre) - ring.r) < 1e-6]
    assert len(around) > 50
    assert all(abs(complex(m.x2, m.y2) - centre) > ring.r + 1 for m in around)


@pytest.mark.parametrize("view", ["key", "task"])
@pytest.mark.parametrize("name", SCENES)
def test_every_point_that_bears_a_letter_has_a_circle(name, view):
    for kind in {drawing.kind for drawing in drawings(name)}:
        page = drawn(name, None, kind, view)
        scene, marks = page.drawing.scene, page.marks["mechanism"]
        circles = {m.name for m in marks if isinstance(m, Circle) and m.cls == "pin"}
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
    symbols = {step.says["symbol"] for _, step, _ in velocity.steps(velocity.plane) if step.arrow}
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
        line == "I1, the instantaneous centre of link 1, is C, whose velocity is nought"
        for line in said("roller")
    )


def test_a_rate_is_told_where_it_is_taken_first():
    lines = [line for line in said("roller-plates") if "in the sense of ω3" in line]
    assert [line.endswith("ω3 = vT2T1/T1T2") for line in lines] == [True, False, False]


def test_how_far_a_wheel_or_a_rack_has_come_is_told_by_its_number():
    assert "for link 2 has turned by −18.0° since the start: B" in said("gears-pair")[2]
    assert (
        "by the arc that the wheel has turned through since, 41.888 mm: B" in said("gears-rack")[1]
    )


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
