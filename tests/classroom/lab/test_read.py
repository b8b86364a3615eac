"""lab.toml is read whole: every mistake is told at once, with its place and the way out."""

from __future__ import annotations

import shutil
from fractions import Fraction

import pytest
from click.testing import CliRunner

from graphkin.classroom.lab.items import all_fields, asked_of, items
from graphkin.classroom.lab.lab_model import SHARES, Fair, LabRule, Range, Rubric
from graphkin.classroom.lab.read_lab import find, read_lab, with_rules
from graphkin.cli.main import app
from graphkin.mechanism import load
from graphkin.text.errors import SceneError
from tests.chosen import CHOSEN
from tests.classroom.lab.singles import LABS, ROOT

RULE = 'graphkin = 1\n[variants]\nset = { n = "number" }\n'


@pytest.fixture
def mine(tmp_path):
    folder = tmp_path / "mine"
    folder.mkdir()
    shutil.copy(ROOT / "sheets" / "pump" / "scene.toml", folder)

    def written(text, encoding="utf-8"):
        (folder / "lab.toml").write_text(text, encoding=encoding)
        return folder

    return written


def problems(folder):
    with pytest.raises(SceneError) as caught:
        read_lab(folder)
    return [str(problem) for problem in caught.value.problems]


def test_the_shipped_labs_are_read():
    assert with_rules() == sorted(LABS)
    for name in LABS:
        lab = read_lab(name)
        assert lab.name == name
        assert lab.scene.is_file()
        assert lab.rule.draws or lab.rule.settings


def test_a_lab_has_its_defaults(mine):
    lab = read_lab(mine(RULE))
    assert (lab.fair, lab.rubric, lab.name) == (Fair(), Rubric(), "mine")
    assert lab.text == RULE
    drawn = "draw = { n = { min = 1, max = 30, step = 1 } }"
    assert read_lab(mine(f'graphkin = 1\n[variants]\ncourse = "c"\n{drawn}\n')).rule.tries == 100


def test_everything_that_is_stated_is_read(mine):
    lab = read_lab(mine(f"graphkin = 1\n{LINES}\n"))
    assert lab.rule == LabRule("M", {"n": Range(Fraction(3), Fraction(21), Fraction(2))}, 7)
    assert lab.fair == Fair(9, 3, (0.05, 4), 0.02, 0.5)
    causes = {"rpm_as_rad": 0.5}
    grades = dict(SHARES)
    rubric = Rubric({"v_D": Fraction(1)}, 0.7, causes, grades, 0.6, 0.4, 0.3, 0.1, 0.9, hold=True)
    assert lab.rubric == rubric


def test_a_list_draws_among_values_and_ranges(mine):
    draw = "draw = { n = [2, 9, { min = 12, max = 20, step = 4 }] }\n"
    lab = read_lab(mine(f'graphkin = 1\n[variants]\ncourse = "M 26"\n{draw}'))
    values = lab.rule.draws["n"]
    assert [values.value(k) for k in range(len(values))] == [2, 9, 12, 16, 20]
    with pytest.raises(IndexError):
        values.value(5)


