"""What is wrong is told in words: the place, what was found, what was expected, and a hint."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from graphkin.mechanism import load
from graphkin.scene.findings import near_name
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES
from graphkin.text.errors import Problem, SceneError
from tests.scene_files import scene_text

Finder = Callable[..., Problem]
Finders = Callable[..., list[Problem]]
TURNED = "turn = 1\nangle"
KNOWN = ", ".join(LANGUAGES)
SLIDES = 'slides = { on = 0, through = "O1", angle = 0 }'

CASES = [
    # numbers
    ("A-B = 40", "A-B = nan", "links.3.A-B", "nan is not a finite decimal number", "a number"),
    ("A-B = 40", "A-B = -inf", "links.3.A-B", "-inf is not a finite", ""),
    ("A-B = 40", "A-B = 1e999", "links.3.A-B", "1e999 is out of range", "1e-60 and 1e60"),
    ("A-B = 40", "A-B = 1e-999", "links.3.A-B", "1e-999 is out of range", ""),
    ("A-B = 40", "A-B = true", "links.3.A-B", "true", "a number or an expression in quotes"),
    ("A-B = 40", "A-B = 2024-01-01", "links.3.A-B", "2024-01-01", "a number"),
    ("A-B = 40", "A-B = {}", "links.3.A-B", "a table", "a number"),
    ("A-B = 40", 'A-B = 40\nA = "on A-C"', "links.3.A", "A is placed by itself", '"on B-C"'),
    (
        "A-B = 40",
        'A-B = 40\nA = "on B-C"',
        "links.3.A",
        "begins with A",
        "of other points above A",
    ),
    ("A-B = 40", f"A-B = {'1' * 300}", "links.3.A-B", "too many digits", ""),
    ("A-B = 40", 'A-B = "9**9**9"', "links.3.A-B", "an exponent above 64", ""),
    ("A-B = 40", 'A-B = "2**(10**9)"', "links.3.A-B", "an exponent above 64", ""),
    ("A-B = 40", 'A-B = "10**61"', "links.3.A-B", '"10**61" is out of range', "1e60"),
    ("A-B = 40", 'A-B = "10**-61"', "links.3.A-B", "out of range", "1e-60"),
    ("A-B = 40", 'A-B = "pi**64*pi**64"', "links.3.A-B", "out of range", "1e60"),
    ("A-B = 40", 'A-B = "1/(n-7)"', "links.3.A-B", "division by zero with n = 7", ""),
    ("A-B = 40", 'A-B = "40 + m"', "links.3.A-B", "uses m, which is no parameter", "with n"),
    ("A-B = 40", 'A-B = "forty"', "links.3.A-B", "uses forty", "a number in cm, or an expression"),
    ("A-B = 40", 'A-B = "40 + N"', "links.3.A-B", "uses N", "did you mean n?"),
    ("A-B = 40", 'A-B = "20n"', "links.3.A-B", '"20n"', "write a product with *: 2*n"),
    ("A-B = 40", 'A-B = "40,5"', "links.3.A-B", "','", "write a decimal point"),
    ("A-B = 40", 'A-B = "n^2"', "links.3.A-B", "'^'", "write a power as **"),
    ("A-B = 40", 'A-B = "40 + t"', "links.3.A-B", "uses the time t", "only in a driver's angle"),
    # the top of the file
    ("graphkin = 1", "", "", "the version of the format is missing", "graphkin = 1"),
    ("graphkin = 1", "graphkin = 2", "", "written for a newer graphkin", "update"),
    ("graphkin = 1", "graphkin = true", "", "graphkin = true", "graphkin = 1"),
    ("graphkin = 1", 'graphkin = "1"', "", 'graphkin = "1"', "graphkin = 1"),
    ("graphkin = 1", "graphkin = 0", "", "graphkin = 0", "graphkin = 1"),
    ("title", "titel", "titel", "unknown key", "did you mean title?"),
    ("title", "time = 'x'\ntitle", "time", "uses x, which is no parameter", ""),
    ('"Pump mechanism"', "5", "title", "5", "a text in quotes"),
    ('"Pump mechanism"', '"a\\u202eb"', "title", "'\\u202e'", "printable text"),
    ('"Pump mechanism"', '"a\\u0000b"', "title", "'\\x00'", "printable text"),
    ('"cm"', '"cn"', "units.length", '"cn"', "one of cm, ft, in, m, mm"),
    ('"deg"', '"degree"', "units.angle", '"degree"', "did you mean deg?"),
    (', speed = "rev/min"', "", "units.speed", "no unit of speed", "rev/min"),
    (', speed = "rev/min"', ', speed = "rev/min", mass = "kg"', "units.mass", "unknown key", ""),
    # parameters
    ("value = 7", "value = 31", "parameters.n.value", "n = 31 is out of range", "from 1 to 30"),
    ("value = 7", 'value = "7.5"', "parameters.n.value", "n = 7.5 is off the step", "steps of 1"),
    ("value = 7", "value = true", "parameters.n.value", "true", "a number"),
    ("value = 7", 'value = "sqrt(2)"', "parameters.n.value", "not rational", ""),
    ("value = 7", 'value = "1/0"', "parameters.n.value", "division by zero", ""),
    ("step = 1 ", "step = 0 ", "parameters.n.step", "0", "above 0"),
    ("step = 1 ", "setp = 1 ", "parameters.n.setp", "unknown key", "did you mean step?"),
    ("min = 1,", "min = 40,", "parameters.n.min", "40 is above max", "at most 30"),
    ("[frame]", "[parameters.sin]\nvalue = 1\n[frame]", "parameters.sin", "a meaning", ""),
    ("[frame]", "[parameters.t]\nvalue = 1\n[frame]", "parameters.t", "a meaning", ""),
    ("[frame]", '[parameters."é"]\nvalue = 1\n[frame]', 'parameters."é"', "no name of a par", ""),
    ("[frame]", "[parameters.m]\nmin = 1\n[frame]", "parameters.m.value", "nothing", "a number"),
    # links
    ("[links.2]", "[links.O1]", "links.O1", "O1 is a point too", "one name for one thing"),
    ("[links.2]", "[links.frame]", "links.frame", "the frame among the links", "[frame]"),
    ("[links.2]", "[links.0]", "links.0", "the frame among the links", "[frame]"),
    ("[links.2]", "[links.02]", "links.02", "no name of a link", "a number, or a letter"),
    ("[links.2]", '[links."a\\u202eb"]', 'links."a\\u202eb"', "no name of a link", ""),
    ("[links.2]", '[links."e\\u0301"]', 'links."é"'[:7] + "e\u0301" + '"', "no name of a", ""),
    ("[links.2]", f"[links.{'a' * 41}]", f"links.{'a' * 41}", "no name of a link", "at most 40"),
    ("O2-B = 30", "X-Y = 30", "links.2", "link 2 touches no other", "slides or rolls"),
    ("O2-B = 30", "", "links.2", "a link without points", "points, such as"),
    ("[links.1]", "[links]\n9 = 3\n[links.1]", "links.9", "3", "a table with its points"),
    ("[links.1]", "slides = { on = 1 }\n[links.1]", "frame.slides", "the frame is at rest", ""),
    # keys of masses
    ("O2-B = 30", "O2-B = 30\nmasss = 2", "links.2.masss", "2", "did you mean mass?"),
    ("O2-B = 30", 'O2-B = 30\ncenter = "B"', "links.2.center", '"B"', "did you mean centre?"),
    ("O2-B = 30", "O2-B = 30\ninertial = 2", "links.2.inertial", "2", "did you mean inertia?"),
    ("O2-B = 30", "O2-B = 30\nslide = 2", "links.2.slide", "2", "did you mean slides?"),
    # slides
    ("on = 0", "on = 7", "links.5.slides.on", "link 7 is not in [links]", "0, 1, 2, 3, 4, 5"),
    ("on = 0", "on = 5", "links.5.slides.on", "link 5 itself", "another link"),
    ("on = 0", "on = true", "links.5.slides.on", "true is no name of a link", ""),
    ("on = 0, ", "", "links.5.slides.on", "is missing", "carries the guide, 0 for the frame"),
    ('"O1", angle', '"O3", angle', "links.5.slides.through", "O3 is no point of the frame", "O1"),
    (", angle = 0 }\n[[", " }\n[[", "links.5.slides", "through without an angle", "angle = …"),
    ('through = "O1", ', "", "links.5.slides", "no through", 'along = "P-Q"'),
    ("angle = 0 }", "angel = 0, angle = 1 }", "links.5.slides.angel", "unknown key", "mean angle?"),
    ("angle = 0 }", "angle = 0, pin = 1 }", "links.5.slides.pin", "1", "true or false"),
    (SLIDES, "", "links.5", "has the point D alone and no slides", "slides = { on = …, … }"),
    (
        SLIDES,
        "slides = { on = 3, through = 5.5, angle = 0 }",
        "links.5.slides.through",
        "5.5",
        'a point, "P", or two coordinates [x, y]',
    ),
    (
        SLIDES,
        'slides = { on = 4, along = "C-D" }',
        "links.5.slides.on",
        "link 5 slides on link 4 and is pinned to it at D",
        "a link that does not have D",
    ),
    (
        SLIDES,
        'slides = { on = 3, along = "D-B" }',
        "links.5.slides.along",
        "D is a point of link 5, not of link 3",
        "to slide link 3 along this link, write slides in link 3, with on = 5",
    ),
    (SLIDES, 'slides = { on = 3, along = "A-X" }', "links.5.slides.along", "X is no point", "C"),
    (SLIDES, 'slides = { on = 3, along = "A" }', "links.5.slides.along", '"A"', '"A-B"'),
    (SLIDES, 'slides = { on = 3, along = "A-A" }', "links.5.slides.along", '"A-A"', "two points"),
    (
        SLIDES,
        'slides = { on = 3, along = "A-B", angle = 3 }',
        "links.5.slides.angle",
        "angle beside along",
        "either along",
    ),
    (SLIDES, 'slides = [1, { on = 3, along = "A-B" }]', "links.5.slides[0]", "1", "a table"),
    # drivers
    ("turn = 1", "turn = 8", "drivers[0].turn", "link 8 is not in [links]", "one of 1, 2"),
    ("turn = 1", "turn = 0", "drivers[0].turn", "against the frame, which is at rest", ""),
    ("turn = 1", "turn = 2\nagainst = 2", "drivers[0].turn", "against itself", ""),
    (TURNED, "slide = 5\nagainst = 5\nposition", "drivers[0].slide", "itself", "against = 0"),
    (TURNED, "slide = 0\nposition", "drivers[0].slide", "against the frame", "slide = 5"),
    ("turn = 1", "turn = 1\nagainst = 9", "drivers[0].against", "link 9 is not in", ""),
    ("turn = 1", "trun = 1", "drivers[0]", "nothing driven", "did you mean turn?"),
    ("turn = 1", "turn = 1\nslide = 5", "drivers[0]", "turn and slide", "one of turn"),
    ("turn = 1", "turn = 1.5", "drivers[0].turn", '"1.5" is no name of a link', ""),
    ("turn = 1", 'turn = 1\nof = "O1-B"', "drivers[0].of", "B is no point of link 1", "A, O1"),
    ("turn = 1", 'turn = 1\nof = "A"', "drivers[0].of", '"A"', "two points"),
    ('\nangle = "30 + 2*n"', "", "drivers[0]", "no angle", "angle = … in deg"),
    ('\nangle = "30 + 2*n"', "\nposition = 1", "drivers[0].position", "has no position", "angle"),
    ('\nspeed = "300 + 10*n"', "", "drivers[0]", "no speed", "speed = … in rev/min"),
    ("[[drivers]]", "[drivers]", "drivers", "a table", "double brackets"),
    ("[branches]", "[[drivers]]\nturn = 1\nangle = 1\nspeed = 2\n[branches]", "drivers", "2 t", ""),
    # branches
    ("\nB = ", "\nX = ", "branches.X", "X is no point or link", "one of 1, 2, 3, 4, 5, A, B"),
    ("A-O2", "A-O3", "branches.B", "O3 is no point of the mechanism", "did you mean O2?"),
    ("right of A-O2", "right of A-B", "branches.B", "B on a side of itself", ""),
    ('"forward"', '"upward"', "branches.5", '"upward"', '"closure 1"'),
    ('"forward"', '"foward"', "branches.5", '"foward"', "did you mean forward?"),
    ("right of A-O2", "rihgt of A-O2", "branches.B", '"rihgt of A-O2"', "did you mean right?"),
    ("A-O2", "A-02", "branches.B", '"right of A-02"', "did you mean O2, with the letter?"),
    ('"forward"', '"closure 0"', "branches.5", '"closure 0"', '"closure 1"'),
    ('"forward"', "1", "branches.5", "1", '"forward"'),
    ('"forward"', '"left of A-B"', "branches.5", "a side for link 5", '"forward"'),
    ('"right of A-O2"', '"backward"', "branches.B", "forward, backward or a closure", "left of"),
    ("5 = ", "frame = ", "branches.frame", "a branch of the frame", "a pin or"),
    # ask
    ('velocity = ["D"]', 'velocity = ["Q"]', "ask.velocity[0]", "Q is no point", "A, B, C, D"),
    ('velocity = ["D"]', 'velocity = "D"', "ask.velocity", '"D"', 'a list, such as ["A", "B"]'),
    ('velocity = ["D"]', 'velocity = ["A@9"]', "ask.velocity[0]", "link 9 is not in", ""),
    ('velocity = ["D"]', 'velocity = ["X@3"]', "ask.velocity[0]", "X is no point", ""),
    ('velocity = ["D"]', "velocity = [3]", "ask.velocity[0]", "3 is no name of a point", ""),
    ("[3, 4]", "[3, 44]", "ask.poles[1]", "link 44 is not in [links]", ""),
    ("[3, 4]", "[0]", "ask.poles[0]", "the frame, which is at rest", "a moving link"),
    ("[3, 4]", "[[3]]", "ask.poles[0]", "a list of 1", "a number or a name"),
    ("[3, 4]", "[3, 3, 44]", "ask.poles[2]", "link 44 is not in [links]", ""),
    ("poles = [3, 4]", 'centres = ["2-3", "x"]', "ask.centres[1]", "link x is not in", ""),
    ("poles = [3, 4]", 'centres = [2, 2, "2-x"]', "ask.centres[2]", "link x is not in", ""),
    ("poles", "pole", "ask.pole", "unknown key", "did you mean poles?"),
    ("poles = [3, 4]", "slides = [4]", "ask.slides[0]", "link 4 does not slide", "slides"),
    ("[ask]", "[asks]", "asks", "unknown key", "did you mean ask?"),
    # sheet, titles, notes
    ("[ask]", '[sheet]\nlanguage = "xx"\n[ask]', "sheet.language", '"xx"', f"one of {KNOWN}"),
    ("[ask]", "[sheet]\nsheets = 3\n[ask]", "sheet.sheets", "3", "1 or 2"),
    ("[ask]", "[sheet]\nscale = 0\n[ask]", "sheet.scale", "0", "above 0"),
    ("[ask]", '[sheet]\nscale = "1:0"\n[ask]', "sheet.scale", "':'", ""),
    ("[ask]", '[sheet]\nowner = "a\\u0007"\n[ask]', "sheet.owner", "'\\x07'", "printable"),
    ("[ask]", '[titles]\nxx = "x"\n[ask]', "titles.xx", "unknown key", KNOWN),
    ("[ask]", "[notes]\nro = 3\n[ask]", "notes.ro", "3", "a text in quotes"),
]


@pytest.mark.parametrize(
    ("old", "new", "place", "found", "more"), CASES, ids=[f"{case[2]}: {case[1]}" for case in CASES]
)
def test_one_thing_wrong_is_one_problem(
    problem: Finder, old: str, new: str, place: str, found: str, more: str
) -> None:
    wrong = problem(old, new)
    assert wrong.place == place
    assert found in wrong.found
    assert more in f"{wrong.expected} {wrong.hint}"


SAID = [
    # a unit behind a number
    ("A-B = 40", 'A-B = "70 mm"', 'links.3.A-B: "70 mm" has a unit', "once in units: write 70"),
    ("A-B = 40", 'A-B = "5cm"', 'links.3.A-B: "5cm" has a unit', "once in units: write 5"),
    ("A-B = 40", 'A-B = "5 m"', 'links.3.A-B: "5 m" has a unit', "write 5; a product has its *"),
    ("A-B = 40", 'A-B = "5*m"', "links.3.A-B: ", "uses m, which is no parameter"),
    ('"30 + 2*n"', '"30°"', 'drivers[0].angle: "30°" has a unit', "once in units: write 30"),
    ('"30 + 2*n"', '"-30 deg"', 'drivers[0].angle: "-30 deg" has a unit', "write -30"),
    ('"30 + 2*n"', '"2*n°"', 'drivers[0].angle: "2*n°" has a unit', "write 2*n"),
    # units of another spelling, and units that there are not
    ('"deg"', '"Degrees"', 'units.angle: "Degrees"', "did you mean deg?"),
    ('"deg"', '"°"', 'units.angle: "°"', "did you mean deg?"),
    ('"rev/min"', '"RPM"', 'units.speed: "RPM"', "did you mean rev/min?"),
    ('"cm"', '"CM"', 'units.length: "CM"', "did you mean cm?"),
    # branches under the wrong name
    (
        '5 = "forward"',
        'D = "forward"',
        "branches.D: forward, backward or a closure for point D",
        "expected 5 = \"forward\"; a block's branch is written under the link's name",
    ),
    (
        'B = "right of A-O2"',
        '3 = "left of A-O2"',
        "branches.3: a side for link 3",
        'sides are written under the pin\'s name: B = "left of A-O2"',
    ),
    # capitals
    (
        "O1-A = ",
        "o1-A = ",
        "links.1.o1: no other link has o1",
        "O1 is written with another capital",
    ),
    # what is not written
    ("on = 0, ", "", "links.5.slides.on: is missing", "carries the guide, 0 for the frame"),
    ("[frame]", "[frame]\nwheel = { radius = 3 }", "frame.wheel.centre: is missing", "of a point"),
]


@pytest.mark.parametrize(("old", "new", "begins", "holds"), SAID)
def test_a_mistake_is_answered_with_the_way_to_write_it(
    problem: Finder, old: str, new: str, begins: str, holds: str
) -> None:
    said = str(problem(old, new))
    assert said.startswith(begins)
    assert holds in said


def test_a_unit_that_is_only_spelt_alike_is_not_meant(problem: Finder) -> None:
    assert str(problem('"deg"', '"grad"')) == 'units.angle: "grad"; expected one of deg, rad'


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ("A-B = 9\nB-A-P = 25", "links.crank.P: the length A-P is missing; expected A-P = …"),
        ("A-B = 9\nP-A-B = 25", "links.crank.P: the length A-P is missing; expected A-P = …"),
        ("A-P = 9\nB-A-P = 25", "links.crank.B: the length A-B is missing; expected A-B = …"),
        ("B-A-P = 25\nA-P = 9", "links.crank.A: the length A-B is missing; expected A-B = …"),
        (
            'A-P = 6\nB-P = 7\nP = "left of A-B"',
            "links.crank.B: the length A-B is missing; expected A-B = …",
        ),
    ],
)
def test_a_length_that_is_missing_is_named(
    broken_crank: Callable[[str], list[Problem]], keys: str, said: str
) -> None:
    assert said in map(str, broken_crank(keys))


PLANETS = [
    ('on = "sun"', 'on = "sum"', "links.planet.rolls.on", "link sum is not in", "did you mean"),
    ("arm = 0,", "arn = 0,", "links.planet.rolls.start.arn", "link arn is not in", "mean arm?"),
    ('wheel = { centre = "P", radius = 30 }', "", "links.planet.rolls", "planet has no wheel", ""),
    ('wheel = { centre = "O", radius = 60 }', "", "links.planet.rolls", "has no wheel to roll", ""),
    ('on = "sun",', 'on = "sun", side = "up",', "links.planet.rolls.side", '"up"', '"left"'),
    ('on = "sun",', 'on = "sun", through = "O",', "links.planet.rolls", "without an angle", ""),
    ('turn = "sun"', 'roll = "planet"', "drivers[1].angle", "has no angle", "position"),
]


def test_of_a_rack_the_pinion_rolls(problems: Finders) -> None:
    """The rack's own rolls are refused with the rolls of its pinion."""
    rack = ('wheel = { centre = "P", radius = 30 }', 'slides = { on = 0, along = "P-O" }')
    wrong = problems(*rack, "planet")
    assert any('write rolls = { on = "planet", through' in str(each.hint) for each in wrong)
    assert any("in link sun" in str(each.hint) for each in wrong)


