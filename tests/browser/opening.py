"""Pages opened in the system's own browser; a test fails on any console error and any request."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

import pytest

MUST = "GRAPHKIN_BROWSER"
"""The variable that makes a missing browser a failure."""
ARGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"]
ARGS += ["--disable-background-networking", "--disable-component-update", "--disable-sync"]

Opened = Callable[..., Any]
LONG = 300_000
"""Milliseconds after which nothing more is waited for, on however slow a machine."""
HOUR = 3600
"""Seconds after its beginning at which the clock of a page stands still."""


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """Debian's chromium, driven by Playwright."""
    path = shutil.which("chromium") or shutil.which("chromium-browser")
    if not path:
        missing("no chromium is installed")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("playwright is not installed")
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=path, args=ARGS)
        yield browser
        browser.close()


def missing(reason: str) -> NoReturn:
    """Skip, or fail where browsers are a must."""
    if os.environ.get(MUST):
        pytest.fail(reason)
    pytest.skip(reason)


def barred(page: Any) -> list[tuple[str, list[str]]]:
    """What axe finds against a page: each rule, and what breaks it."""
    try:
        from axe_playwright_python.sync_playwright import Axe
    except ImportError:
        missing("axe-playwright-python is not installed")
    found = Axe().run(page).response["violations"]
    return [(rule["id"], [node["html"][:120] for node in rule["nodes"]]) for rule in found]


@contextmanager
def watched(chromium: Any, own: tuple[str, ...], levels: tuple[str, ...]) -> Iterator[Opened]:
    """New pages, each in a context of its own: page(color_scheme="dark").

    Fails at the end for what any of them told on the console at one of the levels,
    for its uncaught errors, and for what it asked for but addresses that begin with one of own.
    """
    contexts, wrong = [], []

    def page(**options: Any) -> Any:
        context = chromium.new_context(**options)
        contexts.append(context)
        found = context.new_page()
        found.set_default_timeout(LONG)

        def told(said: Any) -> None:
            if said.type in levels:
                place = said.location
                at = f"{place.get('url', '')[-60:]}:{place.get('lineNumber')}"
                wrong.append(f"console {said.type}: {said.text} ({at}; page {found.url})")

        def asked(request: Any) -> None:
            if not request.url.startswith(own):
                wrong.append(f"request: {request.method} {request.url} (page {found.url})")

        def failed(error: Any) -> None:
            wrong.append(f"uncaught: {error} {error.stack or ''} (page {found.url})")

        found.on("console", told)
        found.on("pageerror", failed)
        found.on("request", asked)
        return found

    yield page
    for context in contexts:
        context.close()
    if wrong:
        pytest.fail("told or asked for by a page:\n" + "\n".join(wrong), pytrace=False)


@pytest.fixture
def opened(chromium: Any) -> Iterator[Opened]:
    """Open a page: opened(path, "#step=3", color_scheme="dark").

    Where it is stopped its clock stands still but for page.clock.run_for(milliseconds), so that
    what it does after a while comes then, however slow the machine is.
    """
    with watched(chromium, ("file:", "blob:", "data:"), ("error",)) as new_page:

        def told(path: Path, place: str = "", *, stopped: bool = False, **options: Any) -> Any:
            page = new_page(**options)
            if stopped:
                page.clock.install(time=0)
            page.goto(path.as_uri() + place)
            if stopped:
                page.clock.pause_at(HOUR)
            return page

        yield told
