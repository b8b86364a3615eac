"""A lab is tried on a thousand variants, and a new one stands at once."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest

from graphkin.classroom.grading.neighbours import standards_of, worst_drawn
from graphkin.classroom.lab.lab_model import settings
from graphkin.classroom.lab.lab_trial import scale_table, trial_lines, tried
from graphkin.classroom.lab.new_lab import new_lab
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants.assign import assigned
from graphkin.classroom.variants.class_files import class_lines
from graphkin.text import words
from graphkin.text.errors import PageError, SceneError
from tests.classroom.lab.singles import ROOT, mechanism_of, sheets_of

RANGES = (
    'graphkin = 1\n[variants]\ncourse = "c"\ndraw = {{ n = {{ min = {}, max = {}, step = 1 }} }}\n'
)


@pytest.fixture
def mine(tmp_path):
    def written(text, scene="pump"):
        folder = tmp_path / "mine"
        folder.mkdir(exist_ok=True)
        shutil.copy(ROOT / "sheets" / scene / "scene.toml", folder)
        (folder / "lab.toml").write_text(text, encoding="utf-8")
        return read_lab(folder)

    return written


@pytest.fixture(scope="module")
def shipped():
    """The shipped labs that go by the number, each tried."""
    return {n: tried(read_lab(n)) for n in ("pump", "pump-collinear", "offset-slider-crank")}


@pytest.mark.parametrize("name", ("offset-slider-crank", "pump-collinear"))
def test_shipped_labs_keep_a_class_of_thirty_apart(shipped, name):
    """A neighbour's right values earn about half at most, and everybody's data are fair."""
    trial = shipped[name]
    assert trial.lab.fair.apart <= 0.52
    assert len(trial.compared) == 30
    assert trial.by_keys == []
    assert np.nanmax(trial.neighbours.exact) <= trial.lab.fair.apart
    students = [Student(i, str(i), i) for i in range(1, 31)]
    assert all(each.fair for each in assigned(trial.lab, students))


def test_a_new_lab_keeps_a_class_of_thirty_apart(tmp_path):
    new_lab("mine", tmp_path)
    trial = tried(read_lab(tmp_path / "mine"))
    assert trial.lab.fair.apart == 0.5
    assert len(trial.compared) == 30
    assert trial.by_keys == []
    assert np.nanmax(trial.neighbours.exact) <= 0.5


def test_scales_are_told_with_how_many_students_have_them(shipped):
    """The pump states one scale for everybody; the slider-crank's sheets choose their own."""
    lab = read_lab("offset-slider-crank")
    given = [settings(lab, Student(i, str(i), i)) for i in range(1, 31)]
    alone = [mechanism_of("offset-slider-crank", each) for each in given[:4]]
    own = [sheets_of(each)[0].scales for each in alone]
    trial = shipped[lab.name]
    for i, scales in enumerate(own):
        found = trial.fairness
        assert found.kL[i] == pytest.approx(scales.kL)
        assert found.larger[i] == pytest.approx(scales.larger)
        assert found.larger_still[i] == pytest.approx(scales.larger_still)
    rows = scale_table(trial, words("en")).rows
    *told, more = [int(row.cells[3]) for row in rows]
    assert len(told) == 8 and more > 0
    assert sum(told) + more == 30
    assert told == sorted(told, reverse=True)
    (one,) = scale_table(shipped["pump"], words("en")).rows
    assert one.cells[:4] == ("1:5", "2.5", "2", "30")


def test_a_formula_is_tried_on_every_number_that_the_scene_allows(shipped):
    for trial in shipped.values():
        assert trial.names == tuple(map(str, range(1, 31)))
        assert trial.different == 30
        assert not trial.unasked and not trial.unmarked


def test_ranges_are_tried_on_a_thousand_draws(mine):
    trial = tried(mine(RANGES.format(1, 30)))
    assert len(trial.many) == 1000
    assert trial.different == 30
    assert 0 < trial.unfair < 1000
    assert not trial.spoilt  # what is unfair is drawn again


