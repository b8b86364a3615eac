"""What accuracy costs: errors obey their laws; what is timed is never asserted."""

from __future__ import annotations

import csv
import io
from functools import cache
from itertools import count
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from graphkin.accuracy.comparison import approach, ground_of, places_around
from graphkin.accuracy.methods import BITS, DIGITS, QUICK, STEPS, TOLERANCES, MethodRow, plain
from graphkin.accuracy.study import LAW, Study, digits_of, methods_picture, study
from graphkin.cli.report.accuracy_report import HEADS, accuracy_table
from graphkin.documents.sheet_documents import scales
from graphkin.mechanism import load
from tests.accuracy.agreement import agreement
from tests.running import Run

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
FOUR_BAR = str(SCENES / "four-bar-double-rocker.toml")
WHOLE_TURN = str(SCENES / "slider-crank.toml")
SEVERAL_DRIVERS = str(SCENES / "gears-planet.toml")
PENCILS = ("pencil, 0.5 mm", "pencil, 0.25 mm", "pencil, 0.1 mm")
OWN = (
    "float64, one by one",
    "float64 batch, by steps",
    "float64 batch, emitted numpy",
    "float32 batch, by steps",
    "longdouble batch, by steps",
)
CASES = ("pump", FOUR_BAR, WHOLE_TURN, SEVERAL_DRIVERS)
every_case = pytest.mark.parametrize("name", CASES, ids=lambda name: Path(name).stem)


@cache
def found(name: str) -> Study:
    """The quick study of a scene with a clock that only counts how often it is read."""
    ticks = count()
    mechanism = load(name)
    return study(mechanism, scales(mechanism), QUICK, clock=lambda: next(ticks) * 1e-3)


@every_case
def test_the_table_has_every_method(name):
    methods = {row.method for row in found(name).rows}
    assert methods >= {*OWN, *PENCILS}
    assert methods >= {f"mpmath, {digits} digits" for digits in DIGITS}
    assert methods >= {f"Arb, {bits} bits" for bits in BITS}
    assert methods >= {f"Newton, to {plain(t)}" for t in TOLERANCES}
    assert methods >= {f"central differences, h = {plain(h)}" for h in STEPS}


@every_case
def test_decimals_err_by_no_more_than_their_digits_and_the_condition(name):
    of = found(name)
    condition = 1 / of.reference.sines.min() ** 3
    for digits in DIGITS:
        assert max(of.row(f"mpmath, {digits} digits").errors) < 10.0 ** (2 - digits) * condition


@every_case
def test_balls_shrink_with_their_bits(name):
    of = found(name)
    rows = [of.row(f"Arb, {bits} bits") for bits in BITS]
    assert all(row.certified for row in rows)
    for bits, row in zip(BITS, rows, strict=True):
        assert 2.0 ** -(bits + 8) < max(row.errors) < 2.0 ** (16 - bits)


@every_case
def test_single_precision_double_and_extended_err_as_their_last_digits(name):
    of = found(name)
    stretch = agreement(of.reference).bound / 2.0**-52
    for kind, digits in (("float32", 24), ("float64", 53)):
        worst = max(of.row(f"{kind} batch, by steps").errors)
        assert 2.0 ** -(digits + 2) < worst < 2.0**-digits * stretch
    longer = np.finfo(np.longdouble).eps
    assert max(of.row("longdouble batch, by steps").errors) < float(longer) * stretch


@every_case
def test_differences_have_a_best_step(name):
    # error of a central second difference: h²/12 from the curve, 4·eps/h² from rounding
    coarse, best, fine = (
        found(name).row(f"central differences, h = {plain(h)}").errors for h in STEPS
    )
    assert best[2] < coarse[2] / 10
    assert best[2] < fine[2] / 10
    assert coarse[1] > best[1] > fine[1]
    assert coarse[0] is None


@every_case
def test_a_looser_tolerance_is_never_better(name):
    loose, middle, tight = (found(name).row(f"Newton, to {plain(t)}").errors for t in TOLERANCES)
    for each in zip(loose, middle, tight, strict=True):
        assert each[0] >= 0.5 * each[1] or each[0] < 1e-14
        assert each[1] >= 0.5 * each[2] or each[1] < 1e-14
    assert max(tight) < 1e-12


@pytest.mark.parametrize("name", ["pump", FOUR_BAR])
def test_a_loose_tolerance_leaves_an_error_that_the_next_step_would_square(name):
    loose, middle = (max(found(name).row(f"Newton, to {plain(t)}").errors) for t in TOLERANCES[:2])
    assert loose > 1e-10
    assert middle < loose / 1e3