@pytest.mark.parametrize(("old", "new", "place", "found", "more"), PLANETS)
def test_wheels_and_tracks(
    problems: Finders, old: str, new: str, place: str, found: str, more: str
) -> None:
    wrong = problems(old, new, "planet")[0]
    assert wrong.place == place
    assert found in wrong.found
    assert more in f"{wrong.expected} {wrong.hint}"


def test_a_driver_along_the_wrong_guide(problem: Finder) -> None:
    old = 'turn = 1\nangle = "30 + 2*n"'
    wrong = problem(old, "slide = 5\nposition = 1\nagainst = 3")
    assert wrong.found == "link 5 slides on the frame, not on link 3"
    assert wrong.expected == "against = 0"
    lost = problem(old, "slide = 4\nposition = 1")
    assert lost.found == "link 4 has no guide to slide along"
    assert lost.expected == "slide = 5"
    assert "no straight track to roll on" in problem(old, "roll = 4\nposition = 1").found


MISPLACED = [
    ("turn = 1", "turn = 1\ntime = 0", "drivers[0].time: unknown key", "above the first heading"),
    ("[ask]", "[ask]\nmodule = 2", "ask.module: unknown key", "above the first heading"),
    ("[ask]", "[sheet]\nenlarge = [2, -1]\n[ask]", "sheet.enlarge[1]: -1", "a number above 0"),
    (
        "[links.2]",
        "touches = { on = 3, radii = [4, 5] }\n[links.2]",
        "links.1.touches.centres: is missing",
        'two points with a dash, such as "A-B"',
    ),
    (
        "[links.1]",
        'Q = { from = "O9", length = 3, angle = 0 }\n[links.1]',
        "frame.Q: from names O9, no point of this link",
        "expected one of O1, O2;",
    ),
]