DRAWN = 'graphkin = 1\n[variants]\ncourse = "M"\ndraw = '
WRONG = {
    DRAWN + "{ n = [] }\n": "lab.toml: variants.draw.n: an empty list",
    DRAWN + "{ n = [14, { min = 12, max = 20, step = 4 }] }\n": "draw.n: 14 lies within what is",
    DRAWN + "{ n = [3, 77] }\n": "variants.draw.n[1]",
    "": "the file is empty",
    "graphkin = 1\n": "variants: no rule; expected set",
    "graphkin = 2\n" + RULE[13:]: "written for a newer graphkin",
    RULE[13:]: "the version of the format is missing",
    "graphkin = 1\nvariants = 3": "variants: 3; expected a table",
    RULE + 'course = "M"\ndraw = { n = [3, 7] }\n': "variants.set.n: draw gives n as well",
    RULE.replace('"number"', '"number mod 0"') + "draw = {}\n": "variants.course: is missing",
    RULE.replace('"number"', '"number mod"'): 'variants.set.n: "number mod" is not an expression',
    RULE + "tries = 3\n": "variants.tries: belongs to ranges",
    RULE.replace(" n ", " m "): "variants.set.m: is no parameter; expected n",
    RULE.replace("number", "numbr"): "did you mean number?",
    RULE.replace('"number"', "7"): "no formula uses number",
    RULE.replace('"number"', "true"): "variants.set.n: true; expected an expression",
    RULE.replace('"number"', '"__import__(1)"'): "variants.set.n",
    RULE.replace('"number"', "nan"): "variants.set.n",
    RULE + "[fair]\ncrossing = 90\n": "fair.crossing: 90; expected a number from 0 to 89",
    RULE + "[fair]\ncrossing = inf\n": "fair.crossing",
    RULE + "[fair]\nsegmnt = 3\n": "did you mean segment?",
    RULE + "[fair]\ntriangle = 3\n": "two numbers [least, most]",
    RULE + "[fair]\ntriangle = [4, 1]\n": "0 ≤ least < most",
    RULE + '[fair]\ntriangle = ["a", 1]\n': "fair.triangle[0]",
    RULE + "[marks]\nv_d_mm = 1\n": "did you mean v_D_mm?",
    RULE + "[marks]\nv_D = -1\n": "marks.v_D: -1; expected points",
    RULE + "[marks]\nv_D = true\n": "marks.v_D: true; expected a number",
    RULE + "[marking]\nfloor = 0.3\n": "marking.floor: 0.3 is above cap",
    RULE + "[marking]\nhold = 1\n": "marking.hold: 1; expected true or false",
    RULE + "[marking]\ncap = 2.5\n": "marking.cap: 2.5; expected a number from 0 to 1",
    RULE + "[marking]\ncauses = { opposite = 2 }\n": "causes.opposite: 2; expected a number from 0",
    RULE + "[marking]\ncauses = { 'a b' = 1 }\n": "no cause has this name",
    RULE + "[text]\n": "text: unknown key",
}
RANGES = 'graphkin = 1\n[variants]\ncourse = "c"\ndraw = { n = { min = 1, max = 30, step = 1 } }\n'
WRONG |= {
    RANGES.replace('course = "c"\n', ""): "variants.course: is missing",
    RANGES.replace('"c"', '""'): "variants.course: is missing",
    RANGES.replace('"c"', '"c\\u202e"'): "control character",
    RANGES.replace("min = 1", "min = 0"): "n = 0 is out of range",
    RANGES.replace("max = 30", "max = 31"): "n = 31 is out of range",
    RANGES.replace("step = 1", "step = 0.5"): "off the step",
    RANGES.replace("step = 1", "step = 0"): "a number above 0",
    RANGES.replace("step = 1", "step = 1e-12"): "too many values",
    RANGES.replace("min = 1", "min = 31"): "is above max",
    RANGES.replace(", step = 1", ""): "variants.draw.n.step: is missing",
    RANGES.replace("{ n =", "{ m ="): "variants.draw.m: is no parameter",
    RANGES + "tries = 0\n": "variants.tries: 0",
    RANGES + "tries = 1.5\n": "a whole number",
}


@pytest.mark.parametrize(("text", "expected"), WRONG.items())
def test_what_is_wrong_is_told_with_its_place(mine, text, expected):
    found = problems(mine(text))
    assert any(expected in problem for problem in found), found
    assert all(problem.startswith("lab.toml") for problem in found)


