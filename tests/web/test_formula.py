"""The exported function of each language gives the numbers of ``solve``, or is refused."""

from __future__ import annotations

import json
import math
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner
from msgspec.structs import replace
from openpyxl import load_workbook

from graphkin.cli.exchange_commands import export
from graphkin.cli.main import app
from graphkin.documents.program_files import PROGRAMS
from graphkin.mechanism import Mechanism, load
from graphkin.motion.driving import stated_motion
from graphkin.motion.sweep import law_of_time
from graphkin.scene.link_points import is_under
from graphkin.text.errors import GraphkinError, SceneError
from graphkin.web.formula import LANGUAGES, Formula, formula_of, formula_workbook
from tests.chosen import EVERY, by_turns

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"
TOLERANCE = 1e-9
"""Largest difference, in parts of the largest value of that quantity in the scene."""
KINDS = (
    *("pump", "crank-rocker", "crank-slot", "crank-fixed-slot", "cam-roller", "gears-planet"),
    *("geneva-wheel", "belts-arm", "shaper", "roller", "trammel", "klein-engine", "two-loops"),
    *("peaucellier", "five-bar", "cylinders-two", "gears-rack", "oldham", "excavator-absolute"),
)
"""Pins, guides that stay and swing, a cam, wheels, a slot, belts, cylinders, several drivers."""
Case = list[float]


def scene_named(name: str, **settings: object) -> Mechanism:
    path = SCENES / f"{name}.toml"
    return jerking(load(path if path.exists() else name, **settings))


def jerking(mechanism: Mechanism) -> Mechanism:
    """The mechanism asked for the jerks of its points of links, too."""
    scene = mechanism.scene
    jerk = tuple(point for point in scene.ask.velocity if not is_under(point))
    return Mechanism(replace(scene, ask=replace(scene.ask, jerk=jerk)))


def at_other_values(name: str) -> list[Mechanism]:
    """The mechanism as written, and with each parameter at two other values in its range."""
    found = [scene_named(name)]
    for parameter in found[0].scene.parameters.values():
        if parameter.minimum is None or parameter.maximum is None:
            continue
        low, high = (Fraction(end.number({})) for end in (parameter.minimum, parameter.maximum))
        step = Fraction(parameter.step.number({})) if parameter.step else (high - low) / 100
        for part in (Fraction(1, 3), Fraction(4, 5)):
            value = low + step * ((high - low) * part // step)
            try:
                other = scene_named(name, **{parameter.name: str(value)})
                other.solve()
            except GraphkinError:
                continue  # the mechanism does not close there
            found.append(other)
    return found


def motion_of(mechanism: Mechanism) -> dict[str, float]:
    """The results of ``solve`` under the names of the exported function."""
    found, solution = {}, mechanism.solve()
    for name, point in solution.points.items():
        named = name.replace("@", "_")
        vectors = [("", point.position), ("v", point.velocity), ("a", point.acceleration)]
        vectors.append(("j", point.jerk))
        for letter, value in vectors:
            if value is not None:
                found[f"{letter}x_{named}"] = complex(value).real
                found[f"{letter}y_{named}"] = complex(value).imag
    for name, link in solution.links.items():
        for quantity in ("omega", "epsilon"):
            value = getattr(link, quantity)
            if value is not None:
                found[f"{quantity}_{name}"] = float(value)
    return found


def places(mechanism: Mechanism) -> Case:
    """The time, or the coordinates of the drivers in degrees or in the scene's unit of length."""
    scene = mechanism.scene
    if law_of_time(scene):
        return [float(scene.time.number(scene.values)) if scene.time else 0.0]
    unit = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254}[scene.units["length"]]
    return [
        stated_motion(driver, scene)[0] / (1.0 if driver.kind == "turn" else unit)
        for driver in scene.drivers
    ]


@cache
def compared(name: str) -> tuple[Formula, list[Case], list[dict[str, float]]]:
    """The formula of a scene as written, arguments of other variants, and what ``solve`` gives."""
    variants = at_other_values(name)
    formula = formula_of(variants[0])
    taken = {each.name for each in formula.arguments}
    cases = []
    for each in variants:
        given = [name for name in each.scene.parameters if f"p_{name}" in taken]
        cases.append([*places(each), *(float(each.scene.values[name]) for name in given)])
    return formula, cases, [motion_of(each) for each in variants]


def by_python(formula: Formula, cases: Sequence[Case], _: Path) -> list[dict[str, float]]:
    names: dict[str, Callable[..., dict[str, float]]] = {}
    exec(LANGUAGES["python"](formula), names)  # type: ignore[arg-type]
    return [names[formula.name](*case) for case in cases]


def by_javascript(formula: Formula, cases: Sequence[Case], tmp: Path) -> list[dict[str, float]]:
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed")
    (tmp / "formula.js").write_text(LANGUAGES["javascript"](formula), encoding="utf-8")
    call = f"{json.dumps(cases)}.map(c => require('./formula.js').{formula.name}(...c))"
    run = f"process.stdout.write(JSON.stringify({call}))"
    done = subprocess.run([node, "-e", run], cwd=tmp, capture_output=True, check=True)
    return json.loads(done.stdout)  # type: ignore[no-any-return]


