"""Hostile files end in one clear error, soon, and never in a traceback."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from graphkin.scene import scene_files
from graphkin.scene.file_limits import NUMBER, PARTS, PLAIN, VALUE
from graphkin.scene.read_scene import read_scene, read_text
from graphkin.text.errors import MORE, Problem, SceneError

OTHER_LETTER = (
    "“{letter}” ({code}) is no letter of a name: these are A to Z and a to z without accents"
)

HEAD = 'graphkin = 1\nunits = { length = "m", angle = "deg", speed = "rad/s" }\n'
DRIVER = "[[drivers]]\nturn = 1\nangle = 0\nspeed = 1\n"


def problems_of(text: str) -> tuple[Problem, ...]:
    with pytest.raises(SceneError) as caught:
        read_text(text, "hostile")
    return caught.value.problems


def first_problem(text: str) -> Problem:
    return problems_of(text)[0]


BOMBS = {
    "nested lists": ("x = " + "[" * 1500, "nested too deeply"),
    "nested tables": ("x = " + "{a=" * 1200, "nested too deeply"),
    "long line": ("x = " + "1" * 5000, "a line of 5004 characters"),
    "dotted key": ("a" + ".a" * 1900 + " = 1", "a key of very many parts"),
    "dotted table": ("[a" + ".a" * 1900 + "]", "a key of very many parts"),
    "quoted dotted key": ('"a"' + ' . "a"' * 600 + " = 1", "a key of very many parts"),
    "large": ("# " + "x" * 100 + "\n") * 3000,
    "broken date": ("x = 2024-02-30", "not TOML: invalid date"),
    "unclosed": ('x = "', "not TOML"),
    "control character": ("x = '\x00'", "not TOML"),
    "surrogate": ('x = "\\ud800"', "not TOML"),
    "key of a value": ("x = 1\nx.y = 2", "not TOML: cannot overwrite a value"),
    "too many links": (
        HEAD + "".join(f"[links.{i}]\n" for i in range(1, 502)) + DRIVER,
        "501 links",
    ),
    "a million keys": ("".join(f"k{i} = {i}\n" for i in range(15000)), "the version of the format"),
}


@pytest.mark.parametrize("name", BOMBS)
def test_bombs_do_not_go_off(name: str) -> None:
    bomb = BOMBS[name]
    text, found = bomb if isinstance(bomb, tuple) else (bomb, "too large")
    assert found in first_problem(text).found


def test_syntax_errors_name_their_line() -> None:
    assert first_problem("graphkin = 1\n\nlinks = [").place == "line 3"


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("angle = 30*k", 'put the expression in quotes: "30*k"'),
        ("angle = sqrt(2) # a root", 'put the expression in quotes: "sqrt(2)"'),
        ("angle = -n", 'put the expression in quotes: "-n"'),
        ("O1 = [0, 3*n]", 'put the expression in quotes: "3*n"'),
        ("O1 = { from = 0, length = 3*n }", 'put the expression in quotes: "3*n"'),
        ("title = Pump", 'put the text in quotes: "Pump"'),
        ("length = 70 mm", "the unit is stated once in units: write 70"),
        ("angle = 30°", "the unit is stated once in units: write 30"),
        ("angle = “30*k”", 'use straight quotes: "'),
        ("angle = „30*k“", 'use straight quotes: "'),
        ("length = 37,5", "numbers are written with a point: 37.5"),
        ("length = 012", "write the number without a leading zero: 12"),
        ("length = 1 2", PARTS),
        ("length = ", f"the value is missing: {VALUE}"),
        ("length = .5", "a point has digits on both sides: 40.0, 0.5"),
        ("length = 5.", "a point has digits on both sides: 40.0, 0.5"),
        ("pin = True", "write true"),
        ("length = 5 // long", "a comment begins with #"),
        ("length 5", "write = between a key and its value"),
        ('title = "Pump', "put its quote at its end"),
        ("speed = fast", NUMBER),
        ("slides = { on = 0, angle = n }", NUMBER),
        ("O2-B = long", NUMBER),
        ("n = { value = seven }", PLAIN),
        ("2 = arm", 'put the text in quotes: "arm"'),
        ("Ă-B = 1", OTHER_LETTER.format(letter="Ă", code="U+0102")),
        ("A-\N{CYRILLIC CAPITAL LETTER VE} = 1", OTHER_LETTER.format(letter="В", code="U+0412")),
        ("[links.ă]", OTHER_LETTER.format(letter="ă", code="U+0103")),
        ("slides = { ön = 0 }", OTHER_LETTER.format(letter="ö", code="U+00F6")),
        ("title = Ștanță", 'put the text in quotes: "Ștanță"'),
        ("[[drivers]", "a heading ends as it begins: [links.2], [[drivers]]"),
        ("length = { a = 1", "the table { } is not closed: } or a comma is missing"),
        ("length = 3*n # a student’s", 'put the expression in quotes: "3*n"'),
    ],
)
def test_syntax_errors_say_how_to_write_it(line: str, hint: str) -> None:
    wrong = first_problem(f"graphkin = 1\n{line}\n")
    assert wrong.place == "line 2"
    assert wrong.found.startswith("not TOML: ")
    assert str(wrong.hint) == hint


@pytest.mark.parametrize("line", ['title = "Pump', "title = 'Pump", 'title = """Pump', 'a = ["b]'])
def test_a_quote_that_is_not_closed_is_told(line: str) -> None:
    wrong = first_problem(f"graphkin = 1\n{line}\n")
    assert wrong.found == "not TOML: the quote of this text is not closed"
    assert str(wrong.hint) == "put its quote at its end"


PUMP = Path(scene_files.find("pump")).read_text(encoding="utf-8")
LINES = PUMP.splitlines()
KEYS = [number for number, line in enumerate(LINES) if re.match(r"[\w-]+ = ", line)]
HEADINGS = [number for number, line in enumerate(LINES) if re.match(r"\[\w", line)]


@pytest.mark.parametrize("number", KEYS, ids=lambda number: LINES[number])
def test_a_key_that_stands_twice_is_told_with_both_lines_and_what_else_is_wrong(
    number: int,
) -> None:
    """Its first value is read: no other problem comes of the second, and others are told too."""
    twice = "\n".join([*LINES[: number + 1], LINES[number], *LINES[number + 1 :], "[colours]"])
    key = LINES[number].partition(" ")[0]
    wrong, other = problems_of(twice)
    assert (wrong.place, other.place) == (f"line {number + 2}", "colours")
    assert re.fullmatch(
        rf"([\w\[\].]+\.)?{key} is written twice, first in line {number + 1}", wrong.found
    )


@pytest.mark.parametrize("number", HEADINGS, ids=lambda number: LINES[number])
def test_a_table_may_be_told_under_two_headings_to_read_it_whole(number: int) -> None:
    """A heading again before the table's last line: all its keys are read, as is the rest."""
    end = next((n for n in range(number + 1, len(LINES)) if LINES[n][:1] in "["), len(LINES)) - 1
    text = "\n".join([*LINES[:end], LINES[number], *LINES[end:]])
    (wrong,) = problems_of(text)
    assert str(wrong) == (
        f"line {end + 1}: {LINES[number].split(']')[0][1:]} is written twice, first in line "
        f"{number + 1}; expected one heading of a table; write all of it under the first"
    )


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("a = { b = 1, b = 2 }\n", ["line 1"]),
        ("a = { b = 1 }\na = { b = 2 }\n[a.b]\n", ["line 2", "line 3"]),
        ("[[a]]\n[a]\n[a.b]\nc = 1\n[[a]]\nc = 1\nc = 1\n", ["line 2", "line 7"]),
        ("a.b = 1\n[a]\nb = 2\n[[a]]\n", ["line 2", "line 3", "line 4"]),
        ("a = 1\na = 2\n\nb = \na = 3\n", ["line 2", "line 4"]),
        ("a = 1\na = 2\nb = " + "[" * 1500, ["line 2", ""]),
    ],
)
def test_what_stands_twice_is_told_with_what_is_no_toml_after_it(
    text: str, places: list[str]
) -> None:
    found = [problem.place for problem in problems_of(text)]
    assert found[: len(places)] == places
    assert not any(place.startswith("line") for place in found[len(places) :])


