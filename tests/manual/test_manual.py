"""The manual is right: its examples run, its links lead somewhere, and no key is left out."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from graphkin.classroom.grading.grading_files import read_marks
from graphkin.construction.core.solution import FAIR
from graphkin.manual import pages
from graphkin.manual import site as site_module
from graphkin.manual.site import relative, site
from graphkin.scene import scene_files
from graphkin.studio.look import every_key
from tests.examples.document import (
    CONTRIBUTING,
    README,
    VERSION,
    Mistake,
    anchors,
    links,
    mistakes,
    with_part,
)
from tests.manual.kinds import KINDS
from tests.manual.made import MANUAL, PICTURES, PICTURES_OF_PAGES, made, picture
from tests.manual.made import pages as made_pages
from tests.manual.running_pages import FIRST, examples, run
from tests.running import ran

PAGES = sorted(MANUAL.rglob("*.md"))
WRITTEN = [README, CONTRIBUTING, *PAGES]
CLASS = MANUAL / "tutorials" / "my-class.md"
LONGEST = 25
"""Words of the longest sentence that a reader takes in at once."""


def named(path: Path) -> str:
    """The name of a page as the name of a test."""
    return f"{path.parent.name}/{path.stem}"


@pytest.mark.parametrize(
    "path", [each for each in PAGES if examples(each) and each != CLASS], ids=named
)
def test_the_examples_of_a_page_run(path: Path, tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.chdir(tmp_path)
    run(path)


def test_the_class_ends_as_it_is_told(tmp_path: Path, monkeypatch: Any) -> None:
    """Everything is right but the field with swapped digits, which the decision then gives."""
    monkeypatch.chdir(tmp_path)
    run(CLASS)
    row = read_marks(Path("report/marks.csv").read_bytes())["0042"]
    wrong = {head: cell for head, cell in row.items() if head.endswith(" why") and cell != "right"}
    assert set(wrong) == {"a_B_mm why"}
    reason = "74 mm on her sheet: two digits are swapped in the table"
    assert reason in wrong["a_B_mm why"]
    assert row["points"] == row["of"] == "14.5"
    assert reason in Path("report/feedback/0042.html").read_text(encoding="utf-8")
    before = Path("moodle.csv").read_text(encoding="utf-8")
    after = Path("report/gradebook-moodle.csv").read_text(encoding="utf-8")
    assert after == before.replace("Submitted for grading,,", "Submitted for grading,10,")


@pytest.mark.parametrize(
    "mistake", mistakes(MANUAL / "scene" / "mistakes.md"), ids=lambda each: str(each.number)
)
def test_a_mistake_gives_its_message(mistake: Mistake, tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.chdir(tmp_path)
    whole = next(each.text for each in examples(FIRST) if each.text.startswith(VERSION))
    Path("my.toml").write_text(with_part(whole, mistake.part), encoding="utf-8")
    result = ran("check", "my.toml")
    assert result.exit_code == 2
    told, *more = result.stderr.splitlines()
    assert told == f"graphkin: my.toml: {mistake.message}"
    assert all(line.startswith("graphkin: the manual says more: ") for line in more)


def test_the_bound_of_an_unfair_crossing_is_the_one_on_the_page() -> None:
    assert FAIR == 1e-4
    assert "below\n1e-4" in (MANUAL / "scene" / "ask.md").read_text(encoding="utf-8")


# --- pages, links, keys ---------------------------------------------------------------------------


@pytest.mark.parametrize("path", WRITTEN, ids=named)
def test_every_link_leads_to_a_file_and_a_heading(path: Path) -> None:
    led = list(links(path))
    assert [to for to, _ in led if not to.exists()] == []
    wanted = [(to, heading) for to, heading in led if heading]
    assert [(to, heading) for to, heading in wanted if heading not in anchors(to)] == []


def test_the_index_names_every_page_once() -> None:
    here = sorted(path.relative_to(MANUAL).with_suffix("").as_posix() for path in PAGES)
    assert sorted(pages.names()) == here


def test_the_readme_takes_a_screen_and_a_half() -> None:
    assert len(README.read_text(encoding="utf-8").splitlines()) <= 140


def test_every_key_that_the_reader_knows_is_explained() -> None:
    given = {"n", "O", "A", "O-B", "links"}  # names in the scene with every table; a heading
    known = {key for keys in every_key().values() for key in keys} - given
    assert sorted(known - {*pages.explained()}) == []


def test_every_key_of_a_lab_is_explained() -> None:
    """The lab to start from has every key, those that are left out in comments."""
    start = MANUAL.parent / "classroom" / "lab" / "start" / "lab.toml"
    keys = re.findall(r"^#? *([a-z]+) = ", start.read_text(encoding="utf-8"), re.MULTILINE)
    assert {"set", "draw", "apart", "hold", "cap"} <= {*keys}
    explained = {*pages.explained(), "graphkin"}
    assert sorted({*keys} - explained) == []


@pytest.mark.parametrize("path", PAGES, ids=named)
def test_no_sentence_is_longer_than_a_breath(path: Path) -> None:
    long = [said for said in sentences(path) if len(said.split()) > LONGEST]
    assert long == []


def sentences(path: Path) -> Iterator[str]:
    """The sentences of a page's paragraphs and lists; tables and code are none."""
    text = re.sub(r"<!-- made.*?<!-- end -->", "", path.read_text("utf-8"), flags=re.DOTALL)
    text = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    kept = [line for line in text.splitlines() if not line.startswith(("|", "#", "!["))]
    for paragraph in re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", "\n".join(kept)):
        yield from re.split(r"(?<=[.:;!?])\s+", " ".join(paragraph.split()))