@pytest.mark.parametrize(("old", "new", "begins", "holds"), MISPLACED)
def test_a_mistake_names_its_place_and_what_stands_there(
    problems: Finders, old: str, new: str, begins: str, holds: str
) -> None:
    (said,) = [each for each in map(str, problems(old, new)) if each.startswith(begins)]
    assert holds in said


def test_every_misspelt_key_of_a_polar_point_is_told(problems: Finders) -> None:
    found = problems("[links.1]", 'Q = { form = "O1", lenght = 3, angel = 0 }\n[links.1]')
    told = {problem.place: str(problem.hint) for problem in found}
    assert told["frame.Q.form"] == "did you mean from?"
    assert told["frame.Q.lenght"] == "did you mean length?"
    assert told["frame.Q.angel"] == "did you mean angle?"


SEVERAL = scene_text("scene/several")


def test_every_problem_is_told_at_once(problems: Finders) -> None:
    found = problems("[links.4]", SEVERAL)
    assert [problem.place for problem in found] == [
        "links.6.A-B",
        "links.6.X",
        "links.6.slides.through[1]",
        "links.6.slides.angle",
        "links.8.R",
        "links.6.slides.on",
        "links.7",
    ]
    assert str(found[0]) == "links.6.A-B: -40; expected a number above 0"


