"""The addresses of the studio and its server, on the loopback address and behind a new token.

A file readable by this user alone that redirects a browser to the page.

Every user of a computer can read the command line of a browser, so it names this file rather than
the address with its token.

The common parts of pages on this computer: answers to requests, and static files.
"""

from __future__ import annotations

import json
import logging
import socket
from collections.abc import Callable, Mapping
from functools import lru_cache
from html import escape
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from typing import Any
from urllib.parse import urlencode

from msgspec import Struct

from graphkin import __version__
from graphkin.documents import VIEWS
from graphkin.drawing.richtext import FILES
from graphkin.drawing.richtext import FOLDER as FONTS
from graphkin.scene import scene_files
from graphkin.studio.guard import FRAMED, Guard, new_token
from graphkin.studio.look import spoken_in
from graphkin.studio.session import (
    MOST_BYTES,
    MOVING,
    OPENED,
    Opened,
    PageRequest,
    PageRequestError,
    Session,
)
from graphkin.text import LANGUAGES, Words, keys
from graphkin.text.errors import GraphkinError, PageError, Problem, message
from graphkin.writers.templates import from_template

KINDS = {".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
KINDS |= {".woff2": "font/woff2", ".html": "text/html", ".png": "image/png", ".jpg": "image/jpeg"}
JSON = "application/json"


HERE = Path(__file__).parent / "web"
MARK = "mark.svg"
"""The icon of every local page."""


def new_application(folder: Path) -> Any:
    """A WSGI application with the files of a folder and the fonts of the sheets."""
    from bottle import Bottle

    app = Bottle()
    app.config["catchall"] = False  # an internal error is printed where the page was started
    app.route("/<name:re:[a-zA-Z-]+\\.(css|js|svg|woff2)>", "GET", lambda name: file(folder, name))
    return app


def file(folder: Path, name: str) -> Any:
    """A file of the page, the mark of graphkin, or one of the sheet's fonts."""
    shared = dict.fromkeys((f"{font}.woff2" for font in FILES.values()), Path(FONTS))
    path = (shared | {MARK: HERE}).get(name, folder) / name
    if not path.is_file():
        return answer(404, "text/plain", b"no such file\n")
    return answer(200, KINDS[path.suffix], path.read_bytes())


def answering(work: Callable[[bytes], bytes], most: int) -> Callable[[], Any]:
    """A handler that takes JSON of at most ``most`` bytes and returns the result of ``work``."""

    def handler() -> Any:
        from bottle import request

        if request.content_type.partition(";")[0].strip() != JSON:
            return answer(415, "text/plain", b"JSON is expected\n")
        if request.content_length > most:
            return answer(413, "text/plain", b"too large\n")
        try:
            return answer(200, JSON, work(request.body.read(most + 1)))
        except PageRequestError as error:
            return answer(400, "text/plain", f"{error}: not as the page asks\n".encode())

    return handler


def answer(status: int, kind: str, body: bytes) -> Any:
    """An answer with a status and a content type; texts are UTF-8."""
    from bottle import HTTPResponse

    whole = (
        kind if kind.startswith(("font", "image/jpeg", "image/png")) else f"{kind}; charset=utf-8"
    )
    return HTTPResponse(body, status, {"Content-Type": whole})


SPOKEN = "studio."
"""Prefix of the keys of the studio's sentences, in the page and in later messages."""
PLANS = ("sheet.velocity", "sheet.acceleration")


def page(opened: Opened, words: Words) -> str:
    """The complete page for a text, with the words of all languages."""
    spoken = {language: spoken_in(language) for language in LANGUAGES}
    said = {language: said_in(language) for language in LANGUAGES}
    start = {"language": words.language, "words": said}
    page = from_template(
        "studio/web/page.html",
        said=said[words.language],
        spoken=spoken,
        language=words.language,
        views=VIEWS,
        moving=MOVING,
        version=__version__,
        name=opened.name,
        mark=opened.mark,
        text=opened.text.removeprefix("\ufeff"),
        rules=opened.rules.removeprefix("\ufeff"),
        rules_mark=opened.rules_mark,
        gone=opened.gone,
        start=json.dumps(start, ensure_ascii=False),
    )
    return f"{page}\n"


@lru_cache(maxsize=8)
def said_in(language: str) -> dict[str, str]:
    """The sentences of the page in one language."""
    words = spoken_in(language)
    own = (key for key in keys() if key.startswith(SPOKEN))
    return {key: words.open(key) for key in (*own, *PLANS)}


# --- the addresses of the studio and its server ---------------------------------------------------


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
    "bring",
    "explain",
)
"""The requests of the page to the session."""


def application(session: Session) -> Any:
    """The WSGI application of a session."""
    app = new_application(HERE)
    app.route("/", "GET", lambda: start_page(session))
    app.route("/moving/<key:re:[a-zA-Z0-9_-]+>", "GET", lambda key: moving_page(session, key))
    app.route("/scenes", "GET", lambda: scenes(session))
    app.route("/manual/<name:path>", "GET", manual_page)
    for name in WORK:
        app.route(f"/{name}", "POST", answering(done_by(session, name), MOST_BYTES))
    return app


