"""Ranges in which a lab is fair: known regions are found again, and proposals hold."""

from __future__ import annotations

import re
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner
from msgspec.structs import replace

from graphkin.classroom.lab import fair_ranges as module
from graphkin.classroom.lab.fair_ranges import (
    fair_ranges,
    halton,
    part_of,
    round_step,
    runs_of,
)
from graphkin.classroom.lab.lab_model import LabRule, Range, ValueList
from graphkin.classroom.lab.lab_trial import trial_lines, tried
from graphkin.classroom.lab.new_lab import (
    as_toml,
    candidates,
    formula_faults,
    is_fair,
    mended,
    proposed_ranges,
    variants_lines,
)
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.cli.class_commands import proposed
from graphkin.cli.main import app
from graphkin.text.errors import SceneError
from tests.scene_files import scene_text

SPACE = scene_text("classroom/crank-with-a-rod")
RULE = """graphkin = 1
[variants]
course = "mechanics"
draw = { phi = { min = 0, max = 355, step = 5 } }
[marks]
v_B_mm = 2
v_B = 1
"""


@pytest.fixture
def lab(tmp_path):
    (tmp_path / "scene.toml").write_text(SPACE, encoding="utf-8")
    return written(tmp_path, RULE)


def written(folder, text):
    """The lab of a folder with other rules."""
    (folder / "lab.toml").write_text(text, encoding="utf-8")
    return read_lab(folder)


REST = RULE[RULE.index("[marks]") :]


def with_ranges(folder, ranges, rest=REST):
    """The lab of a folder with other ranges."""
    lines = ["graphkin = 1", *variants_lines(ranges, "mechanics"), rest]
    return written(folder, "\n".join(lines))


def judging(monkeypatch, region):
    """Let what is fair be a region of the data instead."""

    def judged(lab, many):
        return SimpleNamespace(fair=np.array([region(each) for each in many]))

    monkeypatch.setattr(module, "judged", judged)


def test_intervals_of_the_parameter_that_decides_are_found_to_the_step(lab, monkeypatch):
    good = {*range(20, 75, 5), *range(200, 300, 5), 330}
    judging(monkeypatch, lambda each: each["phi"] in good)
    found = fair_ranges(lab)
    assert found.ranges is not None
    phi = found.ranges["phi"]
    assert {phi.value(k) for k in range(len(phi))} == good
    assert found.ranges["speed"] == Range(60, 300, 5)
    assert found.ranges["r"] == Range(40, 80, 1)
    assert found.tried.guilt("phi") > 0.6
    assert found.tried.guilt("speed") < 0.05
    judging(monkeypatch, lambda each: False)
    found = fair_ranges(lab)
    assert found.ranges is None
    assert proposed_ranges(lab, found) is None


def test_in_a_region_of_two_parameters_all_that_is_proposed_is_fair(lab, monkeypatch):
    """A disc: no box fills it, but the one that is found lies in it and is no sliver of it."""

    def in_disc(each):
        return (each["phi"] - 180) ** 2 / 150**2 + (each["r"] - 60) ** 2 / 18**2 <= 1

    judging(monkeypatch, in_disc)
    found = fair_ranges(lab)
    assert found.ranges is not None
    phi, r = found.ranges["phi"], found.ranges["r"]
    every = [{"phi": phi.value(i), "r": r.value(k)} for i in range(len(phi)) for k in range(len(r))]
    assert all(map(in_disc, every))
    discs = sum(in_disc({"phi": p, "r": q}) for p in range(0, 360, 5) for q in range(40, 81))
    assert len(every) > 0.4 * discs


def test_of_a_fair_box_peeling_leaves_all_but_a_thin_slice_at_each_end():
    """Patience: a slice has at most a twentieth of what is left, and at least one value; a few
    dozen of them come from 300 values to a tenth; what was lost is grown again."""
    whole, good = [(0, 299), (0, 59)], [(40, 99), (0, 44)]
    places = np.array([*np.ndindex(300, 60)])
    fair = module.within(good, places)
    found = module.peel(whole, places, fair)
    again = module.pasted([(60, 65), (20, 25)], whole, places, fair)
    for box in (found, again):
        for (low, high), (first, last) in zip(box, good, strict=True):
            assert first <= low <= first + (last - first) // 20
            assert last - (last - first) // 20 <= high <= last
    for size in (2, 5, 40, 300):
        ((low, _),), ((_, high),) = module.slices([(0, size - 1)])
        assert low == size - 1 - high
        assert size / 40 <= low <= max(size / 20, 1)
    assert not [*module.slices([(3, 3)])]