def test_a_law_of_time_without_a_time_is_told_with_the_speed_beside_it(problems: Finders) -> None:
    """What is wrong beside a law does not wait for the time that the law lacks."""
    found = problems('"30 + 2*n"', '"30*t"\nacceleration = 0')
    assert [str(problem).partition("; ")[0] for problem in found] == [
        'drivers[0].angle: "30*t" uses the time t, and the scene has no time',
        "drivers[0].speed: speed beside a law of time",
        "drivers[0].acceleration: acceleration beside a law of time",
    ]
    mixed = problems('"30 + 2*n"', '"30*t + m"')
    assert [problem.place for problem in mixed] == ["drivers[0].angle"] * 2 + ["drivers[0].speed"]


def test_what_is_wrong_with_the_links_is_told_beside_what_is_asked(problems: Finders) -> None:
    """A link that hangs loose is told with an unknown branch; not so where a length is unread."""
    found = problems("[ask]", 'Q = "left of A-B"\n[links.9]\nA-X = 10\n[ask]')
    assert [problem.place for problem in found] == ["branches.Q", "drivers"]
    found = problems("[ask]", 'Q = "left of A-B"\n[links.9]\nA-X = -10\n[ask]')
    assert [problem.place for problem in found] == ["links.9.A-X", "branches.Q"]
    found = problems("[ask]", "[links.9]\nA-X = 10\n[ask]\nomega = [12]")
    assert [problem.place for problem in found] == ["ask.omega[0]", "drivers"]


