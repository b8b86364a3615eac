"""Only the page that holds the token is answered, only from here, only what it may ask."""

from __future__ import annotations

import json
import re
import socket
from collections.abc import Iterator
from contextlib import suppress
from http.client import HTTPConnection, HTTPResponse
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from graphkin.classroom.sheet_files import hand_out_page
from graphkin.documents import MOTION_VIEWS
from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import cycle
from graphkin.scene import scene_files
from graphkin.scene.quantity import METRES
from graphkin.scene.read_scene import read_text
from graphkin.studio.guard import HEADERS
from graphkin.studio.server import HOME, WORK, Served, serve
from graphkin.studio.session import MOST_BYTES
from tests.studio.pump import LONG, PUMP, desk_in, ordered, running

JSON = {"Content-Type": "application/json"}


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the studio; a secret lies beside it."""
    found = tmp_path_factory.mktemp("around") / "here"
    found.mkdir()
    (found.parent / "secret.toml").write_text(PUMP, encoding="utf-8")
    return found


@pytest.fixture(scope="module")
def served(place: Path) -> Iterator[Served]:
    """A studio that runs in that folder."""
    with running(serve(desk_in(place))) as found:
        yield found


@pytest.fixture(autouse=True)
def nothing_is_left(place: Path) -> Iterator[None]:
    """What a test has written into the folder is gone after it."""
    yield
    for path in place.iterdir():
        path.unlink()


def asked(
    served: Served, method: str, path: str, body: Any = None, **headers: str
) -> tuple[HTTPResponse, bytes]:
    """The answer to a request; a path without a slash before it is the page's own."""
    line = HTTPConnection(HOME, served.port, timeout=LONG)
    whole = path if path.startswith("/") else urlsplit(served.address).path + path
    given = {key.replace("_", "-"): value for key, value in headers.items()}
    line.request(method, whole, body, given)
    answer = line.getresponse()
    data = answer.read()
    line.close()
    return answer, data


def look(served: Served, **fields: Any) -> dict[str, Any]:
    """What is seen of the pump."""
    order = {"text": PUMP, "name": "pump.toml", "language": "en", "tab": "t", "number": 1} | fields
    answer, data = asked(served, "POST", "look", json.dumps(order), **JSON)
    assert answer.status == 200
    return json.loads(data)


def test_the_page_comes_and_all_that_it_loads(served):
    answer, data = asked(served, "GET", "?lab=pump")
    assert answer.status == 200
    page = data.decode()
    assert "Mecanism de pomp" in page
    for name in ("page.js", "page.css", "mark.svg", "talk.js", "editor.js", "GraphkinSans.woff2"):
        answer, data = asked(served, "GET", name)
        assert answer.status == 200, name
        assert data


def test_a_move_of_a_slider_is_answered(served):
    found = look(served, settings={"n": "12"}, quick=True)
    assert found["sliders"][0]["value"] == "12"
    assert len(found["panels"]) == 3


OUTSIDE = ["/", "/look", "/page.js", "/x/", "/x/look", "//", "/?lab=pump", "/scenes", "/moving/x"]
OUTSIDE += [f"/{name}" for name in WORK]


@pytest.mark.parametrize("path", OUTSIDE)
@pytest.mark.parametrize("method", ["GET", "POST"])
def test_nothing_is_answered_without_the_token(served, method, path):
    answer, data = asked(served, method, path, "{}", **JSON)
    assert answer.status == 403
    assert b"graphkin studio" in data


def test_every_studio_has_a_token_and_a_port_of_its_own(tmp_path):
    with running(serve(desk_in(tmp_path))) as first, running(serve(desk_in(tmp_path))) as second:
        assert first.port != second.port
        assert urlsplit(first.address).path != urlsplit(second.address).path


def test_a_page_of_another_site_is_refused_even_with_the_token(served):
    for origin in ("http://evil.example", "null", f"http://localhost:{served.port}", "file://"):
        answer, _ = asked(served, "POST", "look", "{}", Origin=origin, **JSON)
        assert answer.status == 403
    own = f"http://{HOME}:{served.port}"
    assert asked(served, "GET", "", Origin=own)[0].status == 200


