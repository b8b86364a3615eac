"""The server: on the loopback address alone, at a free port, behind a new token."""

from __future__ import annotations

import logging
import socket
from collections.abc import Callable, Mapping
from typing import Any
from urllib.parse import urlencode

from msgspec import Struct

from graphkin.studio.app import application
from graphkin.studio.guard import Guard, new_token
from graphkin.studio.page_requests import MOST_BYTES
from graphkin.studio.session import Session
from graphkin.text.errors import PageError, Problem

HOME = "127.0.0.1"
THREADS = 16
"""Requests answered at once: of each page that is remembered one look and one to save."""
CONNECTIONS = 500
NOTHING: Mapping[str, str] = {}
IDLE, SWEEP = 10, 2
"""Seconds after which a connection that asks for nothing is closed, and between two searches for
such connections."""


class Served(Struct, frozen=True):
    """A server that listens; ``address`` holds the token, ``server`` runs and closes."""

    address: str
    port: int
    server: Any


def serve(
    session: Session,
    port: int = 0,
    first: Mapping[str, str] = NOTHING,
    known: Callable[[], None] = lambda: None,
) -> Served:
    """Listen for the page of a desk, which opens what is named ``first``; port 0 is a free one.

    ``known`` is called whenever a request shows the token.

    Raises as ``served`` does.
    """
    return served(lambda: application(session), port, first, known)


def served(
    made: Callable[[], Any],
    port: int = 0,
    first: Mapping[str, str] = NOTHING,
    known: Callable[[], None] = lambda: None,
) -> Served:
    """Listen for the page of an application, which is ``made`` when its libraries are there.

    Raises PageError where the port is taken, or where the libraries of the studio are missing.
    """
    try:
        from waitress import create_server
    except ImportError:
        hint = "install them: pip install 'graphkin[studio]'"
        raise PageError(Problem("studio", "needs bottle and waitress", hint=hint)) from None

    logging.getLogger("waitress.queue").setLevel(logging.ERROR)  # that one waits is no news
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
        hint = "leave --port out: a free one is found"
        problem = Problem(f"port {port}", f"cannot be used: {error}", "a free port", hint)
        raise PageError(problem) from error
    found.listen(16)
    return found
