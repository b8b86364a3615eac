"""The command: what it says, what it refuses, and its exit status."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner, Result

from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.print_run import JOURNAL, Means, Outcome, PrintRequest, print_class
from graphkin.cli.main import app
from graphkin.reading.read_run import read_order
from graphkin.reading.read_sheet import Grid
from graphkin.text.errors import RosterError
from tests.classroom.printing.conftest import LEVER, LEVER_LAB, tree


def ran(*args: object) -> Result:
    return CliRunner().invoke(app, ["print", *map(str, args)])


def test_it_tells_how_far_it_is_and_names_the_files(make):
    folder = make("a", ["1", "2"])
    result = ran(folder, "--jobs", 1)
    assert result.exit_code == 0
    assert result.stderr.splitlines() == [f"{i} of 2 students" for i in range(3)]
    assert result.stdout.splitlines() == [
        "2 students printed",
        str(folder / "print" / "class-task.pdf"),
        str(folder / "print" / "class-key.pdf"),
    ]
    again = ran(folder, "--jobs", 1)
    assert again.stdout.splitlines()[0] == "0 students printed, 2 stood already"
    assert again.stderr.splitlines() == ["2 of 2 students"]


def test_who_gets_nothing_is_told_and_the_status_is_1(make):
    ids, names = ["7", "8"], ["Ana, Maria", "Bob"]
    folder = make("a", ids, names=names, numbers=[180, 60], scene=LEVER, lab=LEVER_LAB)
    result = ran(folder, "--jobs", 1)
    assert result.exit_code == 1
    assert "graphkin: 7 Ana, Maria: " in result.stderr
    assert "1 student printed" in result.stdout


def test_a_name_with_signs_that_the_font_lacks_is_told(make):
    """The id is called where no letter of the name is left, ? where one is."""
    result = ran(make("a", ["7", "8", "9"], names=["李 小龍", "Ana 王王", "Ana"]), "--jobs", 1)
    assert result.exit_code == 0
    lacks = "the font of the sheets lacks"
    assert f'7: {lacks} 李 小 龍 of "李 小龍, 331 A"; the id replaces the name' in result.stderr
    assert f'8: {lacks} 王 of "Ana 王王, 331 A"; ? replaces each' in result.stderr
    assert "9: " not in result.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--view", "task,keys"], "keys is none of task, key, overlay, steps"),
        (["--view", ","], "nothing is none of"),
        (["--format", "png"], "png is none of pdf, svg"),
        (["--engine", "ray://x:1"], "dask://HOST:PORT"),
        (["--jobs", "0"], "--jobs"),
        (["--lang", "xx"], "--lang"),
    ],
)
def test_words_that_are_not_understood_change_nothing(make, words, said):
    folder = make("a", ["1"])
    before = tree(folder)
    result = ran(folder, *words)
    assert result.exit_code == 2
    assert said in result.stderr
    assert tree(folder) == before


# --- sheets in the language that the class list names --------------------------------------------

IDS = ["1", "2", "=5"]
LISTED = "id,Limba\n1,Română\n2,\n'=5,klingon\n"
SPOKEN = ["ro", None, None]


def listed(make, name, text=LISTED):
    """A class whose list has a column for the language."""
    folder = make(name, IDS)
    (folder / "variants.csv").write_text(text, encoding="utf-8")
    return folder


def printed(folder, language=None, **more) -> Outcome:
    wishes = PrintRequest(("task", "key"), ("pdf", "html"), language, **more)
    return print_class(read_edition(folder), wishes, Means(1), lambda done, total: None)


def own(files, stem):
    """The files of one student."""
    return {name: data for name, data in files.items() if name.split("/")[-1].startswith(stem)}


def test_sheets_forms_and_pages_are_those_of_a_whole_class_in_that_language(make):
    """Byte for byte; who names none, or one that no page has, gets that of the class."""
    folder = listed(make, "a")
    printed(folder, "it")
    found = tree(folder / "print")
    for language in ("it", "ro"):
        plain = make(f"plain-{language}", IDS)
        printed(plain, language)
        files = tree(plain / "print")
        for id_, spoken in zip(IDS, SPOKEN, strict=True):
            if (spoken or "it") == language:
                wanted = own(files, stem := f"{id_[-1]}-")
                assert len(wanted) == 5
                assert own(found, stem) == wanted


def test_a_table_that_cannot_be_read_is_told_before_anything_is_printed(make):
    folder = listed(make, "a", 'id,Limba\n1,"it\n')
    with pytest.raises(RosterError, match=r"variants\.csv, row 2"):
        read_edition(folder)
    result = ran(folder)
    assert result.exit_code == 2
    assert "variants.csv, row 2" in result.stderr
    assert not (folder / "print").exists()


def test_who_names_a_language_that_no_page_has_is_named(make):
    folder = listed(make, "a")
    told = ran(folder, "--view", "task").stderr
    assert 'Ștefan Pop 3 (=5): "klingon" is no language of the pages' in told


# --- the language of the class ------------------------------------------------------------------


def test_the_class_keeps_the_language_that_print_was_told_first(make):
    """The next run speaks it; another one is for that run alone, unless --force makes it so."""
    folder = make("a", ["1"])
    assert "keeps --lang it" in ran(folder, "--lang", "it", "--view", "task").stdout
    plain = make("plain", ["1"])
    assert ran(plain, "--lang", "it", "--view", "task,key").exit_code == 0
    assert ran(folder, "--view", "task,key").exit_code == 0
    names = ("task/1-task.pdf", "task/1-form.pdf", "key/1-key.pdf", "class-key.pdf")
    for name in names:
        found, wanted = (each / "print" / name for each in (folder, plain))
        assert found.read_bytes() == wanted.read_bytes()
    assert "keeps --lang" not in ran(folder, "--lang", "en", "--view", "steps").stdout
    assert read_edition(folder).language == "it"
    assert "keeps --lang en" in ran(folder, "--lang", "en", "--force").stdout
    assert read_edition(folder).language == "en"


def test_a_refused_run_says_which_setting_differs(make):
    folder = make("a", ["1", "2"])
    assert ran(folder, "--lang", "en", "--view", "task").exit_code == 0
    before = tree(folder)
    told = ran(folder, "--lang", "it", "--view", "task").stderr
    assert "and 1 more: there already, printed in en, now in it (--lang); --force" in told
    told = ran(folder, "--ink", "black", "--view", "task").stderr
    assert "there already, printed with --ink colour, now black; --force" in told
    assert tree(folder) == before
    record = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    record["students"][0]["name"] = "Someone else"
    (folder / "manifest.json").write_text(json.dumps(record), encoding="utf-8")
    told = ran(folder, "--view", "task").stderr
    assert "there already, printed with other data, or another name or group; --force" in told


def test_files_of_a_journal_that_notes_no_settings_are_refused_as_before(make):
    folder = make("a", ["1"])
    assert ran(folder, "--view", "task").exit_code == 0
    path = folder / "print" / JOURNAL
    lines = [json.loads(line) for line in path.read_bytes().splitlines()]
    assert [bool(line.pop("settings", None)) for line in lines] == [True, False]
    path.write_text("".join(f"{json.dumps(line)}\n" for line in lines), encoding="utf-8")
    assert "1 stood already" in ran(folder, "--view", "task").stdout
    told = ran(folder, "--view", "task", "--ink", "black").stderr
    assert "there already, made from other data or settings; --force" in told


def test_readings_are_held_against_sheets_in_the_language_of_the_class(make):
    folder = make("a", ["1"], language="it")
    assert read_order(read_edition(folder), Grid()).order.language == "it"


def test_a_language_that_no_page_has_is_refused(make):
    result = ran(make("a", ["1"], language="xx"))
    assert result.exit_code == 2
    assert 'manifest.json: language: "xx" is no language of the pages' in result.stderr
