"""What check tells: structure, closures, range, crossings, and every mistake at once."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from graphkin import load
from graphkin.diagnosis.closures import choices
from tests.running import ROOT, Run
from tests.scene_files import scene_text


def test_closures_are_mirrored_in_the_line_of_the_known_pins() -> None:
    pump = load("pump", n=7)
    b, d = choices(pump.scene, pump.groups, pump.program)
    solution = pump.solve()
    a, o2 = solution.points["A"].position, solution.points["O2"].position
    picked, other = (closure.place for closure in b.closures)
    assert picked == solution.points["B"].position
    assert abs((picked - a) / (o2 - a) - ((other - a) / (o2 - a)).conjugate()) < 1e-12
    assert d.closures[0].place == solution.points["D"].position
    assert [closure.words for closure in d.closures] == ["forward", "backward"]


def test_the_other_closure_is_what_the_scene_finds_with_the_other_branch(tmp_path: Path) -> None:
    text = (ROOT / "sheets" / "pump" / "scene.toml").read_text(encoding="utf-8")
    path = tmp_path / "turned.toml"
    path.write_text(text.replace('"right of A-O2"', '"left of A-O2"'), encoding="utf-8")
    pump, turned = load("pump"), load(str(path))
    other = choices(pump.scene, pump.groups, pump.program)[0].closures[1]
    assert other.place == turned.solve().points["B"].position
    assert other.fails == ""


@pytest.mark.parametrize(
    ("unit", "place"),
    [
        ("mm", "(135.615, 89.825) mm"),
        ("cm", "(135.6145, 89.8247) cm"),
        ("m", "(135.614512, 89.824703) m"),
        ("in", "(135.615, 89.825) in"),
    ],
)
def test_closures_are_in_the_unit_of_the_scene(
    unit: str, place: str, run: Run, tmp_path: Path
) -> None:
    text = (ROOT / "examples" / "scenes" / "four-bar-crank-rocker.toml").read_text("utf-8")
    path = tmp_path / "four-bar.toml"
    path.write_text(text.replace('length = "mm"', f'length = "{unit}"'), encoding="utf-8")
    assert f"left of B-D        {place} " in run("check", str(path)).stdout


# --- structure: the count, the truth, and the drivers --------------------------------------------

CRANKS = """
graphkin = 1
title = "Three parallel cranks"
units = {{ length = "{unit}", angle = "deg", speed = "rad/s" }}
[frame]
O = [0, 0]
Q = [40, 0]
S = [20, 0]
[links.1]
O-A = 10
[links.2]
A-B = 40
A-M = 20
M = "on A-B"
[links.3]
Q-B = 10
[links.4]
S-M = {third}
[[drivers]]
turn = 1
angle = {angle}
speed = 1
{driver}
[branches]
B = "left of A-Q"
"""


@pytest.fixture
def cranks(tmp_path: Path) -> Callable[..., Path]:
    """Write the three parallel cranks: cranks(third=11) makes the third one longer."""

    def written(third: float = 10, angle: float = 40, driver: str = "", unit: str = "mm") -> Path:
        path = tmp_path / "cranks.toml"
        text = CRANKS.format(third=third, angle=angle, driver=driver, unit=unit)
        path.write_text(text, encoding="utf-8")
        return path

    return written


def part(text: str, label: str) -> list[str]:
    """The lines of one part of the report, without their label."""
    lines = text.splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith(label))
    rest = [line[11:] for line in lines[start + 1 :]]
    own = next(
        (n for n, line in enumerate(lines[start + 1 :]) if not line.startswith(" " * 11)), None
    )
    return [lines[start][11:], *rest[:own]]


def test_an_idle_crank_is_told_apart_from_a_jam(run: Run, cranks: Callable[..., Path]) -> None:
    """The count says 0, the rank 1: the third parallel crank could be left out."""
    result = run("check", cranks())
    assert result.exit_code == 0
    assert part(result.stdout, "count") == ["3·4 − 2·6 = 0, mobility by the count"]
    assert part(result.stdout, "groups")[-1] == (
        "3. link 4 between pin S and pin M, which are placed already: it must be idle"
    )
    assert part(result.stdout, "rank") == [
        "1, true mobility by the rank of the constraints",
        "1 more than the count: one constraint is idle, taking what others take already",
        "without link 4 (or link 3) the motion is the same, and the count is right",
    ]


def test_a_third_crank_that_does_not_fit_is_named(run: Run, cranks: Callable[..., Path]) -> None:
    result = run("check", cranks(third=11))
    assert result.exit_code == 2
    assert "links.4: S and M are 10 mm apart without it" in result.stderr


def test_a_group_that_closes_nowhere_has_no_closure_that_the_scene_says(
    run: Run, tmp_path: Path
) -> None:
    path = tmp_path / "torn.toml"
    scene = ROOT / "examples" / "scenes" / "stephenson-3-crank.toml"
    text = scene.read_text(encoding="utf-8")
    path.write_text(text, encoding="utf-8")
    assert part(run("check", path).stdout, "closures")[-1] == "(* as the scene says)"
    path.write_text(text.replace("C-D = 220", "C-D = 20"), encoding="utf-8")
    result = run("check", path)
    assert result.exit_code == 2
    assert part(result.stdout, "closures")[1:] == ["  none in this position"]


INVERSOR = """graphkin = 1
title = "Peaucellier's inversor, its block on the line"
units = { length = "mm", angle = "deg", speed = "rad/s" }
[frame]
O = [0, 0]
Q = [60, 0]
[links.1]
Q-A = 60
[links.2]
O-B = 140
[links.3]
O-C = 140
[links.4]
A-B = 60
[links.5]
A-C = 60
[links.6]
B-P = 60
[links.7]
C-P = 60
[links.8]
P = [0, 0]
slides = { on = 0, through = ["16000/120", 0], angle = 90 }
[[drivers]]
turn = 1
angle = 25
speed = 3
[branches]
B = "left of O-A"
C = "right of O-A"
P = "SIDE of B-C"
"""


@pytest.mark.parametrize(
    ("side", "told"),
    [("left", ""), ("right", "links.8: P is 18.9549 mm beside its guide without it")],
)
def test_an_idle_block_fits_in_one_closure_and_in_the_other_it_is_named(
    side: str, told: str, run: Run, tmp_path: Path
) -> None:
    """OA·OP = OB² - AB² = 16000 mm²: on the far side P keeps to x = 16000/120; on the other A is P.

    A stands at x = 60 (1 + cos 25°) there.
    """
    assert 16000 / 120 - 60 * (1 + math.cos(math.radians(25))) == pytest.approx(18.9549, abs=5e-5)
    path = tmp_path / "inversor.toml"
    path.write_text(INVERSOR.replace("SIDE", side), encoding="utf-8")
    result = run("check", path)
    assert result.exit_code == (2 if told else 0)
    assert told in result.stderr
    assert "drivers:" not in result.stderr


def test_three_parallel_bars_in_line_have_the_mobility_of_their_motion(
    run: Run, cranks: Callable[..., Path]
) -> None:
    """The third bar keeps the coupler parallel to the frame at 0° too, and is idle there."""
    result = run("check", cranks(angle=0, unit="m"))
    assert part(result.stdout, "rank")[:2] == [
        "1, true mobility by the rank of the constraints",
        "1 more than the count: one constraint is idle, taking what others take already",
    ]
    assert "drivers" not in result.stderr


def test_a_singular_position_is_told_apart_from_an_idle_link(
    run: Run, cranks: Callable[..., Path]
) -> None:
    """Two parallel cranks in line: the velocities are freer by one than the motion.

    In metres, whole numbers, so that rounding does not part the arcs that touch.
    """
    path = cranks(angle=0, unit="m")
    whole = path.read_text(encoding="utf-8")
    third = "S = [20, 0]\n", 'A-M = 20\nM = "on A-B"\n', "[links.4]\nS-M = 10\n"
    for lines in third:
        assert lines in whole
        whole = whole.replace(lines, "")
    path.write_text(whole, encoding="utf-8")
    result = run("check", path)
    assert part(result.stdout, "rank") == [
        "2, true mobility by the rank of the constraints",
        "singular position: beside it the constraints leave 1",
    ]
    assert "drivers" not in result.stderr


def test_a_driver_too_many_by_the_rank_is_told_though_everything_fits(
    run: Run, tmp_path: Path
) -> None:
    """A Stephenson six-bar driven at both ends: without either a group of higher class is left."""
    path = tmp_path / "twice.toml"
    path.write_text(scene_text("cli/twice"), encoding="utf-8")
    result = run("check", path)
    assert result.exit_code == 2
    assert part(result.stdout, "rank")[0].startswith("1, true mobility")
    assert "drivers: 2 given, but the count 3·5 - 2·7 leaves 1 freedom" in result.stderr


def test_a_driver_too_few_is_told_with_the_groups_that_stand(
    run: Run, four_bar: Callable[..., Path]
) -> None:
    path = four_bar()
    text = path.read_text(encoding="utf-8").replace("O2-B", "B-C")
    fourth = "[links.4]\nO2-C = 50\n[[drivers]]"
    path.write_text(text.replace("[[drivers]]", fourth), encoding="utf-8")
    result = run("check", path)
    assert result.exit_code == 2
    assert part(result.stdout, "count") == ["3·4 − 2·5 = 2, mobility by the count"]
    assert part(result.stdout, "groups")[0] == "1. crank 1 about O1 (class I)"
    told, more = result.stderr.splitlines()
    assert more == "graphkin: the manual says more: graphkin help drivers"
    assert "1 given, but the count 3·4 - 2·5 leaves 2 freedoms" in told
    assert "add a driver, such as turn = 4" in told


def test_a_second_collar_on_the_same_rail_is_two_idle_constraints(run: Run, tmp_path: Path) -> None:
    """One slide would do: the second takes the same distance and the same turning again."""
    path = tmp_path / "collars.toml"
    text = scene_text("cli/two-collars-on-a-rail")
    path.write_text(text, encoding="utf-8")
    assert part(run("check", path).stdout, "rank") == [
        "1, true mobility by the rank of the constraints",
        "2 more than the count: 2 constraints are idle, taking what others take already",
        "without the guide of block 1 on the frame the motion is the same",
    ]


def test_the_closures_of_a_driven_cylinder_are_those_of_its_dyad(run: Run, tmp_path: Path) -> None:
    """The rod's pin is mirrored in the line of the two fixed ones; the next group has its own."""
    path = tmp_path / "press.toml"
    path.write_text(
        scene_text("cli/driven-cylinder"),
        encoding="utf-8",
    )
    shown = part(run("check", path).stdout, "closures")
    assert shown[0].startswith("B of links")
    assert shown[1].startswith("* left of O-A")
    height = 1e3 * load(path).solve().points["B"].position.imag
    assert f"{-height:.3f}) mm" in shown[2]
    assert shown[3].startswith("C of links bar and ram")


