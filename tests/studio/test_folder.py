"""Nothing outside the folder is read or written, by whatever name; nothing there is lost."""

from __future__ import annotations

import os
from pathlib import Path
from unicodedata import normalize

import pytest

from graphkin.scene.read_scene import read_text
from graphkin.studio import session as desk
from graphkin.studio.folder import Folder
from graphkin.studio.session import Session, WantedSheets, lab_of, save_files, save_scene, sheets_of
from graphkin.text.errors import PageError, SceneError
from tests.studio.pump import PUMP, desk_in, ordered

SCENES = Path(__file__).resolve().parents[2] / "examples" / "scenes"


@pytest.fixture
def place(tmp_path) -> Path:
    """A folder with scenes, and a secret beside it."""
    here = tmp_path / "here"
    (here / "lab").mkdir(parents=True)
    (here / "one.toml").write_text(PUMP, encoding="utf-8")
    (here / "lab" / "scene.toml").write_text(PUMP, encoding="utf-8")
    (here / "lab" / "lab.toml").write_text("", encoding="utf-8")
    (here / "pyproject.toml").write_text("", encoding="utf-8")
    (tmp_path / "secret.toml").write_text("secret", encoding="utf-8")
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside" / "scene.toml").write_text("secret", encoding="utf-8")
    (here / "link.toml").symlink_to(tmp_path / "secret.toml")
    (here / "linked").symlink_to(tmp_path / "outside")
    (here / "within.toml").symlink_to(here / "one.toml")
    return here


OUTSIDE = [
    "../secret.toml",
    "lab/../../secret.toml",
    "/etc/passwd.toml",
    "C:/secret.toml",
    "C:secret.toml",
    "..\\secret.toml",
    "\\\\host\\share\\x.toml",
    "link.toml",
    "linked/scene.toml",
    "linked/new.toml",
    "./../secret.toml",
    "lab/./../../secret.toml",
    ".hidden.toml",
    "lab/.git/config.toml",
    "",
    ".toml",
    "..",
    "lab",
    "one.txt",
    "one.toml/",
    "//one.toml",
    "one.toml\x00.toml",
    "a\nb.toml",
    "con.toml",
    "lab/NUL.x.toml",
    "trailing /x.toml",
    "a" * 300 + ".toml",
    "a/" * 20 + "b.toml",
    "one.toml:stream.toml",
    "a*.toml",
    "\u202ex.toml",
    "a\u200bb.toml",
    "a\u2028b.toml",
]


@pytest.mark.parametrize("name", OUTSIDE)
def test_no_name_leads_out_of_the_folder(place, name):
    folder = Folder(place)
    before = {path: path.read_bytes() for path in place.parent.rglob("*") if path.is_file()}
    with pytest.raises(SceneError):
        folder.read(name)
    with pytest.raises(SceneError):
        save_scene(folder, name, "x", "", replace=True)
    assert before == {p: p.read_bytes() for p in place.parent.rglob("*") if p.is_file()}


def test_scenes_are_listed_and_other_files_are_not(place):
    assert Folder(place).scenes() == ["lab/scene.toml", "one.toml", "within.toml"]


@pytest.mark.parametrize("first", ["NFC", "NFD"])
def test_a_name_has_one_file_however_its_accents_are_written(place, first):
    """A Mac writes them apart from their letters."""
    name = normalize(first, "méca.toml")
    (place / name).write_text("first", encoding="utf-8")
    folder = Folder(place)
    for form in ("NFC", "NFD"):
        other = normalize(form, name)
        assert folder.read(other) == "first"
        assert save_scene(folder, other, "second", "", replace=False).exist == (name,)
    save_scene(folder, normalize("NFD", "né.toml"), "new", "", replace=False)
    assert (place / normalize("NFC", "né.toml")).read_text(encoding="utf-8") == "new"


def test_a_pipe_is_no_scene(place):
    os.mkfifo(place / "pipe.toml")
    assert "pipe.toml" not in Folder(place).scenes()
    with pytest.raises(SceneError):
        Folder(place).read("pipe.toml")
    assert save_scene(Folder(place), "pipe.toml", "x", "", replace=False).exist == ("pipe.toml",)