def test_all_mistakes_are_told_at_once(mine):
    text = (
        RULE.replace("number", "numbr")
        + "[fair]\nsegmnt = 3\n[marks]\nv_x = 1\n[marking]\ncap = -1"
    )
    assert len(problems(mine(text))) == 4


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("pumpp", "did you mean pump?"),
        (ROOT / "README.md", "is no lab"),
        (ROOT / "examples" / "scenes" / "pump.toml", "shipped lab"),
        (ROOT / "examples" / "scenes" / "slider-crank.toml", "graphkin new lab NAME"),
    ],
)
def test_what_is_no_lab_is_told(name, expected):
    with pytest.raises(SceneError, match=expected.replace("?", r"\?")):
        find(name)


# ------------------------------------------------------------------------------------ items


def test_the_form_has_what_is_asked_then_what_the_rubric_names(mine):
    lab = read_lab(mine(RULE + "[marks]\na_BA_tau_mm = 1\nomega_2 = 1\nv_BA = 1\n"))
    form = items(load("pump"), lab)
    fields = [item.field for item in form]
    assert fields[:4] == ["v_D_mm", "v_D", "a_D_mm", "a_D"]
    assert fields[-2:] == ["v_BA", "a_BA_tau_mm"]
    assert len(set(fields)) == len(fields)
    by = {item.field: item for item in form}
    assert (by["v_D_mm"].what, by["v_D_mm"].unit) == ("segment", "mm")
    assert (by["omega_3"].unit, by["omega_3_sense"].what) == ("rad/s", "sense")
    assert (by["J_3_x_mm"].quantity, by["J_3_x_mm"].of) == ("pole", "3")
    assert (by["a_BA_tau_mm"].quantity, by["a_BA_tau_mm"].of) == ("arrow", "a_BA^τ")


def test_every_field_of_a_scene_is_plain_ascii_and_unique():
    for name in CHOSEN:
        fields = all_fields(load(ROOT / "examples" / "scenes" / f"{name}.toml"))
        assert fields
        for field, item in fields.items():
            assert field == item.field
            assert field.isascii() and field.isidentifier()


POINTS = {"a_D_mm": Fraction(3), "a_D": Fraction(1), "epsilon_2": Fraction(3, 2)}


def fields(points: dict[str, Fraction], compute: tuple[str, ...]) -> dict[str, Fraction | None]:
    """The fields of the pump's form, and what they are worth."""
    form, worths = asked_of(items(load("pump"), read_lab("pump")), points, compute)
    return {item.field: worths.get(item.field) for item in form}


def test_the_points_of_a_short_segment_go_to_the_value_that_is_computed():
    found = fields(POINTS, ("a_D_mm", "a_D"))
    assert "a_D_mm" not in found
    assert found["a_D"] == 4


def test_a_short_segment_whose_value_earns_nothing_stays():
    """Else the student would be asked for nothing that earns its points."""
    points = {"a_D_mm": Fraction(3)}
    found = fields(points, ("a_D_mm", "a_D"))
    assert found["a_D_mm"] == 3


@pytest.mark.parametrize("formula", ["n", "nubmer", "2*nr", "x + y"])
def test_a_formula_of_anything_else_is_asked_whether_the_number_is_meant(mine, formula):
    found = problems(mine(RULE.replace('"number"', f'"{formula}"')))
    assert found
    assert all(line.endswith("did you mean number?") for line in found)


def test_mistakes_of_the_rule_name_its_file_and_no_other(mine):
    """Also after check has read the scene, whose name stands before the scene's own mistakes."""
    folder = mine(RULE.replace('"number"', '"n"'))
    said = CliRunner().invoke(app, ["check", str(folder)])
    mistakes = [
        line for line in said.stderr.splitlines() if not line.startswith("graphkin: the manual")
    ]
    assert [line.startswith("graphkin: lab.toml: variants.set.n: ") for line in mistakes] == [True]


def test_a_cause_that_nobody_knows_earns_no_silent_nothing(mine):
    (line,) = problems(mine(RULE + "[marking.causes]\nrpm_as_rads = 0.5\nnormal_missing = 0.3\n"))
    assert line.startswith("lab.toml: marking.causes.rpm_as_rads: no cause has this name")
    assert line.endswith("did you mean rpm_as_rad?")


