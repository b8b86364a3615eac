"""The scripts of pages: short files, each put into a page, that do not take each other's names."""

from __future__ import annotations

import re
from itertools import chain

import pytest

from graphkin.web import offline_page
from graphkin.web.offline_page import (
    BOARD_PAGE,
    FORM,
    MOVING,
    PLAYER,
    STEP_PAGE,
    WEB,
    joined,
    part,
    tight,
    together,
)

PAGES = (STEP_PAGE, BOARD_PAGE, PLAYER, FORM, MOVING)
DECLARED = re.compile(
    r"^(?:async )?(?:function|const|let|class) +([\w$]+|\{[^}]*\}|\[[^\]]*\])", re.M
)
MORE = re.compile(r"(?:^const|^let|,) ([\w$]+) = ", re.M)
LONGEST = 300
"""Most lines of a file."""


def names(name: str) -> list[str]:
    """What a file declares for those after it, with all that one line declares."""
    text = part(name)
    found = list(chain.from_iterable(re.findall(r"[\w$]+", one) for one in DECLARED.findall(text)))
    lines = [line for line in text.splitlines() if line.startswith(("const ", "let "))]
    return sorted({*found, *chain.from_iterable(map(MORE.findall, lines))})


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page[0])
def test_no_two_files_of_a_script_declare_the_same_name(page):
    declared = [name for file in page for name in names(file)]
    assert declared
    assert not {name for name in declared if declared.count(name) > 1}


def test_every_file_is_put_into_a_page():
    assert {path.name for path in WEB.glob("*.js")} == set(chain.from_iterable(PAGES))


def test_files_are_short_and_say_first_what_they_hold():
    for path in WEB.glob("*.js"):
        lines = path.read_text(encoding="utf-8").splitlines()
        assert len(lines) <= LONGEST, path.name
        assert lines[0].startswith("// "), path.name


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page[0])
def test_remarks_are_left_out_and_nothing_else(page):
    told = joined(page).splitlines()
    lines = [line.strip() for name in page for line in part(name).splitlines()]
    short_lines = [offline_page.REMARK.sub("", line) for line in lines]
    script = "\n".join(short_lines)
    for place, what in offline_page.written_in(page).items():
        script = script.replace(place, what)
    written = script.splitlines()
    assert [line for line in written if line in set(told)] == told
    for line, short in zip(lines, short_lines, strict=True):
        assert line == short or line.removeprefix(short).lstrip().startswith("// ")
        assert short.count('"') == line.count('"'), line
    assert all(
        not line or line.startswith(offline_page.REMARKS) for line in set(written) - set(told)
    )
    assert together(page) == f'(() => {{\n"use strict";\n{tight(joined(page))}\n}})();'


def test_blanks_go_only_where_no_text_is():
    """Without any blank a script and its tight form are one; lines with a text stay as they are."""
    script = joined(STEP_PAGE)
    lines = zip(script.split("\n"), tight(script).split("\n"), strict=True)
    for whole, short in lines:
        assert whole.replace(" ", "") == short.replace(" ", "")
        assert whole == short or not set(whole) & set("\"'`/\\")
    assert tight("return a - -b + +c") == "return a - -b + +c"
    assert len(tight(script)) < 0.97 * len(script)
