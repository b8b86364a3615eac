"""The server: on the loopback address alone, at a free port, behind a new token."""

from __future__ import annotations

import logging
import socket
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlencode

from graphkin.errors import PageError, Problem
from graphkin.studio.app import application
from graphkin.studio.desk import Desk
from graphkin.studio.guard import Guard, new_token
from graphkin.studio.orders import MOST_BYTES

HOME = "127.0.0.1"
THREADS = 4
NOTHING: Mapping[str, str] = {}
IDLE = 600
"""Seconds after which a silent connection is closed."""


@dataclass(frozen=True, slots=True)
class Served:
    """A server that listens; ``address`` holds the token, ``server`` runs and closes."""

    address: str
    port: int
    server: Any


def serve(desk: Desk, port: int = 0, first: Mapping[str, str] = NOTHING) -> Served:
    """Listen for the page of a desk, which opens what is named ``first``; port 0 is a free one.

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
    guard = Guard(application(desk), token, (f"{HOME}:{port}", f"localhost:{port}"))
    server = create_server(
        guard,
        sockets=[listening],
        threads=THREADS,
        ident="",
        channel_timeout=IDLE,
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
