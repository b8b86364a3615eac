"""The form of a lab in a real browser: what is filled in, saved and handed in is marked in full."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from math import isnan
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from markupsafe import Markup

from graphkin.classroom.form_page import Identity, form_fragment
from graphkin.classroom.grading.answer_numbers import read_answer
from graphkin.classroom.lab.lab_model import Item
from graphkin.classroom.printing.edition import read_edition
from graphkin.cli.main import app
from graphkin.text import words
from graphkin.web.offline_page import offline_page
from tests.browser.opening import Opened
from tests.classroom.grading.students import book_of
from tests.running import Run

ROSTER = 'Nr.;Matricol;Nume;Grupa\n7;0042;Ștefănescu Ana;A\n9;0043;"O\'Neil, Jr. Pat";A\n'
FIELD = "#answer-{}"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A class folder of two students with their task pages."""
    return class_folder("slotted-lever", tmp_path_factory.mktemp("form"))


def class_folder(name: str, place: Path) -> Path:
    """A class folder made as a lecturer makes it."""
    (place / "class.csv").write_text(ROSTER, encoding="utf-8")
    made = place / name
    for args in (
        ("variants", name, place / "class.csv", "-o", made),
        ("print", made, "--view", "task", "--format", "html", "--lang", "ro", "--jobs", "1"),
    ):
        result = CliRunner().invoke(app, [str(arg) for arg in args])
        assert result.exit_code == 0, result.output
    return made


FIELDS = "form.answers [name]:not([type=hidden])"
"""The fields that a student fills in."""


def page_of(folder: Path, who: str = "0042") -> Path:
    """The page of a student."""
    return folder / "print" / "task" / f"{who}-task.html"


def key_of(folder: Path) -> Mapping[str, float]:
    """The right values of the first student, by field."""
    data = read_edition(folder).takers[0].settings
    return book_of(folder.name).marker(data).standard.key


def written(value: float) -> str:
    """A value as a student writes it, with a comma."""
    return f"{value:.5g}".replace(".", ",")


def fill(page: Any, key: Mapping[str, float]) -> None:
    """Fill in the key."""
    for field in page.locator(FIELDS).all():
        name, value = field.get_attribute("name"), 0.0
        value = key[name]
        if isnan(value):
            continue
        if name.endswith("_sense"):
            field.select_option(index=1 if value > 0 else 2)
        else:
            field.fill(written(value))


def save(page: Any, into: Path) -> Path:
    """Press the button; the file that comes."""
    with page.expect_download() as coming:
        page.get_by_role("button", name="Salvează").click()
    path = into / coming.value.suggested_filename
    coming.value.save_as(path)
    return path


def cells(path: Path, separator: str) -> dict[str, str]:
    """The rows of a saved file."""
    lines = path.read_bytes().decode("utf-8").splitlines()
    return dict(csv.reader(lines, delimiter=separator))


def test_the_key_filled_in_saved_and_graded_earns_every_point(
    opened: Opened,
    folder: Path,
    run: Run,
    tmp_path: Path,
):
    page = opened(page_of(folder))
    fill(page, key_of(folder))
    answers = tmp_path / "answers"
    answers.mkdir()
    path = save(page, answers)
    assert path.name == "0042-answers.csv"
    assert path.read_bytes().startswith(b"field;value\r\nid;0042\r\n")
    result = run("grade", folder, answers, "-o", tmp_path / "report", "--format", "none")
    assert result.exit_code == 0, result.output
    with (tmp_path / "report" / "marks.csv").open(encoding="utf-8", newline="") as file:
        rows = {row["id"]: row for row in csv.DictReader(file)}
    assert rows["0042"]["percent"] in ("100", "100.0", "100.00"), rows["0042"]


def test_it_can_be_filled_in_and_saved_by_keys_alone(opened: Opened, folder: Path):
    page = opened(page_of(folder))
    names = [f.get_attribute("name") for f in page.locator(FIELDS).all()]
    key, seen = key_of(folder), []
    for _ in range(500):
        page.keyboard.press("Tab")
        name = page.evaluate("document.activeElement.name || ''")
        if name:
            seen.append(name)
            if name.endswith("_sense"):
                page.keyboard.press("ArrowDown")
            else:
                page.keyboard.type(written(key[name]) if not isnan(key[name]) else "1")
        elif page.evaluate("document.activeElement.className") == "save":
            break
    assert seen == names
    with page.expect_download() as coming:
        page.keyboard.press("Enter")
    found = cells(coming.value.path(), ";")
    assert list(found) == ["field", "id", *names]
    for name in names:
        if name.endswith("_sense"):
            assert found[name] in ("ccw", "forward")
        else:
            assert found[name] == (written(key[name]) if not isnan(key[name]) else "1")