# --- what crosses, and what falls together -------------------------------------------------------


def test_the_flattest_right_triangle_leans_as_its_velocity_says(run: Run) -> None:
    """Its edge crosses the bar at the angle whose tangent is l/v: told as it is drawn, to scale."""
    text = run("check", ROOT / "examples" / "scenes" / "slider-crank.toml").stdout
    line = next(line for line in text.splitlines() if "right triangle of B about A" in line)
    solved = load(ROOT / "examples" / "scenes" / "slider-crank.toml")
    motion = solved.solve()
    a, b = (motion.points[name] for name in "AB")
    crank = solved.scene.drivers[0].speed.si(solved.scene.values)
    drawn = abs(b.velocity - a.velocity) / crank
    lean = math.degrees(math.atan2(abs(b.position - a.position), drawn))
    assert f"{lean:.2f}°" in line


def test_the_closures_of_a_rope_are_told_by_where_it_leaves_the_drum() -> None:
    """Its ends stand in both: only T, where the tangent touches, tells them apart."""
    mechanism = load(ROOT / "examples" / "scenes" / "rope-on-drum.toml")
    (choice,) = choices(mechanism.scene, mechanism.groups, mechanism.program)
    one, other = (closure.place for closure in choice.closures)
    points = mechanism.solve().points
    assert choice.pin == "T"
    assert abs(one - other) > 0.1
    for place in (one, other):
        tangent = (points["A"].position - place) * (place - points["O"].position).conjugate()
        assert tangent.real == pytest.approx(0, abs=1e-12)


