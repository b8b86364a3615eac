"""The addresses of the studio: the page with its files, and what the page asks for."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from graphkin.studio.guard import FRAMED
from graphkin.studio.local_pages import JSON, answer, answering, new_application
from graphkin.studio.page_requests import MOST_BYTES, PageRequest
from graphkin.studio.session import OPENED, Session
from graphkin.studio.studio_page import page
from graphkin.text import LANGUAGES
from graphkin.text.errors import GraphkinError

HERE = Path(__file__).parent / "web"
WORK = (
    "look",
    "build",
    "picture",
    "write",
    "save",
    "sheets",
    "variants",
    "ranges",
    "student",
    "begin",
    "motion",
)
"""What the page asks the desk to do."""


def application(session: Session) -> Any:
    """The WSGI application of a desk."""
    app = new_application(HERE)
    app.route("/", "GET", lambda: start_page(session))
    app.route("/moving/<key:re:[a-zA-Z0-9_-]+>", "GET", lambda key: moving_page(session, key))
    app.route("/scenes", "GET", lambda: scenes(session))
    for name in WORK:
        app.route(f"/{name}", "POST", answering(done_by(session, name), MOST_BYTES))
    return app


def done_by(session: Session, name: str) -> Callable[[bytes], bytes]:
    """What the desk does for the page under a name."""
    work = getattr(session, name)
    return lambda data: record(work(PageRequest(data)))


def scenes(session: Session) -> Any:
    """What there is to start from."""
    return answer(200, JSON, record(session.listed(asked_language() or "en")))


def start_page(session: Session) -> Any:
    """The page with the text that its address names."""
    from bottle import request

    asked = {key: str(value) for key in OPENED if (value := request.query.getunicode(key, ""))}
    kind, name = next(iter(asked.items()), ("", ""))
    try:
        opened = session.open(name, kind)
    except GraphkinError as error:
        return answer(404, "text/plain", f"{error}\n".encode())
    words = session.words(opened.text, asked_language())
    return answer(200, "text/html", page(opened, words).encode())


def asked_language() -> str:
    """The language that an address names; nothing for one that is none."""
    from bottle import request

    language = str(request.query.getunicode("lang", ""))
    return language if language in LANGUAGES else ""


def moving_page(session: Session, key: str) -> Any:
    """A page that moves by itself, to stand within the page."""
    from bottle import HTTPResponse

    found = session.moving.get(key)
    if found is None:
        return answer(404, "text/plain", b"no such page\n")
    headers = {"Content-Type": "text/html; charset=utf-8", **dict(FRAMED)}
    return HTTPResponse(found.encode(), 200, headers)


def record(found: dict[str, Any]) -> bytes:
    """What is answered, as JSON."""
    text = json.dumps(found, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode()