def test_fields_that_no_sheet_draws_are_told(mine):
    """A scene that asks no acceleration has no acceleration plan to be measured."""
    text = 'graphkin = 1\n[variants]\nset = { n = "number" }\n[marks]\na_D_mm = 1\n'
    lab = mine(text)
    scene = lab.scene.read_text(encoding="utf-8")
    wishes = scene.index("[ask]"), scene.index("[sheet]")
    lab.scene.write_text(
        scene[: wishes[0]] + '[ask]\nvelocity = ["D"]\n\n' + scene[wishes[1] :], encoding="utf-8"
    )
    trial = tried(read_lab(lab.folder))
    assert trial.unasked == ("a_D_mm",)
    assert trial.unmarked == ("v_D_mm", "v_D")
    assert trial.spoilt
    assert any("drawn on no sheet: a_D_mm" in line for line in trial_lines(trial))


# --------------------------------------------------------------------------------------- new


def test_a_new_lab_passes_with_ranges_too(tmp_path):
    new_lab("crank-lab", tmp_path)
    path = tmp_path / "crank-lab" / "lab.toml"
    text = path.read_text(encoding="utf-8")
    commented = [line for line in text.splitlines() if line.startswith("#     ")]
    block = "\n".join(line.removeprefix("#     ") for line in commented)
    text = re.sub(r"(?m)^\[variants\]\nset = .*\n", block + "\n", text)
    path.write_text(text, encoding="utf-8")
    assert len(tried(read_lab(path)).many) == 1000


def test_a_new_lab_is_in_nobodys_way(tmp_path):
    for name in ("../x", "/etc/x", "", ".", "a/b", "CON", "ș", "a b", "x" * 61):
        with pytest.raises(SceneError, match="is no name for a lab"):
            new_lab(name, tmp_path)
    assert not list(tmp_path.iterdir())
    new_lab("crank-lab", tmp_path)
    with pytest.raises(PageError, match="exists already"):
        new_lab("crank-lab", tmp_path)
    new_lab("crank-lab", tmp_path, force=True)


BY_NUMBER = (
    'graphkin = 1\n[variants]\nset = { n = "number" }\n[marks]\nv_D_mm = 1\na_D_mm = 1\n[fair]\n'
)


def test_what_hardly_any_drawing_settles_is_named_as_in_the_report_on_the_class():
    lab = read_lab("slotted-lever")
    trial = tried(lab, 12)
    report = class_lines(lab, trial.compared)
    from_class, from_trial = (
        "\n".join(lines).partition("\nunsure ")[2].partition("pencil in [fair] limits that")
        for lines in (report, trial_lines(trial))
    )
    assert from_trial[:2] == from_class[:2]
    assert "epsilon_4" in from_trial[0] and from_trial[1]


def test_to_whom_a_formula_gives_data_too_near_to_another_s_is_told(mine):
    """A limit that only keys tell: named by number, and such a lab is not fair."""
    trial = tried(mine(f"{BY_NUMBER}apart = 0.4\n", "pump-collinear"))
    assert {fault.limit for _, fault in trial.by_keys} == {"apart"}
    assert trial.spoilt and not trial.pencilled
    lines = "\n".join(trial_lines(trial))
    assert re.search(r"too near to \d+: \d+ % > 40 %", lines)


def test_to_whom_a_formula_gives_what_a_pencil_draws_too_coarsely_is_told(mine):
    lab = mine(f"{BY_NUMBER}pencil = 0.05\n", "pump-collinear")
    trial = tried(lab)
    fair = trial.fairness.fair.nonzero()[0]
    asked = [(trial.many[i], trial.fairness.computed(i)) for i in fair]
    standards = standards_of(lab, asked)
    errors = {trial.names[i]: worst_drawn(s)[1] for i, s in zip(fair, standards, strict=True)}
    coarse = {name: error for name, error in errors.items() if error > 0.05}
    assert {name: fault.value for name, fault in trial.coarse.items()} == coarse
    assert 0 < len(coarse) < trial.pencilled == len(fair)
    assert trial.spoilt
    told = f"a pencil draws {len(fair) - len(coarse)} of the first {len(fair)} of these"
    assert told in "\n".join(trial_lines(trial))
