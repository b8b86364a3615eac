"""The desk about answers: what is asked, what is kept, and what the next marking makes of it."""

from __future__ import annotations

import csv
import io
import json
import random
import re
from math import pi
from pathlib import Path
from shutil import copytree
from threading import Thread
from typing import Any
from wsgiref.util import setup_testing_defaults

import pytest

from graphkin.classroom.grading import class_report
from graphkin.classroom.printing.edition import read_edition
from graphkin.reading.desk_app import DeskSession, desk_application, desk_page
from graphkin.studio.server import served
from graphkin.studio.session import PageRequestError
from graphkin.text import words
from graphkin.text.errors import PageError
from tests.browser.opening import barred, heard
from tests.running import ran

NAMES = (
    "Ana Pop",
    "Ion Marin",
    "Maria Ilie",
    "Dan Luca",
    "Elena Rusu",
    "Radu Stan",
    "Ioana Dinu",
    "Mihai Sava",
)
OFF = 1.37
"""The factor of the like answers: no cause makes it."""


def ids() -> list[str]:
    return [f"{100 + i:04d}" for i in range(len(NAMES))]


@pytest.fixture(scope="module")
def a_class(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three with a like mistake, two with one odd cell, two with one sheet, one with a cause."""
    folder = tmp_path_factory.mktemp("desk")
    rows = "".join(
        f"{who},{i},{name}\n" for i, (who, name) in enumerate(zip(ids(), NAMES, strict=True), 1)
    )
    (folder / "roster.csv").write_text(f"id,number,name\n{rows}", encoding="utf-8")
    assert ran("new", "lab", "crank-lab", "-o", folder).exit_code == 0
    ran("variants", folder / "crank-lab", folder / "roster.csv", "-o", folder / "class")
    opened, noise = read_edition(folder / "class"), random.Random(3)
    every = []
    for taker in opened.takers:
        standard = opened.book.marker(taker.settings, taker.compute).standard
        own = {}
        for item in standard.items:
            key = standard.key[item.field]
            if item.what == "sense":
                own[item.field] = "ccw" if key > 0 else "cw"
            else:
                read = abs(key) + noise.gauss(0, 0.2 * standard.tolerance[item.field].value)
                own[item.field] = f"{read / item.one:.4g}"
        every.append(own)
    for i in (0, 1, 2):
        every[i]["a_B"] = f"{OFF * float(every[i]['a_B']):.4g}"
    for i in (3, 4):
        every[i]["v_C"] = f" {every[i]['v_C'].replace('.', ',,')}"
    every[3]["v_C"] = every[4]["v_C"]
    every[6] = every[5]
    for field, text in every[7].items():
        power = {"v": 1, "o": 1, "a": 2, "e": 2}[field[0]]
        if not field.endswith(("_mm", "_sense")):
            every[7][field] = f"{(30 / pi) ** power * float(text):.4g}"
    table = io.StringIO()
    writer = csv.DictWriter(table, ["id", *(item.field for item in opened.book.form)])
    writer.writeheader()
    writer.writerows({"id": who, **own} for who, own in zip(ids(), every, strict=True))
    (folder / "answers.csv").write_text(table.getvalue(), encoding="utf-8")
    return folder


@pytest.fixture(autouse=True)
def no_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures take most of the time of a report, and none of these tests looks into them."""
    monkeypatch.setattr(class_report, "pictures", lambda *_: {})


@pytest.fixture
def report(a_class: Path, tmp_path: Path) -> Path:
    """A report of its own, marked once for all."""
    if not (a_class / "report").exists():
        graded(a_class, a_class / "report")
    copytree(a_class / "report", tmp_path / "report")
    return tmp_path / "report"


def graded(a_class: Path, report: Path, *more: str) -> str:
    """Mark the class again; what was printed."""
    given = (a_class / "class", a_class / "answers.csv", "-o", report)
    return ran("grade", *given, "--force", "--format", "html", "--jobs", 1, *more).output


def desk(report: Path, marker: str = "Ana", *, anonymous: bool = False) -> DeskSession:
    return DeskSession(report, words("en"), marker, anonymous)


def listed(session: DeskSession, kind: str) -> list[dict[str, str]]:
    return [each for each in session.everything()["items"] if each["kind"] == kind]


def the(session: DeskSession, kind: str) -> dict[str, Any]:
    (each,) = listed(session, kind)
    return session.item(each["name"])


def rule(session: DeskSession, item: dict[str, Any], **what: object) -> dict[str, Any]:
    asked = {"item": item["name"], "known": item["known"], **what}
    return session.rule(json.dumps(asked).encode())


def marks(report: Path) -> dict[str, dict[str, str]]:
    text = (report / "marks.csv").read_text(encoding="utf-8-sig")
    return {row["id"]: row for row in csv.DictReader(io.StringIO(text))}


def feedback(report: Path, who: str) -> str:
    return (report / "feedback" / f"{who}.html").read_text(encoding="utf-8")


def choice(item: dict[str, Any], said: str) -> int:
    return list(item["choices"]).index(said)


# --- what is asked, and what comes of it ---------------------------------------------------------


def test_like_answers_are_decided_once_for_all(a_class: Path, report: Path) -> None:
    session = desk(report)
    item = the(session, "cluster")
    assert {row["who"].partition(" (")[0] for row in item["rows"]} == {*NAMES[:3]}
    assert abs(float(item["told"].split()[2]) - OFF) < 0.02
    before = marks(report)
    assert {before[who]["a_B"] for who in ids()[:3]} == {"0"}
    told = rule(session, item, choice=choice(item, "points: 0.5"), reason="units were mixed")
    assert told["state"] == "decided"
    graded(a_class, report)
    after = marks(report)
    assert {after[who]["a_B"] for who in ids()[:3]} == {"0.5"}
    assert [after[who]["points"] for who in ids()[3:]] == [before[w]["points"] for w in ids()[3:]]
    assert all("units were mixed" in feedback(report, who) for who in ids()[:3])
    assert the(desk(report), "cluster")["state"] == "decided"  # and nobody is asked again


def test_like_cells_are_read_once_and_marked(a_class: Path, report: Path) -> None:
    session = desk(report)
    item = the(session, "cell")
    assert len(item["rows"]) == 2
    written = item["reads"]
    with pytest.raises(PageRequestError, match="cannot be read"):
        rule(session, item, reading="4 apples")
    right = str(written).strip().replace(",,", ".")
    assert rule(session, item, reading=right)["state"] == "decided"
    graded(a_class, report)
    found = marks(report)
    assert [found[who]["pending"] for who in ids()[3:5]] == ["", ""]
    assert found[ids()[4]]["v_C why"] == "right"
    assert "the lecturer read this as" in feedback(report, ids()[4])
    assert str(written).strip() in feedback(report, ids()[4])
    assert the(desk(report), "cell")["state"] == "decided"
    assert "decisions: 2 decided, 0 still open" in graded(a_class, report)


def test_a_cell_that_waits_shows_the_marker_its_key(a_class: Path, report: Path) -> None:
    """The expected value with its tolerance, which the student's feedback keeps back."""
    session = desk(report)
    item = the(session, "cell")
    rows = {row["who"].rpartition("(")[2][:-1]: row["cells"] for row in item["rows"]}
    opened = read_edition(a_class / "class")
    for taker in opened.takers[3:5]:
        own = opened.book.marker(taker.settings, taker.compute).standard
        one, tolerance = own.by_field["v_C"].item.one, own.tolerance["v_C"].value
        expected, allowed = rows[taker.student.id][2:4]
        assert float(expected) == pytest.approx(abs(own.key["v_C"]) / one, rel=1e-3)
        assert float(allowed) == pytest.approx(tolerance / one, rel=0.1)
        assert f">{expected}<" not in feedback(report, taker.student.id)


def test_a_reading_is_of_the_cell_that_was_read(a_class: Path, report: Path) -> None:
    """Whoever hands in again is read again."""
    session = desk(report)
    rule(session, the(session, "cell"), choice=0)  # no answer
    text = (a_class / "answers.csv").read_text(encoding="utf-8")
    changed = report.parent / "again.csv"
    changed.write_text(text.replace(",,", ";;"), encoding="utf-8")
    ran("grade", a_class / "class", changed, "-o", report, "--force", "--format", "none")
    assert {marks(report)[who]["v_C why"] for who in ids()[3:5]} == {"unreadable"}


def test_suspects_are_cleared_or_not(a_class: Path, report: Path) -> None:
    session = desk(report)
    item = the(session, "suspects")
    rule(session, item, choice=choice(item, f"0 points for {NAMES[6]} ({ids()[6]})"), reason="seen")
    graded(a_class, report)
    found = marks(report)
    assert found[ids()[6]]["points"] == "0"
    assert found[ids()[6]]["decision"].startswith("decided, was")
    assert found[ids()[5]]["decision"] == "stands: seen"


@pytest.mark.parametrize(
    ("language", "quotes"), [("de", "„“"), ("en", "“”"), ("fr", "«»"), ("ro", "„”"), ("ru", "«»")]
)
def test_a_cell_is_quoted_as_the_language_quotes(report: Path, language: str, quotes: str) -> None:
    item = the(DeskSession(report, words(language)), "cell")
    before, after = quotes
    for said in (item["title"], item["told"]):
        assert said.count(before) == said.count(after) == 1
        assert not {*"„“”«»"}.difference(quotes) & {*said}


def test_all_that_the_desk_page_loads_is_served(report: Path) -> None:
    """Its icon too: a browser would ask for one that the guard refuses."""
    session = desk(report)
    found = re.findall(r'(?:href|src)="([^"]+)"', desk_page(session).decode())
    assert "mark.svg" in found
    app, states = desk_application(session), []
    for name in found:
        environ = {"PATH_INFO": f"/{name}", "REQUEST_METHOD": "GET"}
        setup_testing_defaults(environ)
        app(environ, lambda status, *_: states.append(status))
    assert {*states} == {"200 OK"}


def test_a_ruling_on_one_suspect_names_that_student(a_class: Path, report: Path) -> None:
    """Only a ruling on several students says that it is for all."""
    marks = desk(report).of_marks()
    several = marks.queue.suspected("", ids()[5:7], ids()[5:7], ())
    alone = marks.queue.suspected("", ids()[6:7], ids()[5:7], ())
    assert several.choices[-1].said == "0 points for all"
    assert alone.choices[-1].said == f"0 points for {marks.queue.names[ids()[6]]}"
    assert [each.who for each in alone.choices[-1].rulings] == ids()[6:7]


def test_a_remark_is_shown_at_its_field(a_class: Path, report: Path) -> None:
    session = desk(report)
    item = the(session, "cluster")
    told = {"item": item["name"], "known": item["known"], "row": 0, "text": "<b>see p. 3</b>"}
    shown = session.remark(json.dumps(told).encode())
    assert shown["rows"][0]["remark"] == "<b>see p. 3</b>"
    assert shown["state"] == "open"  # a remark decides nothing
    graded(a_class, report)
    pages = [feedback(report, who) for who in ids()[:3]]
    (page,) = [page for page in pages if "see p. 3" in page]
    assert "&lt;b&gt;see p. 3" in page
    empty = json.dumps({**told, "known": shown["known"], "text": ""}).encode()
    assert session.remark(empty)["rows"][0]["remark"] == ""


# --- appeals -------------------------------------------------------------------------------------


def test_an_appeal_is_asked_answered_and_kept(a_class: Path, report: Path) -> None:
    rows = [f"{ids()[5]};v_B;I read 5 for 6", "0199;v_B;who am I", f"{ids()[0]};v_Q;what"]
    (report / "appeals.csv").write_text("\n".join(["id;field;text", *rows]), encoding="utf-8")
    said = graded(a_class, report)
    assert '"0199" is no student of this class' in said
    assert '"v_Q" is no field' in said
    assert "the request is being looked at: I read 5 for 6" in feedback(report, ids()[5])
    session = desk(report)
    item = the(session, "appeal")
    assert item["told"] == "I read 5 for 6"
    assert "right" in item["rows"][0]["why"]
    rule(session, item, choice=0, reason="it was right already")
    graded(a_class, report)
    page = feedback(report, ids()[5])
    assert "you asked: I read 5 for 6" in page and "it was right already" in page
    assert the(desk(report), "appeal")["state"] == "decided"
    (report / "appeals.csv").write_text(f"id;field;text\n{ids()[5]};v_B;but why", encoding="utf-8")
    again = the(desk(report), "appeal")
    assert again["state"] == "open"  # another text is another appeal …
    assert "it was right already" in " ".join(again["decided"])  # … and the first answer is seen
    graded(a_class, report)
    assert "it was right already" in feedback(report, ids()[5])
    assert "being looked at: but why" in feedback(report, ids()[5])


def test_a_row_that_a_cause_explains_is_shown_with_the_cause(a_class: Path, tmp_path: Path) -> None:
    """Its row says "the mistake named above"."""
    written = (a_class / "answers.csv").read_text(encoding="utf-8")
    table = list(csv.DictReader(io.StringIO(written)))
    table[7]["v_C"] = table[7]["v_C"].replace(".", ",,")
    with (tmp_path / "answers.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(table[0]))
        writer.writeheader()
        writer.writerows(table)
    given = (a_class / "class", tmp_path / "answers.csv", "-o", tmp_path / "report")
    ran("grade", *given, "--format", "html", "--jobs", 1)
    session = desk(tmp_path / "report")
    every = [session.item(each["name"]) for each in session.everything()["items"]]
    above = [item for item in every if any("named above" in row["why"] for row in item["rows"])]
    assert above and all(item["causes"] for item in above)


def test_an_appeal_on_what_a_cause_explains_is_about_its_cost(a_class: Path, report: Path) -> None:
    """The field has all its points already; the sum shows what the desk decided."""
    who = ids()[7]
    appeal = f"id;field;text\n{who};v_B;rev/min were on the board\n{who};total;and so for all\n"
    (report / "appeals.csv").write_text(appeal, encoding="utf-8")
    graded(a_class, report)
    session = desk(report)
    item, whole = (session.item(each["name"]) for each in listed(session, "appeal"))
    most = item["sums"][0].split(" of ")[1].split()[0]
    free = f"no deduction (points for the whole form: {most})"
    assert "rev/min" in item["causes"][0]
    assert "after a deduction of" in item["sums"][0]
    assert item["choices"] == whole["choices"] == ["the mark stays", free]
    told = rule(session, item, choice=1, reason="the board said so")
    assert told["state"] == "decided"
    assert session.item(item["name"])["sums"] == [f"the whole form earns {most} of {most} points"]
    rule(session, session.item(whole["name"]), points="7")
    assert session.item(whole["name"])["sums"] == [f"the whole form earns 7 of {most} points"]
    session.undo()
    graded(a_class, report)
    assert marks(report)[who]["points"] == most
    assert "the board said so" in feedback(report, who)


# --- several markers -----------------------------------------------------------------------------


def test_two_desks_lose_nothing_and_disagreement_does_not_count(
    a_class: Path, report: Path
) -> None:
    ana, ion = desk(report, "Ana"), desk(report, "Ion")
    one, other = the(ana, "cluster"), the(ion, "cluster")
    rule(ana, one, choice=0)
    assert ion.news(json.dumps([0, 0]).encode())["count"] == [0, 1]
    told = rule(ion, other, choice=2)  # not seen: Ion's page is older than Ana's line
    assert told["state"] == "disagree"
    assert {"Ana", "Ion"} <= {text.rpartition("(")[2].rstrip(")") for text in told["decided"]}
    said = graded(a_class, report)
    assert "Ana, Ion disagree" in said or "Ana and Ion disagree" in said
    assert {marks(report)[who]["a_B"] for who in ids()[:3]} == {"0"}
    again = the(desk(report, "Ana"), "cluster")
    assert again["state"] == "disagree"
    rule(desk(report, "Ana"), again, choice=2)  # both were seen
    assert graded(a_class, report).count("disagree") == 0
    assert {marks(report)[who]["a_B"] for who in ids()[:3]} == {"1"}


def test_agreement_is_no_conflict_and_undo_takes_ones_own(report: Path) -> None:
    ana, ion = desk(report, "Ana"), desk(report, "Ion")
    one, other = the(ana, "cluster"), the(ion, "cluster")
    rule(ana, one, choice=1)
    assert rule(ion, other, choice=1)["state"] == "decided"
    assert ana.undo()["item"] == one["name"]
    assert the(ana, "cluster")["decided"] == ["points: 0.5 (Ion)"]
    assert ana.undo() == {}
    ion.undo()
    assert the(ana, "cluster")["state"] == "open"


def test_many_desks_at_once_lose_no_line(report: Path) -> None:
    def work(marker: str) -> None:
        session = desk(report, marker)
        item = the(session, "cluster")
        for number in range(20):
            told = {"item": item["name"], "known": 0, "row": 0, "text": f"{marker} {number}"}
            session.remark(json.dumps(told).encode())

    threads = [Thread(target=work, args=(f"marker {i}",)) for i in range(4)]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    lines = (report / "decisions.jsonl").read_bytes().splitlines()
    texts = {json.loads(line)["rulings"][0]["text"] for line in lines}
    assert len(lines) == len(texts) == 80


def test_the_table_has_the_last_word(a_class: Path, report: Path) -> None:
    session = desk(report)
    rule(session, the(session, "cluster"), choice=2)
    table = report / "decisions.csv"
    table.write_text(f"id;field;points;reason\n{ids()[0]};a_B;0,25;half of half\n", "utf-8")
    graded(a_class, report)
    assert [marks(report)[who]["a_B"] for who in ids()[:3]] == ["0.25", "1", "1"]
    session = desk(report)
    with pytest.raises(PageRequestError, match="decisions"):
        rule(session, the(session, "cluster"), choice=0)


def test_a_decision_that_fits_no_student_is_named(a_class: Path, report: Path) -> None:
    lines = [
        {"rulings": [{"does": "points", "who": "0999", "field": "a_B", "points": "1"}]},
        {"rulings": [{"does": "points", "who": ids()[0], "field": "a_B", "points": "99"}]},
        {"rulings": [{"does": "points", "who": ids()[1], "field": "a_B", "points": "1/2"}]},
    ]
    text = "\n".join(map(json.dumps, lines))
    (report / "decisions.jsonl").write_text(f"{text}\nnot json\n", encoding="utf-8")
    said = graded(a_class, report)
    assert "not applied: 0999, a_B" in said and f"not applied: {ids()[0]}, a_B" in said
    assert [marks(report)[who]["a_B"] for who in ids()[:2]] == ["0", "0.5"]


# --- the page ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "said",
    [
        b"nothing",
        b'{"item":"cluster-0","known":0,"choice":0}',
        b'{"item":"NAME","known":0,"choice":99}',
        b'{"item":"NAME","known":0,"choice":-1}',
        b'{"item":"NAME","known":0}',
        b'{"item":"NAME","known":0,"points":"1.5"}',
        b'{"item":"NAME","known":0,"points":"nan"}',
        b'{"item":"NAME","known":0,"points":"-1"}',
        b'{"item":"NAME","known":0,"reading":"1"}',
        b'{"item":"NAME","known":0,"choice":0,"who":"0101"}',
    ],
)
def test_the_desk_refuses_what_its_page_does_not_ask(report: Path, said: bytes) -> None:
    session = desk(report)
    name = str(the(session, "cluster")["name"]).encode()
    with pytest.raises(PageRequestError):
        session.rule(said.replace(b"NAME", name))
    assert not (report / "decisions.jsonl").exists()


def test_an_anonymous_desk_names_nobody(report: Path) -> None:
    (report / "appeals.csv").write_text(f"id;field;text\n{ids()[5]};total;please", "utf-8")
    session = desk(report, anonymous=True)
    items = session.everything()["items"]
    told = json.dumps([items, [session.item(each["name"]) for each in items]])
    assert len(items) == 4
    assert not [name for name in (*NAMES, *ids()) if name in told]
    assert re.search(r"student \d", told.casefold())  # which one, the class's codes say


def test_a_folder_without_anything_is_refused(tmp_path: Path) -> None:
    with pytest.raises(PageError, match="holds neither readings nor"):
        desk(tmp_path)
    (tmp_path / "desk.json").write_text('{"format":0}', encoding="utf-8")
    with pytest.raises(PageError, match="graphkin grade --force"):
        desk(tmp_path)


@pytest.mark.parametrize("language", ["en", "it", "ro"])
def test_the_page_speaks_each_language(report: Path, language: str) -> None:
    session = DeskSession(report, words(language))
    assert words(language)("desk.reason") in desk_page(session).decode()
    assert words(language)("desk.stays") in the(session, "cluster")["choices"]


TITLE = "document.getElementById('card-title').textContent"


def press(page: Any, *keys: str) -> None:
    """Press keys, the last of which decides, and wait for the next thing to decide."""
    before = page.locator("#card-title").text_content()
    for key in keys:
        page.keyboard.press(key)
    page.wait_for_function(f"old => {TITLE} !== old", arg=before)


def test_a_class_is_decided_with_single_keys(report: Path, chromium: Any) -> None:
    """Also axe finds nothing, in both schemes and at two sizes."""
    session = desk(report)
    found = served(lambda: desk_application(session))
    thread = Thread(target=found.server.run, daemon=True)
    thread.start()
    for scheme, width in (("light", 1280), ("dark", 420)):
        size = {"width": width, "height": 800}
        page = chromium.new_page(color_scheme=scheme, viewport=size, bypass_csp=True)
        with heard(page, "pageerror") as errors:
            page.goto(found.address)
            page.wait_for_selector("body[data-ready=yes]")
            assert barred(page) == []
            assert page.locator("#card").is_visible() and not page.locator("#paper").is_visible()
            if scheme == "light":
                buttons_stay(page)
                decided_by_keys(page, report)
            assert not errors
        page.close()
    found.server.close()
    thread.join(5)


def buttons_stay(page: Any) -> None:
    """What the page itself decided is no news: a button being clicked stays in its place."""
    press(page, "1")
    page.evaluate("document.querySelector('#options button').dataset.mine = 'yes'")
    for _ in range(2):  # at the second answer the first has been worked through
        with page.expect_response(lambda answer: answer.url.endswith("/news")):
            pass
    assert page.locator("#options button[data-mine=yes]").count() == 1
    press(page, "u")


def decided_by_keys(page: Any, report: Path) -> None:
    """One key decides and shows the next; one takes it back; points and a reason are typed."""
    left, first = (page.locator(f"#{name}").text_content() for name in ("open", "card-title"))
    page.keyboard.press("r")
    selected = "() => window.getSelection().toString() === document.activeElement.value"
    assert page.evaluate(selected) and page.evaluate("document.activeElement.id") == "reading"
    page.keyboard.press("Escape")
    press(page, "1")
    assert page.locator("#open").text_content() != left
    press(page, "u")
    now = [page.locator(f"#{name}").text_content() for name in ("open", "card-title")]
    assert now == [left, first]
    press(page, "PageUp")
    page.keyboard.press("m")
    page.keyboard.type("by hand")
    page.keyboard.press("Enter")
    press(page, "p", "0", ",", "5", "Enter")
    assert the(desk(report), "cluster")["decided"] == ["points: 0.5: by hand (Ana)"]