def test_a_branch_that_nothing_chooses_is_told_beside_an_unknown_one(problems: Finders) -> None:
    """But none is asked for that is missing: the unknown one may be meant for it."""
    found = problems("[branches]", '[branches]\nQ = "left of A-B"\n2 = "closure 9"')
    assert [problem.place for problem in found] == ["branches.Q", "branches.2"]
    found = problems("[branches]\nB", "[branches]\nQ")
    assert [problem.place for problem in found] == ["branches.Q"]


SETTINGS = [
    ({"n": 31}, "setting n", "n = 31 is out of range", "n from 1 to 30 in steps of 1"),
    ({"n": "7.5"}, "setting n", "n = 7.5 is off the step", "in steps of 1"),
    ({"n": "1/3"}, "setting n", "out of range", ""),
    ({"m": 3}, "setting m", '"m" is no parameter', "n"),
    ({"N": 3}, "setting N", '"N" is no parameter', "did you mean n?"),
    ({"n": "seven"}, "setting n", '"seven" is no number', "a number"),
    ({"n": "7*m"}, "setting n", '"7*m" uses m', "a number, without parameters"),
    ({"n": "7,0"}, "setting n", "','", "write a decimal point"),
    ({"n": ""}, "setting n", "an empty expression", "a number"),
    ({"n": True}, "setting n", "true", "a number"),
    ({"n": None}, "setting n", "nothing", "a number"),
    ({"n": float("nan")}, "setting n", "nan", "a number"),
    ({"n": 1e300}, "setting n", "out of range", ""),
    ({"n": object}, "setting n", "<class 'object'>", "a number"),
]


