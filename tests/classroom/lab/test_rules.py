"""The data of a student can be derived again by anyone, and hang on nobody else's."""

from __future__ import annotations

import hashlib
import re
import subprocess
from collections import Counter
from fractions import Fraction
from pathlib import Path

import pytest

from graphkin.classroom.lab import lab_model
from graphkin.classroom.lab.lab_model import (
    Lab,
    LabRule,
    Range,
    drawn,
    exact_text,
    picked,
    settings,
)
from graphkin.classroom.roster.students import Student
from graphkin.scene.expression import UnreadableError
from graphkin.scene.quantity import expression
from graphkin.text.errors import SceneError

PHI = Range(Fraction(20), Fraction(160), Fraction(5))
TENTHS = Range(Fraction(1, 10), Fraction(3), Fraction(1, 10))


def lab(rule: LabRule, name: str = "pump") -> Lab:
    """A lab of which only its name and rule matter."""
    return Lab(name, Path(), Path(), rule)


def ranges(**draws: Range) -> Lab:
    """A lab that draws from ranges."""
    return lab(LabRule("mechanics 2026", draws))


def by_hand(course: str, name: str, student: str, attempt: int, parameter: str) -> int:
    """The documented hash, written out without the json module."""

    def quoted(text: str) -> str:
        return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'

    words = ",".join([quoted(course), quoted(name), quoted(student), str(attempt)])
    return int(hashlib.sha256(f"[{words},{quoted(parameter)}]".encode()).hexdigest(), 16)


def test_the_hash_is_the_documented_one():
    for student in ("0042", "șțăîâ", 'a "b"', "a\\b", "x, y"):
        found = picked("mechanics 2026", "pump", student, 3, "phi")
        assert found == by_hand("mechanics 2026", "pump", student, 3, "phi")


def test_the_command_in_the_documentation_gives_the_same_hash():
    line = re.search(r"printf '%s' '(.+)' \| sha256sum", lab_model.__doc__)
    assert line
    shell = f"printf '%s' '{line[1]}' | sha256sum"
    result = subprocess.run(["sh", "-c", shell], capture_output=True, text=True, check=True)
    assert int(result.stdout.split()[0], 16) == picked("mechanics 2026", "pump", "0042", 0, "n")


def test_a_hash_of_this_year_is_that_of_any_year():
    """Reckoned with sha256sum by hand: what was handed out is never another in a later version."""
    found = settings(ranges(phi=PHI, a=TENTHS), Student(2, "0042"))
    assert found == {"phi": Fraction(125), "a": Fraction(9, 10)}


def test_course_lab_student_attempt_and_parameter_all_matter():
    """And none of them can be shifted into another."""
    same = ("course", "lab", "id", 0, "phi")
    others = [("c", *same[1:]), ("course", "l", *same[2:]), ("course", "lab", "i", 0, "phi")]
    others += [("course", "lab", "id", 1, "phi"), ("course", "lab", "id", 0, "psi")]
    others += [("a", "b", "c", 0, "d"), ("a,b", "c", "", 0, "d"), ("a\nb", "c", "d", 0, "e")]
    assert len({picked(*which) for which in [same, *others, ("a", "b\nc", "d", 0, "e")]}) == 10


def test_every_value_of_a_range_is_drawn_about_as_often():
    counts = Counter(drawn(PHI, "c", "l", str(i), 0, "phi") for i in range(29_00))
    assert set(counts) == {PHI.value(i) for i in range(29)}
    chi = sum((count - 100) ** 2 / 100 for count in counts.values())
    assert chi < 62.4  # 28 degrees of freedom, one in 5000 by chance; the ids are fixed


def test_a_formula_is_exact():
    rule = LabRule(settings={"n": expression("number/3 + 0.1"), "m": expression("30")})
    assert settings(lab(rule), Student(2, "x", 7)) == {
        "n": Fraction(7, 3) + Fraction(1, 10),
        "m": Fraction(30),
    }


def test_a_rest_goes_round_from_zero_and_binds_as_a_product():
    rule = LabRule(settings={"n": expression("2 + 7*number mod 30", counting=True)})
    found = [settings(lab(rule), Student(2, "x", k))["n"] for k in (1, 4, 5, 34)]
    assert found == [9, 30, 7, 30]
    assert expression("-7 mod 3", counting=True).number({}) == 2
    assert expression("5/2 mod 1", counting=True).number({}) == Fraction(1, 2)


def test_a_scene_has_no_rests():
    with pytest.raises(UnreadableError, match="mod"):
        expression("n mod 5")


def test_formulas_and_ranges_give_each_their_own_parameters():
    mixed = LabRule("M", {"phi": PHI}, settings={"n": expression("3*number mod 5", counting=True)})
    alone = LabRule("M", {"phi": PHI})
    one, two = Student(2, "x", 2), Student(3, "y", 9)
    assert mixed.counts
    assert not alone.counts
    for student, n in ((one, 1), (two, 2)):
        assert settings(lab(mixed), student) == {"n": n, **settings(lab(alone), student)}
    with pytest.raises(SceneError, match="has no number"):
        settings(lab(mixed), Student(2, "x"))
    constant = LabRule("M", {"phi": PHI}, settings={"n": expression("4")})
    assert settings(lab(constant), Student(2, "x"))["n"] == 4


@pytest.mark.parametrize(
    ("text", "number", "said"),
    [
        ("sqrt(number)", None, "has no number"),
        ("sqrt(number)", 2, "not rational"),
        ("1/(number - 2)", 2, "division"),
        ("number mod 0", 2, "division by zero"),
        ("sqrt(number) mod 3", 2, "not rational"),
    ],
)
def test_a_formula_without_a_number_or_without_a_rational_value_is_told(text, number, said):
    rule = LabRule(settings={"n": expression(text, counting=True)})
    with pytest.raises(SceneError, match=said):
        settings(lab(rule), Student(2, "x", number))


def test_exact_text_is_as_one_would_write_it():
    for text in ("44", "0.25", "1/3", "-5", "0"):
        assert exact_text(Fraction(text)) == text