LINES = """variants.course = "M"
variants.tries = 7
variants.draw.n.min = 3
variants.draw.n.max = 21
variants.draw.n.step = 2
fair.crossing = 9
fair.segment = 3
fair.triangle = [0.05, 4]
fair.apart = 0.02
fair.pencil = 0.5
marks.v_D = 1
marking.causes.rpm_as_rad = 0.5
marking.follow = 0.7
marking.point = 0.6
marking.line = 0.4
marking.ruler = 0.3
marking.floor = 0.1
marking.cap = 0.9
marking.hold = true"""
BOUNDS = {
    "variants.tries": (1, 10_000),
    "fair.crossing": (0, 89),
    "fair.segment": (0, 1000),
    "fair.apart": (0, 1),
    "fair.pencil": (0, 1),
    "marking.causes.rpm_as_rad": (0, 1),
    "marking.follow": (0, 1),
    "marking.point": (0, 10),
    "marking.line": (0, 10),
    "marking.ruler": (0, 10),
}
KEYS = [line.partition(" = ")[0] for line in LINES.splitlines()]


def exchanged(key, value):
    """The lines with another value of one of them."""
    rows = (line.partition(" = ") for line in LINES.splitlines())
    return "\n".join(f"{own} = {value if own == key else raw}" for own, _, raw in rows)


WRONG_VALUES = ("{ a = 1 }", "[[1]]", "nan", '"?"', "-1e9", "[]")


@pytest.mark.parametrize(("number", "key"), [*enumerate(KEYS)])
def test_one_wrong_value_anywhere_is_told_at_its_place_and_nothing_else(mine, number, key):
    """Of six wrong values every other, the others for the next key."""
    for usual in WRONG_VALUES[number % 2 :: 2]:
        value = "1e9" if key.endswith(".max") and usual == "-1e9" else usual
        if key == "variants.course" and "[" not in usual and "{" not in usual:
            value = '" "'
        with pytest.raises(SceneError) as caught:
            read_lab(mine(f"graphkin = 1\n{exchanged(key, value)}\n"))
        for problem in caught.value.problems:
            assert problem.file == "lab.toml"
            assert problem.place.startswith(key), problem
            assert problem.found and problem.expected, problem
            assert key not in problem.found
    rows = LINES.replace(f"{key} = ", f"{key}x = ")  # and a key that nobody knows
    assert any(f"lab.toml: {key}x" in told for told in problems(mine(f"graphkin = 1\n{rows}\n")))


@pytest.mark.parametrize("key", BOUNDS)
def test_numbers_of_a_lab_lie_between_their_bounds_inclusive(mine, key):
    for bound, off in zip(BOUNDS[key], (-1, 1), strict=True):
        read_lab(mine(f"graphkin = 1\n{exchanged(key, bound)}\n"))
        (told,) = problems(mine(f"graphkin = 1\n{exchanged(key, bound + off)}\n"))
        assert f"lab.toml: {key}" in told and f"from {BOUNDS[key][0]} to {BOUNDS[key][1]}" in told


def test_a_range_may_be_one_value_and_a_floor_the_cap_but_no_triangle_is_flat(mine):
    """The one value may be the last that the scene allows: no step leads on from it."""
    one = exchanged("variants.draw.n.max", 30).replace("n.min = 3", "n.min = 30")
    lab = read_lab(mine(f"graphkin = 1\n{one.replace('floor = 0.1', 'floor = 0.9')}\n"))
    assert lab.rule.draws["n"] == Range(Fraction(30), Fraction(30), Fraction(2))
    assert lab.rubric.floor == lab.rubric.cap
    (told,) = problems(mine(f"graphkin = 1\n{exchanged('fair.triangle', '[1, 1]')}\n"))
    assert "fair.triangle" in told
