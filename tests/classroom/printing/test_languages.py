"""Each student's sheets in the language that the class list names; the others in the class's."""

from __future__ import annotations

import pytest
from click.testing import CliRunner

from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.print_run import Means, Outcome, PrintRequest, print_class
from graphkin.cli.main import app
from graphkin.text.errors import RosterError
from tests.classroom.printing.conftest import tree

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
    result = CliRunner().invoke(app, ["print", str(folder)])
    assert result.exit_code == 2
    assert "variants.csv, row 2" in result.stderr
    assert not (folder / "print").exists()
