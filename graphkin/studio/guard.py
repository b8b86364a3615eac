"""Access to the studio: only from the page whose address holds the token, and only from here.

The server listens on the loopback address alone. A page of another site can still send requests
there. It does not know the token; and a site that points its own name here (DNS rebinding) is
recognized by the Host that its browser sends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from hmac import compare_digest
from secrets import token_urlsafe
from typing import Any

Environ = dict[str, Any]
Start = Callable[..., Any]
Application = Callable[[Environ, Start], Iterable[bytes]]
BITS = 192
"""Bits of a token."""
POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "font-src 'self'",
        "img-src 'self' blob:",  # the sheets of students, as they were sent to the page
        "connect-src 'self'",
        "frame-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    )
)
"""What a browser may load with the page: nothing from outside, and no inline code or styles."""
OWN_POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'unsafe-inline'",
        "style-src 'unsafe-inline'",
        "img-src data:",
        "font-src data:",
        "sandbox allow-scripts",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'self'",
    )
)
"""What a moving page inside the page may do: run its own script.

It has no origin of its own, so it reaches neither the page around it nor the server.
"""
FRAMED = (("Content-Security-Policy", OWN_POLICY), ("X-Frame-Options", "SAMEORIGIN"))
HEADERS = (
    ("Content-Security-Policy", POLICY),
    ("Cache-Control", "no-store"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Content-Type-Options", "nosniff"),
    ("X-Frame-Options", "DENY"),
)
METHODS = ("GET", "POST")


def new_token() -> str:
    """A token that nobody can guess."""
    return token_urlsafe(BITS // 8)


class Guard:
    """Guards an application: requests that are not the page's own get the answer 403 only.

    ``hosts`` are the names under which a browser may call the server, with its port; ``known`` is
    called for every request with the token.
    """

    def __init__(
        self, inside: Application, token: str, hosts: Iterable[str], known: Callable[[], None]
    ) -> None:
        self.inside = inside
        self.token = token.encode()
        self.hosts = frozenset(hosts)
        self.known = known

    def __call__(self, environ: Environ, start: Start) -> Iterable[bytes]:
        """Answer a request, or refuse it."""

        def guarded(status: str, headers: list[tuple[str, str]], *rest: Any) -> Any:
            known = {name for name, _ in headers}
            own = [header for header in HEADERS if header[0] not in known]
            return start(status, [*headers, *own], *rest)

        path = self.path(environ)
        if path is None:
            return refused(guarded)
        self.known()
        within = {**environ, "PATH_INFO": path, "SCRIPT_NAME": ""}
        return self.inside(within, guarded)

    def path(self, environ: Environ) -> str | None:
        """The path behind the token; None for a request that must be refused."""
        host = environ.get("HTTP_HOST", "")
        if host not in self.hosts or environ["REQUEST_METHOD"] not in METHODS:
            return None
        if environ.get("HTTP_ORIGIN", f"http://{host}") != f"http://{host}":
            return None
        empty, _, rest = str(environ.get("PATH_INFO", "")).partition("/")
        token, slash, path = rest.partition("/")
        known = compare_digest(token.encode("utf-8", "replace"), self.token)
        return f"/{path}" if known and slash and not empty else None


def refused(start: Start) -> Iterable[bytes]:
    """The answer to a request that is not the page's own."""
    body = b"403: this address needs the token that graphkin studio has printed.\n"
    start("403 Forbidden", [("Content-Type", "text/plain"), ("Content-Length", str(len(body)))])
    return [body]
