"""The common parts of pages on this computer: answers to requests, and static files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from graphkin.drawing.richtext import FILES
from graphkin.drawing.richtext import FOLDER as FONTS
from graphkin.studio.session import PageRequestError

KINDS = {".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
KINDS |= {".woff2": "font/woff2", ".html": "text/html", ".png": "image/png", ".jpg": "image/jpeg"}
JSON = "application/json"


def new_application(folder: Path) -> Any:
    """A WSGI application with the files of a folder and the fonts of the sheets."""
    from bottle import Bottle

    app = Bottle()
    app.config["catchall"] = False  # an internal error is printed where the page was started
    app.route("/<name:re:[a-zA-Z-]+\\.(css|js|svg|woff2)>", "GET", lambda name: file(folder, name))
    return app


def file(folder: Path, name: str) -> Any:
    """A file of the page, or one of the sheet's fonts."""
    path = (Path(FONTS) if name in {f"{font}.woff2" for font in FILES.values()} else folder) / name
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