def test_a_file_that_is_there_is_not_replaced_without_asking(place):
    folder = Folder(place)
    saved = save_scene(folder, "one.toml", "mine", "", replace=False)
    assert (saved.files, saved.exist) == ((), ("one.toml",))
    assert folder.read("one.toml") == PUMP
    saved = save_scene(folder, "one.toml", "mine", "", replace=True)
    assert saved.files == ("one.toml",)
    assert folder.read("one.toml") == "mine"


def test_what_this_page_has_saved_it_saves_again_until_somebody_else_changes_it(place):
    folder = Folder(place)
    mark = save_scene(folder, "new.toml", "one", "", replace=False).mark
    mark = save_scene(folder, "new.toml", "two", mark, replace=False).mark
    assert folder.read("new.toml") == "two"
    (place / "new.toml").write_text("theirs", encoding="utf-8")
    assert save_scene(folder, "new.toml", "three", mark, replace=False).exist == ("new.toml",)
    assert folder.read("new.toml") == "theirs"


def test_a_link_that_is_replaced_leaves_what_it_led_to(place):
    save_scene(Folder(place), "within.toml", "mine", "", replace=True)
    assert (place / "one.toml").read_text(encoding="utf-8") == PUMP
    assert not (place / "within.toml").is_symlink()


def test_sheets_are_written_all_or_none(place):
    folder = Folder(place)
    files = {"a.svg": b"a", "b.svg": b"b"}
    (place / "b.svg").write_bytes(b"old")
    assert save_files(folder, files, replace=False).exist == ("b.svg",)
    assert not (place / "a.svg").exists()
    (place / "c.svg").mkdir()
    with pytest.raises(PageError, match="is a folder"):
        save_files(folder, {**files, "c.svg": b"c"}, replace=True)
    assert (place / "b.svg").read_bytes() == b"old"
    assert save_files(folder, files, replace=True).files == ("a.svg", "b.svg")


def test_sheets_are_named_as_the_command_names_them(place):
    wanted = WantedSheets(PUMP, "lab/one.toml", {"n": "9"}, "en", "key", ("svg", "html"))
    names = ["one-n9-key.html", "one-n9-velocity-key.svg", "one-n9-acceleration-key.svg"]
    assert list(sheets_of(Folder(place), wanted)) == names


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("pump2", "pump2.toml"),
        ("../evil.toml", "evil.toml"),
        ("..\\evil", "evil.toml"),
        ("a b*.toml", "pump.toml"),
        ("", "pump.toml"),
    ],
)
def test_a_name_that_is_refused_is_answered_with_one_that_would_do(place, name, meant):
    with pytest.raises(SceneError, match=f"ending in .toml, such as {meant}$"):
        Folder(place).path(name)
    assert Folder(place).path(meant)


def test_a_text_is_saved_whatever_is_wrong_with_it_and_while_something_is_drawn(place):
    session = desk_in(place)
    bad = PUMP.replace("A-B = 40", "A-B = ")
    with session.drawing():
        assert session.save(ordered(text=bad, name="bad.toml"))["files"] == ("bad.toml",)
    assert (place / "bad.toml").read_text(encoding="utf-8") == bad


@pytest.mark.parametrize("name", ["lab/lab.toml", "lab.toml", "pyproject.toml"])
def test_files_that_are_no_scenes_are_neither_read_nor_replaced(place, name):
    folder = Folder(place)
    with pytest.raises(SceneError, match=r"is no scene; expected .* such as pump\.toml"):
        folder.read(name)
    with pytest.raises(SceneError, match="is no scene"):
        save_scene(folder, name, "mine", "", replace=True)
    assert (place / "lab" / "lab.toml").read_text(encoding="utf-8") == ""


