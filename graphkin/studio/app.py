"""The addresses of the studio: the page with its files, and what the page asks for."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from graphkin.drawing.glyphs import FILES
from graphkin.drawing.glyphs import FOLDER as FONTS
from graphkin.studio.guard import FRAMED
from graphkin.studio.page_requests import MOST_BYTES, PageRequest, PageRequestError
from graphkin.studio.session import OPENED, Session
from graphkin.studio.studio_page import page
from graphkin.text import LANGUAGES
from graphkin.text.errors import GraphkinError

HERE = Path(__file__).parent / "web"
KINDS = {
    ".css": "text/css",
    ".js": "text/javascript",
    ".svg": "image/svg+xml",
    ".woff2": "font/woff2",
}
JSON = "application/json"
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
    from bottle import Bottle

    app = Bottle()
    app.config["catchall"] = False  # a fault is told where the studio was started
    app.route("/", "GET", lambda: start_page(session))
    app.route("/moving/<key:re:[a-zA-Z0-9_-]+>", "GET", lambda key: moving_page(session, key))
    app.route("/scenes", "GET", lambda: record(session.listed(asked_language() or "en")))
    app.route("/<name:re:[a-zA-Z-]+\\.(css|js|svg|woff2)>", "GET", static)
    for name in WORK:
        app.route(f"/{name}", "POST", answering(getattr(session, name)))
    return app


def answering(work: Callable[[PageRequest], dict[str, Any]]) -> Callable[[], Any]:
    """A handler that reads what is asked for and gives the answer as JSON."""

    def handler() -> Any:
        from bottle import request

        if request.content_type.partition(";")[0].strip() != JSON:
            return answer(415, "text/plain", b"JSON is expected\n")
        if request.content_length > MOST_BYTES:
            return answer(413, "text/plain", b"too large\n")
        data = request.body.read(MOST_BYTES + 1)
        try:
            return record(work(PageRequest(data)))
        except PageRequestError as error:
            return answer(400, "text/plain", f"{error}: not as the page asks\n".encode())

    return handler


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


def static(name: str) -> Any:
    """A file of the page, or one of the sheet's fonts."""
    folder = FONTS if name in {f"{font}.woff2" for font in FILES.values()} else HERE
    path = folder / name
    if not path.is_file():
        return answer(404, "text/plain", b"no such file\n")
    return answer(200, KINDS[path.suffix], path.read_bytes())


def record(found: dict[str, Any]) -> Any:
    """An answer as JSON."""
    text = json.dumps(found, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return answer(200, JSON, text.encode())


def answer(status: int, kind: str, body: bytes) -> Any:
    """An answer of some kind; texts are UTF-8."""
    from bottle import HTTPResponse

    whole = kind if kind.startswith("font") else f"{kind}; charset=utf-8"
    return HTTPResponse(body, status, {"Content-Type": whole})