@pytest.mark.parametrize(("settings", "place", "found", "more"), SETTINGS)
def test_settings_out_of_order(
    problem: Finder, settings: dict[str, object], place: str, found: str, more: str
) -> None:
    wrong = problem(**settings)
    assert wrong.place == place
    assert found in wrong.found
    assert more in f"{wrong.expected} {wrong.hint}"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "the file is empty"),
        ("\ufeff \r\n\t\n", "the file is empty"),
        ("# to be written\n", "nothing but comments"),
    ],
)
def test_an_empty_file_is_one_problem(text: str, said: str) -> None:
    with pytest.raises(SceneError) as caught:
        read_text(text, "empty")
    assert str(caught.value) == f"{said}; expected a scene, its first line graphkin = 1"


@pytest.mark.parametrize(
    ("beside", "near"),
    [
        ({"slider-crank.toml": "graphkin = 1"}, "slider-crank.toml"),
        ({"slider-crank/scene.toml": "graphkin = 1"}, "slider-crank"),
        ({"slider-crank.toml": "[fair]", "slider-cran.csv": "id,name"}, ""),
        ({"m8_short.toml": "graphkin = 1"}, ""),
    ],
    ids=str,
)
def test_a_file_that_is_not_there_is_held_against_the_scenes_beside_it(
    tmp_path: Path, beside: dict[str, str], near: str
) -> None:
    for name, text in beside.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    with pytest.raises(SceneError) as raised:
        load(tmp_path / "slider-cran.toml")
    asked = f"did you mean {tmp_path / near}?" if near else "did you mean"
    assert (asked in str(raised.value)) is bool(near)


