"""The form of a lab as markup: every field labelled, nothing of the key, kept to a student."""

from __future__ import annotations

import html
import json
import re
from html.parser import HTMLParser
from math import isnan
from pathlib import Path

import pytest

from graphkin.classroom.form_page import Identity, lab_form
from graphkin.classroom.grading.answers import read_answers
from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.lab.items import items
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.roster.students import signs
from graphkin.mechanism import load
from graphkin.text import LANGUAGES, words
from graphkin.web import step_page as pages
from graphkin.web.step_page import Slider
from tests.classroom.grading.students import LABS
from tests.running import Run

WHOSE = Identity("0042", "pump CODE", "0042", "Ștefănescu Ana")


class Form(HTMLParser):
    """What stands in a form: its fields by name with their attributes, labels, all ids, options."""

    def __init__(self, markup: str) -> None:
        super().__init__()
        self.fields: dict[str, dict[str, str | None]] = {}
        self.labelled: list[str] = []
        self.ids: list[str] = []
        self.told: dict = {}
        self.options: dict[str, list[str]] = {}
        self.feed(markup)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        if "id" in given:
            self.ids.append(given["id"])
        if tag in ("input", "select") and "name" in given and given.get("type") != "hidden":
            self.fields[given["name"]] = given
        if tag == "label":
            self.labelled.append(given["for"])
        if tag == "form" and "data-form" in given:  # the board has forms of its own
            self.told = json.loads(given["data-form"])
        if tag == "option":
            self.options.setdefault(list(self.fields)[-1], []).append(given["value"])


@pytest.mark.parametrize(("name", "language"), [*zip(LABS, LANGUAGES, strict=False)])
def test_every_field_of_the_form_is_there_with_its_label(name, language):
    mechanism, lab = load(name), read_lab(name)
    form = Form(lab_form(mechanism, lab, words(language), WHOSE).body)
    asked = items(mechanism, lab)
    assert set(form.fields) == {item.field for item in asked}
    assert set(form.labelled) == {field["id"] for field in form.fields.values()}
    assert len(form.ids) == len(set(form.ids))
    for field in form.fields.values():
        assert set(field["aria-describedby"].split()) <= set(form.ids)
    assert {unit for item in asked if (unit := item.unit)} <= set(form.told["units"])


@pytest.fixture(scope="module")
def printed(tmp_path_factory) -> Path:
    """The class folder of some students of every lab, with their task pages."""
    from click.testing import CliRunner

    from graphkin.cli.main import app

    folder = tmp_path_factory.mktemp("classes")
    (folder / "class.csv").write_text("number,id,name\n7,0042,Ana\n12,0043,Ion\n", encoding="utf-8")
    for name in LABS:
        for args in (
            ("variants", name, folder / "class.csv", "-o", folder / name),
            ("print", folder / name, "--view", "task", "--format", "html", "--jobs", "1"),
        ):
            result = CliRunner().invoke(app, [str(arg) for arg in args])
            assert result.exit_code == 0, result.output
    return folder


def said(page: str) -> str:
    """The text of a page and what its form is told, without drawings, styles and scripts."""
    bare = re.sub(r"<(svg|style|script)\b.*?</\1>", " ", page, flags=re.DOTALL)
    told = " ".join(re.findall(r'(?:data-\w+|value)="([^"]*)"', bare))
    return html.unescape(re.sub(r"<[^>]*>", " ", bare) + " " + told)


KEY_MARKS = ("link", "velocity", "acceleration", "construction", "normal", "centre", "arrowhead")
"""Classes of marks that only a key draws."""


@pytest.mark.parametrize("name", LABS)
def test_nothing_of_the_key_is_in_a_task_page(printed, name):
    lab = read_lab(name)
    book = Book(lab, lab.scene.read_text(encoding="utf-8"))
    for who, n in (("0042", 7), ("0043", 12)):
        page = (printed / name / "print" / "task" / f"{who}-task.html").read_text(encoding="utf-8")
        text = said(page).replace(",", ".").replace("−", "-")
        numbers = {abs(float(found)) for found in re.findall(r"\d+\.\d+", text)}
        key = book.marker({"n": str(n)}).standard.key
        for field, value in key.items():
            if field.endswith("_sense") or isnan(value) or abs(value) < 1e-9:
                continue
            near = [x for x in numbers if abs(x - abs(value)) < 2e-3 * abs(value)]
            assert not near, (field, value, near)
        to_scale = re.sub(r'<figure id="scheme">.*?</figure>', "", page, flags=re.DOTALL)
        pictures = "".join(re.findall(r"<svg\b.*?</svg>", to_scale, flags=re.DOTALL))
        marks = {c for found in re.findall(r'class="([^"]*)"', pictures) for c in found.split()[:1]}
        assert marks
        assert not marks & set(KEY_MARKS), marks & set(KEY_MARKS)


def test_forms_of_a_class_are_kept_apart_and_named_by_their_students(printed):
    told = []
    for name in LABS:
        for who in ("0042", "0043"):
            path = printed / name / "print" / "task" / f"{who}-task.html"
            form = Form(path.read_text(encoding="utf-8"))
            assert form.told["id"] == who
            assert form.told["stem"] == who
            told.append(form.told["memory"])
    assert len(set(told)) == len(told)


def test_a_file_line_by_line_with_any_separator_is_an_answer(tmp_path):
    """What the script writes, by hand: grading reads it whatever language the page has."""
    mechanism, lab = load("pump"), read_lab("pump")
    fields = items(mechanism, lab)
    for sign, number in ((";", "12,5"), (",", '"12,5"'), (",", "12.5")):
        text = f"field{sign}value\r\nid{sign}0042\r\nv_D_mm{sign}{number}\r\nv_D{sign}\r\n"
        path = tmp_path / "0042-answers.csv"
        path.write_text(text, encoding="utf-8", newline="")
        found = read_answers(path, fields, signs(["0042"]))
        assert found.of["0042"]["v_D_mm"].value == 12.5
        assert found.of["0042"]["v_D"].is_blank


# --- graphkin sheet --format html: one page beside the files for paper ---------------------------


def written(folder: Path) -> list[str]:
    """The files of a folder."""
    return sorted(path.name for path in folder.iterdir())


def test_one_page_is_written_with_every_step(run: Run, tmp_path: Path):
    view = "steps"
    args = ("sheet", "pump", "--set", "n=7", "-o", tmp_path, "--format", "html", "--view", view)
    result = run(*args, "--lang", "en")
    assert result.exit_code == 0, result.stderr
    assert written(tmp_path) == [f"pump-n7-{view}.html"]
    page = (tmp_path / f"pump-n7-{view}.html").read_text(encoding="utf-8")
    assert page.startswith("<!DOCTYPE html>")
    assert page.count('<li id="step-') == 42
    assert run(*args).exit_code == 2  # it is there already


def test_the_task_of_a_lab_holds_its_form(run: Run, tmp_path: Path):
    args = ("sheet", "pump", "-o", tmp_path, "--format", "html", "--view", "task", "--lang", "en")
    assert run(*args).exit_code == 0
    page = (tmp_path / "pump-task.html").read_text(encoding="utf-8")
    assert 'class="answers"' in page
    assert '<li id="step-' not in page


def test_a_mechanism_that_stands_still_says_why(monkeypatch):
    why = "screen.open"
    monkeypatch.setattr(pages, "slider", lambda *_: Slider(why=why))
    page = pages.step_page(load("pump"), "en")
    assert f'<p id="still">{words("en")(why)}</p>' in page
    assert 'id="driver"' not in page
    assert "const graphkinMotion" not in page