def by_c(formula: Formula, cases: Sequence[Case], tmp: Path) -> list[dict[str, float]]:
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler is installed")
    calls = []
    for case in cases:
        calls += [f"r = {formula.name}({', '.join(map(repr, case))});"]
        calls += [f'printf("%.17g\\n", r.{name});' for name in formula.results]
    main = f"int main(void) {{ struct {formula.name}_result r; {' '.join(calls)} return 0; }}"
    source = f"#include <stdio.h>\n{LANGUAGES['c'](formula)}{main}\n"
    (tmp / "formula.c").write_text(source, encoding="utf-8")
    options = ["-std=c99", "-Wall", "-Wno-unused", "-Wno-parentheses", "-Werror"]
    command = [compiler, *options, "formula.c", "-o", "formula", "-lm"]
    subprocess.run(command, cwd=tmp, check=True)
    done = subprocess.run([str(tmp / "formula")], capture_output=True, check=True)
    numbers = iter(map(float, done.stdout.split()))
    return [{name: next(numbers) for name in formula.results} for _ in cases]


def by_matlab(formula: Formula, cases: Sequence[Case], tmp: Path) -> list[dict[str, float]]:
    octave = shutil.which("octave-cli") or shutil.which("octave")
    if octave is None:
        pytest.skip("GNU Octave is not installed")
    (tmp / f"{formula.name}.m").write_text(LANGUAGES["matlab"](formula), encoding="utf-8")
    lines = ["more off;"]
    for case in cases:
        lines += [f"r = {formula.name}({', '.join(map(repr, case))});"]
        lines += [f'printf("%.17g\\n", r.{name});' for name in formula.results]
    (tmp / "calls.m").write_text("\n".join(lines), encoding="utf-8")
    command = [octave, "--norc", "--no-history", "--quiet", "calls.m"]
    done = subprocess.run(command, cwd=tmp, capture_output=True, check=True)
    numbers = iter(map(float, done.stdout.split()))
    return [{name: next(numbers) for name in formula.results} for _ in cases]


RUNS = {"python": by_python, "javascript": by_javascript, "c": by_c, "matlab": by_matlab}


def test_the_command_offers_every_language() -> None:
    (choice,) = (each.type for each in export.params if each.name == "language")
    assert list(choice.choices) == [*LANGUAGES, "excel", *PROGRAMS]


def test_every_language_is_run() -> None:
    assert set(RUNS) == set(LANGUAGES)


@pytest.mark.parametrize("name", KINDS)
def test_each_argument_changes_a_result(name: str, tmp_path: Path) -> None:
    formula, (case, *_), _ = compared(name)
    (before,) = by_python(formula, [case], tmp_path)
    for place, value in enumerate(case):
        other = [*case[:place], value * 1.0001 + 1e-4, *case[place + 1 :]]
        (after,) = by_python(formula, [other], tmp_path)
        assert after != before, formula.arguments[place].name


OTHERS = by_turns(KINDS, [language for language in RUNS if language != "python"])
"""Each kind in one other language, and each of these for a third of the kinds."""


@pytest.mark.parametrize(("name", "language"), [*((name, "python") for name in KINDS), *OTHERS])
def test_the_numbers_are_those_of_solve(name: str, language: str, tmp_path: Path) -> None:
    formula, cases, expected = compared(name)
    for found, wanted in zip(RUNS[language](formula, cases, tmp_path), expected, strict=True):
        assert set(found) == set(wanted)
        for one in wanted:
            kind = one.partition("_")[0].replace("y", "x")
            alike = [v for n, v in wanted.items() if n.partition("_")[0].replace("y", "x") == kind]
            size = max(map(abs, alike)) if max(map(abs, alike)) > TOLERANCE else 1.0
            assert found[one] == pytest.approx(wanted[one], rel=0, abs=TOLERANCE * size), one


RECALCULATE = """
import json, sys
from formulas import ExcelModel
model = ExcelModel().loads(sys.argv[1]).finish(circular=False)
sheet = "'[book.xlsx]MOTION'!"
for values in json.loads(sys.argv[2]):
    given = {sheet + cell: value for cell, value in values.items()}
    wanted = {name: sheet + cell for name, cell in json.loads(sys.argv[3]).items()}
    found = model.calculate(inputs=given, outputs=list(wanted.values()))
    print(json.dumps({name: float(found[c].value[0, 0]) for name, c in wanted.items()}))
"""
"""A formula engine that knows nothing of mechanisms computes the workbook with other arguments."""