# --- what [sheet] states of scale factors --------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("scale = 0.01", "sheet.scale: does not fit: at 100:1 the drawing leaves its fields"),
        ("scale = 1000", "sheet.scale: at 1:1000 the mechanism is drawn"),
        ("enlarge = [100, 100]", "sheet.enlarge: at 100 times the mechanism is drawn"),
        ("enlarge = 0.001", "sheet.enlarge: at 0.001 times the longest velocity is drawn"),
        ("ka = 0.0001", "sheet.ka: does not fit: at 0.0001 (m/s²)/mm the acceleration plan"),
        ("ka = 1000", "sheet.ka: at 1000 (m/s²)/mm the longest acceleration is drawn"),
    ],
)
def test_a_scale_factor_that_no_sheet_can_keep_is_told_as_sheet_tells_it(
    run: Run, tmp_path: Path, line: str, told: str
) -> None:
    path = tmp_path / "scaled.toml"
    text = (ROOT / "examples" / "scenes" / "crank-rocker.toml").read_text(encoding="utf-8")
    path.write_text(f"{text}\n[sheet]\n{line}\n", encoding="utf-8")
    checked, drawn = run("check", path), run("sheet", path, "-o", tmp_path / "out")
    assert checked.exit_code == drawn.exit_code == 2
    assert checked.stderr == drawn.stderr
    assert told in checked.stderr
    assert "witness" in checked.stdout


