"""A lab beside its scene: tried as the command tries it, proposals that hold, both files saved."""

from __future__ import annotations

from itertools import product
from typing import Any

import pytest
from msgspec.structs import replace

from graphkin.classroom.lab.fair_ranges import fair_ranges
from graphkin.classroom.lab.lab_trial import tried
from graphkin.classroom.lab.new_lab import proposed_ranges
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.studio.folder import shipped_rules, shipped_text
from graphkin.studio.panels import LabProposal, LabTexts, StaleError, beside, lab_advice, trial_of
from graphkin.text import LANGUAGES, words
from graphkin.text.errors import SceneError
from tests.studio.pump import PUMP, desk_in, ordered

RULES = shipped_rules("pump")
SLIDER = shipped_text("offset-slider-crank")


def asked(session: Any, what: str, **fields: Any) -> dict[str, Any]:
    """What the studio answers of the pump's lab."""
    given = {"rules": RULES, "name": "pump/scene.toml", "number": 1} | fields
    return getattr(session, what)(ordered(**given))


@pytest.fixture
def session(tmp_path) -> Any:
    """A studio in an empty folder."""
    return desk_in(tmp_path)


def test_a_lab_is_tried_as_the_command_tries_it(session):
    """As many are fair, and each two students are as far apart; unsaved texts count as they are."""
    report, trial = asked(session, "variants"), tried(read_lab("pump"))
    assert (report["fair"], report["count"]) == (len(trial.many) - trial.unfair, len(trial.many))
    assert report["fair"] == 29
    shares = trial.neighbours.exact
    for own, row in enumerate(report["shares"]):
        for other, share in enumerate(row):
            assert share == (-1 if own == other else round(100 * shares[own, other]))
    last = report["students"][-1]
    assert (last["name"], last["settings"]) == ("30", {"n": "30"})
    assert "v_DC: 0.0441 < 0.05" in last["faults"]
    strict = asked(session, "variants", rules=RULES.replace("crossing = 9 ", "crossing = 65 "))
    assert 0 < strict["fair"] < 29


def test_whom_a_pencil_draws_too_coarsely_is_told_by_fields(session):
    """A limit of the pencil's error: how many keep it, and the symbols of what does not."""
    rules = RULES.replace("[fair]", "[fair]\npencil = 0.1")
    report = asked(session, "variants", rules=rules)
    trial = tried(replace(read_lab("pump"), fair=replace(read_lab("pump").fair, pencil=0.1)))
    assert trial.coarse
    exact = trial.pencilled - len(trial.coarse)
    assert report["exact"].startswith(f"A pencil draws {exact} of the first {trial.pencilled} ")
    assert "<i>ε</i><sub>4</sub>, rad/s<sup>2</sup>: " in report["tables"]
    assert asked(session, "variants")["exact"] == ""


def test_mistakes_of_both_texts_are_told_apart(session):
    wrong = asked(session, "variants", rules=RULES.replace("segment = 3", "segment = -3\nmany = 1"))
    told = [(each["place"], RULES[: each["start"]].count("\n")) for each in wrong["problems"]]
    assert [place for place, _ in told] == ["fair.segment", "fair.many"]
    assert not wrong["scene_wrong"]
    wrong = asked(session, "variants", text=PUMP.replace("O1-A = 30", "O1-A = -30"))
    assert wrong["scene_wrong"]
    assert wrong["problems"] == []
    wrong = asked(session, "variants", rules="[variants")
    assert wrong["problems"][0]["line"] == 1


def test_what_is_proposed_is_fair(session):
    """The change of the scene mends the formula; the ranges, put into the text, are fair to all,
    and everything else of the text stays as it is written."""
    found = asked(session, "ranges")
    start, end = found["mending"]["start"], found["mending"]["end"]
    assert PUMP[start:end] == found["mending"]["before"] == "25"
    mended = PUMP[:start] + found["mending"]["text"] + PUMP[end:]
    assert asked(session, "variants", text=mended)["fair"] == 30
    report = asked(session, "variants", rules=found["rules"])
    assert report["fair"] == report["count"] == 1000
    kept = RULES[RULES.index("[fair]") :]
    assert found["rules"].endswith(kept)
    assert found["shares"][0]["parts"][0] == ("1 … 2", 100)