# --- what the program writes ----------------------------------------------------------------------


@pytest.mark.parametrize("path", list(made_pages()), ids=named)
def test_what_the_program_writes_is_up_to_date(path: Path) -> None:
    said = "run python -m tests.manual"
    assert made(path) == path.read_text(encoding="utf-8"), said


def test_every_scene_and_lab_is_in_the_gallery_once() -> None:
    shown = sorted(name for members in KINDS.values() for name in members)
    assert shown == sorted({*scene_files.names(), *scene_files.examples()})
    assert {path.stem for path in PICTURES.glob("*.svg")} == {*shown, *PICTURES_OF_PAGES}


@pytest.mark.parametrize("name", ["pump", "shaper", "gears-ring"])
def test_a_picture_is_what_its_scene_gives(name: str) -> None:
    kept = (PICTURES / f"{name}.svg").read_text(encoding="utf-8")
    assert picture(name) == kept, "run python -m tests.manual"


# --- the web site and the commands ----------------------------------------------------------------


def test_every_link_of_the_site_leads_within_it() -> None:
    files = dict(site())
    marks = {
        name: {*re.findall(r'id="([^"]+)"', data.decode())}
        for name, data in files.items()
        if name.endswith(".html")
    }
    checked = 0
    for name in marks:
        for to in re.findall(r'(?:href|src)="([^":]+)"', files[name].decode()):
            path, _, mark = to.partition("#")
            file = relative("", joined(name, path)) if path else name
            assert file in files, f"{name} leads to {to}"
            assert not mark or mark in marks[file], f"{name} leads to {to}"
            checked += 1
    assert checked > 1000


def joined(page: str, to: str) -> str:
    """The file to which a relative address on a page leads."""
    parts: list[str] = page.split("/")[:-1]
    for part in to.split("/"):
        if part == "..":
            parts.pop()
        elif part != ".":
            parts.append(part)
    return "/".join(parts)


def test_the_site_loads_nothing_from_elsewhere() -> None:
    for name, data in site():
        if name.endswith((".html", ".css", ".js")):
            loaded = re.findall(r'(?:src=|@import |url\()["\']?https?:', data.decode())
            assert not loaded, name


def test_the_manual_is_written_into_a_folder(tmp_path: Path) -> None:
    result = ran("manual", "--write", tmp_path / "site")
    assert result.exit_code == 0, result.stderr
    for name, data in site():
        assert (tmp_path / "site" / name).read_bytes() == data
    assert ran("manual", "--write", tmp_path / "site").exit_code == 2


def test_help_prints_a_key_in_each_table_that_may_hold_it() -> None:
    said = ran("help", "start").stdout
    places = [line for line in said.splitlines() if line.startswith("[links.NAME], ")]
    assert places == [f"[links.NAME], {key}" for key in ("rolls", "belt", "cam")]
    assert "did you mean slides?" in ran("help", "slidse").stderr
    assert "Coriolis" in ran("help", "slides").stdout


def test_each_card_of_the_gallery_leads_to_the_page_that_moves() -> None:
    written = dict(site_module.site(site_module.moving_page))["gallery.html"].decode()
    for name in site_module.scene_texts():
        assert f'href="moving/{name}.html"' in written
    assert "moving/" not in dict(site())["gallery.html"].decode()


def test_the_manual_is_written_with_the_pages_that_move(tmp_path: Path, monkeypatch: Any) -> None:
    texts = {"slider-crank": site_module.scene_texts()["slider-crank"]}
    monkeypatch.setattr(site_module, "scene_texts", lambda: texts)
    result = ran("manual", "--write", tmp_path, "--moving")
    assert result.exit_code == 0, result.stderr
    page = (tmp_path / "moving" / "slider-crank.html").read_text(encoding="utf-8")
    assert "Slider-crank" in page
    assert ran("manual", "--moving").exit_code == 2


def test_help_explains_a_command_and_names_no_long_list() -> None:
    assert ran("help", "export").stdout.startswith("Usage: graphkin export")
    assert "graphkin variants --help" in ran("help", "variants").stdout
    assert ran("help", "zzzz").stderr.count("\n") == 2
    assert len(ran("help", "zzzz").stderr) < 120


@pytest.mark.parametrize("name", PICTURES_OF_PAGES)
def test_a_picture_of_a_page_is_what_the_page_says(name: str) -> None:
    kept = (PICTURES / f"{name}.svg").read_text(encoding="utf-8")
    assert PICTURES_OF_PAGES[name]() == kept, "run python -m tests.manual"
