"""Debian's own Firefox, driven by Mozilla's Marionette; it fails on any error that a page logs.

Where it is not installed its tests are skipped: Chromium is the browser that must be there.
"""

from __future__ import annotations

import shutil
import socket
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

FRAME = "[outerWidth - innerWidth, outerHeight - innerHeight]"
LOOKS = {
    "light": {"layout.css.prefers-color-scheme.content-override": 1},
    "dark": {"layout.css.prefers-color-scheme.content-override": 0},
    "forced": {"browser.display.document_color_use": 2},
    "still": {"ui.prefersReducedMotion": 1},
}
"""The settings by which a page looks so."""
PLAIN = {
    "layout.css.prefers-color-scheme.content-override": 1,
    "browser.display.document_color_use": 0,
    "ui.prefersReducedMotion": 0,
}
PAINTED = """const done = arguments[arguments.length - 1];
requestAnimationFrame(() => requestAnimationFrame(() => done()));"""
"""What follows a pointer follows it before the window is painted next."""
ERRORS = """return Services.console.getMessageArray()
  .filter(said => said instanceof Ci.nsIScriptError)
  .filter(said => !(said.flags & Ci.nsIScriptError.warningFlag))
  .filter(said => /^(file:|http:..127.0.0.1)/.test(said.sourceName))
  .map(said => said.errorMessage);"""


class Firefox:
    """A window of Firefox with one page."""

    def __init__(self, client: Any) -> None:
        self.client = client

    def open(self, path: Path, place: str, size: tuple[int, int], look: str = "light") -> None:
        """Open a page in a window of a size; it looks as told."""
        self.open_address(path.as_uri() + place, size, look)

    def open_address(self, address: str, size: tuple[int, int], look: str = "light") -> None:
        """Open an address in a window of a size; it looks as told."""
        for name, value in (PLAIN | LOOKS[look]).items():
            self.client.set_pref(name, value)
        across, down = self.run(f"return {FRAME}")
        self.client.set_window_rect(width=size[0] + across, height=size[1] + down)
        self.client.navigate("about:blank")
        self.client.navigate(address)

    def run(self, script: str, *args: Any) -> Any:
        """The result of a script in the page."""
        return self.client.execute_script(script, script_args=args, sandbox=None)

    def later(self, script: str, *args: Any) -> Any:
        """The result of a script that calls its last argument with it."""
        return self.client.execute_async_script(script, script_args=args, sandbox="axe")

    def press(self, *keys: str) -> None:
        """Press keys, one after the other."""
        keyboard = self.client.actions.sequence("key", "keyboard")
        for key in keys:
            keyboard = keyboard.key_down(key).key_up(key)
        keyboard.perform()

    def click(self, at: tuple[float, float]) -> None:
        """Click a place of the window."""
        hand = self.client.actions.sequence("pointer", "one mouse", {"pointerType": "mouse"})
        hand.pointer_move(*map(round, at)).pointer_down().pointer_up().perform()

    def drag(
        self, start: tuple[float, float], end: tuple[float, float], kind: str = "mouse"
    ) -> None:
        """Drag from one place of the window to another, with mouse or finger."""
        hand = self.client.actions.sequence("pointer", f"one {kind}", {"pointerType": kind})
        hand = hand.pointer_move(*map(round, start)).pointer_down()
        for part in range(1, 6):
            x, y = (a + (b - a) * part / 5 for a, b in zip(start, end, strict=True))
            hand = hand.pointer_move(round(x), round(y), duration=40)
        hand.pointer_up().perform()
        self.later(PAINTED)

    def errors(self) -> list[str]:
        """What pages have logged as errors."""
        with self.client.using_context("chrome"):
            found: list[str] = self.client.execute_script(ERRORS)
            self.client.execute_script("Services.console.reset()")
        return found


def free_port() -> int:
    """A port at which nothing listens."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port: int = one.getsockname()[1]
    return port


@pytest.fixture(scope="session")
def started_firefox() -> Iterator[Firefox]:
    """Debian's firefox-esr."""
    path = shutil.which("firefox-esr") or shutil.which("firefox")
    if not path:
        pytest.skip("no firefox is installed")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what the driver's own packages say of one another
        try:
            from marionette_driver.marionette import Marionette
        except ImportError:
            pytest.skip("marionette-driver is not installed: pip install '.[dev]'")
        client = Marionette(bin=path, headless=True, port=free_port(), prefs=PLAIN, gecko_log="-")
        client.start_session()
    client.timeout.script = 300
    yield Firefox(client)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        client.quit()
        client.cleanup()


@pytest.fixture
def firefox(started_firefox: Firefox) -> Iterator[Firefox]:
    """Firefox, in which no test leaves an error behind."""
    yield started_firefox
    assert started_firefox.errors() == []