def test_ranges_keep_to_the_limit_of_a_pencil(lab, tmp_path, monkeypatch):
    """A slow piston is drawn less exactly: what is proposed has no draw in which it is too slow,
    and check, which counts the others, finds none in the proposal."""
    monkeypatch.setattr(module, "DRAWS", 200)
    monkeypatch.setattr(module, "PENCILLED", 40)
    pencil = "[fair]\npencil = 0.02\n"
    lab = written(tmp_path, RULE + pencil)
    before, found = tried(lab, 60), fair_ranges(lab)
    assert 0 < sum(found.exact) < len(found.exact) == 40
    assert found.exact_inside == 1.0
    assert found.ranges is not None
    after = tried(with_ranges(tmp_path, found.ranges, REST + pencil), 60)
    share = [len(each.coarse) / each.pencilled for each in (before, after)]
    assert share[0] > 0.2
    assert share[1] < 0.05
    assert before.spoiled_share > 1 - before.fairness.fair.mean() + 0.1
    # where no class would be left the rest is drawn again
    monkeypatch.setattr(module, "LEFT", 10**6)
    monkeypatch.setattr("graphkin.classroom.lab.new_lab.CLASS", 12)
    found = fair_ranges(lab)
    assert 0 < found.exact_inside < 1
    assert found.count > 10_000
    said = "\n".join(proposed(lab, found))
    assert f"a pencil draws {100 * found.exact_inside:.0f} % of these exactly enough" in said


def test_a_part_of_a_list_has_the_values_between():
    every = ValueList((Range(10, 10, 1), Range(20, 40, 10), Range(70, 80, 5)))
    for low in range(len(every)):
        for high in range(low, len(every)):
            part = part_of(every, low, high)
            told = [part.value(k) for k in range(len(part))]
            assert told == [every.value(k) for k in range(low, high + 1)]


def test_ranges_and_check_tell_the_same_of_a_class(tmp_path):
    """Thirty data are too few to keep a class apart: both say of how many they do."""
    pump = read_lab("pump")
    limited = replace(pump, fair=replace(pump.fair, apart=0.5))
    new = proposed_ranges(limited, fair_ranges(limited))
    assert new is not None and new.kept < new.of
    drawn = replace(limited, rule=LabRule(new.course, new.ranges))
    outcome = tried(drawn)
    unfair = {name for name, _ in outcome.by_keys}
    assert (len(outcome.compared) - len(unfair), len(outcome.compared)) == (new.kept, new.of)
    (again,) = (line for line in trial_lines(outcome) if line.startswith("again"))
    assert f"{new.kept} of a class of {new.of} have fair data" in again


def test_a_scene_without_ends_is_told(lab):
    lab.scene.write_text(re.sub(r", min.* }", " }", SPACE), encoding="utf-8")
    with pytest.raises(SceneError, match="no parameter has min and max"):
        fair_ranges(lab)


def test_the_proposal_is_a_fair_lab(lab, tmp_path, monkeypatch):
    """Pasted into lab.toml in place of what stood there, and tried as check does."""
    monkeypatch.setattr(module, "DRAWS", 200)
    found = fair_ranges(lab)
    trial = tried(with_ranges(tmp_path, found.ranges), 120)
    assert trial.unfair == 0
    assert found.tried.share < 1
    assert trial.different > 96


def test_what_is_proposed_is_read_as_it_was_meant(lab, tmp_path):
    """Ranges, lists of them with single values, and a parameter of which one value is left."""
    ranges = {
        "phi": ValueList((Range(10, 10, 5), Range(20, 40, 5))),
        "speed": Range(65, 65, 5),
        "r": Range(45, 55, 2),
    }
    read = with_ranges(tmp_path, ranges).rule.draws
    for name, values in ranges.items():
        told = [read[name].value(k) for k in range(len(read[name]))]
        assert told == [values.value(k) for k in range(len(values))]