@pytest.mark.parametrize("line", ["scale = 2", "enlarge = [1, 0.5]", 'rule = "lab"', "ka = 0.2"])
def test_a_scale_factor_that_sheets_keep_is_none_of_checks_business(
    run: Run, tmp_path: Path, line: str
) -> None:
    path = tmp_path / "scaled.toml"
    text = (ROOT / "examples" / "scenes" / "crank-rocker.toml").read_text(encoding="utf-8")
    path.write_text(f"{text}\n[sheet]\n{line}\n", encoding="utf-8")
    result = run("check", path)
    assert (result.exit_code, result.stderr) == (0, "")


def test_enlarge_without_a_crank_is_told_by_check(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "scaled.toml"
    text = (ROOT / "examples" / "scenes" / "cylinders-two.toml").read_text(encoding="utf-8")
    path.write_text(f"{text}\n[sheet]\nenlarge = 2\n", encoding="utf-8")
    result = run("check", path)
    assert result.exit_code == 2
    assert "sheet.enlarge: the plans of this mechanism are not drawn by one crank" in result.stderr


def test_the_number_of_a_closure_is_told_in_ways(run: Run) -> None:
    """A link on two known pins states ways; a scene may still number its closures."""
    path = ROOT / "tests" / "scenes" / "structure" / "pins" / "plate-by-its-closure.toml"
    checked = run("check", path)
    assert checked.exit_code == 0
    assert "branches   L0 = closure 1 is L0 = forward, s0 = forward\n" in checked.stdout


@pytest.fixture
def offset_slider_crank(tmp_path: Path) -> Callable[[str], Path]:
    """A slider-crank with r = 60, l = 200 and e = 20 mm that asks for something more."""

    def written(asked: str) -> Path:
        path = tmp_path / "offset.toml"
        path.write_text(
            "graphkin = 1\ntitle = 'Offset'\n"
            "units = { length = 'mm', angle = 'deg', speed = 'rev/min' }\n"
            "frame.O = [0, 0]\n[links]\n1 = { O-A = 60 }\n2 = { A-B = 200 }\n"
            "3 = { B = [0, 0], slides = { on = 0, through = [0, 20], angle = 0 } }\n"
            "[[drivers]]\nturn = 1\nangle = 40\nspeed = 120\n"
            f"[branches]\n3 = 'forward'\n[ask]\n{asked}\n",
            encoding="utf-8",
        )
        return path

    return written


def test_an_asked_stroke_and_time_ratio_are_reported(
    run: Run, offset_slider_crank: Callable[[str], Path]
) -> None:
    """H by Pythagoras in both dead positions; K by the angle between their cranks."""
    low, high = math.sqrt(140**2 - 20**2), math.sqrt(260**2 - 20**2)
    angle = math.degrees(math.asin(20 / 140) - math.asin(20 / 260))
    ratio = (180 + angle) / (180 - angle)
    checked = run("check", offset_slider_crank("strokes = [3]\ntime_ratios = [3]"))
    assert checked.exit_code == 0
    assert f"stroke of link 3: {high - low:.6g} mm" in checked.stdout
    assert f"time ratio of link 3: {ratio:.5g}" in checked.stdout


def test_a_stroke_of_a_link_that_turns_fully_is_a_mistake(
    run: Run, offset_slider_crank: Callable[[str], Path]
) -> None:
    checked = run("check", offset_slider_crank("strokes = [3, 1]\ntime_ratios = [1]"))
    assert checked.exit_code == 2
    assert "ask.strokes[1]: link 1" in checked.stderr
    assert "ask.time_ratios[0]: link 1" in checked.stderr
