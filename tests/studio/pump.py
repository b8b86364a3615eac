"""The pump as the page of the studio asks for it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Thread
from typing import Any

from graphkin.scene import scene_files
from graphkin.studio.folder import Folder
from graphkin.studio.look import Sight, look
from graphkin.studio.panels import Memory
from graphkin.studio.server import Served
from graphkin.studio.session import PageRequest, Session, requested

PUMP = (scene_files.shelf() / "pump" / "scene.toml").read_text(encoding="utf-8")


def line_with(words: str) -> int:
    """The number of the line of the pump's text that has some words."""
    return PUMP[: PUMP.index(words)].count("\n") + 1


BAR = line_with("A-B = 40")

LONG = 600
"""Seconds after which a studio that has not ended never will, on however slow a machine."""


def seen(text: str = PUMP, memory: Memory | None = None, **options: Any) -> dict[str, Any]:
    """What is seen of a text, in English if no other language is named."""
    sight = Sight(text, "scene", **{"language": "en", **options})
    return look(sight, memory or Memory(), lambda: None)


def svgs(found: dict[str, Any]) -> dict[str, str]:
    """The pictures by name."""
    return {panel["name"]: panel["svg"] for panel in found["panels"]}


def ordered(**fields: Any) -> PageRequest:
    """A request of the page."""
    order = {"text": PUMP, "language": "en", "tab": "a", **fields}
    return requested(json.dumps(order).encode(), PageRequest)


def desk_in(place: Any) -> Session:
    """A desk in a folder."""
    return Session(Folder(place))


@contextmanager
def running(served: Served) -> Iterator[Served]:
    """A studio that runs in a thread of its own until it is not needed any more.

    Its workers end with it, also where a test fails: none computes beside the tests that follow.
    """

    def run() -> None:
        with suppress(OSError):  # its socket is closed under it
            served.server.run()

    thread = Thread(target=run, daemon=True)
    thread.start()
    try:
        yield served
    finally:
        served.server.close()
        served.server.asyncore.close_all(served.server._map, ignore_all=True)
        served.server.task_dispatcher.shutdown(timeout=LONG)
        thread.join(LONG)
    assert not thread.is_alive()
    assert not served.server.task_dispatcher.threads


def drawn(svg: str) -> list[str]:
    """The elements of a picture that are no labels, leaders, details, notes or insets."""
    elements = re.findall(r"<(?:line|circle|path|polyline|polygon|text) [^>]*>", svg)
    moving = re.compile(r'class="(?:label|leader|number|caption|detail|[\w-]+ detail)')
    return [element for element in elements if not moving.search(element)]
