"""Fairness is judged in arrays by what each variant's own sheets draw."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from math import asin, degrees
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from graphkin import load
from graphkin.classroom.lab.fairness import judged
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.lab.variant_scales import by_arrays, scaling
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.solution import smallest_margin
from graphkin.construction.result_tables import vectors
from graphkin.documents.scaling import scales
from graphkin.text.errors import GraphkinError
from tests.classroom.lab.singles import LABS, ROOT, SCENES, lab_of, mechanism_of, sheets_of

NUMBERS = [{"n": Fraction(n)} for n in range(1, 31, 3)]
PLACES = {"velocity": "centre", "acceleration": "pole"}


@pytest.fixture(scope="module", params=LABS)
def judgement(request):
    lab = read_lab(request.param)
    mechanism = load(request.param)
    singles = [sheets_of(mechanism_of(request.param, given)) for given in NUMBERS]
    return lab, mechanism, judged(lab, NUMBERS), singles


def test_segments_are_as_long_as_the_tables_of_the_sheets_say(judgement):
    lab, _, found, singles = judgement
    seen = 0
    for i, sheets in enumerate(singles):
        tables = {name: mm for sheet in sheets for name, _, mm, _ in vectors(sheet)}
        for field, lengths in found.lengths.items():
            name = field.removesuffix("_mm").replace("_nu", "^ν")
            if name in tables:
                assert lengths[i] == pytest.approx(tables[name], abs=1e-9)
                small = tables[name] < lab.fair.segment  # and so are computed
                assert [f in found.computed(i) for f in (field, field.removesuffix("_mm"))] == [
                    small and field in lab.rubric.points,
                    small and field.removesuffix("_mm") in lab.rubric.points,
                ]
                seen += 1
    assert seen >= 2 * len(singles)


def test_a_rate_is_as_long_as_its_relative_vector_on_paper(judgement):
    """The segment by which omega is read, over the bar's length on paper, is omega/(kv/kL)."""
    _, _, found, singles = judgement
    for i, sheets in enumerate(singles):
        for sheet in sheets:
            quantity = "omega" if sheet.kind == "velocity" else "epsilon"
            scale = sheet.scales.kv if sheet.kind == "velocity" else sheet.scales.ka
            for link in sheet.scene.links:
                name, value = f"{quantity}_{link}", sheet.trace.value(quantity, link)
                if value is None or name not in found.lengths:
                    continue
                p, q, *_ = sheet.trace.program.steps[
                    sheet.trace.program.targets[(quantity, link)]
                ].args
                bar = abs(sheet.trace.values[q] - sheet.trace.values[p])
                assert found.lengths[name][i] == pytest.approx(1000 * abs(value) * bar / scale)


def test_the_flattest_crossing_is_that_of_the_construction(judgement):
    """The smallest sine of the scalar route; what the hand's way of a plate adds stands apart."""
    _, _, found, singles = judgement
    for i, sheets in enumerate(singles):
        sine = min(smallest_margin(sheet.trace) for sheet in sheets)
        assert found.flattest[i] == pytest.approx(degrees(asin(sine)), abs=1e-6)


def test_triangles_are_relative_velocity_over_bar_as_drawn(judgement):
    _, _, found, singles = judgement
    for i, sheets in enumerate(singles):
        sheet = sheets[-1]
        for step, value in [(s, v) for _, s, v in sheet.on_mechanism if "″" in s.name]:
            name = step.of.speed
            if name in found.triangles and step.role == "tip":
                pin, pivot = sheet.standing.spot(step.of.q), sheet.standing.spot(step.of.p)
                ratio = abs(value - pin) / abs(pin - pivot)
                assert found.triangles[name][i] == pytest.approx(ratio)
                break
        else:
            pytest.fail("no right triangle was found")


def test_each_limit_that_is_broken_is_told_with_what_was_found_and_nothing_else(judgement):
    """Limits so high that every kind of them is broken somewhere, and kept somewhere."""
    found, seen = judgement[2], Counter[str]()
    least = {
        "crossing": float(np.median(found.flattest)),
        "segment": float(np.median(found.shortest)),
    }
    ratios = np.concatenate([*found.triangles.values()])
    low, high = (float(np.quantile(ratios, part)) for part in (0.25, 0.75))
    strict = replace(found, limits=replace(found.limits, triangle=(low, high), **least))
    for i in range(len(strict)):
        assert strict.closes[i] and strict.fits[i]
        expected = {
            *(
                ("crossing", n, a[i])
                for n, a in found.crossings.items()
                if a[i] < least["crossing"]
            ),
            *(("segment", n, mm[i]) for n, mm in found.lengths.items() if mm[i] < least["segment"]),
            *(
                ("triangle", n, v[i])
                for n, v in found.triangles.items()
                if v[i] < low or v[i] > high
            ),
        }
        told = strict.faults(i)
        assert {(each.limit, each.where, each.value) for each in told} == expected
        assert strict.fair[i] == (not expected)
        for each in told:
            side = low if each.value < low else high
            assert each.bound == least.get(each.limit, side)
        seen.update({each.limit for each in told})
    assert seen.keys() == {"crossing", "segment", *(["triangle"] if len(ratios) else [])}


