"""The manifest of a class folder: read whole, held against its lab, every mistake told."""

from __future__ import annotations

import json
import os

import pytest

from graphkin.classroom.printing.edition import read_edition
from graphkin.text.errors import SceneError


def change(folder, **changes):
    """Write the manifest with some of its tables otherwise."""
    path = folder / "manifest.json"
    raw = json.loads(path.read_text(encoding="utf-8")) | changes
    path.write_text(json.dumps(raw), encoding="utf-8")


def told(folder):
    """What is wrong with a folder, one line each."""
    with pytest.raises(SceneError) as refused:
        read_edition(folder)
    return [str(problem) for problem in refused.value.problems]


def test_students_come_in_roster_order_with_their_data_as_text(make):
    edition = read_edition(make("a", ["0002", "0001"]))
    assert [each.student.id for each in edition.takers] == ["0002", "0001"]
    assert edition.takers[0].settings == {"n": "1"}
    assert edition.takers[0].student.group == "331 A"
    assert edition.takers[1].compute == ("v_B_mm", "v_B")
    assert edition.lab.name == "slider"
    assert edition.lab.rubric.points["v_B_mm"] == 2


def test_the_format_is_written_and_another_is_refused(make):
    """Folders of years ago are of format 1, and are read."""
    folder = make("a", ["1"])
    assert json.loads((folder / "manifest.json").read_text(encoding="utf-8"))["format"] == 1
    change(folder, format=2)
    (line,) = told(folder)
    assert line.startswith(str(folder / "manifest.json")) and "expected format 1" in line


def test_a_lab_that_was_changed_since_or_is_missing_is_refused_file_by_file(make):
    folder = make("a", ["1"])
    for name in ("scene.toml", "lab.toml"):
        with (folder / "lab" / name).open("a", encoding="utf-8") as stream:
            stream.write("# a remark\n")
    for name, line in zip(("scene.toml", "lab.toml"), told(folder), strict=True):
        assert name in line and "changed since" in line
        (folder / "lab" / name).unlink()
    assert len(told(folder)) == 2


def test_a_folder_without_a_manifest_says_how_to_make_one(tmp_path):
    (line,) = told(tmp_path)
    assert "graphkin variants" in line
    assert "manifest.json" in line


def test_what_is_no_manifest_is_refused(make):
    folder = make("a", ["1"])
    for text in ("", "{", "[1]", '{"students": 3}', "\x00", "[" * 100_000):
        (folder / "manifest.json").write_text(text, encoding="utf-8")
        assert len(told(folder)) == 1
    nobody = make("b", ["1"])
    change(nobody, students=[])
    (line,) = told(nobody)
    assert "has no student" in line


def test_every_student_who_is_wrong_is_told(make):
    folder = make("a", ["1"])
    right = {"id": "1", "code": "AAAA", "parameters": {"n": "1"}}
    changes = [
        {"id": 7},
        {"code": ""},
        {"parameters": {"n": 1}},
        {"compute": "v_B"},
        {"name": None},
    ]
    wrong = [3, *(right | change for change in changes)]
    change(folder, students=[*wrong, right])
    lines = told(folder)
    assert len(lines) == len(wrong)
    keys = ["table", *(next(iter(each)) for each in changes)]
    for place, (line, key) in enumerate(zip(lines, keys, strict=True), 1):
        assert f"student {place}:" in line and key in line


def test_students_with_the_same_id_or_code_are_refused(make):
    folder = make("a", ["1"])
    right = {"id": "1", "code": "AAAA", "parameters": {"n": "1"}}
    change(folder, students=[right, right, right | {"id": "2"}])
    lines = told(folder)
    assert any('2 students have the id "1"' in line for line in lines)
    assert any('3 students have the code "AAAA"' in line for line in lines)
    assert all(line.startswith("manifest.json: ") for line in lines if " students have " in line)


@pytest.mark.parametrize("name", ["manifest.json", "lab/scene.toml"])
@pytest.mark.parametrize("kind", ["large", "pipe"])
def test_a_file_of_a_class_that_is_too_large_or_a_pipe_is_refused(make, name, kind):
    folder = make("class", ["0001"])
    path = folder / name
    path.unlink()
    if kind == "pipe":
        os.mkfifo(path)
    else:
        path.touch()
        os.truncate(path, (64 << 20) + 1)
    said = "larger than 64 MiB" if kind == "large" else "a pipe or a device is no file"
    with pytest.raises(SceneError, match=said):
        read_edition(folder)
