"""File names from hostile ids: plain letters, no two alike, none outside the folder."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphkin.classroom.printing.edition import inside, stems
from graphkin.text.errors import PageError

HOSTILE = [
    *(
        "../../x",
        "/etc/passwd",
        "C:\\Windows\\x",
        "CON",
        "con",
        "nul",
        "LPT1",
        "..",
        ".",
        "",
        "-rf",
    ),
    *("ștefan", "s\u0326tefan", "Ab", "aB", "a/b", "a\\b", "a\x00b", "a\nb", "=HYPERLINK(1)"),
    *("x" * 300, "x" * 301, "１２", "\u202egpj.exe"),
]
CODE = st.text("ABCDEFGHIJKLMNOPQRSTUVWXYZ234567", min_size=10, max_size=10)


def hold_the_laws(found: list[str]) -> None:
    assert all(re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_-]*", name, re.ASCII) for name in found)
    assert len({name.casefold() for name in found}) == len(found)
    devices = r"(?i)con|prn|aux|nul|com\d|lpt\d"
    assert not [name for name in found if re.fullmatch(devices, name)]
    assert max(map(len, found)) < 80


def test_hostile_ids_become_plain_names_inside_the_folder(tmp_path):
    hold_the_laws(stems(HOSTILE, [f"CODE{i:06d}" for i in range(len(HOSTILE))]))
    for name in HOSTILE:
        stem = stems([name], ["CODE"])[0]
        assert inside(tmp_path, f"task/{stem}-task.pdf").resolve().parent == tmp_path / "task"


@given(st.lists(st.tuples(st.text(max_size=5), CODE), min_size=1, max_size=9))
def test_no_ids_make_names_that_are_alike(students):
    hold_the_laws(stems([id_ for id_, _ in students], [code for _, code in students]))


def test_twins_by_case_both_get_their_codes_as_do_ids_of_another_alphabet():
    assert stems(["Ab", "aB"], ["XX", "YY"]) == ["Ab-xx", "aB-yy"]
    assert stems(["Щ"], ["QQ77"]) == ["id-qq77"]


def test_a_link_that_leads_out_is_refused(tmp_path: Path):
    (tmp_path / "print").mkdir()
    (tmp_path / "print" / "task").symlink_to(tmp_path, target_is_directory=True)
    with pytest.raises(PageError, match="leads to"):
        inside(tmp_path / "print", "task/0001-task.pdf")