@pytest.fixture(scope="module")
def turning(tmp_path_factory):
    """A slider-crank over a whole turn, whose centre and pole come and go; a tall one as well."""
    found = {}
    for name, offset in (("long", 30), ("tall", 105)):
        text = (ROOT / "sheets" / "offset-slider-crank" / "scene.toml").read_text(encoding="utf-8")
        text = text.replace("n = { value = 7, min = 1, max = 30, step = 1 }", "n = 0")
        text = text.replace('"128 + 6*n/5"', '"n"').replace('"100 + 5*n"', "120")
        text = text.replace("[0, 30]", f"[0, {offset}]")
        text = text.replace("epsilon = [2]", "epsilon = [2]\ncentres = [2]\npoles = [2]")
        path = tmp_path_factory.mktemp(name) / "turning.toml"
        path.write_text(text, encoding="utf-8")
        found[name] = path
    return found


@pytest.mark.parametrize("name", ["long", "tall"])
def test_centres_that_come_and_go_are_where_the_layout_has_them(turning, name):
    path = turning[name]
    lab = lab_of(path)
    many = [{"n": Fraction(angle)} for angle in range(0, 360, 5)]
    found = judged(lab, many)
    seen = set()
    for i, given in enumerate(many):
        for sheet in sheets_of(mechanism_of(path, given)):
            quantity = PLACES[sheet.kind]
            point = sheet.place(sheet.trace.value(quantity, "2"))
            field = f"{'I' if quantity == 'centre' else 'J'}_2_x_mm"
            on_page = point is not None and lay_out(sheet).mechanism.holds(point, 2.0)
            assert found.on_page[field][i] == on_page
            seen.add((quantity, on_page))
            if not on_page:
                assert {field, field.replace("_x_", "_y_")} <= set(found.computed(i))
            flat = found.rays[field][i] < lab.fair.crossing
            assert (field in found.computed(i)) == (flat or not on_page)
    assert len(seen) == 4


@pytest.mark.parametrize("name", ["gears-planet.toml", "centrodes-four-bar.toml"])
def test_scenes_that_go_one_by_one_are_judged_all_the_same(name):
    mechanism = load(SCENES / name)
    parameter = next(iter(mechanism.scene.parameters.values()))
    value = Fraction(mechanism.scene.values[parameter.name])
    found = judged(lab_of(SCENES / name), [{parameter.name: value}])
    assert found.closes.all() and found.fits.all()
    for sheet in sheets_of(mechanism):
        tables = {name: mm for name, _, mm, _ in vectors(sheet)}
        for field, lengths in found.lengths.items():
            name = field.removesuffix("_mm")
            if name in tables:
                assert lengths[0] == pytest.approx(tables[name], abs=1e-9)


# --- scales of a batch: those of each one's own sheets -------------------------------------------

BY_ARRAYS = [(lab, "n", range(1, 31, 2)) for lab in LABS] + [
    (SCENES / "crank-slot.toml", "angle", range(0, 345, 30)),
    (SCENES / "oscillating-slide.toml", "angle", range(0, 345, 30)),
    (SCENES / "crank-rocker.toml", "n", range(0, 24, 2)),
]
ONE_BY_ONE = [
    (SCENES / "gears-planet.toml", "angle", range(0, 345, 90)),
    (SCENES / "rapid-return-slider.toml", "y", range(-116, -96, 8)),
]


def held(name: str | Path, parameter: str, values: range) -> None:
    """Hold the scales of a batch against those of each variant's own sheets."""
    mechanism = load(name)
    many = [{parameter: Fraction(value)} for value in values]
    arrays = {**mechanism.scene.values, parameter: np.array(values, dtype=float)}
    lab = lab_of(Path(mechanism.scene.source))
    found = scaling(mechanism, arrays, len(many), lambda i: lab.variant(many[i])).own
    for i, given in enumerate(many):
        try:
            own = scales(load(name, **given))
        except GraphkinError:
            assert found[i] is None
            continue
        assert (found[i].kL, found[i].triangles) == (own.kL, own.triangles)
        assert found[i].seconds == pytest.approx(own.seconds, rel=1e-12)
        assert found[i].kv == pytest.approx(own.kv, rel=1e-12)
        assert found[i].ka == pytest.approx(own.ka, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "parameter", "values"), BY_ARRAYS[::2], ids=lambda v: str(v)[-22:]
)
def test_a_cranks_batch_has_the_scales_of_its_sheets(name, parameter, values):
    assert by_arrays(load(name))
    held(name, parameter, values)


@pytest.mark.parametrize(("name", "parameter", "values"), ONE_BY_ONE, ids=lambda v: str(v)[-22:])
def test_what_no_crank_scales_is_asked_one_by_one(name, parameter, values):
    assert not by_arrays(load(name))
    held(name, parameter, values)


def with_sheet(tmp_path: Path, line: str) -> Path:
    """A lab with one more line in its [sheet]."""
    text = Path(load("offset-slider-crank").scene.source).read_text(encoding="utf-8")
    path = tmp_path / "offset-slider-crank.toml"
    path.write_text(f"{text.rstrip()}\n{line}\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("line", ["scale = 10", "ka = 0.5", "enlarge = 2"])
def test_what_the_scene_states_holds_for_a_batch(tmp_path, line):
    held(with_sheet(tmp_path, line), "n", range(1, 31, 7))