@pytest.mark.parametrize(
    ("name", "known", "near"),
    [
        ("de", ("en", "it", "ro"), ""),
        ("es", ("en", "it", "ro"), ""),
        ("whitworht", ("m8_short", "pump"), ""),
        ("whitworht", ("m8_short", "whitworth"), "whitworth"),
        ("O3", ("A", "O1", "O2"), "O2"),
        ("n", ("N", "m"), "N"),
        ("rihgt", ("left", "right"), "right"),
        ("degree", ("deg", "rad"), "deg"),
        ("7", ("1", "2"), ""),
        ("lock", ("slides", "wheel"), ""),
        ("weight", ("moderate", "serious", "slight"), ""),
        ("lsight", ("moderate", "serious", "slight"), "slight"),
    ],
)
def test_a_name_is_near_another_by_a_third_of_its_letters_or_its_number(
    name: str, known: tuple[str, ...], near: str
) -> None:
    assert near_name(name, known) == near


def test_a_list_in_round_brackets_is_mended_in_square_ones(problem: Finder) -> None:
    for wrong in ("(0, -30)", "[0, -30)", "(0, -30]"):
        assert "a list is written in square brackets: [0, -30]" in str(problem("[0, -30]", wrong))


@pytest.mark.parametrize("strange", ["a", 1 + 2j, [None], [True]])
def test_a_batch_wants_real_numbers(strange: object) -> None:
    with pytest.raises(SceneError) as raised:
        load("pump").batch(n=strange)
    assert str(raised.value) == "n: holds what is no number; expected real numbers"