@pytest.mark.parametrize("name", WORK)
def test_every_work_is_for_the_page_alone_and_for_what_it_asks(served, name):
    """Not for another site, another host, a form of one, or what is none of its requests."""
    evil = "http://evil.example"
    assert asked(served, "POST", name, "{}", Origin=evil, **JSON)[0].status == 403
    assert asked(served, "POST", name, "{}", Host="evil.example", **JSON)[0].status == 403
    assert asked(served, "POST", name, "text=", Content_Type="text/plain")[0].status == 415
    assert asked(served, "GET", name)[0].status in (404, 405)
    for wrong in ("[]", '{"text": 5, "of": 5, "page": "all", "kind": "x", "name": [1], "view": 1}'):
        assert asked(served, "POST", name, wrong, **JSON)[0].status == 400


@pytest.mark.parametrize("kind", ["scene", "lab", "example"])
@pytest.mark.parametrize(
    "name", ["../secret.toml", "/etc/passwd", "..", "", "x\u0000", "../../pyproject"]
)
def test_no_picture_is_drawn_of_what_lies_elsewhere(served, kind, name):
    order = json.dumps({"kind": kind, "name": name})
    answer, data = asked(served, "POST", "picture", order, **JSON)
    assert (answer.status, json.loads(data)) == (200, {"sketch": None})


