"""What helps to write: keys that the reader knows, mends that mend, names where they stand."""

from __future__ import annotations

import re
import tomllib
from typing import Any

import pytest

from graphkin.studio.look import editing_help, every_key
from graphkin.studio.mends import Edit
from graphkin.text.errors import Mend
from tests.golden.works import small_text
from tests.studio.test_places import PUMP, SCENES, mistakes, selected_span

KINDS = re.compile(r"\[\d+\]")


def tables(value: Any, place: str = "") -> list[tuple[str, set[str]]]:
    """The tables of a tree by their places, each with its keys."""
    if isinstance(value, list):
        return [each for inner in value for each in tables(inner, place)]
    if not isinstance(value, dict):
        return []
    found = [(place, set(value))]
    for key, inner in value.items():
        found += tables(inner, f"{place}.{key}" if place else key)
    return found


def kind_of(place: str) -> str:
    """The place of a table of the same kind: that of any link, any parameter."""
    parts = place.split(".")
    if parts[0] in ("links", "parameters") and len(parts) > 1:
        parts[1] = {"links": "1", "parameters": "n"}[parts[0]]
    if parts[0] == "links" and parts[-1][:1].isupper():
        parts[-1] = "P"
    return ".".join(parts)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_every_key_that_a_scene_uses_is_offered(path):
    """But for names: of points, links, parameters, titles."""
    known: dict[str, set[str]] = {}
    for place, keys in every_key().items():
        known.setdefault(kind_of(KINDS.sub("", place)), set()).update(keys)
    names = ("links", "parameters", "branches", "names", "frame.", ".start", ".turns")
    for place, keys in tables(tomllib.loads(path.read_text(encoding="utf-8"))):
        words = {key for key in keys if re.fullmatch("[a-z]{2,}", key)}
        if place in names or place.endswith(names) or place.startswith(("names.", "frame.")):
            continue
        assert words <= known[kind_of(place)], place


WRONG = [
    ("omega = [2", "omga = [2"),
    ("O1-A = 30", "O1-A = 30 cm"),
    ("O1-A = 30", "O1-A = 30,5"),
    ("O1-A = 30", 'O1-A = "30,5"'),
    ('"30 + 2*n"', '"30 + 2*n^2"'),
    ('"30 + 2*n"', '"30 + 2*nn"'),
    ('"30 + 2*n"', '"30 + 2*m"'),
    ('"30 + 2*n"', "30 + 2*n"),
    ('"left of A-B"', '"lft of A-B"'),
    ('"right of A-O2"', '"rigth of A-O2"'),
    ('"right of A-O2"', '"right of A-02"'),
    ('"cm"', '"centimetres"'),
    ('velocity = ["D"]', 'velocity = ["d"]'),
    ('through = "O1"', 'trough = "O1"'),
    ("turn = 1", "turn = 11"),
    ("# crank", "// crank"),
    ('language = "ro"', 'language = "rom"'),
]


@pytest.mark.parametrize(("right", "wrong"), WRONG)
def test_a_mend_leaves_its_mistake_behind(right, wrong):
    """What is proposed, put into the text, takes the mistake away, and brings no other."""
    text = PUMP.replace(right, wrong, 1)
    before = mistakes(text)
    mended = [mark for mark in before if mark.mends]
    assert mended, [str(mark.problem) for mark in before]
    after = applied(text, mended[0].mends[0])
    left = {str(mark.problem) for mark in mistakes(after)}
    assert left < {str(mark.problem) for mark in before}


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("a-block-is-driven-as-a-crank", 1),
        ("a-closure-number-that-there-is-not", 4),
        ("a-driver-on-a-coupler-that-the-crank-moves", 1),
        ("a-driver-too-few", 1),
        ("a-driver-too-many", 2),
        ("a-driver-too-many-for-the-truth-though-not-for-the-count", 2),
        ("a-digit-less", 1),
        ("a-group-of-class-three-needs-its-number", 1),
        ("branches-that-name-nothing-1-forward", 1),
        ("guide-on-the-pinned-link-a-link-hangs-loose", 1),
        ("number-for-a-block", 2),
        ("side-for-a-way", 2),
        ("way-for-a-side", 2),
        ("way-of-the-other-link", 2),
    ],
)
def test_each_mend_that_is_offered_takes_its_mistake_away(name, count):
    """Of mistakes whose messages say what may stand instead, each of it is offered."""
    text = small_text("mistakes", name)
    wrong = next(mark for mark in mistakes(text) if mark.mends)
    assert len(wrong.mends) == count
    for mend in wrong.mends:
        left = [mark.problem for mark in mistakes(applied(text, mend))]
        assert (wrong.problem.place, wrong.problem.found) not in [(p.place, p.found) for p in left]


def applied(text: str, edit: Edit) -> str:
    """A text after an edit, as a browser makes it."""
    data = text.encode("utf-16-le")
    return (data[: 2 * edit.start] + edit.text.encode("utf-16-le") + data[2 * edit.end :]).decode(
        "utf-16-le"
    )


def test_no_change_is_offered_where_it_is_not_clear_which_piece_is_meant():
    (mark,) = mistakes(PUMP.replace('"30 + 2*n"', '"nn + 2*nn"'))
    assert isinstance(mark.problem.hint, Mend)
    assert not mark.mends


def test_no_way_is_offered_for_a_pin():
    """The side of a pin names two others; a way would be refused there."""
    (mark,) = mistakes(PUMP.replace('"right of A-O2"', '"above"'))
    assert mark.problem.place == "branches.B"
    assert not mark.mends
    (mark,) = mistakes(PUMP.replace('5 = "forward"', '5 = "up"'))
    assert [edit.text for edit in mark.mends][:2] == ['5 = "forward"', '5 = "backward"']


def test_names_are_found_where_they_are_written():
    found = editing_help(PUMP, "pump")
    assert found.points == ["O1", "O2", "A", "B", "C", "D"]
    assert found.links == ["1", "2", "3", "4", "5"]
    assert found.parameters == ["n"]
    told = {name: selected_span(PUMP, *spot) for name, spot in found.spots.items()}
    assert told["AB"] == "A-B = 40"
    assert told["3"] == "[links.3]"
    assert told["O2"] == "O2 = [0, -30]"
    assert told["C"] == "A-C = 20"


def test_a_text_that_is_no_toml_still_has_its_keys():
    assert "through" in editing_help("[links.1]\nslides = { on", "x").keys["links.1.slides"]


def test_the_keys_of_one_wheel_are_those_of_each_of_several():
    keys = every_key()
    assert keys["links.1.wheels"] == keys["links.1.wheel"]