def test_a_saved_file_is_opened_to_go_on(
    opened: Opened,
    folder: Path,
    tmp_path: Path,
):
    page = opened(page_of(folder))
    fill(page, key_of(folder))
    path = save(page, tmp_path)
    before = [field.input_value() for field in page.locator(FIELDS).all()]
    page.once("dialog", lambda dialog: dialog.accept())
    page.get_by_role("button", name="Golește").click()
    assert {f.input_value() for f in page.locator(FIELDS).all()} == {""}
    page.set_input_files("input.file", path)
    status = page.get_by_role("status")
    status.filter(has_text=path.name).wait_for()
    assert [f.input_value() for f in page.locator(FIELDS).all()] == before


OTHERS = {
    "field,value\nid,0043\nomega_3,1\n": "0043",
    "id;omega_3\n0042;1\n": "nu este un fișier",
    "": "nu este un fișier",
    "field;value\nid;0042\nomega_9;1\n": "nu este un fișier",
}
"""Files that are not of the first student's form, and what is said of each."""


def test_a_file_that_is_not_of_this_form_changes_nothing(
    opened: Opened, folder: Path, tmp_path: Path
):
    page = opened(page_of(folder))
    first = page.locator("form.answers input[name]").first
    first.fill("3")
    for number, (text, said) in enumerate(OTHERS.items()):
        path = tmp_path / f"other-{number}.csv"
        path.write_text(text, encoding="utf-8")
        page.set_input_files("input.file", path)
        status = page.get_by_role("status").filter(has_text=said)
        status.filter(has_text=path.name if said != "0043" else said).wait_for()
        assert first.input_value() == "3"


PLAIN = """
3 -3 +3 −3 3,5 3.5 ,5 .5 5, 1e3 1E-3 1,5·10^3 1.5*10^-3 1.234,5 1'000 12a abc -- 3_000 3mm 3cm
0,1m 2in 3m/s 3(m/s) 3m·s^-1 3ms⁻¹ 3m/s² 3m/s^2 3rad/s 3s^-1 3s⁻² 30rpm 3°/s 30rot/min 3deg/s
5o0 5O0m/s 1o 4b7 1e999 1e308 3kg 3kg/m3 =1+1 @x 1e400 ٣ Infinity NaN 0x10 ½ , . + e5 3e5e5
"""
SPACED = ["3\u00a0mm", "3 mm", " 3 ", "3 m / s", "5O mm", "1 000", "3 x 10 ^ 2", "3 m/s ²"]
TEXTS = [*PLAIN.split(), *SPACED, "7" * 61, "a" * 40]
SAID = {"number": "no_number", "unit": "no_unit", "large": "too_large"}
UNITS = {"v_D_mm": "mm", "v_D": "m/s", "a_D": "m/s²", "omega_2": "rad/s", "epsilon_2": "rad/s²"}


def bare_page(items: list[Item], identity: Identity, language: str = "en") -> str:
    """A page with nothing but a form."""
    form = form_fragment(items, {}, (), words(language), identity)
    main = Markup(f"<main>{form.body}</main>")
    return offline_page("Form", language, main, [form.style], [form.script])


@pytest.fixture(scope="module")
def bare(tmp_path_factory) -> Path:
    """A form with a field of each unit."""
    items = [
        Item(name, "value", f"*{name[0]}*", unit, "velocity", "D") for name, unit in UNITS.items()
    ]
    path = tmp_path_factory.mktemp("bare") / "form.html"
    path.write_text(bare_page(items, Identity("bare", "bare")), encoding="utf-8")
    return path


WRITTEN = """([field, ...texts]) => texts.map((text) => {
  const [input, wrong] = [field, `${field}-wrong`].map((each) => document.querySelector(each));
  input.value = text;
  input.dispatchEvent(new Event("change", { bubbles: true }));
  return wrong.innerText;
})"""
"""What is said of each text that is written into a field."""


def test_numbers_are_read_as_grading_reads_them(opened: Opened, bare: Path):
    page = opened(bare)
    for name, unit in UNITS.items():
        item = Item(name, "value", "", unit, "x", "D")
        found = page.evaluate(WRITTEN, [FIELD.format(name), *TEXTS])
        for text, said in zip(TEXTS, found, strict=True):
            problem = read_answer(text, item).problem
            sentence = words("en").sentences[f"answers.{SAID[problem]}"] if problem else ""
            assert bool(said) == bool(sentence), (name, text)
            if sentence:
                assert re.split(r"\{\w+\}", sentence)[1] in said, (name, text)


HOSTILE = '"><script>document.title="taken"</script><b onclick="x">&{id}'


def test_names_and_ids_are_text(opened: Opened, tmp_path: Path):
    path = tmp_path / "hostile.html"
    item = Item("v_D", "value", "*v*", "m/s", "velocity", "D")
    whose = Identity("stem", HOSTILE, HOSTILE, HOSTILE)
    path.write_text(bare_page([item], whose), encoding="utf-8")
    page = opened(path)
    assert page.title() == "Form"
    assert HOSTILE in page.inner_text("p.owner")
    assert page.locator("b, main script").count() == 0
    with page.expect_download() as coming:
        page.get_by_role("button", name="Save the").click()
    rows = cells(coming.value.path(), ",")
    assert rows["id"] == HOSTILE