def done_by(session: Session, name: str) -> Callable[[bytes], bytes]:
    """The handler of a session for a request."""
    work = getattr(session, name)
    return lambda data: record(work(PageRequest(data)))


def scenes(session: Session) -> Any:
    """The scenes that can be opened."""
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
    """The language that an address names; empty for an unknown one."""
    from bottle import request

    language = str(request.query.getunicode("lang", ""))
    return language if language in LANGUAGES else ""


@lru_cache(maxsize=1)
def manual_files() -> Mapping[str, bytes]:
    """The files of the manual by their names."""
    from graphkin.manual.site import site

    return dict(site(opening))


def opening(name: str) -> str:
    """The address that opens a shipped scene, as seen from the gallery of the manual."""
    kind = "lab" if name in scene_files.names() else "example"
    return f"../?{urlencode({kind: name})}"


def manual_page(name: str) -> Any:
    """A file of the manual."""
    found = manual_files().get(name)
    if found is None:
        return answer(404, "text/plain", b"no such page\n")
    return answer(200, KINDS.get(Path(name).suffix, "application/octet-stream"), found)


def moving_page(session: Session, key: str) -> Any:
    """A moving page, shown inside the page."""
    from bottle import HTTPResponse

    found = session.moving.get(key)
    if found is None:
        return answer(404, "text/plain", b"no such page\n")
    headers = {"Content-Type": "text/html; charset=utf-8", **dict(FRAMED)}
    return HTTPResponse(found.encode(), 200, headers)


def record(found: dict[str, Any]) -> bytes:
    """An answer as JSON."""
    text = json.dumps(found, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode()


HOME = "127.0.0.1"
THREADS = 16
"""Requests answered at once: one look and one save for each remembered page."""
CONNECTIONS = 500
NOTHING: Mapping[str, str] = {}
IDLE, SWEEP = 2, 1
"""Seconds before an idle connection is closed, and seconds between two searches for them.

When too many connections are open, a page waits no longer than the sum of both.
"""


class Served(Struct, frozen=True):
    """A listening server; ``address`` holds the token, ``server`` runs and closes."""

    address: str
    port: int
    server: Any


def serve(
    session: Session,
    port: int = 0,
    first: Mapping[str, str] = NOTHING,
    known: Callable[[], None] = lambda: None,
) -> Served:
    """Listen for the page of a session, which opens the scene named in ``first``.

    Port 0 means a free port. ``known`` is called for every request with the token. Raises as
    ``served`` does.
    """
    return served(lambda: application(session), port, first, known)


def served(
    made: Callable[[], Any],
    port: int = 0,
    first: Mapping[str, str] = NOTHING,
    known: Callable[[], None] = lambda: None,
) -> Served:
    """Listen for the page of an application, which is ``made`` once its libraries are found.

    Raises PageError where the port is in use, or where the libraries of the studio are missing.
    """
    try:
        from waitress import create_server
    except ImportError:
        hint = message("install them: pip install 'graphkin[studio]'")
        raise PageError.at("studio", message("needs bottle and waitress"), hint=hint) from None

    logging.getLogger("waitress.queue").setLevel(logging.ERROR)  # a waiting request is no news
    listening = listener(port)
    port = listening.getsockname()[1]
    token = new_token()
    hosts = (f"{HOME}:{port}", f"localhost:{port}")
    guard = Guard(made(), token, hosts, known)
    server = create_server(
        guard,
        sockets=[listening],
        threads=THREADS,
        ident="",
        connection_limit=CONNECTIONS,
        asyncore_use_poll=True,  # select takes no file beyond the 1024th
        channel_timeout=IDLE,
        cleanup_interval=SWEEP,
        max_request_body_size=MOST_BYTES,
        max_request_header_size=16 * 1024,
        clear_untrusted_proxy_headers=True,
    )
    query = f"?{urlencode(first)}" if first else ""
    return Served(f"http://{HOME}:{port}/{token}/{query}", port, server)


def listener(port: int) -> socket.socket:
    """A socket that listens at a port of the loopback address."""
    found = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        found.bind((HOME, port))
    except (OSError, OverflowError) as error:
        found.close()
        hint = message("leave --port out: a free one is found")
        problem = Problem(
            message("port {port}", port=port),
            message("cannot be used: {error}", error=str(error)),
            message("a free port"),
            hint,
        )
        raise PageError(problem) from error
    found.listen(16)
    return found


PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={address}">
<title>graphkin</title>
</head>
<body><a href="{address}">graphkin studio</a></body>
</html>
"""


class Redirect:
    """A redirect that exists from its writing until the page is requested."""

    def __init__(self) -> None:
        self.folder: Path | None = None

    def write(self, address: str) -> str:
        """Write the file into a folder that only this user may open; return its address."""
        self.folder = Path(mkdtemp(prefix="graphkin-"))
        path = self.folder / "studio.html"
        path.write_text(PAGE.format(address=escape(address)), encoding="utf-8")
        return path.as_uri()

    def remove(self) -> None:
        """Remove the file, if it still exists."""
        folder, self.folder = self.folder, None
        if folder:
            rmtree(folder, ignore_errors=True)