def test_the_design_puts_one_draw_into_each_part():
    """Of base^k draws in a row one lies in each of as many parts (van der Corput's law); the bases
    are the primes, so that no two columns go together (Halton 1960)."""
    primes = [n for n in range(2, 38) if all(n % k for k in range(2, n))]
    for column, base in enumerate(primes):
        count = base**4 if base < 4 else base**2
        found = np.sort(halton(column + 1, count, count)[:, column] * count + 1e-6).astype(int)
        assert list(found) == list(range(count)), base


@pytest.mark.parametrize("count", [9, 10, 11, 12])
def test_all_values_of_a_parameter_are_tried_unless_they_are_many(lab, monkeypatch, count):
    """Of few each is tried with the box of the others; of more than an eighth of the draws those
    in the box."""
    monkeypatch.setattr(module, "DRAWS", 80)
    good = {1, 2, 5, count - 1}
    judging(monkeypatch, lambda each: each["a"] in good and each["b"] < 4)
    space = {"a": Range(0, count - 1, 1), "b": Range(0, 9, 1)}
    found = module.all_runs(lab, space, [(1, 2), (0, 3)], "a")
    assert {found.value(k) for k in range(len(found))} == (good if count <= 10 else {1, 2})
    assert module.all_runs(lab, space, [(1, 2), (4, 9)], "a") is None


def test_runs_are_ranges_and_single_values():
    values = Range(Fraction(10), Fraction(60), Fraction(10))
    runs = runs_of(values, [True, False, True, True, False, True])
    assert isinstance(runs, ValueList)
    assert [runs.value(k) for k in range(len(runs))] == [10, 30, 40, 60]
    assert as_toml(runs) == "[10, { min = 30, max = 40, step = 10 }, 60]"
    assert runs_of(values, [False] * 6) is None
    assert runs_of(values, [True] * 6) == values


def test_steps_that_no_scene_states_are_round():
    spans = {50: 1, 300: 5, 7: "1/10", 90: 1, 1000: 20}
    assert {span: round_step(Fraction(span)) for span in spans} == {
        span: Fraction(step) for span, step in spans.items()
    }


def test_one_number_that_is_changed_mends_the_pump(tmp_path):
    lab = read_lab("pump")
    trial = tried(lab)
    assert trial.unfair == 1
    assert formula_faults(lab).unfair.keys() == {"30"}
    found = mended(lab, trial)
    assert found is not None
    assert abs(found.percent) < 3
    text = lab.scene.read_text(encoding="utf-8")
    changed = next(new for one, new in candidates(text, 1) if one == found)
    assert changed.count(found.new) > text.count(found.new)
    path = tmp_path / "scene.toml"
    path.write_text(changed, encoding="utf-8")
    assert is_fair(replace(lab, scene=path), trial)
    assert not is_fair(lab, trial)


def test_a_length_that_all_students_share_as_a_parameter_is_mended_as_well(tmp_path):
    """But not the one that the formula gives; its new value stands on the parameter's steps."""
    pump = read_lab("pump")
    text = pump.scene.read_text(encoding="utf-8").replace("B-C = 25", 'B-C = "bc"')
    shared = "[parameters]\nbc = { value = 25, min = 22, max = 29, step = 0.5 }"
    path = tmp_path / "scene.toml"
    path.write_text(text.replace("[parameters]", shared), encoding="utf-8")
    lab = replace(pump, scene=path)
    found = mended(lab, tried(lab))
    assert found is not None
    assert (found.old, found.new, found.text) == ("25", "25.5", shared.partition("\n")[2])


def test_the_command_tells_proposes_and_draws(lab, tmp_path, monkeypatch):
    monkeypatch.setattr(module, "DRAWS", 60)
    monkeypatch.setattr("graphkin.classroom.lab.new_lab.CLASS", 12)
    out = tmp_path / "out"
    result = CliRunner().invoke(app, ["ranges", str(tmp_path), "-o", str(out)])
    assert result.exit_code == 0, result.output
    for said in ("decides    phi", "[variants.draw]", "different data; at apart = 0.5"):
        assert said in result.output
    names = {
        f"{tmp_path.name}-fair-by-{what}.{kind}"
        for what in ("parameter", "pairs")
        for kind in ("svg", "png")
    }
    assert {path.name for path in out.iterdir()} == names