@pytest.mark.parametrize("method", ["PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "HEAD"])
def test_other_methods_are_refused(served, method):
    assert asked(served, method, "")[0].status == 403


def test_it_listens_on_the_loopback_address_alone(served):
    assert served.server.socket.getsockname()[0] == "127.0.0.1"
    others = {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None)}
    for address in others - {"127.0.0.1", "::1"}:
        with (
            pytest.raises(OSError, match=r"."),
            socket.create_connection((address, served.port), 1),
        ):
            pass


@pytest.mark.parametrize(
    "path", ["", "page.js", "nothing.js", "../folder.py", "/", "scenes", "?scene=../x.toml"]
)
def test_every_answer_forbids_what_comes_from_elsewhere(served, path):
    answer, _ = asked(served, "GET", path)
    for name, value in HEADERS:
        assert answer.getheader(name) == value
    policy = answer.getheader("Content-Security-Policy")
    assert "http" not in policy
    assert "unsafe" not in policy
    assert "*" not in policy


@pytest.mark.parametrize(
    "path",
    [
        "page.html",
        "../guard.py",
        "..%2fguard.py",
        "%2e%2e/guard.py",
        "web/page.js",
        "/etc/passwd",
        "page.js%00.css",
        "GraphkinSans.ttf",
        "..",
        "?scene=../../../etc/passwd",
        "?scene=/etc/passwd.toml",
        "?scene=%2e%2e%2fx.toml",
        "?lab=../pump",
        "?lab=%00",
        "?example=../lifter",
        "?example=..%2f..%2fpyproject",
        "?like=../secret.toml",
        "?like=/etc/passwd.toml",
        "?scene=x.toml&lab=../pump",
        "moving/..%2fpage",
        "moving/../page",
        "scenes/../guard",
    ],
)
def test_no_other_file_comes(served, path):
    answer, data = asked(served, "GET", path)
    assert answer.status in (400, 403, 404)
    assert b"import" not in data
    assert b"root:" not in data


def test_a_page_that_moves_stands_within_the_page_and_reaches_nothing(served):
    """It runs in a sandbox without a name of its own, in no other page, and loads nothing."""
    order = json.dumps({"text": PUMP, "name": "pump.toml", "page": "steps"})
    found = json.loads(asked(served, "POST", "motion", order, **JSON)[1])
    answer, data = asked(served, "GET", found["page"])
    assert answer.status == 200
    assert b"<html" in data
    policy = answer.headers["Content-Security-Policy"].split("; ")
    assert len(answer.headers.get_all("Content-Security-Policy")) == 1
    assert {"default-src 'none'", "sandbox allow-scripts", "frame-ancestors 'self'"} <= {*policy}
    assert answer.headers["X-Frame-Options"] == "SAMEORIGIN"
    assert answer.headers["Cache-Control"] == "no-store"
    assert asked(served, "GET", "moving/other")[0].status == 404
    answer, _ = asked(served, "GET", f"/{found['page']}")
    assert answer.status == 403
    broken = json.dumps({"text": PUMP.replace("O1-A = 30", "O1-A = 300"), "page": "steps"})
    assert json.loads(asked(served, "POST", "motion", broken, **JSON)[1])["problems"]


@pytest.mark.parametrize("view", MOTION_VIEWS)
def test_sheets_of_the_whole_motion_are_shown_as_the_command_draws_them(served, view):
    """Positions and diagrams are pages of the motion, the same as those of ``graphkin sheet``."""
    text = Path(scene_files.find("offset-slider-crank")).read_text(encoding="utf-8")
    order = json.dumps(
        {"text": text, "name": "crank.toml", "page": view, "language": "en", "settings": {"n": "9"}}
    )
    found = json.loads(asked(served, "POST", "motion", order, **JSON)[1])
    answer, data = asked(served, "GET", found["page"])
    mechanism = Mechanism(read_text(text, "crank", None, {"n": 9}))
    assert data.decode() == hand_out_page(mechanism, "crank", "crank", view, "en")
    assert answer.status == 200
    assert data.count(b"<svg") >= 3
    broken = json.dumps({"text": text.replace('O-A = "r"', "O-A = 900"), "page": view})
    assert json.loads(asked(served, "POST", "motion", broken, **JSON)[1])["problems"]


def test_a_request_that_is_too_large_is_refused(served):
    line = HTTPConnection(HOME, served.port, timeout=LONG)
    line.putrequest("POST", urlsplit(served.address).path + "look")
    line.putheader("Content-Type", "application/json")
    line.putheader("Content-Length", str(MOST_BYTES + 1))
    line.endheaders()
    assert line.getresponse().status == 413
    line.close()


@pytest.mark.parametrize(
    "body",
    [
        "",
        "no json",
        "[]",
        "null",
        '{"text": 5}',
        '{"text": "\\ud800"}',
        '{"text": "", "settings": []}',
        '{"text": "", "settings": {"n": 5}}',
        '{"text": "", "settings": {"n": ""}}',
        f'{{"text": "", "settings": {{"n": "{"1" * 101}"}}}}',
        '{"text": "", "quick": 1}',
        '{"text": "", "number": -1}',
        '{"text": "", "number": true}',
        '{"text": "", "number": 1e3}',
        '{"text": "", "language": "xx"}',
        '{"text": "", "language": ["en"]}',
        '{"text": "", "mechanism": "both"}',
        '{"text": "", "name": ["x"]}',
        f'{{"text": "", "name": "{"x" * 301}"}}',
        "[" * 100_000,
        b"\xff\xfe",
    ],
)
def test_what_the_page_does_not_ask_is_refused(served, body):
    assert asked(served, "POST", "look", body, **JSON)[0].status == 400


@pytest.mark.parametrize(
    "fields",
    [
        {"kind": "explode", "of": ["A"]},
        {"kind": "move"},
        {"kind": "move", "of": "A"},
        {"kind": "move", "of": ["A", "B", "C"]},
        {"kind": "move", "of": [""]},
        {"kind": "pivot", "at": [1]},
        {"kind": "pivot", "at": [1, "2"]},
        {"kind": "pivot", "at": [1, True]},
        {"kind": "pivot", "at": [1, 1e300]},
        {"kind": "pivot", "places": [1]},
        {"kind": "pivot", "places": {"A": None}},
        {"kind": "pivot", "places": {f"A{n}": [0, 0] for n in range(501)}},
    ],
)
def test_an_act_that_the_page_does_not_ask_is_refused(served, fields):
    order = {"text": PUMP, "language": "en"} | fields
    assert asked(served, "POST", "build", json.dumps(order), **JSON)[0].status == 400
    nan = '{"text": "", "kind": "pivot", "at": [NaN, 0]}'
    assert asked(served, "POST", "build", nan, **JSON)[0].status == 400


def test_an_act_answers_with_the_text_and_writes_no_file(served, place):
    order = {"text": PUMP, "language": "en", "kind": "pivot", "at": [11, 4]}
    found = json.loads(asked(served, "POST", "build", json.dumps(order), **JSON)[1])
    assert found["text"] == PUMP.replace("O2 = [0, -30]\n", "O2 = [0, -30]\nO3 = [11, 4]\n")
    broken = json.loads(
        asked(served, "POST", "build", json.dumps(order | {"text": "= ="}), **JSON)[1]
    )
    assert broken["problems"]
    assert broken["text"] == "= ="
    assert not list(place.iterdir())


def test_scene_and_sheets_are_saved_where_it_was_started(served, place):
    order = {"text": PUMP, "name": "mine.toml", "language": "en", "settings": {"n": "9"}}
    assert json.loads(asked(served, "POST", "save", json.dumps(order), **JSON)[1])["files"]
    assert (place / "mine.toml").read_text(encoding="utf-8") == PUMP
    order |= {"view": "task", "formats": ["svg", "pdf"]}
    found = json.loads(asked(served, "POST", "sheets", json.dumps(order), **JSON)[1])
    names = {path.name for path in place.iterdir()}
    assert names == {"mine.toml", *found["files"]}
    assert "mine-n9-velocity-task.pdf" in names
    again = json.loads(asked(served, "POST", "sheets", json.dumps(order), **JSON)[1])
    assert again["exist"] == found["files"]


def test_a_hostile_name_and_text_stay_text_in_the_page(served, place):
    evil = "</textarea><script>alert(1)</script><img src=x onerror=alert(1)> \" ' &"
    (place / "'&evil.toml").write_text(f"# {evil}\n", encoding="utf-8")
    answer, data = asked(served, "GET", "?scene=%27%26evil.toml")
    assert answer.status == 200
    assert data.count(b"<script") == 1
    assert b"<img" not in data
    assert b"onerror=alert(1)&gt;" in data


def test_a_fault_is_told_without_its_inner_parts(served, monkeypatch, capsys):
    def fault(*_: Any) -> None:
        raise ZeroDivisionError("a secret path")

    monkeypatch.setattr("graphkin.studio.session.look", fault)
    order = json.dumps({"text": PUMP, "language": "en"})
    answer, data = asked(served, "POST", "look", order, **JSON)
    assert answer.status == 500
    assert b"secret" not in data
    monkeypatch.undo()
    assert look(served)["panels"]


def test_requests_that_are_never_finished_keep_nobody_waiting(served):
    half = [socket.create_connection((HOME, served.port)) for _ in range(150)]
    for each in half:
        each.sendall(b"GET / HTTP/1.1\r\nHost: ")
    assert asked(served, "GET", "")[0].status == 200
    for each in half:
        each.close()


def test_a_request_that_is_never_finished_is_closed(tmp_path, monkeypatch):
    monkeypatch.setattr("graphkin.studio.server.IDLE", 0)
    monkeypatch.setattr("graphkin.studio.server.SWEEP", 0)
    with (
        running(serve(desk_in(tmp_path))) as served,
        socket.create_connection((HOME, served.port)) as half,
        suppress(ConnectionResetError),
    ):
        half.sendall(b"GET / HTTP/1.1\r\nHost: ")
        assert half.recv(1) == b""


@pytest.mark.parametrize(("name", "driver"), [("five-bar", 1), ("cylinders-two", 2)])
def test_each_of_several_drivers_is_moved_while_the_others_stand(tmp_path, name, driver):
    """How far the page moves is how far a cycle of that driver does."""
    session, text = desk_in(tmp_path), scene_files.examples()[name].read_text("utf-8")
    answer = session.motion(ordered(text=text, name=f"{name}.toml", page="curves", driver=driver))
    assert len(answer["drivers"]) == 2
    assert not answer["problems"]
    page = session.moving[answer["page"].removeprefix("moving/")]
    mechanism = Mechanism(read_text(text, name))
    swept = cycle(mechanism, driver=driver)
    one = METRES[mechanism.scene.units["length"]] if swept.sweep.what == "slide" else 1.0
    start = swept.sweep.start / one
    ends = next((low, high) for low, high in swept.ranges if low <= swept.sweep.start <= high)
    told = re.findall(r'"low":([-.\de]+),"high":([-.\de]+),"start":([-.\de]+),"whole"', page)
    assert [float(each) for each in told[0]] == pytest.approx([*(e / one for e in ends), start])
    with_time = session.motion(ordered(text=text, name=f"{name}.toml", page="curves"))
    assert session.moving[with_time["page"].removeprefix("moving/")] != page