@every_case
def test_a_finer_pencil_errs_less_in_proportion(name):
    coarse, middle, fine = (np.array(found(name).row(p).errors) for p in PENCILS)
    assert coarse / middle == pytest.approx(2, rel=0.25)
    assert middle / fine == pytest.approx(2.5, rel=0.25)
    assert (fine > 1e-5).all()


@pytest.mark.parametrize("name", [FOUR_BAR, "pump"])
def test_towards_a_dead_point_errors_grow_as_one_two_three(name):
    # the 1-2-3 law of the conditioning of a dyad
    flat = found(name).flattening
    assert flat.approach.end == "dead"
    assert flat.falls
    assert flat.sines.min() < 1e-6
    assert flat.slopes("float64") == pytest.approx(LAW, abs=0.4)


def test_a_group_of_class_three_dies_by_the_same_law():
    from graphkin.accuracy.comparison import answers_of
    from graphkin.accuracy.study import flattened

    ground = ground_of(load(str(SCENES / "rod-and-wheel.toml")).scene)
    flat = flattened(
        approach(ground, 10, 2),
        answers_of(ground.sweep.scene, ground.piece.course.program),
    )
    assert flat.falls
    assert flat.slopes("float64") == pytest.approx(LAW, abs=0.4)


def test_positions_keep_away_from_flat_crossings():
    for name in ("pump", FOUR_BAR):
        ground = ground_of(load(name).scene)
        places = places_around(ground, 9)
        course = places.course
        assert course.margins(places.at).min() > 0.09
        assert places.at.min() < ground.centre < places.at.max()


def test_the_csv_holds_what_was_found():
    of = found("pump")
    rows = list(csv.DictReader(io.StringIO(accuracy_table(of))))
    assert tuple(rows[0]) == HEADS
    assert [row["method"] for row in rows] == [row.method for row in of.rows]
    arb = next(row for row in rows if row["method"] == "Arb, 106 bits")
    assert arb["error_is_certified_radius"] == "yes"
    error = float(arb["acceleration_error_over_largest_acceleration"])
    assert error == pytest.approx(of.row("Arb, 106 bits").errors[2], rel=1e-2)
    assert all(row["positions_compared"] == "6" and row["machine"] for row in rows)
    assert rows[-1]["median_seconds_per_position"] == ""


def test_the_command_writes_table_and_pictures(run: Run, tmp_path: Path):
    args = ("accuracy", "pump", "--set", "n=7", "--quick", "--format", "svg", "-o", tmp_path)
    result = run(*args)
    assert result.exit_code == 0, result.stderr
    names = {path.name for path in tmp_path.iterdir()}
    pictures = {f"pump-n7-accuracy-{p}.svg" for p in ("time", "dead-point")}
    assert names == {"pump-n7-accuracy.csv", *pictures}
    assert "What accuracy costs: Pump mechanism" in result.stdout
    assert result.stderr == ""
    again = run(*args)
    assert again.exit_code == 2
    assert "--force" in again.stderr


def test_each_row_of_the_table_has_its_digits_and_its_time_on_the_picture():
    """A drawing by hand has no time that was measured."""
    of = found("pump")
    digits, times = methods_picture(of).axes
    assert [label.get_text() for label in digits.get_yticklabels()] == [r.method for r in of.rows]
    drawn = points(digits)
    for y, row in enumerate(of.rows):
        assert drawn[y] == pytest.approx([-np.log10(e) for e in row.errors if e is not None])
    measured = {y: [row.time.median] for y, row in enumerate(of.rows) if row.time is not None}
    assert points(times) == measured


def points(axes) -> dict[int, list[float]]:
    """The places of single marks along the axis, by row."""
    found = {}
    for line in axes.lines:
        if len(line.get_xdata()) == 1:
            found.setdefault(int(line.get_ydata()[0]), []).append(float(line.get_xdata()[0]))
    return found


def test_an_answer_without_a_correct_digit_is_crossed_out():
    axes = Figure().add_subplot()
    axes.set_xscale("log")
    digits_of(axes, 0, MethodRow("float32", "float32", (1e-7, 2.0, np.inf), None))
    assert points(axes) == {0: pytest.approx([7.0])}
    assert [text.get_text() for text in axes.texts] == ["✗"]


def test_an_error_without_bound_fails_and_is_no_number():
    """Balls that grow without bound are no error of 1.8e308."""
    reference = found("pump").reference
    missed = np.array([[np.inf, np.nan, 0.0]] * len(reference.places.at))
    assert reference.relative(missed) == (np.inf, np.inf, 0.0)
