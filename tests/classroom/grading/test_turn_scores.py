"""Score sheets of "your turn": whose they are, whether they are as a page saved them, and what is
told of each step."""

from __future__ import annotations

import csv
import json
from hashlib import sha256

import pytest

from graphkin.classroom.grading.turn_scores import MOST, read_turns, turns_table
from graphkin.text.errors import Refusals

CODES = {"0002": "TZHG6MXPZY", "0001": "AAAA", "ă3": "BBBB", "0004": "CCCC"}
STEPS = [["v_A", "alone", 0], ["v_B", "hint", 3], ["a_A", "alone", 1], ["ă\n", "help", 2]]


def saved(folder, name, who, code=None, **changes):
    """A score sheet as a page saves it, with its seal where there is a code."""
    told = {"graphkin_turn": 1, "id": who, "from": 2, "steps": STEPS, "left": 5}
    text = json.dumps([who, 2, STEPS, 5], ensure_ascii=False).replace(", ", ",")
    seal = sha256(f"{code}\n{text}".encode()).hexdigest() if code else ""
    told |= {"seal": seal} | changes
    (folder / name).write_text(json.dumps(told), encoding="utf-8")


def test_a_score_sheet_counts_how_its_steps_were_drawn(tmp_path):
    """In the order of the class; who has saved no id is named by the file."""
    saved(tmp_path, "a.json", "0001", "AAAA")
    saved(tmp_path, "b.json", "ă3", "BBBB", left=4)
    saved(tmp_path, "0004-turn.json", "")
    saved(tmp_path, "z.json", "0002", "AAAA")
    (tmp_path / "notes.txt").write_text("no sheet")
    found = read_turns(tmp_path, CODES, Refusals())
    assert [each.who for each in found] == ["0002", "0001", "ă3", "0004"]
    assert [each.seal for each in found] == ["broken", "right", "broken", "none"]
    heads, *rows = csv.reader(turns_table(found).decode("utf-8-sig").splitlines())
    assert ",".join(heads) == "id,from_step,steps,alone,hint,drawn_by_page,wrong,left,seal,file"
    assert rows[1] == ["0001", "2", "4", "2", "1", "1", "6", "5", "right", "a.json"]
    assert rows[2][7:] == ["4", "broken", "b.json"]
    for path in (tmp_path / "a.json", tmp_path / "none"):
        assert read_turns(path, CODES, Refusals()) == []


CHANGES = (
    {"from": -1},
    {"left": 100_001},
    {"graphkin_turn": 2},
    {"steps": [["v_A", "alone"]]},
    {"steps": [["v_A", "guessed", 0]]},
    {"steps": [["v_A", "alone", -1]]},
    {"more": 1},
    {"seal": "a" * MOST},
)


@pytest.mark.parametrize("changes", CHANGES, ids=str)
def test_what_no_page_saves_is_no_score_sheet(tmp_path, changes):
    saved(tmp_path, "a.json", "0001", **changes)
    refusals = Refusals()
    assert read_turns(tmp_path, CODES, refusals) == []
    (problem,) = refusals.found["a.json"]
    assert str(problem).startswith("a.json: ")
    assert "expected a score sheet as a page saves it" in str(problem)


def test_a_file_that_is_no_student_s_keeps_no_other_back(tmp_path):
    """Of two with one id counts that which was saved from the own page."""
    saved(tmp_path, "a.json", "0001")
    saved(tmp_path, "b.json", "0001", "AAAA")
    saved(tmp_path, "c.json", "0009")
    (tmp_path / "d.json").write_bytes(b"\xff\xfe{")
    (tmp_path / "e.json").write_bytes(b"[" * 100_000)
    saved(tmp_path, "f.json", "0002")
    refusals = Refusals()
    found = read_turns(tmp_path, CODES, refusals)
    assert [each.file for each in found] == ["f.json", "b.json"]
    stranger, *broken, also = refusals.lines()
    assert also == 'b.json: "0001" has a score sheet already, in a.json; expected one'
    assert stranger.startswith('c.json: "0009" is no student of this class')
    assert [line[:6] for line in broken] == ["d.json", "e.json"]
