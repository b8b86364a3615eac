"""Pages with wheels: ground, marks, names of contacts, and sentences that a pencil can follow."""

from __future__ import annotations

import re

import pytest

from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.link_poses import lettered
from graphkin.construction.core.program import ContactName
from graphkin.documents.relations import relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.documents.step_numbers import stages
from graphkin.drawing.marks import CircleMark
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
    contacts = {of for what, of in velocity.trace.program.targets if isinstance(of, ContactName)}
    linked = {lettered(of) for of in contacts if "@" in of}
    assert linked
    symbols = {step.of.symbol for _, step, _ in velocity.steps(velocity.plane) if step.arrow}
    assert not {s for s in symbols if any(each in s for each in linked)}


def test_a_wheel_that_rolls_on_a_rack_that_turns_is_told_by_both_their_turnings():
    mechanism = Mechanism(read_text(RACK_ON_ARM, "rack", None, {}))
    verdict = proved(mechanism, mechanism.solve())
    lines = [plain(s.markup) for s in sentences(drawings_of(mechanism, verdict, words("en"))[1])]
    assert any("t′3t′2 = aTAν = (ω3 − ω1)2·AT ∥ AT, from A towards T, 21.60 mm" in s for s in lines)


def test_a_tangential_component_is_not_there_before_the_points_that_it_is_told_of():
    (_, drawing) = drawings("roller-plates")
    staged, program = stages(drawing, sentences(drawing)), drawing.trace.program
    found = {step.of.symbol: n for n, step, _ in drawing.steps(drawing.plane) if step.arrow}
    rims = [n for (what, of), n in program.targets.items() if what == drawing.kind and "@3" in of]
    assert len(rims) == 2
    assert staged[found["a_T2,3T1,3^τ"]] == max(staged[number] for number in rims)


@pytest.mark.parametrize("language", ["en", "ro", "it"])
def test_a_place_that_was_found_is_told_in_millimetres_of_paper(language):
    drawing = drawings("rod-and-wheel", language=language)[0]
    told = plain(sentences(drawing)[1].markup)
    figure = re.search(r"(\d+[.,]\d\d) mm", told)
    field = lay_out(drawing).mechanism
    from_zero = field(drawing.positions["C"])[0] - field(drawing.positions["R"])[0]
    assert figure is not None
    assert float(figure[1].replace(",", ".")) == pytest.approx(-from_zero, abs=0.005)