@pytest.mark.parametrize(
    "name", ["crank-slot", "gears-planet", "cylinders-two", "pump"][: 4 if EVERY else 3]
)
def test_a_workbook_computes_what_solve_does(name: str, tmp_path: Path) -> None:
    formula, cases, expected = compared(name)
    (tmp_path / "book.xlsx").write_bytes(formula_workbook(formula))
    rows = {
        row[0].value: row[1].coordinate
        for row in load_workbook(tmp_path / "book.xlsx")["Motion"].iter_rows()
        if len(row) > 1
    }
    given = [
        {rows[a.name]: value for a, value in zip(formula.arguments, case, strict=True)}
        for case in cases
    ]
    wanted = {result: rows[result] for result in formula.results}
    command = [sys.executable, "-c", RECALCULATE, "book.xlsx", json.dumps(given)]
    done = subprocess.run(
        [*command, json.dumps(wanted)], cwd=tmp_path, capture_output=True, check=True, text=True
    )
    for line, solved in zip(done.stdout.splitlines(), expected, strict=True):
        found = json.loads(line)
        for one, value in solved.items():
            assert found[one] == pytest.approx(value, rel=1e-8, abs=1e-7), one


def test_a_workbook_needs_a_file() -> None:
    told = CliRunner().invoke(app, ["export", "pump", "--to", "excel"])
    assert told.exit_code == 2
    assert "-o FILE" in told.stderr


def test_most_scenes_are_compared_at_several_positions() -> None:
    counts = [len(compared(name)[1]) for name in KINDS]
    assert sum(counts) >= 3 * len(KINDS)


def test_a_law_of_time_is_a_function_of_the_time(tmp_path: Path) -> None:
    formula = formula_of(scene_named("excavator-absolute"))
    assert [each.name for each in formula.arguments] == ["t_s"]
    text = (SCENES / "excavator-absolute.toml").read_text(encoding="utf-8")
    assert "time = 0.5\n" in text
    later = tmp_path / "later.toml"
    later.write_text(text.replace("time = 0.5\n", "time = 0.7\n"), encoding="utf-8")
    wanted = motion_of(jerking(load(later)))
    (found,) = by_python(formula, [[0.7]], tmp_path)
    assert found == pytest.approx(wanted, rel=TOLERANCE, abs=TOLERANCE)
    (before,) = by_python(formula, [[0.5]], tmp_path)
    assert before != pytest.approx(wanted, rel=1e-3)


def test_no_number_where_the_mechanism_cannot_be_assembled(tmp_path: Path) -> None:
    formula = formula_of(scene_named("four-bar-double-rocker"))
    cases = [[float(angle), *(a.value for a in formula.arguments[1:])] for angle in range(360)]
    found = by_python(formula, cases, tmp_path)
    finite = [all(map(math.isfinite, each.values())) for each in found]
    assert any(finite)
    assert not all(finite)


def test_a_point_keeps_its_own_name_beside_one_that_only_resembles_it(tmp_path: Path) -> None:
    """C@2 and a point written C_2 would have one identifier; the written point has it."""
    text = (SCENES / "crank-slot.toml").read_text(encoding="utf-8")
    path = tmp_path / "alike.toml"
    path.write_text(re.sub(r"\bE\b", "C_2", text), encoding="utf-8")
    formula = formula_of(load(path))
    case = [each.value for each in formula.arguments]
    (found,) = by_python(formula, [case], tmp_path)
    solution = load(path).solve()
    for name, own in (("C_2", "C_2"), ("C_2_", "C@2")):
        place = solution.points[own].position
        assert complex(found[f"x_{name}"], found[f"y_{name}"]) == pytest.approx(place)
    assert "C_2_ in a result stands for C@2." in formula.notes


@pytest.mark.parametrize("name", ["platform-3rpr", "gears-sun-and-planet"])
def test_what_is_no_line_of_formulas_is_refused(name: str) -> None:
    with pytest.raises(SceneError, match="one line of formulas"):
        formula_of(scene_named(name))


def test_a_formula_says_where_the_motion_takes_another_closure() -> None:
    """A parallelogram keeps its side in the formula, and changes it in the motion."""
    notes = formula_of(scene_named("four-bar-change-point")).notes
    assert "The closure is that of the scene. Beyond phi_deg = 0, 180" in notes
    assert not [*formula_of(scene_named("crank-rocker")).warnings()]


def test_a_title_cannot_leave_its_comment(tmp_path: Path) -> None:
    text = (SCENES / "trammel.toml").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("title")]
    lines.insert(1, 'title = "a\\u2028throw 1"')
    path = tmp_path / "odd.toml"
    path.write_text("\n".join(lines), encoding="utf-8")
    try:
        source = LANGUAGES["javascript"](formula_of(load(path)))
    except SceneError:
        return  # such a title is no title
    assert source.startswith("// a throw 1\n")


def test_the_command_writes_what_the_formula_is(tmp_path: Path) -> None:
    source = LANGUAGES["c"](formula_of(load("pump", n=9)))
    printed = CliRunner().invoke(app, ["export", "pump", "--set", "n=9", "--to", "c"])
    assert printed.output == source
    file = tmp_path / "new" / "pump.c"
    arguments = ["export", "pump", "--set", "n=9", "--to", "c", "-o", str(file)]
    assert CliRunner().invoke(app, arguments).exit_code == 0
    assert file.read_text(encoding="utf-8") == source