LONG_TABLES = {
    "unknown keys": "".join(f"k{i} = {i}\n" for i in range(15000)),
    "parameters": "[parameters]\n" + "".join(f'p{i} = "sqrt(2)"\n' for i in range(105)),
    "divisions": "[parameters]\n" + "".join(f'p{i} = "1/0"\n' for i in range(105)),
    "ranges": "[parameters]\n" + "".join(f"p{i} = {{ value = 3, max = 2 }}\n" for i in range(105)),
    "lengths": f"{HEAD}[links.1]\n" + "".join(f'O-A{i} = "1/0"\n' for i in range(105)),
}


@pytest.mark.parametrize("name", LONG_TABLES)
def test_very_many_problems_are_cut_short(name: str) -> None:
    with pytest.raises(SceneError) as caught:
        read_text(LONG_TABLES[name], "hostile")
    problems = caught.value.problems
    assert len(problems) == 101
    assert len(set(problems)) == 101
    assert "more problems" in str(problems[-1])


@pytest.mark.parametrize(("found", "told"), [(100, 100), (101, 101), (5000, 101)])
def test_an_error_carries_a_hundred_problems_and_says_that_there_are_more(
    found: int, told: int
) -> None:
    error = SceneError(Problem(f"place {i}", "wrong") for i in range(found))
    again = SceneError(error.problems)
    assert len(error.problems) == told
    assert again.problems == error.problems
    assert (error.problems[-1] == MORE) == (found > 100)


@pytest.fixture
def written(tmp_path: Path) -> Callable[[bytes], Path]:
    def write(data: bytes) -> Path:
        path = tmp_path / "scene.toml"
        path.write_bytes(data)
        return path

    return write


def test_a_byte_order_mark_is_passed_over(written: Callable[[bytes], Path], data: Path) -> None:
    path = written(b"\xef\xbb\xbf" + (data / "pump.toml").read_bytes())
    assert read_scene(path).title == "Pump mechanism"
    assert read_scene(path).name == path.parent.name
    assert read_scene(path).source == str(path)


@pytest.mark.parametrize(
    ("data", "found"),
    [
        (b'graphkin = 1\ntitle = "\xff"', "the byte 0xff is not UTF-8"),
        (b"\xff\xfe" + "graphkin = 1".encode("utf-16-le"), "is UTF-16"),
        (b"\xfe\xff" + "graphkin = 1".encode("utf-16-be"), "is UTF-16"),
        (b"\x00" * 300_000, "the file is too large"),
        (b"\x00", "not TOML"),
    ],
)
def test_bytes_that_are_no_text(written: Callable[[bytes], Path], data: bytes, found: str) -> None:
    with pytest.raises(SceneError, match=found):
        read_scene(written(data))


def test_files_that_cannot_be_opened(tmp_path: Path) -> None:
    for path in (tmp_path / "missing.toml", tmp_path, tmp_path / "a\x00b", Path(os.devnull)):
        with pytest.raises(SceneError, match="the scene cannot be read"):
            read_scene(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes in folders there")
def test_a_pipe_is_no_scene_and_nobody_waits_for_it(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "scene.toml")
    with pytest.raises(SceneError, match="a pipe or a device is no file"):
        read_scene(tmp_path / "scene.toml")