@pytest.mark.parametrize("run", ["batch", "stream"])
def test_a_batch_wants_one_number_for_each_variant(run: str) -> None:
    slider = load("offset-slider-crank")
    with pytest.raises(SceneError) as raised:
        getattr(slider, run)(n=[[1, 2], [3, 4]], r=[50, 51, 52])
    told = "n: an array of 2 dimensions; expected one number for each variant"
    assert str(raised.value) == told
    with pytest.raises(SceneError) as raised:
        getattr(slider, run)(n=[1, 2, 3], r=[50, 51])
    assert str(raised.value) == "r: 2 values beside 3 of n; expected as many, or one"


def refused(text: str, settings: dict[str, str] | None = None) -> str:
    with pytest.raises(SceneError) as error:
        read_text(text, "scene.toml", settings=settings or {})
    return str(error.value)


OWN_POSITION = scene_text("motion/own-position")


def test_a_hint_does_not_repeat_what_was_expected() -> None:
    said = refused(OWN_POSITION, {"q": "3"})
    assert said == 'setting q: "q" is no parameter; expected p'


def test_the_frame_is_not_proposed_for_a_driver() -> None:
    said = refused(OWN_POSITION.replace("turn = 1", "turn = 9"))
    assert "link 9 is not in [links]; expected one of 1, 2" in said


@pytest.mark.parametrize(
    ("old", "new", "meant"),
    [
        ('speed = "rev/min" }', 'speed = "rev/min", results = "inch" }', "in"),
        ("[ask]", '[sheet]\nlanguage = "deutsch"\n[ask]', "de"),
    ],
)
def test_a_long_form_of_a_short_word_is_recognised(old: str, new: str, meant: str) -> None:
    assert refused(OWN_POSITION.replace(old, new)).endswith(f"did you mean {meant}?")