def test_a_lab_is_begun_for_any_scene(session):
    rules = session.begin(ordered(text=SLIDER, name="own.toml"))["rules"]
    report = asked(session, "variants", text=SLIDER, rules=rules)
    assert report["problems"] == []
    assert report["fair"] > 0
    assert "v_B = 1" in rules
    none = PUMP.replace(", min = 1, max = 30", "")
    assert (
        "no parameter has min and max" in session.begin(ordered(text=none))["problems"][0]["found"]
    )


@pytest.mark.parametrize("view", ["key", "task"])
def test_the_sheets_of_a_student_are_drawn(session, view):
    sheets = session.student(ordered(name="pump", settings={"n": "9"}, view=view))["sheets"]
    assert len(sheets) == 2
    assert all('viewBox="0 0 420 297"' in sheet for sheet in sheets)
    wrong = session.student(ordered(name="pump", settings={"n": "99"}))
    assert wrong["problems"][0]["setting"] == "n"


def test_scene_and_rules_are_saved_together(session, tmp_path):
    """Both or neither, and nothing over what somebody else has written since."""
    saved = asked(session, "save")
    assert saved["files"] == ("pump/scene.toml", "pump/lab.toml")
    assert read_lab(tmp_path / "pump").text == RULES
    opened = session.open("pump/scene.toml", "scene")
    assert (opened.rules, opened.rules_mark) == (RULES, saved["rules_mark"])
    (tmp_path / "pump" / "lab.toml").write_text("theirs", encoding="utf-8")
    marks = {"mark": opened.mark, "rules_mark": opened.rules_mark}
    again = asked(session, "save", text=PUMP + "\n", **marks)
    assert again["exist"] == ("pump/lab.toml",)
    assert "-theirs" in again["changes"]
    assert (tmp_path / "pump" / "scene.toml").read_text(encoding="utf-8") == PUMP
    refused = asked(session, "save", name="pump.toml")
    assert "pump/scene.toml" in refused["problems"][0]["expected"]
    assert not (tmp_path / "pump.toml").exists()


def test_rules_outside_the_folder_are_neither_read_nor_replaced(session, tmp_path):
    outside = tmp_path.parent / "outside.toml"
    outside.write_text("secret", encoding="utf-8")
    lab = tmp_path / "lab"
    lab.mkdir()
    (lab / "scene.toml").write_text(PUMP, encoding="utf-8")
    (lab / "lab.toml").symlink_to(outside)
    with pytest.raises(SceneError, match="leads out of the folder"):
        session.open("lab/scene.toml", "scene")
    assert asked(session, "save", name="lab/scene.toml", replace=True)["problems"]
    assert outside.read_text(encoding="utf-8") == "secret"


def test_what_is_not_wanted_any_more_ends_at_once():
    """A search that takes seconds is given up as soon as something newer is asked for."""
    slow = LabTexts(shipped_text("slotted-lever"), shipped_rules("slotted-lever"), "slotted-lever")
    looks: list[int] = []

    def go_on() -> None:
        looks.append(1)
        if len(looks) > 2:
            raise StaleError

    with pytest.raises(StaleError):
        beside(trial_of, slow, go_on)
    assert len(looks) == 3


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_limit_has_its_name(language):
    from graphkin.classroom.lab.fairness import WORDS

    for limit in WORDS:
        assert words(language)(f"studio.limit_{limit}")


def test_it_is_told_which_share_of_a_proposal_a_pencil_draws():
    lab = read_lab("pump")
    found = fair_ranges(lab)
    new = proposed_ranges(lab, found)
    assert new is not None
    texts = LabTexts(shipped_text("pump"), shipped_rules("pump"), "pump")
    for language, (exact, told) in product(LANGUAGES, ((1.0, False), (0.4, True))):
        said = words(language)
        advice = lab_advice(LabProposal(found, replace(new, exact=exact), None), texts, said)
        assert (said("studio.exact_share", share=40) in advice.kept) == told


def test_the_parameter_that_decides_most_comes_first(monkeypatch):
    lab = "offset-slider-crank"
    found = fair_ranges(read_lab(lab))
    decides = {"n": 0.1, "r": 0.6}
    monkeypatch.setattr(type(found.tried), "guilt", lambda tried, name: decides[name])
    texts = LabTexts(SLIDER, shipped_rules(lab), lab)
    for _ in range(2):
        shares = lab_advice(LabProposal(found, None, None), texts, words("en")).shares
        told = {each.name: each.decides for each in shares}
        assert list(told.items()) == sorted(told.items(), key=lambda each: -each[1])
        assert told == {name: round(100 * share) for name, share in decides.items()}
        decides = dict(zip(decides, [*decides.values()][::-1], strict=True))
