"""How a link's points are given: every placing uses only points before it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from graphkin.scene.model import Angled, Apart, At, Link, OnLine, Polar, Triangle
from graphkin.scene.quantity import exact
from graphkin.text.errors import Problem

MM = {number: exact(number, "mm") for number in range(201)}
Reader = Callable[[str], Link]
Breaker = Callable[[str], list[Problem]]


def test_a_link_in_coordinates_keeps_its_axes(crank: Reader) -> None:
    link = crank("O = [3, 4]\nA = [10, 5]")
    assert link.placings == (At("O", MM[3], MM[4]), At("A", MM[10], MM[5]))


def test_one_point_in_coordinates_then_lengths(crank: Reader) -> None:
    link = crank('O = [1, 2]\nO-A = 30\nO-B = 20\nA-B = 20\nB = "right of A-O"')
    assert link.placings == (
        At("O", MM[1], MM[2]),
        Apart("A", "O", MM[30]),
        Triangle("B", "A", "O", MM[20], MM[20], -1),
    )


def test_a_polar_point(crank: Reader) -> None:
    link = crank('O = [0, 0]\nA = { from = "O", length = 30, angle = 20 }\nA-B = 0.5\nO-A-B = 90')
    assert link.placings[1] == Polar("A", "O", MM[30], exact(20, "deg"))
    assert isinstance(link.placings[2], Angled)


@pytest.mark.parametrize(
    ("keys", "start", "sense"),
    [
        ('O-C = 10\nC = "on O-A"', "O", 1),
        ('A-C = 10\nC = "on O-A"', "A", -1),
        ('O-C = 10\nC = "on A-O"', "O", -1),
        ('A-C = 10\nC = "beyond A on O-A"', "A", 1),
        ('O-C = 40\nC = "beyond A on O-A"', "O", 1),
        ('O-C = 10\nC = "beyond O on O-A"', "O", -1),
        ('A-C = 40\nC = "beyond O on O-A"', "A", -1),
    ],
)
def test_points_on_a_line(crank: Reader, keys: str, start: str, sense: int) -> None:
    placing = crank(f"O-A = 30\n{keys}").placings[-1]
    assert isinstance(placing, OnLine)
    assert (placing.start, placing.sense) == (start, sense)


@pytest.mark.parametrize(
    "keys",
    [
        'O-A = 30\nA-B = 20\nA = "on O-B"',
        'A = "on B-O"\nA-O = 30\nB-A = 20',
        'A = "on O-B"\nA-B = 20\nA-O = 30',
        'A-B = 20\nO-A = 30\nA = "on O-B"',
    ],
)
def test_both_parts_of_a_line_make_it_without_its_length(crank: Reader, keys: str) -> None:
    """OA = 30 and AB = 20 with A between them are OB = 50, from whichever end it begins."""
    origin, middle, far = crank(keys).placings
    assert isinstance(origin, At) and isinstance(middle, Apart) and isinstance(far, OnLine)
    assert (origin.x.number({}), middle.start) == (0, origin.point)
    assert (far.start, far.sense) == ("A", 1)
    assert {origin.point, middle.point, far.point} == {"O", "A", "B"}


def test_parts_and_the_whole_line_are_one_measure_too_many(broken_crank: Breaker) -> None:
    (problem,) = broken_crank('O-A = 30\nA-B = 20\nO-B = 50\nA = "on O-B"')
    assert "one measure too many" in str(problem)


def test_an_angle_places_either_of_its_ends(crank: Reader) -> None:
    last = crank("O-A = 30\nA-B = 20\nO-A-B = 60").placings[-1]
    first = crank("O-A = 30\nA-B = 20\nB-A-O = 300").placings[-1]
    assert isinstance(last, Angled) and isinstance(first, Angled)
    assert (last.arm, first.arm) == ("O", "O")
    assert last.angle.number({}) == 60
    assert first.angle.number({}) == -300


@pytest.mark.parametrize("angle", [0, 180])
def test_straight_angles_are_allowed(crank: Reader, angle: int) -> None:
    assert isinstance(crank(f"O-A = 30\nA-B = 20\nO-A-B = {angle}").placings[-1], Angled)


def test_points_wait_for_each_other(crank: Reader) -> None:
    link = crank(
        'O-A = 30\nD-C = 15\nD-A = 25\nD = "left of A-C"\nO-C = 30\nA-C = 30\nC = "left of O-A"'
    )
    assert link.points == ("O", "A", "D", "C")
    assert [placing.point for placing in link.placings] == ["O", "A", "C", "D"]


BROKEN = {
    'O-A = 40\nO-B = 15\nA-B = 25\nB = "left of O-A"': (
        "B",
        "O-A 40, O-B 15, A-B 25 make a flat triangle",
        'B = "on O-A"',
    ),
    'O-A = 10\nO-B = 15\nA-B = 25\nB = "left of O-A"': ("B", "flat", 'B = "beyond O on O-A"'),
    'O-A = 10\nO-B = 35\nA-B = 25\nB = "left of O-A"': ("B", "flat", 'B = "beyond A on O-A"'),
    'O-A = 0.3\nO-B = 0.1\nA-B = 0.2\nB = "left of O-A"': ("B", "flat", "on O-A"),
    'O-A = 40\nO-B = 1\nA-B = "n"\nB = "left of O-A"': ("B", "make no triangle", "on O-A"),
    'O-A = "sqrt(2)"\nO-B = "1"\nA-B = "sqrt(2) - 1"\nB = "left of O-A"': ("B", "flat", "on O-A"),
    'O = [0, 0]\nA = [3, 4]\nO-B = 2\nA-B = 3\nB = "left of O-A"': ("B", "flat", "on O-A"),
    "O-A = 40\nO-B = 20\nA-B = 25": ("B", "no side", '"left of O-A" or "right of O-A"'),
    'O-A = 40\nO-B = 20\nB = "left of O-A"': ("B", "not the length A-B", ""),
    'O-A = 40\nB = "left of O-A"': ("B", "not the length O-B and A-B", ""),
    'O-A = 40\nB = "on O-A"': ("B", "nothing says how far", "O-B or A-B"),
    'O-A = 40\nO-B = 3\nA-B = 37\nB = "on O-A"': ("A-B", "one measure too many", ""),
    'O-A = 40\nO-B = 50\nB = "on O-A"': ("O-B", "B is 50 from O", 'mean "beyond A on O-A"?'),
    'O-A = 40\nO-B = 30\nB = "beyond A on O-A"': ("O-B", "B is 30 from O", 'mean "on O-A"?'),
    'O-A = 40\nO-B = 30\nA-B = 30\nB = "left of O-X"': ("B", "names X, no point", ""),
    'O-A1 = 40\nO-B = 30\nA1-B = 30\nB = "left of O-A2"': ("B", "names A2", "did you mean A1?"),
    'O-A = 40\nO-B = 30\nA-B = 30\nB = "leftish of O-A"': ("B", '"leftish of O-A"', "left of"),
    'O-A = 40\nB = { from = "X", length = 3, angle = 0 }': ("B", "from names X", ""),
    'B = { from = "O", length = 3, angle = 0 }\nO-A = 3': (
        "B",
        "first key begins with",
        "of other points",
    ),
    'A = { from = "O", length = 3, angle = 0 }\nO = { from = "A", length = 3, angle = 9 }': (
        "A",
        "A, O are placed from one another, in a circle",
        "coordinates of one point, such as A = [0, 0]",
    ),
    'O = [0,0]\nA = {from = "B", length = 3, angle = 0}\nB = {from = "A", length = 3, angle = 9}': (
        "A",
        "A, B are placed from one another, in a circle",
        "coordinates of one point",
    ),
    'A = { from = "A", length = 3, angle = 0 }': ("A", "A is placed from itself", "A = [0, 0]"),
    'C = "left of O-A"\nO-A = 3\nO-C = 3\nA-C = 3': (
        "C",
        "first key begins with",
        "of other points",
    ),
    "O-A = 40\nA-O = 40": ("A-O", "the length O-A is written above", ""),
    "O-A = 40\nA-B = 3\nO-A-B = 3\nB-A-O = 3": ("B-A-O", "the angle O-A-B is written above", ""),
    "O-A = 40\nA-B = 3\nO-A-B = 3\nO-B = 3": ("O-B", "one measure too many", ""),
    "O = [0, 0]\nA = [1, 2]\nO-A = 3": ("O-A", "one measure too many", "leave it out"),
    "O-A = 40\nB-C = 3": ("", "nothing places B, C", ""),
    "O-A = 40\nO-B = 3": ("B", "one length, O-B, does not place B", 'write B = "on O-A"'),
    "O-A = 40\nO-O = 3": ("O-O", "O-O names one point twice", ""),
    "O-A = 40\nO-A-O = 3": ("O-A-O", "names one point twice", ""),
    "O-A = 40\nO-A-B-C = 3": ("O-A-B-C", "is no key of a link", ""),
    "O-A = 40\n_x = [1, 2]": ("_x", "is no key of a link", ""),
    "O-A = 40\nframe = [1, 2]": ("frame", "a point named frame", ""),
    f"O-A = 40\n{'A' * 41} = [1, 2]": ("A" * 41, "is no key of a link", ""),
    "O-A = 40\nB = [1]": ("B", "a list of 1", "[x, y]"),
    "O-A = 40\nB = 3": ("B", "3", "coordinates [x, y]"),
    "O = [0, true]": ("O[1]", "true", "a number"),
    "O-A = -4": ("O-A", "-4", "a number above 0"),
    "O-A = 0": ("O-A", "0", "a number above 0"),
    'O-A = "n - 7"': ("O-A", '"n - 7" is 0', "a number above 0"),
    'O = [0, 0]\nA = { from = "O", length = 0, angle = 0 }': ("A.length", "0", "above 0"),
    'O = [0, 0]\nA = { from = "O", length = 2 }': ("A.angle", "nothing", "a number"),
    'O-A = 3\nslide = { on = 0, through = "O" }': ("slide", "unknown table", "mean slides?"),
    "O-A = 3\nrols = [{ on = 0 }]": ("rols", "unknown table", "did you mean rolls?"),
    'O-A = 3\nwheel = { centre = "O" }': ("wheel", "no radius", "radius = …, or teeth"),
    'O-A = 3\nwheel = { centre = "O", teeth = 2.5, module = 1 }': ("wheel.teeth", "2.5", "whole"),
    'O-A = 3\nwheel = { centre = "X", radius = 2 }': ("wheel.centre", "X is no point of this", ""),
    'O-A = 3\nwheel = { centre = "O", radius = -2 }': ("wheel.radius", "-2", "above 0"),
    "O-A = 3\nwheel = 3": ("wheel", "3", "a table"),
    'O-A = 3\nwheel = { centre = "O", radius = 2, color = 1 }': ("wheel.color", "unknown key", ""),
}


@pytest.mark.parametrize("keys", BROKEN)
def test_points_that_cannot_be_placed(broken_crank: Breaker, keys: str) -> None:
    place, found, more = BROKEN[keys]
    problems = broken_crank(keys)
    assert len(problems) == 1, problems
    assert problems[0].place == f"links.crank.{place}".rstrip(".")
    assert found in problems[0].found
    assert more in str(problems[0])


def test_coincident_points_make_no_line(broken_crank: Breaker) -> None:
    (problem,) = broken_crank('O = [1, 1]\nA = [1, 1]\nO-B = 3\nB = "on O-A"')[:1]
    assert "O and A lie at one spot" in problem.found
    (problem,) = broken_crank('O = [1, 1]\nA = [1, 1]\nO-B = 3\nA-B = 3\nB = "left of O-A"')[:1]
    assert "O and A lie at one spot" in problem.found
    (problem,) = broken_crank("O = [1, 1]\nA = [1, 1]\nO-B = 3\nA-O-B = 3")[:1]
    assert "O and A lie at one spot" in problem.found


def test_a_number_that_cannot_be_read_is_told_once(broken_crank: Breaker) -> None:
    (problem,) = broken_crank('O-A = nan\nO-B = 30\nA-B = 30\nB = "left of O-A"')
    assert problem.place == "links.crank.O-A"


def test_a_point_on_the_axis_may_be_written_before_its_end(crank):
    early = crank('O-M = 1\nO-D = 2\nM = "on O-D"\nD-M-E = 90\nM-E = 3')
    late = crank('O-D = 2\nO-M = 1\nM = "on O-D"\nD-M-E = 90\nM-E = 3')
    assert early.points == late.points == ("O", "D", "M", "E")
    assert [str(each) for each in early.placings] == [str(each) for each in late.placings]


def test_a_point_beside_the_axis_must_be_written_after_its_end(broken_crank):
    for words in ("left of O-D", "beyond O on O-D"):
        said = "".join(map(str, broken_crank(f'O-M = 1\nO-D = 2\nD-M = 2\nM = "{words}"')))
        assert "write O-D above the other lengths" in said
