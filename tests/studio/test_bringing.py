"""What the page sends of another program comes back as a scene, or as sentences."""

from __future__ import annotations

from base64 import b64encode
from pathlib import Path

import pytest

from graphkin.manual.pages import address_at
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.studio.pump import PUMP, desk_in, ordered

FILES = Path(__file__).parent.parent / "importing"


def brought(tmp_path, **fields):
    return desk_in(tmp_path).bring(ordered(**fields))


def test_a_file_becomes_a_scene_under_its_name(tmp_path):
    data = (FILES / "crank.linkage2").read_bytes()
    found = brought(tmp_path, file=b64encode(data).decode(), name="crank.linkage2")
    assert (found["problems"], found["name"], found["drawing"]) == ([], "crank.toml", False)
    assert found["notes"]
    assert Mechanism(read_text(found["text"], "crank")).solve().points


@pytest.mark.parametrize("fields", [{}, {"pasted": "x"}, {"file": "no base 64"}, {"pasted": "<a"}])
def test_what_is_no_mechanism_is_said(tmp_path, fields):
    found = brought(tmp_path, **fields)
    assert len(found["problems"]) == 1
    assert not found["text"]


def test_notes_are_in_the_language_of_the_page(tmp_path):
    data = b64encode((FILES / "crank.linkage2").read_bytes()).decode()
    romanian = brought(tmp_path, file=data, name="a.linkage2", language="ro")["notes"]
    assert romanian != brought(tmp_path, file=data, name="a.linkage2")["notes"]


@pytest.mark.parametrize(
    ("line", "section"),
    [
        ("title =", "scene.html#the-top-of-the-file"),
        ("units =", "scene.html#the-top-of-the-file"),
        ("n = {", "scene.html#parameters"),
        ("O1-A", "scene.html#linksname"),
        ("slides", "scene.html#slides"),
        ("angle = ", "scene.html#drivers"),
        ("5 = ", "scene.html#branches"),
        ("poles", "scene.html#ask"),
    ],
)
def test_help_leads_to_the_key_at_the_caret(tmp_path, line, section):
    lines = PUMP.splitlines()
    number = next(n for n, each in enumerate(lines) if each.startswith(line))
    found = desk_in(tmp_path).explain(ordered(line=number, column=1))
    assert found["address"] == f"manual/reference/{section}"


def test_help_leads_to_the_index_where_nothing_is_written():
    assert address_at("", 0, 0) == "index.html"
    assert address_at("graphkin = 1", 90, 3) == "index.html"