def test_a_scene_is_saved_where_it_was_opened_until_somebody_else_changes_it(place):
    session = desk_in(place)
    opened = session.open("one.toml", "scene")
    ours = PUMP.replace("A-B = 40", "A-B = 41")
    assert session.save(ordered(text=ours, name="one.toml", mark=opened.mark))["files"]
    theirs = PUMP.replace("C-D = 20", "C-D = 21")
    (place / "one.toml").write_text(theirs, encoding="utf-8")
    found = session.save(ordered(text=ours, name="one.toml", mark=opened.mark))
    assert found["exist"] == ("one.toml",)
    changed = [line for line in found["changes"] if line[0] in "-+"]
    assert changed == ["-A-B = 40", "+A-B = 41", "-C-D = 21", "+C-D = 20"]
    assert (place / "one.toml").read_text(encoding="utf-8") == theirs


def test_values_that_cannot_be_written_are_told(place):
    found = desk_in(place).write(ordered(settings={"n": "seven"}))
    assert not found["edits"]
    assert found["problems"][0]["setting"] == "n"


def test_the_form_is_that_of_the_scene_s_own_lab(place):
    folder = Folder(place)
    assert lab_of(folder, "lab/scene.toml", "any") == str(folder.root / "lab")
    assert lab_of(folder, "pump.toml", PUMP) == "pump"
    assert lab_of(folder, "pump.toml", PUMP + "\n") == "pump.toml"


def test_the_page_is_told_why_nothing_was_written(place):
    session = desk_in(place)
    found = session.save(ordered(name="link.toml", replace=True))
    assert not found["files"]
    assert "leads out" in found["problems"][0]["found"]
    broken = ordered(text="graphkin = 1", name="x.toml", view="key", formats=["svg"])
    assert session.sheets(broken)["problems"]
    assert sorted(path.suffix for path in place.iterdir()) == ["", "", *[".toml"] * 4]


def test_a_scene_outside_the_folder_is_not_opened(place, monkeypatch):
    monkeypatch.chdir(place)
    session = desk_in(place)
    assert session.address_of("") == {}
    assert session.address_of("pump") == {"lab": "pump", "rules": "yes"}
    assert session.address_of("one.toml") == {"scene": "one.toml"}
    assert session.address_of("lab") == {"scene": "lab/scene.toml", "rules": "yes"}
    for name in ("../secret.toml", str(place.parent / "secret.toml"), "link.toml"):
        with pytest.raises(SceneError, match="lies outside this folder"):
            session.address_of(name)


def test_what_is_opened_is_what_was_named(place):
    session = desk_in(place)
    assert session.open("one.toml", "scene").text == PUMP
    assert session.open("pump", "lab").text == PUMP
    assert session.open("pump", "lab").name == "pump.toml"
    read_text(session.open("", "").text, "new")
    assert session.open("none.toml", "scene").gone
    for kind in ("scene", "like", "lab", "example"):
        for name in ("none", "../pump", "../secret.toml", "..", "/etc/passwd", "link.toml"):
            with pytest.raises(SceneError):
                session.open(name, kind)


def test_one_like_a_scene_has_its_text_and_another_name(place):
    session = desk_in(place)
    (place / "one-2.toml").write_text("", encoding="utf-8")
    opened = session.open("one.toml", "like")
    assert (opened.name, opened.text, opened.mark) == ("one-3.toml", PUMP, "")
    assert session.open("lab/scene.toml", "like").name == "lab-2.toml"


@pytest.mark.parametrize("language", ["en", "ro", "it"])
def test_scenes_that_are_too_many_to_be_listed_are_counted(tmp_path, monkeypatch, language):
    for name in "abc":
        (tmp_path / f"{name}.toml").touch()
    session = Session(Folder(tmp_path))
    assert session.listed(language)["more"] == ""
    monkeypatch.setattr(desk, "MOST", 2)
    listed = session.listed(language)
    assert listed["scenes"] == ["a.toml", "b.toml"]
    assert "1" in listed["more"]


def test_every_scene_that_comes_with_it_is_listed_with_its_title_and_opened(place):
    session = desk_in(place)
    listed = dict(session.listed("it")["examples"])
    assert len(listed) > 60
    assert listed["lifter"] == "Meccanismo di sollevamento"
    for name in listed:
        assert session.open(name, "example").text == (SCENES / f"{name}.toml").read_text("utf-8")
